"""Every route that has a stream output captures what the reference computes.

And what is captured is a mesh again, which is drawn like any other.
"""

from __future__ import annotations

from functools import lru_cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.compiled import CompiledMaterial
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.summary import details
from burnish.targets.runner.capturing import Vertices, capture
from burnish.targets.runner.meshes import MeshError, cube, plane
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import SceneState, set_up

from .kit import Studio

FILE = Path(__file__).with_name("captures.burnish")
PLAIN = (
    "lavapipe:glsl", "lavapipe:hlsl-glslang", "lavapipe:hlsl-dxc", "llvmpipe:gl330",
    "llvmpipe:gl450", "llvmpipe:es310", "chromium:webgl2",
)  # fmt: skip
"""The routes with a stream output."""
EXPANDED = PLAIN[:4]
"""Those with a geometry stage as well."""
WORK = [
    *(("Plain", route) for route in PLAIN),
    *((name, route) for name in ("Tent", "Sparks") for route in EXPANDED),
]


@lru_cache(maxsize=1)
def compiled() -> burnish.CompileResult:
    profiles = sorted({ROUTES[route].profile for route in PLAIN})
    return burnish.compile(FILE, profiles, pass_="Captured", partial=True, native_stages=True)


@pytest.mark.parametrize(("name", "route"), WORK)
def test_it_agrees(studio: Studio, name: str, route: str) -> None:
    (row,) = conform([(name, compiled()[name])], [ROUTES[route]], studio.runner, studio.toolchain)
    assert row.status == "agrees", "\n".join(details(row)) or row.problem
    assert row.proven > 1000


def state_of(material: CompiledMaterial) -> SceneState:
    mesh = with_inputs(material.reflection, plane(2))
    return set_up(material.instance(), mesh, Scene(), (4, 4))


def captured(studio: Studio, text: str, route: str = "lavapipe:glsl", **options: Any) -> Vertices:
    profile = ROUTES[route].profile
    (material,) = burnish.compile(text, profile, pass_="Moved", **options).materials
    state = state_of(material)
    return capture(material, state, ROUTES[route], studio.runner, studio.toolchain)


def test_points_come_in_the_order_of_the_mesh_and_only_where_they_are_emitted(
    studio: Studio,
) -> None:
    text = """
    material Dust { number : uint = 0u  expand point {
        points of 2 as i where primitive_index mod 3u == 1u {
            number = 10u * primitive_index + uint(i)
        }
    }  color = vec3(1) }
    pass Moved { capture number : uint = number }
    """
    for route in EXPANDED:
        found = captured(studio, text, route, native_stages=True)
        assert found.primitive == "point"
        assert found.members["number"].tolist() == [[10], [11], [40], [41], [70], [71]], route


def test_triangles_are_captured_corner_by_corner(studio: Studio) -> None:
    """A vertex that triangles share is there for each of them; the first one stays the first."""
    text = """
    material Dust { color = vec3(1) }
    pass Moved { capture number : int = int(vertex_index)  capture corner : vec2 = uv }
    """
    whole = plane(2).triangles.reshape(-1)
    for route in ("lavapipe:glsl", "lavapipe:hlsl-dxc", "llvmpipe:gl330", "llvmpipe:gl450"):
        found = captured(studio, text, route)
        assert found.count == len(whole)
        assert found.members["number"][:, 0].tolist() == whole.tolist()
        assert (found.members["corner"] == plane(2).channels["uv"][whole]).all()


def test_what_is_captured_is_drawn_again(studio: Studio) -> None:
    """Captured triangles are a mesh: captured once more unchanged, they are the same."""
    text = """
    material Dust { attribute heat : float  color = vec3(1)  hot = @vertex (heat + 1) }
    pass Moved { capture position : vec3 = position  capture heat : float = hot }
    """
    profile = ROUTES["llvmpipe:gl450"].profile
    (material,) = burnish.compile(text, profile, pass_="Moved").materials
    first = with_inputs(material.reflection, cube())
    before = first
    for step in range(3):
        state = set_up(material.instance(), before, Scene(), (4, 4))
        found = capture(material, state, ROUTES["llvmpipe:gl450"], studio.runner, studio.toolchain)
        before = found.mesh()
        assert found.count == before.triangles.size == 36
        corners = first.triangles.reshape(-1)
        assert (found.members["position"] == first.channels["position"][corners]).all()
        heat = np.float32(first.channels["heat"][corners]) + np.float32(step + 1)
        assert np.allclose(found.members["heat"], heat, atol=1e-6)


def test_vertices_without_a_position_are_no_mesh(studio: Studio) -> None:
    text = "material Dust { color = vec3(1) } pass Moved { capture number : float = uv.x }"
    with pytest.raises(MeshError, match="captured `position`"):
        captured(studio, text).mesh()
