"""Surfaces of glTF files with extensions, in `std.gltf_layers`, against the specifications.

Each texture is painted with numbers without a pattern, and read where its place says.
"""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from burnish.compiler.reference.namespace import Lanes

from ..semantics.kit import Painted
from .kit import NORMAL_IN_WORLD, Floats, close, lanes, shown, unit
from .surfaces import ACROSS, ALONG, TANGENT
from .truth import truth

UV, UV2 = np.array((0.3, 0.8)), np.array((0.65, 0.15))
MIXINS = (
    "Anisotropy", "Clearcoat", "Dispersion", "Ior", "Iridescence", "Sheen", "Specular",
    "Transmission", "Unlit", "Volume",
)  # fmt: skip


def painted(u: float, v: float) -> Lanes:
    """A picture whose channels differ everywhere."""
    return (0.2 + 0.5 * u, 0.9 - 0.4 * v, 0.3 + 0.2 * u * v, 0.8 - 0.1 * u - 0.3 * v)


PICTURE = Painted(painted)
WHITE, FLAT = Painted(lambda _u, _v: (1.0,) * 4), Painted(lambda _u, _v: (0.5, 0.5, 1.0, 1.0))
PLACE = (1, (0.1, -0.2), 0.7, (0.5, 1.5))


def texel(place: Any = None) -> Floats:
    """The texel that is read, by the matrices of `KHR_texture_transform`: coordinates turn against
    the clock, where v points downwards."""
    set_, offset, turn, scale = place or (0, (0, 0), 0, (1, 1))
    cos, sin = np.cos(turn), np.sin(turn)
    at = np.array(((cos, sin), (-sin, cos))) @ ((UV, UV2)[set_] * scale) + offset
    return np.array(painted(*at))


def found(quantity: str, mixin: str = "", members: str = "", /, **given: Any) -> Floats:
    """A quantity of a material of a file with an extension."""
    chain = f"FileSurface + {mixin}" if mixin else "FileSurface"
    values: dict[str, Any] = {
        "vertex_uv": lanes(UV), "vertex_uv2": lanes(UV2), "front_facing": (True,),
        "vertex_tangent": (*lanes(TANGENT), 1.0), "base_color_map": WHITE, "emissive_map": WHITE,
        "metallic_roughness_map": WHITE, "occlusion_map": WHITE, "normal_map": FLAT, **given,
    }  # fmt: skip
    return shown(
        f"import std.gltf_layers.{{FileSurface, {', '.join(MIXINS)}}}\n"
        f"material M : {chain} {{ {members} color = vec3({quantity}) }}",
        **{name: value if isinstance(value, tuple | Painted) else (value,)
           for name, value in values.items()},
    )  # fmt: skip


@truth("std.gltf_layers.placed", "std.gltf_layers.TexturePlace", "std.gltf_layers.in_place")
@pytest.mark.parametrize("place", [None, PLACE, (0, (0.1, 0.3), -0.4, (1.0, 2.0))])
def test_textures_have_a_place(place: Any) -> None:
    given = {} if place is None else {"base_color_place": place}
    read = found("base.rgb", base_color_map=PICTURE, **given)
    assert read == close(texel(place)[:3])


CORE: dict[str, tuple[str, dict[str, Any], Any]] = {
    "base_color": ("base_color", {"base_color_factor": (0.5, 0.25, 1.0, 0.4)},
                   lambda t: t[:3] * (0.5, 0.25, 1)),
    "metallic_roughness": ("metallic, roughness, base.a",
                           {"metallic_factor": 0.5, "roughness_factor": 0.25,
                            "base_color_factor": (1.0, 1.0, 1.0, 0.4)},
                           lambda t: (0.5 * t[2], 0.25 * t[1], 0.4)),
    "occlusion": ("occlusion", {"occlusion_strength": 0.25}, lambda t: (0.75 + 0.25 * t[0],) * 3),
    "emissive": ("emissive", {"emissive_factor": (1.0, 0.5, 2.0)}, lambda t: t[:3] * (1, 0.5, 2)),
}  # fmt: skip


@truth("std.gltf_layers.FileSurface", "std.gltf_layers.LayeredSurface")
@pytest.mark.parametrize("name", CORE)
@pytest.mark.parametrize("place", [None, PLACE])
def test_what_a_file_says_without_extensions(name: str, place: Any) -> None:
    quantity, given, wanted = CORE[name]
    maps = {f"{name}_map": PICTURE, f"{name}_place": place or (0, (0.0, 0.0), 0.0, (1.0, 1.0))}
    assert found(quantity, **given, **maps) == close(wanted(texel(place)))


