"""Limits of connections to the server of ``burnish view``: their number, and their idle time.

Anybody on this computer can open connections, and send half a request, or read half an answer.
uvicorn waits for the rest for ever; this module closes such connections.
"""

from __future__ import annotations

import asyncio
from functools import cache

import h11
from uvicorn.protocols.http.h11_impl import H11Protocol

MOST_HEADERS = 32 * 1024
"""Bytes of the first line and all headers of a request."""
_TO_ASK = 10.0
"""Seconds until all headers of a request have to have arrived."""
_TO_READ = 30.0
"""Seconds until somebody has to read the next part of an answer."""
_MOST = 2000
"""The most open connections, if the system allows as many files."""


class Connection(H11Protocol):
    """One connection, which uvicorn makes."""

    _asking: asyncio.TimerHandle | None = None
    """Ends the wait for a request."""
    _reading: asyncio.TimerHandle | None = None
    """Ends the wait for a reader."""

    def connection_made(self, transport: asyncio.BaseTransport) -> None:
        """Wait for the first request, unless there are too many connections."""
        assert isinstance(transport, asyncio.Transport)
        super().connection_made(transport)
        if len(self.connections) > _most_connections():
            transport.abort()
        self._asking = self.loop.call_later(_TO_ASK, transport.abort)

    def connection_lost(self, exc: Exception | None) -> None:
        """Stop all waiting."""
        self._stop_asking()
        self._stop_reading()
        super().connection_lost(exc)

    def data_received(self, data: bytes) -> None:
        """Go on with a request, or begin a further one, whose time limit begins now."""
        if self._asking is None and self._is_between():
            self._asking = self.loop.call_later(_TO_ASK, self.transport.abort)
        super().data_received(data)
        if not self._is_between():
            self._stop_asking()

    def on_response_complete(self) -> None:
        """Wait for a further request.

        The body of a refused request may still arrive; uvicorn drops it, since browsers read no
        answer before all is sent.
        """
        super().on_response_complete()
        if self.conn.their_state is h11.SEND_BODY:
            self._asking = self.loop.call_later(_TO_ASK, self.transport.abort)

    def pause_writing(self) -> None:
        """Called when somebody reads more slowly than the server writes."""
        super().pause_writing()
        self._reading = self.loop.call_later(_TO_READ, self.transport.abort)

    def resume_writing(self) -> None:
        """Called when somebody has read a part."""
        self._stop_reading()
        super().resume_writing()

    def _is_between(self) -> bool:
        """True if there is no request that waits for an answer."""
        return self.cycle is None or self.cycle.response_complete

    def _stop_asking(self) -> None:
        if self._asking is not None:
            self._asking.cancel()
            self._asking = None

    def _stop_reading(self) -> None:
        if self._reading is not None:
            self._reading.cancel()
            self._reading = None


@cache
def _most_connections() -> int:
    """Half of the files that the process may open, so that enough are left to work with."""
    try:
        import resource
    except ModuleNotFoundError:  # Windows counts no files.
        return _MOST
    soft, _hard = resource.getrlimit(resource.RLIMIT_NOFILE)
    return _MOST if soft == resource.RLIM_INFINITY else min(_MOST, soft // 2)
