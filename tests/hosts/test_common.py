"""What all example hosts draw, and by what they are judged."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from .expecting import SCENES, Picture, difference
from .scene import COMMON, SCENE, text

EXAMPLES = COMMON.parents[1]


def test_the_scene_is_what_its_script_makes() -> None:
    assert SCENE.read_text(encoding="utf-8") == text() + "\n", (
        "run `python -m burnish.tests.hosts.scene`"
    )


@pytest.mark.parametrize("name", ["plastic", "frames/shadows"])
def test_materials_are_those_of_the_examples(name: str) -> None:
    example = EXAMPLES / f"{name}.burnish"
    copied = COMMON / "materials" / example.name
    assert copied.read_text(encoding="utf-8") == example.read_text(encoding="utf-8")


@pytest.mark.parametrize("name", SCENES)
def test_a_picture_is_judged(name: str, expected: Callable[[str], Picture], tmp_path: Path) -> None:
    wanted = expected(name)
    assert len(np.unique(wanted.reshape(-1, 3), axis=0)) > 200, "there is something to see"
    drawn = tmp_path / "drawn.png"
    Image.fromarray(wanted).save(drawn)
    assert difference(drawn, wanted) == ""

    off = wanted.copy()
    off[:16, :64] = 255 - off[:16, :64] // 2
    Image.fromarray(off).save(drawn)
    assert difference(drawn, wanted).startswith("drawn.png: 1.6% of the pixels are off by more")


def test_only_opaque_pictures_of_the_size_are_taken(tmp_path: Path) -> None:
    drawn, wanted = tmp_path / "drawn.png", np.zeros((256, 256, 3), np.uint8)
    Image.new("RGB", (128, 256)).save(drawn)
    assert difference(drawn, wanted) == "drawn.png has (128, 256) pixels"
    Image.new("RGBA", (256, 256)).save(drawn)
    assert difference(drawn, wanted) == "drawn.png is not opaque"
