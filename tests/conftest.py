"""What holds in all tests: graphs are verified after every pass. And a machine without tools."""

from __future__ import annotations

import os
from importlib.metadata import Distribution, PackageNotFoundError
from pathlib import Path

import pytest

from burnish.compiler.passes.checkpoint import VARIABLE
from burnish.targets.toolchain import places

os.environ[VARIABLE] = "1"


@pytest.fixture
def no_tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A machine without any tool; returns its cache folder, which is its whole file system too."""

    def no_package(name: str) -> Distribution:
        raise PackageNotFoundError(name)

    monkeypatch.setenv("BURNISH_TOOLS", str(tmp_path))
    monkeypatch.setenv("PATH", "")
    monkeypatch.setattr(places, "ROOT", tmp_path)
    monkeypatch.setattr(places, "distribution", no_package)
    return tmp_path
