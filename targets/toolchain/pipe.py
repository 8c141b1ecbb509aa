"""Packets between Burnish and a process that it has started: a line of JSON, and bytes behind it.

``workers.py`` is Burnish's side of the pipe. Workers of Burnish's own answer by ``serve``, such as
drivers; those that judge for ``burnish conform`` also ask back, by ``converse``. Workers of
compilers, which import nothing of Burnish, write lines only.
"""

from __future__ import annotations

import faulthandler
import json
import os
import sys
from collections.abc import Callable, Mapping
from typing import IO, Any, NamedTuple

FOLLOWING = "following"
"""The key of a line that bytes follow: their number."""


class Packet(NamedTuple):
    """A request, or the answer to one."""

    content: Mapping[str, Any]
    """The part that is JSON."""
    data: bytes = b""
    """Texels, elements or whatever else takes long as JSON."""


def send(packet: Packet, stream: IO[bytes]) -> None:
    """Write a packet. Raises ``BrokenPipeError`` if nobody reads it."""
    following = {FOLLOWING: len(packet.data)} if packet.data else {}
    stream.write(json.dumps({**packet.content, **following}).encode() + b"\n")
    stream.write(packet.data)
    stream.flush()


def receive(stream: IO[bytes], most: int) -> Packet:
    """Read a packet of at most ``most`` bytes.

    Raises ``EOFError`` if the stream ends before the packet does, ``OverflowError`` if the packet
    is longer, and ``ValueError`` if its line is no object of JSON.
    """
    line = stream.readline(most + 1)
    if len(line) > most:
        raise OverflowError
    if not line.endswith(b"\n"):
        raise EOFError
    content = json.loads(line)
    if not isinstance(content, dict):
        raise ValueError
    following = content.pop(FOLLOWING, 0)
    if len(line) + following > most:
        raise OverflowError
    data = stream.read(following)
    if len(data) < following:
        raise EOFError
    return Packet(content, data)


def serve(answer: Callable[[Packet], Packet], orphan_limit: float) -> None:
    """Answer packets until the input ends. Whatever libraries print goes to standard error.

    A request that takes ``orphan_limit`` seconds ends the process. The sender waits for less time;
    so this happens only if the sender has died, which a process that hangs does not notice.
    """
    converse(lambda request, _ask: answer(request), orphan_limit)


Ask = Callable[[Packet], Packet]
"""Sends a question back to who has sent the request, and returns the answer to it."""


def converse(answer: Callable[[Packet, Ask], Packet], orphan_limit: float) -> None:
    """Like ``serve``, but before a packet is answered, questions may be sent back.

    The sender has to tell such a question from the answer, and to send what is asked for. While it
    is waited for, no time counts. If the sender has died, ``EOFError`` ends the process.
    """
    with os.fdopen(os.dup(1), "wb") as answers:
        os.dup2(2, 1)

        def ask(question: Packet) -> Packet:
            faulthandler.cancel_dump_traceback_later()
            send(question, answers)
            received = receive(sys.stdin.buffer, sys.maxsize - 1)
            faulthandler.dump_traceback_later(orphan_limit, exit=True)
            return received

        while True:
            try:
                request = receive(sys.stdin.buffer, sys.maxsize - 1)
            except EOFError:
                return
            faulthandler.dump_traceback_later(orphan_limit, exit=True)
            send(answer(request, ask), answers)
            faulthandler.cancel_dump_traceback_later()
