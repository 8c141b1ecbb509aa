"""Patches of materials: divided by stages of their own, as instances, and by the reference.

``test_tessellation_stages.py`` compares patterns, with shaders made by hand. Here each driver with
the stages draws both forms of the same materials. Where all numbers on the way are small multiples
of a power of two, nothing is rounded, and the pictures are the same to the last bit. Where levels
differ from patch to patch, the picture is that of the triangles into which the reference divides
each patch.
"""

from __future__ import annotations

from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any, cast

import numpy as np
import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.ir.stages import TESSELLATED_CHAIN
from burnish.compiler.ir.tessellation import PATCH_KINDS, PatchKind, Spacing
from burnish.compiler.reference import tessellation as reference
from burnish.compiler.reference.tessellation import patterns
from burnish.compiler.reference.tessellation.stitching import between_rings
from burnish.support.frozen import changed
from burnish.targets.description.shading_language import Language
from burnish.targets.emit.fields import Fields
from burnish.targets.emit.views import TessellationView
from burnish.targets.runner import binding
from burnish.targets.runner import expanded_draws as expanding
from burnish.targets.runner.drivers.pipeline import Pipeline
from burnish.targets.runner.meshes import Indices, plane, sphere
from burnish.targets.runner.patches import pattern
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import SceneState, set_up

from . import kit
from .kit import Floats, Studio, assert_one_picture, compiled
from .planted.planting import Plant, form, supplied, target
from .test_tessellation_stages import ON, PROFILES, SPACINGS

EXAMPLES = Path(__file__).parents[2] / "examples"
SIZE = (64, 48)
CLEAR = (9.0, 9.0, 9.0, 9.0)

MATERIAL = """
material M {{
    param detail : float in 1..16 = 3
    mark : float = {mark}
    part : int = {part}
    clip_position = vec4(0.75 * position.xy, 0.5 - 0.25 * position.z, 1)
    color = vec3(mark, uv.x, float(part)) * (if front_facing then 1 else -1)
    {members}
}}
"""


def text(members: str, mark: str = "0", part: str = "0") -> str:
    """The material with these members besides."""
    return MATERIAL.format(members=members, mark=mark, part=part)


EXACT = {
    "triangles": """tessellate triangle by detail as at {
        position = inherited.position + vec3(0.125, 0, 0.5) * at.x
        mark = at.y + 2 * at.z
        part = int(64 * at.x + 8 * at.y)
    }""",
    "fractional triangles": """tessellate triangle spacing fractional_odd by detail + 0.5 as at {
        mark = corner[1].uv.y + at.z
        uv = inherited.uv + at.xy
        part = int(64 * at.x + 8 * at.y)
    }""",
    "other ends": """tessellate triangle ends [1, 2, 0] by 2 inside 4 as at {
        position = corner[0].position * at.x + corner[2].position * at.y
            + corner[1].position * at.z
        mark = at.x + 4 * at.y
        part = int(patch_index)
    }""",
    "quads": """tessellate quad by 4 inside 8 as at {
        position = inherited.position + vec3(0, 0.125, 0.25) * at.x
        mark = at.x + 2 * at.y
        part = int(64 * at.x + 8 * at.y) + int(patch_index)
    }""",
    "fractional quads": """tessellate quad spacing fractional_even by 4 inside vec2(2, 8) as at {
        mark = at.x + 2 * at.y
        part = int(64 * at.x + 8 * at.y)
    }""",
    "lines": """tessellate isoline by 4 lines 3 as at {
        position = inherited.position + vec3(0, 0.25, 0.25) * at.y + vec3(0, 0, 0.5) * at.x
        mark = at.x + 2 * at.y
        part = int(64 * at.x + 8 * at.y) + int(patch_index)
    }""",
    "fractional lines": """tessellate isoline spacing fractional_odd by detail + 0.5 lines 2 as at {
        position = inherited.position + vec3(0.125, 0.25, 0) * at.y
        mark = at.x
        part = int(64 * at.x + 8 * at.y)
    }""",
    "many points": """tessellate quad of 9 ends [0, 2, 8, 6] by 2 as at {
        position = corner[0].position + at.x * (corner[2].position - corner[0].position)
            + at.y * (corner[6].position - corner[0].position)
            + 0.25 * (corner[4].position - corner[1].position) * at.x
        mark = at.x + corner[7].uv.y
        part = int(64 * at.x + 8 * at.y)
    }""",
}


