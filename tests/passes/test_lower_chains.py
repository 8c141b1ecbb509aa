"""Divided patches whose parts are expanded, lowered to instances: every vertex of the draw has what
the tessellation and the expansion say together.

What they say is evaluated directly here: at each emitted vertex, with the corners of the part of
the patch at hand, and at these, with the control points of the patch.
"""

from __future__ import annotations

import random
from collections.abc import Sequence

import pytest

from burnish.compiler.ir.leaves import Attribute, Parameter
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.operations import CROSS
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.stages import (
    CLIP_POSITION,
    EMITTED,
    EMITTING,
    GROUP,
    INSTANCES,
    PATCH_INDEX,
    RASTERISED,
    STRIP,
    STRIP_VERTEX,
    TARGET,
    TESSELLATED,
    TESSELLATED_EXPANDED,
    VERTICES,
    SystemInput,
)
from burnish.compiler.passes.corner_inputs import NOWHERE
from burnish.compiler.passes.lower_stages import lower_stages
from burnish.compiler.reference.evaluate import evaluate
from burnish.compiler.reference.namespace import Lanes
from burnish.compiler.reference.tessellation import ONE, triangle

from .kit import elaborated
from .test_lower_expansion import Primitive, attributes, parameter, strip_vertices, values_of
from .test_lower_tessellation import COLOR, SLOTS, directly

MATERIALS = {
    "nothing is set": """
        tessellate triangle by detail { }
        expand triangle { strip of 3 as i { } }""",
    "both set it": """
        tessellate triangle by detail as at {
            mark = at.y  position = inherited.position + at.x * inherited.normal
        }
        expand triangle { list of 6 as i for s in 0..2 like corner[i mod 3] {
            mark = inherited.mark + float(i)  position = corner[1].position + float(s) * normal
        } }""",
    "conditions": """
        tessellate triangle by detail as at { mark = at.y }
        expand triangle {
            strip of 3 as i where corner[0].mark < 0.5 { uv = inherited.uv * 2 }
            strip of 4 as i for s in 0..2 where patch_index mod 2 == 0u like corner[s] {
                tint = corner[2 - s].tint + uv
            }
        }""",
    "of a quad": """
        tessellate quad of 7 ends [6, 1, 2, 0] by 2 as at { mark = at.x + corner[5].uv.x }
        expand triangle { strip of 3 as i {
            mark = sum k in 0..3 : corner[k].mark  flag = not corner[i].flag
        } }""",
    "of lines": """
        tessellate isoline by detail lines 2 as at { mark = at.x + at.y }
        expand line { strip of 4 as i like corner[i / 2] { uv = inherited.uv + float(i) } }""",
    "numbers": """
        tessellate triangle by detail as at { mark = float(patch_index) + at.x }
        expand triangle { strip of 3 as i { tint = vec2(float(patch_index), float(vertex_index)) } }
        alpha = float(instance_index)""",
    "matrices and integers": """
        attribute bend : mat2
        attribute kind : int
        attribute shift : vec2 per instance
        tessellate triangle by detail as at { uv = bend * at.xy + shift }
        expand triangle { strip of 3 as i { mark = float(kind) + corner[0].uv.x } }""",
}


def together(
    whole: Shader, root: Node, place: Primitive, corners: Sequence[Lanes], numbers: dict[str, int]
) -> Lanes:
    """The value of a root at an emitted vertex of the part of a patch whose corners lie there."""

    def emitted(node: Node) -> Lanes | None:
        match node.data:
            case Parameter() as leaf:
                return parameter(whole, leaf)
            case SystemInput(domain=domain) as row if domain == EMITTED:
                return (numbers[row.name],)
        if node.op != "cross":
            return None
        crossing = CROSS.data(node)
        if crossing.mode != "corner":
            return evaluate(node.operands[0], emitted)
        assert crossing.origin == TESSELLATED
        (corner,) = evaluate(node.operands[1], emitted)
        return directly(whole, node.operands[0], place, corners[int(corner)])

    return evaluate(root, emitted)


def lowered(
    whole: Shader, root: Node, place: Primitive, corners: Sequence[Lanes], vertex: int
) -> Lanes:
    """The value of a root of a lowered shader at one vertex of the draw."""
    meshes = {info.leaf: info.mesh for info in whole.attributes}
    counted = {PATCH_INDEX.name: place.number, "instance_index": place.instance}

    def leaf(node: Node) -> Lanes | None:
        match node.data:
            case Parameter() as found:
                return parameter(whole, found)
            case SystemInput(name=name):
                return ({"vertex_index": vertex, "instance_index": place.number}[name],)
            case Attribute() as read:
                mesh = meshes[read]
                assert mesh is not None
                if mesh.is_of_pattern:
                    assert mesh.corner is not None
                    return corners[mesh.corner]
                if mesh.corner is None:
                    number = counted.get(mesh.name)
                    return place.values[mesh.name, place.instance] if number is None else (number,)
                point = place.vertices[mesh.corner]
                return (point,) if mesh.is_number else place.values[mesh.name, point]
        return evaluate(node.operands[0], leaf) if node.op == "cross" else None

    return evaluate(root, leaf)


