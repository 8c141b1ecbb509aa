"""Files that are read whole: what is no file, or too large, is refused before it is read."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from burnish.compiler.budget import BudgetError, raised
from burnish.targets.runner.files import FileError, opened, read_file


def refused(path: Path) -> str:
    """The error about a file that errors call `it`."""
    with pytest.raises(FileError) as caught:
        read_file(path, "it")
    return str(caught.value)


def test_all_bytes_of_a_file_are_read(tmp_path: Path) -> None:
    path = tmp_path / "data"
    for content in (b"", b"\0\r\n\x1a\xff" * 10_000):
        path.write_bytes(content)
        assert read_file(path, "it") == content


def test_links_lead_to_files(tmp_path: Path) -> None:
    (tmp_path / "data").write_bytes(b"abc")
    (tmp_path / "link").symlink_to("data")
    assert read_file(tmp_path / "link", "it") == b"abc"


def test_what_is_no_file(tmp_path: Path) -> None:
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "link").symlink_to(os.devnull)
    for path in (tmp_path, tmp_path / "pipe", tmp_path / "link", Path("/dev/zero")):
        assert refused(path) == "cannot read it: it is not a file", path


def test_what_is_not_there(tmp_path: Path) -> None:
    (tmp_path / "circle").symlink_to("circle")
    (tmp_path / "nowhere").symlink_to("gone")
    (tmp_path / "file").touch()
    assert refused(tmp_path / "gone") == "cannot read it: No such file or directory"
    assert refused(tmp_path / "nowhere") == "cannot read it: No such file or directory"
    assert refused(tmp_path / "file" / "x") == "cannot read it: Not a directory"
    assert refused(tmp_path / "circle") == "cannot read it: Too many levels of symbolic links"
    assert refused(tmp_path / ("x" * 5000)) == "cannot read it: File name too long"
    assert refused(tmp_path / "a\0b") == "cannot read it: a name has no character NUL"


def test_a_file_that_is_too_large_is_not_read(tmp_path: Path) -> None:
    """The file is sparse: it takes no space on the disk, but a terabyte of memory if it is read."""
    path = tmp_path / "hole"
    with path.open("wb") as file:
        file.truncate(10**12)
    with pytest.raises(BudgetError) as caught:
        read_file(path, "it")
    assert str(caught.value) == (
        "it has 1,000 GB, and the limit is 256 MB: `--budget file=1000G` raises it"
    )


def test_another_limit_and_a_raised_one(tmp_path: Path) -> None:
    path = tmp_path / "data"
    path.write_bytes(bytes(3000))
    with raised({"document": 2999}), pytest.raises(BudgetError, match=r"the limit is 3 kB: .*3000"):
        read_file(path, "it", "document")
    with raised({"document": 3000}):
        assert len(read_file(path, "it", "document")) == 3000


def test_a_file_that_grows(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "log"
    path.write_bytes(bytes(10))
    before = path.stat()
    path.write_bytes(bytes(12))
    monkeypatch.setattr(os, "fstat", lambda _file: before)
    assert refused(path) == "cannot read it: it grows while it is read"


def test_what_fails_while_it_is_read_is_told(tmp_path: Path) -> None:
    path = tmp_path / "data"
    path.touch()
    with (
        pytest.raises(FileError, match=r"^cannot read it: Input/output error$"),
        opened(path, "it"),
    ):
        raise OSError(5, "Input/output error")


def test_errors_of_those_who_read_stay_as_they_are(tmp_path: Path) -> None:
    path = tmp_path / "data"
    path.touch()
    with pytest.raises(ValueError, match=r"^mine$"), opened(path, "it"):
        raise ValueError("mine")
