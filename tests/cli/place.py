"""A folder in which a test compiles, and says whether that was done before.

The fixture ``place`` of ``conftest.py`` makes one for each test.
"""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path
from typing import NamedTuple

import pytest

from burnish.commands.group import burnish
from burnish.commands.results import answer, ask

from ..suite import processes

TOLD = """
import sys
from burnish.commands.cli import main
try:
    main()
finally:
    print("COMPILED" if "burnish.api.entry_points" in sys.modules else "KNOWN", file=sys.stderr)
"""


class Run(NamedTuple):
    """The result of a command."""

    how: str
    """``KNOWN`` if it was done before, else ``COMPILED``."""
    code: int
    output: str
    errors: str


class Place:
    """A folder with a file to compile, and a cache of its own."""

    def __init__(
        self, folder: Path, patch: pytest.MonkeyPatch, captured: pytest.CaptureFixture[str]
    ) -> None:
        self.folder = folder / "place"
        self.folder.mkdir()
        self.cache = folder / "cache"
        self._patch = patch
        self._captured = captured
        self.environment({"BURNISH_CACHE": str(self.cache)})
        patch.delenv("BURNISH_VERIFY")
        patch.chdir(self.folder)

    def environment(self, variables: Mapping[str, str]) -> None:
        """Set variables of the environment."""
        for name, value in variables.items():
            self._patch.setenv(name, value)

    def write(self, **texts: str) -> None:
        """Write files: ``main="…"`` is ``main.burnish``."""
        for name, text in texts.items():
            (self.folder / f"{name}.burnish").write_text(text, "utf-8")

    def run(self, *options: str, output: str = "out") -> Run:
        """Compile in this process, as ``cli.main`` does."""
        command = ["compile", "main.burnish", "-t", "wgsl", "-o", output, *options]
        question = ask(command)
        if question is not None and answer(question):
            return Run("KNOWN", 0, *self._captured.readouterr())
        with pytest.raises(SystemExit) as ended:
            burnish.main(command, obj=question)
        code = ended.value.code
        assert isinstance(code, int)
        return Run("COMPILED", code, *self._captured.readouterr())

    def process(self, *options: str, output: str = "out") -> Run:
        """Compile in a process of its own."""
        command = ["compile", "main.burnish", "-t", "wgsl", "-o", output, *options]
        run = processes.run([sys.executable, "-c", TOLD, *command], cwd=self.folder)
        *errors, how = run.stderr.splitlines(keepends=True)
        return Run(how.strip(), run.returncode, run.stdout, "".join(errors))

    def results(self) -> list[Path]:
        """The answers that are kept."""
        return sorted(self.cache.glob("private/result/*"))

    def fragment(self, output: str = "out") -> str:
        """The shader that was written."""
        return (self.folder / output / "Main.frag.wgsl").read_text("utf-8")
