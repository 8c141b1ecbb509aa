"""Fresh processes of a checkout, which start as a user starts them."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from resource import RUSAGE_CHILDREN, getrusage
from time import perf_counter

from .clock import PATIENCE

PLASTIC = Path(__file__).parents[2] / "examples" / "plastic.burnish"


@dataclass(frozen=True, slots=True)
class Start:
    """Fresh processes of one checkout, with a cache folder of their own."""

    environment: Mapping[str, str]
    folder: Path
    runs: int
    """The number of processes of which the fastest one counts."""

    def python(self) -> float:
        """Python with what it always loads."""
        return self._best("-c", "pass")[0]

    def help(self) -> float:
        """A command that compiles nothing."""
        return self._best("-m", "burnish", "--help")[0]

    def changed(self) -> float:
        """A compile of a text that has not been compiled before."""
        found = []
        for number in range(self.runs):
            self._example().write_text(f"{self._text()}// {perf_counter()} {number}\n", "utf-8")
            found.append(self._once(*self._compile())[0])
        return min(found)

    def unchanged(self) -> float:
        """A compile of a text that was compiled before."""
        self._example().write_text(self._text(), "utf-8")
        self._once(*self._compile())
        return self._best(*self._compile())[0]

    def unchanged_wall(self) -> float:
        """The wall-clock time of a compile of a text that was compiled before."""
        self._example().write_text(self._text(), "utf-8")
        self._once(*self._compile())
        return self._best(*self._compile())[1]

    def many(self, count: int) -> float:
        """The wall-clock time of one command for many files that were not compiled before."""
        self.folder.mkdir(exist_ok=True)
        files = [self.folder / f"many{number}.burnish" for number in range(count)]
        for number, file in enumerate(files):
            text = self._text().replace("material Plastic", f"material Plastic{number}")
            file.write_text(f"{text}// {perf_counter()}\n", "utf-8")
        output = str(self.folder / "build")
        try:
            return self._once("-m", "burnish", "compile", *map(str, files), "-o", output)[1]
        except subprocess.CalledProcessError:  # An older checkout takes one file.
            return float("inf")

    def _text(self) -> str:
        return PLASTIC.read_text("utf-8")

    def _example(self) -> Path:
        self.folder.mkdir(exist_ok=True)
        return self.folder / "plastic.burnish"

    def _compile(self) -> tuple[str, ...]:
        output = str(self.folder / "build")
        return "-m", "burnish", "compile", str(self._example()), "--target", "wgsl", "-o", output

    def _best(self, *arguments: str) -> tuple[float, float]:
        found = [self._once(*arguments) for _ in range(self.runs)]
        return min(cpu for cpu, _ in found), min(wall for _, wall in found)

    def _once(self, *arguments: str) -> tuple[float, float]:
        """Milliseconds of CPU and by the clock of one process, as a user starts it."""
        environment = {**self.environment, "BURNISH_CACHE": str(self.folder / "cache")}
        before, start = getrusage(RUSAGE_CHILDREN), perf_counter()
        subprocess.run(
            [sys.executable, *arguments],
            env=environment,
            check=True,
            timeout=PATIENCE,
            stdout=subprocess.DEVNULL,
        )
        after, end = getrusage(RUSAGE_CHILDREN), perf_counter()
        user, system = after.ru_utime - before.ru_utime, after.ru_stime - before.ru_stime
        return 1000 * (user + system), 1000 * (end - start)
