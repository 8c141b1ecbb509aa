"""Lets a long command end in good order when a signal asks it to, instead of at once.

``burnish conform`` works within ``Stopping``, so that it can still say what it has found so far.
"""

from __future__ import annotations

import signal
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from threading import current_thread, main_thread
from types import FrameType, TracebackType
from typing import Any, Self

from .terminal import remember_signal

NAMES = ("SIGINT", "SIGTERM", "SIGHUP")
"""The signals that ask a command to end, as far as the system has them."""


class Stopping:
    """A context manager that heeds the first signal that asks the command to end.

    Such a signal raises ``KeyboardInterrupt``, or calls a function where ``by`` names one, or does
    nothing yet within ``later``. These blocks nest: the innermost one counts. At the latest, the
    end of the whole block raises ``KeyboardInterrupt``.

    Further signals do nothing: a terminal and a parent process often both send one, and the command
    is about to end anyway. Signals that the process ignores stay ignored.
    """

    def __init__(self) -> None:
        self.asked = False
        """True if a signal has come."""
        self._act = _interrupt
        self._before: dict[int, Any] = {}

    def __enter__(self) -> Self:
        # Other threads, in which tests may run a command, cannot set handlers.
        if current_thread() is main_thread():
            for name in NAMES:
                number = getattr(signal, name, None)
                if number is not None and callable(signal.getsignal(number)):
                    self._before[number] = signal.signal(number, self._heed)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self.asked:
            raise KeyboardInterrupt
        for number, handler in self._before.items():
            signal.signal(number, handler)

    @contextmanager
    def by(self, act: Callable[[], None]) -> Iterator[None]:
        """Within the ``with`` block, the first signal calls ``act``, in the main thread, between
        any two of its instructions.

        Raises ``KeyboardInterrupt`` if a signal has come before: some libraries swallow that.
        """
        with self._acting(act):
            if self.asked:
                raise KeyboardInterrupt
            yield

    @contextmanager
    def at_once(self) -> Iterator[None]:
        """Within the ``with`` block, the first signal raises ``KeyboardInterrupt``.

        Some libraries swallow that, or raise another exception in its place. So the block raises it
        in any case if a signal has come, also before.
        """
        try:
            with self.by(_interrupt):
                yield
        finally:
            if self.asked:
                raise KeyboardInterrupt

    @contextmanager
    def later(self) -> Iterator[None]:
        """Within the ``with`` block, a signal is only remembered."""
        with self._acting(lambda: None):
            yield

    @contextmanager
    def _acting(self, act: Callable[[], None]) -> Iterator[None]:
        before, self._act = self._act, act
        try:
            yield
        finally:
            self._act = before

    def _heed(self, number: int, _frame: FrameType | None) -> None:
        if self.asked:
            return
        self.asked = True
        remember_signal(number)
        self._act()


def _interrupt() -> None:
    raise KeyboardInterrupt
