"""The library's surface and lights of glTF, against formulas written after the specification.

Every model is a square that faces the viewer, lit by one light, so that each angle is known.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest

import burnish
from burnish import Texture
from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.picture import RasterRules
from burnish.targets.runner.cameras import looking
from burnish.targets.runner.meshes import plane
from burnish.targets.runner.reference import expected
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import set_up

from ..semantics.kit import Painted, at, shader
from .kit import MESH, Floats, close, columns, of, shown, unit
from .truth import truth

SIDE = 9
TEXT = """\
import std.gltf.{{MetallicRoughness, Masked, PunctualPoint, PunctualSpot}}
import std.lights.{{Directional}}


material Square : MetallicRoughness {{ }}
pass Shown : {pass_} {{ }}
rig One {{ lamp : {light} }}
"""


def middle(light: str, pass_: str = "Forward", **values: Any) -> list[float]:
    """The colour of the square's middle, at the origin, seen from (0, 0, 5)."""
    text = TEXT.format(light=light, pass_=pass_)
    compiled = burnish.compile(text, (), pass_="Shown").materials[0]
    state = set_up(compiled.instance(), plane(2), Scene(looking(eye=(0.0, 0.0, 5.0))), (SIDE, SIDE))
    state.instance.set("ambient_light", (0, 0, 0))
    state.instance.set("normal_scale", 0)  # The nearest texel to a flat normal leans a little.
    for name, value in values.items():
        state.instance.set(name.replace("lamp_", "lamp."), value)
    targets = expected(compiled.shader, state, RasterRules(state.width, state.height)).targets
    found: list[float] = targets[0][SIDE // 2, SIDE // 2].tolist()
    return found


def reflected(base: float, metallic: float, roughness: float, angle: float) -> float:
    """The light that the model reflects straight back to the viewer, of a white light at an angle.

    This is appendix B of the specification, with its factors under their names there. The light
    has an irradiance of pi, as all lights that are 1 have.
    """
    alpha = roughness**2
    f0 = 0.04 * (1 - metallic) + base * metallic
    h_dot_v = n_dot_h = math.cos(angle / 2)
    fresnel = f0 + (1 - f0) * (1 - h_dot_v) ** 5
    distribution = alpha**2 / (math.pi * (n_dot_h**2 * (alpha**2 - 1) + 1) ** 2)
    n_dot_l, n_dot_v = math.cos(angle), 1.0

    def visible(cosine: float) -> float:
        return 2 * cosine / (cosine + math.sqrt(alpha**2 + (1 - alpha**2) * cosine**2))

    shadowing = visible(n_dot_l) * visible(n_dot_v)
    specular = fresnel * distribution * shadowing / (4 * n_dot_l * n_dot_v)
    diffuse = (1 - fresnel) * base * (1 - metallic) / math.pi
    return math.pi * (diffuse + specular) * n_dot_l


@truth(
    "std.gltf.MetallicRoughness",
    "std.gltf.metallic_rough",
    "std.gltf.trowbridge_reitz",
    "std.gltf.smith",
    "std.gltf.squared",
)
@pytest.mark.parametrize(
    ("metallic", "roughness", "degrees"),
    [(0, 1, 0), (0, 0.5, 40), (1, 0.3, 20), (0.5, 0.7, 75), (1, 1, 60)],
)
def test_what_is_reflected(metallic: float, roughness: float, degrees: float) -> None:
    angle = math.radians(degrees)
    found = middle(
        "Directional", lamp_direction=(-math.sin(angle), 0, -math.cos(angle)),
        lamp_diffuse_color=(1, 1, 1), base_color=(0.8, 0.5, 0.2, 0.3), metallic=metallic,
        roughness=roughness,
    )  # fmt: skip
    wanted = [reflected(base, metallic, roughness, angle) for base in (0.8, 0.5, 0.2)]
    assert np.allclose(found, [*wanted, 1], rtol=2e-5)


@truth("std.gltf.MetallicRoughness")
def test_pictures_multiply_numbers() -> None:
    found = middle(
        "Directional", lamp_direction=(0, 0, -1), lamp_diffuse_color=(1, 1, 1),
        base_color=(1, 1, 0.5, 0.5), base_color_map=Texture.solid((0.5, 1, 1, 0.5)),
        metallic=1, roughness=0.5, metallic_roughness_map=Texture.solid((0, 0.6, 0, 1)),
        emissive=(3, 0, 2), emissive_map=Texture.solid((1, 1, 0)), is_opaque=False,
    )  # fmt: skip
    # What the textures hold, in steps of 1/255.
    half, rough = 128 / 255, 153 / 255
    wanted = [reflected(base, 0, 0.5 * rough, 0) for base in (half, 1, 0.5)]
    assert np.allclose(found, [wanted[0] + 3, wanted[1], wanted[2], 0.5 * half], rtol=2e-5)


@truth("std.gltf.MetallicRoughness")
def test_occlusion_keeps_light_from_all_around_away() -> None:
    found = middle(
        "Directional", lamp_diffuse_color=(0, 0, 0), ambient_light=(1, 1, 1), metallic=0,
        base_color=(0.5, 0.5, 0.5, 1), occlusion_map=Texture.solid((0, 1, 1)),
        occlusion_strength=0.75,
    )  # fmt: skip
    assert np.allclose(found[:3], (0.04 + 0.96 * 0.5) * 0.25, rtol=1e-6)


@truth("std.gltf.leaning")
def test_bumps_lean_as_far_as_their_scale_says() -> None:
    """A texel that leans by 45 degrees towards u; half as far, it leans by less."""
    texel = Texture.solid((1, 0.5, 1))
    values: dict[str, Any] = {
        "lamp_direction": (0, 0, -1), "lamp_diffuse_color": (1, 1, 1), "metallic": 0,
        "normal_map": texel, "base_color": (1, 1, 1, 1),
    }  # fmt: skip
    flat = middle("Directional", **(values | {"normal_scale": 0}))
    assert np.allclose(flat[0], reflected(1, 0, 1, 0), rtol=2e-5)
    leaning = [middle("Directional", **(values | {"normal_scale": s}))[0] for s in (0.5, 1)]
    assert flat[0] > leaning[0] > leaning[1] > 0.2


SLANTED: dict[str, Any] = {
    "lamp_direction": (-0.6, 0, -0.8), "lamp_diffuse_color": (1, 1, 1), "metallic": 0,
    "base_color": (1, 1, 1, 1), "normal_map": Texture.solid((0.8, 0.5, 1)), "normal_scale": 1,
}  # fmt: skip
"""A square with a bump that leans along u, lit from the right."""


def placed(*scale: float) -> dict[str, Any]:
    """The transform of an object that is scaled along its axes, column by column."""
    return {"object_to_world": np.diag((*scale, 1.0)).tolist()}


@truth("std.gltf.MetallicRoughness")
@pytest.mark.parametrize("scale", [(-1, 1, -1), (1, -1, -1), (1, 1, -1), (-1, -1, -1)])
def test_backs_are_lit_or_hidden(scale: tuple[float, ...]) -> None:
    """The square is turned around, or mirrored, so that its back is seen.

    Its bump leans as it is seen: on a back the other way than the tangent says.
    """
    assert middle("Directional", **SLANTED, **placed(*scale)) == [0, 0, 0, 0]
    leaning = SLANTED if scale[0] < 0 else {
        **SLANTED, "normal_map": Texture.solid((0.2, 0.5, 1)),
    }  # fmt: skip
    shown = middle("Directional", **SLANTED, **placed(*scale), is_two_sided=True)
    assert np.allclose(shown, middle("Directional", **leaning), rtol=0.02)
    assert shown[0] > 0.1


@truth("std.gltf.MetallicRoughness")
@pytest.mark.parametrize("scale", [(-1, 1, 1), (1, -1, 1), (-1, -1, 1), (2, 0.5, 1)])
@pytest.mark.parametrize("is_two_sided", [False, True])
def test_the_front_of_a_mirrored_mesh_is_its_front(
    scale: tuple[float, ...], is_two_sided: bool
) -> None:
    leaning = SLANTED if scale[0] > 0 else {
        **SLANTED, "normal_map": Texture.solid((0.2, 0.5, 1)),
    }  # fmt: skip
    shown = middle("Directional", **SLANTED, **placed(*scale), is_two_sided=is_two_sided)
    assert np.allclose(shown, middle("Directional", **leaning), rtol=0.02)


@truth("std.gltf.Masked")
@pytest.mark.parametrize(("alpha", "is_drawn"), [(0.3, False), (0.5, True), (0.7, True)])
def test_the_cutoff(alpha: float, is_drawn: bool) -> None:
    found = middle("Directional", "Masked", base_color=(1, 1, 1, alpha), alpha_cutoff=0.5)
    assert (found[3] > 0) == is_drawn


def value_of(slot: str, **values: Any) -> Floats:
    """A number of the glTF material, whose maps are white if nothing else is given."""
    given: dict[str, Any] = {"vertex_tangent": (1.0, 0.0, 0.0, 1.0)}
    imports = "import std.gltf.{MetallicRoughness}"
    return of(slot, "M : MetallicRoughness", imports, **given | values)


@truth("std.gltf.MetallicRoughness")
@pytest.mark.parametrize(
    ("roughness", "green", "width"), [(0.5, 0.6, 0.09), (0.0, 1.0, 0.002025), (1.0, 0.04, 0.002025)]
)
def test_no_surface_is_so_smooth_that_highlights_vanish(
    roughness: float, green: float, width: float
) -> None:
    """The square of the roughness, which is 0.045 at least."""
    painted = Painted(lambda _u, _v: (0.0, green, 0.0, 1.0))
    found = value_of("width", roughness=roughness, metallic_roughness_map=painted)
    assert found == close([width] * 3)


@truth("std.gltf.MetallicRoughness")
@pytest.mark.parametrize("hand", [1.0, -1.0])
@pytest.mark.parametrize("mirror", [1.0, -1.0])
@pytest.mark.parametrize("is_facing", [True, False])
def test_the_front_is_the_other_side_where_a_mesh_is_mirrored(
    hand: float, mirror: float, is_facing: bool
) -> None:
    """Whichever hand the axes of its textures have."""
    found = value_of(
        "float(is_front)", vertex_tangent=(1.0, 0.0, 0.0, hand), front_facing=(is_facing,),
        object_to_world=columns(np.diag((mirror, 1.0, 1.0, 1.0))),
    )  # fmt: skip
    assert found == close([float(is_facing == (mirror > 0))] * 3)


@truth("std.gltf.PaintedVertices")
def test_colours_of_vertices_multiply_the_base() -> None:
    text = (
        "import std.gltf.{MetallicRoughness, PaintedVertices}\n"
        "material M : MetallicRoughness + PaintedVertices { color = base.rgb  alpha = base.a }"
    )
    whole = shader(text)
    given: dict[str, Any] = {
        **MESH, "vertex_tangent": (1.0, 0.0, 0.0, 1.0), "base_color": (0.5, 0.8, 1.0, 0.5),
        "vertex_color": (0.5, 0.25, 1.0, 0.4), "base_color_map": Painted(lambda _u, _v: (1.0,) * 4),
    }  # fmt: skip
    found = at(whole, whole.results_of(TARGET)[0].value, given)
    assert found == close((0.25, 0.2, 1.0, 0.2))


def everywhere(base: Floats, metallic: float) -> Floats:
    """What is mirrored of even light at a right angle, and what is scattered of the rest."""
    mirrored = 0.04 * (1 - metallic) + metallic * base
    return np.asarray(mirrored + (1 - mirrored) * base * (1 - metallic))


def shaded(
    normal: Floats, light: Floats, eye: Floats, base: Floats, metallic: float, roughness: float
) -> Floats:
    """Appendix B of the specification for any directions."""
    alpha = max(roughness, 0.045) ** 2  # The library's least roughness.
    half = unit(light + eye)
    n_dot_l, n_dot_v = (max(float(normal @ each), 0.0) for each in (light, eye))
    n_dot_h, h_dot_v = (max(float(half @ each), 0.0) for each in (normal, eye))
    f0 = 0.04 * (1 - metallic) + base * metallic
    fresnel = f0 + (1 - f0) * (1 - h_dot_v) ** 5
    distribution = alpha**2 / (math.pi * (n_dot_h**2 * (alpha**2 - 1) + 1) ** 2)

    def visible(cosine: float) -> float:
        return 1 / (cosine + math.sqrt(alpha**2 + (1 - alpha**2) * cosine**2))

    specular = fresnel * distribution * visible(n_dot_l) * visible(n_dot_v)
    found = (1 - fresnel) * base * (1 - metallic) / math.pi + specular
    return np.asarray(math.pi * found * n_dot_l)


BASE = np.array((0.8, 0.5, 0.2))


@truth("std.gltf.smith", "std.gltf.trowbridge_reitz", "std.gltf.squared")
@pytest.mark.parametrize(("cosine", "width"), [(0.4, 0.3), (0.95, 0.05), (0.1, 1.0)])
def test_facets_after_trowbridge_and_reitz(cosine: float, width: float) -> None:
    """Walter 2007, equations 33 and 34; `smith` is the latter over twice the cosine."""
    tangent = math.sqrt(1 - cosine**2) / cosine
    density = width**2 / (math.pi * cosine**4 * (width**2 + tangent**2) ** 2)
    unmasked = 2 / (1 + math.sqrt(1 + width**2 * tangent**2))
    call = f"trowbridge_reitz({cosine}, {width}), smith({cosine}, {width}), squared({width})"
    found = of(call, "M", "import std.gltf.{smith, squared, trowbridge_reitz}")
    assert found == close((density, unmasked / (2 * cosine), width**2))


@truth("std.gltf.MetallicRoughness", "std.gltf.metallic_rough")
@pytest.mark.parametrize("degrees", [20, 60, 80, 86])
def test_a_surface_seen_and_lit_from_the_side(degrees: float) -> None:
    """Each map is read where the mesh says; the light comes from the other side."""
    angle, uv = math.radians(degrees), (0.3, 0.8)
    eye = np.array((math.sin(angle), 0.0, math.cos(angle)))
    light = unit((-math.sin(angle), 0.1, math.cos(angle)))

    def painted(*lanes: float) -> Painted:
        """A map that has these colours there, and others elsewhere."""
        return Painted(lambda u, v: tuple(lane * u * v / (uv[0] * uv[1]) for lane in lanes))

    text = (
        "import std.gltf.{MetallicRoughness}\nimport std.lights.{Directional}\n"
        "material M : MetallicRoughness { }\nrig R { lamp : Directional }"
    )
    found = shown(
        text, vertex_position=(0.0, 0.0, 0.0), vertex_normal=(0.0, 0.0, 1.0), vertex_uv=uv,
        vertex_tangent=(1.0, 0.0, 0.0, 1.0), object_to_world=columns(np.eye(4)),
        eye=tuple(map(float, 3 * eye)), front_facing=(True,), ambient_light=(0.3, 0.2, 0.1),
        base_color_map=painted(*BASE, 1.0), metallic_roughness_map=painted(0.0, 0.6, 0.4, 1.0),
        normal_map=painted(0.5, 0.5, 1.0, 1.0), occlusion_map=painted(0.7, 0.0, 0.0, 1.0),
        emissive_map=painted(0.1, 0.2, 0.3, 1.0), emissive=(1.0, 2.0, 3.0),
        **{"lamp.direction": tuple(map(float, -light))},
    )  # fmt: skip
    wanted = shaded(np.array((0.0, 0.0, 1.0)), light, eye, BASE, 0.4, 0.6)
    wanted += 0.7 * np.array((0.3, 0.2, 0.1)) * everywhere(BASE, 0.4) + (0.1, 0.4, 0.9)
    assert found == close(wanted)


@truth("std.gltf.MetallicRoughness", "std.gltf.metallic_rough", "std.gltf.leaning")
@pytest.mark.parametrize(
    ("towards", "roughness", "scale", "blue"),
    [
        ((0.6, 0.0, 0.8), 0.5, 1.0, 230),
        ((-0.3, 0.5, 0.8), 0.0, 0.5, 230),  # as smooth as it can be
        ((0.9, 0.1, 0.1), 0.7, -2.0, 230),
        ((-0.8, 0.2, -0.6), 0.7, 1.0, 230),  # from behind
        ((0.95, 0.0, 0.3), 0.7, 1.0, 50),  # The map bends the normal away from the eye.
    ],
)
def test_a_bent_surface(
    towards: tuple[float, ...], roughness: float, scale: float, blue: int
) -> None:
    """The square is in the plane of x and y, so its axes are those of the world."""
    texel, rough, metal, occluded = (204, 102, blue), 178, 128, 51
    light = unit(towards)
    found = middle(
        "Directional", lamp_direction=tuple(-light), lamp_diffuse_color=(0.5, 2, 1.5),
        base_color=(*BASE, 1), base_color_map=Texture.solid((0.4, 1, 0.6)), metallic=0.75,
        roughness=roughness, normal_scale=scale,
        normal_map=Texture.solid(tuple(lane / 255 for lane in texel)),
        metallic_roughness_map=Texture.solid((0, rough / 255, metal / 255, 1)),
        occlusion_map=Texture.solid((occluded / 255, 1, 1)), occlusion_strength=0.5,
        ambient_light=(0.1, 0.2, 0.4), emissive=(0.5, 0.25, 1),
        emissive_map=Texture.solid((0.4, 0, 1)),
    )  # fmt: skip
    lean = 2 * np.array(texel) / 255 - 1
    normal = unit(lean * (scale, scale, 1))
    metallic, base = 0.75 * metal / 255, BASE * (0.4, 1, 0.6)
    wanted = shaded(normal, light, np.array((0, 0, 1.0)), base, metallic, roughness * rough / 255)
    wanted *= (0.5, 2, 1.5)
    occlusion = 0.5 + 0.5 * occluded / 255
    wanted += occlusion * np.array((0.1, 0.2, 0.4)) * everywhere(base, metallic) + (0.2, 0, 1)
    assert np.allclose(found[:3], wanted, rtol=2e-5)
