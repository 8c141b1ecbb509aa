"""The imports of a process: a compile and a command load only the modules that they need."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from ..suite.processes import run

COMPILE = """
import sys
import burnish
burnish.compile("material M { color = vec3(1) }", targets=("wgsl",)).materials[0].reflection
for name in ("numpy", "click", "burnish.commands.cli", "burnish.targets.glsl"):
    assert name not in sys.modules, name
for name in ("syntax_errors", "advice", "token_view", "foreign_choices", "foreign_syntax"):
    assert f"burnish.compiler.syntax.{name}" not in sys.modules, name
for name in ("toolchain", "runner"):
    assert f"burnish.targets.{name}" not in sys.modules, name
"""


def test_compiling_loads_only_what_it_needs() -> None:
    run([sys.executable, "-c", COMPILE], check=True)


COMMAND = """
import sys
from burnish.commands.cli import main
try:
    main()
except SystemExit as ended:
    assert not ended.code
assert "burnish.commands.explain" not in sys.modules, "only explain reads its programs"
drawing = ("toolchain", "runner", "conformance")
for name in ("numpy", "PIL", *(f"burnish.targets.{part}" for part in drawing)):
    assert name not in sys.modules, name
"""
STARTING = """
for name in ("jinja2", "burnish.api.entry_points", "burnish.compiler.frontend"):
    assert name not in sys.modules, name
"""


@pytest.mark.parametrize(
    ("line", "check"),
    [
        ("--version", STARTING),
        ("render --help", STARTING),
        ("compile m.burnish -o out --no-cache", ""),
    ],
)
def test_commands_load_only_what_they_need(line: str, check: str, tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text("material M { color = vec3(1) }")
    command = [sys.executable, "-c", COMMAND + check, *line.split()]
    run(command, cwd=tmp_path, check=True)
