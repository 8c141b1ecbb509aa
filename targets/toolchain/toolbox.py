"""The tools of one ``Toolchain``: found once, and run with its time limit and its workers."""

from __future__ import annotations

import sys
from collections.abc import Mapping
from pathlib import Path

from .children import Family
from .limits import COMPILERS
from .process import Outcome, run
from .tools import ToolState, inspect, tool_named
from .workers import Pool, Worker

HERE = Path(__file__).parent


class Toolbox:
    """Runs tools for the ``check`` functions of checkers."""

    def __init__(self, parallel: int, time_limit: float, states: Mapping[str, ToolState]) -> None:
        """``states`` are those of the tools that were looked for before."""
        self.time_limit = time_limit
        """The time limit of one run of one tool, in seconds."""
        self._states = dict(states)
        self._running = Family()
        self.dxc = Pool(parallel, lambda: Worker(self._dxc_command, COMPILERS))
        self.tint = Pool(1, lambda: Worker(self._tint_command, COMPILERS))

    def problem(self, tool: str) -> str | None:
        """The reason why a tool cannot be used; ``None`` if it can."""
        return self._state(tool).problem

    def version(self, tool: str) -> str:
        """A tool's version; empty if the tool is missing."""
        return self._state(tool).version or ""

    def run(
        self, tool: str, *arguments: str, stdin: bytes = b"", folder: Path | None = None
    ) -> Outcome:
        """Run the first program of a tool; the tool must have no ``problem``."""
        command = [self._path(tool), *arguments]
        return run(
            command, time_limit=self.time_limit, stdin=stdin, folder=folder, family=self._running
        )

    def close(self) -> None:
        """End all tools and workers. Callers that wait for one are told that it was killed."""
        self._running.close()
        self.dxc.close()
        self.tint.close()

    def _state(self, tool: str) -> ToolState:
        if tool not in self._states:
            self._states[tool] = inspect(tool_named(tool))
        return self._states[tool]

    def _path(self, tool: str) -> str:
        return str(self._state(tool).paths[0])

    def _dxc_command(self) -> list[str]:
        return [sys.executable, "-I", "-S", str(HERE / "dxc_worker.py"), self._path("dxc")]

    def _tint_command(self) -> list[str]:
        folder = self._state("tint").paths[0].parents[2]
        return [self._path("node"), str(HERE / "tint_worker.mjs"), str(folder)]