LAYERS: dict[str, tuple[str, str, dict[str, Any], Any]] = {
    "clearcoat": ("Clearcoat", "clearcoat", {"clearcoat_factor": 0.5}, lambda t: 0.5 * t[0]),
    "clearcoat_roughness": ("Clearcoat", "clearcoat_roughness",
                            {"clearcoat_roughness_factor": 0.5}, lambda t: 0.5 * t[1]),
    "iridescence": ("Iridescence", "iridescence", {"iridescence_factor": 0.5},
                    lambda t: 0.5 * t[0]),
    "iridescence_thickness": (
        "Iridescence", "iridescence_thickness",
        {"iridescence_thickness_minimum": 700.0, "iridescence_thickness_maximum": 300.0},
        lambda t: 700 - 400 * t[1],
    ),
    "sheen_color": ("Sheen", "sheen_color", {"sheen_color_factor": (0.5, 0.25, 0.75)},
                    lambda t: t[:3] * (0.5, 0.25, 0.75)),
    "sheen_roughness": ("Sheen", "sheen_roughness", {"sheen_roughness_factor": 0.5},
                        lambda t: 0.5 * t[3]),
    "specular": ("Specular", "specular", {"specular_factor": 0.5}, lambda t: 0.5 * t[3]),
    "specular_color": ("Specular", "specular_color", {"specular_color_factor": (0.5, 2.0, 1.5)},
                       lambda t: t[:3] * (0.5, 2, 1.5)),
    "transmission": ("Transmission", "transmission", {"transmission_factor": 0.5},
                     lambda t: 0.5 * t[0]),
    "thickness": ("Volume", "thickness", {"thickness_factor": 3.0}, lambda t: 3 * t[1]),
    "anisotropy": ("Anisotropy", "anisotropy_strength", {"anisotropy_factor": 0.5},
                   lambda t: 0.5 * t[2]),
}  # fmt: skip


@truth(
    "std.gltf_layers.Anisotropy", "std.gltf_layers.Clearcoat", "std.gltf_layers.Iridescence",
    "std.gltf_layers.Sheen", "std.gltf_layers.Specular", "std.gltf_layers.Transmission",
    "std.gltf_layers.Volume",
)  # fmt: skip
@pytest.mark.parametrize("name", LAYERS)
@pytest.mark.parametrize("place", [None, PLACE])
def test_textures_of_extensions(name: str, place: Any) -> None:
    mixin, quantity, given, wanted = LAYERS[name]
    maps = {f"{name}_map": PICTURE, f"{name}_place": place or (0, (0.0, 0.0), 0.0, (1.0, 1.0))}
    expected = np.broadcast_to(wanted(texel(place)), 3)
    assert found(quantity, mixin, **given, **maps) == close(expected)


@truth("std.gltf_layers.Dispersion", "std.gltf_layers.Ior", "std.gltf_layers.Iridescence",
       "std.gltf_layers.Volume")  # fmt: skip
def test_numbers_of_extensions() -> None:
    assert found("dispersion", "Dispersion", dispersion=0.3) == close((0.3,) * 3)
    assert found("ior", "Ior", ior=1.7) == close((1.7,) * 3)
    assert found("iridescence_ior", "Iridescence", iridescence_ior=1.7) == close((1.7,) * 3)
    volume = {"attenuation_color": (0.3, 0.2, 0.1), "attenuation_distance": 3.0}
    assert found("attenuation_color", "Volume", **volume) == close((0.3, 0.2, 0.1))
    assert found("attenuation_distance", "Volume", **volume) == close((3.0,) * 3)


@truth("std.gltf_layers.Anisotropy")
@pytest.mark.parametrize("is_painted", [False, True])
def test_the_direction_of_the_anisotropy(is_painted: bool) -> None:
    """It turns from the tangent to the bitangent; a texture has directions of any length."""
    quantity = "anisotropy_direction.x, anisotropy_direction.y, 0"
    direction = found(quantity, "Anisotropy", anisotropy_map=PICTURE, anisotropy_rotation=0.6,
                      has_anisotropy_map=is_painted)  # fmt: skip
    x, y = unit(2 * texel()[:2] - 1) if is_painted else (1.0, 0.0)
    cos, sin = np.cos(0.6), np.sin(0.6)
    assert direction == close((cos * x - sin * y, sin * x + cos * y, 0))


