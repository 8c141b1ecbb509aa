"""Types with members that are wrong, and materials that are: what is told, and what stays."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish

from .texts import RED, converted, document, lit, node, told

BAND = '<member name="width" type="float"/><member name="tint" type="color3"/>'
MEMBER = (
    '<typedef name="band">{}</typedef><nodedef name="ND_shows" node="shows">'
    '<input name="in" type="band"/><output name="out" type="color3"/></nodedef>'
    '<implementation name="IM_shows" nodedef="ND_shows" target="genglsl" '
    'sourcecode="{{{{in}}}}{}"/>'
    '<shows name="x" type="color3"><input name="in" type="band" value="{}"/></shows>'
)
NODES = {
    "a structure with too few members": (
        node(MEMBER.format(BAND, ".width", "{0.5}")),
        "doc.mtlx:2: x: '{0.5}' is no value of the type band",
    ),
    "a structure without braces": (
        node(MEMBER.format(BAND, ".width", "0.5; 1, 1, 1")),
        "doc.mtlx:2: x: '0.5; 1, 1, 1' is no value of the type band",
    ),
    "a member that is no number": (
        node(MEMBER.format(BAND, ".width", "{wide; 1, 1, 1}")),
        "doc.mtlx:2: x: 'wide' is no value of the type float",
    ),
    "no such member": (
        node(MEMBER.format(BAND, ".depth", "{0.5; 1, 1, 1}")),
        "doc.mtlx:2: x: the type band has no member 'depth'",
    ),
    "a member of another type": (
        node(MEMBER.format(BAND, ".width", "{0.5; 1, 1, 1}")),
        "doc.mtlx:2: x: '{{in}}.width' is a float, and no color3",
    ),
    "a member that is a text": (
        node(MEMBER.format('<member name="tint" type="string"/>', ".tint", "{red}")),
        "doc.mtlx:2: x: there are no values of the type string in shaders",
    ),
    "a type within itself": (
        node(MEMBER.format('<member name="tint" type="band"/>', ".tint", "")),
        "doc.mtlx:2: x: the type band contains itself",
    ),
    "types that grow": (
        node("".join(
            f'<typedef name="b{place + 1}"><member name="l" type="b{place}"/>'
            f'<member name="r" type="b{place}"/></typedef>' for place in range(50)
        ) + '<typedef name="b0"><member name="l" type="float"/></typedef>'
        + MEMBER.format('<member name="tint" type="b50"/>', ".tint", "")),
        "doc.mtlx:2: x: the type b13 has more than 4096 members in members",
    ),
    "a source that is more than a member": (
        node(MEMBER.format(BAND, ".tint * 2.0", "{0.5; 1, 1, 1}")),
        "doc.mtlx:2: x: shows has no meaning for renderers of the kind of Burnish",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", NODES)
def test_what_is_wrong_with_a_type_is_told(name: str, tmp_path: Path) -> None:
    text, expected = NODES[name]
    assert expected in told(tmp_path, text)


OWN = (
    '<nodedef name="ND_twice" node="twice"><input name="in" type="color3" value="1, 1, 1"/>'
    '<output name="out" type="color3"/></nodedef>'
    '<nodegraph name="NG_twice" nodedef="ND_twice"><multiply name="m" type="color3">'
    '<input name="in1" type="color3" interfacename="in"/><input name="in2" type="float" value="2"/>'
    '</multiply><output name="out" type="color3" nodename="m"/></nodegraph>'
    '<twice name="t" type="color3"><input name="in" type="color3" value="0.1, 0.2, 0.3"/></twice>'
)


@pytest.mark.parametrize(("last", "expected"), [('nodename="t"', 1), (RED, 0)])
def test_a_function_of_what_is_not_converted_stays_if_others_read_it(
    last: str, expected: int, tmp_path: Path
) -> None:
    bad = lit('nodename="t"', "Bad").replace('name="s"', 'name="bad"').replace(
        "</surface_unlit>", '<input name="opacity" type="float" nodename="gone"/></surface_unlit>'
    ).replace('nodename="s"', 'nodename="bad"')  # fmt: skip
    found = converted(tmp_path, document(f"{OWN}{bad}{lit(last, 'Good')}"))
    assert [material.name for material in found.materials] == ["Good"]
    assert found.files["doc.burnish"].decode().count("fn twice(") == expected
    assert not burnish.check(tmp_path / found.main)
