"""Lets a process that judges a frame for ``burnish conform`` offer parts of its work to others.

Such a process has ``LentHelpers``, which ask the main process; that answers with ``Offers``. A part
waits behind all subjects with which no process has begun. So only processes help that have nothing
else to do.
"""

from __future__ import annotations

import pickle
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import CancelledError, Executor, Future
from typing import Any

from ..targets.toolchain.pipe import Ask, Packet

_HELP = "help"
"""The key of a packet that is about parts of the work; its value says which of these."""
_OFFER, _TAKE, _GATHER = "offer", "take", "gather"

Part = bytes | None
DrawPart = Callable[[bytes, int], Part]
"""Has a process make a part of a work: by what is common to all parts, and the part's number."""


class LentHelpers:
    """The processes that the main process has. It is asked for one work after the other."""

    def __init__(self, ask: Ask) -> None:
        self._ask = ask

    def offer(self, common: bytes, count: int) -> LentHelpers:
        """Offer parts that are numbered from 0. Helpers get what is ``common`` to all of them."""
        self._ask(Packet({_HELP: _OFFER, "count": count}, common))
        return self

    def take(self) -> int | None:
        """The number of a part with which nobody has begun, which nobody else gets any more."""
        number: int | None = self._ask(Packet({_HELP: _TAKE})).content["part"]
        return number

    def gather(self) -> Sequence[Part]:
        """What others have made of each part, once they have ended; ``None`` for all others."""
        found: Sequence[Part] = pickle.loads(self._ask(Packet({_HELP: _GATHER})).data)
        return found


def asks_help(reply: Mapping[str, Any]) -> bool:
    """True if a process that judges has not answered yet, but has something to do with parts."""
    return _HELP in reply


class Offers:
    """The parts of its work that one process has offered, in the main process."""

    def __init__(self, threads: Executor, draw: DrawPart) -> None:
        """Parts are drawn in ``threads``, behind all work that these have been given before."""
        self._threads, self._draw = threads, draw
        self._parts: list[Future[Part]] = []
        self._common: bytes | None = None
        """The data that helpers need for any part: calls that were cancelled may stay queued for
        long, and must not hold it."""

    def answer(self, asked: Mapping[str, Any], data: bytes) -> Packet:
        """The answer to a packet of ``LentHelpers``."""
        match asked[_HELP]:
            case "offer":
                count = asked["count"]
                self._common = data
                self._parts = [self._threads.submit(self._drawn, n) for n in range(count)]
                return Packet({})
            case "take":
                return Packet({"part": self._taken()})
            case _:
                made = [_made(part) for part in self._parts]
                self._parts, self._common = [], None
                return Packet({}, pickle.dumps(made))

    def withdraw(self) -> None:
        """Take back all parts with which nobody has begun: nobody wants them any more."""
        for part in self._parts:
            part.cancel()
        self._common = None

    def _drawn(self, number: int) -> Part:
        common = self._common
        return None if common is None else self._draw(common, number)

    def _taken(self) -> int | None:
        """The last part with which nobody has begun: helpers begin with the first one."""
        for number in reversed(range(len(self._parts))):
            part = self._parts[number]
            if not part.cancelled() and part.cancel():
                return number
        return None


def _made(part: Future[Part]) -> Part:
    """What has become of a part, for which this waits; ``None`` if there is no result."""
    try:
        return part.result()
    except (CancelledError, MemoryError):
        return None
