"""The server of ``burnish view``: sends the page, its documents, and news of every change.

It listens on this computer only. It sends only the page and documents, by names that it knows: no
request becomes the path of a file.
"""

from __future__ import annotations

import asyncio
import json
import logging
import os
import signal
import socket
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress
from importlib.resources import files
from threading import Timer

import uvicorn
from starlette.applications import Starlette
from starlette.background import BackgroundTask
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request as HttpRequest
from starlette.responses import JSONResponse, PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route

from ...support.garbage import settle
from ...targets.web_host.serving.modules import host_modules
from ..failures import drawing_errors, lacking
from ..terminal import flushed
from .connections import MOST_HEADERS, Connection
from .documents import choice_of
from .guarding import Guarded
from .pictures import Wanted, wanted_of
from .request import ViewRequest
from .uploads import UploadError, Uploads
from .watching import Watched

_KINDS = {
    ".css": "text/css",
    ".html": "text/html",
    ".js": "text/javascript",
    ".svg": "image/svg+xml",
}
_SCRIPT = _KINDS[".js"]
PAGE = "/web_view/index.html"
"""The file that ``/`` shows."""


def page_files() -> dict[str, tuple[bytes, str]]:
    """The content and the media type of each file, by the path of its address. The folders lie as
    they do in the tree, so that a module of the page imports one of the host as it does there."""
    found = {f"/web_host/{name}": (text.encode(), _SCRIPT) for name, text in host_modules().items()}
    for file in files(f"{__package__.split('.')[0]}.targets.web_view").iterdir():
        kind = next((kind for end, kind in _KINDS.items() if file.name.endswith(end)), None)
        if kind is not None:
            found[f"/web_view/{file.name}"] = file.read_bytes(), kind
    return {"/": found[PAGE], **found}


HOST = "127.0.0.1"
"""The loopback interface: no other computer reaches it."""
_PATIENCE = 0.8
"""The seconds that requests may still take when the server ends; then the process ends, whatever
its threads do."""
_Queue = asyncio.Queue[tuple[str, str] | None]
_SIGNALLED = 128
"""The number that shells add to the signal that has ended a program."""
_PIECE = 1 << 18
"""Bytes of a document that are sent at once."""
_PULSE = 15.0
"""The seconds after which a page gets an event, so that nobody takes the connection for dead."""


