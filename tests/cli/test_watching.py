"""The events that tell commands about changed files: ``commands/watch.py``."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from queue import Queue
from threading import Thread

import pytest
import watchfiles

from burnish.commands.watch import Watcher, sources

from ..suite.processes import LIMIT, until

PLAIN = "material Plain { color = vec3(0.5) }\n"
IMPORTING = 'import "parts/half.burnish".{half}\nmaterial Plain { color = vec3(half(1.0)) }\n'
HALF = "fn half(x: float) -> float = 0.5 * x\n"


class Told:
    """Follows files as commands do, in a thread, and knows which have changed."""

    def __init__(self, watcher: Watcher[Path]) -> None:
        self._watcher = watcher
        self._changes: Queue[Path] = Queue()
        self._seen: Path | None = None

    def follow(self, file: Path) -> None:
        self._watcher.follow(file, file, lambda: sources(file, ()))

    def work(self) -> None:
        for file in self._watcher.changes():
            self.follow(file)
            self._changes.put(file)

    def sees(self, file: Path) -> None:
        """Wait until a change of this file, and of no other one, is told. A change of the file
        before may be told twice: it can be looked at in the midst of being written."""
        found = self._changes.get(timeout=LIMIT)
        while found == self._seen != file:
            found = self._changes.get(timeout=LIMIT)
        assert found == file
        self._seen = file

    def sees_nothing(self) -> None:
        assert self._changes.empty()


@contextmanager
def watching() -> Iterator[Told]:
    watcher = Watcher[Path]()
    told = Told(watcher)
    thread = Thread(target=told.work, daemon=True)
    thread.start()
    try:
        yield told
    finally:
        watcher.stop()
        thread.join(LIMIT)
        assert not thread.is_alive()


@pytest.fixture(params=["reported", "polled"])
def told(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Iterator[Told]:
    """A watcher whose system reports changes, and one whose system cannot."""
    if request.param == "polled":
        monkeypatch.setattr(watchfiles, "watch", _exhausted)
    with watching() as told:
        yield told


def _exhausted(*_folders: Path, **_options: object) -> Iterator[object]:
    raise RuntimeError("Too many open files (os error 24)")


def replace(file: Path, text: str) -> None:
    """Write a file as many editors do: into another one, which is then renamed."""
    new = file.with_suffix(".new")
    new.write_text(text)
    new.replace(file)


def test_files_that_are_written_and_replaced(told: Told, tmp_path: Path) -> None:
    first, second = tmp_path / "a.burnish", tmp_path / "b.burnish"
    for file in (first, second):
        file.write_text(PLAIN)
        told.follow(file)
    for text in (PLAIN + "\n", PLAIN):
        first.write_text(text)
        told.sees(first)
        replace(second, text)
        told.sees(second)
    first.unlink()
    told.sees(first)
    first.write_text(PLAIN)
    told.sees(first)
    (tmp_path / "other.burnish").write_text(PLAIN)
    replace(second, PLAIN)
    told.sees(second)
    told.sees_nothing()


def test_imports_that_appear_later(told: Told, tmp_path: Path) -> None:
    """Their folder may appear later as well; from then on they are followed."""
    file, half = tmp_path / "m.burnish", tmp_path / "parts" / "half.burnish"
    file.write_text(IMPORTING)
    told.follow(file)
    half.parent.mkdir()
    half.write_text(HALF)
    told.sees(file)
    half.write_text(HALF.replace("0.5", "0.25"))
    told.sees(file)
    half.unlink()
    told.sees(file)


def test_a_folder_that_is_replaced(told: Told, tmp_path: Path) -> None:
    folder = tmp_path / "shown"
    folder.mkdir()
    file = folder / "m.burnish"
    file.write_text(PLAIN)
    told.follow(file)
    folder.rename(tmp_path / "old")
    told.sees(file)
    (tmp_path / "old" / "m.burnish").write_text(PLAIN * 2)
    folder.mkdir()
    file.write_text(PLAIN)
    told.sees(file)
    file.write_text(PLAIN + "\n")
    told.sees(file)


def test_names_that_are_no_unicode(told: Told, tmp_path: Path) -> None:
    folder = tmp_path / os.fsdecode(b"\xff")
    folder.mkdir()
    file = folder / os.fsdecode(b"\xfe.burnish")
    file.write_text(PLAIN)
    told.follow(file)
    file.write_text(PLAIN + "\n")
    told.sees(file)


def test_other_names_that_are_no_unicode(told: Told, tmp_path: Path) -> None:
    """Changes of a file are seen although the watching package fails on such names beside it."""
    file = tmp_path / "m.burnish"
    file.write_text(PLAIN)
    told.follow(file)
    for number in range(3):
        (tmp_path / os.fsdecode(b"\xff%d" % number)).write_text("")
        file.write_text(PLAIN + number * "\n")
        told.sees(file)


def test_an_exhausted_system_is_told_once(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(watchfiles, "watch", _exhausted)
    with watching() as told:
        for name in ("a", "b", "c"):
            file = tmp_path / name / "m.burnish"
            file.parent.mkdir()
            file.write_text(PLAIN)
            told.follow(file)
            file.write_text(PLAIN + "\n")
            told.sees(file)
    assert capsys.readouterr().err == (
        "note: the system does not report changes of files, so they are looked for every 0.3 "
        "seconds: Too many open files (os error 24)\n"
    )


def test_one_watch_for_all_files_of_a_folder(tmp_path: Path) -> None:
    """This holds for any number of files: the system allows a user some 128 watches."""

    def watches() -> int:
        opened = [each for each in Path("/proc/self/fd").iterdir() if each.is_symlink()]
        return sum("inotify" in str(each.readlink()) for each in opened)

    files = [tmp_path / f"{number}.burnish" for number in range(200)]
    for file in files:
        file.write_text(PLAIN)
    before = watches()
    with watching() as told:
        for file in files:
            told.follow(file)
        until(lambda: watches() > before, "the folder is watched")
        assert watches() == before + 1
        files[-1].write_text(PLAIN + "\n")
        told.sees(files[-1])
