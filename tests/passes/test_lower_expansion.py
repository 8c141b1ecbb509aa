"""An expansion that is lowered to instances gives every vertex what the expansion itself says.

What it says is evaluated directly here: strip by strip, vertex by vertex, with the corners of each
primitive at hand.
"""

from __future__ import annotations

import random
from collections.abc import Iterator, Mapping
from dataclasses import dataclass

import pytest

from burnish.compiler.ir.expansion import EmittedStrips
from burnish.compiler.ir.leaves import Attribute, Parameter
from burnish.compiler.ir.node import Node, reachable
from burnish.compiler.ir.operations import CROSS
from burnish.compiler.ir.primitives import CORNERS
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.stages import (
    CLIP_POSITION,
    EMITTED,
    EMITTING,
    GROUP,
    INSTANCES,
    PRIMITIVE_INDEX,
    RASTERISED,
    STRIP,
    STRIP_VERTEX,
    TARGET,
    VERTICES,
    SystemInput,
)
from burnish.compiler.ir.types import scalar_kind, width
from burnish.compiler.passes.corner_inputs import NOWHERE
from burnish.compiler.passes.lower_expansion import lower_expansion
from burnish.compiler.reference.evaluate import evaluate
from burnish.compiler.reference.namespace import Lanes

from .kit import elaborated

SLOTS = """
    param scale : float in 0..4 = 0.5
    param count : int in 0..3 = 2
    mark  : float = 0
    tint  : vec2  = vec2(uv.y, uv.x)
    flag  : bool  = uv.x > 0.4
    frame : mat2  = mat2(uv, uv.yx)
    bias  = 0.25
"""
COLOR = "color = vec3(mark + bias, tint) + vec3(frame * uv, if flag then 1 else 0)"

MATERIALS = {
    "a strip of each point": """
        expand point { strip of 4 as i {
            mark = float(i)  position = corner[0].position + scale * vec3(float(i), 0, 1)
        } }""",
    "longer strips": """
        expand point { strip of 7 as i { mark = float(i)  uv = corner[0].uv * float(i) } }""",
    "a list": """
        expand triangle { list of 6 as i like corner[i mod 3] { mark = float(i / 3) } }""",
    "several strips": """
        expand triangle { strip of 3 as i for s in 1..4 {
            mark = float(s)  position = corner[i].position + float(s) * corner[i].normal
        } }""",
    "as many as a parameter says": """
        expand triangle { strip of 5 as i for s in 0..count like corner[i mod 3] {
            tint = corner[0].tint + corner[1].uv * float(s)
        } }""",
    "where a condition holds": """
        expand line { strip of 4 as i for s in 0..3 where corner[s mod 2].uv.x > 0.4
            like corner[i / 2] { mark = corner[i].uv.y } }""",
    "several groups": """
        expand triangle {
            strip of 3 as i { mark = 1  flag = not corner[i].flag }
            list of 3 as i where corner[2].uv.y < 0.6 like corner[2 - i] { bias = 2 }
            strip of 4 as i for s in 0..2 like corner[s] { tint = vec2(float(i), float(s)) }
        }""",
    "adjacency": """
        expand triangle_adjacency { strip of 4 as i for s in 0..3 like corner[2 * s] {
            position = corner[2 * s + i mod 2].position + corner[(2 * s + 5) mod 6].normal
        } }""",
    "a line between others": """
        expand line_adjacency { strip of 4 as i { mark = corner[3].uv.x - corner[i].uv.y } }""",
    "what it is otherwise": """
        expand triangle { strip of 3 as i {
            position = inherited.position * 2  uv = position.xy
        } }""",
    "sums over corners": """
        expand triangle { strip of 3 as i {
            mark = sum k in 0..3 : corner[k].uv.x  frame = 2 * corner[1].frame
        } }""",
    "numbers": """
        expand triangle { strip of 3 as i for s in 0..2 where primitive_index mod 2 == 0u {
            mark = float(primitive_index) + 0.01 * float(vertex_index)
            bias = 0.5 * float(corner[2 - i].number) + float(instance_index)
        } }
        number = vertex_index""",
    "an input per instance": """
        attribute shift : vec2 per instance
        expand point { strip of 3 as i {
            uv = corner[0].uv + shift  mark = float(primitive_index)
        } }
        place = shift""",
}


@dataclass(frozen=True)
class Primitive:
    """One primitive of one instance of a mesh."""

    number: int
    instance: int
    vertices: tuple[int, ...]
    values: Mapping[tuple[str, int], Lanes]
    """The values of the mesh's inputs, by name and by the number of the vertex or instance."""


def values_of(
    leaves: list[Attribute], dice: random.Random, vertices: int
) -> dict[tuple[str, int], Lanes]:
    """A value of each input for each vertex, and for two instances."""
    found: dict[tuple[str, int], Lanes] = {}
    for leaf in leaves:
        for number in range(vertices if leaf.step == VERTICES else 2):
            whole = scalar_kind(leaf.type) != "float"
            lanes = [dice.randrange(9) if whole else dice.random() for _ in range(width(leaf.type))]
            found[leaf.name, number] = tuple(lanes)
    return found


