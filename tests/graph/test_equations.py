"""Graphs of the equations of materials: each piece that an author wrote once, and what it reads."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest

import burnish
from burnish.api.entry_points import declared, equations
from burnish.commands.graph import dot, svg, text
from burnish.commands.graph.equations import equations_picture
from burnish.commands.graph.model import Picture
from burnish.compiler.semantics.equations.model import EquationNode, Equations
from tests.golden import assert_golden

EXAMPLES = Path(__file__).parents[2] / "examples"
GOLDEN = Path(__file__).parent / "golden"
OWN = {"parameter", "texture", "buffer", "attribute", "equation"}
FILES = [*sorted(EXAMPLES.glob("*.burnish")), *sorted(EXAMPLES.glob("tutorial/*.burnish"))]


def of_example(file: Path) -> Iterator[Equations]:
    """The graphs of all materials of an example, under its first rig and the usual pass."""
    names = declared(file)
    for material in names.materials:
        try:
            yield from equations(file, material=material, rig=next(iter(names.rigs), None))
        except burnish.CompileError as error:
            # A material for passes of its own, which frames draw.
            assert names.frames or names.passes, error


@cache
def graphs() -> list[tuple[str, Equations]]:
    """The graphs of all examples, each with the text of its file."""
    return [(file.read_text("utf-8"), graph) for file in FILES for graph in of_example(file)]


def of_text(source: str, name: str | None = None) -> dict[str, EquationNode]:
    """The nodes of a material of a text, by their names."""
    (graph,) = equations(source, material=name)
    return {node.name: node for node in graph.nodes}


def rows(node: EquationNode) -> list[str]:
    """The rows of a node in words."""
    return [f"{row.label} {row.words}".strip() for row in node.rows]


@pytest.mark.parametrize("name", ["plastic", "principled", "gold"])
def test_graphs_as_text(name: str) -> None:
    source = (EXAMPLES / f"{name}.burnish").read_text("utf-8")
    found = equations(source, search_path=[EXAMPLES])
    written = "\n".join(text.written(equations_picture(graph)) for graph in found)
    assert_golden(written, GOLDEN / f"{name}_equations.txt")


def test_every_example_has_graphs() -> None:
    assert len(graphs()) > 140
    assert {graph.name for _source, graph in graphs()} >= {"Plastic", "Bricks", "Lacquer", "Gold"}


def test_each_declaration_of_a_material_is_one_node() -> None:
    for source, graph in graphs():
        body = re.search(rf"^material {graph.name}\b[^{{]*\{{\n(.*?)^\}}", source, re.M | re.S)
        if body is None:
            continue  # It is written on one line.
        lines = re.findall(r"^    (?:param |map |buffer |attribute )?(\w+) *[:=]", body[1], re.M)
        shown = Counter(node.name for node in graph.nodes)
        own = Counter(node.name for node in graph.nodes if node.kind in OWN and node.span)
        assert max(shown.values()) == 1, graph.name
        assert set(lines) <= set(own), (graph.name, set(lines) - set(own))


def test_rows_read_nodes_that_stand_before_them() -> None:
    for _source, graph in graphs():
        before: dict[str, EquationNode] = {}
        for node in graph.nodes:
            for row in node.rows:
                if row.source:
                    assert before[row.source].name in row.words, (graph.name, node.name)
            before[node.key] = node
        assert len(before) == len(graph.nodes)


def test_each_parameter_that_an_equation_names_has_an_arrow() -> None:
    """A parameter of the material is read by a row, unless only its declaration names it."""
    for source, graph in graphs():
        read = {row.source for node in graph.nodes for row in node.rows}
        body = re.search(rf"^material {graph.name}\b[^{{]*\{{\n(.*?)^\}}", source, re.M | re.S)
        for node in graph.nodes:
            if body is not None and node.kind in ("parameter", "texture", "buffer"):
                uses = re.findall(rf"^[^/\n]*\b{node.name}\b", re.sub("//.*", "", body[1]), re.M)
                assert node.key in read or len(uses) < 2, (graph.name, node.name)


def test_everything_leads_to_the_pass_in_plastic() -> None:
    (graph,) = equations(EXAMPLES / "plastic.burnish")
    reached = {graph.nodes[-1].key}
    for node in reversed(graph.nodes):
        if node.key in reached:
            reached.update(row.source for row in node.rows)
    assert {node.key for node in graph.nodes} <= reached


def test_constants_and_signs_stand_in_the_rows_that_read_them() -> None:
    nodes = of_text("""material M {
        param gain : float = 2
        curve = 1 - gain * -uv.x / 3
        color = mix(#ff0000, vec3(0.5), curve)
    }""")
    assert rows(nodes["multiply"]) == ["× gain", "× -uv.x", "÷ 3"]
    assert rows(nodes["curve"]) == ["+ 1", "− multiply"]
    assert rows(nodes["color"]) == ["x #ff0000", "y vec3(0.5)", "z curve"]


def test_an_equation_of_constants_is_one_box_with_its_text() -> None:
    nodes = of_text("material M { half = 1.0 / 2  color = vec3(half) }")
    assert (nodes["half"].text, nodes["half"].rows) == ("1.0 / 2", ())


def test_rows_of_texture_reads_are_called_as_the_kind_of_texture_has_them() -> None:
    nodes = of_text("""material M {
        map sheets : texture2d_array
        map lamps  : depth_cube_array
        shown = sheets(uv, 3)
        far   = sheets.level(uv, 3, 2)
        texel = sheets.load(ivec2(uv), 3, 0)
        sharp = lamps(normal, 1, 0.5)
        color = shown.rgb + far.rgb + texel.rgb + vec3(sharp)
    }""")
    assert rows(nodes["shown"]) == ["map sheets", "coordinate uv", "layer 3"]
    assert rows(nodes["far"]) == ["map sheets", "coordinate uv", "layer 3", "level 2"]
    assert rows(nodes["texel"]) == ["map sheets", "place ivec2", "layer 3", "level 0"]
    assert rows(nodes["sharp"]) == ["map lamps", "coordinate normal", "layer 1", "reference 0.5"]


def test_arguments_stand_in_rows_by_their_names() -> None:
    nodes = of_text("""
        fn ring(p: vec2, radius: float = 1, width: float = 0.1) -> float = radius + width * p.x
        struct Layer { tint : rgb  weight : float }
        term bent(k: rgb, n: vec3 = normal) = k * n.z
        material M {
            map wood : texture2d
            normal = normalize(vec3(uv, 1))
            edge  = ring(uv, width = 0.5)
            layer = Layer(weight = edge, tint = #fff)
            read  = wood.level(level = 2, coordinate = uv)
            first = bent(read.rgb)
            other = bent(n = position, k = layer.tint)
            color = first + other
        }""")
    assert rows(nodes["edge"]) == ["p uv", "width 0.5"]
    assert rows(nodes["layer"]) == ["weight edge", "tint #fff"]
    assert rows(nodes["read"]) == ["map wood", "level 2", "coordinate uv"]
    assert rows(nodes["first"]) == ["k read.rgb", "normal normal"]
    assert rows(nodes["other"]) == ["n position", "k layer.tint"]


def test_lanes_of_a_vector_have_names_if_each_is_written() -> None:
    nodes = of_text("""material M {
        apart   = vec3(uv.x, 0, 1)
        mixed   = vec3(uv, 1)
        columns = mat2(uv, uv.yx)
        color   = apart + mixed + vec3(columns[0], 1)
    }""")
    assert rows(nodes["apart"]) == ["x uv.x", "y 0", "z 1"]
    assert rows(nodes["mixed"]) == ["uv", "1"]
    assert rows(nodes["columns"]) == ["0 uv", "1 uv.yx"]


def test_slots_that_functions_read_by_themselves_have_rows_if_the_material_sets_them() -> None:
    source = """
        import std.terms.{lambert}
        material Flat { color = lambert(#fff) }
        material Bumpy { normal = normalize(vec3(uv, 1))  color = lambert(#fff) }
    """
    assert rows(of_text(source, "Flat")["color"]) == ["k #fff", "each light Daylight"]
    bumpy = of_text(source, "Bumpy")["color"]
    assert rows(bumpy) == ["k #fff", "normal normal", "each light Daylight"]


def test_slots_that_with_replaces_are_read_from_their_new_values() -> None:
    nodes = of_text("""
        import std.terms.{lambert}
        material M {
            normal = normalize(vec3(uv, 1))
            other  = normalize(vec3(uv, 2))
            color  = lambert(#fff) with { normal = other }
        }
    """)
    assert rows(nodes["color"]) == ["k #fff", "normal other", "each light Daylight"]


def test_a_base_is_folded_with_what_the_material_sets_and_what_it_could_set() -> None:
    nodes = of_text("""
        material Base {
            param gain : float = 2
            base  = #102030
            inner = base * gain
            color = inner * inner
        }
        material Derived : Base { base = inherited.base * 0.5 }
    """, "Derived")  # fmt: skip
    assert {name for name, node in nodes.items() if node.kind == "equation"} == {"base"}
    assert rows(nodes["base"]) == ["× inherited.base", "× 0.5"]
    assert (nodes["color"].note, rows(nodes["color"])) == ("of Base", ["gain 2", "base base"])


def test_loops_are_one_box_with_their_text() -> None:
    nodes = of_text("""material M {
        param steps : int in 1..8 = 3
        total = sum i in 0..steps up to 8 : uv.x * float(i)
        color = vec3(total)
    }""")
    assert nodes["total"].text == "sum i in 0..steps up to 8 : uv.x * float(i)"
    assert rows(nodes["total"]) == ["uv", "steps"]


def test_deep_and_wide_expressions_need_no_recursion() -> None:
    deep = "abs(" * 150 + "uv.x" + ")" * 150
    wide = " + ".join(["uv.x"] * 3000)
    nodes = of_text(f"material M {{ deep = {deep}  wide = {wide}  color = vec3(deep + wide) }}")
    assert len(nodes["wide"].rows) == 3000
    assert sum(node.note == "abs" or node.name.startswith("abs") for node in nodes.values()) == 150


def picture(name: str) -> Picture:
    (graph,) = equations(EXAMPLES / f"{name}.burnish")
    return equations_picture(graph)


@pytest.mark.parametrize("name", ["plastic", "principled", "clear_coat"])
def test_arrows_end_at_rows_in_pictures_and_graphviz_has_all_of_them(name: str) -> None:
    found = picture(name)
    boxes = {box.key: box for box in found.boxes}
    for arrow in found.arrows:
        assert arrow.source in boxes
        assert arrow.row is not None and boxes[arrow.target].inputs[arrow.row].is_read
    drawn = svg.drawn(found)
    assert drawn.count('r="3"') == sum(len(box.inputs) for box in found.boxes)
    assert dot.written(found).count(" -> ") == len(found.arrows)
