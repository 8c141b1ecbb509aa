"""Starts ``burnish view``, and asks its server as browsers and others do."""

from __future__ import annotations

import http.client
import json
import sys
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

from ..suite.processes import LIMIT, Program, started

FLAT = """
/// One colour all over.
material Flat {
    param base  : rgb = #b5651d             /// Base colour
    param level : float in 0..1 = 1         /// How much of it
    color = base * level
}
"""


@dataclass(frozen=True, slots=True)
class Answer:
    """An answer of the server."""

    status: int
    headers: Mapping[str, str]
    body: bytes

    def json(self) -> Any:
        """The body as data."""
        return json.loads(self.body)


@dataclass(frozen=True, slots=True)
class Viewer:
    """A server that runs."""

    program: Program
    address: str
    said: Path
    """The file of its standard error."""

    def ask(
        self, path: str, method: str = "GET", body: bytes | None = None, **headers: str
    ) -> Answer:
        """Send a request; names of headers have ``_`` for ``-``."""
        connection = http.client.HTTPConnection(urlsplit(self.address).netloc, timeout=LIMIT)
        given = {name.replace("_", "-"): value for name, value in headers.items()}
        try:
            connection.request(method, path, body, headers=given)
            found = connection.getresponse()
            return Answer(found.status, dict(found.getheaders()), found.read())
        finally:
            connection.close()


@contextmanager
def viewing(file: Path, *options: str) -> Iterator[Viewer]:
    """Show a file for as long as the block runs."""
    command = [sys.executable, "-m", "burnish", "view", file.name, "--no-browser", *options]
    said = file.with_suffix(".said")
    with said.open("w") as stream, started(command, cwd=file.parent, stderr=stream) as program:
        line = program.line().decode()
        name, shown, address = line.partition(" is shown at ")
        is_told = name == file.name or not file.name.isprintable()
        assert (is_told, shown) == (True, " is shown at "), line + said.read_text()
        yield Viewer(program, address.strip(), said)
