"""Has shader texts checked by the real downstream compilers, in parallel.

``compile --validate`` and ``conform`` create a ``Toolchain``, and so do the tests.
"""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Iterator, Mapping, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace

from ..closing import Closing
from .checkers import CHECKERS, Checker
from .job import Job, Message, Verdict
from .toolbox import Toolbox
from .tools import ToolState

TIME_LIMIT = 60.0


class Toolchain(Closing):
    """Owns the worker processes. Use it as a context manager, one for many calls of ``check``."""

    def __init__(
        self,
        *,
        time_limit: float = TIME_LIMIT,
        parallel: int | None = None,
        states: Mapping[str, ToolState] | None = None,
    ) -> None:
        """``time_limit`` is in seconds for each run of a tool; ``parallel`` tools run at once.

        Tools that have no state among ``states`` are looked for when they are needed.
        """
        self._parallel = parallel or os.cpu_count() or 1
        self._toolbox = Toolbox(self._parallel, time_limit, states or {})
        self._threads = ThreadPoolExecutor(self._parallel)

    def close(self) -> None:
        """Cancel all work and end all tools, first those for which threads wait."""
        self._threads.shutdown(wait=False, cancel_futures=True)
        self._toolbox.close()
        self._threads.shutdown()

    def problem(self, checker: str) -> str | None:
        """The reasons why a checker cannot be used, tool by tool; ``None`` if it can."""
        problems = (self._toolbox.problem(tool) for tool in CHECKERS[checker].needs)
        return "; ".join(problem for problem in problems if problem) or None

    def versions(self, checker: str) -> tuple[str, ...]:
        """The versions of the tools that a checker needs; an empty text for each missing tool."""
        return tuple(self._toolbox.version(tool) for tool in CHECKERS[checker].needs)

    def check(self, jobs: Sequence[Job], *, keep_modules: bool = False) -> list[Verdict]:
        """A verdict for each job, in the jobs' order.

        A checker without its tools answers ``missing``. Raises ``KeyError`` if a job names a
        checker that does not exist.
        """
        verdicts: dict[int, Verdict] = {}
        problems = {name: self.problem(name) for name in {job.checker for job in jobs}}
        batches = list(self._batches(jobs))
        results = self._threads.map(
            lambda batch: self._answer([jobs[index] for index in batch], problems), batches
        )
        for batch, answers in zip(batches, results, strict=True):
            verdicts.update(zip(batch, answers, strict=True))
        kept = [verdicts[index] for index in range(len(jobs))]
        if keep_modules:
            return kept
        return [replace(verdict, spirv=None, dxil=None) for verdict in kept]

    def _batches(self, jobs: Sequence[Job]) -> Iterator[list[int]]:
        """The jobs' indices, in batches that one call of one checker can answer."""
        alike: defaultdict[tuple[str, tuple[str, ...]], list[int]] = defaultdict(list)
        for index, job in enumerate(jobs):
            alike[job.checker, job.flags].append(index)
        for (name, _flags), indices in alike.items():
            share = -(-len(indices) // self._parallel)
            size = min(CHECKERS[name].batch, max(CHECKERS[name].together, share))
            yield from (indices[at : at + size] for at in range(0, len(indices), size))

    def _answer(self, jobs: Sequence[Job], problems: Mapping[str, str | None]) -> list[Verdict]:
        """The verdicts on one batch of jobs."""
        checker = jobs[0].checker
        problem = problems[checker]
        if problem is None:
            return _checked(CHECKERS[checker], jobs, self._toolbox)
        message = Message("error", None, None, problem)
        return [Verdict(job, "missing", (message,), log=problem) for job in jobs]


def _checked(checker: Checker, jobs: Sequence[Job], toolbox: Toolbox) -> list[Verdict]:
    """The verdicts of a checker, which gets only texts that it may have."""
    refusals = [checker.refusal(job) for job in jobs]
    rest = [job for job, refusal in zip(jobs, refusals, strict=True) if refusal is None]
    answers = iter(checker.check(rest, toolbox) if rest else ())
    return [refusal or next(answers) for refusal in refusals]
