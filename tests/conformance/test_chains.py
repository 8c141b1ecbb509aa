"""Divided patches whose parts are expanded: by all stages, as instances, and by hand.

Each driver with the stages draws both forms of the same materials. Where all numbers on the way are
small multiples of a power of two, nothing is rounded, and the pictures are the same to the last
bit. What the lowering and the stages might have in common is compared with triangles that are made
here: of the parts into which the reference divides each patch.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.stages import TESSELLATED_EXPANDED
from burnish.compiler.passes.expanded_corners import CellCorners
from burnish.compiler.reference import tessellation as reference
from burnish.targets.runner import expanded_draws as expanding
from burnish.targets.runner.meshes import Indices, plane
from burnish.targets.runner.patches import pattern
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import SceneState, set_up

from .kit import Floats, Studio, assert_one_picture, compiled
from .planted.planting import Plant, form, replaced, supplied
from .test_patches import CLEAR, EVERYWHERE, SIZE, state_of, text
from .test_tessellation_stages import ON, PROFILES

EXACT = {
    "triangles": """tessellate triangle by detail as at {
        position = inherited.position + vec3(0.125, 0, 0.5) * at.x
        part = int(64 * at.x + 8 * at.y)
    }
    expand triangle {
        strip of 3 as i { mark = float(corner[0].part) }
        strip of 3 as i {
            position = corner[0].position + 0.5 * (inherited.position - corner[0].position)
                + vec3(0, 0, 0.25)
            mark = float(i) + 4 * float(corner[1].part)
            part = corner[2].part
        }
    }""",
    "quads": """tessellate quad by 4 inside 8 as at {
        position = inherited.position + vec3(0, 0.125, 0.25) * at.x
        part = int(64 * at.x + 8 * at.y) + int(patch_index)
    }
    expand triangle {
        strip of 4 as i for s in 0..2 where corner[0].uv.x < 0.75 like corner[i mod 3] {
            position = inherited.position + vec3(0.0625 * float(i), 0, 0.5 * float(s))
            mark = float(i) + 8 * float(patch_index)
        }
    }""",
    "lines": """tessellate isoline by 4 lines 3 as at {
        position = inherited.position + vec3(0, 0.25, 0.25) * at.y
        part = int(64 * at.x + 8 * at.y)
    }
    expand line {
        strip of 4 as i like corner[i / 2] {
            position = inherited.position + 0.0625 * float(i mod 2) * vec3(1, 1, 0)
            mark = float(corner[1].part) + float(i)
        }
    }""",
    "levels that differ": """tessellate triangle spacing fractional_even
        by clamp(1 + 4 * (end[0].uv.x + end[1].uv.x), 1, 9) as at {
        part = int(64 * at.x + 8 * at.y)
    }
    expand triangle {
        list of 6 as i like corner[(i + i / 3) mod 3] {
            mark = float(i) + 8 * float(corner[1].part)
            position = inherited.position
                + vec3(0.0625 * float(i mod 2), 0.0625 * float(i mod 3), 0.25 * float(i / 3))
        }
    }""",
}


def both(name: str) -> tuple[CompiledMaterial, CompiledMaterial]:
    """A material with all stages; and the same drawn as instances."""
    native, lowered = (
        burnish.compile(text(EXACT[name]), PROFILES, native_stages=stage).materials[0]
        for stage in (True, False)
    )
    return native, lowered


def drawn_both(studio: Studio, name: str, route: str) -> tuple[Floats, Floats]:
    """The pictures that are drawn with native stages, and as instances."""
    native, lowered = both(name)
    assert tuple(s.row for s in native.staged.program.stages) == TESSELLATED_EXPANDED
    (found,) = studio.draw(route, native, state_of(native))
    (expected,) = studio.draw(route, lowered, state_of(lowered))
    return found, expected


@pytest.mark.parametrize("route", ON)
@pytest.mark.parametrize("name", EXACT)
def test_both_forms_are_one_picture(studio: Studio, name: str, route: str) -> None:
    assert_one_picture(*drawn_both(studio, name, route))


# --- made by hand --------------------------------------------------------------------------------

OUTWARDS = """tessellate triangle by {} as at {{
    part = int(64 * at.x + 8 * at.y)
}}
expand triangle {{
    list of 6 as i like corner[i mod 3] {{
        position = 0.75 * inherited.position + vec3(0, 0, if i < 3 then 0 else 0.5)
        mark = float(i) + 8 * float(corner[(i + 1) mod 3].part)
    }}
}}"""
LEVELS: dict[str, Callable[[Floats], Floats]] = {
    "4": lambda us: 4 + 0 * us,
    "clamp(1 + 4 * (end[0].uv.x + end[1].uv.x), 1, 9)": lambda us: (
        1 + 4 * (us[[1, 2, 0]] + us[[2, 0, 1]])
    ),
}
"""Into how many steps the edges of a triangle are divided, by the u of its ends."""


@pytest.mark.parametrize("route", EVERYWHERE)
@pytest.mark.parametrize("level", LEVELS)
def test_instances_have_the_triangles_that_are_meant(
    studio: Studio, level: str, route: str
) -> None:
    (lowered,) = burnish.compile(text(OUTWARDS.format(level)), ROUTES[route].profile).materials
    (found,) = studio.draw(route, lowered, state_of(lowered))
    (expected,) = studio.draw(route, given(), by_hand(level))
    assert (found == expected).all()
    assert len(np.unique(expected[..., 0])) > 20


@pytest.mark.parametrize("route", ON)
@pytest.mark.parametrize("level", LEVELS)
def test_stages_make_the_triangles_that_are_meant(studio: Studio, level: str, route: str) -> None:
    source = text(OUTWARDS.format(level))
    (native,) = burnish.compile(source, PROFILES, native_stages=True).materials
    (found,) = studio.draw(route, native, state_of(native))
    (expected,) = studio.draw(route, given(), by_hand(level))
    assert (found == expected).all()


def given() -> CompiledMaterial:
    """The material whose vertices say themselves what they are."""
    members = "attribute given : float  attribute whole : int"
    return compiled(text(members, "given", "whole"))


def by_hand(level: str) -> SceneState:
    """The scene that ``OUTWARDS`` means, vertex by vertex."""
    source = text(OUTWARDS.format(level))
    (native,) = burnish.compile(source, "glsl:vulkan", native_stages=True).materials
    state = state_of(native)
    found: dict[str, list[Floats]] = {
        name: [] for name in ("vertex_position", "vertex_uv", "given", "whole")
    }
    for patch in state.triangles:
        edges = LEVELS[level](state.attributes["vertex_uv"][patch, 0])
        pattern = reference.triangle(edges.tolist(), float(edges.max()), "equal")
        weights = np.array(pattern.places) / reference.ONE
        parts = np.floor(64 * weights[:, 0] + 8 * weights[:, 1])
        position, uv = (
            weights @ state.attributes[name][patch] for name in ("vertex_position", "vertex_uv")
        )
        for cell, i in ((cell, i) for cell in pattern.cells for i in range(6)):
            here = cell[i % 3]
            farther = np.array([0, 0, 0 if i < 3 else 0.5])
            found["vertex_position"].append(0.75 * position[here] + farther)
            found["vertex_uv"].append(uv[here])
            found["given"].append(np.array([i + 8 * parts[cell[(i + 1) % 3]]]))
            found["whole"].append(parts[[here]])
    vertices = {name: np.stack(values) for name, values in found.items()}
    material = given()
    mesh = with_inputs(material.reflection, plane(4))
    return replace(
        set_up(material.instance(), mesh, Scene(), SIZE, CLEAR),
        attributes=vertices,
        triangles=np.arange(len(vertices["given"])).reshape(-1, 3),
    )


# --- planted errors ------------------------------------------------------------------------------


def _corners_exchanged(patch: pytest.MonkeyPatch, _folder: Path) -> None:
    """The vertices of a part get where its corners lie in another order."""
    right = pattern

    def wrong(*arguments: Any) -> tuple[Floats, Indices]:
        places, cells = right(*arguments)
        return places, np.roll(cells, 1, axis=1)

    patch.setattr(expanding, "pattern", wrong)


def _of_next_part(corners: CellCorners, corner: int) -> Node:
    """The number of a corner as if parts shared their vertices."""
    assert corners._cell is not None
    return corners._call(corners._cell.type, "add", corners._cell, corners._number(corner))


PLANTED = {
    "the corners of a part are others": ("triangles", "lavapipe:glsl", _corners_exchanged),
    "parts overlap": (
        "levels that differ", "lavapipe:glsl", replaced(CellCorners, "_vertex_at", _of_next_part)
    ),
    "every part is drawn": (
        "levels that differ", "lavapipe:glsl",
        replaced(CellCorners, "is_there", property(lambda _corners: None)),
    ),
    "every corner is the first one": (
        "triangles", "lavapipe:glsl", replaced(
            CellCorners, "_known_place",
            lambda corners, _corner: corners._vertices.given_place(0),
        ),
    ),
    "a part has only its first vertices": (
        "quads", "lavapipe:glsl",
        form("glsl", loop="for ({index_typed} = 0; {index} < 3; {index}++) {{"),
    ),
    "corners of the geometry stage are one": (
        "lines", "lavapipe:glsl", form("glsl", corner="{name}[0]")
    ),
    "patches have one number": ("quads", "lavapipe:glsl", supplied("glsl", "patch_index", "0")),
    "they have in OpenGL": ("quads", "llvmpipe:gl450", supplied("glsl", "patch_index", "0")),
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
        found, expected = drawn_both(studio, name, route)
    assert (found != expected).any()