def bent(scale: float, read: Floats) -> Floats:
    """The normal that a normal map means (glTF 2.0, section 3.9.3)."""
    x, y, z = (2 * read[:3] - 1) * (scale, scale, 1)
    return unit(x * ALONG + y * ACROSS + z * NORMAL_IN_WORLD)


@truth("std.gltf_layers.FileSurface", "std.gltf_layers.bent_by")
@pytest.mark.parametrize("is_front", [False, True])
def test_bumps_lean_towards_the_side_that_is_seen(is_front: bool) -> None:
    given: Any = {"normal_map": PICTURE, "normal_place": PLACE, "normal_scale": 0.6,
                  "front_facing": is_front}  # fmt: skip
    side = 1 if is_front else -1
    assert found("normal", **given) == close(side * bent(0.6, texel(PLACE)))
    assert found("clearcoat_normal", **given) == close(side * NORMAL_IN_WORLD)


@truth("std.gltf_layers.Clearcoat", "std.gltf_layers.bent_by")
@pytest.mark.parametrize("is_front", [False, True])
def test_a_coat_has_bumps_of_its_own(is_front: bool) -> None:
    given: Any = {"clearcoat_normal_map": PICTURE, "clearcoat_normal_scale": 0.6,
                  "clearcoat_normal_place": PLACE, "front_facing": is_front}  # fmt: skip
    side = 1 if is_front else -1
    assert found("clearcoat_normal", "Clearcoat", **given) == close(side * bent(0.6, texel(PLACE)))
    assert found("normal", "Clearcoat", **given) == close(side * NORMAL_IN_WORLD)


@truth("std.gltf_layers.FileSurface")
@pytest.mark.parametrize("is_opaque", [False, True])
def test_alpha_counts_unless_a_file_says_that_it_is_opaque(is_opaque: bool) -> None:
    factor = {"base_color_factor": (1.0, 1.0, 1.0, 0.4), "is_opaque": is_opaque}
    wanted = 1 if is_opaque else 0.4 * texel()[3]
    assert found("alpha", base_color_map=PICTURE, **factor) == close((wanted,) * 3)


HIDDEN = "if is_hidden then 1 else 0"
MIRROR = tuple(map(tuple, np.diag((-1.0, 1.0, 1.0, 1.0)).tolist()))


@truth("std.gltf_layers.FileSurface")
@pytest.mark.parametrize("is_front", [False, True])
@pytest.mark.parametrize("is_mirrored", [False, True])
@pytest.mark.parametrize("is_two_sided", [False, True])
def test_backs_are_hidden(is_front: bool, is_mirrored: bool, is_two_sided: bool) -> None:
    """The front of a mirrored mesh is the side that runs with the clock."""
    placed = {"object_to_world": MIRROR} if is_mirrored else {}
    shown_as = is_front != is_mirrored
    given: Any = {"front_facing": shown_as, "is_two_sided": is_two_sided, **placed}
    assert found(HIDDEN, **given)[0] == (not is_front and not is_two_sided)


@truth("std.gltf_layers.Volume")
@pytest.mark.parametrize("thickness", [0.0, 0.5])
@pytest.mark.parametrize("is_front", [False, True])
@pytest.mark.parametrize("is_two_sided", [False, True])
def test_the_border_of_a_medium_has_one_side(
    thickness: float, is_front: bool, is_two_sided: bool
) -> None:
    """`KHR_materials_volume`: `doubleSided` has no effect on it."""
    given: Any = {"thickness_factor": thickness, "front_facing": is_front,
                  "is_two_sided": is_two_sided}  # fmt: skip
    hidden = not is_front and (thickness > 0 or not is_two_sided)
    assert found(HIDDEN, "Volume", **given)[0] == hidden


@truth("std.gltf_layers.Unlit", "std.gltf_layers.UnlitSurface")
@pytest.mark.parametrize("is_unlit", [False, True])
def test_an_unlit_surface_is_its_base_colour(is_unlit: bool) -> None:
    given: Any = {"base_color_factor": (0.5, 0.25, 1.0, 1.0), "ambient_light": (0.0, 0.0, 0.0),
                  "emissive_factor": (0.1, 0.2, 0.3), "sun.diffuse_color": (0.0, 0.0, 0.0),
                  "sun.specular_color": (0.0, 0.0, 0.0)}  # fmt: skip
    color = found("inherited.color", "Unlit", is_unlit=is_unlit, **given)
    assert color == close((0.5, 0.25, 1) if is_unlit else (0.1, 0.2, 0.3))
