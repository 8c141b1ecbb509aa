"""Hostile requests to the server of ``burnish view``: it refuses all of them, and goes on."""

from __future__ import annotations

import socket
import time
from collections.abc import Iterator
from contextlib import ExitStack, suppress
from functools import partial
from pathlib import Path
from urllib.parse import quote, urlsplit

import pytest

from burnish.commands.view.uploads import MOST_BYTES

from ..suite.processes import LIMIT, at_once
from .kit import FLAT, Viewer, viewing

pytestmark = pytest.mark.xdist_group("hostile requests")  # One server is asked by all tests.

SECRET = "material Secret { color = vec3(1) }\n"
PICTURE = "/picture?name=a.png&dimension=2d&sample=float"


@pytest.fixture(scope="module")
def viewer(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Viewer]:
    """A server of a folder with secrets beside it and in it; it has complained of nothing."""
    outside = tmp_path_factory.mktemp("hostile")
    folder = outside / "shown"
    folder.mkdir()
    (outside / "secret.burnish").write_text(SECRET)
    (folder / "flat.burnish").write_text(FLAT)
    (folder / ".hidden.burnish").write_text(SECRET)
    (folder / "secret.txt").write_text(SECRET)
    (folder / "link.burnish").symlink_to(outside / "secret.burnish")
    with viewing(folder) as viewer:
        yield viewer
        assert viewer.said.read_text() == ""


def sent(viewer: Viewer, *pieces: bytes) -> bytes:
    """The server's answer to these bytes, until it closes the connection."""
    with connection(viewer) as stream:
        for piece in pieces:
            stream.sendall(piece)
        return received(stream)


def received(stream: socket.socket) -> bytes:
    found = bytearray()
    while piece := stream.recv(1 << 16):
        found += piece
    return bytes(found)


def connection(viewer: Viewer) -> socket.socket:
    address = urlsplit(viewer.address)
    return socket.create_connection((address.hostname, address.port), timeout=LIMIT)


def head(viewer: Viewer, line: str, *headers: str) -> bytes:
    """The head of a request after which the connection is closed."""
    host = f"Host: {urlsplit(viewer.address).netloc}"
    return "\r\n".join((line, host, "Connection: close", *headers, "", "")).encode("latin-1")


def status(answer: bytes) -> int:
    """The status of an answer; 0 if there is none."""
    return int(answer.split(b" ", 2)[1]) if answer else 0


HOSTS = (
    "evil.example", "localhost.", "127.0.0.1.", "127.1", "0x7f.1", "2130706433", "[::1]",
    "[::ffff:127.0.0.1]", "user@127.0.0.1", "127.0.0.1@evil.example", "127.0.0.1.evil.example",
    "evil.example#127.0.0.1", "LOCALHOST.evil.example", "localhost,127.0.0.1", "",
)  # fmt: skip


@pytest.mark.parametrize("name", HOSTS)
def test_other_names_of_the_server(viewer: Viewer, name: str) -> None:
    """Names that lead here, or seem to, are those of other pages (DNS rebinding)."""
    port = urlsplit(viewer.address).port
    for host in (f"{name}:{port}", name, f"{name}:80", f"{name}:{port}0"):
        answer = viewer.ask("/document", Host=host)
        assert (answer.status, SECRET.encode() in answer.body) == (403, False), host


def test_requests_without_or_with_two_names(viewer: Viewer) -> None:
    assert status(sent(viewer, b"GET /document HTTP/1.0\r\n\r\n")) == 403
    assert status(sent(viewer, b"GET /document HTTP/1.1\r\nConnection: close\r\n\r\n")) == 400
    two = head(viewer, "GET /document HTTP/1.1", "Host: evil.example")
    assert status(sent(viewer, two)) == 400
    absolute = head(viewer, "GET http://evil.example/document HTTP/1.1")
    assert status(sent(viewer, absolute)) == 404


def test_requests_of_other_pages(viewer: Viewer) -> None:
    """Forms, scripts without CORS, streams of events and sockets: all carry where they are from."""
    own = urlsplit(viewer.address)
    origins = (
        "http://evil.example", "null", "file://", f"https://{own.netloc}", f"http://{own.netloc}.",
        f"http://{own.netloc}@evil.example", f"http://127.0.0.1:{(own.port or 0) + 1}", "",
        f"http://127.0.0.2:{own.port}", f"http://[::1]:{own.port}",
    )  # fmt: skip
    kinds = ("application/x-www-form-urlencoded", "multipart/form-data; boundary=x", "text/plain")
    for origin in origins:
        assert viewer.ask("/changes", Origin=origin).status == 403, origin
        for kind in kinds:
            answer = viewer.ask(PICTURE, "POST", b"x", Origin=origin, Content_Type=kind)
            assert answer.status == 403, (origin, kind)
    for site in ("cross-site", "same-site", "strange", ""):
        for mode in ("no-cors", "cors", "navigate", "websocket"):
            for path, method, body in (("/document", "GET", None), (PICTURE, "POST", b"x")):
                answer = viewer.ask(path, method, body, Sec_Fetch_Site=site, Sec_Fetch_Mode=mode)
                assert answer.status == 403, (path, site, mode)
    upgrade = ("Upgrade: websocket", "Connection: Upgrade", "Sec-WebSocket-Key: AAAA")
    asked = head(viewer, "GET /changes HTTP/1.1", "Origin: http://evil.example", *upgrade)
    assert status(sent(viewer, asked)) == 403


