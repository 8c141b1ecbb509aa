"""The reflection says what there is, in the form that its records declare."""

from __future__ import annotations

import json
import os
from pathlib import Path

import pytest

import burnish
from burnish.compiler.documents.reading import read
from burnish.compiler.documents.reflection import Reflection
from burnish.compiler.documents.writing import to_json
from burnish.compiler.ir.build import constant
from burnish.compiler.ir.leaves import Attribute
from burnish.compiler.ir.node import Folding, Graph, Node
from burnish.compiler.ir.types import FLOAT, INT
from burnish.compiler.reflection import reflect
from burnish.compiler.reflection.values import steps

from .lit import BACKENDS, PARAMETERS, PROGRAM, SHADER, derived_values

GOLDEN = Path(__file__).parent / "golden" / "lit.json"


@pytest.fixture
def reflection() -> Reflection:
    return reflect(SHADER, PROGRAM, BACKENDS, derived_values())


def test_the_reflection_is_the_expected_one(reflection: Reflection) -> None:
    """``BURNISH_UPDATE_GOLDEN=1`` writes the file anew; the difference is then there to be read."""
    text = json.dumps(to_json(reflection), indent=2, ensure_ascii=False) + "\n"
    if os.environ.get("BURNISH_UPDATE_GOLDEN"):
        GOLDEN.write_text(text, encoding="utf-8")
    assert text == GOLDEN.read_text(encoding="utf-8")


def test_the_reflection_comes_back_from_json(reflection: Reflection) -> None:
    assert read(Reflection, json.loads(json.dumps(to_json(reflection)))) == reflection


def test_a_light_array_tells_its_members_and_its_count(reflection: Reflection) -> None:
    rows = {row.name: row for row in reflection.parameters}
    lamps = rows["lamps"]
    assert lamps.count == "lamps.count"
    assert to_json(lamps.layout) == {"stored": "Point[8]", "count": 8, "stride": 32}
    assert [(m.name, m.offset) for m in lamps.members] == [
        ("place", 0),
        ("reach", 12),
        ("on", 16),
    ]
    assert to_json(reflection.lights) == [
        {
            "name": "torch",
            "entry": "torch",
            "kind": "Spot",
            "library": "std.lights.Spot",
            "doc": "Over the table.",
            "capacity": None,
            "count": None,
            "parameters": ["torch.axis", "torch.outer"],
        },
        {
            "name": "lamps",
            "entry": "lamps",
            "kind": "Lamp",
            "library": None,
            "doc": "",
            "capacity": 8,
            "count": "lamps.count",
            "parameters": ["lamps"],
        },
    ]


def test_a_parameter_that_nothing_reads_has_no_place(reflection: Reflection) -> None:
    rows = {row.name: row for row in reflection.parameters}
    assert list(rows) == [info.leaf.name for info in PARAMETERS]
    assert (rows["time"].block, rows["time"].offset) == (None, None)


def test_shared_operands_of_a_derived_value_are_one_step() -> None:
    graph = Graph()
    value = constant(graph, FLOAT, 2.0)
    for _ in range(200):
        value = graph.node("call", FLOAT, (value, value), "mul")
    found = steps(value)
    assert len(found) == 201
    assert to_json(found[-1]) == {
        "op": "call",
        "type": "float",
        "function": "mul",
        "args": [199, 199],
    }


def test_equal_values_have_equal_steps_whatever_was_made_before() -> None:
    def value(graph: Graph, *, right_first: bool) -> Node:
        numbers = (3.0, 2.0) if right_first else (2.0, 3.0)
        made = {number: constant(graph, FLOAT, number) for number in numbers}
        product = graph.node("call", FLOAT, (made[2.0], made[3.0]), "mul")
        return graph.node("call", FLOAT, (product, made[2.0]), "sub")

    assert steps(value(Graph(), right_first=True)) == steps(value(Graph(), right_first=False))


