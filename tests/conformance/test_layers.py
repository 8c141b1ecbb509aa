"""Layers of render targets: one draw to all of them, and a draw for each, give the same pictures.

Both forms are drawn by each driver with a geometry stage, with numbers that need no rounding, and
compared to the last bit. What the picture of a layer has to be is computed directly as well.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.documents.drawing import LayersRow
from burnish.compiler.ir import build
from burnish.compiler.ir.types import BOOL
from burnish.compiler.passes import lower_expansion
from burnish.compiler.reference.picture import RasterRules
from burnish.compiler.semantics.shading import elaborate
from burnish.compiler.semantics.shading.passes.layers import layer_of
from burnish.support.frozen import changed
from burnish.targets.runner import binding
from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.reference import expected
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene import Scene, with_inputs
from burnish.targets.runner.scene_state import SceneState, set_up

from .kit import Floats, Studio
from .planted.planting import Plant, form, replaced

ON = ("lavapipe:glsl", "lavapipe:hlsl-glslang", "lavapipe:hlsl-dxc", "llvmpipe:gl330",
      "llvmpipe:gl450")  # fmt: skip
"""The routes with a geometry stage."""
LOWERED = ("lavapipe:glsl", "lavapipe:hlsl-dxc", "lavapipe:wgsl-naga")
PROFILES = tuple(sorted({ROUTES[name].profile for name in (*ON, *LOWERED)}))
NATIVE = tuple(sorted({ROUTES[name].profile for name in ON}))
WIDTH, HEIGHT, COUNT = 32, 16, 5
CLEAR = (9.0, 9.0, 9.0, 9.0)

TEXT = """
material M {
    clip_position = vec4(0.75 * position.xy, 0.5 - 0.25 * position.z, 1)
}
pass P {
    layers of 5
    param first : int in -4..4 = 0
    layer  : int
    mark   : float = 0
    second : vec2 = vec2(0)

    target one : rgba32f = vec4(mark, uv.x, float(layer), 1)
    target two : rg32f   = vec2(uv.y, float(primitive_index))

    expand triangle {
        strip of 3 as i for s in 0..3 where corner[0].position.x < 0.4 {
            layer    = first + 2 * s
            mark     = float(s)
            position = inherited.position + vec3(0.125, 0, 0.25) * float(s)
        }
        list of 3 as i {
            layer    = int(primitive_index mod 2u)
            mark     = 8
            position = 0.5 * inherited.position
        }
    }
}
"""


def compiled(*, native: bool) -> CompiledMaterial:
    profiles = NATIVE if native else PROFILES
    (material,) = burnish.compile(TEXT, profiles, pass_="P", native_stages=native).materials
    return material


def state_of(material: CompiledMaterial, first: int = 0) -> SceneState:
    """A plane whose vertices have coordinates that are multiples of a half."""
    mesh = with_inputs(material.reflection, plane(4))
    state = set_up(material.instance(), mesh, Scene(), (WIDTH, HEIGHT), CLEAR)
    state.instance.set("first", first)
    return state


def drawn_both(studio: Studio, route: str, first: int = 0) -> tuple[Floats, Floats]:
    """The first target as one draw to all layers, and as a draw for each."""
    pictures = []
    for native in (True, False):
        material = compiled(native=native)
        pictures.append(studio.draw(route, material, state_of(material, first))[0])
    return pictures[0], pictures[1]


def by_layer(picture: Floats) -> Floats:
    return picture.reshape(COUNT, HEIGHT, WIDTH, 4)


@pytest.mark.parametrize("first", [0, 2, -4])
@pytest.mark.parametrize("route", ON)
def test_both_forms_are_one_picture(studio: Studio, route: str, first: int) -> None:
    """With 2 and -4, some layers are not there: the nearest one counts."""
    found, expected = drawn_both(studio, route, first)
    assert found.shape == (COUNT * HEIGHT, WIDTH, 4)
    assert (found == expected).all()
    nearest = {min(max(first + 2 * s, 0), COUNT - 1) for s in range(3)} | {0, 1}
    drawn = {k for k, layer in enumerate(by_layer(expected)) if (layer != CLEAR).any()}
    assert drawn == nearest


@pytest.mark.parametrize("route", LOWERED)
def test_all_targets_are_as_the_reference_has_them(studio: Studio, route: str) -> None:
    material = compiled(native=False)
    state = state_of(material)
    wanted = expected(material.shader, state, RasterRules(state.width, state.height)).targets
    found = studio.draw(route, material, state)
    assert len(found) == len(wanted) == 2
    for one, other in zip(found, wanted, strict=True):
        assert one.shape == other.shape == (COUNT * HEIGHT, WIDTH, 4)
        assert np.allclose(one, other, atol=1e-5)


@pytest.mark.parametrize("native", [True, False])
def test_each_strip_is_in_its_layer_alone(studio: Studio, native: bool) -> None:
    """Each pixel shows the number of the strip that drew it, which also tells its layer."""
    material = compiled(native=native)
    one, _two = studio.draw("lavapipe:glsl", material, state_of(material))
    for number, layer in enumerate(by_layer(one)):
        seen = layer[(layer != CLEAR).any(axis=-1)]
        assert (seen[:, 2] == number).all()
        assert set(np.unique(seen[:, 0])) <= {number / 2, 8.0}
        assert len(seen) > 20 or number == 3


def test_a_host_draws_the_layers_one_by_one() -> None:
    """The reflection is enough: each draw differs from the others in one parameter."""
    material = compiled(native=False)
    assert material.reflection.draw.layers == LayersRow(
        count=COUNT, parameter="draw.layer", view_mask=None
    )
    assert len({layer.draw().blocks for layer in state_of(material).layers}) == COUNT
    native = compiled(native=True)
    assert native.reflection.draw.layers == LayersRow(count=COUNT, parameter=None, view_mask=None)
    assert state_of(native).layers == ()


_draws = SceneState.draws


def _turned(state: SceneState) -> tuple[Draw, ...]:
    """The draws of the layers, the last one first."""
    return _draws(state)[::-1]


def _first_only(state: SceneState) -> tuple[Draw, ...]:
    """The first layer in place of all."""
    return (_draws(state)[0],) * COUNT


PLANTED = {
    "all strips in the first layer": form("glsl", deliver_layer="gl_Layer = 0;"),
    "layers count from one": form("glsl", deliver_layer="gl_Layer = min({value} + 1, 4);"),
    "the layer is not told": form("glsl", deliver_layer="// {value}"),
    "layers in another order": replaced(SceneState, "draws", _turned),
    "one layer for all": replaced(SceneState, "draws", _first_only),
    "strips of all layers in each": replaced(
        lower_expansion._Lowering, "_is_drawn",
        lambda lowering, _layer: build.constant(lowering._graph, BOOL, True),
    ),
    "a layer that is not there is not the nearest": replaced(
        elaborate, "layer_of",
        lambda *given: (
            changed(result, value=result.value.operands[0])
            for result in layer_of(*given)
        ),
    ),
    "targets without layers": replaced(binding, "_layers", lambda _row: 0),
}  # fmt: skip


@pytest.mark.parametrize("plant", PLANTED.values(), ids=PLANTED)
def test_the_comparison_shows_what_is_wrong(
    studio: Studio, plant: Plant, monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    with monkeypatch.context() as patch:
        plant(patch, tmp_path)
        found, expected = drawn_both(studio, "lavapipe:glsl", -4)
    assert found.shape != expected.shape or (found != expected).any()
