"""Whenever a process is killed while it writes, the next one puts its files right."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from functools import partial
from pathlib import Path
from stat import S_IMODE

import pytest

from burnish.commands import replacing
from burnish.commands.replacing import replace_all

from ..suite.processes import Background, at_once, run, started, until
from .kit import PLAIN, shell, tree

CALLS = ("mkdir", "chmod", "open", "link", "replace", "unlink", "rmdir", "listdir")
"""The system calls at which a process may be killed."""

KILLED = f"""
import os, signal, sys
from burnish.commands import replacing

def killed(folder, fatal, moment):
    count = 0

    def counted(call):
        def replacement(*arguments, **options):
            nonlocal count
            count += 1
            if (count, moment) == (fatal, "before"):
                os.kill(os.getpid(), signal.SIGKILL)
            try:
                return call(*arguments, **options)
            finally:
                if count == fatal:
                    os.kill(os.getpid(), signal.SIGKILL)
        return replacement

    replacing.open = counted(open)
    for name in {CALLS}:
        setattr(os, name, counted(getattr(os, name)))
    replacing.replace_all(folder, {{"a": b"new", "b": b"new", "c": b"new"}})
    os._exit(0)

moment = sys.argv[1]
for fatal, folder in enumerate(sys.argv[2:], start=1):
    child = os.fork()
    if child == 0:
        killed(folder, fatal, moment)
    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""
"""For each folder in turn, a process that writes there and is killed at the call of that number."""

OLD = {"a": b"old", "b": b"old"}
NEW = {"a": b"new", "b": b"new", "c": b"new"}


def contents(folder: Path) -> dict[str, bytes]:
    """What the files of a folder hold; a journal is left out."""
    return {path.name: path.read_bytes() for path in folder.iterdir() if path.is_file()}


def put_old(folder: Path) -> None:
    for name, content in OLD.items():
        (folder / name).write_bytes(content)


@pytest.mark.parametrize("moment", ["before", "after"])
def test_killed_at_each_call(moment: str, tmp_path: Path) -> None:
    """The next process writes another file, and leaves the whole old set or the whole new one."""
    folders = [tmp_path / str(number) for number in range(40)]
    for folder in folders:
        folder.mkdir()
        put_old(folder)
    killing = run([sys.executable, "-c", KILLED, moment, *map(str, folders)], check=True)
    codes = list(map(int, killing.stdout.split()))
    calls = codes.count(-signal.SIGKILL)
    assert codes == [-signal.SIGKILL] * calls + [0] * (len(folders) - calls)
    assert 20 < calls < len(folders), "not every call was tried, or hardly any was counted"
    found = []
    for folder in folders:
        for name, content in contents(folder).items():
            assert content in (OLD.get(name), NEW[name]), folder
        replace_all(str(folder), {"other": b"x"})
        rest = contents(folder)
        assert rest.pop("other") == b"x"
        assert rest in (OLD, NEW), folder
        assert tree(folder) == {"other", *rest}, folder
        found.append(rest)
    assert found == sorted(found, key=lambda rest: rest == NEW), "what was new became old again"
    assert found[0] == OLD
    assert found[-1] == NEW


def test_killed_at_any_time(tmp_path: Path) -> None:
    """Compiles are killed after random times; in the end all is as a compile leaves it."""
    for name in ("old", "new"):
        (tmp_path / f"{name}.burnish").write_text(f"/// {name * 20_000}\n{PLAIN}")
        assert shell("compile", f"{name}.burnish", "-o", name, folder=tmp_path).returncode == 0
    out = tmp_path / "out"
    command = [sys.executable, "-m", "burnish", "compile", "-o", "out"]
    for turn in range(12):
        name = ("old", "new")[turn % 2]
        with started([*command, f"{name}.burnish"], cwd=tmp_path) as program:
            until(
                lambda: list(out.glob(".burnish-*/new")) or not program.runs(),
                "the first file", pause=0,
            )  # fmt: skip
            time.sleep(turn * 1e-4)
        for path in filter(Path.is_file, out.iterdir()):
            whole = [(tmp_path / each / path.name).read_bytes() for each in ("old", "new")]
            assert path.read_bytes() in whole
    assert shell("compile", "new.burnish", "-o", "out", folder=tmp_path).returncode == 0
    assert tree(out) == tree(tmp_path / "new")
    for path in out.iterdir():
        assert path.read_bytes() == (tmp_path / "new" / path.name).read_bytes()