def places_in(patch: str, count: int, dice: random.Random) -> list[Lanes]:
    """Some places in a patch, as if they were the corners of one of its parts."""
    found: list[Lanes] = []
    for _ in range(count):
        u, v = dice.random(), dice.random()
        found.append((u, (1 - u) * v, (1 - u) * (1 - v)) if patch == "triangle" else (u, v))
    return found


@pytest.mark.parametrize("members", MATERIALS.values(), ids=MATERIALS)
def test_every_vertex_has_what_both_say(members: str) -> None:
    (whole,) = elaborated(f"material M {{ {SLOTS} {members} {COLOR} }}")
    patches, expansion = whole.tessellation, whole.expansion
    assert patches is not None and expansion is not None
    assert whole.chain == TESSELLATED_EXPANDED
    made = lower_stages(whole)
    assert made.chain == RASTERISED
    pattern = [info for info in made.attributes if info.mesh and info.mesh.is_of_pattern]
    assert {info.leaf.step for info in pattern} == {VERTICES}
    assert all(i.leaf.step == INSTANCES for i in made.attributes if i not in pattern)
    dice, count = random.Random(members), 9
    values = values_of(attributes(whole), dice, count)
    for number in range(4):
        vertices = tuple(dice.randrange(count) for _ in range(patches.points))
        place = Primitive(number, number // 2, vertices, values)
        corners = places_in(patches.patch, patches.kind.cell, dice)
        # The host draws as many vertices for each part, so the number of a part does not matter.
        start = expansion.listed * dice.randrange(5)
        assert check(whole, made, place, corners, start) > 0


def check(
    whole: Shader, made: Shader, place: Primitive, corners: Sequence[Lanes], start: int
) -> int:
    """Compare all vertices of one part, the first of which has a certain number in the draw; how
    many of them there are."""
    assert whole.expansion is not None
    told = [result.value for result in whole.results_of(EMITTING)]
    before, after = (
        [shader.results_of(kind)[0].value for kind in (CLIP_POSITION, TARGET)]
        for shader in (whole, made)
    )
    drawn = [
        (group, *each)
        for group, strips in enumerate(whole.expansion.groups)
        for each in strip_vertices(strips)
    ]
    seen = 0
    for vertex, (group, strip, of_strip) in enumerate(drawn):
        numbers = {GROUP.name: group, STRIP.name: strip, STRIP_VERTEX.name: of_strip}
        found = [lowered(made, root, place, corners, start + vertex) for root in after]
        if not together(whole, told[group], place, corners, numbers)[0]:
            assert found[0] == NOWHERE
            continue
        for root, value in zip(before, found, strict=True):
            assert value == pytest.approx(together(whole, root, place, corners, numbers))
        seen += 1
    return seen


def test_vertices_find_out_where_their_corners_lie() -> None:
    """Levels differ, so the draw has as many vertices as the finest patch needs."""
    (whole,) = elaborated(
        f"""material M {{ {SLOTS}
            tessellate triangle by clamp(4 * end[0].uv.x, 1, 3) as at {{ mark = at.y - at.z }}
            expand triangle {{ strip of 4 as i like corner[i mod 3] {{
                position = corner[2].position + float(i) * inherited.normal
            }} }}
            {COLOR} }}"""
    )
    made, finest = lower_stages(whole), triangle([3, 3, 3], 3, "equal")
    assert made.listed == 6 * len(finest.cells)
    assert made.levels == ()
    assert not any(info.mesh and info.mesh.is_of_pattern for info in made.attributes)
    values = values_of(attributes(whole), random.Random(5), 3)
    for edge, level in ((0.125, 1.0), (0.5, 2.0)):
        for corner in range(3):
            values["vertex_uv", corner] = (edge, 0.25 * corner)
        place = Primitive(0, 0, (0, 1, 2), values)
        divided = triangle([level] * 3, level, "equal")
        for number, cell in enumerate(divided.cells):
            corners = [tuple(lane / ONE for lane in divided.places[point]) for point in cell]
            assert check(whole, made, place, corners, 6 * number) == 6
        position = made.results_of(CLIP_POSITION)[0].value
        for vertex in range(6 * len(divided.cells), made.listed):
            assert lowered(made, position, place, (), vertex) == NOWHERE
