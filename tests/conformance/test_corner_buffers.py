"""Corners that need more vertex inputs than there are: the vertex stage reads them of a buffer.

Where all numbers on the way are small multiples of a power of two, nothing is rounded, and the
picture is the same to the last bit as that with stages of their own, whose vertices have inputs of
the usual kind.
"""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.documents.drawing import MeshInputRow
from burnish.compiler.ir import build
from burnish.compiler.ir.node import Graph, Node
from burnish.compiler.ir.stages import VERTEX
from burnish.compiler.passes import corners_in_buffer, pipeline
from burnish.compiler.passes.mesh_buffers import member_name
from burnish.targets import registry
from burnish.targets.description.capabilities import buffers_of
from burnish.targets.runner import expanded_draws as expanding
from burnish.targets.runner.expanded_draws import _values
from burnish.targets.runner.meshes import Indices, plane
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import SceneState, set_up

from .kit import Floats, Studio
from .planted.planting import Plant, replaced
from .test_patches import CLEAR, SIZE, text

NATIVE = "lavapipe:glsl"
"""The route whose pictures all others are compared with."""
EVERYWHERE = tuple(
    name
    for name, route in ROUTES.items()
    if buffers_of(VERTEX).is_met(registry.select(route.profile)[1])
)

EXACT = {
    "triangles with adjacency": """
        attribute shade : float
        expand triangle_adjacency {
            strip of 3 as i for s in 0..2 {
                position = mix(corner[2 * i].position, corner[2 * i + 1].position, 0.25 * float(s))
                    + vec3(0, 0, 0.5) * float(s)
                uv = corner[5 - i].uv
                mark = corner[2 * i].shade + 4 * corner[2 * i + 1].shade + float(s)
            }
        }""",
    "sixteen points": """
        attribute shade : float
        tessellate quad of 16 ends [0, 3, 15, 12] by 4 as at {
            position = inherited.position + 0.25 * (corner[5].position - corner[6].position) * at.x
            uv = corner[9].uv
            mark = (sum k in 0..16 : corner[k].shade) + at.x + 2 * at.y
            part = int(patch_index)
        }""",
    "parts of patches": """
        attribute shade : float
        attribute shift : vec2 per instance
        tessellate quad of 16 ends [0, 3, 15, 12] by clamp(1 + 4 * end[0].uv.x, 1, 4) as at {
            mark = (sum k in 0..16 : corner[k].shade) + at.x + shift.x
            part = int(patch_index)
        }
        expand triangle { strip of 3 as i {
            position = inherited.position + 0.25 * (corner[0].position - inherited.position)
            uv = corner[1].uv
        } }""",
}


def made(name: str, route: str, *, native: bool) -> CompiledMaterial:
    """A material for a route."""
    (found,) = burnish.compile(
        text(EXACT[name]), ROUTES[route].profile, native_stages=native
    ).materials
    return found


def state_of(material: CompiledMaterial) -> SceneState:
    """A plane whose vertices have coordinates that are multiples of a power of two, twice."""
    mesh = with_inputs(material.reflection, plane(4))
    vertex = np.arange(len(mesh))[:, None] / 8
    mesh = replace(mesh, channels={**mesh.channels, "shade": vertex})
    if "shift" in mesh.instances:
        shifts = np.array([[0.5, 0.25], [8.0, 1.0]])
        mesh = replace(mesh, instances={"shift": shifts}, instance_count=2)
    if material.reflection.draw.corners == 16:
        mesh = replace(mesh, patches=sixteens(5))
    return set_up(material.instance(), mesh, Scene(), SIZE, CLEAR)


def sixteens(side: int) -> Indices:
    """All squares of sixteen vertices of a square grid."""
    grid = np.arange(side * side).reshape(side, side)
    starts = range(side - 3)
    return np.array([grid[y : y + 4, x : x + 4].reshape(-1) for y in starts for x in starts])


def drawn_both(studio: Studio, name: str, route: str) -> tuple[Floats, Floats]:
    """The pictures that are drawn from a buffer by a route, and with native stages."""
    lowered, native = made(name, route, native=False), made(name, NATIVE, native=True)
    rows = lowered.reflection.vertex_inputs
    assert sum(row.buffer is not None for row in rows) > pipeline.MOST_INPUTS
    (found,) = studio.draw(route, lowered, state_of(lowered))
    (expected,) = studio.draw(NATIVE, native, state_of(native))
    return found, expected


@pytest.mark.parametrize("route", EVERYWHERE)
@pytest.mark.parametrize("name", EXACT)
def test_a_buffer_has_what_inputs_would_have(studio: Studio, name: str, route: str) -> None:
    found, expected = drawn_both(studio, name, route)
    if ROUTES[route].driver == ROUTES[NATIVE].driver:
        assert (found == expected).all()
    else:
        # Drivers interpolate differently, and disagree about the pixels at some edges.
        alike = np.isclose(found, expected, rtol=1e-3, atol=1e-3).all(axis=-1)
        assert alike.mean() > 0.99
    covered = (expected != np.array(CLEAR, np.float32)).any(axis=-1)
    assert covered.sum() > 100
    assert len(np.unique(expected[covered], axis=0)) > 5


# --- planted errors ------------------------------------------------------------------------------


def _first_element(patch: pytest.MonkeyPatch, _folder: Path) -> None:
    """All instances read what the first one has."""
    right = build.index

    def wrong(graph: Graph, whole: Node, number: Node) -> Node:
        if whole.op == "buffer":
            number = build.constant(graph, number.type, 0)
        return right(graph, whole, number)

    patch.setattr(build, "index", wrong)


def _other_corners(
    wanted: MeshInputRow, data: Any, corners: Indices, copies: int
) -> np.ndarray[Any, Any]:
    return _values(wanted, data, np.roll(corners, 1, axis=1), copies)


def _one_name(patch: pytest.MonkeyPatch, _folder: Path) -> None:
    """A corner is taken for another one."""
    right = member_name
    patch.setattr(
        corners_in_buffer, "member_name", lambda leaf: right(leaf).replace("corner2", "corner1")
    )


PLANTED = {
    "all read the first element": ("triangles with adjacency", _first_element),
    "all patches read the first element": ("sixteen points", _first_element),
    "corners in another order": (
        "sixteen points", replaced(expanding, "_values", _other_corners)
    ),
    "one corner for another": ("triangles with adjacency", _one_name),
}  # fmt: skip


@pytest.mark.parametrize(("name", "plant"), PLANTED.values(), ids=PLANTED)
def test_the_comparison_shows_what_is_wrong(
    studio: Studio, name: str, plant: Plant, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    with monkeypatch.context() as patch:
        plant(patch, tmp_path)
        found, expected = drawn_both(studio, name, "lavapipe:wgsl-naga")
    assert (found != expected).any()
