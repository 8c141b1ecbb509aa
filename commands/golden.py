"""``burnish conform --golden``: writes a folder by which others judge their own pictures."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..targets.conformance.golden.document import NAME, GoldenCase
from ..targets.conformance.golden.writing import GoldenWriting, NothingToDrawError
from .compared import ConformRequest, subjects_of
from .console import remark, say
from .failures import fail
from .output import write_tree
from .progress import Progress

if TYPE_CHECKING:
    from ..targets.runner.routes import Route


def write_golden(request: ConformRequest, routes: Sequence[Route], folder: Path) -> None:
    """Write the bounds and inputs of all subjects of a request, or nothing at all.

    Raises whatever compiling and drawing by the reference raise, and ``CompileError`` if the folder
    cannot be written.
    """
    subjects = subjects_of(request, routes, native_stages=False)
    writing = GoldenWriting(routes, request.seed)
    with Progress("bounding") as progress:
        try:
            writing.add(subjects, progress.tell)
        except NothingToDrawError as error:
            fail(str(error))
    write_tree(folder, writing.files())
    for case in writing.cases:
        say(_line(case))
    for case in writing.cases:
        if case.undecided == case.width * case.height:
            remark("warning", f"{case.folder}: nothing is compared, as all pixels are undecided")
    say(f"golden: {folder / NAME}")


def _line(case: GoldenCase) -> str:
    outputs = ", ".join(row.name for row in case.outputs)
    size = f"{case.width} x {case.height}"
    return f"{case.folder}: {outputs}, {size} pixels, {case.undecided} undecided"
