"""Nodes that are sides of many others are written once, however many ways lead to them."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish

from .texts import converted, document, told

TIMES = 40
"""How often a node is both sides of the next one: 2 to this power ways lead to the first one."""
MATERIAL = (
    '<surfacematerial name="m" type="material">'
    '<input name="{0}" type="{0}" nodename="n{1}"/></surfacematerial>'
)
SCATTERING = (
    '<oren_nayar_diffuse_bsdf name="b" type="BSDF"/>'
    '<surface name="n0" type="surfaceshader"><input name="bsdf" type="BSDF" nodename="b"/>'
    '<input name="opacity" type="float" value="0.5"/></surface>'
)
MODEL = '<standard_surface name="n0" type="surfaceshader"/>'
MOVING = (
    '<displacement name="n0" type="displacementshader">'
    '<input name="displacement" type="float" value="0.5"/></displacement>'
)


def doubled(first: str, kind: str, node: str, sides: tuple[str, str]) -> str:
    """The first node, and others each of which has the one before it on both sides."""
    inputs = "".join(f'<input name="{side}" type="{kind}" nodename="n{{}}"/>' for side in sides)
    return first + "".join(
        f'<{node} name="n{place + 1}" type="{kind}">{inputs.format(place, place)}</{node}>'
        for place in range(TIMES)
    )


@pytest.mark.parametrize(
    ("first", "kind", "written"),
    [
        (SCATTERING, "surfaceshader", "n1_alpha = mix(n0_alpha, n0_alpha, 0)"),
        (MODEL, "surfaceshader", "n1 = mixed(n0, n0, 0)"),
        (MOVING, "displacementshader", "n1 = mix(n0, n0, 0)"),
    ],
)
def test_a_mix_of_mixes_is_as_long_as_its_nodes(
    first: str, kind: str, written: str, tmp_path: Path
) -> None:
    body = doubled(first, kind, "mix", ("bg", "fg")) + MATERIAL.format(kind, TIMES)
    found = converted(tmp_path, document(body))
    assert not found.problems
    text = " ".join((tmp_path / found.main).read_text().split())
    assert text.count(written) == 1
    assert text.count("mix") < 3 * TIMES
    assert not burnish.check(tmp_path / found.main)


def test_closures_of_closures_are_looked_at_once(tmp_path: Path) -> None:
    closures = doubled('<oren_nayar_diffuse_bsdf name="n0" type="BSDF"/>', "BSDF", "add",
                       ("in1", "in2"))  # fmt: skip
    surface = (
        '<surface name="s" type="surfaceshader">'
        f'<input name="bsdf" type="BSDF" nodename="n{TIMES}"/></surface>'
    )
    material = MATERIAL.format("surfaceshader", "").replace('"n"', '"s"')
    found = converted(tmp_path, document(closures + surface + material))
    assert not found.problems
    assert (tmp_path / found.main).read_text().count("added(") == TIMES


@pytest.mark.parametrize("kind", ["surfaceshader", "displacementshader"])
def test_a_mix_that_is_its_own_side_is_told(kind: str, tmp_path: Path) -> None:
    mix = f'<mix name="n0" type="{kind}"><input name="bg" type="{kind}" nodename="n1"/></mix>'
    body = mix + "\n" + mix.replace("n1", "n2").replace("n0", "n1").replace("n2", "n0")
    assert told(tmp_path, document(f"{body}\n{MATERIAL.format(kind, 0)}")) == [
        "doc.mtlx:2: n0: this node depends on itself"
    ]
