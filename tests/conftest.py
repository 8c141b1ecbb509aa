"""Fixtures for all tests. Every test has its graphs verified after each pass."""

from __future__ import annotations

import os
from importlib.metadata import Distribution, PackageNotFoundError
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from burnish.compiler.passes.checkpoint import VARIABLE
from burnish.targets.toolchain import places

os.environ[VARIABLE] = "1"

# How long an example takes says more about the machine than about Burnish.
settings.register_profile("burnish", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("burnish")

pytest_plugins = ["burnish.tests.suite.account", "burnish.tests.suite.quick"]


@pytest.fixture
def no_tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Simulates a machine without any tool; its cache folder, which is returned, is its file
    system."""

    def no_package(name: str) -> Distribution:
        raise PackageNotFoundError(name)

    monkeypatch.setenv("BURNISH_TOOLS", str(tmp_path))
    monkeypatch.setenv("PATH", "")
    monkeypatch.setattr(places, "ROOT", tmp_path)
    monkeypatch.setattr(places, "distribution", no_package)
    return tmp_path
