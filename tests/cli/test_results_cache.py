"""The cache of answers of ``burnish compile``: odd folders, damage, many at once, bounds."""

from __future__ import annotations

import json
import os
import time
from collections.abc import Callable, Mapping
from pathlib import Path

import pytest

from burnish.commands import results
from burnish.compiler import cache

from ..suite.processes import at_once
from .kit import tree
from .place import Place


def _is_file(folder: Path) -> Mapping[str, str]:
    (folder / "file").touch()
    return {"BURNISH_CACHE": str(folder / "file")}


def _is_device(_: Path) -> Mapping[str, str]:
    return {"BURNISH_CACHE": os.devnull}


def _is_too_long(folder: Path) -> Mapping[str, str]:
    return {"BURNISH_CACHE": str(folder / ("x" * 5000))}


def _is_circular(folder: Path) -> Mapping[str, str]:
    (folder / "circle").symlink_to("circle")
    return {"BURNISH_CACHE": str(folder / "circle")}


def _is_nowhere(_: Path) -> Mapping[str, str]:
    """The home is unknown: there is no ``HOME``, and the user has no home folder."""
    return {"BURNISH_CACHE": "", "XDG_CACHE_HOME": "", "HOME": "~"}


def _is_empty(_: Path) -> Mapping[str, str]:
    """``~/.cache`` would be a folder at the root of the disk."""
    return {"BURNISH_CACHE": "", "XDG_CACHE_HOME": "", "HOME": ""}


def _is_relative(_: Path) -> Mapping[str, str]:
    """The cache must not be in the current folder, as a relative path would have it."""
    return {"BURNISH_CACHE": "", "XDG_CACHE_HOME": "caches", "HOME": "home"}


def _is_chosen_and_relative(_: Path) -> Mapping[str, str]:
    """A relative choice is ignored: the maker of the current folder must not make the cache."""
    return {"BURNISH_CACHE": "caches", "XDG_CACHE_HOME": "caches", "HOME": "home"}


@pytest.mark.parametrize(
    "odd",
    [
        _is_file, _is_device, _is_too_long, _is_circular, _is_nowhere, _is_empty, _is_relative,
        _is_chosen_and_relative,
    ],
)  # fmt: skip
def test_an_odd_cache_folder(
    place: Place, odd: Callable[[Path], Mapping[str, str]], tmp_path: Path
) -> None:
    place.environment(odd(tmp_path))
    place.write(main="material Main { }")
    assert [place.run() for _ in range(2)] == [
        ("COMPILED", 0, "Main: 2 shaders and Main.json in out\n", "")
    ] * 2
    assert tree(place.folder) == {
        "main.burnish", "out", "out/Main.frag.wgsl", "out/Main.vert.wgsl", "out/Main.json"
    }  # fmt: skip


@pytest.mark.parametrize(
    "damage",
    [
        b"",
        b"x",
        b"x" * 200,
        cache.digest(b"[]").encode(),
        bytes.fromhex(cache.digest(b"[]")) + b"[]",
    ],
)
def test_a_damaged_answer(place: Place, damage: bytes) -> None:
    place.write(main="material Main { }")
    first = place.run()
    (result,) = place.results()
    result.write_bytes(damage)
    assert place.run() == first
    assert place.run()[0] == "KNOWN"


def test_only_texts_are_kept(place: Place) -> None:
    place.write(main="material Main { }")
    place.run()
    (result,) = place.results()
    kept: dict[str, object] = json.loads(result.read_bytes()[8:])
    assert kept.keys() == {
        "circumstances", "depfile", "folder", "folders", "force", "library", "links", "owners",
        "printed", "sources", "texts", "warnings",
    }  # fmt: skip


def test_many_at_once(place: Place) -> None:
    place.write(main="material Main { alpha = sin(uv.x) }")
    runs = at_once([place.process] * 6)
    assert [run.code for run in runs] == [0] * 6
    assert len(place.results()) == 1
    before = place.fragment()
    assert place.run()[:2] == ("KNOWN", 0)
    assert place.fragment() == before


def test_many_answers(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "KEPT", 2)
    other = place.cache / "private" / "other" / "0123456789abcdef"
    cache.store("other", other.name, b"")
    os.utime(other, (0, 0))
    for number in range(4):
        place.write(main=f"material Main {{ alpha = 0.{number} }}")
        place.run(output=f"out{number}")
    assert len(place.results()) == 2
    assert other.exists()
    assert place.run(output="out3").how == "KNOWN"


def test_a_clock_that_goes_backwards(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    """Answers from before the change seem to be newer than all later ones."""
    monkeypatch.setattr(cache, "KEPT", 2)
    place.write(main="material Main { }")
    for number in range(3):
        place.run(output=f"out{number}")
    later = time.time() + 1000
    for path in place.results():
        os.utime(path, (later, later))
    assert [place.run(output="new").how for _ in range(2)] == ["COMPILED", "KNOWN"]
    assert len(place.results()) == 2


def test_what_a_killed_process_left(place: Place) -> None:
    place.write(main="material Main { }")
    left = place.folder / "out" / f".burnish-{'5f' * 16}"
    left.parent.mkdir()
    left.write_text("half")
    assert [place.run()[:2] for _ in range(2)] == [("COMPILED", 0), ("KNOWN", 0)]
    assert left.read_text() == "half"


def test_large_answers_take_no_room(place: Place, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(results, "LARGEST", 1000)
    place.write(main="material Main { }")
    assert [place.run().how for _ in range(2)] == ["COMPILED"] * 2
    assert place.results() == []


@pytest.mark.parametrize(
    "changes",
    [
        {"texts": {"../elsewhere": "x"}},
        {"texts": {"elsewhere": "x"}, "folder": ".."},
        {"texts": {"elsewhere": "x"}, "folder": "../place"},
    ],
)
def test_an_answer_writes_nowhere_else(place: Place, changes: dict[str, object]) -> None:
    place.write(main="material Main { color = vec3(1) }\n")
    place.run()
    (kept,) = place.results()
    entry = json.loads(cache.load("result", kept.name) or b"") | changes
    cache.store("result", kept.name, json.dumps(entry).encode())
    assert place.run().how == "COMPILED"
    assert not list(place.folder.parent.rglob("elsewhere"))


def test_a_source_that_has_become_huge(place: Place) -> None:
    """The source is not read to its end only to see that it has changed."""
    place.write(main="material Main { }")
    place.run()
    main = place.folder / "main.burnish"
    os.truncate(main, 1 << 40)
    how, code, _, errors = place.run()
    assert (how, code) == ("COMPILED", 1)
    assert errors.startswith("error[B0005]: `main.burnish` is larger than ")


def test_what_was_kept_for_others_is_ignored(place: Place) -> None:
    """Former versions kept answers in folders that anybody can read."""
    place.write(main="material Main { color = vec3(1) }\n")
    before = place.run()
    (place.cache / "private").chmod(0o755)
    assert [place.run() for _ in range(2)] == [before] * 2
