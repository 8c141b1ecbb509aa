"""Hostile HTTP requests to the server of ``burnish view``, each made of a seed.

``received.py`` tries them, and ``test_requests.py`` asks a few. All happens in this process: the
application is called as uvicorn calls it, with paths, queries, headers and bodies that no browser
would send.
"""

from __future__ import annotations

import asyncio
import atexit
import gc
from collections.abc import Callable, Iterator, MutableMapping, Sequence
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory
from typing import Any
from urllib.parse import quote, quote_from_bytes, unquote

from burnish.commands.view.request import ViewRequest
from burnish.commands.view.server import Server

from .names import hostile_names

SECRET = "Kept0Private"
"""A word that stands in files beside the folder, in hidden ones, and in what links lead to."""
_NAMES = ("flat.burnish", "broken.burnish", "deep/flat.burnish")
_FLAT = """
material Flat {
    param base : rgb = #b5651d
    map paint : texture2d = black
    color = base * paint(uv).rgb
}
"""
_PATHS = ("/", "/document", "/files", "/picture", "/web_view/main.js", "/web_host/host.js", "/x")
_KEYS = (
    "file", "subject", "rig", "pass", "mesh", "profile", "picture.paint", "picture.", "dimension",
    "sample", "name", "",
)  # fmt: skip
_WORDS = (
    *_NAMES, "Flat", "sphere", "cube", "2d", "float", "glsl:es300", "a.png", "sky.hdr", "../",
    "..", "secret.burnish", "link.burnish", ".hidden.burnish", "/etc/passwd", "%", "%00", "\\", ":",
    "srgb:", "\r\nX-Evil: 1\r\n", "<script>", "1e999", "None", "\udcff", "\u202e", "\U0001f525",
)  # fmt: skip
_HEADERS = (
    "host", "origin", "sec-fetch-site", "content-length", "transfer-encoding", "range", "expect",
    "cookie", "content-type", "x-forwarded-host", "accept-encoding", "if-none-match",
)  # fmt: skip
_METHODS = ("GET", "GET", "GET", "POST", "POST", "HEAD", "PUT", "OPTIONS", "TRACE", "\u00e4")
_PICTURES = (
    b"GIF89a\x00\x20\x00\x20\x80\0\0\0\0\0\xff\xff\xff,\0\0\0\0\x01\0\x01\0\0\x02\x02D\x01\0;",
    b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x02\0\0\0\x02\x08\x02\0\0\0", b"BM", b"II*\0\x08\0\0\0",
    b"%!PS-Adobe-3.0 EPSF-3.0\n", b"#?RADIANCE\n\n-Y 99999 +X 99999\n", b"RIFF\0\0\0\0WEBPVP8 ",
)  # fmt: skip


@dataclass(frozen=True, slots=True)
class Hostile:
    """One request."""

    method: str
    path: str
    query: bytes
    headers: Sequence[tuple[bytes, bytes]]
    parts: Sequence[bytes]
    """The parts of its body, in the order in which they are sent."""
    is_whole: bool
    """True if the body ends; otherwise the connection ends before it."""


@dataclass(frozen=True, slots=True)
class Answered:
    """The answer of the server to a request."""

    status: int
    headers: Sequence[tuple[bytes, bytes]]
    body: bytes


class Asked:
    """A server of a folder with secrets in it and around it, which listens to nobody but us."""

    def __init__(self, folder: Path) -> None:
        shown = _filled(folder)
        request = ViewRequest(
            file=shown, mesh="sphere", floor=False, scene=None, variant=None,
            environment="studio", eye=None, look_at=None, turn=(0.0, 0.0), instances=1,
            exposure=0.0, tone="none", values=(), material=None, rig=None, pass_=None,
            search_path=(), hoist=True, plain=False,
        )  # fmt: skip
        self._server = Server(request)
        self._application = self._server.application()
        self._loop = asyncio.new_event_loop()
        self._host = self._server.address.removeprefix("http://").rstrip("/")

    def close(self) -> None:
        """Give back the port and the loop."""
        self._loop.run_until_complete(self._loop.shutdown_default_executor())
        self._loop.close()
        self._server.close()

    def problem(self, seed: str) -> str | None:
        """The fault in the answer to the request of a seed; ``None`` if there is none.

        Raises whatever the application raises, which is a fault as well.
        """
        hostile = request_of(seed, self._host)
        answered = self._loop.run_until_complete(self._ask(hostile))
        return None if answered is None else _problem(answered)

    async def _ask(self, hostile: Hostile) -> Answered | None:
        """The answer; ``None`` where nobody is left to get one."""
        parts = [
            {"type": "http.request", "body": part, "more_body": True} for part in hostile.parts
        ]
        end = "http.request" if hostile.is_whole else "http.disconnect"
        waiting = [*parts, {"type": end, "body": b"", "more_body": False}]
        sent: list[MutableMapping[str, Any]] = []

        async def receive() -> MutableMapping[str, Any]:
            return waiting.pop(0) if waiting else {"type": "http.disconnect"}

        async def send(message: MutableMapping[str, Any]) -> None:
            sent.append(message)

        scope = {
            "type": "http", "asgi": {"version": "3.0"}, "http_version": "1.1", "scheme": "http",
            "method": hostile.method, "path": hostile.path, "root_path": "",
            "raw_path": hostile.path.encode("utf-8", "surrogateescape"),
            "query_string": hostile.query, "headers": hostile.headers,
            "server": ("127.0.0.1", 1), "client": ("127.0.0.1", 2), "state": {},
        }  # fmt: skip
        await self._application(scope, receive, send)
        if not sent:
            return None
        body = b"".join(message.get("body", b"") for message in sent[1:])
        return Answered(sent[0]["status"], sent[0]["headers"], body)


