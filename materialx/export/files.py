"""Opens a file of Burnish and exports its materials; ``burnish export`` calls it."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path

from ...api.compiling import opened, sources
from ...compiler.diagnostics.diagnostic import CompileError, Report
from ...compiler.frontend import Frontend
from ...compiler.syntax import ast
from .exporting import Exported, exported


def export(
    source: str | Path,
    *,
    material: str | None = None,
    rig: str | None = None,
    pass_: str | None = None,
    search_path: Sequence[str | Path] = (),
    file_of: Callable[[str, ast.Texture], str] = lambda _material, texture: (
        f"{texture.name.text}.png"
    ),
) -> Exported:
    """The materials of a file, or of a text, as a document of MaterialX.

    ``file_of`` gives the file of a material's texture as the document names it. Raises
    ``CompileError`` for errors in the file, and ``UnsaidError`` for all that MaterialX cannot say.
    """
    report = Report()
    given, folders = sources(source, search_path)
    frontend = Frontend(report, folders)
    module = opened(given, frontend)
    found = [] if module is None else frontend.assembled(module, material, rig, pass_)
    if report.failed:
        raise CompileError(report.diagnostics)
    return exported(found, file_of)
