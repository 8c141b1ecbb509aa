"""The toolchain that all tests of this folder share, and fake tools that misbehave."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

import pytest

from burnish.targets.toolchain import Toolchain

PlantTool = Callable[[str, str, str], None]


@pytest.fixture(scope="session")
def toolchain() -> Iterator[Toolchain]:
    """The real tools. ``make test`` installs them, so a missing tool fails the test."""
    with Toolchain() as tools:
        yield tools


@pytest.fixture
def plant_tool(no_tools: Path) -> PlantTool:
    """Puts a shell script into the cache that prints a version, and otherwise does what it is
    given."""

    def plant(path: str, version: str, deed: str) -> None:
        script = no_tools / path
        script.parent.mkdir(parents=True, exist_ok=True)
        script.write_text(
            f'#!/bin/sh\nif [ "$1" = --version ]; then echo "{version}"; exit; fi\n{deed}\n'
        )
        script.chmod(0o755)

    return plant
