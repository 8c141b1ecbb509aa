"""Several views of a scene: one draw of all of them, and a draw for each, give the same pictures.

Both forms are drawn with numbers that need no rounding, and compared to the last bit. What the
picture of a view has to be is computed directly as well.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.documents.drawing import LayersRow
from burnish.compiler.passes import lower_views
from burnish.compiler.reference.picture import RasterRules
from burnish.targets.runner import binding
from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.reference import expected
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import SceneState, set_up

from .kit import Floats, Studio
from .planted.planting import Plant, replaced, supplied

NATIVE = ("lavapipe:glsl", "lavapipe:hlsl-dxc")
"""The routes on which one draw reaches several views."""
LOWERED = (*NATIVE, "lavapipe:hlsl-glslang", "lavapipe:wgsl-naga", "llvmpipe:gl330")
WIDTH, HEIGHT, COUNT = 16, 8, 3
CLEAR = (9.0, 9.0, 9.0, 9.0)

TEXT = """
material M {
    shift = float(view_index) / 4
    // The right half of the plane lies before the near plane, so that triangles are clipped.
    clip_position = vec4(0.5 * position.xy + vec2(shift, 0), 0.5 - position.x, 1)
    attribute place : vec2 per instance
}
pass P {
    views of 3
    param marks : float[3]
    target one : rgba32f = vec4(float(view_index), marks[view_index], @vertex shift, place.x)
    target two : rg32f   = vec2(if view_index == 1 then 0.5 else 0.25, uv.y)
}
"""  # fmt: skip


def compiled(*routes: str, native: bool) -> CompiledMaterial:
    profiles = sorted({ROUTES[name].profile for name in routes})
    (material,) = burnish.compile(TEXT, profiles, pass_="P", native_stages=native).materials
    return material


def state_of(material: CompiledMaterial) -> SceneState:
    """A plane whose vertices have coordinates that are multiples of a half."""
    mesh = with_inputs(material.reflection, plane(4))
    state = set_up(material.instance(), mesh, Scene(), (WIDTH, HEIGHT), CLEAR)
    state.instance.set("marks", [4.0, 2.0, 8.0])
    return state


def drawn(studio: Studio, route: str, *, native: bool) -> tuple[Floats, ...]:
    material = compiled(route, native=native)
    return studio.draw(route, material, state_of(material))


def by_view(picture: Floats) -> Floats:
    return picture.reshape(COUNT, HEIGHT, WIDTH, 4)


@pytest.mark.parametrize("route", NATIVE)
def test_both_forms_are_one_picture(studio: Studio, route: str) -> None:
    found, wanted = (drawn(studio, route, native=native) for native in (True, False))
    for one, other in zip(found, wanted, strict=True):
        assert one.shape == (COUNT * HEIGHT, WIDTH, 4)
        assert (one == other).all()


@pytest.mark.parametrize("route", LOWERED)
def test_all_targets_are_as_the_reference_has_them(studio: Studio, route: str) -> None:
    material = compiled(route, native=False)
    state = state_of(material)
    wanted = expected(material.shader, state, RasterRules(state.width, state.height)).targets
    for one, other in zip(studio.draw(route, material, state), wanted, strict=True):
        assert one.shape == other.shape == (COUNT * HEIGHT, WIDTH, 4)
        assert np.allclose(one, other, atol=1e-5)


@pytest.mark.parametrize("native", [True, False])
def test_each_view_is_in_its_layer(studio: Studio, native: bool) -> None:
    """The numbers of the view, from the fragments and from the vertices, and where it is drawn."""
    one, two = drawn(studio, "lavapipe:glsl", native=native)
    for number, (layer, other) in enumerate(zip(by_view(one), by_view(two), strict=True)):
        seen = (layer != CLEAR).any(axis=-1)
        assert (layer[seen][:, 0] == number).all()
        assert (layer[seen][:, 1] == (4, 2, 8)[number]).all()
        assert (layer[seen][:, 2] == number / 4).all()
        assert (other[seen][:, 0] == (0.5 if number == 1 else 0.25)).all()
        # From the left end of the plane, or where depths begin to be above 1, to the near plane.
        columns = np.nonzero(seen.any(axis=0))[0]
        assert (columns[0], columns[-1]) == (6 + 2 * number, 9 + 2 * number)


def test_a_host_is_told_of_the_views() -> None:
    """It draws them one by one, with a parameter, or all at once, with a mask."""
    lowered = compiled("lavapipe:glsl", native=False)
    assert lowered.reflection.draw.layers == LayersRow(
        count=COUNT, parameter="draw.view_index", view_mask=None
    )
    assert len({view.draw().blocks for view in state_of(lowered).layers}) == COUNT
    native = compiled("lavapipe:glsl", native=True)
    assert native.reflection.draw.layers == LayersRow(count=COUNT, parameter=None, view_mask=0b111)
    assert native.reflection.pipeline_inputs == {
        "vertex": ("view_index",), "fragment": ("view_index",),
    }  # fmt: skip
    assert state_of(native).layers == ()


_draws = SceneState.draws


def _turned(state: SceneState) -> tuple[Draw, ...]:
    """The draws of the views, the last one first."""
    return _draws(state)[::-1]


def _all_but_one(row: LayersRow | None) -> int:
    """The first and the last view, where all are drawn at once."""
    return 0b101 if row is not None and row.view_mask else 0


PLANTED = {
    "all views are the first": supplied("glsl", "view_index", "0"),
    "views count from one": supplied("glsl", "view_index", "(gl_ViewIndex + 1)"),
    "views in another order": replaced(SceneState, "draws", _turned),
    "views not told apart": replaced(lower_views, "_with_numbers", lambda shader, _number: shader),
    "a view is left out": replaced(binding, "_view_mask", _all_but_one),
}


@pytest.mark.parametrize("plant", PLANTED.values(), ids=PLANTED)
def test_the_comparison_shows_what_is_wrong(
    studio: Studio, plant: Plant, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    with monkeypatch.context() as patch:
        plant(patch, tmp_path)
        found, wanted = (drawn(studio, "lavapipe:glsl", native=n) for n in (True, False))
    assert any((one != other).any() for one, other in zip(found, wanted, strict=True))
