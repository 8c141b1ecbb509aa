"""A test that hangs fails, and the tests after it run; this is told, and so is what a run took."""

from __future__ import annotations

import sys
from pathlib import Path

import pytest

from .account import Account
from .processes import run

CONFIGURATION = Path(__file__).parents[2] / "pyproject.toml"
LIMITS = ("-o", "timeout=2", "-o", "faulthandler_timeout=4")

HANGING = """
import os, subprocess, sys, threading
from burnish.tests.suite.processes import run

COMMAND = [sys.executable, "-c", "import time; time.sleep(100)"]

def test_a_lock():
    lock = threading.Lock()
    lock.acquire()
    lock.acquire()

def test_a_pipe():
    os.read(os.pipe()[0], 1)

def test_a_program():
    subprocess.run(COMMAND)

def test_a_program_of_ours():
    run(COMMAND)

def test_that_hangs_not():
    pass
"""


def outcome(folder: Path, text: str, *options: str) -> tuple[int, str]:
    """The exit code and the output of pytest for a module."""
    (folder / "test_it.py").write_text(text)
    command = [sys.executable, "-m", "pytest", "-c", str(CONFIGURATION), "--rootdir", str(folder)]
    plugin = ("-p", "burnish.tests.suite.account", "-p", "no:cacheprovider")
    done = run([*command, *plugin, *LIMITS, *options, "test_it.py"], cwd=folder)
    return done.returncode, done.stdout + done.stderr


def test_what_hangs_fails(tmp_path: Path) -> None:
    code, said = outcome(tmp_path, HANGING, "-n", "0", "-o", "timeout=1")
    assert code == 1
    for what in ("a_lock", "a_pipe", "a_program", "a_program_of_ours"):
        assert f"test_it.py::test_{what} - Failed: Timeout" in said
    assert "4 failed, 1 passed" in said


DEAF = """
import signal, time

def test_deaf():
    signal.pthread_sigmask(signal.SIG_BLOCK, {signal.SIGALRM})
    time.sleep(100)

def test_other():
    pass
"""


def test_what_no_signal_ends_takes_its_process_with_it(tmp_path: Path) -> None:
    code, said = outcome(tmp_path, DEAF, "-n", "1")
    assert code == 1
    assert "crashed while running 'test_it.py::test_deaf'" in said
    assert 'test_it.py", line 6 in test_deaf' in said, "the traceback of each thread"
    assert "1 failed, 1 passed" in said


@pytest.mark.parametrize("workers", ["0", "2"])
def test_the_most_memory_is_told(workers: str, tmp_path: Path) -> None:
    code, said = outcome(tmp_path, "def test_it(): b'x' * 200_000_000", "-n", workers)
    assert code == 0
    (line,) = (line for line in said.splitlines() if line.startswith("memory: at most "))
    assert 200 < int(line.split()[3]) < 400
    assert "skipped: 0," in said


def test_too_much_memory_is_told() -> None:
    account = Account()
    for needed in (900, 1100):
        account.add(needed)
    assert list(account.lines(3)) == [
        "memory: at most 1100 MB in a process of the tests",
        "        that is too much: a process should need 1000 MB at most",
        "skipped: 3, each for a reason that tests may have",
    ]


SKIPPING = """
import pytest
def test_one():
    pytest.skip("this file system has no such names")
def test_other():
    pytest.skip("no tool")
"""


def test_what_is_skipped_for_no_good_reason_fails(tmp_path: Path) -> None:
    _, said = outcome(tmp_path, SKIPPING, "-n", "0")
    assert "FAILED test_it.py::test_other" in said
    assert "skipped, but no test may be, because 'no tool'" in said
    assert "1 failed, 1 skipped" in said
    _, said = outcome(tmp_path, "import pytest\npytest.importorskip('no_such_module')", "-n", "0")
    assert "ERROR test_it.py" in said
    assert "1 error" in said
