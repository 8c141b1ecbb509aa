"""Makes a main thread that waits for other threads react to signals at once.

Python runs the handlers of signals in the main thread, between two of its instructions. A signal
that comes just when that thread begins to wait for a lock is noted, but does not end the waiting:
Ctrl-C then seems to do nothing until some other thread is done. So a thread of its own is told of
each signal by ``set_wakeup_fd``, and wakes the main thread by a signal that means nothing else.
"""

from __future__ import annotations

import os
import signal
import time
from threading import Thread, main_thread

PAUSES = (0.02, 0.2, 1.0)
"""The seconds after which the main thread is woken: several times, since it may have begun to wait
only then."""


def wake_on_signals() -> None:
    """Begin to wake the main thread, which calls this, whenever a signal has come. Windows has no
    way to do that."""
    if os.name != "posix":
        return
    reading, writing = os.pipe()
    os.set_blocking(writing, False)
    signal.signal(signal.SIGURG, lambda _number, _frame: None)
    signal.set_wakeup_fd(writing, warn_on_full_buffer=False)
    Thread(target=_wake, args=(reading,), daemon=True).start()


def _wake(reading: int) -> None:
    main = main_thread().ident
    assert main is not None
    while numbers := os.read(reading, 1):
        for pause in PAUSES if numbers[0] != signal.SIGURG else ():
            time.sleep(pause)
            signal.pthread_kill(main, signal.SIGURG)
