"""A process that is killed while it writes leaves whole files; other failures take all back."""

from __future__ import annotations

import fcntl
import os
import re
import signal
import sys
import time
from functools import partial
from pathlib import Path

import pytest

from burnish.commands import replacing
from burnish.commands.replacing import replace_all

from ..suite.processes import at_once, run, started, until
from .kit import PLAIN, shell, tree

CALLS = ("mkdir", "open", "stat", "link", "replace", "unlink", "close")
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
RANDOM = re.compile(r"\.burnish-[0-9a-f]{32}")
"""The names that only a killed process leaves."""


def contents(folder: Path) -> dict[str, bytes]:
    """What the files of a folder hold; what has a random name is left out."""
    files = (path for path in folder.iterdir() if not RANDOM.fullmatch(path.name))
    return {path.name: path.read_bytes() for path in files}


def put_old(folder: Path) -> None:
    for name, content in OLD.items():
        (folder / name).write_bytes(content)


@pytest.mark.parametrize("moment", ["before", "after"])
def test_killed_at_each_call(moment: str, tmp_path: Path) -> None:
    """No file is ever half of one or missing; doing it again completes the set."""
    folders = [tmp_path / str(number) for number in range(50)]
    for folder in folders:
        folder.mkdir()
        put_old(folder)
    killing = run([sys.executable, "-c", KILLED, moment, *map(str, folders)], check=True)
    codes = list(map(int, killing.stdout.split()))
    calls = codes.count(-signal.SIGKILL)
    assert codes == [-signal.SIGKILL] * calls + [0] * (len(folders) - calls)
    assert 20 < calls < len(folders), "not every call was tried, or hardly any was counted"
    stages = []
    for folder in folders:
        found = contents(folder)
        for name, content in found.items():
            assert content in (OLD.get(name), NEW[name]), folder
        assert found.keys() >= OLD.keys(), folder
        stages.append(sum(content == b"new" for content in found.values()))
        left = tree(folder) - found.keys()
        assert all(map(RANDOM.fullmatch, left)), folder
        replace_all(str(folder), NEW)
        assert contents(folder) == NEW
        assert tree(folder) == NEW.keys() | left, "what others may have made is left alone"
    assert stages == sorted(stages), "what was new became old again"
    assert set(stages) == {0, 1, 2, 3}


def test_killed_at_any_time(tmp_path: Path) -> None:
    """Compiles are killed after random times; in the end all is as a compile leaves it."""
    for name in ("old", "new"):
        (tmp_path / f"{name}.burnish").write_text(f"/// {name * 20_000}\n{PLAIN}")
        assert shell("compile", f"{name}.burnish", "-o", name, folder=tmp_path).returncode == 0
    out = tmp_path / "out"
    out.mkdir()
    command = [sys.executable, "-m", "burnish", "compile", "-o", "out"]
    for turn in range(12):
        name, before = ("old", "new")[turn % 2], tree(out)
        with started([*command, f"{name}.burnish"], cwd=tmp_path) as program:
            until(
                lambda before=before: tree(out) != before or not program.runs(),
                "the first file", pause=0,
            )  # fmt: skip
            time.sleep(turn * 1e-4)
        for path, content in contents(out).items():
            assert content in [(tmp_path / each / path).read_bytes() for each in ("old", "new")]
    assert shell("compile", "new.burnish", "-o", "out", folder=tmp_path).returncode == 0
    assert contents(out) == contents(tmp_path / "new")


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

    def replace(source: str, target: str, **options: int) -> None:
        if target == "c":
            raise OSError(16, "Device or resource busy")
        rename(source, target, **options)

    monkeypatch.setattr(os, "replace", replace)
    return tmp_path


def _cannot_link(*_: object, **__: object) -> None:
    raise PermissionError(1, "Operation not permitted")


@pytest.mark.parametrize("links", [True, False])
def test_what_was_renamed_is_taken_back(
    links: bool, refusing: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (refusing / "pointer").symlink_to("nowhere")
    if not links:
        monkeypatch.setattr(os, "link", _cannot_link)
    before = {path.name: path.lstat().st_ino for path in refusing.iterdir()}
    names = ("a", "new", "pointer", "b", "c")
    with pytest.raises(OSError, match=r"busy: '.*/c'$"):
        replace_all(str(refusing), dict.fromkeys(names, b"new"))
    assert {path.name: path.lstat().st_ino for path in refusing.iterdir()} == before
    assert {name: (refusing / name).read_bytes() for name in OLD} == OLD
    assert (refusing / "pointer").readlink() == Path("nowhere")


def test_a_file_system_without_second_names(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(os, "link", _cannot_link)
    put_old(tmp_path)
    replace_all(str(tmp_path), NEW)
    assert contents(tmp_path) == NEW
    assert tree(tmp_path) == NEW.keys()


@pytest.mark.parametrize("call", ["link", "replace"])
def test_an_interruption_takes_back_as_well(
    call: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    put_old(tmp_path)
    real, interruptions = getattr(os, call), [KeyboardInterrupt()]

    def interrupted(source: str, target: str, **options: int) -> None:
        real(source, target, **options)
        if "b" in (source, target) and interruptions:
            raise interruptions.pop()

    monkeypatch.setattr(os, call, interrupted)
    with pytest.raises(KeyboardInterrupt):
        replace_all(str(tmp_path), NEW)
    assert contents(tmp_path) == OLD
    assert tree(tmp_path) == {"a", "b"}


def test_somebody_who_never_ends(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(replacing, "PATIENCE", 0.1)
    put_old(tmp_path)
    other = os.open(tmp_path, os.O_RDONLY)
    fcntl.flock(other, fcntl.LOCK_EX)
    said = f"another process has kept the folder locked for 0.1 seconds: '{tmp_path}'"
    with pytest.raises(TimeoutError, match=re.escape(said)):
        replace_all(str(tmp_path), {"a": b"x"})
    assert tree(tmp_path) == {"a", "b"}
    assert contents(tmp_path) == OLD
    os.close(other)
    replace_all(str(tmp_path), NEW)
    assert contents(tmp_path) == NEW


@pytest.mark.parametrize("number", [9, 37, 95])
def test_a_file_system_without_locks(
    number: int, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def flock(*_: object) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr("fcntl.flock", flock)
    replace_all(str(tmp_path), NEW)
    assert contents(tmp_path) == NEW
    assert tree(tmp_path) == {"a", "b", "c"}


def test_a_file_system_that_ignores_case(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """There, a second file must not silently take the place of the first."""
    put_old(tmp_path)
    monkeypatch.setattr(replacing._Folder, "_at", lambda _, name: name.lower())
    with pytest.raises(FileExistsError, match=r"here `a` is the same name: '.*/A'$"):
        replace_all(str(tmp_path), {"a": b"new", "c": b"new", "A": b"other"})
    assert contents(tmp_path) == OLD
    assert tree(tmp_path) == {"a", "b"}
