"""A tessellation that is lowered to instances gives every vertex what the tessellation itself says.

What it says is evaluated directly here, vertex by vertex, with the control points of each patch at
hand.
"""

from __future__ import annotations

import random
from collections.abc import Callable
from math import sin

import pytest

from burnish.compiler.ir.leaves import Attribute, Parameter
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.operations import CROSS
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.stages import (
    CLIP_POSITION,
    EDGE_LEVEL,
    INSTANCES,
    PATCH_INDEX,
    RASTERISED,
    TARGET,
    TESSELLATED_CHAIN,
    VERTICES,
    SystemInput,
)
from burnish.compiler.passes.lower_tessellation import lower_tessellation
from burnish.compiler.reference.evaluate import evaluate
from burnish.compiler.reference.namespace import Lanes

from .kit import elaborated
from .test_lower_expansion import Primitive, attributes, parameter, values_of

SLOTS = """
    param scale  : float in 0..4 = 0.5
    param detail : float in 1..64 = 3
    mark  : float = 0
    tint  : vec2  = vec2(uv.y, uv.x)
    flag  : bool  = uv.x > 0.4
    frame : mat2  = mat2(uv, uv.yx)
    wave  = @vertex sin(4 * uv.x)
"""
COLOR = "color = vec3(mark + wave, tint) + vec3(frame * uv, if flag then 1 else 0)"

MATERIALS = {
    "nothing is set": "tessellate triangle by detail { }",
    "weights": """
        tessellate triangle by detail as at {
            mark = at.y  position = inherited.position + scale * at.x * inherited.normal
        }""",
    "of a quad": """
        tessellate quad by 2 * detail inside vec2(3, detail) as at {
            mark = at.x * (1 - at.y)  uv = inherited.uv + corner[2].uv * at
        }""",
    "control points": """
        tessellate quad of 7 ends [6, 1, 2, 0] by detail as at {
            mark = corner[5].uv.x + corner[3].tint.y
            uv = sum k in 0..7 : corner[k].uv * at.x
        }""",
    "what depends on it follows": """
        tessellate triangle spacing fractional_even by detail as at {
            uv = inherited.uv * at.z  tint = inherited.tint + uv  flag = at.x > 0.5
        }""",
    "the patch's number": """
        tessellate triangle by detail as at { mark = float(patch_index) + at.x }""",
    "numbers of vertices": """
        tessellate triangle by detail as at { mark = float(vertex_index) + 2 * at.x }""",
    "instances": """
        attribute shift : vec2 per instance
        tessellate triangle by detail as at { uv = inherited.uv + shift * at.xy }
        alpha = shift.x + float(instance_index)""",
    "matrices and integers": """
        attribute bend : mat2
        attribute kind : int
        tessellate triangle by detail as at { uv = bend * at.xy  mark = float(kind) }""",
}
Leaf = Callable[[int | None, Node], Lanes | None]


def leaf_of(whole: Shader, place: Primitive) -> Leaf:
    """The values of leaves at a vertex of the mesh, or where there is none."""

    def at(mesh_vertex: int | None, node: Node) -> Lanes | None:
        match node.data:
            case Parameter() as leaf:
                return parameter(whole, leaf)
            case Attribute(name=name, step=step):
                number = place.instance if step == INSTANCES else mesh_vertex
                return place.values[name, number if number is not None else -1]
            case SystemInput(name="instance_index"):
                return (place.instance,)
            case SystemInput(name="vertex_index"):
                return (mesh_vertex,)
            case SystemInput() as row if row == PATCH_INDEX:
                return (place.number,)
        return None

    return at


def directly(whole: Shader, root: Node, place: Primitive, where: Lanes) -> Lanes:
    """The value of a root at a vertex of a patch; crossings into fragments give what crosses."""
    at = leaf_of(whole, place)
    assert whole.tessellation is not None
    coordinate = whole.tessellation.kind.coordinate

    def divided(node: Node) -> Lanes | None:
        if node.data == coordinate:
            return where
        if node.op != "cross":
            return at(None, node)
        if CROSS.data(node).mode != "corner":
            return evaluate(node.operands[0], divided)
        (point,) = evaluate(node.operands[1], divided)
        mesh_vertex = place.vertices[int(point)]
        return evaluate(node.operands[0], lambda inner: at(mesh_vertex, inner))

    return evaluate(root, divided)


def lowered(whole: Shader, root: Node, place: Primitive, where: Lanes) -> Lanes:
    """The value of a root of a lowered shader at one vertex of the draw."""
    meshes = {info.leaf: info.mesh for info in whole.attributes}
    counted = {"patch_index": place.number, "instance_index": place.instance}

    def leaf(node: Node) -> Lanes | None:
        match node.data:
            case Parameter() as found:
                return parameter(whole, found)
            case SystemInput(name="instance_index"):
                return (place.number,)  # Every patch is an instance.
            case Attribute() as read:
                mesh = meshes[read]
                assert mesh is not None
                if mesh.is_of_pattern:
                    return where
                if mesh.corner is None:
                    number = counted.get(mesh.name)
                    return place.values[mesh.name, place.instance] if number is None else (number,)
                point = place.vertices[mesh.corner]
                return (point,) if mesh.is_number else place.values[mesh.name, point]
        return evaluate(node.operands[0], leaf) if node.op == "cross" else None

    return evaluate(root, leaf)


