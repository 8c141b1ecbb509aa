"""The server of ``burnish view``: what it sends, and to whom."""

from __future__ import annotations

import json
import signal
import socket
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import pytest

from ..cli.kit import invoke, shell
from ..suite.processes import until
from .kit import FLAT, Viewer, viewing

pytestmark = pytest.mark.xdist_group("server of view")  # One server is asked by all tests.


@pytest.fixture(scope="module")
def viewer(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Viewer]:
    file = tmp_path_factory.mktemp("view") / "flat.burnish"
    file.write_text(FLAT)
    with viewing(file) as viewer:
        yield viewer


def test_the_page_and_its_parts(viewer: Viewer) -> None:
    page = viewer.ask("/")
    assert (page.status, page.headers["content-type"]) == (200, "text/html; charset=utf-8")
    assert b'src="/web_view/main.js"' in page.body
    assert "default-src 'none'" in page.headers["content-security-policy"]
    for path in (
        "/web_view/main.js", "/web_host/host.js", "/web_host/webgpu/device.js",
        "/web_host/generated/builtins.js",
    ):  # fmt: skip
        assert viewer.ask(path).headers["content-type"] == "text/javascript; charset=utf-8", path


def test_nothing_but_the_page_is_served(viewer: Viewer) -> None:
    for path in (
        "/flat.burnish", "/../flat.burnish", "/%2e%2e/flat.burnish", "/etc/passwd", "//etc/passwd",
        "/web_view/../../setup.py", "/web_view/controls.py", "/web_host/package.py", "/web_view/",
        "/web_host/datum.d.ts", "/web_host/generated/documents.d.ts", "/web_host/package.json",
    ):  # fmt: skip
        assert viewer.ask(path).status == 404, path
    assert viewer.ask("/document", "POST").status == 405


def test_it_listens_on_this_computer_only(viewer: Viewer) -> None:
    port = urlsplit(viewer.address).port
    assert port is not None
    rows = [line.split() for line in Path("/proc/net/tcp").read_text().splitlines()[1:]]
    listening = [row[1] for row in rows if row[3] == "0A" and row[1].endswith(f":{port:04X}")]
    assert listening == [f"0100007F:{port:04X}"]
    assert f":{port:04X} " not in Path("/proc/net/tcp6").read_text()


def test_others_are_refused(viewer: Viewer) -> None:
    own = urlsplit(viewer.address).netloc
    port = own.partition(":")[2]
    for path in ("/", "/document", "/changes", "/web_view/main.js"):
        for host in ("evil.example", f"evil.example:{port}", "127.0.0.1", f"127.0.0.2:{port}", ""):
            assert viewer.ask(path, Host=host).status == 403, (path, host)
    for name in ("127.0.0.1", "localhost", "LocalHost"):
        assert viewer.ask("/document", Host=f"{name}:{port}").status == 200, name
    for origin in ("http://evil.example", "null", f"http://evil.example:{port}", f"https://{own}"):
        assert viewer.ask("/document", Origin=origin).status == 403, origin
    assert viewer.ask("/document", Origin=f"http://{own}").status == 200
    for site in ("cross-site", "same-site"):
        assert viewer.ask("/document", Sec_Fetch_Site=site).status == 403, site
    # A link from elsewhere may lead to the page.
    assert viewer.ask("/", Sec_Fetch_Site="cross-site").status == 200


def test_a_document(viewer: Viewer) -> None:
    found = viewer.ask("/document").json()
    assert found["file"] == "flat.burnish"
    assert found["subjects"] == [{"name": "Flat", "kind": "material"}]
    assert found["chosen"] == {"subject": "Flat", "rig": None, "pass": None, "mesh": "sphere"}
    assert found["doc"] == "One colour all over."
    assert [(row["name"], row["kind"]) for row in found["controls"][:2]] == [
        ("base", "color"), ("level", "number"),
    ]  # fmt: skip
    assert found["package"]["plan"]["outputs"][0]["name"] == "color"
    (text,) = (shader["texts"] for shader in found["package"]["shaders"])
    assert list(text) == ["wgsl:webgpu"]
    # What nobody can mean is as if nothing was asked for.
    strange = viewer.ask("/document?subject=None&mesh=..%2F..&profile=hlsl:sm60&rig=%00").json()
    assert strange == found


@pytest.mark.usefixtures("interruptible")
def test_changes_and_mistakes(tmp_path: Path) -> None:
    """Each change is told, and each mistake once; Ctrl-C ends the server and its streams."""
    file = tmp_path / "m.burnish"
    file.write_text(FLAT)
    with viewing(file, "--port", "0") as viewer:
        first = viewer.ask("/document").json()
        with socket.create_connection(
            (urlsplit(viewer.address).hostname, urlsplit(viewer.address).port), timeout=60
        ) as stream:
            head = f"GET /changes HTTP/1.1\r\nHost: {urlsplit(viewer.address).netloc}\r\n\r\n"
            stream.sendall(head.encode())
            _told(stream, first)
            file.write_text(FLAT.replace("level\n", "levle\n"))
            until(lambda: "error" in viewer.ask("/document").json(), "the mistake is seen")
            broken = viewer.ask("/document").json()
            _told(stream, broken)
            assert broken["version"] != first["version"]
            assert "unknown name `levle`" in broken["error"]
            assert broken["subjects"] == first["subjects"]
            assert viewer.ask("/document").json() == broken
            file.write_text(FLAT.replace("#b5651d", "#336699"))
            until(lambda: "error" not in viewer.ask("/document").json(), "the mended file")
            viewer.program.signal(signal.SIGINT)
            ended = viewer.program.ended()
    assert ended.returncode == 130
    said = viewer.said.read_text()
    assert said.count("error[B0201]: unknown name `levle`") == 1
    assert "Traceback" not in said


def _told(stream: socket.socket, document: dict[str, Any]) -> None:
    """Read until the version of a document is told."""
    said = json.dumps({"file": document["file"], "version": document["version"]})
    wanted, found = f"data: {said}\n\n".encode(), b""
    while wanted not in found:
        piece = stream.recv(4096, 0)
        assert piece, f"the stream has ended: {found!r}"
        found += piece


def test_a_port_that_is_taken(tmp_path: Path) -> None:
    (tmp_path / "m.burnish").write_text(FLAT)
    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        ended = shell("view", "m.burnish", "--no-browser", "--port", port, folder=tmp_path)
    assert (ended.returncode, ended.stdout) == (1, "")
    assert ended.stderr == (
        f"error: port {port} cannot be used: Address already in use\n"
        "  = help: name another one, or leave `--port` out to get one that is free\n"
    )


def test_command_lines_that_make_no_sense(tmp_path: Path) -> None:
    missing = invoke("view", tmp_path / "none.burnish")
    assert missing.exit_code == 1
    assert f"there is no file `{tmp_path / 'none.burnish'}`" in missing.stderr
    assert invoke("view", tmp_path / "none.burnish", "--port", 70000).exit_code == 2
    assert invoke("view", tmp_path / "none.burnish", "--mesh", "teapot").exit_code == 2


@pytest.mark.parametrize("package", ["starlette", "uvicorn", "watchfiles"])
def test_without_its_packages(
    package: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "m.burnish").write_text(FLAT)
    for name in [package, *(name for name in sys.modules if name.startswith(f"{package}."))]:
        monkeypatch.setitem(sys.modules, name, None)
    monkeypatch.delitem(sys.modules, "burnish.commands.view.server", raising=False)
    result = invoke("view", tmp_path / "m.burnish", "--no-browser")
    assert result.exit_code
    assert f"{sys.executable} -m pip install 'burnish[view]'" in result.stderr
