"""Cached values survive damage, unwritable folders and changed ingredients."""

from __future__ import annotations

from pathlib import Path

import pytest

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
