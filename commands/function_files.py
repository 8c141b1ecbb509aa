"""Compiles one file of a command line to functions: ``compiled_files.py`` calls it for them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from ..api import entry_points as api
from ..api.compiled_functions import FunctionsResult
from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import CompileError, Diagnostic, Report
from ..compiler.diagnostics.nearest import suggestion
from ..compiler.documents.functions import Functions
from ..compiler.documents.writing import to_text
from ..engines.engine import Engine
from ..targets import registry
from ..targets.selection import DEFAULT
from .compile_options import CompileRequest, name_and_value
from .compiled_record import Compiled


def compiled_functions(request: CompileRequest) -> Compiled:
    """What the only file of a request becomes."""
    (file,) = request.files
    try:
        engine = _engine(request.engines[0]) if request.engines else None
        if engine is not None and engine.write_shaders is not None:
            return _of_shaders(request, file, engine)
        result = _result(request, file, engine)
        if engine is None:
            texts = {each.name: each.text for material in result for each in material.files}
            told = result.diagnostics
        else:
            texts, told = _files_of(engine, result)
    except CompileError as error:
        return Compiled({}, {}, {}, {}, (), (), error.diagnostics, None)
    documents, lines = {}, []
    for material in () if request.prints else result:
        own = "" if engine is None else f".{engine.name}"  # So that engines share a folder.
        name = f"{material.name}{own}.functions.json"
        document = material.document
        if engine is not None:
            from ..engines.fitting import taken

            document = taken(engine, document, material.files[0].emission)
        documents[name] = to_text(document)
        lines.append(_line(document, len(material.files), name, request, engine))
    remarks = () if request.prints else tuple(_remarks(result, engine))
    return Compiled(texts, documents, {}, {}, tuple(lines), remarks, told, result.inputs)


def _engine(name: str) -> Engine:
    """The engine called so. Raises ``CompileError`` if there is none."""
    from ..engines import known as engines

    if name not in engines.names():
        report = Report()
        hint = suggestion(name, engines.names()) or f"there is {', '.join(engines.names())}"
        report.add(rules.NO_SUCH_ENGINE, None, name=name, hint=hint)
        raise CompileError(report.diagnostics)
    return engines.load(name)


def _result(request: CompileRequest, file: Path, engine: Engine | None) -> FunctionsResult:
    if engine is not None:
        return _for_engine(request, file, engine)
    return api.functions(
        file,
        _apart(request.targets) or DEFAULT,
        material=request.material,
        rig=request.rig,
        slots=_apart(request.slots),
        together=request.together,
        prefix=request.prefix,
        search_path=request.search_path,
        values=dict(map(name_and_value, request.values)),
    )


def _for_engine(request: CompileRequest, file: Path, engine: Engine) -> FunctionsResult:
    """The functions that an engine takes, with what a user says of its values."""
    from ..api.compiling_engines import functions_for

    given = [each.partition("=") for each in _apart(request.slots)]
    return functions_for(
        engine,
        file,
        material=request.material,
        rig=request.rig,
        search_path=tuple(map(Path, request.search_path)),
        prefix=request.prefix,
        values=tuple(map(name_and_value, request.values)),
        named={word.strip(): slot.strip() for word, sign, slot in given if sign},
        only=[word for word, sign, _slot in given if not sign],
    )


def _of_shaders(request: CompileRequest, file: Path, engine: Engine) -> Compiled:
    """The files of an engine that takes whole shaders. Raises ``CompileError``."""
    from ..api.compiling_engines import shader_files, shaders_for

    result = shaders_for(
        engine,
        file,
        material=request.material,
        rig=request.rig,
        pass_=request.pass_,
        search_path=tuple(map(Path, request.search_path)),
        values=tuple(map(name_and_value, request.values)),
        hoist=request.hoist,
    )
    report, texts, lines = Report(), dict[str, str](), []
    for frame in result.frames:
        report.add(
            rules.UNFIT_FOR_ENGINE, None, slot=frame.name, engine=engine.title,
            reason="it is a frame of several passes, and the engine takes single materials",
        )  # fmt: skip
    for material in () if result.frames else result.materials:
        own = shader_files(engine, material, report)
        texts |= own
        lines.append(f"{material.name}: {len(own)} files for {engine.title} in {request.output}\n")
    if report.failed:
        raise CompileError((*result.diagnostics, *report.diagnostics))
    told = () if request.prints else tuple(lines)
    return Compiled(texts, {}, {}, {}, told, (), result.diagnostics, result.inputs)


def _files_of(
    engine: Engine, result: FunctionsResult
) -> tuple[dict[str, str], tuple[Diagnostic, ...]]:
    """What an engine takes of all materials, with what is told. Raises ``CompileError``."""
    from ..engines.fitting import files

    report, found = Report(), dict[str, str]()
    for material in result:
        emissions = {f"{each.target}:{each.profile}": each.emission for each in material.files}
        found |= files(engine, material.document, emissions, report)
    if report.failed:
        raise CompileError(report.diagnostics)
    return found, (*result.diagnostics, *report.diagnostics)


def _apart(given: Sequence[str]) -> list[str]:
    """Values of an option, each of which may be several with commas."""
    return [name.strip() for names in given for name in names.split(",") if name.strip()]


def _line(
    made: Functions, files: int, document: str, request: CompileRequest, engine: Engine | None
) -> str:
    names = [row.name for row in made.functions]
    counted = "1 function" if len(names) == 1 else f"{len(names)} functions"
    texts = "1 text" if files == 1 else f"{files} texts"
    where = texts if engine is None else f"files for {engine.title}"
    listed = ", ".join(names)
    return f"{made.material}: {counted} ({listed}) in {where} and {document} in {request.output}\n"


def _remarks(result: FunctionsResult, engine: Engine | None) -> Iterator[str]:
    """A line for each language of the texts that is marked as unproven, or for the engine."""
    names = [file.target for material in result for file in material.files]
    if engine is not None and engine.dialect is not None:
        names = []
    for target in map(registry.load, dict.fromkeys(names)):
        if target.unproven:
            yield f"texts in {target.title}: {target.unproven}\n"
    if engine is not None and engine.unproven:
        yield f"files for {engine.title}: {engine.unproven}\n"
