"""All comparers agree with each other, and with NumPy, about random pictures and random damage."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

from . import oracle
from .folders import FILES, Array, Case, npy
from .kit import LANGUAGES, Said, verdicts

pytestmark = pytest.mark.xdist_group("comparers")  # One process compiles the programs.

TRIES = 300
TYPES = ("f2", "f4", "f8", "u1", "u2")


def test_random_pictures(tmp_path: Path) -> None:
    cases = [random_case(np.random.default_rng(number)) for number in range(TRIES)]
    said = said_by_all(cases, tmp_path)
    expected = [[(case.expected, case.expected)] * len(LANGUAGES) for case in cases]
    assert [each for each in zip(said, expected, strict=True) if each[0] != each[1]] == []
    words = [case.expected.partition(":")[0] for case in cases]
    assert min(words.count(word) for word in ("good", "bad")) > TRIES / 10


def test_random_damage(tmp_path: Path) -> None:
    chances = [np.random.default_rng(number) for number in range(TRIES)]
    cases = [damaged(random_case(chance), chance) for chance in chances]
    said = said_by_all(cases, tmp_path)
    assert [each for each in said if len(set(each)) != 1] == []
    assert [each for each in said if each[0][0] != each[0][1]] == []
    errors = {each[0][0].partition("npy: ")[2][:9] for each in said}
    assert len(errors) > 8


def said_by_all(cases: Sequence[Case], folder: Path) -> list[list[Said]]:
    """For each case, what the comparers say."""
    lines = [case.write(folder / str(number)) for number, case in enumerate(cases)]
    said = [verdicts(language, lines, folder) for language in LANGUAGES]
    return [
        [Said(case.named(each.loaded), each.parsed) for each in of_case]
        for case, of_case in zip(cases, zip(*said, strict=True), strict=True)
    ]


def random_case(chance: np.random.Generator) -> Case:
    """Bounds around random numbers, and a picture of them that may be off a little."""
    height, width, lanes = map(int, chance.integers(1, (5, 5, 5)))
    type_ = np.dtype(chance.choice(TYPES))
    encoding = str(chance.choice(("linear", "srgb"))) if type_.kind == "u" else "linear"
    middle = chance.choice((0.01, 1, 50)) * chance.normal(0.5, 0.5, (height, width, lanes))
    if type_.kind == "u":
        middle = chance.random((height, width, lanes)) ** 3
    widths = chance.choice(
        (0, 1e-9, 0.01, np.inf), (2, height, width, lanes), p=(0.1, 0.1, 0.7, 0.1)
    )
    lower, upper = middle - widths[0], middle + widths[1]
    undecided = (chance.random((height, width)) < 0.2).astype("u1")
    drawn = middle + chance.choice((0, 0.005, 0.1)) * chance.normal(size=middle.shape)
    picture = encoded(drawn[..., : int(chance.integers(1, lanes + 1))], type_, encoding)
    if type_.kind == "f":
        odd = chance.random(picture.shape) < chance.choice((0, 0.02))
        picture[odd] = chance.choice((np.nan, np.inf, -np.inf, -0.0, 5e-324), odd.sum())
    contents = map(npy, (lower, upper, undecided, picture))
    expected = oracle.verdict(lower, upper, undecided, picture, encoding)
    return Case("random", expected, dict(zip(FILES, contents, strict=True)), encoding)


def encoded(values: Array, type_: np.dtype[np.generic], encoding: str) -> Array:
    """Values as a picture of a type has them."""
    if type_.kind == "f":
        return values.astype(type_)
    values = np.clip(values, 0, 1)
    if encoding == "srgb":
        values[..., :3] = oracle.srgb(values[..., :3])
    codes: Array = np.round(values * np.iinfo(type_.name).max).astype(type_)
    return codes


def damaged(case: Case, chance: np.random.Generator) -> Case:
    """A case one of whose files has a few other bytes, most of them in its header, or an end."""
    name = str(chance.choice(FILES))
    content = bytearray(case.files[name])
    for place in chance.integers(0, chance.choice((12, 80, len(content))), chance.integers(1, 4)):
        letters = chance.choice((b" ,()'0123456789<>|uf", bytes(range(256))))
        content[place] = chance.choice(list(letters))
    if chance.random() < 0.2:
        del content[int(chance.integers(len(content))) :]
    return Case("damaged", "", {**case.files, name: bytes(content)}, case.encoding)
