"""The server of ``burnish view``: the page, what it draws, and word of every change.

It listens on this computer only. All that it sends are the page and documents, by names that it
knows: no request becomes the path of a file.
"""

from __future__ import annotations

import asyncio
import json
import socket
from collections.abc import AsyncIterator, Callable
from contextlib import asynccontextmanager, suppress

import uvicorn
from starlette.applications import Starlette
from starlette.concurrency import run_in_threadpool
from starlette.requests import Request as HttpRequest
from starlette.responses import JSONResponse, PlainTextResponse, Response, StreamingResponse
from starlette.routing import Route

from ...targets.runner.textures.kinds import PictureError
from ..failures import lacking
from .documents import choice_of
from .files import page_files
from .guarding import Guarded
from .pictures import MOST_BYTES, Pictures, wanted_of
from .request import Request
from .watching import Watched

HOST = "127.0.0.1"
"""The loopback interface: no other computer reaches it."""
_PATIENCE = 2
"""How many seconds requests may still take when the server ends."""
_Queue = asyncio.Queue[tuple[str, str] | None]
_PULSE = 15.0
"""After how many seconds a page is told something, so that nobody takes it for dead."""


class Server:
    """Shows a file, or those of a folder, until it is interrupted."""

    def __init__(self, request: Request, port: int = 0) -> None:
        """Bind the port, or any that is free. Raises ``OSError`` if it cannot be had."""
        self._pictures = Pictures()
        self._loop: asyncio.AbstractEventLoop | None = None
        self._watched = Watched(request, self._pictures, self._changed)
        self._socket = socket.create_server((HOST, port))
        self._port: int = self._socket.getsockname()[1]
        self._pages: set[_Queue] = set()
        """For each open page what it is still to be told: files with their versions, and at last
        nothing more."""

    @property
    def is_empty(self) -> bool:
        """Whether there is nothing to show."""
        return self._watched.folder.first() is None

    @property
    def address(self) -> str:
        """What a browser opens."""
        return f"http://{HOST}:{self._port}/"

    def run(self) -> None:
        """Serve until Ctrl-C, which is raised again as ``KeyboardInterrupt``."""
        config = uvicorn.Config(
            self._application(), log_level="warning", access_log=False, ws="none", http="h11",
            loop="asyncio", server_header=False, timeout_graceful_shutdown=_PATIENCE,
        )  # fmt: skip
        _Ending(config, self._end_pages).run([self._socket])

    # --- what is served --------------------------------------------------------------------------

    def _application(self) -> Guarded:
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
        return Response(content, media_type="application/json")

    async def _files(self, _request: HttpRequest) -> Response:
        return JSONResponse(await run_in_threadpool(self._watched.folder.listing))

    async def _picture(self, request: HttpRequest) -> Response:
        """Keep the picture that is sent, for a texture as the query says."""
        asked = request.query_params
        wanted = wanted_of(asked.get("dimension", ""), asked.get("sample", ""))
        if wanted is None:
            return PlainTextResponse("there is no such texture", 400)
        data = bytearray()
        async for part in request.stream():
            data += part
            if len(data) > MOST_BYTES:
                said = f"the file is larger than {MOST_BYTES >> 20} MB"
                return PlainTextResponse(said, 413, {"connection": "close"})
        name = asked.get("name", "the picture")
        try:
            word = await run_in_threadpool(self._pictures.keep, name, bytes(data), wanted)
        except (PictureError, MemoryError) as error:
            return PlainTextResponse(str(error) or "there is not enough memory for this", 422)
        except ModuleNotFoundError as error:
            return PlainTextResponse(lacking(error), 422)
        return PlainTextResponse(word)

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
            await run_in_threadpool(self._watched.end)

    def _changed(self, name: str, version: str) -> None:
        """Tell pages of a change; called by the thread that watches the file."""
        if self._loop is not None:
            with suppress(RuntimeError):  # The loop has ended, and nobody is left to be told.
                self._loop.call_soon_threadsafe(self._tell, name, version)

    def _tell(self, name: str, version: str) -> None:
        for queue in self._pages:
            queue.put_nowait((name, version))


async def _next_event(queue: _Queue) -> str:
    """What a page is told next; empty if that is nothing more."""
    try:
        told = await asyncio.wait_for(queue.get(), _PULSE)
    except TimeoutError:
        return ": still here\n\n"
    if told is None:
        return ""
    name, version = told
    return f"data: {json.dumps({'file': name, 'version': version})}\n\n"


class _Ending(uvicorn.Server):
    """Lets the pages go before it waits for open requests, which theirs would be for ever."""

    def __init__(self, config: uvicorn.Config, end_pages: Callable[[], None]) -> None:
        super().__init__(config)
        self._end_pages = end_pages

    async def shutdown(self, sockets: list[socket.socket] | None = None) -> None:
        self._end_pages()
        await super().shutdown(sockets)


def _route(path: str, content: bytes, media_type: str) -> Route:
    async def answer(_request: HttpRequest) -> Response:
        return Response(content, media_type=media_type)

    return Route(path, answer)
