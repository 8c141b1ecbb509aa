"""What ``burnish compile --format json`` tells besides diagnostics."""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from typing import Literal

from ..compiler.documents.answer import CompileAnswer, CompiledFileRow
from ..compiler.inputs import Inputs
from .compile_options import CompileRequest
from .compiled_record import Compiled
from .depfiles import files_read
from .written_files import owners_of, written_of


def compile_answer(
    request: CompileRequest, found: Sequence[Compiled], inputs: Inputs, lines: Sequence[str]
) -> CompileAnswer:
    """The record of a compile without errors; ``lines`` are for people."""
    said = () if request.list_outputs else lines
    return CompileAnswer(
        outputs=tuple(_outputs(request, found)),
        read=tuple(files_read(inputs, request.files)),
        missing=tuple(path for path, content in inputs.contents.items() if content is None),
        lines=tuple(line.rstrip("\n") for line in said),
    )


def _outputs(request: CompileRequest, found: Sequence[Compiled]) -> Iterator[CompiledFileRow]:
    """A row for each output, in the order in which they are put in place."""
    owners = owners_of(request.files, found)
    source_of = {name: source for source, names in owners.items() for name in names}
    kind_of: dict[str, Literal["module", "reflection", "functions", "plan"]] = {}
    for each in found:
        kind_of |= dict.fromkeys(each.modules, "module")
        kind_of |= dict.fromkeys(
            each.reflections, "functions" if request.has_functions else "reflection"
        )
        kind_of |= dict.fromkeys(each.plans, "plan")
    for name in written_of(request.files, found):
        yield CompiledFileRow(
            path=os.path.join(request.output, name),  # noqa: PTH118
            kind=kind_of.get(name, "text"),
            source=source_of[name],
        )
