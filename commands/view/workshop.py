"""Makes documents and textures for the server of ``burnish view``, one at a time.

Each may take all the memory that the limits allow, so no two are made together. Garbage is freed at
once, and not when Python next looks for it: a picture is a single object for Python, however many
megabytes it has.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from threading import Lock

from ...support.garbage import sweep


class Workshop:
    """The right to work. Threads share one workshop, and wait in it for each other."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._is_swept = True

    @contextmanager
    def working(self) -> Iterator[None]:
        """Have the workshop alone inside the ``with`` block."""
        with self._lock:
            self._sweep()
            self._is_swept = False
            yield

    def tidy(self) -> None:
        """Free the garbage of the last work. It takes a while, so nobody should wait for it."""
        with self._lock:
            self._sweep()

    def _sweep(self) -> None:
        if not self._is_swept:
            sweep()
            self._is_swept = True
