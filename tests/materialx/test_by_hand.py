"""Materials that were written by hand after documents: both sides have the same scene.

A mistake of the scene would look like one of a converter. So these materials are as simple as can
be, and each depends on something else: lights, spaces, charts, textures, primitive variables.
"""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from burnish import Texture
from burnish.materialx.fidelity.checker import Checker
from burnish.materialx.fidelity.checking import Claim, check
from burnish.materialx.fidelity.comparing import compare, drawn
from burnish.materialx.fidelity.settings import SETTINGS, Setting

from .kit import BY_HAND, DOCUMENTS, document

pytestmark = pytest.mark.xdist_group("materialx")

PAIRS = {
    ("unlit_constant", "Lamp"): "Lamp",
    ("surface_diffuse", "Chalk"): "Chalk",
    ("image_plain", "Sticker"): "Sticker",
    ("spaces", "seen/object_place"): "ObjectPlace",
    ("spaces", "seen/world_place"): "WorldPlace",
    ("spaces", "seen/object_normal"): "ObjectNormal",
    ("spaces", "seen/world_normal"): "WorldNormal",
    ("spaces", "seen/world_tangent"): "WorldTangent",
    ("spaces", "seen/world_bitangent"): "WorldBitangent",
    ("spaces", "seen/view"): "View",
    ("spaces", "seen/uv"): "Uv",
    ("spaces", "seen/uv_second"): "UvSecond",
    ("spaces", "seen/paint"): "Paint",
    ("primvars", "own/flowing"): "Flowing",
    ("primvars", "own/tips"): "Tips",
}
"""The material for each renderable."""
USUAL, LARGEST = 1e-6, 1e-5
"""The differences that nearly all pixels, and all of them, stay below. Texts of both sides round
differently where a triangle is seen from its edge, or where a texture is steep."""


def claim(name: str, renderable: str, material: str) -> Claim:
    tiles = Texture.load(DOCUMENTS / "images" / "tiles.png")
    values = {"tiles": tiles} if material == "Sticker" else {}
    source = BY_HAND / f"{name}.burnish"
    return Claim(document(name), renderable, source, material, values, by_host=False)


@pytest.mark.parametrize("setting", SETTINGS.values(), ids=SETTINGS)
@pytest.mark.parametrize(("name", "renderable"), PAIRS)
def test_both_sides_draw_the_same(
    checker: Checker, name: str, renderable: str, setting: Setting
) -> None:
    found = check(checker, claim(name, renderable, PAIRS[name, renderable]), setting)
    assert found.verdict == "alike", found.reason
    assert found.likeness is not None
    assert found.likeness.drawn > 100
    assert found.likeness.percentiles[1] <= USUAL, found.reason
    assert found.likeness.largest <= LARGEST, found.reason


def test_textures_may_be_decoded_before_filtering(checker: Checker) -> None:
    source = "burnish 1\nmaterial Early { map tiles : texture2d of rgb\n color = tiles(uv).rgb }"
    tiles = Texture.load(DOCUMENTS / "images" / "tiles.png", srgb=True)
    early = Claim(document("image_plain"), "Sticker", source, "Early", {"tiles": tiles})
    found, late = (check(checker, replace(early, by_host=each)) for each in (True, False))
    assert found.likeness is not None and found.likeness.largest <= LARGEST, found.reason
    assert late.verdict == "different"


def test_another_material_is_told_apart(checker: Checker) -> None:
    found = check(checker, claim("spaces", "seen/object_place", "WorldPlace"))
    assert found.verdict == "different"
    assert found.likeness is not None
    assert found.likeness.share > 0.9


def test_the_lights_of_a_setting_shine_on_both_sides(checker: Checker) -> None:
    asked = document("surface_diffuse"), "Chalk"
    one, two = (checker.draw(*asked, setting).picture for setting in SETTINGS.values())
    assert (drawn(one) == drawn(two)).all()
    assert (two >= one).all()
    assert (two > one + 0.01).any()


def test_the_reference_bounds_the_picture(checker: Checker) -> None:
    source = BY_HAND / "surface_diffuse.burnish"
    for setting in SETTINGS.values():
        found = checker.ours(source, "Chalk", setting).within_bounds()
        assert found.agrees and found.proven > 1000


def test_complete_texts_draw_the_same(checker: Checker) -> None:
    asked = document("image_wraps"), "edges/bordered"
    reduced, complete = (checker.draw(*asked, complete=each).picture for each in (False, True))
    assert compare(reduced, complete).largest <= LARGEST


def test_borders_have_the_default_color(checker: Checker) -> None:
    picture = checker.draw(document("image_wraps"), "edges/bordered").picture
    assert np.isclose(picture[drawn(picture)], [0.2, 0.5, 0.1, 1.0]).all(axis=1).sum() >= 5
