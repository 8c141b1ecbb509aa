"""A page that knows WebGPU and the reflection draws what the runtime draws.

``by_hand/page.mjs`` was written after ``docs/reflection.md``. It gets the WGSL, the reflection and
a mesh, and shares no code with the runtime or with the pages of the browser's driver.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from importlib.resources import files
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.documents.writing import to_json
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.drivers.browser.chromium import Chromium
from burnish.targets.runner.frames.states import draw_states
from burnish.targets.runner.meshes import Mesh, sphere
from burnish.targets.runner.patches import patches
from burnish.targets.runner.primitives import primitives
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import SceneState, set_up

from .kit import Studio

Texels = NDArray[np.uint8]

ROUTE = ROUTES["chromium:webgpu"]
SIZE = (128, 96)
BALL = sphere(12, 8)

SPIKES = """
import std.terms.{lambert}
material Spikes {
    param length : float in 0..1 = 0.5
    param every  : uint in 1..9 = 2
    height : float = 0
    expand triangle {
        strip of 3 as i {}
        list of 9 as i
        where primitive_index mod every == 0u
        like corner[(i / 3 + i mod 3) mod 3] {
            height   = if i mod 3 == 2 then 1 else 0
            position = inherited.position + length * height * inherited.normal
        }
    }
    color = mix(#1c4f6b, #f3e9d2, height) * lambert(vec3(uv, 1))
}
"""
ROUNDED = """
import std.tessellation.{PhongTessellation}
import std.terms.{lambert}
material Rounded : Surface + PhongTessellation {
    color = lambert(vec3(uv, 1 - uv.x))
}
"""
ROUGH = """
import std.tessellation.{DisplacedQuads}
import std.terms.{lambert}
material Rough : Surface + DisplacedQuads {
    displacement = 0.25 * sin(20 * uv.x) * sin(20 * uv.y)
    color = lambert(vec3(uv, 1 - uv.x))
}
"""

CASES: Mapping[str, tuple[str, Mapping[str, object]]] = {
    "an expansion": (SPIKES, {"length": 0.75, "every": 3}),
    "triangles that are not divided": (ROUNDED, {"detail": 1}),
    "triangles with a point in the middle": (ROUNDED, {"detail": 4}),
    "triangles with a triangle in the middle": (ROUNDED, {"detail": 4.5, "roundness": 0.5}),
    "quads that are not divided": (ROUGH, {"detail": 1}),
    "quads with a point in the middle": (ROUGH, {"detail": 6}),
    "quads with a quad in the middle": (ROUGH, {"detail": 7}),
}
"""Materials with values of their parameters."""


@pytest.fixture(scope="module")
def page() -> Iterator[Chromium]:
    """A browser that has loaded the page."""
    opened = Chromium("page.mjs", files(__package__).joinpath("by_hand"))
    yield opened
    opened.close()


@pytest.mark.parametrize(("source", "values"), CASES.values(), ids=CASES)
def test_it_draws_the_same(
    studio: Studio, page: Chromium, source: str, values: Mapping[str, object]
) -> None:
    material, state = set_up_with(source, values)
    found = drawn_by_page(page, material, state, to_json(material.reflection))
    expected = drawn_by_runtime(studio, material, state)
    assert len(np.unique(expected.reshape(-1, 4), axis=0)) > 100
    # Devices may round what they encode as sRGB to either neighbour.
    assert np.abs(found.astype(int) - expected.astype(int)).max() <= 1


Reflection = dict[str, Any]


def _another_corner(reflection: Reflection) -> None:
    reflection["vertex_inputs"][0]["mesh"]["corner"] = 1


def _fewer_vertices(reflection: Reflection) -> None:
    reflection["draw"]["vertices"] -= 3


def _another_place(reflection: Reflection) -> None:
    (length,) = (row for row in reflection["parameters"] if row["name"] == "length")
    length["offset"] += 8


@pytest.mark.parametrize("mistake", [_another_corner, _fewer_vertices, _another_place])
def test_the_page_goes_by_the_reflection(
    page: Chromium, mistake: Callable[[Reflection], None]
) -> None:
    material, state = set_up_with(*CASES["an expansion"])
    reflection = to_json(material.reflection)
    right = drawn_by_page(page, material, state, reflection)
    mistake(reflection)
    assert (drawn_by_page(page, material, state, reflection) != right).any()


def set_up_with(source: str, values: Mapping[str, object]) -> tuple[CompiledMaterial, SceneState]:
    """A material, and the ball with these values."""
    (material,) = burnish.compile(source, ROUTE.profile, hoist=False).materials
    instance = material.instance()
    for name, value in values.items():
        instance.set(name, value)
    return material, set_up(instance, BALL, Scene(), SIZE)


def drawn_by_page(
    page: Chromium, material: CompiledMaterial, state: SceneState, reflection: Mapping[str, Any]
) -> Texels:
    """The page's picture of the ball, with the values of an instance."""
    width, height = SIZE
    names = [row["name"] for row in reflection["parameters"]]
    job = {
        "reflection": reflection,
        "texts": {file.name: file.text for file in material.files},
        "values": {name: state.instance.get(name) for name in names},
        "mesh": mesh_of(BALL, reflection["draw"]),
        "width": width,
        "height": height,
    }
    answer = page.call("draw", json.dumps(job))
    assert answer["errors"] == []
    return np.array(answer["texels"], np.uint8).reshape(height, width, 4)


def mesh_of(mesh: Mesh, draw: Mapping[str, Any]) -> dict[str, Any]:
    """The mesh as the page takes it."""
    divided = draw["tessellation"]
    if divided is None:
        corners = primitives(mesh, draw["primitive"])
    else:
        corners = patches(mesh, divided["kind"], draw["corners"], divided["ends"])
    return {
        "primitives": corners.tolist(),
        "attributes": {f"vertex_{name}": each.tolist() for name, each in mesh.channels.items()},
    }


def drawn_by_runtime(studio: Studio, material: CompiledMaterial, state: SceneState) -> Texels:
    """The picture of the browser's driver, in the format of the only target."""
    codes = compile_one(ROUTE, material.files, studio.toolchain)
    made = pipeline(material.reflection, ROUTE, codes)
    (outcome,) = draw_states(material, [state], ROUTE, made, studio.runner)
    return np.rint(255 * outcome.pictures[0]).astype(np.uint8)
