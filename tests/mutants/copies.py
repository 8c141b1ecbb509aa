"""A copy of the package, in which one mutant after the other is judged."""

from __future__ import annotations

import json
import os
import shutil
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from subprocess import TimeoutExpired

from ..suite import processes
from .places import ROOT, Mutant

JUDGE = Path(__file__).with_name("judge.py")
MATERIALS = ROOT / "tests" / "conformance" / "materials"

PATIENCE = 60.0
"""How many seconds a mutant has; one that takes longer hangs, or is as good as that."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """What became of a mutant."""

    verdict: str
    """``caught``; ``same`` if no text and nothing that a driver is told differs; or ``survived``:
    something differs, but all pictures agree."""
    by: str = ""
    """The material and the route that show it, or the exception."""
    different: list[str] = field(default_factory=list)
    """Of a survivor, the materials and routes that differ."""


class Copy:
    """A copy of the package in a folder of its own."""

    def __init__(self, folder: Path, materials: Path = MATERIALS) -> None:
        """``folder`` must be empty; it has the unchanged package's behaviour, too."""
        self._folder, self._materials = folder, materials
        self._package = folder / "burnish"
        ignored = shutil.ignore_patterns("__pycache__", "tests", "build", "docs", ".*")
        shutil.copytree(ROOT, self._package, ignore=ignored)
        self._behaviour = folder / "behaviour.json"
        written = self._run("--write")
        assert written.verdict == "written", written

    def judged(self, mutant: Mutant) -> Judgement:
        """The verdict on a mutant; afterwards the copy is unchanged again."""
        path = self._package / mutant.path
        source = path.read_bytes()
        path.write_bytes(mutant.change.applied(source))
        try:
            return self._run(*["--all"] * (mutant.area == "drivers"))
        finally:
            path.write_bytes(source)

    def _run(self, *options: str) -> Judgement:
        command = [
            sys.executable, str(JUDGE), str(self._materials), str(self._behaviour), *options
        ]  # fmt: skip
        # No code may be taken from another mutant's cache.
        env = {**os.environ, "PYTHONPATH": str(self._folder), "PYTHONDONTWRITEBYTECODE": "1"}
        try:
            done = processes.run(command, env=env, cwd=self._folder, limit=PATIENCE)
        except TimeoutExpired:
            return Judgement("caught", "takes too long")
        lines = done.stdout.splitlines()
        if not lines or not lines[-1].startswith("{"):
            return Judgement("caught", f"ends with {done.returncode}: {done.stderr[-200:]}")
        return Judgement(**json.loads(lines[-1]))


@contextmanager
def copy(folder: Path) -> Iterator[Copy]:
    """A copy that is deleted again."""
    folder.mkdir(parents=True)
    try:
        yield Copy(folder)
    finally:
        shutil.rmtree(folder)
