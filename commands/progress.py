"""A progress bar for ``render`` and ``conform``, which appears only if they take long."""

from __future__ import annotations

import sys
from collections.abc import Callable
from threading import Lock, Timer
from types import TracebackType
from typing import Any, Self

import click

PATIENCE = 1.0
"""The seconds after which the bar appears."""

_STEPS = 1000
_CLEARED = "\r\x1b[K"
"""Deletes the line of a terminal in which the bar stands."""


class Progress:
    """A context manager that shows a bar on standard error if that is a terminal."""

    def __init__(self, label: str) -> None:
        self._bar: Any = None
        self._timer: Timer | None = None
        self._lock = Lock()
        self._reached = 0
        if sys.stderr is not None and sys.stderr.isatty():
            self._bar = click.progressbar(length=_STEPS, label=label, file=sys.stderr)
            self._timer = Timer(PATIENCE, self._appear)
            self._timer.daemon = True

    def __enter__(self) -> Self:
        if self._timer is not None:
            self._timer.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._timer is not None:
            self._timer.cancel()
        with self._lock:
            if self._bar is not None and self._bar.entered:
                self._bar.__exit__(kind, error, trace)
            self._bar = None

    def tell(self, share: float) -> None:
        """Report that ``share`` of the work is done, from 0 to 1."""
        with self._lock:
            self._reached = round(share * _STEPS)
            self._draw()

    def aside(self, write: Callable[[], None]) -> None:
        """Call ``write``, which prints lines, so that they stand above the bar."""
        with self._lock:
            if self._bar is None or not self._bar.entered:
                write()
                return
            self._bar.file.write(_CLEARED)
            self._bar.file.flush()
            write()
            self._bar._last_line = None  # click draws a line only if it has changed.
            self._bar.render_progress()

    def _appear(self) -> None:
        with self._lock:
            if self._bar is not None:
                self._bar.__enter__()
                self._draw()

    def _draw(self) -> None:
        if self._bar is not None and self._bar.entered:
            self._bar.update(self._reached - self._bar.pos)
