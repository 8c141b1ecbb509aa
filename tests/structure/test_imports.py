"""The imports of a process: a compile and a command load only the modules that they need."""

from __future__ import annotations

import os
import sys
from pathlib import Path

import pytest

from burnish.compiler.watching import VARIABLE

from ..suite.processes import run
from .kit import ROOT

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


LOADED = """
from burnish.commands.cli import main
import sys
try:
    main()
finally:
    print(*sys.modules)
"""
MOST = 430
"""The largest number of modules of Burnish that a compile of one small material loads: each takes a
fifth of a millisecond."""
NOT_FOR_ALL = (
    "compiler.documents.plan", "compiler.ir.frame", "compiler.ir.verify",
    "compiler.passes.corners_in_buffer", "compiler.passes.emit_strips",
    "compiler.passes.lower_capture", "compiler.passes.lower_expansion",
    "compiler.passes.lower_tessellation", "compiler.planning", "compiler.reference.picture",
    "compiler.reflection.plan", "compiler.semantics.frames.", "stdlib.builtins.elsewhere",
    "stdlib.builtins.foreign_words", "stdlib.comparisons",
    "compiler.semantics.shading.kernels.kernel", "targets.conformance", "targets.emit.strips",
    "stdlib.other_names", "targets.runner", "targets.toolchain", "targets.web_host",
)  # fmt: skip
"""The beginnings of the names of modules that are for frames, kernels, expansion, mistakes and so
on, and of those that are for other commands."""
OTHERS = {"click", "jinja2", "lark", "numpy", "tomllib", "datetime", "dataclasses", "inspect"}


def test_a_compile_loads_only_what_its_material_needs(tmp_path: Path) -> None:
    """Modules are loaded where they are used, if most materials do not use them."""
    line = ["compile", str(ROOT / "examples/plastic.burnish"), "-o", str(tmp_path), "--no-cache"]
    environment = {name: value for name, value in os.environ.items() if name != VARIABLE}
    said = run([sys.executable, "-c", LOADED, *line], env=environment, check=True).stdout
    loaded = set(said.splitlines()[-1].split())
    own = {name.removeprefix("burnish.") for name in loaded if name.startswith("burnish.")}
    assert [name for name in own if name.startswith(NOT_FOR_ALL)] == []
    assert len(own) <= MOST, len(own)
    assert not loaded & OTHERS
