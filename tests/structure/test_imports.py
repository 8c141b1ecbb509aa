"""Data flows down the page: the door, targets, compiler, stdlib; nobody imports upwards."""

from __future__ import annotations

import ast
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import pytest

from burnish.targets import registry

from .kit import ROOT, files

BACKENDS = registry.names()


def imports(path: Path) -> Iterator[str]:
    """What a file imports, as full names; of ``from a import b`` both ``a`` and ``a.b``."""
    package = ("burnish", *path.relative_to(ROOT).parent.parts)
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) + 1 - node.level] if node.level else ()
            module = ".".join((*base, *((node.module,) if node.module else ())))
            yield module
            yield from (f"{module}.{alias.name}" for alias in node.names)


def upward(folder: str, *forbidden: str) -> list[str]:
    """The imports of a folder's files that lead into one of the forbidden packages."""
    place = ROOT / folder
    paths = files(place) if place.is_dir() else [place]
    return [
        f"{path.relative_to(ROOT)} imports {name}"
        for path in paths
        if path.suffix == ".py"
        for name in imports(path)
        if any(f"{name}.".startswith(f"burnish.{package}.") for package in forbidden)
    ]


DOOR = ("api", "cli", "commands")


@pytest.mark.parametrize(
    ("folder", "forbidden"),
    [
        ("stdlib", (*DOOR, "targets", "compiler")),
        ("compiler", (*DOOR, "targets")),
        ("targets", DOOR),
        # It prints what is legal, and decides nothing.
        (
            "targets/emit",
            (
                "compiler.passes",
                "compiler.ir.ranges",
                "compiler.ir.rewrite",
                "targets.toolchain",
                *(f"targets.{name}" for name in BACKENDS),
            ),
        ),
        (
            "targets/legalise",
            ("targets.toolchain", "targets.runner", *(f"targets.{name}" for name in BACKENDS)),
        ),
        (
            "targets/toolchain",
            (
                "targets.emit",
                "targets.runner",
                "targets.conformance",
                *(f"targets.{name}" for name in BACKENDS),
            ),
        ),
        (
            "targets/runner",
            ("targets.emit", "targets.conformance", *(f"targets.{name}" for name in BACKENDS)),
        ),
        ("api.py", ("cli", "commands", "targets.toolchain")),
        ("__init__.py", ("cli", "commands", "targets")),
        *(
            (
                f"targets/{name}",
                ("targets.toolchain", *(f"targets.{other}" for other in BACKENDS if other != name)),
            )
            for name in BACKENDS
        ),
    ],
    ids=lambda value: value if isinstance(value, str) else "",
)
def test_direction(folder: str, forbidden: tuple[str, ...]) -> None:
    assert not upward(folder, *forbidden)


def test_the_reader_of_imports_reads_them() -> None:
    found = set(imports(ROOT / "targets" / "registry.py"))
    assert {"burnish.targets.emit.description", "pathlib.Path"} <= found
    assert "burnish.compiler.frontend" in set(imports(ROOT / "api.py"))


COMPILE = """
import sys
import burnish
burnish.compile("material M { color = vec3(1) }", targets=("wgsl",)).materials[0].reflection
for name in ("numpy", "click", "burnish.cli", "burnish.targets.glsl"):
    assert name not in sys.modules, name
for name in ("syntax_errors", "advice", "foreign_syntax"):
    assert f"burnish.compiler.syntax.{name}" not in sys.modules, name
for name in ("toolchain", "runner"):
    assert f"burnish.targets.{name}" not in sys.modules, name
"""


def test_compiling_loads_only_what_it_needs() -> None:
    subprocess.run([sys.executable, "-c", COMPILE], check=True, timeout=60)


COMMAND = """
import sys
from burnish.cli import main
main(sys.argv[1:], standalone_mode=False)
drawing = ("toolchain", "runner", "conformance")
for name in ("numpy", "PIL", *(f"burnish.targets.{part}" for part in drawing)):
    assert name not in sys.modules, name
"""
STARTING = """
for name in ("jinja2", "burnish.api", "burnish.compiler"):
    assert name not in sys.modules, name
"""


@pytest.mark.parametrize(
    ("line", "check"),
    [("--version", STARTING), ("render --help", STARTING), ("compile m.burnish -o out", "")],
)
def test_commands_load_only_what_they_need(line: str, check: str, tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text("material M { color = vec3(1) }")
    command = [sys.executable, "-c", COMMAND + check, *line.split()]
    subprocess.run(command, cwd=tmp_path, check=True, timeout=60)