def both(name: str) -> tuple[CompiledMaterial, CompiledMaterial]:
    """A material with tessellation stages; and the same drawn as instances."""
    native, lowered = (
        burnish.compile(text(EXACT[name]), PROFILES, native_stages=stage).materials[0]
        for stage in (True, False)
    )
    return native, lowered


def state_of(material: CompiledMaterial) -> SceneState:
    """A plane whose vertices have coordinates that are multiples of a half."""
    mesh = with_inputs(material.reflection, plane(4))
    if material.reflection.draw.corners == 9:
        mesh = replace(mesh, patches=nines(5))
    return set_up(material.instance(), mesh, Scene(), SIZE, CLEAR)


def nines(side: int) -> Indices:
    """Squares of nine vertices of a square grid, which share those at their edges."""
    grid = np.arange(side * side).reshape(side, side)
    starts = range(0, side - 2, 2)
    return np.array([grid[y : y + 3, x : x + 3].reshape(-1) for y in starts for x in starts])


def drawn_both(studio: Studio, name: str, route: str) -> tuple[Floats, Floats]:
    """The pictures that are drawn with tessellation stages, and as instances."""
    native, lowered = both(name)
    rows = tuple(stage.row for stage in native.staged.program.stages)
    assert rows == TESSELLATED_CHAIN
    (found,) = studio.draw(route, native, state_of(native))
    (expected,) = studio.draw(route, lowered, state_of(lowered))
    return found, expected


@pytest.mark.parametrize("route", ON)
@pytest.mark.parametrize("name", EXACT)
def test_both_forms_are_one_picture(studio: Studio, name: str, route: str) -> None:
    assert_one_picture(*drawn_both(studio, name, route))


@pytest.mark.parametrize("route", ON)
@pytest.mark.parametrize("name", ["displacement", "splines"])
def test_the_forms_of_examples_differ_by_rounding_only(
    studio: Studio, name: str, route: str
) -> None:
    path = EXAMPLES / f"{name}.burnish"
    native, lowered = (
        burnish.compile(path, PROFILES, native_stages=stage).materials[0] for stage in (True, False)
    )
    one, other = (
        set_up(material.instance(), sphere(12, 12), Scene(), SIZE, CLEAR)
        for material in (native, lowered)
    )
    (found,) = studio.draw(route, native, one)
    (expected,) = studio.draw(route, lowered, other)
    covered = (expected != np.array(CLEAR, np.float32)).any(axis=-1)
    assert (covered == (found != np.array(CLEAR, np.float32)).any(axis=-1)).mean() > 0.999
    assert np.isclose(found, expected, rtol=1e-3, atol=1e-3).mean() > 0.995
    assert covered.sum() > 500


LEVEL_0 = """param rising : float in 0..1 = 0
    tessellate triangle by rising as at { mark = at.x }"""


@pytest.mark.parametrize("route", ROUTES)
def test_patches_of_level_0_are_not_drawn(studio: Studio, route: str) -> None:
    (lowered,) = burnish.compile(text(LEVEL_0), ROUTES[route].profile).materials
    assert lowered.reflection.levels is not None, "the host divides"
    state = state_of(lowered)
    assert not len(state.triangles)
    (found,) = studio.draw(route, lowered, state)
    assert (found == np.array(CLEAR, np.float32)).all()
    (expected,) = studio.draw(kit.REFERENCE, lowered, state)
    assert (expected == found).all()


# --- levels that differ --------------------------------------------------------------------------

DIFFERING = """tessellate triangle spacing {}
    by clamp(1 + 4 * (end[0].uv.x + end[1].uv.x), 1, 9) as at {{
    mark = at.x + 2 * at.y
    part = int(64 * at.x + 8 * at.y)
}}"""
GIVEN = """
    attribute given : float
    attribute whole : int
"""


@pytest.mark.parametrize("route", ON)
@pytest.mark.parametrize("spacing", SPACINGS)
def test_levels_that_differ_are_those_of_the_edges(
    studio: Studio, spacing: Spacing, route: str
) -> None:
    found, expected = drawn_with_levels(studio, spacing, route)
    assert (found == expected).all()
    assert len(np.unique(expected[..., 2])) > 20


