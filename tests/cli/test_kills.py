"""Whenever a process is killed while it writes, each file is whole, and the next one writes on."""

from __future__ import annotations

import fcntl
import os
import signal
import sys
import time
from functools import partial
from pathlib import Path
from stat import S_IMODE

import pytest

from burnish.commands import replacing
from burnish.commands.replacing import TEMPORARY, replace_all

from ..suite.processes import at_once, run, started, until
from .kit import PLAIN, shell, tree

CALLS = ("mkdir", "open", "link", "replace", "unlink", "stat", "close")
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
"""Kills a process for each folder while it writes there, at the call with the folder's number."""

OLD = {"a": b"old", "b": b"old"}
NEW = {"a": b"new", "b": b"new", "c": b"new"}


def contents(folder: Path) -> dict[str, bytes]:
    """The contents of a folder's files by their names; temporary files are left out."""
    files = (path for path in folder.iterdir() if not path.name.startswith(TEMPORARY))
    return {path.name: path.read_bytes() for path in files}


def put_old(folder: Path) -> None:
    for name, content in OLD.items():
        (folder / name).write_bytes(content)


@pytest.mark.parametrize("moment", ["before", "after"])
def test_killed_at_each_call(moment: str, tmp_path: Path) -> None:
    """Until the first file is renamed there is the old set, and after the last one the new set; in
    between, each file is whole. The next process writes as if nothing had happened."""
    folders = [tmp_path / str(number) for number in range(50)]
    for folder in folders:
        folder.mkdir()
        put_old(folder)
    killing = run([sys.executable, "-c", KILLED, moment, *map(str, folders)], check=True)
    codes = list(map(int, killing.stdout.split()))
    calls = codes.count(-signal.SIGKILL)
    assert codes == [-signal.SIGKILL] * calls + [0] * (len(folders) - calls)
    assert 15 < calls < len(folders), "not every call was tried, or hardly any was counted"
    found = []
    for folder in folders:
        found.append(contents(folder))
        left = tree(folder) - contents(folder).keys()
        replace_all(str(folder), {"a": b"newer", "other": b"x"})
        assert contents(folder) == {**found[-1], "a": b"newer", "other": b"x"}
        assert tree(folder) == {*contents(folder), *left}, "what another process left is foreign"
    steps = [OLD, OLD | {"a": b"new"}, OLD | {"a": b"new", "b": b"new"}, NEW]
    numbers = [steps.index(each) for each in found]
    assert numbers == sorted(numbers)
    assert set(numbers) == {0, 1, 2, 3}


def test_killed_at_any_time(tmp_path: Path) -> None:
    """Compiles are killed after random times; in the end all is as a compile leaves it."""
    for name in ("old", "new"):
        (tmp_path / f"{name}.burnish").write_text(f"/// {name * 20_000}\n{PLAIN}")
        assert shell("compile", f"{name}.burnish", "-o", name, folder=tmp_path).returncode == 0
    out = tmp_path / "out"
    command = [sys.executable, "-m", "burnish", "compile", "--force", "-o", "out"]
    for turn in range(12):
        name = ("old", "new")[turn % 2]
        with started([*command, f"{name}.burnish"], cwd=tmp_path) as program:
            until(
                lambda: list(out.glob(f"{TEMPORARY}*")) or not program.runs(),
                "the first file", pause=0,
            )  # fmt: skip
            time.sleep(turn * 1e-4)
        for name in contents(out):
            whole = [(tmp_path / each / name).read_bytes() for each in ("old", "new")]
            assert (out / name).read_bytes() in whole
    assert shell("compile", "new.burnish", "--force", "-o", "out", folder=tmp_path).returncode == 0
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
    """A folder in which no new file can have the name `c`, as if something were mounted there."""
    put_old(tmp_path)
    rename, failures = os.replace, [OSError(16, "Device or resource busy")]

    def replace(source: str, target: str, **places: int | None) -> None:
        if target == "c" and failures:
            raise failures.pop()
        rename(source, target, **places)

    monkeypatch.setattr(os, "replace", replace)
    return tmp_path


def _cannot_link(*_: object, **__: object) -> None:
    raise PermissionError(1, "Operation not permitted")


