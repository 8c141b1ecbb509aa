"""The pictures that examples are drawn with: they are what is painted, and commands find them."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from PIL import Image

from burnish.compiler.budget import Tally
from burnish.targets.runner.textures.high_range import format_of, read_floats

from . import pictures

EXAMPLES = Path(__file__).parents[2] / "examples"


def test_pictures_in_8_bits_are_those_that_are_painted() -> None:
    for name, path in pictures.files():
        with Image.open(path) as found:
            painted = pictures.painted(name)
            assert (found.mode, found.size) == (painted.mode, painted.size), name
            difference = np.asarray(found).astype(int) - np.asarray(painted).astype(int)
            assert abs(difference).max() <= 1, name


@pytest.mark.parametrize("name", pictures.PANORAMAS)
def test_panoramas_are_those_that_are_painted(name: str) -> None:
    path = pictures.FOLDER / f"{name}.hdr"
    form = format_of(path)
    assert form is not None
    found = read_floats(path, form, str(path), Tally("memory", "it takes"))[..., :3]
    painted = pictures.panorama(name)
    # A texel's lanes have 8 bits each and one exponent.
    assert np.all(abs(found - painted) <= painted.max(axis=-1, keepdims=True) / 100 + 1e-6)


def test_commands_in_examples_name_pictures_that_there_are_and_all_are_named() -> None:
    named = set[str]()
    for example in EXAMPLES.glob("*.burnish"):
        for line in re.findall(r"^//! {5}burnish render (.*)$", example.read_text("utf-8"), re.M):
            assert line.startswith(f"{example.name} -o {example.stem}.png ")
            named |= set(re.findall(r"pictures/[\w.]+", line))
    files = {f"pictures/{path.name}" for path in pictures.FOLDER.iterdir()}
    assert named == files
