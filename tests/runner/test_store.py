"""A store gives back what was put in, or nothing; and does not grow without limit."""

from __future__ import annotations

import os
import random
from pathlib import Path

import pytest

from burnish.targets.runner import store as stores
from burnish.targets.runner.store import Store, digest, digest_of_sources


@pytest.fixture(autouse=True)
def cache(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path))
    return tmp_path


def incompressible(size: int) -> bytes:
    """Random bytes, ``size`` of them; a file that holds them is a little larger."""
    return random.Random(size).randbytes(size)


def files(store: Store) -> list[Path]:
    return [path for path in store.folder.rglob("*") if path.is_file()]


def age(store: Store, name: str, seconds: int) -> None:
    os.utime(store.folder / name[:2] / name[2:], (seconds, seconds))


def test_digests_tell_ingredients_apart() -> None:
    different = [("ab", "c"), ("a", "bc"), ("abc",), ("abc", ""), ("c", "ab"), ("ab", "d")]
    assert len({digest(*ingredients) for ingredients in different}) == len(different)
    assert digest("é") == digest("é".encode())


@pytest.mark.parametrize("name", ["a.py", "a.mjs", "a.js"])
def test_the_digest_of_sources_is_theirs(name: str, tmp_path: Path) -> None:
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / name).write_text("a = 1")
    before = digest_of_sources(tmp_path)
    (tmp_path / "deep" / "notes.txt").write_text("nothing")
    assert digest_of_sources(tmp_path) == before
    (tmp_path / "deep" / name).write_text("a = 2")
    assert digest_of_sources(tmp_path) != before


def test_what_is_kept_is_found_by_others() -> None:
    name = digest("a")
    assert Store("s").read(name) is None
    Store("s").write(name, b"data")
    assert Store("s").read(name) == b"data"
    assert Store("other").read(name) is None
    Store("s").write(name, b"")
    assert Store("s").read(name) == b""


@pytest.mark.parametrize("damage", [lambda data: data[:-1], lambda data: b"x" + data[1:], bytes])
def test_what_is_damaged_is_not_there(damage: object) -> None:
    store, name = Store("s"), digest("a")
    store.write(name, b"data")
    (path,) = files(store)
    path.write_bytes(damage(path.read_bytes()) if damage is not bytes else b"")  # type: ignore[operator]
    assert store.read(name) is None


def test_what_repeats_itself_takes_little_room() -> None:
    """This is the case for pictures, most of which is background."""
    store, data = Store("s"), bytes(100_000)
    store.write(digest("a"), data)
    (path,) = files(store)
    assert path.stat().st_size < len(data) / 100
    assert store.read(digest("a")) == data


def test_what_was_not_used_for_longest_goes_first() -> None:
    store = Store("s", limit=5000)
    names = [digest(str(number)) for number in range(4)]
    for number, name in enumerate(names):
        store.write(name, incompressible(1000))
        age(store, name, 1000 + number)
    assert store.read(names[0]) is not None  # and so it was used
    store.prune()
    assert len(files(store)) == 4
    newest = digest("newest")
    store.write(newest, incompressible(2000))
    store.prune()
    kept = [name for name in (*names, newest) if store.read(name) is not None]
    assert kept == [names[0], newest]


def test_a_long_run_prunes_by_itself(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(stores, "CHECK_EVERY", 3000)
    store = Store("s", limit=10_000)
    for number in range(100):
        store.write(digest(str(number)), incompressible(1000))
        assert sum(path.stat().st_size for path in files(store)) <= 15_000


def test_a_store_that_cannot_be_written_stops_nobody(cache: Path) -> None:
    (cache / "private").mkdir(0o700)
    (cache / "private" / "s").write_text("a file where a folder should be")
    store = Store("s")
    store.write(digest("a"), b"data")
    store.prune()
    assert store.read(digest("a")) is None


@pytest.mark.parametrize("part", ["private", "private/s", "private/s/ab"])
def test_nothing_is_deleted_through_a_link(part: str, cache: Path, tmp_path: Path) -> None:
    """The cache folder may have come from somebody else, with links in it."""
    victim, rest = tmp_path / "victim", "private/s/ab".removeprefix(part).strip("/")
    (victim / rest).mkdir(parents=True)
    for path in (victim, *victim.rglob("*")):
        path.chmod(0o700)
    precious = victim / rest / "precious"
    precious.write_bytes(bytes(1000))
    link = cache / part
    if link.parent != cache:
        link.parent.mkdir(parents=True)
        for path in (cache / "private", *(cache / "private").rglob("*")):
            path.chmod(0o700)
    link.symlink_to(victim)
    store = Store("s", limit=10)
    store.write("abcd", b"data")
    store.prune()
    assert precious.read_bytes() == bytes(1000)
    assert store.read("abprecious") is None


def test_a_write_that_fails_leaves_nothing(monkeypatch: pytest.MonkeyPatch) -> None:
    def full(_source: str, _target: str) -> None:
        raise OSError("no space left")

    store = Store("s")
    monkeypatch.setattr(os, "replace", full)
    store.write(digest("a"), b"data")
    assert files(store) == []