def trial() -> Callable[[Random, Path], None]:
    """The function that sends a random request to one server, which all requests share."""
    stack = ExitStack()
    server = stack.enter_context(asked())
    atexit.register(stack.close)

    def ask(random: Random, _base: Path) -> None:
        problem = server.problem(str(random.getrandbits(64)))
        assert problem is None, problem

    return ask


@contextmanager
def asked() -> Iterator[Asked]:
    """A server for as long as the block runs, in which garbage is looked for among what is new."""
    gc.freeze()
    with TemporaryDirectory(prefix="burnish-") as folder:
        server = Asked(Path(folder))
        try:
            yield server
        finally:
            server.close()
            gc.unfreeze()


def request_of(seed: str, host: str) -> Hostile:
    """The request of a seed, to the server of this name."""
    random = Random(seed)
    path = random.choice(_PATHS) if random.random() < 0.8 else f"/{_text(random)}"
    query = "&".join(
        f"{random.choice(_KEYS)}{random.choice('===&')}{_written(random)}"
        for _ in range(random.randrange(6))
    )
    headers = [(b"host", host.encode())] if random.random() < 0.9 else []
    for _ in range(random.randrange(3) if random.random() < 0.3 else 0):
        value = random.choice((_text(random), host, f"http://{host}", "same-origin", "9" * 30))
        headers.append((random.choice(_HEADERS).encode(), value.encode("latin-1", "replace")))
    if path == "/picture" and random.random() < 0.7:
        query = f"name={random.choice(('a.png', 'b.hdr', 'c.exr'))}&dimension=2d&sample=float"
    method = "POST" if path == "/picture" else random.choice(_METHODS)
    parts = [_body(random) for _ in range(random.randrange(4))]
    return Hostile(
        method, unquote(path, errors="replace"), query.encode("latin-1", "replace"), headers,
        parts, random.random() < 0.9,
    )  # fmt: skip


def _text(random: Random) -> str:
    if random.random() < 0.1:
        return next(hostile_names(random))
    return "".join(random.choice(_WORDS) for _ in range(random.randrange(4)))


def _written(random: Random) -> str:
    """A text as it may stand in a query: escaped once, twice, or not at all; or bytes."""
    text = _text(random)
    match random.randrange(5):
        case 0:
            return text
        case 1:
            return quote_from_bytes(random.randbytes(random.randrange(12)))
        case 2:
            return quote(quote(text, errors="surrogateescape"))
        case _:
            return quote(text, safe="", errors="surrogateescape")


def _body(random: Random) -> bytes:
    whole = bytearray(random.choice(_PICTURES))
    for _ in range(random.randrange(4)):
        whole[random.randrange(len(whole))] = random.randrange(256)
    return bytes(whole[: random.randrange(len(whole) + 1)]) + random.randbytes(random.randrange(40))


def _filled(folder: Path) -> Path:
    """The folder that is shown, in one with secrets."""
    shown, secret = folder / "shown", f"material {SECRET} {{ color = vec3(1) }}\n"
    (shown / "deep").mkdir(parents=True)
    for name in _NAMES:
        (shown / name).write_text(_FLAT)
    (shown / "broken.burnish").write_text("material Broken {\n")
    for hidden in (folder / "secret.burnish", shown / ".hidden.burnish", shown / "secret.txt"):
        hidden.write_text(secret)
    (shown / "link.burnish").symlink_to(folder / "secret.burnish")
    (shown / "up").symlink_to(folder)
    return shown


def _problem(answered: Answered) -> str | None:
    names = {name.lower() for name, _value in answered.headers}
    if answered.status >= 500:
        return f"the status is {answered.status}: {answered.body[:200]!r}"
    if SECRET.encode() in answered.body:
        return f"a file is told that is not shown: {answered.body[:200]!r}"
    if b"Traceback" in answered.body:
        return f"a traceback is told: {answered.body[:200]!r}"
    if any(b"\r" in value or b"\n" in value for _name, value in answered.headers):
        return f"a header has two lines: {answered.headers!r}"
    missing = {b"content-security-policy", b"x-content-type-options"} - names
    return f"there is no header {sorted(missing)!r}" if missing else None
