"""Compiles the files of ``burnish bind``, and writes their binding in each language.

What files become is compiled as ``burnish compile`` does it: in several processes if there are
many, and kept from one command to the next. A binding is made of the reflections alone.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from itertools import chain, groupby
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ..support.frozen import changed
from .compile_options import CompileRequest
from .compiled_record import Compiled
from .results import asked
from .source_folders import files_in

if TYPE_CHECKING:
    from ..bindings.model import Binding
    from ..compiler.diagnostics.diagnostic import Diagnostic
    from ..compiler.inputs import Inputs


class Bound(NamedTuple):
    """What the files of a command line have become."""

    files: tuple[Path, ...]
    """The files that declare something to compile; no folders."""
    found: tuple[Compiled, ...]
    """What each has become, with all of its rigs."""

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """Errors and warnings."""
        return tuple(one for each in self.found for one in each.diagnostics)

    @property
    def inputs(self) -> Inputs | None:
        """All that was read; ``None`` if there are errors."""
        inputs = [each.inputs for each in self.found if each.inputs is not None]
        if not inputs or len(inputs) < len(self.found):
            return None
        first, *others = inputs
        return first.joined(others)


def bound(given: Sequence[Path], request: CompileRequest, *, use_cache: bool) -> Bound:
    """Compile files, and all in folders that declare something, with each of their rigs."""
    from .compilation import with_progress
    from .many_files import compiled_each

    requests = [each for path in dict.fromkeys(given) for each in _requests(path, request)]
    question = asked(("bind",)) if use_cache else None
    found = compiled_each(requests, question)
    if len(requests) > 1:
        found = with_progress(found, len(requests))
    by_file = [
        (file, _joined([each for _, each in pairs]))
        for file, pairs in groupby(
            zip(requests, found, strict=True), lambda pair: pair[0].files[0]
        )
    ]  # fmt: skip
    return Bound(tuple(file for file, _ in by_file), tuple(each for _, each in by_file))


def _requests(path: Path, request: CompileRequest) -> Iterator[CompileRequest]:
    """A request for each file and rig; files in a folder need not declare anything."""
    is_folder = path.is_dir()
    for file in map(Path, files_in(path)) if is_folder else (path,):
        rigs = _rigs(file, request, is_asked_for=not is_folder)
        for rig in rigs:
            yield changed(request.of_one(file), rig=rig)


def _rigs(file: Path, request: CompileRequest, *, is_asked_for: bool) -> Sequence[str | None]:
    """The rigs with which a file is compiled; none if it is only for importing.

    To parse a file takes longer than to look for a word in it.
    """
    from ..api import entry_points as api
    from ..compiler.diagnostics.diagnostic import CompileError

    is_plain = request.rig is not None or not file.is_file() or b"rig" not in file.read_bytes()
    if is_asked_for and is_plain:
        return [request.rig]
    try:
        declared = api.declared(file, search_path=request.search_path)
    except CompileError:
        return [request.rig]  # Compiling tells what is wrong.
    if not is_asked_for and not (declared.frames or declared.materials or declared.kernels):
        return []
    return declared.rigs if request.rig is None and len(declared.rigs) > 1 else [request.rig]


def _joined(found: Sequence[Compiled]) -> Compiled:
    """What a file has become with all of its rigs."""
    if len(found) == 1:
        return found[0]
    inputs = [each.inputs for each in found if each.inputs is not None]
    return Compiled(
        _merged(each.texts for each in found), _merged(each.reflections for each in found),
        _merged(each.plans for each in found), {}, (), (),
        tuple(dict.fromkeys(one for each in found for one in each.diagnostics)),
        inputs[0].joined(inputs[1:]) if len(inputs) == len(found) else None,
    )  # fmt: skip


def _merged(parts: Iterable[Mapping[str, str]]) -> dict[str, str]:
    return dict(chain.from_iterable(part.items() for part in parts))


def binding_of(made: Bound, namespace: str, *, embed: bool) -> Binding:
    """The binding of all files, in no language yet.

    Raises ``CompileError`` if two materials would have files of one name.
    """
    from ..bindings import gathering
    from ..compiler.documents.plan import FramePlan
    from ..compiler.documents.reading import read
    from ..compiler.documents.reflection import Reflection
    from .written_files import written_of

    written_of(made.files, made.found)
    compiled: list[gathering.Compiled] = []
    plans = []
    for each in made.found:
        texts = each.texts if embed else {}
        numbers = {}
        for name, text in each.reflections.items():
            numbers[name] = len(compiled)
            reflection = read(Reflection, json.loads(text))
            compiled.append(gathering.Compiled(reflection=reflection, texts=texts))
        for text in each.plans.values():
            plan = read(FramePlan, json.loads(text))
            shaders = tuple(numbers[row.reflection] for row in plan.shaders)
            plans.append(gathering.CompiledPlan(plan=plan, shaders=shaders))
    sources = tuple(file.name for file in made.files)
    return gathering.gathered(compiled, plans, sources, namespace)


def stem_of(given: Path) -> str:
    """What the files of several languages are called: a word that can be imported."""
    return re.sub(r"\W", "_", given.resolve().stem) or "materials"
