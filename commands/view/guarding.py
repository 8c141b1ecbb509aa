"""Keeps other web pages away from the server of ``burnish view``.

A page from anywhere can have its browser send requests to this computer. With a name of its own
that leads here (DNS rebinding) it could even read the answers, which hold a person's source. So the
server answers only requests to its own name, and only its own page.
"""

from __future__ import annotations

from starlette.datastructures import Headers, MutableHeaders
from starlette.responses import PlainTextResponse
from starlette.types import ASGIApp, Message, Receive, Scope, Send

_NAMES = ("127.0.0.1", "localhost")
_OWN = ("same-origin", "none")
"""The origins of requests that browsers make for the page itself, or for a typed address."""

_HEADERS = {
    "cache-control": "no-store",
    "content-security-policy": (
        "default-src 'none'; script-src 'self'; style-src 'self'; connect-src 'self'; "
        "img-src 'self' blob: data:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'; "
        "require-trusted-types-for 'script'; trusted-types 'none'"
    ),
    "cross-origin-opener-policy": "same-origin",
    "cross-origin-resource-policy": "same-origin",
    "referrer-policy": "no-referrer",
    "x-content-type-options": "nosniff",
}
"""Headers by which the page loads nothing from elsewhere, makes no elements of texts, and is not
embedded by other pages."""


class Guarded:
    """An application that refuses requests of other pages."""

    def __init__(self, application: ASGIApp, port: int) -> None:
        self._application = application
        self._hosts = {f"{name}:{port}" for name in _NAMES}
        self._origins = {f"http://{host}" for host in self._hosts}
        if port == 80:
            self._hosts |= set(_NAMES)
            self._origins |= {f"http://{name}" for name in _NAMES}

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Answer a request, with headers that keep the answer within the page."""
        if scope["type"] != "http":
            await self._application(scope, receive, send)
            return

        async def send_guarded(message: Message) -> None:
            if message["type"] == "http.response.start":
                MutableHeaders(scope=message).update(_HEADERS)
            await send(message)

        problem = self._problem(Headers(scope=scope), scope["path"])
        answer = PlainTextResponse(problem, 403) if problem else self._application
        await answer(scope, receive, send_guarded)

    def _problem(self, headers: Headers, path: str) -> str:
        """The reason why a request is refused; empty if it is not."""
        if headers.get("host", "").lower() not in self._hosts:
            return "this server is called 127.0.0.1 or localhost, with its port"
        origin = headers.get("origin")
        if origin is not None and origin.lower() not in self._origins:
            return "only the page of this server may ask for this"
        # A link to the page may stand anywhere.
        if path != "/" and headers.get("sec-fetch-site", "none") not in _OWN:
            return "only the page of this server may ask for this"
        return ""