def drawn_with_levels(studio: Studio, spacing: Spacing, route: str) -> tuple[Floats, Floats]:
    """The pictures of patches with different levels, and of the reference's triangles."""
    source = text(DIFFERING.format(spacing))
    (native,) = burnish.compile(source, PROFILES, native_stages=True).materials
    state = state_of(native)
    (found,) = studio.draw(route, native, state)
    (expected,) = studio.draw(route, given(), in_triangles(state, spacing))
    return found, expected


EVERYWHERE = tuple(name for name in ROUTES if "chromium" not in name)
"""Every language, and all drivers but browsers."""


@pytest.mark.parametrize("route", EVERYWHERE)
@pytest.mark.parametrize("spacing", SPACINGS)
def test_vertices_find_out_where_they_lie(studio: Studio, spacing: Spacing, route: str) -> None:
    source = text(DIFFERING.format(spacing))
    (native,) = burnish.compile(source, PROFILES, native_stages=True).materials
    (lowered,) = burnish.compile(source, ROUTES[route].profile).materials
    assert lowered.reflection.draw.tessellation is not None
    assert lowered.reflection.levels is None
    (found,) = studio.draw(route, lowered, state_of(lowered))
    (expected,) = studio.draw(route, given(), in_triangles(state_of(native), spacing))
    assert (found == expected).all()
    assert len(np.unique(expected[..., 2])) > 20


@cache
def given() -> CompiledMaterial:
    """The material whose vertices say themselves what they are."""
    return compiled(text(GIVEN, "given", "whole"))


def in_triangles(state: SceneState, spacing: Spacing) -> SceneState:
    """The patches of a draw, each divided by the reference, and all vertices of them apart."""
    found: dict[str, list[Floats]] = {name: [] for name in ("vertex_position", "vertex_uv", "at")}
    cells: list[Indices] = []
    count = 0
    for patch in state.triangles:
        us = state.attributes["vertex_uv"][patch, 0]
        edges = [1 + 4 * float(us[a] + us[b]) for a, b in ((1, 2), (2, 0), (0, 1))]
        pattern = reference.triangle(edges, max(edges), spacing)
        weights = np.array(pattern.places) / reference.ONE
        found["at"].append(weights)
        for name in ("vertex_position", "vertex_uv"):
            found[name].append(weights @ state.attributes[name][patch])
        cells.append(np.array(pattern.cells) + count)
        count += len(weights)
    vertices = {name: np.concatenate(values) for name, values in found.items()}
    at = vertices.pop("at")
    vertices["given"] = at[:, :1] + 2 * at[:, 1:2]
    vertices["whole"] = np.floor(64 * at[:, :1] + 8 * at[:, 1:2])
    instance = given().instance()
    return replace(
        set_up(instance, with_inputs(given().reflection, plane(4)), Scene(), SIZE, CLEAR),
        attributes=vertices,
        triangles=np.concatenate(cells),
    )


# --- planted errors ------------------------------------------------------------------------------


def _spacings(**words: str) -> Plant:
    return target("glsl", lambda right: changed(right, spacings={**right.spacings, **words}))


def _winding(language: str, winding: str) -> Plant:
    def change(right: Language) -> Language:
        profiles = tuple(changed(profile, patch_winding=winding) for profile in right.profiles)
        return changed(right, profiles=profiles)

    return target(language, change)


def _other_edges(patch: pytest.MonkeyPatch, _folder: Path) -> None:
    """Each edge of a triangle is taken for the next one."""
    kinds = cast("dict[str, PatchKind]", PATCH_KINDS)
    right = kinds["triangle"]
    patch.setitem(kinds, "triangle", changed(right, edges=(*right.edges[1:], right.edges[0])))


def _other_places(patch: pytest.MonkeyPatch, _folder: Path) -> None:
    """The pattern has the places of its points in another order."""
    right = pattern

    def wrong(*arguments: Any) -> tuple[Floats, Indices]:
        places, cells = right(*arguments)
        return np.roll(places, 1, axis=0), cells

    patch.setattr(expanding, "pattern", wrong)


