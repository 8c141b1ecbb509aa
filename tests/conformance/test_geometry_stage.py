"""A geometry stage and a draw of instances are two ways to one picture.

The reference draws the instances (``test_examples.py``). Here each driver with a geometry stage
draws both forms of the same materials. Where all numbers on the way are small multiples of a power
of two, nothing is rounded, and the pictures are the same to the last bit: so both forms have the
same triangles, in the same order, with the same vertex first. Elsewhere drivers round differently
in different stages.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import numpy as np
import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.ir.expansion import Expansion
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.primitives import CORNERS
from burnish.compiler.passes.lower_expansion import EmittedNumbers, _Lowering
from burnish.targets.conformance.cases import series_of
from burnish.targets.runner import expanded_draws as expanding
from burnish.targets.runner.expanded_draws import _values
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import SceneState, set_up

from ..targets.standings import routes
from .kit import Floats, Studio, assert_one_picture
from .planted.planting import Plant, form, replaced

ON = tuple(
    name
    for name in sorted(routes("native", "expansions"))
    if ROUTES[name].driver in ("lavapipe", "llvmpipe")
)
"""The routes with a geometry stage: SwiftShader has none, whatever the profile."""
PROFILES = tuple(sorted({ROUTES[name].profile for name in ON}))
EXAMPLES = Path(__file__).parents[2] / "examples"
SIZE = (64, 48)
CLEAR = (9.0, 9.0, 9.0, 9.0)

MATERIAL = """
material M {{
    param count : int in 0..3 = 2
    attribute shade : float
    mark : float = 0
    clip_position = vec4(0.75 * position.xy, 0.5 - 0.25 * position.z, 1)
    expand {}
    color = vec3(mark, uv.x, float(primitive_index)) * (if front_facing then 1 else -1)
}}
"""

EXACT = {
    "point": """point { strip of 4 as i {
        position = corner[0].position + 0.125 * vec3(float(i mod 2), float(i / 2), 0)
        mark     = 0.25 * float(i)
    } }""",
    "a long strip": """point { strip of 7 as i {
        position = corner[0].position + 0.0625 * vec3(float(i), float(i mod 2) * 2, float(i))
        mark     = 0.125 * float(i)
        uv       = vec2(float(i * i))
    } }""",
    "a list": """triangle { list of 6 as i like corner[i mod 3] {
        position = 0.5 * inherited.position + vec3(if i < 3 then 0 else 0.5, 0, 0)
        mark     = float(i)
    } }""",
    "line": """line { strip of 4 as i like corner[i / 2] {
        position = inherited.position + 0.0625 * vec3(float(i mod 2), 0, 0.5 * float(i mod 2))
        mark     = 0.5 * float(i)
    } }""",
    "lines": """line {
        line of 3 as i for s in 0..count where corner[0].uv.x < 0.8 like corner[i mod 2] {
            position = inherited.position
                + 0.0625 * vec3(float(s), float(i mod 2), 0.5 * float(i) + float(s))
            mark     = 0.5 * float(i)
        }
        line of 2 as i { mark = 2 }
    }""",
    "triangle": """triangle { strip of 3 as i for s in 0..count where corner[0].position.x < 0.4 {
        position = inherited.position + vec3(0.125, 0.25, 0.5) * float(s)
        mark     = float(s)
    } }""",
    "groups": """triangle {
        strip of 3 as i { mark = 1 }
        strip of 4 as i for s in 1..3 where primitive_index mod 2 == 0u like corner[i mod 3] {
            position = corner[0].position
                + 0.25 * vec3(float(i mod 2), float(i / 2), 2 * float(s))
        }
        list of 3 as i like corner[2 - i] { position = 0.5 * inherited.position + vec3(0, 0, 2) }
    }""",
    "line_adjacency": """line_adjacency { strip of 4 as i {
        position = mix(corner[i].position, corner[1].position, 0.5)
            + vec3(0, 0.0625 * float(i), 0.125)
        mark     = 0.25 * float(i)
    } }""",
    "triangle_adjacency": """triangle_adjacency {
        strip of 4 as i for s in 0..3 like corner[0] {
            position = mix(corner[2 * s].position, corner[(2 * s + i) mod 6].position, 0.5)
                + vec3(0, 0, 0.25 * float(s) + 0.125 * float(i))
            mark     = float(s)
        }
    }""",
}


def both(name: str) -> tuple[CompiledMaterial, CompiledMaterial]:
    """A material, or an example, with a geometry stage; and the same drawn as instances."""
    text = MATERIAL.format(EXACT[name]) if name in EXACT else EXAMPLES / f"{name}.burnish"
    native, lowered = (
        burnish.compile(text, PROFILES, native_stages=stage).materials[0] for stage in (True, False)
    )
    return native, lowered


def state_of(material: CompiledMaterial) -> SceneState:
    """A plane whose vertices have coordinates that are multiples of a half."""
    mesh = with_inputs(material.reflection, plane(4))
    return set_up(material.instance(), mesh, Scene(), SIZE, CLEAR)


def test_every_kind_of_primitive_is_tried() -> None:
    assert CORNERS.keys() <= EXACT.keys()


@pytest.mark.parametrize("route", ON)
@pytest.mark.parametrize("name", EXACT)
def test_both_forms_are_one_picture(studio: Studio, name: str, route: str) -> None:
    assert_one_picture(*drawn_both(studio, name, route))


def drawn_both(studio: Studio, name: str, route: str) -> tuple[Floats, Floats]:
    """The pictures that are drawn with a geometry stage, and as instances."""
    native, lowered = both(name)
    assert [stage.name for stage in native.staged.program.stages][1] == "geometry"
    (found,) = studio.draw(route, native, state_of(native))
    (expected,) = studio.draw(route, lowered, state_of(lowered))
    return found, expected


def _without_turning(numbers: EmittedNumbers, group: int) -> Node:
    """The number of a vertex in its strip, as if all triangles of a strip were alike."""
    place = numbers._within(group)
    if numbers._groups[group].strips > 1:
        place = numbers._call("mod", place, numbers._number(3 * numbers._groups[group].primitives))
    three = numbers._number(3)
    return numbers._call(
        "add", numbers._call("div", place, three), numbers._call("mod", place, three)
    )


def _too_early(expansion: Expansion) -> tuple[int, ...]:
    """For each group the number of its first vertex, as if the others had two."""
    return (0, *[2] * (len(expansion.groups) - 1))


def _apart(numbers: EmittedNumbers, group: int) -> Node:
    """The number of a vertex in its line, as if lines shared no vertices."""
    place = numbers._within(group)
    return numbers._call("mod", place, numbers._number(numbers._groups[group].vertices))


PLANTED = {
    "lines are cut into pieces": ("lines", replaced(EmittedNumbers, "_strip_vertex", _apart)),
    "triangles of a strip are not turned": (
        "a long strip", replaced(EmittedNumbers, "_strip_vertex", _without_turning)
    ),
    "all vertices are of the first strip": (
        "triangle", replaced(EmittedNumbers, "_strip", lambda numbers, _group: numbers._number(0))
    ),
    "every strip is drawn": (
        "triangle", replaced(_Lowering, "drawn", lambda _lowering, _results: None)
    ),
    "groups begin elsewhere": ("groups", replaced(Expansion, "starts", property(_too_early))),
    "each vertex is like the first corner": ("a list", form("glsl", corner="{name}[0]")),
    "strips are joined": ("triangle", form("glsl", end_strip="// EndPrimitive();")),
    "the first vertex is left out": (
        "point", form("glsl", loop="for ({index_typed} = 1; {index} < {count}; {index}++) {{")
    ),
    "corners in another order": (
        "triangle_adjacency",
        replaced(expanding, "_values", lambda wanted, data, corners, copies: _values(
            wanted, data, np.roll(corners, 2, axis=1), copies
        )),
    ),
}  # fmt: skip


@pytest.mark.parametrize(("name", "plant"), PLANTED.values(), ids=PLANTED)
def test_the_comparison_shows_what_is_wrong(
    studio: Studio,
    name: str,
    plant: Plant,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    """The reference draws what the lowering has made, so that only this comparison can tell."""
    with monkeypatch.context() as patch:
        plant(patch, tmp_path)
        found, expected = drawn_both(studio, name, "lavapipe:glsl")
    assert (found != expected).any()


@pytest.mark.parametrize("route", ON)
@pytest.mark.parametrize("name", ["sprites", "fur"])
def test_the_forms_differ_by_rounding_only(studio: Studio, name: str, route: str) -> None:
    native, lowered = both(name)
    drawn = 0
    for one, other in zip(states(native), states(lowered), strict=True):
        (found,) = studio.draw(route, native, one)
        (expected,) = studio.draw(route, lowered, other)
        covered = (expected != np.array(other.clear[0], np.float32)).any(axis=-1)
        assert (covered == (found != np.array(one.clear[0], np.float32)).any(axis=-1)).all()
        assert np.allclose(found, expected, rtol=1e-4, atol=1e-4)
        drawn += int(covered.sum())
    assert drawn > 2000


def states(material: CompiledMaterial) -> Iterator[SceneState]:
    """The cases in which ``conform`` draws a material."""
    for series in series_of(material.reflection, 7, SIZE):
        yield from (case.state for case in series.cases)
