"""What several tests of the command line need."""

from __future__ import annotations

import signal
from collections.abc import Iterator
from pathlib import Path

import pytest

from .place import Place


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Lets the programs that a test starts be interrupted.

    Who runs the tests in the background may have them ignore it, which programs inherit.
    """
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.fixture
def place(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> Place:
    """A folder to compile in, which is also the current one, and a cache of its own."""
    return Place(tmp_path, monkeypatch, capsys)
