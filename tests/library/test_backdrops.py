"""What is seen through glass, in `std.backdrops`."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np
import pytest

from burnish.compiler.reference.namespace import Lanes

from .kit import (
    CLIP,
    NORMAL,
    NORMAL_IN_WORLD,
    POSITION_IN_WORLD,
    TO_EYE,
    WORLD,
    Floats,
    close,
    facets,
    lanes,
    mirrored_by,
    shown,
    unit,
)
from .surfaces import COAT_NORMAL, TANGENT, all_bounces, fifth, parts, written
from .test_around import around
from .test_gltf_surface import sheen_share
from .test_image_light import Around, light_of, matt_samples
from .truth import truth

GLASS = "metallic = 0  transmission = 1  thickness = 0.3  ior = 1.8  dispersion = 4"
IORS = (1.72, 1.8, 1.88)
"""Half of the spread is 0.4 times 4 over 20."""


def seen(
    mixin: str, knobs: str, roughness: float, /, light: str = "light_behind", **given: object
) -> Floats:
    """A light of a surface: usually what is seen through it."""
    return shown(
        f"import std.backdrops.{{{mixin}}}\nimport std.models.{{GltfSurface}}\n"
        f"material M : GltfSurface + {mixin} {{ {knobs}  roughness = {roughness}\n"
        f"color = {light} }}",
        vertex_tangent=(*lanes(TANGENT), 1.0), **given,
    )  # fmt: skip


def bent(ior: float) -> Floats:
    """The way of light below the surface, after Snell."""
    nv = NORMAL_IN_WORLD @ TO_EYE
    inside = np.sqrt(1 - (1 - nv**2) / ior**2)
    return np.asarray((nv * NORMAL_IN_WORLD - TO_EYE) / ior - inside * NORMAL_IN_WORLD)


def glossy(axis: Floats, width: float) -> Floats:
    """The light that facets of this width gather around a direction."""
    local = mirrored_by(facets(16, width))
    weights = np.maximum(local[:, 2], 0)[:, None]
    return np.asarray((weights * light_of(around(axis, local))).sum(axis=0) / weights.sum())


def mirrored(normal: Floats) -> Floats:
    return np.asarray(2 * (normal @ TO_EYE) * normal - TO_EYE)


@truth("std.backdrops.CubeAround", "std.backdrops.InCube", "std.backdrops.mirrored_by")
def test_each_layer_mirrors_its_surroundings() -> None:
    """A coat over cloth over plastic, as they share light that is the same everywhere; but each
    gets the light of its own directions."""
    knobs = {
        "metallic": 0.4, "base_color": (0.5, 0.1, 0.3), "clearcoat": 0.8, "occlusion": 0.7,
        "clearcoat_roughness": 0.3, "clearcoat_normal": COAT_NORMAL, "transmission": 0.25,
        "sheen_color": (0.3, 0.6, 0.2), "sheen_roughness": 0.5,
    }  # fmt: skip
    written_knobs = "  ".join(f"{name} = {written(value)}" for name, value in knobs.items())
    found = seen("CubeAround", written_knobs, 0.6, "even_light", surroundings=Around())

    base, sheen = np.array((0.5, 0.1, 0.3)), np.array((0.3, 0.6, 0.2))
    nv = float(NORMAL_IN_WORLD @ TO_EYE)
    share = parts(nv, 0.36)
    clear, metal = all_bounces(np.full(3, 0.04), share), all_bounces(base, share)
    coat = 0.8 * (0.04 + 0.96 * fifth(float(COAT_NORMAL @ TO_EYE)))
    fibres = sheen_share(nv, 0.25)
    matt = light_of(around(NORMAL_IN_WORLD, matt_samples())).mean(axis=0)
    gloss = glossy(mirrored(NORMAL_IN_WORLD), 0.36)
    plastic = clear * gloss + (1 - clear.max()) * base * 0.75 * matt
    body = plastic + 0.4 * (metal * gloss - plastic)
    below = sheen * fibres * matt + (1 - 0.6 * fibres) * body
    wanted = coat * glossy(mirrored(COAT_NORMAL), 0.09) + (1 - coat) * below
    assert found == pytest.approx(0.7 * wanted, rel=2e-6)


@truth("std.backdrops.CubeAround", "std.backdrops.seen_in_cube")
def test_each_colour_is_seen_in_its_own_direction() -> None:
    cube = Around()
    found = seen("CubeAround", GLASS, 0.6, surroundings=cube)
    for color, ior in enumerate(IORS):
        assert found[color] == close(glossy(bent(ior), 0.36)[color])


@truth("std.backdrops.CubeAround", "std.backdrops.seen_in_cube")
def test_without_dispersion_all_colours_are_seen_in_one() -> None:
    cube = Around()
    found = seen("CubeAround", "ior = 1.5", 0.0, surroundings=cube)
    assert found == pytest.approx(light_of(-TO_EYE), abs=2e-4)
    assert len(set(cube.reads)) == 16


@dataclass
class Behind:
    """A picture whose light grows to the right and downwards, and which notes where it is read."""

    reads: list[tuple[Lanes, float]] = field(default_factory=list)

    def read(self, _name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of a read."""
        (x, y), (level,) = operands
        self.reads.append(((float(x), float(y)), float(level)))
        return (x, y, x + y, 1.0)


@truth(
    "std.backdrops.PictureBehind", "std.backdrops.BeforePicture", "std.backdrops.seen_in_picture"
)
@pytest.mark.parametrize(("roughness", "levels"), [(0.5, 8), (0.25, 5)])
def test_a_picture_is_read_where_the_ways_end(roughness: float, levels: int) -> None:
    """As the camera shows that point; the depth of the mesh grows with the object."""
    picture = Behind()
    found = seen("PictureBehind", GLASS, roughness, behind=picture, behind_levels=(levels,))
    depth = 0.3 * np.linalg.norm(WORLD[:3, :3] @ unit(NORMAL))
    places = []
    for ior in IORS:
        at = CLIP @ np.append(POSITION_IN_WORLD + depth * bent(ior), 1)
        places.append((0.5 + 0.5 * at[0] / at[3], 0.5 - 0.5 * at[1] / at[3]))
    assert found == close((places[0][0], places[1][1], sum(places[2])))
    assert {level for _, level in picture.reads} == {roughness * (levels - 1)}


@truth("std.backdrops.PictureBehind")
def test_a_thin_wall_shows_what_is_behind_the_pixel() -> None:
    picture = Behind()
    seen("PictureBehind", "ior = 1.5", 0.0, behind=picture)
    at = CLIP @ np.append(POSITION_IN_WORLD, 1)
    ((place, level),) = set(picture.reads)
    assert place == close((0.5 + 0.5 * at[0] / at[3], 0.5 - 0.5 * at[1] / at[3]))
    assert level == 0
