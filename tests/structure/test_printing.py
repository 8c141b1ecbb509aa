"""Commands print through two modules, which write out what a terminal would obey."""

from __future__ import annotations

import ast
from collections.abc import Iterator

import pytest

from .kit import ROOT

PRINTING = ("console.py", "terminal.py")
"""The modules that print for all others."""


def printed(text: str) -> Iterator[str]:
    """The calls in a module that print by themselves, each with its line."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.Call):
            name = ast.unparse(node.func)
            if name in ("print", "click.echo", "click.secho", "click.echo_via_pager") or (
                name.startswith(("sys.stdout", "sys.stderr")) and name.endswith("write")
            ):
                yield f"{node.lineno}: {name}"


def test_only_two_modules_print() -> None:
    paths = [*(ROOT / "commands").rglob("*.py"), *(ROOT / "api").glob("*.py"), *ROOT.glob("*.py")]
    found = {str(path.relative_to(ROOT)): list(printed(path.read_text("utf-8"))) for path in paths}
    assert {name for name, calls in found.items() if calls} == {
        f"commands/{name}" for name in PRINTING
    }


@pytest.mark.parametrize(
    "text", ["print(1)", "click.echo(x)", "sys.stdout.buffer.write(b'')", "click.secho(name)"]
)
def test_what_prints_is_found(text: str) -> None:
    assert len(list(printed(f"def f():\n    {text}\n"))) == 1