def test_writers_take_turns(tmp_path: Path) -> None:
    """The files that several threads have written at the same time are those of one of them."""

    def write(number: int) -> None:
        content = str(number).encode()
        for _ in range(50):
            replace_all(str(tmp_path), dict.fromkeys("abc", content))

    at_once([partial(write, number) for number in range(4)])
    assert tree(tmp_path) == {"a", "b", "c"}
    assert len(set(contents(tmp_path).values())) == 1


@pytest.fixture
def refusing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A folder in which `c` cannot be renamed over, as if it were mounted."""
    put_old(tmp_path)
    rename = os.replace

    def replace(source: str, target: str) -> None:
        if Path(target).name == "c" and "old" not in source:
            raise OSError(16, "Device or resource busy")
        rename(source, target)

    monkeypatch.setattr(os, "replace", replace)
    return tmp_path


@pytest.mark.parametrize("links", [True, False])
def test_what_was_renamed_is_taken_back(
    links: bool, refusing: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def link(*_: object, **__: object) -> None:
        raise PermissionError(1, "Operation not permitted")

    if not links:
        monkeypatch.setattr(os, "link", link)
    with pytest.raises(OSError, match="busy"):
        replace_all(str(refusing), {"a": b"new", "new": b"new", "b": b"new", "c": b"new"})
    assert contents(refusing) == OLD
    assert tree(refusing) == {"a", "b"}


def test_an_interruption_takes_back_as_well(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put_old(tmp_path)
    rename = os.replace

    def replace(source: str, target: str) -> None:
        rename(source, target)
        if Path(target).name == "b" and Path(source).parent.name == "new":
            raise KeyboardInterrupt

    monkeypatch.setattr(os, "replace", replace)
    with pytest.raises(KeyboardInterrupt):
        replace_all(str(tmp_path), NEW)
    assert contents(tmp_path) == OLD
    assert tree(tmp_path) == {"a", "b"}


def test_somebody_who_never_ends(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(replacing, "PATIENCE", 0.1)
    put_old(tmp_path)
    begun, done = threading.Event(), threading.Event()
    write = replacing._write

    def waiting(path: str, content: bytes) -> None:
        if threading.current_thread() is not threading.main_thread():
            begun.set()
            done.wait(60)
        write(path, content)

    monkeypatch.setattr(replacing, "_write", waiting)
    other = Background(partial(replace_all, str(tmp_path), NEW))
    begun.wait(60)
    with pytest.raises(TimeoutError, match=r"if there is none, delete `.*\.burnish-output-\d+`"):
        replace_all(str(tmp_path), {"a": b"x"})
    assert contents(tmp_path) == OLD
    done.set()
    other.returned()
    assert contents(tmp_path) == NEW


def test_a_file_system_without_locks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def flock(*_: object) -> None:
        raise OSError(37, "No locks available")

    monkeypatch.setattr("fcntl.flock", flock)
    replace_all(str(tmp_path), NEW)
    assert contents(tmp_path) == NEW
    assert tree(tmp_path) == {"a", "b", "c"}


@pytest.mark.parametrize("kind", ["file", "link", "other"])
def test_a_journal_that_is_not_ours(
    kind: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Who may write into a shared folder must not choose what others put there."""
    folder, journal = tmp_path / "out", tmp_path / "out" / f".burnish-output-{os.getuid()}"
    planted = tmp_path / "planted"
    (planted / "new").mkdir(parents=True)
    (planted / "whole").touch()
    (planted / "new" / "a").write_bytes(b"planted")
    folder.mkdir()
    if kind == "file":
        journal.touch()
    elif kind == "link":
        journal.symlink_to(planted)
    else:
        planted.rename(journal)
        journal = journal.rename(folder / ".burnish-output-12345")
        monkeypatch.setattr(os, "getuid", lambda: 12345)
    with pytest.raises(PermissionError, match="is in the way, and is not a folder of this user"):
        replace_all(str(folder), {"b": b"new"})
    assert contents(folder).keys() <= {journal.name}


@pytest.mark.parametrize("mask", [0o000, 0o077, 0o777])
def test_others_can_add_nothing_whatever_the_umask(
    mask: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    modes: list[int] = []

    def rename(source: str, target: str) -> None:
        modes.extend(S_IMODE(each.lstat().st_mode) for each in Path(source).parents[:2])
        Path(source).rename(target)

    monkeypatch.setattr(os, "replace", rename)
    before = os.umask(mask)
    try:
        replace_all(str(tmp_path), {"a": b"new"})
    finally:
        os.umask(before)
    assert modes == [0o700, 0o700]
    assert [each.name for each in tmp_path.iterdir()] == ["a"]