@pytest.mark.parametrize("links", [True, False])
def test_what_was_renamed_is_taken_back(
    links: bool, refusing: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (refusing / "pointer").symlink_to("nowhere")
    (refusing / "c").write_text("old")
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


@pytest.mark.parametrize(("call", "links"), [("link", True), ("replace", True), ("replace", False)])
def test_an_interruption_takes_back_as_well(
    call: str, links: bool, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """The interruption comes directly after the first call that involves `b`."""
    put_old(tmp_path)
    if not links:
        monkeypatch.setattr(os, "link", _cannot_link)
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
    fcntl.flock(other, fcntl.LOCK_EX | fcntl.LOCK_NB)
    with pytest.raises(TimeoutError, match=r"has held this folder for 0\.1 seconds"):
        replace_all(str(tmp_path), {"a": b"x"})
    assert contents(tmp_path) == OLD
    os.close(other)
    replace_all(str(tmp_path), NEW)
    assert contents(tmp_path) == NEW


def test_a_file_system_without_locks(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def flock(*_: object) -> None:
        raise OSError(37, "No locks available")

    monkeypatch.setattr("fcntl.flock", flock)
    replace_all(str(tmp_path), NEW)
    assert contents(tmp_path) == NEW
    assert tree(tmp_path) == {"a", "b", "c"}


def test_a_file_system_that_ignores_case(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """A second file must not silently replace the first one there."""
    put_old(tmp_path)
    monkeypatch.setattr(replacing._Folder, "_at", lambda _, name: name.lower())
    with pytest.raises(FileExistsError, match=r"here `a` is the same name: '.*/A'$"):
        replace_all(str(tmp_path), {"a": b"new", "c": b"new", "A": b"other"})
    assert contents(tmp_path) == OLD
    assert tree(tmp_path) == {"a", "b"}


PLANTED = ("lock", "whole", "new", "new/a", "old", "old/id", "journal")
"""Files of the journal that an earlier version kept in a folder while it wrote there.

It believed the journal when it found one.
"""


@pytest.mark.parametrize("linked", PLANTED)
def test_what_lies_in_the_folder_is_not_believed(linked: str, tmp_path: Path) -> None:
    """Neither read nor changed, wherever links in it lead: somebody else may have put it there."""
    victim, folder = tmp_path / "victim", tmp_path / "out"
    for each in (victim / "sub", folder):
        each.mkdir(parents=True)
    for path in (victim / "id", victim / "sub" / "id"):
        path.write_text("secret")
    _plant(folder / f".burnish-output-{os.getuid()}", linked, victim)
    before = _everything(tmp_path)
    replace_all(str(folder), {"b": b"new"})
    (folder / "b").unlink()
    assert _everything(tmp_path) == before


def _plant(journal: Path, linked: str, victim: Path) -> None:
    if linked == "journal":
        journal.symlink_to(victim)
        return
    for name in ("new", "old"):
        if linked != name:
            (journal / name).mkdir(parents=True)
            (journal / name / "a").write_text("planted")
    (journal / "whole").touch()
    (journal / linked).unlink(missing_ok=True)
    (journal / linked).symlink_to(victim if linked in ("new", "old") else victim / "id")


def _everything(folder: Path) -> dict[str, object]:
    """All entries below a folder: the number, kind, links and content of each."""
    found: dict[str, object] = {}
    for path in folder.rglob("*"):
        status = path.lstat()
        content = path.read_bytes() if path.is_file() else b""
        found[str(path)] = status.st_ino, status.st_mode, status.st_nlink, content
    return found


@pytest.mark.parametrize("name", ["", ".", "..", "../a", "/a", "sub/a", "a\0b"])
def test_a_name_means_a_file_in_the_folder_itself(name: str, tmp_path: Path) -> None:
    (tmp_path / "out" / "sub").mkdir(parents=True)
    with pytest.raises(OSError, match="it is no name of a file"):
        replace_all(str(tmp_path / "out"), {"b": b"new", name: b"new"})
    assert tree(tmp_path) == {"out", "out/sub"}


def test_a_folder_that_is_exchanged_meanwhile(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Files come into the folder that was opened, and not to where its path leads then."""
    out, victim = tmp_path / "out", tmp_path / "victim"
    for each in (out, victim):
        each.mkdir()
    rename = os.replace

    def replace(source: str, target: str, **places: int | None) -> None:
        if not out.is_symlink():
            out.rename(tmp_path / "away")
            out.symlink_to(victim)
        rename(source, target, **places)

    monkeypatch.setattr(os, "replace", replace)
    replace_all(str(out), NEW)
    assert contents(tmp_path / "away") == NEW
    assert tree(victim) == set()


@pytest.mark.parametrize("mask", [0o000, 0o027, 0o777])
def test_files_have_the_rights_that_the_umask_leaves(mask: int, tmp_path: Path) -> None:
    before = os.umask(mask)
    try:
        replace_all(str(tmp_path), {"a": b"new"})
    finally:
        os.umask(before)
    assert S_IMODE((tmp_path / "a").stat().st_mode) == 0o666 & ~mask
    assert tree(tmp_path) == {"a"}
