"""The extensions ``KHR_materials_…`` of materials in glTF files: what is read of them, what is
told, and what the mixins of ``std.gltf_layers`` draw."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from burnish.targets.runner.scenes.gltf.reading import read_gltf
from burnish.targets.runner.scenes.records import SceneError

from ..cli.kit import invoke
from .kit import Builder, Json, png, triangle
from .test_staging import base, drawn, squares

TEXEL = (51, 102, 153, 204)
NUMBERS = np.array(TEXEL) / 255
LIGHT = np.array([((lane / 255 + 0.055) / 1.055) ** 2.4 for lane in TEXEL[:3]])
"""What the texel means as a colour, which is sRGB."""

FRAME = """\
import std.gltf_layers.{{FileSurface, {mixins}}}
material Shown : FileSurface + {chain} {{ color = {color} }}
frame Shown_frame {{
    models scene
    shown = Forward(scene)
    output picture = shown.color
}}
"""


def textured(name: str, extension: Json) -> Builder:
    """A square whose material has an extension, which may name texture 0."""
    made = squares({"extensions": {f"KHR_materials_{name}": extension}})
    made.whole["images"] = [{"bufferView": made.view(png(*TEXEL))}]
    made.whole["textures"] = [{"source": 0}]
    return made


def text(mixins: str, color: str) -> str:
    """A frame that shows a quantity of a material with some mixins."""
    return FRAME.format(mixins=mixins, chain=mixins.replace(",", " +"), color=color)


PAINT = {"index": 0}
CASES: dict[str, tuple[str, str, Json, Sequence[float]]] = {
    "anisotropy": (
        "Anisotropy", "rgb(anisotropy_strength, anisotropy_direction.x, anisotropy_direction.y)",
        {"anisotropyStrength": 0.5, "anisotropyRotation": 0.5},
        (0.5, math.cos(0.5), math.sin(0.5)),
    ),
    "clearcoat": (
        "Clearcoat", "rgb(clearcoat, clearcoat_roughness, 0)",
        {"clearcoatFactor": 0.5, "clearcoatTexture": PAINT,
         "clearcoatRoughnessFactor": 0.25, "clearcoatRoughnessTexture": PAINT},
        (0.5 * NUMBERS[0], 0.25 * NUMBERS[1], 0),
    ),
    "dispersion": ("Dispersion", "rgb(dispersion)", {"dispersion": 0.25}, (0.25,) * 3),
    "ior": ("Ior", "rgb(ior / 4)", {"ior": 2}, (0.5,) * 3),
    "iridescence": (
        "Iridescence", "rgb(iridescence, iridescence_ior / 4, iridescence_thickness / 1000)",
        {"iridescenceFactor": 0.5, "iridescenceTexture": PAINT, "iridescenceIor": 2,
         "iridescenceThicknessMinimum": 200, "iridescenceThicknessMaximum": 700,
         "iridescenceThicknessTexture": PAINT},
        (0.5 * NUMBERS[0], 0.5, 0.2 + 0.5 * NUMBERS[1]),
    ),
    "sheen": (
        "Sheen", "rgb(sheen_color.r, sheen_color.b, sheen_roughness)",
        {"sheenColorFactor": [0.5, 1, 0.25], "sheenColorTexture": PAINT,
         "sheenRoughnessFactor": 0.5, "sheenRoughnessTexture": PAINT},
        (0.5 * LIGHT[0], 0.25 * LIGHT[2], 0.5 * NUMBERS[3]),
    ),
    "specular": (
        "Specular", "rgb(specular, specular_color.g, specular_color.b)",
        {"specularFactor": 0.5, "specularTexture": PAINT,
         "specularColorFactor": [1, 2, 0.5], "specularColorTexture": PAINT},
        (0.5 * NUMBERS[3], 2 * LIGHT[1], 0.5 * LIGHT[2]),
    ),
    "transmission": (
        "Transmission", "rgb(transmission)",
        {"transmissionFactor": 0.5, "transmissionTexture": PAINT}, (0.5 * NUMBERS[0],) * 3,
    ),
    "volume": (
        "Volume", "rgb(thickness, attenuation_distance, attenuation_color.g)",
        {"thicknessFactor": 0.5, "thicknessTexture": PAINT, "attenuationDistance": 0.75,
         "attenuationColor": [1, 0.125, 0]},
        (0.5 * NUMBERS[1], 0.75, 0.125),
    ),
    "an endless distance": (
        "Volume", "rgb(thickness, attenuation_distance, attenuation_color.g)",
        {"thicknessFactor": 0.5}, (0.5, 0, 1),
    ),
}  # fmt: skip


@pytest.mark.parametrize("case", CASES)
def test_numbers_and_textures_reach_the_surface(case: str, tmp_path: Path) -> None:
    """Each texture counts by the channel that the specification names, times its factor."""
    mixins, color, extension, expected = CASES[case]
    scene = textured("volume" if " " in case else case, extension)
    pixels = drawn(text(mixins, color), scene, tmp_path)
    assert pixels[6, 5, :3] == pytest.approx(expected, abs=0.003)


def test_a_texture_turns_the_anisotropy(tmp_path: Path) -> None:
    scene = textured("anisotropy", {"anisotropyStrength": 0.5, "anisotropyTexture": PAINT})
    color = "rgb(anisotropy_strength, -anisotropy_direction.x, -anisotropy_direction.y)"
    lean = 1 - 2 * NUMBERS[:2]
    pixels = drawn(text("Anisotropy", color), scene, tmp_path)
    expected = (0.5 * NUMBERS[2], *lean / np.linalg.norm(lean))
    assert pixels[6, 5, :3] == pytest.approx(expected, abs=0.003)


def test_a_coat_has_bumps_of_its_own(tmp_path: Path) -> None:
    normals = {"index": 0, "scale": 0.5}
    scene = textured("clearcoat", {"clearcoatFactor": 1, "clearcoatNormalTexture": normals})
    lean = (2 * NUMBERS[:3] - 1) * (0.5, 0.5, 1)
    lean /= np.linalg.norm(lean)
    pixels = drawn(text("Clearcoat", "rgb(0.5 + 0.5 * clearcoat_normal)"), scene, tmp_path)
    # The square has no coordinates: its tangent is any direction in its plane.
    assert pixels[6, 5, 2] == pytest.approx(0.5 + 0.5 * lean[2], abs=0.003)
    bent = np.linalg.norm(2 * pixels[6, 5, :2] - 1)
    assert bent == pytest.approx(np.linalg.norm(lean[:2]), abs=0.01)


def test_an_unlit_material_is_its_base_colour(tmp_path: Path) -> None:
    lit = base(0.5, 0.25, 1)
    unlit = lit | {"extensions": {"KHR_materials_unlit": {}}}
    pixels = drawn(text("Unlit", "inherited.color"), squares(unlit, lit), tmp_path)
    assert pixels[6, 5].tolist() == [0.5, 0.25, 1, 1]
    assert pixels[6, 9].tolist() != [0.5, 0.25, 1, 1]


def test_an_index_of_zero_is_endless(tmp_path: Path) -> None:
    """It mirrors all light, which the colour of the highlight can tint."""
    for said, read in ((0, 1e6), (0.5, 1), (1, 1), (1.5, 1.5)):
        found = read_gltf(textured("ior", {"ior": said}).save(tmp_path))
        assert found.objects[0].look.parameters["ior"] == read
        told = "material 0: its index of refraction is below 1; it counts as 1"
        assert found.notes == ((told,) if said == 0.5 else ())


def test_the_border_of_a_medium_is_seen_from_outside_only(tmp_path: Path) -> None:
    """Even if a thin wall would be seen from both sides."""
    for thickness, drawn_pixels in ((0, 16), (0.5, 0)):
        scene = textured("volume", {"thicknessFactor": thickness})
        scene.whole["materials"][0]["doubleSided"] = True
        scene.whole["nodes"][0] |= {"rotation": [0, 1, 0, 0]}
        pixels = drawn(text("Volume", "#ffffff"), scene, tmp_path)
        assert np.count_nonzero(pixels[..., 3]) == drawn_pixels


def checkered(transform: Json | None, coordinates: int = 0) -> Builder:
    """A square with a picture of 2 x 2 texels, whose second coordinates are mirrored."""
    made = squares({})
    place = made.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    made.whole["meshes"][0]["primitives"][0]["attributes"] = {
        "POSITION": place,
        "TEXCOORD_0": made.array([(0, 1), (1, 1), (1, 0), (0, 0)]),
        "TEXCOORD_1": made.array([(1, 1), (0, 1), (0, 0), (1, 0)]),
    }
    made.whole["images"] = [{"bufferView": made.view(four_colors())}]
    made.whole["textures"] = [{"source": 0}]
    info: Json = {"index": 0, "texCoord": coordinates}
    if transform is not None:
        info["extensions"] = {"KHR_texture_transform": transform}
    made.whole["materials"] = [{"pbrMetallicRoughness": {"baseColorTexture": info},
                                "extensions": {"KHR_materials_unlit": {}}}]  # fmt: skip
    return made


def four_colors() -> bytes:
    """A picture of 8 x 8 texels: red and green above, blue and white below."""
    from io import BytesIO

    from PIL import Image

    colors = np.array([[(255, 0, 0), (0, 255, 0)], [(0, 0, 255), (255, 255, 255)]], np.uint8)
    stream = BytesIO()
    Image.fromarray(colors.repeat(4, 0).repeat(4, 1)).save(stream, "PNG")
    return stream.getvalue()


R, G, B, W = (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)


@pytest.mark.parametrize(
    ("transform", "coordinates", "corners"),
    [
        (None, 0, (R, G, B, W)),
        (None, 1, (G, R, W, B)),
        ({"texCoord": 1}, 0, (G, R, W, B)),
        ({"offset": [0.5, 0]}, 0, (G, R, W, B)),
        ({"offset": [0, 1], "scale": [1, -1]}, 0, (B, W, R, G)),
        # The specification's example: the lower left quarter, turned.
        ({"offset": [0, 1], "rotation": 1.57079632679, "scale": [0.5, 0.5]}, 0, (B, B, B, B)),
        # Coordinates turn against the clock, and so the picture turns with it.
        ({"offset": [0, 1], "rotation": 1.57079632679}, 0, (B, R, W, G)),
    ],
)
def test_textures_lie_as_the_file_says(
    transform: Json | None, coordinates: int, corners: Any, tmp_path: Path
) -> None:
    scene = checkered(transform, coordinates)
    pixels = drawn(text("Unlit", "inherited.color"), scene, tmp_path)[4:8, 4:8, :3]
    seen = (pixels[0, 0], pixels[0, 3], pixels[3, 0], pixels[3, 3])
    assert np.array(seen) == pytest.approx(np.array(corners), abs=0.3)


def test_what_a_material_of_the_frame_lacks_is_told(tmp_path: Path) -> None:
    scene = checkered({"offset": [0.5, 0], "texCoord": 1})
    scene.whole["materials"][0] |= {"name": "Glass", "extensions": {
        "KHR_materials_transmission": {"transmissionFactor": 1}, "KHR_materials_ior": {"ior": 1.3},
    }}  # fmt: skip
    (tmp_path / "m.burnish").write_text(
        "import std.gltf.{MetallicRoughness}\nimport std.gltf_layers.{Ior}\n"
        "material Scanned : MetallicRoughness {}\n"
        "frame F { models scene  shown = Forward(scene)  output picture = shown.color }\n"
    )
    result = invoke("render", tmp_path / "m.burnish", "--scene", scene.save(tmp_path), "-o",
                    tmp_path / "x.png", "--size", 4)  # fmt: skip
    lacks = "is left out, as Scanned of the frame has no value for it: the mixins of "
    assert [line.partition("material 'Glass': ")[2] for line in result.stderr.splitlines()] == [
        f"{said} {lacks}std.gltf_layers do"
        for said in (
            "KHR_materials_ior", "KHR_materials_transmission",
            "how base_color_map lies on the surface",
        )
    ]  # fmt: skip


# --- variants ------------------------------------------------------------------------------------


def varied() -> Builder:
    """A square that is red, and green and blue in variants."""
    made = squares(base(1, 0, 0))
    made.add("materials", **base(0, 1, 0))
    made.add("materials", **base(0, 0, 1))
    made.whole["extensions"] = {"KHR_materials_variants": {"variants": [
        {"name": "meadow"}, {"name": "sea"}, {"name": "none of these"}
    ]}}  # fmt: skip
    made.whole["meshes"][0]["primitives"][0]["extensions"] = {"KHR_materials_variants": {
        "mappings": [{"material": 1, "variants": [0]}, {"material": 2, "variants": [1]}]
    }}  # fmt: skip
    return made


@pytest.mark.parametrize(
    ("variant", "color"),
    [("meadow", (0, 1, 0)), ("sea", (0, 0, 1)), ("none of these", (1, 0, 0))],
)
def test_a_variant_chooses_materials(
    variant: str, color: tuple[float, ...], tmp_path: Path
) -> None:
    shown = text("Unlit", "base_color")
    pixels = drawn(shown, varied(), tmp_path, "--variant", variant)
    assert tuple(pixels[6, 5, :3]) == color


def test_without_a_name_the_file_is_as_it_is_and_tells_of_variants(tmp_path: Path) -> None:
    found = read_gltf(varied().save(tmp_path))
    assert found.objects[0].look.parameters["base_color"] == (1, 0, 0, 1)
    assert found.notes == (
        "it has the variants 'meadow', 'sea', 'none of these': `--variant NAME` shows one",
    )


def test_variants_that_a_file_does_not_have(tmp_path: Path) -> None:
    path = varied().save(tmp_path)
    with pytest.raises(SceneError) as caught:
        read_gltf(path, "desert")
    assert str(caught.value) == (
        f"{path} has no variant 'desert': it has the variants 'meadow', 'sea', 'none of these'"
    )
    path = triangle().save(tmp_path)
    with pytest.raises(SceneError, match="has no variant 'desert': it has none"):
        read_gltf(path, "desert")
    made = varied()
    at = made.whole["meshes"][0]["primitives"][0]["extensions"]["KHR_materials_variants"]
    at["mappings"][1]["variants"] = [3]
    with pytest.raises(SceneError, match="mesh 0, primitive 0: there is no variant 3"):
        read_gltf(made.save(tmp_path))


# --- what is wrong -------------------------------------------------------------------------------

WRONG: dict[str, tuple[str, Json, str]] = {
    "negative": ("sheen", {"sheenColorFactor": [-1, 0, 0]}, "Expected `float` >= 0.0"),
    "more than all": ("transmission", {"transmissionFactor": 1.5}, "Expected `float` <= 1.0"),
    "no distance": ("volume", {"attenuationDistance": 0}, "Expected `float` > 0.0"),
    "a thin film of less than air": ("iridescence", {"iridescenceIor": 0.5}, "`float` >= 1.0"),
    "two lanes": ("specular", {"specularColorFactor": [1, 1]}, "Expected `array` of length 3"),
    "a number for an extension": ("clearcoat", {"clearcoatTexture": 3}, "Expected `object | null`"),
    "no such texture": ("volume", {"thicknessTexture": {"index": 7}},
                        "material 0, thickness_map: there is no texture 7"),
    "an absurd rotation": ("anisotropy", {"anisotropyRotation": "left"}, "Expected `float`"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
def test_wrong_values_are_told(name: str, tmp_path: Path) -> None:
    extension, values, told = WRONG[name]
    with pytest.raises(SceneError) as caught:
        read_gltf(textured(extension, values).save(tmp_path))
    assert told in str(caught.value)


def test_numbers_that_are_none_are_refused(tmp_path: Path) -> None:
    path = textured("volume", {"thicknessFactor": 1}).save(tmp_path)
    path.write_text(path.read_text().replace('"thicknessFactor": 1', '"thicknessFactor": NaN'))
    with pytest.raises(SceneError, match="is no glTF"):
        read_gltf(path)