def test_equal_blocks_of_derived_values_are_shared() -> None:
    source = """
        import std.terms.{lambert}
        material One { color = lambert(#808080) }
        material Two { first = inverse(object_to_world)[0].xyz color = first.x * lambert(#808080) }
        material Three { color = lambert(#808080) * determinant(object_to_world) }
    """
    found = burnish.compile(source, ("wgsl",))
    normals = [
        [row.steps for row in each.reflection.derived if row.role == "normal_matrix"]
        for each in found
    ]
    assert len(normals[0]) == 1
    assert normals[1:] == normals[:1] * 2


def test_a_fold_can_be_derived() -> None:
    graph = Graph()
    count, start = constant(graph, INT, 3), constant(graph, INT, 0)
    turn = graph.node("bound", INT, (), 0)
    total = graph.node("fold", INT, (count, start, turn), Folding("add", 4))
    assert to_json(steps(total)[-2:]) == [
        {"op": "bound", "type": "int", "binder": 0, "args": []},
        {"op": "fold", "type": "int", "operator": "add", "bound": 4, "args": [0, 1, 2]},
    ]


def test_what_only_a_shader_knows_cannot_be_derived() -> None:
    node = Graph().node("attribute", FLOAT, (), Attribute("weight", FLOAT))
    with pytest.raises(ValueError, match="cannot compute attribute"):
        steps(node)


def test_members_of_structures_have_the_types_that_were_written() -> None:
    source = (
        "struct Lamp { place : point<world> aim : direction<world> glow : float[2] }\n"
        "material Lit { param lamps : Lamp[2] color = lamps[1].aim * 0.5 + 0.5 }\n"
    )
    found = burnish.compile(source, ("wgsl",))["Lit"].reflection.parameters
    (lamps,) = [row for row in found if row.name == "lamps"]
    written = [(member.type, member.representation) for member in lamps.members]
    assert written == [
        ("point<world>", "vec3"), ("direction<world>", "vec3"), ("float[2]", "float[2]")
    ]  # fmt: skip


def test_lights_have_parameters_of_any_group() -> None:
    (material,) = burnish.compile(
        """
        import std.terms.{lambert}
        import std.lights.{Point}
        light Lamp : Point {
            param pulse : float in 0..1 per frame = 1
            param near  : float in 0..1 per draw = 1
            falloff = if position.x < 0 then pulse else near
        }
        light Glow : Light {
            param aim : direction<world> per view
            to_light = -aim
            diffuse_color = vec3(1)
            specular_color = vec3(1)
        }
        material Lit { color = lambert(vec3(1)) }
        rig Hall { lamp : Lamp  glow : Glow }
        """,
        ("wgsl",),
    )
    rows = {row.name: row.parameters for row in material.reflection.lights}
    blocks = {row.name: row.block for row in material.reflection.parameters}
    assert rows["glow"] == ("glow.aim",)
    assert {name: blocks[name] for name in rows["lamp"]} == {
        "lamp.diffuse_color": "Rig",
        "lamp.specular_color": "Rig",
        "lamp.place": "Rig",
        "lamp.pulse": "Frame",
        "lamp.near": "Draw",
    }
    instance = material.instance()
    instance.rig.lamp = {"place": (0, 1, 0), "pulse": 0.5}
    assert (instance.get("lamp.pulse"), instance.lamp.near) == (0.5, 1.0)


def test_only_lights_are_listed_as_lights() -> None:
    """Structures per rig and members of a host's block have parts, too, but do not shine."""
    (material,) = burnish.compile(
        """
        import std.terms.{lambert}
        import std.lights.{Point}
        extern block Host per rig at group 1, binding 9 { tone : vec3 at 0 }
        struct Glow { tint : rgb, size : float }
        material Lit {
            param glow : Glow per rig
            color = lambert(glow.tint * glow.size) * tone
        }
        rig Hall { lamp : Point  more : Point[<= 2] }
        """,
        ("wgsl",),
    )
    assert [row.name for row in material.reflection.lights] == ["lamp", "more"]