UP = (
    "../secret.burnish", "..\\secret.burnish", "./../secret.burnish", "flat.burnish/../../secret",
    "%2e%2e/secret.burnish", "%252e%252e%252fsecret.burnish", "..%2fsecret.burnish",
    "..%5csecret.burnish", "..%c0%afsecret.burnish", "flat.burnish%00.txt", "/etc/passwd",
    "//etc/passwd", "\\\\server\\share\\x.burnish", "C:\\secret.burnish", "file:///etc/passwd",
    ".hidden.burnish", "secret.txt", "link.burnish", "flat.burnish/", "FLAT.BURNISH", ".", "..",
    "~/secret.burnish", "/proc/self/environ", "flat.burnish::$DATA", "CON", "\ud7ff\n\r",
)  # fmt: skip


@pytest.mark.parametrize("name", UP)
def test_names_that_lead_elsewhere(viewer: Viewer, name: str) -> None:
    """The names are tried as the address of a resource, and as the name of a file to show."""
    plain = viewer.ask("/document?file=flat.burnish").json()
    for text in (quote(name, safe=""), quote(name), quote(name, safe="/\\%:.$")):
        for path in (f"/{text}", f"/web_view/{text}", f"/web_host/{text}"):
            assert viewer.ask(path).status == 404, path
        for key in ("file", "subject", "rig", "pass", "mesh", "picture.paint", "profile"):
            found = viewer.ask(f"/document?file=flat.burnish&{key}={text}")
            assert found.status == 200
            assert b"Secret" not in found.body
            if key == "file":
                assert viewer.ask(f"/document?file={text}").json() == plain


@pytest.mark.parametrize("method", ["PUT", "DELETE", "TRACE", "PATCH", "OPTIONS", "CONNECT", "GIT"])
def test_other_methods(viewer: Viewer, method: str) -> None:
    for path in ("/", "/document", "/files", "/changes", PICTURE, "/web_view/main.js"):
        answer = sent(viewer, head(viewer, f"{method} {path} HTTP/1.1", "Content-Length: 0"))
        assert status(answer) == 405, (method, path)
        assert b"access-control" not in answer.lower()


BROKEN = (
    b"", b"\r\n" * 100, b"GET\r\n\r\n", b"GET / HTTP/9.9\r\n\r\n", b"\x16\x03\x01\x02\x00\x01",
    b"GET / HTTP/1.1\r\nHost : x\r\n\r\n", b"GET /\xff HTTP/1.1\r\n\r\n", bytes(range(256)) * 300,
    b"GET / HTTP/1.1\nX: y\n z\n\n", b"PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n", b"GET / HTTP/1.1\r\n" * 9,
    b"GET /" + b"a" * 100_000, b"GET / HTTP/1.1\r\nA: " + b"a" * 100_000,
    b"GET / HTTP/1.1\r\n" + b"A: b\r\n" * 20_000,
)  # fmt: skip


@pytest.mark.parametrize("number", range(len(BROKEN)))
def test_what_is_no_request(viewer: Viewer, number: int) -> None:
    """Lines and headers that are too long are among them."""
    with connection(viewer) as stream:
        stream.sendall(BROKEN[number])
        stream.shutdown(socket.SHUT_WR)
        with suppress(ConnectionResetError):  # The rest of what is too long was not read.
            assert status(received(stream)) in (0, 400, 403)
    assert viewer.ask("/document").status == 200


def test_bodies_that_are_wrongly_framed(viewer: Viewer) -> None:
    """Two lengths, a length and chunks, or lengths that are none, hide requests from each other."""
    line = f"POST {PICTURE} HTTP/1.1"
    chunked = "Transfer-Encoding: chunked"
    for headers in (
        ("Content-Length: 4", "Content-Length: 5"), ("Content-Length: -1",),
        ("Content-Length: 4x",), ("Content-Length: 99999999999999999999999",),
        ("Transfer-Encoding: gzip, chunked",), (chunked, chunked),
    ):  # fmt: skip
        answer = sent(viewer, head(viewer, line, *headers), b"text")
        assert status(answer) in (400, 413, 501), headers
    assert status(sent(viewer, head(viewer, line, chunked), b"zz\r\n")) == 400


