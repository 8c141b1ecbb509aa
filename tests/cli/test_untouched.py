"""An output that is the same as before is left as it is, so that builds do no work for it."""

from __future__ import annotations

import os
from collections.abc import Callable
from pathlib import Path

import pytest

from burnish.commands import replacing
from burnish.commands.replacing import replace_all

from .kit import PLAIN, invoke, shell, tree

PAST = 1_000_000_000


def stamps(folder: Path) -> dict[str, tuple[int, int]]:
    """What a build system compares of each file, and what tells one file from another."""
    return {path.name: (path.stat().st_mtime_ns, path.stat().st_ino) for path in folder.iterdir()}


def age(folder: Path) -> dict[str, tuple[int, int]]:
    """Date all files back; returns their stamps."""
    for path in folder.iterdir():
        os.utime(path, (PAST, PAST))
    return stamps(folder)


def test_what_compiles_to_the_same_is_left(tmp_path: Path) -> None:
    file, out = tmp_path / "m.burnish", tmp_path / "out"
    file.write_text("material A { color = vec3(0.25) }\nmaterial B { color = vec3(0.5) }\n")
    line = ("compile", file, "-t", "wgsl", "-o", out)
    assert invoke(*line).exit_code == 0
    before = age(out)
    assert invoke(*line, "--no-cache").exit_code == 0
    assert stamps(out) == before
    file.write_text("// B is another one.\nmaterial A { color = vec3(0.25) }\nmaterial B {\n}\n")
    assert invoke(*line).exit_code == 0
    changed = {name for name, stamp in stamps(out).items() if stamp != before[name]}
    assert changed == {"B.frag.wgsl"}
    assert tree(out) == set(before)


def test_what_is_written_again_from_the_cache_is_left(tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(PLAIN)
    line = ("compile", "m.burnish", "-o", "out")
    assert shell(*line, folder=tmp_path).returncode == 0
    before = age(tmp_path / "out")
    (tmp_path / "out" / "Plain.frag.wgsl").unlink()
    assert shell(*line, folder=tmp_path).returncode == 0
    changed = {n for n, stamp in stamps(tmp_path / "out").items() if stamp != before[n]}
    assert changed == {"Plain.frag.wgsl"}


def test_all_commands_that_write_leave_it(tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(PLAIN)
    out = tmp_path / "out"
    out.mkdir()
    lines = (
        ("graph", tmp_path / "m.burnish", "-o", out / "g.svg"),
        ("export", tmp_path / "m.burnish", "-o", out / "g.json"),
        ("corpus", "--only", "mod", "-o", out),
    )
    for line in lines:
        assert invoke(*line).exit_code == 0
    before = age(out)
    for line in lines:
        assert invoke(*line).exit_code == 0
    assert stamps(out) == before


def _longer(file: Path) -> None:
    file.write_text("same and more")


def _linked(file: Path) -> None:
    (file.parent.parent / "real").write_text("same")
    file.unlink()
    file.symlink_to(file.parent.parent / "real")


def _twice(file: Path) -> None:
    os.link(file, file.parent.parent / "second")


def _unreadable(file: Path) -> None:
    file.unlink()
    os.mkfifo(file)


@pytest.mark.skipif(os.name == "nt", reason="pipes and links")
@pytest.mark.parametrize("spoil", [_longer, _linked, _twice, _unreadable])
def test_only_an_own_file_with_one_name_is_left(
    spoil: Callable[[Path], None], tmp_path: Path
) -> None:
    out = tmp_path / "out"
    replace_all(str(out), {"a": b"same", "b": b"same"})
    spoil(out / "a")
    kept, spoilt = (out / "b").stat().st_ino, (out / "a").lstat().st_ino
    replace_all(str(out), {"a": b"same", "b": b"same"})
    assert (out / "a").read_bytes() == b"same"
    assert not (out / "a").is_symlink()
    assert (out / "a").lstat().st_ino != spoilt
    assert (out / "b").stat().st_ino == kept


def test_what_another_process_changes_meanwhile_is_written(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Between the comparison and the moment when names change, another process may write."""
    replace_all(str(tmp_path), {"a": b"same", "b": b"old"})
    lock = replacing._Folder.lock

    def late(folder: replacing._Folder) -> None:
        (tmp_path / "a").write_bytes(b"meanwhile")
        lock(folder)

    monkeypatch.setattr(replacing._Folder, "lock", late)
    replace_all(str(tmp_path), {"a": b"same", "b": b"new"})
    assert {path.name: path.read_bytes() for path in tmp_path.iterdir()} == {
        "a": b"same", "b": b"new",
    }  # fmt: skip


def test_a_failure_leaves_what_was_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    replace_all(str(tmp_path), {"a": b"same", "b": b"old"})
    before = stamps(tmp_path)

    def failing(*_names: str) -> None:
        raise OSError(5, "it fails")

    monkeypatch.setattr(replacing._Folder, "rename", failing)
    with pytest.raises(OSError, match="it fails"):
        replace_all(str(tmp_path), {"a": b"same", "b": b"new"})
    assert stamps(tmp_path) == before
