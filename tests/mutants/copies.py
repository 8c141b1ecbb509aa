"""A copy of the package, in which one mutant after the other is judged."""

from __future__ import annotations

import json
import os
import shutil
import sys
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from subprocess import DEVNULL, PIPE
from typing import Any

from ..suite.processes import Program, started
from .places import DRAWING, ROOT, Mutant

JUDGE = "judge"
"""The program beside this file that is asked; it is a package of modules."""
MATERIALS = ROOT / "tests" / "conformance" / "materials"
FRAMES = ROOT / "tests" / "mutants" / "frames"
JUDGES = (MATERIALS, FRAMES)
"""The folders whose materials and frames judge."""

MOST = 16
"""The number of materials that judge a mutant, unless the caller asks for more.

If the first sixteen materials that run a mutant's line do not show it, others rarely do.
"""
LIMIT = 300.0
"""The limit of an answer, in seconds; the judge gives up earlier."""
LONG = 3600.0
"""The limit of an answer about all materials, in seconds."""


@dataclass(frozen=True, slots=True)
class Judgement:
    """The result of judging a mutant."""

    verdict: str
    """``caught``; ``unreached`` if no material runs the line; ``same`` if no text and nothing that
    a driver is told differs; ``same code`` if only texts differ, and compilers make the same code
    of them; or ``survived``: something differs, but all pictures agree."""
    by: str = ""
    """The material and the route that show it, or the exception."""
    different: list[str] = field(default_factory=list)
    """The materials and routes of a survivor that differ."""


@dataclass(frozen=True, slots=True)
class Known:
    """The facts about the unchanged package."""

    behaviour: Mapping[str, str]
    """Digests of what each material comes to on each route."""
    reached: Mapping[str, Sequence[str]]
    """The materials that run each line, ``path:line``; for ``""`` the import runs it."""
    materials: Sequence[str]
    """All of them, in their order."""

    def runs(self, path: str, materials: Iterable[str]) -> dict[str, set[str]]:
        """The lines of a file that each of some materials runs."""
        found: dict[str, set[str]] = {name: set() for name in materials}
        for line, names in self.reached.items():
            if line.startswith(f"{path}:"):
                for name in found.keys() & set(names):
                    found[name].add(line)
        return found


class Copy:
    """A copy of the package in a folder of its own, and the process that judges mutants of it."""

    def __init__(self, folder: Path, judge: Program, package: Path) -> None:
        """Take the copy in ``folder``, which has the package; see ``copy``."""
        self._folder, self._judge, self._package = folder, judge, package

    def known(self, kept: Path | None = None, *, drawn: bool = False) -> Known:
        """The behaviour of all materials without a mutant, and the lines that they run.

        With ``drawn``, also the codes that compilers make of their texts, and the lines that run to
        draw them. The answer is taken from the file ``kept``, or else written there, so that the
        next run need not compute it again.
        """
        into = kept or self._folder / "known.json"
        if not into.exists():
            self._answer({"kind": "known", "into": str(into), "everything": drawn}, LONG)
        behaviour, reached = json.loads(into.read_text("utf-8")).values()
        materials = dict.fromkeys(name for names in reached.values() for name in names if name)
        return Known(behaviour, reached, sorted(materials))

    def judged(self, mutant: Mutant, known: Known, most: int = MOST) -> Judgement:
        """The verdict on a mutant, by at most so many materials; afterwards the copy is unchanged
        again."""
        materials = _that_show(mutant, known, most)
        if not materials:
            return Judgement("unreached")
        labels = {f"{Path(each).stem}{each[each.rindex(': ') :]}" for each in materials}
        path = self._package / mutant.path
        status, source = path.stat(), path.read_bytes()
        path.write_bytes(mutant.change.applied(source))
        try:
            answer = self._answer({
                "kind": "mutant",
                "path": mutant.path,
                "materials": materials,
                "known": {k: v for k, v in known.behaviour.items() if k.split(", ")[0] in labels},
                "everything": mutant.area in DRAWING,
            }, LIMIT)  # fmt: skip
        finally:
            path.write_bytes(source)
            # Python takes code from its cache if a file has the time that it had.
            os.utime(path, ns=(status.st_atime_ns, status.st_mtime_ns))
        return Judgement(**answer)

    def _answer(self, question: Mapping[str, Any], limit: float) -> dict[str, Any]:
        self._judge.write(json.dumps(question).encode() + b"\n")
        line = self._judge.line(limit)
        assert line.endswith(b"\n"), "the judge has ended"
        answer: dict[str, Any] = json.loads(line)
        return answer


def _that_show(mutant: Mutant, known: Known, most: int) -> Sequence[str]:
    """At most ``most`` of the materials that run a mutant's lines.

    Together they run as much of its file as possible. All materials count if the import runs the
    lines, or if nobody can say who does.
    """
    found = set()
    for line in mutant.lines:
        found |= set(known.reached.get(f"{mutant.path}:{line}", ()))
    anything = "" in found or not mutant.path.endswith(".py") or mutant.area == "drivers"
    waiting = known.runs(mutant.path, known.materials if anything else sorted(found))
    shown: list[str] = []
    run: set[str] = set()
    while waiting and len(shown) < most:
        best = max(waiting, key=lambda name: (len(waiting[name] - run), -len(waiting[name])))
        run |= waiting.pop(best)
        shown.append(best)
    return shown


@contextmanager
def copy(folder: Path, materials: Sequence[Path] = JUDGES) -> Iterator[Copy]:
    """A copy that is judged by the materials of some folders; it is deleted again."""
    package = folder / "burnish"
    ignored = shutil.ignore_patterns("tests", "build", "docs", ".*")
    shutil.copytree(ROOT, package, ignore=ignored)
    # No code may be taken from another mutant's cache.
    env = {
        **os.environ, "PYTHONPATH": f"{folder}{os.pathsep}{Path(__file__).parent}",
        "PYTHONDONTWRITEBYTECODE": "1",
        "OPENBLAS_NUM_THREADS": "1", "BURNISH_CACHE": str(folder / "cache"),
    }  # fmt: skip
    command = [sys.executable, "-m", JUDGE, *map(str, materials)]
    with started(command, cwd=folder, env=env, stdin=PIPE, stderr=DEVNULL, stdout=PIPE) as judge:
        try:
            yield Copy(folder, judge, package)
        finally:
            shutil.rmtree(folder)
