"""Executes a command line of ``burnish compile``: compiles, writes and reports.

``cli.py`` calls ``succeeds`` for plain command lines, ``compile.py`` for those that click has read.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from .compile_options import CompileRequest
from .console import rendered, show
from .results import STDOUT, Output, Question, keep
from .terminal import print_output

if TYPE_CHECKING:
    from ..api.compiled import CompileResult
    from ..compiler.diagnostics.diagnostic import Diagnostic
    from ..compiler.documents.plan import FramePlan
    from ..compiler.documents.reflection import Reflection


def succeeds(request: CompileRequest, question: Question | None) -> bool:
    """Compile once and report the diagnostics; True if there was any output.

    ``question`` is the key under which the output is kept, if it is to be kept.
    """
    from ..compiler.diagnostics.diagnostic import CompileError

    warnings: tuple[Diagnostic, ...] = ()
    try:
        result = _compiled(request)
        warnings = result.diagnostics
        if request.validate:
            _insist_on_acceptance(result)
        output = _output(request, result)
        _deliver(output)
    except CompileError as error:
        show((*warnings, *error.diagnostics))
        return False
    show(warnings)
    if question is not None:
        keep(question, output, result.inputs)
    return True


def _compiled(request: CompileRequest) -> CompileResult:
    from ..api import entry_points as api
    from ..targets.selection import DEFAULT

    return api.compile(
        request.file,
        [name for names in request.targets for name in names.split(",")] or DEFAULT,
        material=request.material,
        rig=request.rig,
        pass_=request.pass_,
        search_path=request.search_path,
        hoist=request.hoist,
        flip_y=request.flip_y,
        single_file=request.single_file,
        line_directives=request.line_directives,
        native_stages=request.native_stages,
    )


def _output(request: CompileRequest, result: CompileResult) -> Output:
    """The output of a command line: files in a folder, or shaders on standard output."""
    warnings = rendered(result.diagnostics)
    if request.output == STDOUT:
        files = [file for material in result.materials for file in material.files]
        headings = (f"// ======== {file.name}\n" if len(files) > 1 else "" for file in files)
        printed = (heading + file.text for heading, file in zip(headings, files, strict=True))
        return Output(STDOUT, {}, "".join(printed), warnings)
    texts: dict[str, str] = {}
    reflections: dict[str, str] = {}
    lines = []
    for material in result.materials:
        reflection = f"{material.name}.json"
        texts |= {file.name: file.text for file in material.files}
        reflections[reflection] = _as_json(material.reflection)
        shaders = f"{len(material.files)} shaders and {reflection}"
        lines.append(f"{material.name}: {shaders} in {request.output}\n")
    plans: dict[str, str] = {}
    for frame in result.frames:
        plan = f"{frame.name}.plan.json"
        plans[plan] = _as_json(frame.plan)
        count = len(frame.plan.steps)
        steps = "1 step" if count == 1 else f"{count} steps"
        lines.append(f"{frame.name}: {steps}, {plan} in {request.output}\n")
    lines += _remarks_on_languages(result)
    # Reflections are put in place behind the shaders, and plans last: whoever sees a new one finds
    # what it describes.
    return Output(request.output, texts | reflections | plans, "".join(lines), warnings)


def _remarks_on_languages(result: CompileResult) -> Iterator[str]:
    """A line for each language of the texts that is marked as unproven."""
    from ..targets import registry

    names = (file.target for material in result.materials for file in material.files)
    for target in map(registry.load, dict.fromkeys(names)):
        if target.unproven:
            yield f"texts in {target.title}: {target.unproven}\n"


def _deliver(output: Output) -> None:
    """Write the files and print the texts, or raise ``CompileError``."""
    from .output import unwritable, write_all

    if output.folder != STDOUT:
        write_all(Path(output.folder), output.texts)
    try:
        print_output(output.printed)
    except BrokenPipeError:
        raise
    except OSError as error:
        raise unwritable(Path("standard output"), error.strerror or str(error)) from error


def _insist_on_acceptance(result: CompileResult) -> None:
    """Raise ``CompileError`` unless the downstream compilers accept every text."""
    from ..compiler.diagnostics.diagnostic import CompileError
    from .validate import validate

    found = validate(file for material in result.materials for file in material.files)
    if any(diagnostic.severity == "error" for diagnostic in found):
        raise CompileError(found)
    show(found)


def _as_json(document: Reflection | FramePlan) -> str:
    import json

    from ..compiler.documents.writing import to_json

    return json.dumps(to_json(document), indent=2, ensure_ascii=False) + "\n"
