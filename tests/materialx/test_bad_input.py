"""Documents that are broken, hostile or huge are told by file, line and node, and never crash."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

import burnish
from burnish.materialx.importing import imported
from burnish.materialx.outline import DocumentError

from .texts import RED, converted, document, lit, node, told

ADD = '<add name="{}" type="color3"><input name="in1" type="color3" {}/></add>'
LOOP = (
    '<nodedef name="ND_loop" node="loop"><output name="out" type="color3"/></nodedef>\n'
    '<nodegraph name="NG_loop" nodedef="ND_loop"><loop name="l" type="color3"/>'
    '<output name="out" type="color3" nodename="l"/></nodegraph>\n'
    '<loop name="x" type="color3"/>'
)
GRAPH = '<nodegraph name="g"><constant name="c" type="color3">{}</constant>{}</nodegraph>'
OUT = '<output name="out" type="color3" {}/>'
IN = '<input name="value" type="color3" {}/>'
NODES = {
    "unknown node": (
        node('<mystery name="x" type="color3"/>'),
        "doc.mtlx:2: x: MaterialX knows no 'mystery' of these types",
    ),
    "misspelt node": (
        node('<constan name="x" type="color3"/>'),
        "doc.mtlx:2: x: MaterialX knows no 'constan' of these types: did you mean 'constant'?",
    ),
    "a category for a type": (
        node('<noise3d name="x" type="noise3d"/>'),
        "doc.mtlx:2: x: noise3d is of the type float, color3, color4, vector2, vector3 or vector4, "
        "and not 'noise3d'",
    ),
    "nodes in a circle": (
        node("\n".join((ADD.format("y", 'nodename="x"'), ADD.format("x", 'nodename="y"')))),
        "doc.mtlx:3: x: this node depends on itself",
    ),
    "a definition that contains itself": (
        node(LOOP),
        "doc.mtlx:3: NG_loop/l: the definition ND_loop contains itself",
    ),
    "a graph that reads itself": (
        node(GRAPH.format(IN.format('nodegraph="g"'), OUT.format('nodename="c"'))),
        "doc.mtlx:2: g: the output 'out' depends on itself",
    ),
    "an output that is itself": (
        document('<output name="o" type="color3" output="o"/>\n' + lit('output="o"')),
        "doc.mtlx:3: s: the output 'o' depends on itself",
    ),
    "another type": (
        node('<constant name="x" type="matrix44"/>'),
        "doc.mtlx:3: s: the input 'emission_color' of the type color3 is connected to 'x', which "
        "is of the type matrix44",
    ),
    "no such node": (
        document(lit('nodename="nope"')),
        "doc.mtlx:2: s: there is no node 'nope'",
    ),
    "no such graph": (
        document(lit('nodegraph="nope"')),
        "doc.mtlx:2: s: there is no graph 'nope'",
    ),
    "no such output of a graph": (
        document(GRAPH.format("", OUT.format('nodename="c"')) + "\n"
                 + lit('nodegraph="g" output="nope"')),
        "doc.mtlx:3: s: the graph g has no output 'nope'",
    ),
    "a graph without outputs": (
        node(GRAPH.format("", "")),
        "doc.mtlx:3: s: the graph g has no output",
    ),
    "two numbers for three": (
        document(lit('value="1, 2"')),
        "doc.mtlx:2: s: the input 'emission_color': '1, 2' is no value of the type color3",
    ),
    "no number": (
        document(lit('value="nan, 1, 2"')),
        "doc.mtlx:2: s: the input 'emission_color': 'nan, 1, 2' is no value of the type color3",
    ),
    "no such space of colours": (
        document(lit(f'{RED} colorspace="mine"')),
        "doc.mtlx:2: s: there is no colour space 'mine'",
    ),
    "a material that is its own surface": (
        document('<surfacematerial name="m" type="material">\n'
                 '<input name="surfaceshader" type="surfaceshader" nodename="m"/>\n'
                 "</surfacematerial>"),
        "doc.mtlx:2: m: this material depends on itself",
    ),
    "a surface from a graph that is its own": (
        document('<nodegraph name="g"><output name="out" type="surfaceshader" nodegraph="g"/>'
                 '</nodegraph>\n<surfacematerial name="m" type="material">\n'
                 '<input name="surfaceshader" type="surfaceshader" nodegraph="g"/>\n'
                 "</surfacematerial>"),
        "doc.mtlx:2: g: this surface depends on itself",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", NODES)
def test_what_is_wrong_with_a_node_is_told_by_its_line(name: str, tmp_path: Path) -> None:
    text, expected = NODES[name]
    assert expected in told(tmp_path, text)


XI = '<xi:include xmlns:xi="http://www.w3.org/2001/XInclude" href="{}"/>'
OUTSIDE = "doc.mtlx:1: error: '{}' is included from outside of the document's folder"
FILES: dict[str, tuple[str | bytes, str]] = {
    "empty": ("", "doc.mtlx:1: error: the file is empty"),
    "bytes": (
        bytes(range(256)),
        "doc.mtlx:2: error: this is no XML: an element is not closed, or an attribute has no "
        "quotes",
    ),
    "no UTF-8": (b"<materialx>\xff</materialx>", "doc.mtlx:1: error: this text is not UTF-8"),
    "a zero": (
        b"<materialx>\0</materialx>",
        "doc.mtlx:1: error: XML parse error (Start-end tags mismatch at character 11)",
    ),
    "no XML": (
        "hello",
        "doc.mtlx:1: error: XML parse error (No document element found at character 5)",
    ),
    "another XML": (
        "<html></html>",
        "doc.mtlx:1: error: this is no document of MaterialX: it begins with <html>",
    ),
    "not closed": (
        "<materialx>\n<a>\n</materialx>",
        "doc.mtlx:3: error: this is no XML: </materialx> closes <a>",
    ),
    "entities that grow": (
        '<?xml version="1.0"?>\n<!DOCTYPE a [<!ENTITY b "bbb"><!ENTITY c "&b;&b;">]>\n<materialx/>',
        "doc.mtlx:2: error: documents of MaterialX have no DOCTYPE and no entities",
    ),
    "100 000 deep": (
        "<materialx>\n" + "<a>" * 100_000,
        "doc.mtlx:2: error: elements nest more than 64 deep",
    ),
    "a base that is itself": (
        document(lit(more=' inherit="m"')),
        'doc.mtlx:1: error: encountered cycle at element: <surfacematerial name="m" type="material"'
        ' inherit="m">',
    ),
    **{
        f"includes {href[:20]}": (document(XI.format(href)), OUTSIDE.format(href))
        for href in (
            "http://example.org/a.mtlx", "file:///etc/passwd", "../beside.mtlx", "/etc/passwd",
            "//host/share", "link/beside.mtlx",
        )
    },
    "includes nothing": (
        document(XI.format("gone.mtlx")),
        "doc.mtlx:1: error: there is no file 'gone.mtlx', which is included",
    ),
    "includes a long name": (
        document(XI.format("x" * 5000)),
        f"doc.mtlx:1: error: there is no file '{'x' * 100}…', which is included",
    ),
    "includes no path": (
        document(XI.format("a\0b")),
        "doc.mtlx:1: error: there is no file 'a\0b', which is included",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", FILES)
def test_what_is_no_document_is_told(name: str, tmp_path: Path) -> None:
    folder = tmp_path / "folder"
    folder.mkdir()
    (tmp_path / "beside.mtlx").write_text(document(lit(name="secret")))
    (folder / "link").symlink_to(tmp_path)
    text, expected = FILES[name]
    assert told(folder, text) == [expected]


def test_a_document_that_includes_itself_is_read_once(tmp_path: Path) -> None:
    found = converted(tmp_path, document(XI.format("doc.mtlx") + lit()))
    assert [material.name for material in found.materials] == ["M"]
    assert not found.problems


def test_a_huge_file_is_refused_by_its_size(tmp_path: Path) -> None:
    path = tmp_path / "huge.mtlx"
    path.touch()
    os.truncate(path, 1 << 33)
    with pytest.raises(
        DocumentError, match=r"^huge\.mtlx:1: error: documents of more than 32 MiB are not read$"
    ):
        imported(path)


def test_a_file_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(FileNotFoundError):
        imported(tmp_path / "gone.mtlx")


def test_pictures_outside_of_the_folder_are_not_read(tmp_path: Path) -> None:
    folder = tmp_path / "folder"
    folder.mkdir()
    (tmp_path / "secret.png").write_bytes(b"secret")
    (folder / "link.png").symlink_to(tmp_path / "secret.png")
    for name in ("../secret.png", str(tmp_path / "secret.png"), "link.png", "x" * 5000 + ".png"):
        image = (
            '<image name="x" type="color3"><input name="file" type="filename" value="{}"/></image>'
        )
        found = converted(folder, node(image.format(name)))
        assert set(found.files) == {"doc.burnish"}
        problem = found.problems[0]
        assert not problem.is_error
        assert str(problem) == (
            f"doc.mtlx:6: m: the picture `{name}` is not in the document's folder: its texture is "
            "white until a host binds it"
        )


@pytest.mark.parametrize("version", ["1.36", "1.38", "1.39", "2.0", "99999999999999999999", "one"])
def test_documents_of_other_versions(version: str, tmp_path: Path) -> None:
    """Older ones are upgraded by MaterialX; all others are read as they stand."""
    found = converted(tmp_path, document(lit(), version))
    assert [material.name for material in found.materials] == ["M"]


def test_two_elements_with_one_name(tmp_path: Path) -> None:
    """The first one is read, as MaterialX does."""
    found = converted(tmp_path, document(lit() + "\n" + lit('value="0, 1, 0"')))
    assert "rgb(1, 0, 0)" in found.files["doc.burnish"].decode()
    left_out = "an element before it has this name already, and this one is left out"
    assert [str(problem) for problem in found.problems] == [
        f"doc.mtlx:8: s: {left_out}", f"doc.mtlx:11: m: {left_out}",
    ]  # fmt: skip


UNREAD = """<surface_unlit name="s" type="surfaceshader" inherit="base">
<input name="emision" type="float" value="2"/>
<input name="qqqqq" type="float" value="2"/>
<input name="opacity" type="color3" value="1, 1, 1"/>
</surface_unlit>"""


def test_what_a_definition_does_not_read_is_told_and_the_rest_converted(tmp_path: Path) -> None:
    found = converted(tmp_path, document(UNREAD))
    assert [material.name for material in found.materials] == ["S"]
    assert not any(problem.is_error for problem in found.problems)
    assert [str(problem) for problem in found.problems] == [
        "doc.mtlx:2: s: there is no node 'base' to inherit from",
        "doc.mtlx:3: s/emision: surface_unlit has no such input, and it is left out: "
        "did you mean 'emission'?",
        "doc.mtlx:4: s/qqqqq: surface_unlit has no such input, and it is left out",
        "doc.mtlx:5: s/opacity: this input of surface_unlit is of the type float, and not color3",
    ]


HOSTILE = "a&#10;} material Evil {} &#13; */ } &#x2028;/// &#x85; material Evil {}"
NAMES = (
    "Ünï cödé", "a b", "../x", "material", "for", "float4", "main", "gl_Position", "π", "1a",
    "Surface", "MaterialXSurface", "vec3", "pi", "true", "in", "sampler", "discard", "a/b", "if",
    "Asked", "mix", "uv", "normal", "color", "x" * 5000, HOSTILE,
)  # fmt: skip
NAMED = """<nodegraph name="g" doc="{hostile}">
<input name="{name}" type="color3" value="0,1,0" doc="{hostile}" uimin="0" uimax="inf"/>
<input name="b{name}" type="float" value="0" uiname="{hostile}" uimin="nan" uimax="1e999"/>
<noise3d name="q" type="float"/>
<multiply name="{name}k" type="color3" doc="{hostile}">
<input name="in1" type="color3" interfacename="{name}"/>
<input name="in2" type="float" nodename="q"/></multiply>
<multiply name="z{name}" type="color3"><input name="in1" type="color3" nodename="{name}k"/>
<input name="in2" type="color3" nodename="{name}k"/></multiply>
<multiply name="y" type="color3"><input name="in1" type="color3" nodename="z{name}"/>
<input name="in2" type="float" interfacename="b{name}"/></multiply>
<output name="out" type="color3" nodename="y"/></nodegraph>
"""


def test_names_of_all_kinds_become_names_of_burnish(tmp_path: Path) -> None:
    """And texts of all kinds stay in their comments: each file has one material, and compiles."""
    for number, name in enumerate(NAMES):
        folder = tmp_path / str(number)
        folder.mkdir()
        hostile = HOSTILE
        body = NAMED.format(name=name, hostile=hostile)
        more = f' doc="{hostile}"'
        text = document(body + lit('nodegraph="g"', name, more), f"1.39 {hostile}")
        found = converted(folder, text)
        assert not found.problems, name
        assert len(found.materials) == 1, name
        main = folder / found.main
        assert not burnish.check(main), name
        lines = main.read_text().splitlines()
        assert sum(line.startswith("material ") for line in lines) == 1, name


def test_hostile_files_and_properties_stay_in_their_comments(tmp_path: Path) -> None:
    hostile = HOSTILE
    for text in (
        f'<image name="x" type="color3"><input name="file" type="filename" value="{hostile}.png"/>'
        "</image>",
        f'<geompropvalue name="x" type="color3"><input name="geomprop" type="string" '
        f'value="{hostile}"/></geompropvalue>',
    ):
        found = converted(tmp_path, node(text))
        assert not burnish.check(tmp_path / found.main)
        assert all("\n" not in str(problem) for problem in found.problems)


def test_a_chain_of_5000_nodes(tmp_path: Path) -> None:
    nodes = [ADD.format("n0", RED)]
    nodes += [ADD.format(f"n{place}", f'nodename="n{place - 1}"') for place in range(1, 5000)]
    found = converted(tmp_path, document("\n".join([*nodes, lit('nodename="n4999"')])))
    assert not found.problems
    assert found.files["doc.burnish"].decode().count("+") == 0  # All add nothing to red.


def test_a_chain_without_end_is_told(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("burnish.support.depth.CALLS", 900)
    nodes = [ADD.format("n0", RED)]
    nodes += [ADD.format(f"n{place}", f'nodename="n{place - 1}"') for place in range(1, 300)]
    said = told(tmp_path, document("\n".join([*nodes, lit('nodename="n299"')])))
    assert said == [
        "doc.mtlx:305: m: its nodes depend on each other over more steps than are followed"
    ]


def test_3000_materials_are_too_many(tmp_path: Path) -> None:
    many = "\n".join(lit(name=f"m{place}").replace('"s"', f'"s{place}"') for place in range(3000))
    assert told(tmp_path, document(many)) == [
        "doc.mtlx:1: error: 3000 materials or outputs are drawn, and a file of Burnish has at most "
        "256: divide the document"
    ]
