"""Exports the materials of a file as a document, and tells what MaterialX cannot say of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, NamedTuple

from ...compiler.ir.shader import Shader
from ...compiler.semantics.shading.assembly import Setting
from ...compiler.syntax import ast
from ..library import library
from .materials import MaterialWriter
from .own import OwnDefinitions
from .unsayable import UnsaidError, UnsayableError

VERSION = "1.39"


class Exported(NamedTuple):
    """A document as a text, and the materials that are in it."""

    text: str
    materials: Sequence[str]


def _place(error: UnsayableError) -> tuple[str, int]:
    return ("", 0) if error.span is None else (error.span.source.name, error.span.start)


def exported(
    materials: Sequence[tuple[Setting, Shader]], file_of: Callable[[str, ast.Texture], str]
) -> Exported:
    """Write materials, which have been checked, to one document.

    ``file_of`` gives the file of a material's texture. Raises ``UnsaidError`` with all that has no
    meaning in MaterialX.
    """
    import MaterialX

    document, has_definitions = _document(materials, file_of, needs_surfaces=False)
    if has_definitions:
        # Of a document without materials, readers show the graphs of its definitions as well.
        document, _ = _document(materials, file_of, needs_surfaces=True)
    document.setDataLibrary(library())
    is_valid, reason = document.validate()
    assert is_valid, reason
    text = MaterialX.writeToXmlString(document)
    return Exported(text, [setting.surface.record.name for setting, _shader in materials])


def _document(
    materials: Sequence[tuple[Setting, Shader]],
    file_of: Callable[[str, ast.Texture], str],
    needs_surfaces: bool,
) -> tuple[Any, bool]:
    """A document with materials, and true if it has definitions of its own.

    With ``needs_surfaces``, colours are surfaces without light, unless one of them has an alpha.
    """
    import MaterialX

    document = MaterialX.createDocument()
    document.setVersionString(VERSION)
    own = OwnDefinitions(document)
    writers = [
        MaterialWriter(document, own, setting, shader, file_of) for setting, shader in materials
    ]
    are_opaque = not any(writer.has_alpha for writer in writers)
    beside = any(writer.is_surface for writer in writers) or (needs_surfaces and are_opaque)
    told = [error for writer in writers for error in writer.written(beside)]
    if told:
        raise UnsaidError(sorted(told, key=_place))
    return document, bool(document.getNodeDefs())
