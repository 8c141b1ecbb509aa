"""Ctrl-C ends a command whose main thread waits for others, whichever thread gets the signal."""

from __future__ import annotations

import signal
import sys

import pytest

from ..suite.processes import started

WAITING = """
import signal, sys
from threading import Event, Thread
from burnish.commands.waking import wake_on_signals

def tell():
    print("waits", flush=True)
    Event().wait()

wake_on_signals()
Thread(target=tell, daemon=True).start()
signal.pthread_sigmask(signal.SIG_BLOCK, [signal.SIGINT])  # So the other thread gets it.
try:
    Event().wait()
except KeyboardInterrupt:
    sys.exit(130)
"""


@pytest.mark.usefixtures("interruptible")
def test_the_main_thread_is_woken() -> None:
    with started([sys.executable, "-c", WAITING]) as program:
        assert program.line() == b"waits\n"
        program.signal(signal.SIGINT)
        assert program.exit_code(10) == 130
