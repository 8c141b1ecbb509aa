"""A material that names its pass: ``material Leaf by Cutout``."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.api import entry_points as api
from burnish.compiler.diagnostics.render import render_all

TEXT = """
abstract material Foliage by Cutout { color = #3a7a2a }
material Leaf : Foliage { alpha = uv.x }
material Needle : Foliage by Fine { alpha = uv.y }
material Log : Foliage by Forward {}
material Bark { color = #654321 }
pass Cutout : Forward { discard when alpha < 0.5 }
pass Fine : Cutout { raster { samples = 4, alpha_to_coverage = true } }
pass Overlay : Forward blend alpha { alpha = 0.5 }
"""


def passes(pass_: str | None = None) -> dict[str, str]:
    found = burnish.compile(TEXT, "wgsl", pass_=pass_)
    return {material.name: material.reflection.pass_ for material in found}


def test_each_material_is_drawn_by_its_own_pass_or_that_of_its_base() -> None:
    assert passes() == {"Leaf": "Cutout", "Needle": "Fine", "Log": "Forward", "Bark": "Forward"}
    leaf, bark = (burnish.compile(TEXT, "wgsl")[name] for name in ("Leaf", "Bark"))
    assert "discard;" in leaf.text("wgsl", "fragment")
    assert "discard;" not in bark.text("wgsl", "fragment")


def test_a_named_pass_draws_all() -> None:
    assert set(passes("Overlay").values()) == {"Overlay"}


def test_whoever_names_another_pass_is_told() -> None:
    found = burnish.compile(TEXT, "wgsl", pass_="Overlay", material="Leaf").diagnostics
    assert render_all(found) == (
        "warning[B0217]: `Leaf` is drawn by `Cutout`, and here by `Overlay`\n"
        " --> <text>:2:30\n"
        "  |\n"
        "2 | abstract material Foliage by Cutout { color = #3a7a2a }\n"
        "  |                              ^^^^^^\n"
        "  = help: What its own pass does, such as to discard, is not done here. Leave `--pass` "
        "out, or derive the other pass from the material's."
    )


@pytest.mark.parametrize(
    ("material", "pass_"), [("Leaf", "Cutout"), ("Leaf", "Fine"), ("Bark", "Fine")]
)
def test_a_pass_that_does_what_the_material_wants_is_no_other(material: str, pass_: str) -> None:
    assert not burnish.compile(TEXT, "wgsl", pass_=pass_, material=material).diagnostics


def test_a_pass_of_a_material_is_no_variant_of_all() -> None:
    assert api.variants(TEXT) == ((None, None), (None, "Overlay"))
    assert api.declared(TEXT).ties == {"Leaf": "Cutout", "Needle": "Fine", "Log": "Forward"}


def test_the_pass_may_be_imported_where_the_base_names_it(tmp_path: Path) -> None:
    (tmp_path / "foliage.burnish").write_text(TEXT, encoding="utf-8")
    file = tmp_path / "garden.burnish"
    file.write_text(
        'import "foliage.burnish".{Foliage}\nmaterial Fern : Foliage { alpha = uv.x }\n',
        encoding="utf-8",
    )
    assert burnish.compile(file, "wgsl")["Fern"].reflection.pass_ == "Cutout"
    assert not burnish.check(file)


def test_a_material_is_checked_under_its_pass() -> None:
    text = """
        material Sliced by Slices { alpha = thickness }
        pass Slices : Forward { thickness = 0.5 }
    """
    told = [found.message for found in burnish.check(text)]
    assert told == ["unknown name `thickness`"]
    text = """
        material Placed by Flat { clip_position = vec4(2 * uv - 1, 0, 1) }
        pass Flat { target color : rgba8 = vec4(material.color, 1) }
    """
    assert not burnish.check(text)


def test_a_frame_says_which_pass_draws_and_is_told_where_none_is_the_materials() -> None:
    frame = """
        frame Wood {{
            models scene
            seen = {}(scene)
            output picture = seen.color
        }}
    """
    right, wrong = (
        burnish.compile(TEXT + frame.format(name), "wgsl") for name in ("Fine", "Forward")
    )
    assert not right.diagnostics
    assert [found.message for found in wrong.diagnostics] == [
        "no step draws `Leaf` by `Cutout`",
        "no step draws `Needle` by `Fine`",
    ]
