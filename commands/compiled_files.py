"""Compiles one file of a command line to what is written for it.

``many_files.py`` calls ``compiled`` for each file, or a process that it has started.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from .compile_options import CompileRequest, name_and_value
from .compiled_record import Compiled

if TYPE_CHECKING:
    from ..api.compiled import CompiledMaterial, CompileResult
    from ..api.modules import Module
    from ..compiler.diagnostics.diagnostic import Diagnostic
    from ..compiler.documents.reflection import Reflection


_UNSIGNED = (
    "DXIL is not signed: Direct3D 12 takes it in developer mode, or once dxil.dll has signed it\n"
)
"""Said of DXIL, as the tool that signs it is Microsoft's, and not part of DXC's sources."""


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
        modules, said = _modules(request, result)
        warnings += said
    except CompileError as error:
        return Compiled({}, {}, {}, {}, (), (), (*warnings, *error.diagnostics), None)
    return _written(request, result, modules, warnings)


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
        bindings=request.bindings,
    )


def _complaints(result: CompileResult) -> tuple[Diagnostic, ...]:
    """The warnings of the downstream compilers; raises ``CompileError`` if one refuses a text."""
    from ..api.validating import validate
    from ..compiler.diagnostics.diagnostic import CompileError

    found = validate(file for material in result.materials for file in material.files)
    if any(diagnostic.severity == "error" for diagnostic in found):
        raise CompileError(found)
    return tuple(found)


def _modules(
    request: CompileRequest, result: CompileResult
) -> tuple[Mapping[str, Sequence[Module]], tuple[Diagnostic, ...]]:
    """The modules of each material, by its stem; and warnings. Raises ``CompileError``."""
    if not request.modules:
        return {}, ()
    from ..api.modules import modules_of

    return modules_of(result.materials, request.modules, optimised=request.optimize)


def _written(
    request: CompileRequest,
    result: CompileResult,
    modules: Mapping[str, Sequence[Module]],
    warnings: tuple[Diagnostic, ...],
) -> Compiled:
    from ..compiler.documents.writing import to_text
    from ..compiler.syntax.quoting import counted

    texts = {file.name: file.text for material in result.materials for file in material.files}
    reflections: dict[str, str] = {}
    plans: dict[str, str] = {}
    lines = []
    if request.prints:
        return Compiled(texts, {}, {}, {}, (), (), warnings, result.inputs)
    binaries: dict[str, bytes] = {}
    for material in result.materials:
        reflection = f"{material.stem}.json"
        own = modules.get(material.stem, ())
        reflections[reflection] = to_text(_reflection(material, own))
        binaries |= {module.row.file: module.content for module in own}
        made = f", {counted(len(own), 'module')}" if own else ""
        shaders = f"{counted(len(material.files), 'shader')}{made} and {reflection}"
        lines.append(f"{material.name}: {shaders} in {request.output}\n")
        lines += _reasons(material) if request.why else ()
    for frame in result.frames:
        plan = f"{frame.stem}.plan.json"
        plans[plan] = to_text(frame.plan)
        count = len(frame.plan.steps)
        steps = "1 step" if count == 1 else f"{count} steps"
        lines.append(f"{frame.name}: {steps}, {plan} in {request.output}\n")
    remarks = (*_remarks_on_passes(request, result), *_remarks_on_languages(result))
    if "dxil" in request.modules:
        remarks = (*remarks, _UNSIGNED)
    return Compiled(
        texts, reflections, plans, binaries, tuple(lines), remarks, warnings, result.inputs
    )


def _reflection(material: CompiledMaterial, modules: Sequence[Module]) -> Reflection:
    if not modules:
        return material.reflection
    from ..api.modules import with_modules

    return with_modules(material.reflection, modules)


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
    declared = api.declared(file, search_path=request.search_path)
    passes = [name for name in declared.passes if name not in declared.ties.values()]
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
