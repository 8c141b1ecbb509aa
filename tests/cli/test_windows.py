"""Writing files where Windows has other rules, which this imitates.

There nobody can delete or replace a file that is open, and Python knows neither descriptors of
folders nor ``flock``.
"""

from __future__ import annotations

import errno
import os
from collections.abc import Callable
from pathlib import Path

import pytest

from burnish.commands import replacing
from burnish.commands.replacing import replace_all

from .kit import tree


def _open_files() -> set[Path]:
    """The paths of the files that this process has open."""
    return {entry.resolve() for entry in Path("/proc/self/fd").iterdir()}


@pytest.fixture(autouse=True)
def windows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Refuses what Windows refuses."""

    def imitated(call: Callable[..., object]) -> Callable[..., object]:
        def called(*paths: str, **options: object) -> object:
            given = [name for name, value in options.items() if name.endswith("dir_fd") and value]
            assert not given, "Windows has no descriptors of folders"
            if not _open_files().isdisjoint(Path(path).resolve() for path in paths):
                raise PermissionError(errno.EACCES, "another process uses the file")
            return call(*paths, **options)

        return called

    monkeypatch.setattr(replacing, "_ANCHORED", False)
    monkeypatch.delattr("fcntl.flock")
    monkeypatch.delattr(os, "O_DIRECTORY")
    for name in ("unlink", "replace", "link"):
        monkeypatch.setattr(os, name, imitated(getattr(os, name)))


def test_files_are_replaced_and_nothing_else_is_left(tmp_path: Path) -> None:
    for content in (b"old", b"new"):
        replace_all(str(tmp_path), {"a": content, "b": content})
        assert tree(tmp_path) == {"a", "b"}
        assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes() == content


def test_an_error_changes_nothing(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("old")
    (tmp_path / "c").mkdir()
    with pytest.raises(IsADirectoryError, match="it is a folder"):
        replace_all(str(tmp_path), {"a": b"new", "b": b"new", "c": b"new"})
    assert tree(tmp_path) == {"a", "c"}
    assert (tmp_path / "a").read_text() == "old"


def test_a_file_that_somebody_has_open(tmp_path: Path) -> None:
    replace_all(str(tmp_path), {"a": b"old", "b": b"old"})
    with (
        (tmp_path / "b").open("rb"),
        pytest.raises(PermissionError, match=r"another process uses the file: '.*b'$"),
    ):
        replace_all(str(tmp_path), {"a": b"new", "b": b"new", "c": b"new"})
    assert tree(tmp_path) == {"a", "b"}
    assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes() == b"old"


@pytest.mark.parametrize("name", ["..\\a", "C:a", "a:stream", "deep/a"])
def test_names_that_lead_elsewhere_there(name: str, tmp_path: Path) -> None:
    with pytest.raises(OSError, match="it is no name of a file"):
        replace_all(str(tmp_path), {"b": b"new", name: b"new"})
    assert tree(tmp_path) == set()
