"""Compiles one file of a command line to what is written for it.

``many_files.py`` calls ``compiled`` for each file, or a process that it has started.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import TYPE_CHECKING

from .compile_options import CompileRequest, name_and_value
from .compiled_record import Compiled

if TYPE_CHECKING:
    from ..api.compiled import CompiledMaterial, CompileResult
    from ..compiler.diagnostics.diagnostic import Diagnostic


def compiled(request: CompileRequest) -> Compiled:
    """What the only file of a request becomes."""
    from ..compiler.diagnostics.diagnostic import CompileError

    (file,) = request.files
    if request.has_functions:
        from .function_files import compiled_functions

        return compiled_functions(request)
    warnings: tuple[Diagnostic, ...] = ()
    try:
        result = _result(request, file)
        warnings = result.diagnostics
        if request.validate:
            warnings += _complaints(result)
    except CompileError as error:
        return Compiled({}, {}, {}, (), (), (*warnings, *error.diagnostics), None)
    return _written(request, result, warnings)


def _result(request: CompileRequest, file: Path) -> CompileResult:
    from ..api import entry_points as api
    from ..targets.selection import DEFAULT

    return api.compile(
        file,
        [name for names in request.targets for name in names.split(",")] or DEFAULT,
        material=request.material,
        rig=request.rig,
        pass_=request.pass_,
        search_path=request.search_path,
        values=dict(map(name_and_value, request.values)),
        hoist=request.hoist,
        flip_y=request.flip_y,
        single_file=request.single_file,
        line_directives=request.line_directives,
        native_stages=request.native_stages,
    )


def _complaints(result: CompileResult) -> tuple[Diagnostic, ...]:
    """The warnings of the downstream compilers; raises ``CompileError`` if one refuses a text."""
    from ..compiler.diagnostics.diagnostic import CompileError
    from .validate import validate

    found = validate(file for material in result.materials for file in material.files)
    if any(diagnostic.severity == "error" for diagnostic in found):
        raise CompileError(found)
    return tuple(found)


def _written(
    request: CompileRequest, result: CompileResult, warnings: tuple[Diagnostic, ...]
) -> Compiled:
    from ..compiler.documents.writing import to_text

    texts = {file.name: file.text for material in result.materials for file in material.files}
    reflections: dict[str, str] = {}
    plans: dict[str, str] = {}
    lines = []
    if request.prints:
        return Compiled(texts, {}, {}, (), (), warnings, result.inputs)
    for material in result.materials:
        reflection = f"{material.name}.json"
        reflections[reflection] = to_text(material.reflection)
        shaders = f"{len(material.files)} shaders and {reflection}"
        lines.append(f"{material.name}: {shaders} in {request.output}\n")
        lines += _reasons(material) if request.why else ()
    for frame in result.frames:
        plan = f"{frame.name}.plan.json"
        plans[plan] = to_text(frame.plan)
        count = len(frame.plan.steps)
        steps = "1 step" if count == 1 else f"{count} steps"
        lines.append(f"{frame.name}: {steps}, {plan} in {request.output}\n")
    remarks = (*_remarks_on_passes(request, result), *_remarks_on_languages(result))
    return Compiled(texts, reflections, plans, tuple(lines), remarks, warnings, result.inputs)


def _reasons(material: CompiledMaterial) -> Iterator[str]:
    """A line for each value that a shader does not compute, with its place in the source."""
    for removal in material.removals:
        place = "" if removal.span is None else f"{removal.span}: "
        yield f"  {place}{removal.sentence}\n"
    if not material.removals:
        yield "  No value of a parameter makes anything dead.\n"


def _remarks_on_passes(request: CompileRequest, result: CompileResult) -> Iterator[str]:
    """A line that tells of the passes of a file that have not drawn its materials."""
    from ..api import entry_points as api

    drawn = any(each.reflection.targets for each in result.materials)
    file = request.files[0]
    if request.pass_ is not None or not drawn or result.frames or not file.is_file():
        return  # A pipe cannot be read again.
    if b"pass" not in file.read_bytes():
        return  # To parse a file again takes longer than to look for the word.
    passes = api.declared(file, search_path=request.search_path).passes
    if passes:
        ways = " or ".join(f"`--pass {name}`" for name in passes)
        yield f"the library's pass Forward draws; {ways} takes one of {file.name}\n"


def _remarks_on_languages(result: CompileResult) -> Iterator[str]:
    """A line for each language of the texts that is marked as unproven."""
    from ..targets import registry

    names = (file.target for material in result.materials for file in material.files)
    for target in map(registry.load, dict.fromkeys(names)):
        if target.unproven:
            yield f"texts in {target.title}: {target.unproven}\n"
