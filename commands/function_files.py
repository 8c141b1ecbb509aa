"""Compiles one file of a command line to functions: ``compiled_files.py`` calls it for them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

from ..api import entry_points as api
from ..api.compiled_functions import CompiledFunctions, FunctionsResult
from ..compiler.diagnostics.diagnostic import CompileError
from ..compiler.documents.writing import to_text
from ..targets import registry
from ..targets.selection import DEFAULT
from .compile_options import CompileRequest, name_and_value
from .compiled_files import Compiled


def compiled_functions(request: CompileRequest) -> Compiled:
    """What the only file of a request becomes."""
    (file,) = request.files
    try:
        result = _result(request, file)
    except CompileError as error:
        return Compiled({}, {}, {}, (), (), error.diagnostics, None)
    texts = {each.name: each.text for material in result for each in material.files}
    documents, lines = {}, []
    for material in () if request.prints else result:
        name = f"{material.name}.functions.json"
        documents[name] = to_text(material.document)
        lines.append(_line(material, name, request.output))
    remarks = () if request.prints else tuple(_remarks(result))
    return Compiled(texts, documents, {}, tuple(lines), remarks, result.diagnostics, result.inputs)


def _result(request: CompileRequest, file: Path) -> FunctionsResult:
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


def _apart(given: Sequence[str]) -> list[str]:
    """Values of an option, each of which may be several with commas."""
    return [name.strip() for names in given for name in names.split(",") if name.strip()]


def _line(material: CompiledFunctions, document: str, folder: str) -> str:
    names = [row.name for row in material.document.functions]
    counted = "1 function" if len(names) == 1 else f"{len(names)} functions"
    texts = "1 text" if len(material.files) == 1 else f"{len(material.files)} texts"
    return (
        f"{material.name}: {counted} ({', '.join(names)}) in {texts} and {document} in {folder}\n"
    )


def _remarks(result: FunctionsResult) -> Iterator[str]:
    """A line for each language of the texts that is marked as unproven."""
    names = (file.target for material in result for file in material.files)
    for target in map(registry.load, dict.fromkeys(names)):
        if target.unproven:
            yield f"texts in {target.title}: {target.unproven}\n"
