"""The time and memory that a run of the tests took, told at its end, and reasons to skip a test.

``conftest.py`` makes this a plugin of pytest. With pytest-xdist it is one in each worker too, and
the workers send the main process what they needed.
"""

from __future__ import annotations

from collections.abc import Generator, Iterator
from typing import TypeVar

import pytest

from .memory import most_memory

MEMORY_AIM = 1000
"""The most megabytes that a worker needs, if nothing grows that should not."""

REASONS = {
    "a folder that even root cannot write to": "only Linux has /proc",
    "this file system has no such names": "names that are not Unicode, which macOS refuses",
    "not run: godot is not installed": "Debian unstable cannot always be installed from",
}
"""The reasons for which a test may be skipped, and where that happens. A test whose tool is missing
is not skipped: it fails, unless nobody can promise that the tool can be installed today
(``Tool.may_be_missing``)."""

OUTPUT = "workeroutput"
"""The attribute in which pytest-xdist has what a worker sends to the main process."""

Report = TypeVar("Report", pytest.TestReport, pytest.CollectReport)


class Account:
    """The memory that workers needed, or this process, if there are none."""

    def __init__(self) -> None:
        self._workers: list[int] = []

    def add(self, needed: int) -> None:
        """Add the megabytes that one process needed."""
        self._workers.append(needed)

    def pytest_sessionfinish(self, session: pytest.Session) -> None:
        """Called in every process when it has run its last test, before the summary."""
        needed = round(most_memory() / 1e6)
        output = getattr(session.config, OUTPUT, None)
        if output is not None:
            output["memory"] = needed
        elif not self._workers:
            self.add(needed)

    @pytest.hookimpl(optionalhook=True)
    def pytest_testnodedown(self, node: object) -> None:
        """Called in the main process when a worker has ended. One that crashed has sent nothing."""
        if needed := getattr(node, OUTPUT, {}).get("memory"):
            self.add(needed)

    def pytest_terminal_summary(self, terminalreporter: pytest.TerminalReporter) -> None:
        """Called in the main process at the end."""
        for line in self.lines(len(terminalreporter.getreports("skipped"))):
            terminalreporter.write_line(line)

    def lines(self, skipped: int) -> Iterator[str]:
        """The lines of the account, after so many tests were skipped."""
        worker = max(self._workers)
        yield f"memory: at most {worker} MB in a process of the tests"
        if worker > MEMORY_AIM:
            yield f"        that is too much: a process should need {MEMORY_AIM} MB at most"
        yield f"skipped: {skipped}, each for a reason that tests may have"


def pytest_configure(config: pytest.Config) -> None:
    """Called in every process when it starts."""
    config.pluginmanager.register(Account())


@pytest.hookimpl(wrapper=True)
def pytest_runtest_makereport() -> Generator[None, pytest.TestReport, pytest.TestReport]:
    """Called after each part of a test."""
    return _judged((yield))


@pytest.hookimpl(wrapper=True)
def pytest_make_collect_report() -> Generator[None, pytest.CollectReport, pytest.CollectReport]:
    """Called after the tests of a module were collected."""
    return _judged((yield))


def _judged(report: Report) -> Report:
    """A report. If something was skipped for a reason that is not listed, it has failed."""
    if report.outcome == "skipped" and not hasattr(report, "wasxfail"):
        assert isinstance(report.longrepr, tuple)
        reason = report.longrepr[2].removeprefix("Skipped: ")
        if reason not in REASONS:
            report.outcome = "failed"
            report.longrepr = f"skipped, but no test may be, because {reason!r}"
    return report
