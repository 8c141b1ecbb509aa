"""A command that ends for any reason also ends its child processes, and their children, at once."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Mapping
from pathlib import Path

import pytest

from ..suite.processes import started, until
from .kit import tree

MATERIAL = "material Good { color = vec3(uv, 0.5) }\n"
COMMANDS = {
    "compile good.burnish -t glsl:gl330 --validate -o out": "glslangValidator",
    "conform good.burnish --routes lavapipe:glsl": "glslangValidator",
    "conform good.burnish --routes chromium:webgl2": "--remote-debugging-pipe",
    "render good.burnish --on lavapipe:glsl -o out.png": "glslangValidator",
    "gallery . -o out --routes lavapipe:glsl --on lavapipe:glsl --size 16": "glslangValidator",
    "doctor": "glslangValidator",
}
"""The commands, each with words of the command line of the program that it is waiting for."""
SIGNALS = {signal.SIGINT: 130, signal.SIGTERM: 143, signal.SIGHUP: 129, signal.SIGKILL: -9}
"""The exit code after each of them."""


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """A folder with a material, beside tools of which one never answers."""
    (tmp_path / "place").mkdir()
    (tmp_path / "place" / "good.burnish").write_text(MATERIAL)
    return tmp_path / "place"


def environment(place: Path, command: str) -> Mapping[str, str]:
    """An environment in which glslang ends only for ``--version``, and for ``doctor`` never."""
    tool = place.parent / "tools" / "glslang" / "bin" / "glslangValidator"
    tool.parent.mkdir(parents=True)
    version = "" if command == "doctor" else 'test "$1" = --version && '
    tool.write_text(
        f"#!/bin/sh\n{version}echo 'Glslang Version: 11:12.0.0' && {'' if version else 'false && '}"
        "exit\n/bin/sleep 600 &\n/bin/sleep 601\n"
    )
    tool.chmod(0o755)
    return {
        **os.environ,
        "BURNISH_TOOLS": str(tool.parents[2]),
        "BURNISH_CACHE": str(place.parent / "cache"),
    }


@pytest.mark.usefixtures("interruptible")
@pytest.mark.parametrize("number", SIGNALS)
@pytest.mark.parametrize("command", COMMANDS)
def test_nothing_is_left(command: str, number: signal.Signals, place: Path) -> None:
    words = [sys.executable, "-m", "burnish", *command.split()]
    with started(words, cwd=place, env=environment(place, command)) as program:
        until(lambda: waits(program.family(), COMMANDS[command]), "what it waits for", pause=0.1)
        program.signal(number)
        assert program.exit_code(20) == SIGNALS[number]
        until(lambda: not program.family(), "the end of all that was started", limit=20)
        said = program.ended()
    assert "Traceback" not in said.stderr
    assert tree(place) == {"good.burnish"}


def waits(family: Mapping[int, str], words: str) -> bool:
    return any(words in text for text in family.values())
