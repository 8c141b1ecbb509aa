"""Graphs of the examples: what is shown, and that pictures are well made."""

from __future__ import annotations

import re
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from pathlib import Path

import pytest

import burnish
from burnish.commands.graph import dot, svg, text
from burnish.commands.graph.kinds import ArrowKind, Kind
from burnish.commands.graph.model import Picture
from burnish.commands.graph.program import program_picture
from tests.golden import assert_golden

EXAMPLES = Path(__file__).parents[2] / "examples"
SHOWN = ("plastic", "normal_map", "clear_coat", "lights", "palette", "cutout", "marble")
GOLDEN = Path(__file__).parent / "golden"
SVG = "{http://www.w3.org/2000/svg}"


def pictures(name: str, *, everything: bool = False) -> Iterator[Picture]:
    """The pictures of all materials of an example, which is named by its file."""
    source = (EXAMPLES / f"{name}.burnish").read_text("utf-8")
    for material in burnish.compile(source, (), search_path=[EXAMPLES]):
        yield program_picture(material.shader, material.staged, everything=everything)


@pytest.mark.parametrize("name", ["plastic", "normal_map"])
def test_graphs_as_text(name: str) -> None:
    assert_golden("\n".join(map(text.written, pictures(name))), GOLDEN / f"{name}.txt")


@pytest.mark.parametrize("everything", [False, True], ids=["named", "all"])
@pytest.mark.parametrize("name", SHOWN)
def test_arrows_join_boxes_that_there_are(name: str, everything: bool) -> None:
    for found in pictures(name, everything=everything):
        keys = [box.key for box in found.boxes]
        assert len(keys) == len(set(keys))
        assert len(found.arrows) == len(set(found.arrows))
        homes = {box.key: cluster.title for cluster in found.clusters for box in cluster.boxes}
        for arrow in found.arrows:
            is_inner = homes[arrow.source] == homes[arrow.target]
            assert is_inner == (arrow.kind is ArrowKind.USE)


@pytest.mark.parametrize("native_stages", [False, True])
def test_a_stage_that_hands_a_value_on_has_no_box_for_it(native_stages: bool) -> None:
    """The arrow comes from the stage that has one, as through the control stage of a patch."""
    source = """
        import std.tessellation.{Displaced}
        material Handed : Surface + Displaced {
            fineness = 2
            displacement = 0.1 * uv.y
            color = rgb(uv.x)
        }
    """
    (material,) = burnish.compile(source, (), native_stages=native_stages)
    found = program_picture(material.shader, material.staged, everything=False)
    keys = {box.key for box in found.boxes}
    assert all({arrow.source, arrow.target} <= keys for arrow in found.arrows)
    assert any(arrow.kind is ArrowKind.CROSSING for arrow in found.arrows)


@pytest.mark.parametrize("name", SHOWN)
def test_whatever_is_computed_has_a_formula_and_a_use(name: str) -> None:
    for found in pictures(name):
        read = {arrow.source for arrow in found.arrows}
        for box in found.boxes:
            results = {Kind.RESULT, Kind.DERIVED, Kind.CROSSING}
            assert box.key in read or box.kind in results, box
            assert box.formula or box.kind is not Kind.VALUE, box


@pytest.mark.parametrize("name", SHOWN)
def test_pictures_are_well_formed_and_letters_fit_their_boxes(name: str) -> None:
    for found in pictures(name):
        root = ET.fromstring(svg.drawn(found))
        width, height = float(root.attrib["width"]), float(root.attrib["height"])
        for group in root.iter(f"{SVG}g"):
            box = group.find(f"{SVG}rect")
            if group.find(f"{SVG}title") is None or box is None:
                continue
            left, right = (float(box.attrib["x"]), float(box.attrib["width"]))
            assert left + right < width
            assert float(box.attrib["y"]) + float(box.attrib["height"]) < height
            for line in group.iter(f"{SVG}text"):
                letters = len(line.text or "") * float(line.attrib["font-size"]) * 0.61
                assert float(line.attrib["x"]) + letters < left + right


def test_a_picture_is_the_same_every_time() -> None:
    assert list(map(svg.drawn, pictures("plastic"))) == list(map(svg.drawn, pictures("plastic")))


def test_the_legend_names_the_kinds_that_are_shown() -> None:
    (found,) = pictures("plastic")
    drawn = svg.drawn(found)
    assert "parameter of the rig" in drawn
    assert "a guard stays" in drawn
    assert ">supplied by the pipeline<" not in drawn


@pytest.mark.parametrize("name", SHOWN)
def test_graphviz_texts_are_balanced_and_quoted(name: str) -> None:
    for found in pictures(name):
        written = dot.written(found)
        bare = re.sub(r'"(?:[^"\\]|\\.)*"', "", written)
        assert '"' not in bare
        assert bare.count("{") == bare.count("}") == len(found.clusters) + 1
        assert written.count(" -> ") >= len(found.arrows)


def test_guards_are_marked_where_they_are() -> None:
    source = """material M {
        careful = 1 / uv.x
        safe    = 1 / (1 + uv.x * uv.x)
        color   = vec3(careful, safe, careful * safe)
    }"""
    (material,) = burnish.compile(source, ())
    found = program_picture(material.shader, material.staged, everything=False)
    assert {box.name for box in found.boxes if box.guarded} == {"careful"}
    assert {"careful", "safe"} <= {box.name for box in found.boxes}
