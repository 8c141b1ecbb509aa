"""Writing files where names cannot be relative to an open folder, and nothing locks: on Windows."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from burnish.commands import replacing
from burnish.commands.replacing import replace_all

from .kit import tree


@pytest.fixture(autouse=True)
def windows(monkeypatch: pytest.MonkeyPatch) -> None:
    """Has no open folders, and no links besides symbolic ones."""

    def link(*_: object, **__: object) -> None:
        raise NotImplementedError

    monkeypatch.setattr(replacing, "_ANCHORED", False)
    monkeypatch.setattr(os, "link", link)
    monkeypatch.delattr("fcntl.flock")


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
