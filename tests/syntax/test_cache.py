"""Cached data survive damage and unwritable folders; old ones go; what others wrote is ignored."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from burnish.compiler import cache
from burnish.compiler.cache import digest, load, store

KEY, OTHER = "0123456789abcdef", "fedcba9876543210"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The private folder, which is not there yet."""
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "cache"))
    return tmp_path / "cache" / "private"


def test_what_is_stored_is_found(folder: Path) -> None:
    assert load("x", KEY) is None
    store("x", KEY, b"first")
    store("x", OTHER, b"other")
    store("x", KEY, b"second")
    assert (load("x", KEY), load("x", OTHER), load("y", KEY)) == (b"second", b"other", None)
    assert {path.name for path in (folder / "x").iterdir()} == {KEY, OTHER}


@pytest.mark.parametrize("damage", [b"", b"short", b"x" * 100])
def test_damage_is_noticed(folder: Path, damage: bytes) -> None:
    store("x", KEY, b"value")
    (folder / "x" / KEY).write_bytes(damage)
    assert load("x", KEY) is None
    store("x", KEY, b"value")
    assert load("x", KEY) == b"value"


def test_a_folder_that_cannot_be_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "file").touch()
    monkeypatch.setenv("BURNISH_CACHE", str(tmp_path / "file" / "cache"))
    store("x", KEY, b"value")
    assert load("x", KEY) is None


@pytest.mark.parametrize("mask", [0, 0o22, 0o777])
def test_all_is_private_whatever_the_mask_is(folder: Path, mask: int) -> None:
    before = os.umask(mask)
    try:
        store("x", KEY, b"value")
    finally:
        os.umask(before)
    modes = [path.stat().st_mode & 0o777 for path in (folder, folder / "x", folder / "x" / KEY)]
    assert modes == [0o700, 0o700, 0o600]
    assert load("x", KEY) == b"value"


@pytest.mark.parametrize("mode", [0o777, 0o770, 0o702, 0o755])
def test_a_folder_that_others_can_use_is_not_used(folder: Path, mode: int) -> None:
    store("x", KEY, b"value")
    folder.chmod(mode)
    assert load("x", KEY) is None
    store("x", OTHER, b"value")
    assert [path.name for path in (folder / "x").iterdir()] == [KEY]


def test_a_file_that_others_can_write_is_not_used(folder: Path) -> None:
    store("x", KEY, b"value")
    (folder / "x" / KEY).chmod(0o666)
    assert load("x", KEY) is None


def test_links_are_not_followed(folder: Path, tmp_path: Path) -> None:
    store("x", KEY, b"value")
    (folder / "x" / OTHER).symlink_to(KEY)
    assert load("x", OTHER) is None
    folder.rename(tmp_path / "elsewhere")
    folder.symlink_to(tmp_path / "elsewhere")
    assert load("x", KEY) is None
    store("x", OTHER, b"value")
    assert (tmp_path / "elsewhere" / "x" / OTHER).is_symlink()


def test_a_link_to_a_folder_is_not_followed(folder: Path, tmp_path: Path) -> None:
    store("x", KEY, b"value")
    (folder / "x").rename(tmp_path / "elsewhere")
    (folder / "x").symlink_to(tmp_path / "elsewhere")
    assert load("x", KEY) is None
    store("x", OTHER, b"value")
    assert [path.name for path in (tmp_path / "elsewhere").iterdir()] == [KEY]


def test_pipes_are_not_waited_for(folder: Path) -> None:
    store("x", KEY, b"value")
    os.mkfifo(folder / "x" / OTHER, 0o600)
    assert load("x", OTHER) is None


@pytest.mark.parametrize("path", ["", f"x/{KEY}"])
def test_what_belongs_to_another_user_is_not_used(
    folder: Path, path: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    """``chown`` needs a privilege that tests may lack, so the files stay, and the user changes."""
    store("x", KEY, b"value")
    true = os.lstat(folder / path)
    real = {name: getattr(os, name) for name in ("lstat", "fstat")}

    def owned(name: str, of: str | int) -> os.stat_result:
        status: os.stat_result = real[name](of)
        fields = list(status)
        fields[4] += status.st_ino == true.st_ino
        return os.stat_result(fields)

    for name in real:
        monkeypatch.setattr(os, name, lambda of, name=name: owned(name, of))
    assert load("x", KEY) is None
    store("x", OTHER, b"value")
    assert (folder / "x" / OTHER).exists() == bool(path)


def written(folder: Path, number: int) -> Path:
    """The file of a value that is written ``number`` seconds after 1970."""
    path = folder / "x" / f"{number:016x}"
    store("x", path.name, b"value")
    os.utime(path, (number, number))
    return path


def test_the_oldest_values_make_room(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(cache, "KEPT", 3)
    paths = [written(folder, number) for number in range(1, 6)]
    assert set((folder / "x").iterdir()) == set(paths[2:])


def test_halves_of_values_go_and_other_names_stay(
    folder: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(cache, "KEPT", 1)
    half = written(folder, 1).rename(folder / "x" / f"{1:016x}.{7:016x}.tmp")
    store("y", KEY, b"value")
    last = written(folder, 2)
    assert not half.exists()
    assert list((folder / "x").iterdir()) == [last]
    assert load("y", KEY) == b"value"


@pytest.mark.usefixtures("folder")
def test_what_cannot_be_deleted_only_takes_room(monkeypatch: pytest.MonkeyPatch) -> None:
    def refuse(path: str) -> None:
        raise PermissionError(path)

    monkeypatch.setattr(cache, "KEPT", 1)
    monkeypatch.setattr(os, "unlink", refuse)
    store("x", KEY, b"one")
    store("x", OTHER, b"two")
    assert (load("x", KEY), load("x", OTHER)) == (b"one", b"two")


def test_digests_are_the_same_in_every_python() -> None:
    """They have nothing to do with the version: these were computed by CPython 3.11."""
    assert (digest(b""), digest(b"burnish")) == ("2c530c1562a7fbd1", "de99ccab372c9b22")
