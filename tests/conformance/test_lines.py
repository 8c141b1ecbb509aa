"""Lines on every driver: which pixels they cover and what is interpolated, held to the reference.

``tests/reference/test_lines.py`` has the rules. Here random lines, each in a field of the picture
of its own, are drawn by every driver, and compared with the rule that was measured of it.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import cache
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.reference.picture import RasterRules
from burnish.compiler.reference.picture import lines as lines_module
from burnish.compiler.reference.picture.scene import Bools, Lines
from burnish.targets.conformance.bounds import bounds_of
from burnish.targets.conformance.compare import Comparison, compare
from burnish.targets.conformance.drivers import DRIVERS
from burnish.targets.runner.exact import exact_shader
from burnish.targets.runner.kernels import drawable
from burnish.targets.runner.meshes import Mesh
from burnish.targets.runner.reference import expected
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import SceneState, set_up

from .kit import Floats, Studio, compiled

FIELD = 12
"""Pixels along a side."""
FIELDS = (24, 16)
SIZE = (FIELDS[0] * FIELD, FIELDS[1] * FIELD)
CLEAR = (-8.0, -8.0, -8.0, -8.0)
SHORT = 4
"""Every fourth line is shorter than about a pixel."""

MATERIAL = """
material M {
    attribute far : float
    part : int = 0
    tessellate isoline by 1 { part = int(patch_index) }
    clip_position = vec4(position, 1) * far
    color = vec3(uv, float(part))
}
"""

DRAWN_BY = (
    "lavapipe:glsl", "swiftshader:glsl", "llvmpipe:gl330", "llvmpipe:gl450", "llvmpipe:es310",
    "chromium:webgpu", "chromium:webgl2",
)  # fmt: skip
"""One route of each driver, and all of OpenGL's."""
NATIVE = ("lavapipe:glsl", "llvmpipe:gl450")


@cache
def material(*, native: bool = False) -> CompiledMaterial:
    """Lines between the ends of patches, drawn by the stages for them or as instances."""
    if not native:
        return compiled(MATERIAL)
    profiles = sorted({ROUTES[name].profile for name in NATIVE})
    return burnish.compile(MATERIAL, profiles, native_stages=True).materials[0]


def lines() -> tuple[Floats, Floats]:
    """The ends of lines in pixels, (lines, 2, 2), and clip w at each."""
    chance = np.random.default_rng(12)
    count = FIELDS[0] * FIELDS[1]
    corners = np.stack(np.meshgrid(*map(np.arange, FIELDS)), axis=-1).reshape(count, 1, 2) * FIELD
    ends = chance.uniform(2, FIELD - 2, (count, 2, 2))
    near = ends[::SHORT, 0] + chance.uniform(-1.5, 1.5, (count // SHORT, 2))
    ends[::SHORT, 1] = np.clip(near, 2, FIELD - 2)
    return ends + corners, chance.uniform(1, 4, (count, 2))


def state(of: CompiledMaterial) -> SceneState:
    """All lines, each of which is a patch."""
    ends, far = lines()
    x, y = (ends / np.array(SIZE) * 2 - 1).reshape(-1, 2).T
    depth = np.linspace(0.1, 0.9, len(x))
    channels: dict[str, Floats] = {
        "position": np.stack([x, -y, depth], axis=1).astype(np.float32).astype(np.float64),
        "uv": np.stack([np.arange(len(x)) % 2, depth], axis=1),
        "far": far.reshape(-1, 1).astype(np.float32).astype(np.float64),
    }
    none = np.zeros((0, 3), np.int64)
    mesh = Mesh(channels, none, patches=np.arange(len(x)).reshape(-1, 2))
    return set_up(of.instance(), with_inputs(of.reflection, mesh), Scene(), SIZE, CLEAR)


def comparison(
    studio: Studio, name: str, *, native: bool = False, rule: Lines | None = None
) -> Comparison:
    """A route's picture, compared with its driver's measured rule for lines, or another rule."""
    route = ROUTES[name]
    drawn, meant = material(native=native), material()
    (got,) = studio.draw(name, drawn, state(drawn))
    asked = state(meant)
    bounds = bounds_of(asked, route, studio.runner.device(route))[0]
    rules: RasterRules = bounds.rules if rule is None else replace(bounds.rules, lines=rule)
    program = exact_shader(drawable(meant.emitted(route.profile)))
    wanted = expected(program, asked, rules, bounds.errors)
    steps = [np.ones_like(target) for target in wanted.targets]
    return compare([got], wanted, wanted.targets, steps, bounds.level)


@pytest.mark.parametrize("route", DRAWN_BY)
def test_drivers_draw_lines_by_the_rule_that_was_measured(studio: Studio, route: str) -> None:
    found = comparison(studio, route)
    assert found.agrees, found
    assert found.undecided < 0.1 * found.covered
    assert found.proven > 1000


@pytest.mark.parametrize("route", NATIVE)
def test_the_stages_draw_the_same_lines(studio: Studio, route: str) -> None:
    found = comparison(studio, route, native=True)
    assert found.agrees, found
    assert found.proven > 1000


@pytest.mark.parametrize("route", DRAWN_BY)
def test_another_rule_would_show(studio: Studio, route: str) -> None:
    measured = DRIVERS[ROUTES[route].driver].measured
    assert measured is not None
    for rule in ("rectangle", "parallelogram", "diamonds"):
        if rule != measured.lines:
            assert comparison(studio, route, rule=rule).wrong > 50


@pytest.mark.parametrize("route", DRAWN_BY)
def test_any_rule_allows_what_is_drawn(studio: Studio, route: str) -> None:
    found = comparison(studio, route, rule="any")
    assert found.agrees, found
    assert found.proven > 0.2 * found.covered


# --- planted errors ------------------------------------------------------------------------------


def _longer_pixels(patch: pytest.MonkeyPatch) -> None:
    """Lines of the reference are a little too wide."""
    patch.setattr(lines_module, "_HALF", 0.55)


def _other_way(patch: pytest.MonkeyPatch) -> None:
    """A line of the reference begins where it should end."""
    patch.setattr(lines_module, "_CORNERS", [1, 0, 1])


def _sideways(patch: pytest.MonkeyPatch) -> None:
    """Values of the reference change across the line as well."""
    right = lines_module._plane

    def wrong(*asked: Any) -> tuple[Floats, Floats]:
        x, y = right(*asked)
        return x + np.array([0.0, 0.0, 0.25]), y

    patch.setattr(lines_module, "_plane", wrong)


def _turned_diamonds(patch: pytest.MonkeyPatch) -> None:
    """The reference takes the diamonds where lines begin for those where they end."""
    right = lines_module.LineFaces._by_diamonds

    def wrong(faces: lines_module.LineFaces, *asked: Any) -> tuple[Bools, Bools]:
        return right(replace(faces, begin=faces.end, end=faces.begin), *asked)

    patch.setattr(lines_module.LineFaces, "_by_diamonds", wrong)


PLANTED = {
    "lines that are too wide": ("lavapipe:glsl", _longer_pixels),
    "ends exchanged": ("lavapipe:glsl", _other_way),
    "values that change across": ("swiftshader:glsl", _sideways),
    "diamonds at the other ends": ("llvmpipe:gl330", _turned_diamonds),
}


@pytest.mark.parametrize(("route", "plant"), PLANTED.values(), ids=PLANTED)
def test_the_comparison_shows_what_is_wrong(
    studio: Studio,
    route: str,
    plant: Callable[[pytest.MonkeyPatch], None],
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    with monkeypatch.context() as patch:
        plant(patch)
        assert comparison(studio, route).wrong > 10
