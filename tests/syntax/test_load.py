"""Reading files: every way it can fail has a message, and line ends do not matter."""

from __future__ import annotations

from pathlib import Path

import pytest

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.syntax import load
from burnish.compiler.syntax.load import load_source


def complaint(path: Path) -> str:
    """The error about a file that cannot be read."""
    report = Report()
    assert load_source(path, report, "x.burnish") is None
    (found,) = report.diagnostics
    return f"{found.rule.code} {found.message}"


def test_a_missing_file(tmp_path: Path) -> None:
    assert complaint(tmp_path / "none") == "B0001 there is no file `x.burnish`"


@pytest.mark.parametrize("wanted", ["m.burnsh", "m", "M.burnish"])
def test_a_missing_file_is_like_another(tmp_path: Path, wanted: str) -> None:
    (tmp_path / "m.burnish").write_text("a = 1", encoding="utf-8")
    report = Report()
    assert load_source(tmp_path / wanted, report) is None
    (found,) = report.diagnostics
    assert found.hint == f"did you mean `{tmp_path / 'm.burnish'}`?"


def test_a_folder(tmp_path: Path) -> None:
    assert complaint(tmp_path) == "B0002 `x.burnish` is a folder, not a file"


@pytest.mark.parametrize(
    ("content", "reason"),
    [
        (b"a = 1\xff", "byte 5 is 0xff"),
        ("a = 1".encode("utf-16"), "it is UTF-16"),
        (b"\x89PNG\r\n\0", "it contains NUL bytes"),
    ],
)
def test_what_is_no_text(tmp_path: Path, content: bytes, reason: str) -> None:
    path = tmp_path / "x"
    path.write_bytes(content)
    assert complaint(path) == f"B0004 `x.burnish` is not UTF-8 text: {reason}"


def test_what_is_too_large(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(load, "SIZE_LIMIT", 4)
    path = tmp_path / "x"
    path.write_bytes(b"a = 1")
    assert complaint(path) == "B0005 `x.burnish` is larger than 4 bytes"


@pytest.mark.parametrize("end", ["\n", "\r\n", "\r"])
def test_lines_are_counted_whatever_ends_them(tmp_path: Path, end: str) -> None:
    path = tmp_path / "x"
    path.write_bytes(f"\ufeffa = 1 // one{end}\tb = 2".encode())
    source = load_source(path, Report())
    assert source is not None
    assert source.name == str(path)
    assert source.position(source.text.index("b")) == (2, 2)
    assert source.line(1) == "a = 1 // one"
