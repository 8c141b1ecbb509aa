"""Cached values survive damage, unwritable folders and changed ingredients; old ones go."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from burnish.compiler import cache
from burnish.compiler.cache import cached


class Counter:
    """A value that counts how often it was computed."""

    def __init__(self) -> None:
        self.count = 0

    def __call__(self) -> dict[str, int]:
        self.count += 1
        return {"value": self.count}


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    chosen = tmp_path / "cache"
    monkeypatch.setenv("BURNISH_CACHE", str(chosen))
    return chosen


def test_a_value_is_computed_once(folder: Path) -> None:
    compute = Counter()
    assert cached("x", ("a",), compute) == cached("x", ("a",), compute) == {"value": 1}
    assert len(list(folder.iterdir())) == 1


def test_other_ingredients_make_another_value(folder: Path) -> None:
    compute = Counter()
    cached("x", ("a", "b"), compute)
    assert cached("x", ("ab",), compute) == {"value": 2}
    assert len(list(folder.iterdir())) == 2


@pytest.mark.parametrize("damage", [b"", b"short", b"x" * 100])
def test_damage_is_mended(folder: Path, damage: bytes) -> None:
    compute = Counter()
    cached("x", ("a",), compute)
    (path,) = folder.iterdir()
    path.write_bytes(damage)
    assert cached("x", ("a",), compute) == {"value": 2}
    assert cached("x", ("a",), compute) == {"value": 2}


def test_an_unwritable_folder_only_costs_time(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    blocked = tmp_path / "file"
    blocked.touch()
    monkeypatch.setenv("BURNISH_CACHE", str(blocked / "cache"))
    compute = Counter()
    cached("x", ("a",), compute)
    assert cached("x", ("a",), compute) == {"value": 2}


def written(folder: Path, number: int) -> Path:
    """The file of a value that is written ``number`` seconds after 1970."""
    before = set(folder.glob("*"))
    cached("x", (str(number),), Counter())
    (path,) = set(folder.glob("*")) - before
    os.utime(path, (number, number))
    return path


def test_the_oldest_values_make_room(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "KEPT", 3)
    paths = [written(folder, number) for number in range(1, 6)]
    assert set(folder.iterdir()) == set(paths[2:])


def test_halves_of_values_go_and_what_others_wrote_stays(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cache, "KEPT", 1)
    half = written(folder, 1).rename(folder / f"x-{0:016x}.bin.7.tmp")
    (folder / "tools-0.bin").mkdir()
    (folder / "mine.bin").touch()
    os.utime(folder / "mine.bin", (0, 0))
    last = written(folder, 2)
    assert not half.exists()
    assert {path.name for path in folder.iterdir()} == {"tools-0.bin", "mine.bin", last.name}


def test_what_cannot_be_deleted_only_takes_room(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(path: str) -> None:
        raise PermissionError(path)

    monkeypatch.setattr(cache, "KEPT", 1)
    monkeypatch.setattr(os, "unlink", refuse)
    assert cached("x", ("a",), Counter()) == cached("x", ("b",), Counter()) == {"value": 1}
    assert len(list(folder.iterdir())) == 2