@pytest.mark.parametrize("members", MATERIALS.values(), ids=MATERIALS)
def test_every_vertex_has_what_the_tessellation_says(members: str) -> None:
    (whole,) = elaborated(f"material M {{ {SLOTS} {members} {COLOR} }}")
    patches = whole.tessellation
    assert patches is not None
    assert whole.chain == TESSELLATED_CHAIN
    made = lower_tessellation(whole)
    assert made.chain == RASTERISED
    pattern = [info for info in made.attributes if info.mesh and info.mesh.is_of_pattern]
    assert {info.leaf.step for info in made.attributes} - {INSTANCES} <= {VERTICES}
    assert all(i.leaf.step == INSTANCES for i in made.attributes if i not in pattern)
    dice, count = random.Random(members), 9
    values = values_of(attributes(whole), dice, count)
    before = [whole.results_of(kind)[0].value for kind in (CLIP_POSITION, TARGET)]
    after = [made.results_of(kind)[0].value for kind in (CLIP_POSITION, TARGET)]
    for number in range(4):
        vertices = tuple(dice.randrange(count) for _ in range(patches.points))
        place = Primitive(number, number // 2, vertices, values)
        u, v = dice.random(), dice.random()
        where = (u, (1 - u) * v, (1 - u) * (1 - v)) if patches.patch == "triangle" else (u, v)
        for old, new in zip(before, after, strict=True):
            wanted = directly(whole, old, place, where)
            assert lowered(made, new, place, where) == pytest.approx(wanted)


def test_what_is_not_set_is_mixed_and_equations_follow() -> None:
    """A slot of the fragments is computed from mixed inputs, as if nothing were divided."""
    (whole,) = elaborated("material M { tessellate triangle by 4 { } color = vec3(sin(uv), 0) }")
    (color,) = whole.results_of(TARGET)
    values = values_of(attributes(whole), random.Random(1), 3)
    place, where = Primitive(0, 0, (0, 1, 2), values), (0.5, 0.25, 0.25)
    mixed = evaluate_mixed([values["vertex_uv", k] for k in range(3)], where)
    wanted = (*map(sin, mixed), 0.0, 1.0)
    assert directly(whole, color.value, place, where) == pytest.approx(wanted)


def evaluate_mixed(ends: list[Lanes], weights: Lanes) -> list[float]:
    """The weighted mean of vectors."""
    return [
        sum(weight * float(lane) for weight, lane in zip(weights, lanes, strict=True))
        for lanes in zip(*ends, strict=True)
    ]


@pytest.mark.parametrize(("lines", "count"), [("1", 2 * 5), ("3", 2 * 3 * 5)])
def test_lines_whose_levels_differ_have_as_many_vertices_as_they_can(
    lines: str, count: int
) -> None:
    (whole,) = elaborated(
        f"material M {{ tessellate isoline by clamp(8 * end[0].uv.x, 1, 5) lines {lines} {{ }} }}"
    )
    made = lower_tessellation(whole)
    assert (made.chain, made.listed) == (RASTERISED, count)


def test_lines_that_a_host_divides_read_where_they_lie() -> None:
    (whole,) = elaborated("material M { tessellate isoline by 4 { } }")
    made = lower_tessellation(whole)
    assert (made.chain, made.listed) == (RASTERISED, 0)
    assert [i.declared_type for i in made.attributes if i.mesh and i.mesh.is_of_pattern] == ["vec2"]


@pytest.mark.parametrize(("most", "count"), [("1", 3), ("2", 3 * 6), ("5", 3 * 37)])
def test_patches_whose_levels_differ_have_as_many_vertices_as_they_can(
    most: str, count: int
) -> None:
    """Two steps divide a triangle into six parts; five into three rings and the one inside."""
    (whole,) = elaborated(
        f"material M {{ tessellate triangle by clamp(8 * end[0].uv.x, 1, {most}) {{ }} }}"
    )
    made = lower_tessellation(whole)
    assert made.chain == RASTERISED
    assert (made.listed, made.levels) == (count, ())
    assert not any(info.mesh and info.mesh.is_of_pattern for info in made.attributes)


def test_the_larger_of_both_ways_along_an_edge_counts() -> None:
    """The ends of an edge have no order, so that both patches beside it divide it alike."""
    (whole,) = elaborated(
        "material M { tessellate triangle by 1 + 2 * end[0].uv.x + end[1].uv.y { } }"
    )
    values = {("vertex_uv", 0): (1.0, 8.0), ("vertex_uv", 1): (4.0, 2.0), ("vertex_uv", 2): (0, 0)}
    levels = [result.value for result in whole.results_of(EDGE_LEVEL)]
    one, other = (
        [at_patch(whole, level, Primitive(0, 0, order, values)) for level in levels]
        for order in ((0, 1, 2), (1, 0, 2))
    )
    # Between 0 and 1: 1 + 2 * 1 + 2 = 5 one way, and 1 + 2 * 4 + 8 = 17 the other.
    assert (one[2], other[2]) == (17, 17)
    assert (one[0], one[1]) == (other[1], other[0])


def at_patch(whole: Shader, root: Node, place: Primitive) -> float:
    """A level of a patch."""
    at = leaf_of(whole, place)

    def leaf(node: Node) -> Lanes | None:
        if node.op != "cross":
            return at(None, node)
        (point,) = evaluate(node.operands[1], leaf)
        mesh_vertex = place.vertices[int(point)]
        return evaluate(node.operands[0], lambda inner: at(mesh_vertex, inner))

    (level,) = evaluate(root, leaf)
    return float(level)