def attributes(whole: Shader) -> list[Attribute]:
    """The vertex inputs that a shader reads."""
    return [node.data for node in whole.roots.nodes if isinstance(node.data, Attribute)]


def parameter(whole: Shader, leaf: Parameter) -> Lanes:
    """The default of a parameter."""
    default = next(i.default for i in whole.parameters if i.leaf == leaf)
    return default if isinstance(default, tuple) else (default,)


def directly(
    whole: Shader, root: Node, place: Primitive, group: int, strip: int, vertex: int
) -> Lanes:
    """The value of a root at an emitted vertex; crossings into fragments give what crosses."""
    numbers = {
        GROUP.name: group, STRIP.name: strip, STRIP_VERTEX.name: vertex,
        PRIMITIVE_INDEX.name: place.number,
    }  # fmt: skip

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
            case SystemInput(domain=domain) as row if domain == EMITTED:
                return (numbers[row.name],)
        return None

    def emitted(node: Node) -> Lanes | None:
        if node.op != "cross":
            return at(None, node)
        if CROSS.data(node).mode != "corner":
            return evaluate(node.operands[0], emitted)
        (corner,) = evaluate(node.operands[1], emitted)
        mesh_vertex = place.vertices[int(corner)]
        return evaluate(node.operands[0], lambda inner: at(mesh_vertex, inner))

    return evaluate(root, emitted)


def lowered(whole: Shader, root: Node, place: Primitive, vertex: int, instance: int) -> Lanes:
    """The value of a root of a lowered shader at one vertex of the draw."""
    meshes = {info.leaf: info.mesh for info in whole.attributes}
    counted = {
        "primitive_index": place.number, "instance_index": place.instance,
    }  # fmt: skip

    def leaf(node: Node) -> Lanes | None:
        match node.data:
            case Parameter() as found:
                return parameter(whole, found)
            case SystemInput(name=name):
                return ({"vertex_index": vertex, "instance_index": instance}[name],)
            case Attribute() as read:
                mesh = meshes[read]
                assert mesh is not None
                if mesh.corner is None:
                    number = counted.get(mesh.name)
                    return place.values[mesh.name, place.instance] if number is None else (number,)
                corner = place.vertices[mesh.corner]
                return (corner,) if mesh.is_number else place.values[mesh.name, corner]
        return evaluate(node.operands[0], leaf) if node.op == "cross" else None

    return evaluate(root, leaf)


def strip_vertices(group: EmittedStrips) -> Iterator[tuple[int, int]]:
    """The strips and vertices of a group, triangle by triangle, as Vulkan assembles them."""
    for strip in range(group.strips):
        for triangle in range(group.primitives):
            if group.shape == "list":
                yield from ((strip, 3 * triangle + corner) for corner in range(3))
            elif triangle % 2 == 0:
                yield from ((strip, triangle + corner) for corner in range(3))
            else:
                yield from ((strip, triangle + corner) for corner in (0, 2, 1))


@pytest.mark.parametrize("members", MATERIALS.values(), ids=MATERIALS)
def test_every_vertex_has_what_the_expansion_says(members: str) -> None:
    (whole,) = elaborated(f"material M {{ {SLOTS} {members} {COLOR} }}")
    expansion = whole.expansion
    assert expansion is not None
    made = lower_expansion(whole)
    assert made.chain == RASTERISED
    assert {info.leaf.step for info in made.attributes} <= {INSTANCES}
    dice, corners, count = random.Random(members), CORNERS[expansion.primitive], 9
    values = values_of(attributes(whole), dice, count)
    told = [result.value for result in whole.results_of(EMITTING)]
    before = [whole.results_of(kind)[0].value for kind in (CLIP_POSITION, TARGET)]
    after = [made.results_of(kind)[0].value for kind in (CLIP_POSITION, TARGET)]
    seen = 0
    for number in range(4):
        vertices = tuple(dice.randrange(count) for _ in range(corners))
        place = Primitive(number % 2, number // 2, vertices, values)
        drawn = [
            (group, *each)
            for group, strips in enumerate(expansion.groups)
            for each in strip_vertices(strips)
        ]
        assert len(drawn) == expansion.listed
        for vertex, (group, strip, of_strip) in enumerate(drawn):
            position, color = (lowered(made, root, place, vertex, number) for root in after)
            if not directly(whole, told[group], place, group, strip, 0)[0]:
                assert position == NOWHERE
                continue
            wanted = [directly(whole, root, place, group, strip, of_strip) for root in before]
            assert position == pytest.approx(wanted[0])
            assert color == pytest.approx(wanted[1])
            seen += 1
    assert seen > 0


def test_nothing_is_lowered_where_nothing_is_expanded() -> None:
    (whole,) = elaborated("material M { }")
    assert lower_expansion(whole) is whole


def test_only_corners_that_are_read_are_inputs() -> None:
    equations = "uv = corner[1].uv  position = corner[2].position"
    text = (
        f"material M {{ expand triangle {{ strip of 3 {{ {equations} }} }} color = vec3(uv, 0) }}"
    )
    (whole,) = elaborated(text)
    made = lower_expansion(whole)
    assert [info.leaf.name for info in made.attributes] == [
        "corner2.vertex_position",
        "corner1.vertex_uv",
    ]
    assert not any(node.op == "array" for node in reachable(made.roots))
