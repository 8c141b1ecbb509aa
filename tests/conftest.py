"""Fixtures for all tests. Every test has its graphs verified after each pass.

What the package is generated from may have changed since it was installed, and a new checkout has
no bytecode; where ``PYTHONDONTWRITEBYTECODE`` is set, it never gets any. Everything works all the
same, but each of the many processes that tests start would compute both again.
"""

from __future__ import annotations

import gc
import os
import re
import signal
import sys
from collections.abc import Iterator
from importlib.metadata import Distribution, PackageNotFoundError
from pathlib import Path

import pytest
from hypothesis import HealthCheck, settings

from burnish.compiler.watching import VARIABLE
from burnish.support.garbage import settle
from burnish.targets.toolchain import places

from .suite.processes import run

ROOT = Path(__file__).parents[1]
NOT_OURS = re.escape(str(ROOT)) + r"/(\.|build/|dist/)"
"""A pattern of the folders of the checkout that are not Burnish's own code."""

MEMORY = {
    "MALLOC_ARENA_MAX": "1",
    "MALLOC_MMAP_THRESHOLD_": str(1 << 25),
    "MALLOC_TRIM_THRESHOLD_": str(1 << 28),
}
"""Settings of the C library of Linux, for the processes that draw.

It keeps the memory that each thread frees for this thread. So a worker that draws in many threads
would hold a hundred megabytes more, unless all share one heap. And it gives large arrays back to
the system as soon as they are freed, which then has to clear them for the next operation: a tenth
of the time of a picture.
"""

GARBAGE = (20_000, 10, 10)
"""The thresholds of Python's garbage collection; the usual first one is 700. Higher ones would let
circles of dropped objects keep pictures for long."""

os.environ[VARIABLE] = "1"

# How long an example takes says more about the machine than about Burnish.
settings.register_profile("burnish", deadline=None, suppress_health_check=[HealthCheck.too_slow])
settings.load_profile("burnish")

pytest_plugins = [
    "burnish.tests.suite.account",
    "burnish.tests.suite.quick",
    "burnish.tests.suite.units",
]


def pytest_configure(config: pytest.Config) -> None:
    """Before all tests, and before pytest-xdist starts its workers."""
    if not hasattr(config, "workerinput"):
        for name, setting in MEMORY.items():
            os.environ.setdefault(name, setting)
        run([sys.executable, "-m", "burnish.generate"])
        run([sys.executable, "-m", "compileall", "-q", "-x", NOT_OURS, str(ROOT)])


def pytest_collection_finish() -> None:
    """Before the first test of a process.

    The tests themselves are half a million objects, which stay until the end. Looking through them
    for garbage again and again took a sixth of the time of tests that compile.
    """
    settle()
    gc.set_threshold(*GARBAGE)


@pytest.fixture
def interruptible() -> Iterator[None]:
    """Lets the programs that a test starts be interrupted, and be told that a terminal is gone.

    Who runs the tests in the background may have them ignore these, which programs inherit.
    """
    before = {
        signal.SIGINT: signal.signal(signal.SIGINT, signal.default_int_handler),
        signal.SIGHUP: signal.signal(signal.SIGHUP, signal.SIG_DFL),
    }
    yield
    for number, handler in before.items():
        signal.signal(number, handler)


@pytest.fixture
def no_tools(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Simulates a machine without any tool; its cache folder, which is returned, is its file
    system."""

    def no_package(name: str) -> Distribution:
        raise PackageNotFoundError(name)

    monkeypatch.setenv("BURNISH_TOOLS", str(tmp_path))
    monkeypatch.setenv("PATH", "")
    monkeypatch.setattr(places, "ROOT", tmp_path)
    monkeypatch.setattr(places, "distribution", no_package)
    return tmp_path