def test_bodies_that_are_too_large(viewer: Viewer) -> None:
    """A body with a declared size is refused unread; one of chunks, as soon as it is too large."""
    line = f"POST {PICTURE} HTTP/1.1"
    with connection(viewer) as stream:
        stream.sendall(head(viewer, line, f"Content-Length: {MOST_BYTES + 1}"))
        assert status(stream.recv(1 << 16)) == 413
    chunk = b"100000\r\n" + bytes(1 << 20) + b"\r\n"
    with connection(viewer) as stream:
        stream.sendall(head(viewer, line, "Transfer-Encoding: chunked"))
        for _ in range(MOST_BYTES >> 20):
            stream.sendall(chunk)
        stream.sendall(chunk[:100])
        assert status(stream.recv(1 << 16)) == 413
    # Nobody reads the body of these, however long it is.
    body = head(viewer, "GET /document HTTP/1.1", "Content-Length: 1000000000")
    with connection(viewer) as stream:
        stream.sendall(body)
        assert status(stream.recv(1 << 16)) == 200


def test_bodies_that_end_too_early(viewer: Viewer) -> None:
    for _ in range(5):
        with connection(viewer) as stream:
            stream.sendall(head(viewer, f"POST {PICTURE} HTTP/1.1", "Content-Length: 1000") + b"x")
    assert viewer.ask("/document").status == 200


def test_texts_that_nobody_means(viewer: Viewer) -> None:
    """Every value in a page's query is a name or ignored: no number, structure or markup."""
    plain = viewer.ask("/document").json()
    deep = quote("[" * 5000 + "]" * 5000)
    for text in ("1e999", "-1", "NaN", "null", "{}", deep, quote("<script>"), "%ff%fe", "%00"):
        for key in ("subject", "rig", "pass", "mesh", "profile", "file", "x", "picture."):
            assert viewer.ask(f"/document?{key}={text}&{key}={text}&&=&{text}").json() == plain
        for key in ("dimension", "sample"):
            assert viewer.ask(f"/picture?name=a&{key}={text}", "POST", b"x").status == 400
    name = quote("a\r\nX-Evil: 1\r\n\r\n<script>.png")
    answer = viewer.ask(f"/picture?name={name}&dimension=2d&sample=float", "POST", b"x")
    assert answer.status == 422
    assert "x-evil" not in {key.lower() for key in answer.headers}
    assert answer.headers["content-type"] == "text/plain; charset=utf-8"


def test_answers_stay_within_the_page(viewer: Viewer) -> None:
    """This holds also for answers to other pages, and about things that do not exist."""
    paths = ("/", "/document", "/files", "/none", "/web_view/main.js")
    answers = {path: viewer.ask(path) for path in paths}
    answers["refused"] = viewer.ask("/", Host="evil.example")
    for path, answer in answers.items():
        found = {key.lower(): value for key, value in answer.headers.items()}
        assert found["x-content-type-options"] == "nosniff", path
        policy = found["content-security-policy"]
        assert "default-src 'none'" in policy
        assert "require-trusted-types-for 'script'" in policy
        assert "unsafe" not in policy
        assert found["cross-origin-resource-policy"] == "same-origin"
        assert "server" not in found
    ranges = viewer.ask("/web_view/main.js", Range="bytes=0-0,-1,5-4,0-99999999999")
    assert (ranges.status, ranges.body) == (200, viewer.ask("/web_view/main.js").body)


def test_many_at_once(viewer: Viewer) -> None:
    """Requests for one document and for another are answered alike."""
    paths = ["/document", "/files", "/document?mesh=cube", "/web_view/main.js"] * 50
    answers = at_once([partial(viewer.ask, path) for path in paths])
    assert {answer.status for answer in answers} == {200}
    for start in range(4):
        assert len({answer.body for answer in answers[start::4]}) == 1


def test_who_asks_slowly(viewer: Viewer) -> None:
    """Half a request is waited for, but not for ever; others are answered meanwhile."""
    with ExitStack() as streams:
        begun = time.monotonic()
        slow = [streams.enter_context(connection(viewer)) for _ in range(100)]
        for stream in slow:
            stream.sendall(b"GET / HTTP/1.1\r\nHost:")
        assert viewer.ask("/document").status == 200
        for stream in slow:
            stream.settimeout(max(1.0, LIMIT - (time.monotonic() - begun)))
            with pytest.raises(ConnectionResetError):
                assert stream.recv(1) == b""
                raise ConnectionResetError


def test_no_file_of_outside_is_listed(viewer: Viewer) -> None:
    names = [file["name"] for group in viewer.ask("/files").json() for file in group["files"]]
    assert names == ["flat.burnish"]
    assert Path(viewer.said).read_text() == ""
