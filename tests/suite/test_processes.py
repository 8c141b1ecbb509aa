"""The processes that tests start are ended, and waiting for them has a limit."""

from __future__ import annotations

import signal
import sys
import time
from subprocess import TimeoutExpired

import pytest

from .processes import Background, at_once, run, started, until

FAMILY = """
import subprocess, sys, time
child = "import time; print('ready', flush=True); time.sleep(600)"
subprocess.Popen([sys.executable, "-c", child], start_new_session=True)
time.sleep(600)
"""
"""Starts a program that leaves its process group, as browsers do."""


def test_what_a_program_says() -> None:
    done = run([sys.executable, "-c", "print(input(), end='é')"], text="a line\n")
    assert (done.returncode, done.stdout, done.stderr) == (0, "a lineé", "")


def test_its_standard_input_is_empty() -> None:
    command = [sys.executable, "-c", "import sys; print(repr(sys.stdin.read()))"]
    assert run(command).stdout == "''\n"


def test_what_has_to_succeed() -> None:
    with pytest.raises(AssertionError, match="no luck"):
        run([sys.executable, "-c", "raise SystemExit('no luck')"], check=True)


def test_a_program_that_hangs_is_ended_with_all_that_it_has_started() -> None:
    with (
        pytest.raises(TimeoutExpired),
        started([sys.executable, "-c", FAMILY]) as program,
    ):
        assert program.line() == b"ready\n"
        assert len(program.family()) == 2
        program.ended(limit=0.2)
    assert not program.family()


def test_a_program_that_refuses_to_end_is_ended() -> None:
    deaf = "import signal, time; signal.signal(signal.SIGINT, signal.SIG_IGN)"
    script = f"{deaf}; print('deaf', flush=True); time.sleep(600)"
    with started([sys.executable, "-c", script]) as program:
        assert program.line() == b"deaf\n"
        program.signal(signal.SIGINT)
        with pytest.raises(TimeoutExpired):
            program.exit_code(limit=0.2)
    assert not program.family()


def test_a_line_that_does_not_come() -> None:
    script = "import time; print('half a', end='', flush=True); time.sleep(600)"
    with (
        started([sys.executable, "-c", script]) as program,
        pytest.raises(AssertionError, match=r"wrote no line within 1 s, only b'half a'"),
    ):
        program.line(limit=1)


def test_a_call_that_does_not_return() -> None:
    running = Background(lambda: time.sleep(2))
    with pytest.raises(AssertionError, match=r"did not return within 0\.1 s"):
        running.returned(limit=0.1)


def test_what_a_call_raises_is_raised() -> None:
    with pytest.raises(ZeroDivisionError):
        at_once([lambda: 1 / 1, lambda: 1 / 0])


def test_what_never_happens() -> None:
    with pytest.raises(AssertionError, match=r"still waiting after 0\.1 s: a miracle"):
        until(lambda: False, "a miracle", limit=0.1)
