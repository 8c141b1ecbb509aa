"""Writing files where Windows has other rules, of which this imitates two.

There nobody can delete or replace a file that is open, and files are locked by other means.
"""

from __future__ import annotations

import errno
import fcntl
import os
import sys
from pathlib import Path
from types import SimpleNamespace

import pytest

from burnish.commands import replacing
from burnish.commands.replacing import replace_all

from .kit import tree


def _open_files() -> set[Path]:
    """The paths of the files that this process has open."""
    return {entry.resolve() for entry in Path("/proc/self/fd").iterdir()}


def _lock(file: int, _mode: int, _bytes: int) -> None:
    try:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except BlockingIOError:
        raise PermissionError(errno.EACCES, "locked") from None


@pytest.fixture(autouse=True)
def windows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Locks as Windows does, and refuses to delete what is open."""
    assert tmp_path.is_dir()  # It was made while there still were users.
    delete = os.unlink

    def unlink(path: str) -> None:
        if Path(path).resolve() in _open_files():
            raise PermissionError(errno.EACCES, "another process uses the file", path)
        delete(path)

    monkeypatch.setattr(replacing, "ON_WINDOWS", True)
    monkeypatch.setattr(os, "unlink", unlink)
    monkeypatch.delattr(os, "getuid")
    monkeypatch.setitem(sys.modules, "msvcrt", SimpleNamespace(LK_NBLCK=2, locking=_lock))


def test_files_are_replaced_and_nothing_else_is_left(tmp_path: Path) -> None:
    for content in (b"old", b"new"):
        replace_all(str(tmp_path), {"a": content, "b": content})
        assert tree(tmp_path) == {"a", "b"}
        assert (tmp_path / "a").read_bytes() == (tmp_path / "b").read_bytes() == content


def test_who_writes_is_waited_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(replacing, "PATIENCE", 0.05)
    (tmp_path / ".burnish-output-0").mkdir(mode=0o700)
    with (tmp_path / ".burnish-output-0" / "lock").open("w") as other:
        _lock(other.fileno(), 2, 1)
        with pytest.raises(TimeoutError, match="another process has been writing there"):
            replace_all(str(tmp_path), {"a": b"new"})
    assert not (tmp_path / "a").exists()
    replace_all(str(tmp_path), {"a": b"new"})
    assert tree(tmp_path) == {"a"}
