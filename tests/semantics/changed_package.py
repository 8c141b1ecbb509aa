"""Copies of the package with changes, for tests of what adding something to Burnish takes.

A test makes a copy in a folder of its own, and runs scripts there that import it.
"""

from __future__ import annotations

import sys
from collections.abc import Iterable
from pathlib import Path

from ..suite import processes
from ..suite.package import copy_package

GRAMMAR = "compiler/syntax/burnish.lark"
MEMBERS = "compiler/syntax/ast/members.py"
KINDS = "compiler/syntax/ast/member_kinds.py"

Change = tuple[str, str, str]
"""A file, a text in it, and what replaces this text."""

CHECK = """
import sys
import burnish
from burnish.compiler.diagnostics.render import render
(found,) = burnish.check(sys.argv[1])
print(render(found))
"""
"""Prints the one diagnostic of a program."""


def changed_package(folder: Path, changes: Iterable[Change]) -> Path:
    """Copy the package into ``folder``, with changes; returns the folder."""
    copy = copy_package(folder / "burnish")
    for name, before, after in changes:
        text = (copy / name).read_text("utf-8")
        assert before in text, (name, before)
        (copy / name).write_text(text.replace(before, after, 1), "utf-8")
    return folder


def generate(package: Path) -> None:
    """Compute what a changed package keeps, once for more than a few scripts."""
    processes.run([sys.executable, "-m", "burnish.generate"], cwd=package, check=True)


def run(package: Path, script: str, *arguments: str) -> str:
    """The output of a script that imports the changed package."""
    command = [sys.executable, "-c", script, *arguments]
    return processes.run(command, cwd=package, check=True).stdout
