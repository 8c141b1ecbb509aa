"""Checks a reflection's rows about the texts for one profile, from which a driver is set up."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping
from typing import NoReturn

from .....compiler.documents.backends import BindingRow, BlockBindingRow
from .....compiler.documents.reflection import Reflection
from .....compiler.ir.formats import VERTEX_FORMATS
from .....compiler.ir.leaves import LARGEST_PLACE
from .....compiler.ir.stages import STAGES
from .rows import Named, PlanError

_ENTRY = re.compile(r"[A-Za-z_][A-Za-z0-9_]*")
"""The names that entry points may have: compilers get them on their command lines."""


def check_backend(where: str, reflection: Reflection, profile: str) -> None:
    """Raise ``PlanError`` if something that a shader uses has no binding, or an unknown form."""
    _Backend(f"{where}, {profile}", reflection, profile).check()


class _Backend:
    def __init__(self, where: str, reflection: Reflection, profile: str) -> None:
        self._where = where
        self._reflection = reflection
        self._backend = reflection.backends[profile]

    def check(self) -> None:
        backend = self._backend
        for row in backend.files:
            if row.stage not in STAGES:
                self._fail(f"there is no stage `{row.stage}`")
            if not _ENTRY.fullmatch(row.entry_point):
                self._fail(f"`{row.entry_point}` is no name of an entry point")
        for kind, names in self._bound():
            for name in names:
                if name not in getattr(backend, kind):
                    self._fail(f"nothing says where `{name}` of its {kind} is")
        for read in self._reflection.vertex_inputs:
            if read.buffer is None and read.representation not in VERTEX_FORMATS:
                self._fail(f"no vertex input is {read.representation}, as `{read.name}` is")
            if read.buffer is None and read.format != VERTEX_FORMATS[read.representation]:
                found = read.format or "none"
                self._fail(f"{found} is no format of {read.representation}, as `{read.name}` is")
            if read.buffer is None and read.location is None:
                self._fail(f"the vertex input `{read.name}` has no location")

        self._check_places()

    def _check_places(self) -> None:
        """Check that groups and bindings are numbers that some API has."""
        backend = self._backend
        tables: list[tuple[str, Mapping[str, BindingRow | BlockBindingRow]]] = [
            ("block", backend.blocks), ("image", backend.images), ("buffer", backend.buffers),
            ("texture", backend.textures), ("sampler", backend.samplers),
        ]  # fmt: skip
        for kind, rows in tables:
            for name, row in rows.items():
                for what, number in (("group", row.group), ("binding", row.binding)):
                    if number is not None and number > LARGEST_PLACE:
                        self._fail(f"no {what} has the number {number}, as the {kind} `{name}`")

    def _bound(self) -> Iterator[tuple[str, Iterable[str]]]:
        """Everything that has a binding in the texts, by the backend's names for the bindings."""
        reflection, backend = self._reflection, self._backend
        yield "blocks", _names(reflection.blocks)
        yield "buffers", _names(row for row in reflection.buffers if row.stages)
        yield "buffers", _names(reflection.results)
        yield "textures", _names(row for row in reflection.textures if row.stages)
        yield (
            "vertex_inputs",
            _names(row for row in reflection.vertex_inputs if row.buffer is None),
        )
        if backend.images:
            yield "images", _names(reflection.targets)
        if reflection.capture is not None and backend.captures:
            yield "captures", _names(reflection.capture.members)

    def _fail(self, text: str) -> NoReturn:
        raise PlanError(f"{self._where}: {text}")


def _names(rows: Iterable[Named]) -> Iterator[str]:
    return (row.name for row in rows)