class Server:
    """Shows a file, or those of a folder, until it is interrupted."""

    def __init__(self, request: ViewRequest, port: int = 0) -> None:
        """Bind the port, or any that is free. Raises ``OSError`` if the port is in use."""
        self._loop: asyncio.AbstractEventLoop | None = None
        self._watched = Watched(request, self._changed)
        self._uploads = Uploads()
        self._socket = socket.create_server((HOST, port))
        self._port: int = self._socket.getsockname()[1]
        self._pages: set[_Queue] = set()
        """For each open page, the events that it still has to get: files with their versions, and
        at last ``None``."""

    @property
    def is_empty(self) -> bool:
        """True if there is nothing to show."""
        return self._watched.folder.first() is None

    @property
    def address(self) -> str:
        """The address that a browser opens."""
        return f"http://{HOST}:{self._port}/"

    def run(self) -> None:
        """Serve until Ctrl-C, which is raised again as ``KeyboardInterrupt``."""
        settle()
        config = uvicorn.Config(
            self.application(), log_level="error", access_log=False, ws="none", http=Connection,
            loop="asyncio", server_header=False, h11_max_incomplete_event_size=MOST_HEADERS,
        )  # fmt: skip
        _Ending(config, self._end_pages).run([self._socket])

    def close(self) -> None:
        """Give back the port of a server that does not run."""
        self._socket.close()

    # --- answers ---------------------------------------------------------------------------------

    def application(self) -> Guarded:
        """The application that answers requests."""
        routes = [
            Route("/document", self._document),
            Route("/files", self._files),
            Route("/changes", self._changes),
            Route("/picture", self._picture, methods=["POST"]),
            *(_route(path, *file) for path, file in page_files().items()),
        ]
        return Guarded(Starlette(routes=routes, lifespan=self._watching), self._port)

    async def _document(self, request: HttpRequest) -> Response:
        choice = choice_of(request.query_params)
        content = await run_in_threadpool(self._watched.document, choice)
        if content is None:
            return PlainTextResponse("nothing in the folder can be drawn", 404)
        return StreamingResponse(
            _parts(content), headers={"content-length": str(len(content))},
            media_type="application/json", background=self._tidying,
        )  # fmt: skip

    async def _files(self, _request: HttpRequest) -> Response:
        return JSONResponse(await run_in_threadpool(self._watched.folder.listing))

    async def _picture(self, request: HttpRequest) -> Response:
        """Keep the picture that a page sends; the query names its texture."""
        asked = request.query_params
        wanted = wanted_of(asked.get("dimension", ""), asked.get("sample", ""))
        if wanted is None:
            return PlainTextResponse("there is no such texture", 400)
        try:
            data = await self._uploads.read(request)
        except UploadError as error:
            return PlainTextResponse(str(error), error.status)
        name = asked.get("name", "the picture")
        status, text = await run_in_threadpool(self._keep, name, data, wanted)
        return PlainTextResponse(text, status, background=self._tidying)

    def _keep(self, name: str, data: bytes, wanted: Wanted) -> tuple[int, str]:
        """Keep a picture; returns the answer.

        No error leaves this thread: the traceback of an error that is handed on is part of a
        reference cycle, with everything that its functions have made.
        """
        with self._watched.workshop.working():
            try:
                return 200, self._watched.pictures.keep(name, data, wanted)
            except drawing_errors() as error:
                return 422, str(error)
            except MemoryError:
                return 422, "there is not enough memory for this"
            except ModuleNotFoundError as error:
                return 422, lacking(error)

    @property
    def _tidying(self) -> BackgroundTask:
        """The task that runs once an answer has been sent."""
        return BackgroundTask(self._watched.workshop.tidy)

    async def _changes(self, _request: HttpRequest) -> Response:
        return StreamingResponse(self._told(), media_type="text/event-stream")

    async def _told(self) -> AsyncIterator[str]:
        """The versions of files, now and after each change, as server-sent events."""
        queue: _Queue = asyncio.Queue()
        for told in self._watched.versions.items():
            queue.put_nowait(told)
        self._pages.add(queue)
        self._watched.is_seen = True
        try:
            while event := await _next_event(queue):
                yield event
        finally:
            self._pages.discard(queue)
            self._watched.is_seen = bool(self._pages)

    def _end_pages(self) -> None:
        for queue in self._pages:
            queue.put_nowait(None)

    # --- changes ---------------------------------------------------------------------------------

    @asynccontextmanager
    async def _watching(self, _application: Starlette) -> AsyncIterator[None]:
        """Watch files for as long as the server runs."""
        self._loop = asyncio.get_running_loop()
        self._watched.begin()
        try:
            yield
        finally:
            self._watched.end()

    def _changed(self, name: str, version: str) -> None:
        """Tell pages of a change; called by the thread that watches the file."""
        if self._loop is not None:
            with suppress(RuntimeError):  # The loop has ended, and nobody is left to be told.
                self._loop.call_soon_threadsafe(self._tell, name, version)

    def _tell(self, name: str, version: str) -> None:
        for queue in self._pages:
            queue.put_nowait((name, version))


async def _next_event(queue: _Queue) -> str:
    """The next event for a page; empty if there are no more."""
    try:
        told = await asyncio.wait_for(queue.get(), _PULSE)
    except TimeoutError:
        return ": still here\n\n"
    if told is None:
        return ""
    name, version = told
    return f"data: {json.dumps({'file': name, 'version': version})}\n\n"


async def _parts(content: bytes) -> AsyncIterator[bytes]:
    """A document in pieces; each waits until the earlier ones are nearly all read.

    So a connection to somebody who reads slowly needs no copy of the document.
    """
    for start in range(0, len(content), _PIECE):
        yield content[start : start + _PIECE]


class _Ending(uvicorn.Server):
    """Lets the pages go before it waits for open requests, since theirs stay open for ever.

    It does not wait for long.
    """

    def __init__(self, config: uvicorn.Config, end_pages: Callable[[], None]) -> None:
        super().__init__(config)
        self._end_pages = end_pages

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        # Requests that are cancelled from here on are no errors.
        logging.getLogger("uvicorn.error").setLevel(logging.CRITICAL)
        patience = Timer(_PATIENCE, self._end_at_once)
        patience.daemon = True
        patience.start()
        self._end_pages()
        await super().shutdown(sockets)

    def _end_at_once(self) -> None:
        """End the process while a thread still works, if nobody will see the result.

        Such work is a compile, or a kernel. Nothing is written to files here.
        """
        received = self._captured_signals[-1] if self._captured_signals else signal.SIGINT
        os._exit(flushed(_SIGNALLED + received))


def _route(path: str, content: bytes, media_type: str) -> Route:
    async def answer(_request: HttpRequest) -> Response:
        return Response(content, media_type=media_type)

    return Route(path, answer)
