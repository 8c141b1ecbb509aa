"""Ctrl-C ends a command whose main thread waits for others, whichever thread gets the signal."""

from __future__ import annotations

import signal
import sys
import threading

import pytest

from burnish.commands import cli

from ..suite.processes import started

WAITING = """
import signal, sys
from threading import Event, Thread
from burnish.commands import cli
from burnish.commands import compilation, group

def tell():
    print("waits", flush=True)
    Event().wait()

def wait(*_arguments, **_options):
    Thread(target=tell, daemon=True).start()
    signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])  # So the other thread gets it.
    Event().wait()

compilation.succeeds = wait
group.burnish.main = wait
cli.main()
"""


@pytest.mark.usefixtures("interruptible")
@pytest.mark.parametrize("line", ["compile m.burnish -o out --validate", "doctor"])
def test_the_main_thread_is_woken(line: str) -> None:
    """This holds for each way to run a command: a plain ``compile`` does not go through click."""
    with started([sys.executable, "-c", WAITING, *line.split()]) as program:
        assert program.line() == b"waits\n"
        program.signal(signal.SIGINT)
        assert program.exit_code(10) == 130


def test_a_thread_that_was_just_being_started(monkeypatch: pytest.MonkeyPatch) -> None:
    """Ctrl-C may come before it runs; ``threading.enumerate`` lists it all the same."""
    threads = [threading.current_thread(), threading.Thread(daemon=False)]
    monkeypatch.setattr(threading, "enumerate", lambda: threads)
    cli._leave_threads(130)
