"""The fixtures that several tests of the command line need."""

from __future__ import annotations

from pathlib import Path

import pytest

from .place import Place


@pytest.fixture
def place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Place:
    """A folder to compile in, which is also the current one, and a cache of its own."""
    return Place(tmp_path, monkeypatch, capsys)
