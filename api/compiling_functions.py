"""Compiles the slots of materials to functions that an engine calls.

``entry_points.py`` calls ``functions_of`` with everything that its caller has asked for, as it
calls ``compiling.result_of`` for whole shaders.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from itertools import chain
from pathlib import Path
from typing import NamedTuple

from ..compiler.diagnostics.diagnostic import CompileError, Report
from ..compiler.frontend import Frontend
from ..compiler.inputs import Inputs
from ..compiler.ir.functions import FunctionsAsked, FunctionsShader, Offer
from ..compiler.passes.pipeline import Options
from ..compiler.passes.stage_functions import StagedFunctions, stage_functions
from ..compiler.reflection.functions import functions_document
from ..compiler.reflection.roles import scene_names
from ..support.frozen import changed
from ..support.garbage import seldom_collected
from ..targets.description.profile import Profile
from ..targets.description.shading_language import Language
from ..targets.emit.function_rows import function_backend_row
from ..targets.emit.functions import FunctionEmission, emit_functions
from ..targets.legalise.legalise import legalise
from ..targets.selection import full_name, select_targets
from .compiled_functions import CompiledFunctions, FunctionFile, FunctionsResult
from .compiling import lacking_features, opened


class AskedFunctions(NamedTuple):
    """Everything that ``functions`` is given."""

    targets: tuple[str, ...]
    source: str | Path
    """A text, or a path."""
    search_path: tuple[Path, ...]
    material: str | None
    rig: str | None
    slots: tuple[str, ...]
    together: bool
    prefix: str | None
    values: tuple[tuple[str, str], ...]
    offers: tuple[Offer, ...] = ()
    """Slots to return as far as a material has them, instead of ``slots``."""
    left: tuple[Offer, ...] = ()
    """Slots to leave out of the own ones where they are as declared: the engine has these."""
    languages: tuple[tuple[Language, Profile], ...] = ()
    """Languages of engines, instead of ``targets``."""


@seldom_collected
def functions_of(asked: AskedFunctions) -> FunctionsResult:
    """Compile the materials of a file, or of a text, to functions. Raises ``CompileError``."""
    report, inputs = Report(), Inputs()
    chosen = list(asked.languages) or select_targets(asked.targets, report, single_file=False)
    frontend = Frontend(report, asked.search_path, inputs)
    module = opened(asked.source, frontend)
    wanted = _wanted(asked)
    made = [] if module is None else frontend.functions(module, asked.material, asked.rig, wanted)
    if asked.values and not report.failed:
        made = _specialised(made, asked, report)
    if report.failed:
        raise CompileError(report.diagnostics)
    found = tuple(_compiled(each, chosen, asked.prefix, report) for each in made)
    if report.failed:
        raise CompileError(report.diagnostics)
    return FunctionsResult(found, report.diagnostics, inputs)


def _wanted(asked: AskedFunctions) -> FunctionsAsked:
    """What the frontend has to know, with the library's words for what engines have."""
    names = scene_names()
    return FunctionsAsked(
        asked.slots, asked.offers, asked.left, asked.together, asked.rig is not None,
        frozenset(names["at_vertices"]), names["slots"], names["surface"], names["moving"],
    )  # fmt: skip


def _specialised(
    made: Sequence[FunctionsShader], asked: AskedFunctions, report: Report
) -> list[FunctionsShader]:
    """Functions that serve no other values of parameters than asked for."""
    from .specialising import specialised

    shaders = specialised([each.shader for each in made], asked.values, report)
    return [changed(each, shader=new) for each, new in zip(made, shaders, strict=True)]


def _compiled(
    made: FunctionsShader,
    chosen: Sequence[tuple[Language, Profile]],
    prefix: str | None,
    report: Report,
) -> CompiledFunctions:
    """The functions of one material in all languages; what languages lack is reported."""
    staged = stage_functions(made, Options(hoist=False))
    lacking = lacking_features(made.shader, lambda _profile: staged.program, chosen)
    report.extend(chain.from_iterable(lacking.values()))
    emissions = [
        (language, profile, _emitted(staged, language, profile, prefix or made.shader.name))
        for language, profile in chosen
        if full_name(language, profile) not in lacking
    ]
    files = tuple(
        FunctionFile(_file_name(made.shader.name, *each[:2]), each[0].name, each[1].name, each[2])
        for each in emissions
    )
    backends = {
        full_name(language, profile): function_backend_row(language, emission, file.name)
        for (language, profile, emission), file in zip(emissions, files, strict=True)
    }
    document = partial(functions_document, staged.program, staged.slots, made.own_pass, backends)
    return CompiledFunctions(made.shader.name, files, document)


def _emitted(
    staged: StagedFunctions, language: Language, profile: Profile, prefix: str
) -> FunctionEmission:
    legal = legalise(staged.program, language, profile, staged.undecided)
    return emit_functions(legal, {slot.name: slot.doc for slot in staged.slots}, prefix)


def _file_name(material: str, language: Language, profile: Profile) -> str:
    """``Plastic.functions.wgsl``; with the profile's name where it is not the default one."""
    own = () if profile is language.profiles[0] else (profile.name,)
    return ".".join((material, *own, "functions", language.extension))