def _other_first_vertex(patch: pytest.MonkeyPatch, _folder: Path) -> None:
    """The triangles between two rings of a pattern begin with other vertices."""
    right = between_rings
    patch.setattr(patterns, "between_rings", lambda *rows: ((b, c, a) for a, b, c in right(*rows)))


def _handing_on_the_first(patch: pytest.MonkeyPatch, _folder: Path) -> None:
    """Each invocation of a control shader hands on what the first control point has."""
    right = Fields.tessellation

    def wrong(fields: Fields) -> TessellationView | None:
        view = right(fields)
        if view is None:
            return None
        handing = [changed(store, value=f"{store.value}[0]; //") for store in view.handing]
        return changed(view, handing=handing)

    patch.setattr(Fields, "tessellation", wrong)


def _other_topology(patch: pytest.MonkeyPatch, _folder: Path) -> None:
    """A host takes the vertices of lines for those of triangles."""
    right = binding.pipeline

    def wrong(*asked: Any, **options: Any) -> Pipeline:
        made = right(*asked, **options)
        return replace(made, primitive="triangle") if made.primitive == "line" else made

    patch.setattr(kit, "pipeline", wrong)


PLANTED = {
    "triangles turn the other way": ("triangles", "lavapipe:glsl", _winding("glsl", "ccw")),
    "they do in HLSL": ("triangles", "lavapipe:hlsl-dxc", _winding("hlsl", "ccw")),
    "they do in OpenGL": ("quads", "llvmpipe:gl450", _winding("glsl", "cw")),
    "each control point is the first one": (
        "many points", "lavapipe:glsl", form("glsl", corner="{name}[0]")
    ),
    "all hand on the first control point": ("triangles", "lavapipe:glsl", _handing_on_the_first),
    "weights of other corners": (
        "triangles", "lavapipe:glsl", supplied("glsl", "patch_weights", "gl_TessCoord.yzx")
    ),
    "coordinates exchanged": (
        "quads", "lavapipe:glsl", supplied("glsl", "patch_coordinate", "gl_TessCoord.yx")
    ),
    "all patches have one number": (
        "other ends", "lavapipe:glsl", supplied("glsl", "patch_index", "0")
    ),
    "steps are equal": (
        "fractional triangles", "lavapipe:glsl", _spacings(fractional_odd="equal_spacing")
    ),
    "steps are even": (
        "fractional triangles", "lavapipe:glsl",
        _spacings(fractional_odd="fractional_even_spacing"),
    ),
    "levels inside exchanged": (
        "fractional quads", "lavapipe:glsl",
        form("glsl", inner_level="gl_TessLevelInner[1 - {number}]"),
    ),
    "the pattern's places are others": ("triangles", "lavapipe:glsl", _other_places),
    "triangles begin with other vertices": ("quads", "lavapipe:glsl", _other_first_vertex),
    "lines run the other way": (
        "lines", "lavapipe:glsl", supplied("glsl", "patch_coordinate", "gl_TessCoord.yx")
    ),
    "as many segments as lines": (
        "lines", "lavapipe:glsl", form("glsl", edge_level="gl_TessLevelOuter[1 - {number}]")
    ),
    "lines are taken for triangles": ("lines", "lavapipe:glsl", _other_topology),
    "levels of other edges": (
        "levels", "lavapipe:glsl", form("glsl", edge_level="gl_TessLevelOuter[({number} + 1) % 3]")
    ),
    "edges lie between other ends": ("levels", "lavapipe:glsl", _other_edges),
    "one edge has no level": (
        "levels", "lavapipe:glsl", form("glsl", edge_level="gl_TessLevelOuter[{number} / 2]")
    ),
}  # fmt: skip


@pytest.mark.parametrize(("name", "route", "plant"), PLANTED.values(), ids=PLANTED)
def test_the_comparison_shows_what_is_wrong(
    studio: Studio,
    name: str,
    route: str,
    plant: Plant,
    monkeypatch: pytest.MonkeyPatch,
    tmp_path: Path,
) -> None:
    with monkeypatch.context() as patch:
        plant(patch, tmp_path)
        if name == "levels":
            found, expected = drawn_with_levels(studio, "equal", route)
        else:
            found, expected = drawn_both(studio, name, route)
    assert (found != expected).any()
