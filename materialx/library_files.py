"""Files of Burnish's own library, parsed, for what importers have to know of them."""

from __future__ import annotations

from ..compiler.diagnostics.diagnostic import Report
from ..compiler.diagnostics.source import Source
from ..compiler.library import FOLDER
from ..compiler.library_trees import parse_library
from ..compiler.syntax import ast

Declaration = (
    ast.Record
    | ast.Mixin
    | ast.Function
    | ast.Rig
    | ast.StructDeclaration
    | ast.Enumeration
    | ast.ExternBlock
    | ast.Space
    | ast.Constant
)
"""What has a name, unlike an import."""


def declarations(path: str) -> tuple[Declaration, ...]:
    """The declarations of a file of the library, but for its imports."""
    source = Source(path, (FOLDER / path).read_text(encoding="utf-8"))
    found = parse_library(source, Report()).declarations
    return tuple(each for each in found if not isinstance(each, ast.Import))
