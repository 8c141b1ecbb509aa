"""Values of an instance that are written as text, as on a command line."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish import Instance, ParameterError


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("power", "32", 32.0),
        ("power", " 3.2e1 ", 32.0),
        ("base", "1,0.5,0", (1.0, 0.5, 0.0)),
        ("base", "(1, 0.5, 0)", (1.0, 0.5, 0.0)),
        ("base", "1 0.5 0", (1.0, 0.5, 0.0)),
        ("base", "#ffffff", (1.0, 1.0, 1.0)),
        ("tilt", "180deg", 3.1415927410125732),
        ("offset", "-1,2", (-1, 2)),
        ("shiny", "false", False),
        ("mask", "1,true", (True, True)),
        ("turn", "1,2,3,4", ((1.0, 2.0), (3.0, 4.0))),
        ("ways", "1,0,0, 0,1,0", ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0))),
        ("layer.weights", "1,2,3", (1.0, 2.0, 3.0)),
        ("lamps.count", "2", 2),
        ("lamps[0].place", "0,2,1", (0.0, 2.0, 1.0)),
    ],
)
def test_texts_mean_values(instance: Instance, name: str, text: str, value: object) -> None:
    instance.set_text(name, text)
    assert instance.get(name) == value


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("power", "", "`power` (float) cannot hold ''"),
        ("power", "much", "`power` (float) cannot hold 'much'"),
        ("power", "nan", "`power` takes finite numbers, and nan is none"),
        ("power", "1,2", "`power` takes one number (float), and was given a list of 2"),
        ("base", "1,2", "`base` takes 3 numbers (rgb), and was given a list of 2"),
        ("base", "1,2,x", "`base` (rgb) cannot hold 'x'"),
        ("steps", "1.5", "`steps` (int) cannot hold '1.5'"),
        ("shiny", "yes", "`shiny` (bool) cannot hold 'yes'"),
        ("layer.weights", "1,2", "`layer.weights` (float[3]) takes 3 numbers, not 2"),
        ("layer", "1,2", "`layer` (Layer) is set by its parts, each by its name"),
        ("lamps", "1,2", "`lamps` (Point[3]) is set by its parts, each by its name"),
        ("powr", "1", "there is no parameter `powr`: did you mean `power`?"),
        (
            "torch.position",
            "1,2,3",
            "there is no parameter `torch.position`: did you mean `torch.place`?",
        ),
        (
            "torch.outer",
            "30",
            "`torch.outer` is declared in 0deg..90deg: 30 is 1718.9deg; did you mean 30deg?",
        ),
        ("torch.outer", "120deg", "`torch.outer` is declared in 0deg..90deg: 120deg is not"),
        (
            "torch",
            "1",
            "`torch` is a light, whose parameters are `torch.diffuse_color`, "
            "`torch.specular_color`, `torch.place`, `torch.axis`, `torch.inner`, `torch.outer`",
        ),
    ],
)
def test_texts_that_mean_nothing(instance: Instance, name: str, text: str, message: str) -> None:
    with pytest.raises(ParameterError) as caught:
        instance.set_text(name, text)
    assert str(caught.value) == message


def test_a_text_for_a_texture_is_a_picture_or_a_colour(instance: Instance, tmp_path: Path) -> None:
    instance.set_text("albedo", "#b5651d")
    assert instance.textures()["albedo"] == burnish.Texture.solid("#b5651d")
    with pytest.raises(burnish.PictureError, match="No such file or directory"):
        instance.set_text("albedo", str(tmp_path / "none.png"))
    assert instance.albedo == burnish.Texture.solid("#b5651d")
