"""A progress bar that appears only where something takes longer than a moment."""

from __future__ import annotations

import sys
import time
from types import TracebackType
from typing import Any, Self

import click

PATIENCE = 1.0
"""Seconds after which people want to know."""

_STEPS = 1000


class Progress:
    """A bar on standard error, if that is a terminal; a context manager."""

    def __init__(self, label: str) -> None:
        self._label = label
        self._started = time.monotonic()
        self._bar: Any = None
        self._shown = 0

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._bar is not None:
            self._bar.__exit__(kind, error, trace)

    def tell(self, share: float) -> None:
        """``share`` of the work is done, from 0 to 1."""
        if self._bar is None:
            if not sys.stderr.isatty() or time.monotonic() - self._started < PATIENCE:
                return
            self._bar = click.progressbar(length=_STEPS, label=self._label, file=sys.stderr)
            self._bar.__enter__()
        reached = round(share * _STEPS)
        self._bar.update(reached - self._shown)
        self._shown = reached
