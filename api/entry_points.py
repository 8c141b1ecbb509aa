"""The library's entry points: from a material to shader texts and their reflection.

Users call ``compile`` and ``check`` as ``burnish.compile`` and ``burnish.check``. The commands call
them too, and ``variants`` besides. This module runs the compiler's phases in order.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import cache
from importlib import import_module
from itertools import chain, islice
from os import PathLike
from pathlib import Path
from types import NoneType
from typing import TYPE_CHECKING, Any, NamedTuple

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import CompileError, Diagnostic, Report
from ..compiler.diagnostics.source import Span
from ..compiler.documents.writing import to_json
from ..compiler.frontend import Frontend, current_library
from ..compiler.ir.frame import Frame, FrameShader
from ..compiler.ir.program import Program
from ..compiler.ir.shader import Shader
from ..compiler.ir.stages import COMPUTED, TARGET
from ..compiler.passes.lower_stages import keep_stages, lower_stages
from ..compiler.passes.pipeline import Options, Staged, stage
from ..compiler.semantics.names.modules import Module
from ..compiler.source_map import located
from ..support.arguments import expect, expect_all
from ..support.frozen import changed
from ..support.garbage import seldom_collected
from ..targets.availability import way_out, with_as_many
from ..targets.description.profile import Profile
from ..targets.description.shading_language import Language
from ..targets.emit.directives import Directed, directed
from ..targets.emit.emitter import EmitOptions, EmittedFile, emit
from ..targets.legalise.forms import form_for
from ..targets.legalise.guards import keeps
from ..targets.legalise.lacks import Lack, lacks
from ..targets.legalise.legal import Legal
from ..targets.legalise.legalise import legalise
from ..targets.legalise.limits import excesses
from ..targets.selection import DEFAULT, full_name, select_targets
from .compiled import CompiledFrame, CompiledMaterial, CompileResult, OutputFile
from .remembered import Remembered

if TYPE_CHECKING:
    from ..targets.runner.instances.host_values import MissingValuesError
    from ..targets.runner.instances.instance import Instance
    from ..targets.runner.instances.values import ParameterError
    from ..targets.runner.textures.kinds import PictureError
    from ..targets.runner.textures.texture import Texture

__all__ = [
    "CompileResult",
    "CompiledFrame",
    "CompiledMaterial",
    "Instance",
    "MissingValuesError",
    "OutputFile",
    "ParameterError",
    "PictureError",
    "Texture",
    "check",
    "compile",
    "to_json",
]


def compile(
    source: str | Path,
    targets: str | Iterable[str] = DEFAULT,
    *,
    material: str | None = None,
    rig: str | None = None,
    pass_: str | None = None,
    search_path: Sequence[str | Path] = (),
    hoist: bool = True,
    flip_y: bool = False,
    single_file: bool = False,
    line_directives: bool = False,
    partial: bool = False,
    native_stages: bool = False,
) -> CompileResult:
    """Compile a file, or a text, for some targets.

    ``source`` is a path, or the text itself (a ``str`` that contains a line break or a brace).
    ``targets`` are names such as ``"wgsl"``, or with a profile ``"glsl:es300"``; ``"all"`` means
    every profile that need not be named, and ``"default"`` the first profile of every language that
    is not marked as unproven. All materials that are not abstract are compiled, unless ``material``
    names one; then only what it uses is checked, but all of the file is read, with its syntax.
    ``rig`` and ``pass_`` are only needed if a file has several. With ``hoist=False`` the shaders
    compute everything themselves. With ``line_directives``, texts have ``#line`` directives that
    name the material's lines, if the language has them. If a profile lacks something that a
    material needs, this is an error; with ``partial``, that material has no text for this profile,
    and its ``lacking`` says why. With ``native_stages``, a material that expands primitives or
    divides patches has the stages for it that a target provides; otherwise each primitive or patch
    is drawn as an instance.

    Raises ``CompileError``, whose ``diagnostics`` are all errors, and ``TypeError`` for arguments
    of other types.
    """
    _check_names(material=material, rig=rig, pass_=pass_)
    _check_flags(
        hoist=hoist, flip_y=flip_y, single_file=single_file,
        line_directives=line_directives, partial=partial, native_stages=native_stages,
    )  # fmt: skip
    asked = _Asked(
        tuple(_names_of_targets(targets)), *_sources(source, search_path), material, rig, pass_,
        Options(hoist), EmitOptions(flip_y, single_file, line_directives), partial, native_stages,
    )  # fmt: skip
    library = current_library()
    result = _REMEMBERED.find(asked, library)
    if result is None:
        result = _result(asked)
        _REMEMBERED.keep(asked, library, result)
    return result


class _Asked(NamedTuple):
    """Everything that ``compile`` is given."""

    targets: tuple[str, ...]
    source: str | Path
    """A text, or a path."""
    search_path: tuple[Path, ...]
    material: str | None
    rig: str | None
    pass_: str | None
    options: Options
    emit: EmitOptions
    partial: bool
    native_stages: bool


_REMEMBERED = Remembered()
"""The results of the last calls of ``compile``."""


@seldom_collected
def _result(asked: _Asked) -> CompileResult:
    """Compile a file, or a text. Raises ``CompileError``."""
    report = Report()
    chosen = select_targets(asked.targets, report, single_file=asked.emit.single_file)
    frontend, module = _opened(asked.source, asked.search_path, report)
    frames: list[Frame] | None = None
    if module is None:
        shaders = []
    elif frontend.has_frames(module, asked.material):
        frames = frontend.frames(module, asked.material, asked.rig)
        shaders = [each.shader for frame in frames for each in frame.shaders]
    else:
        shaders = frontend.shaders(module, asked.material, asked.rig, asked.pass_)
    if report.failed:
        raise CompileError(report.diagnostics)
    if asked.emit.line_directives:
        _warn_of_targets_without_lines(chosen, report)
    compiled = []
    for elaborated in shaders:
        shader = keep_stages(elaborated) if asked.native_stages else lower_stages(elaborated)
        staged = stage(shader, asked.options)
        lacking = _lacking(shader, staged, chosen)
        if not asked.partial:
            report.extend(chain.from_iterable(lacking.values()))
        to_textures = frames is not None
        compiled.append(_compiled(shader, staged, lacking, chosen, asked.emit, to_textures))
    if frames:
        programs = {each.name: each.staged.program for each in compiled}
        _check_filtering(frames, lambda shader: programs[shader.name], report)
    if report.failed:
        raise CompileError(report.diagnostics)
    made = _compiled_frames(frames or (), compiled)
    return CompileResult(tuple(compiled), report.diagnostics, frontend.inputs, made)


@seldom_collected
def check(
    source: str | Path,
    *,
    rig: str | None = None,
    pass_: str | None = None,
    search_path: Sequence[str | Path] = (),
) -> tuple[Diagnostic, ...]:
    """All diagnostics of a file or text, but for those about a target; nothing is emitted.

    Raises ``TypeError`` for arguments of other types, and nothing else.
    """
    report = Report()
    _check_names(rig=rig, pass_=pass_)
    frontend, module = _opened(source, search_path, report)
    if module is not None:
        frames = frontend.check(module, rig, pass_)
        if not report.failed:
            _check_filtering(frames, cache(_program_of), report)
    return report.diagnostics


def has_frames(
    source: str | Path, *, material: str | None = None, search_path: Sequence[str | Path] = ()
) -> bool:
    """True if ``compile`` makes frames of a file; ``material`` is the only name asked for.

    Raises ``CompileError`` if the file cannot be read.
    """
    report = Report()
    frontend, module = _opened(source, search_path, report)
    if module is None or report.failed:
        raise CompileError(report.diagnostics)
    return frontend.has_frames(module, material)


class Declared(NamedTuple):
    """The names of declarations that ``compile`` accepts, in the order of the file."""

    frames: tuple[str, ...]
    materials: tuple[str, ...]
    kernels: tuple[str, ...]
    rigs: tuple[str, ...]
    passes: tuple[str, ...]


def declared(source: str | Path, *, search_path: Sequence[str | Path] = ()) -> Declared:
    """The declarations of a file. Raises ``CompileError`` if the file cannot be read."""
    report = Report()
    frontend, module = _opened(source, search_path, report)
    if module is None or report.failed:
        raise CompileError(report.diagnostics)
    kinds = ("frame", "material", "kernel", "rig", "pass")
    return Declared(*(frontend.declared(module, kind) for kind in kinds))


def variants(
    source: str | Path, *, search_path: Sequence[str | Path] = ()
) -> tuple[tuple[str | None, str | None], ...]:
    """Pairs of a rig's and a pass's name for ``compile``: all with which a file can be drawn.

    They are the file's own, or ``None`` for the library's. Raises ``CompileError`` if the file
    cannot be read.
    """
    report = Report()
    frontend, module = _opened(source, search_path, report)
    if module is None or report.failed:
        raise CompileError(report.diagnostics)
    return tuple(frontend.variants(module))


def _names_of_targets(targets: str | Iterable[str]) -> list[str]:
    if isinstance(targets, str):
        return targets.split(",")
    return expect_all("targets", targets, str, "names of targets")


def _check_names(**names: str | None) -> None:
    for argument, name in names.items():
        expect(argument, name, (str, NoneType), "a name")


def _check_flags(**flags: bool) -> None:
    for argument, flag in flags.items():
        expect(argument, flag, bool, "True or False")


def _opened(
    source: str | Path, search_path: Sequence[str | Path], report: Report
) -> tuple[Frontend, Module | None]:
    """The module of a path or a text, and its front end; ``None`` if it cannot be read."""
    given, folders = _sources(source, search_path)
    frontend = Frontend(report, folders)
    if isinstance(given, str):
        return frontend, frontend.open_text(given, "<text>")
    return frontend, frontend.open_file(given)


def _sources(
    source: str | Path, search_path: Sequence[str | Path]
) -> tuple[str | Path, tuple[Path, ...]]:
    """The text itself or the path of a file, and the folders in which imports are looked for."""
    expect("source", source, (str, PathLike), "a path or a text")
    folders = expect_all("search_path", search_path, (str, PathLike), "a sequence of folders")
    is_text = isinstance(source, str) and ("\n" in source or "{" in source)
    return source if is_text else Path(source), tuple(map(Path, folders))


def _program_of(shader: FrameShader) -> Program:
    """The program of a frame's shader, before it is made legal for any profile."""
    return stage(lower_stages(shader.shader), Options()).program


def _check_filtering(
    frames: Iterable[Frame], program_of: Callable[[FrameShader], Program], report: Report
) -> None:
    """Report results that are filtered and have a format that many devices cannot filter."""
    from ..compiler.reflection.filtering import filtered_in

    for found in chain.from_iterable(filtered_in(frame, program_of) for frame in frames):
        report.add(
            rules.NOT_FILTERED, found.span, name=found.name, step=found.step, format=found.format
        )


def _compiled_frames(
    frames: Iterable[Frame], compiled: Iterable[CompiledMaterial]
) -> tuple[CompiledFrame, ...]:
    """The frames with their shaders, which were compiled in the same order."""
    shaders = iter(compiled)
    return tuple(
        CompiledFrame(frame.name, tuple(islice(shaders, len(frame.shaders))), frame)
        for frame in frames
    )


def _compiled(
    shader: Shader,
    staged: Staged,
    lacking: Mapping[str, Sequence[Diagnostic]],
    chosen: list[tuple[Language, Profile]],
    emit_options: EmitOptions,
    to_textures: bool = False,
) -> CompiledMaterial:
    """Compile one shader for the chosen profiles.

    ``to_textures`` is True if the shader draws textures that others read, so that the first row of
    the picture lies first in memory.
    """

    def options(profile: Profile) -> EmitOptions:
        # The images of a kernel have their first row at the top, also if a pass draws them.
        turned = emit_options.flip_y and shader.chain != COMPUTED
        flip_y = profile.framebuffer.rows_up if to_textures else turned
        return changed(emit_options, flip_y=flip_y)

    forms = (
        (form_for(staged, profile), target, profile)
        for target, profile in chosen
        if full_name(target, profile) not in lacking
    )
    legals = (
        legalise(form.program, target, profile, form.undecided) for form, target, profile in forms
    )
    emissions = tuple((legal, emit(legal, options(legal.profile))) for legal in legals)
    files = tuple(
        _output(shader, legal, file, emit_options)
        for legal, emission in emissions
        for file in emission.files
    )
    profiles = [profile for _target, profile in chosen]
    guards = tuple(g for g in staged.guards if any(keeps(profile, g) for profile in profiles))
    reasons = {name: "; ".join(each.message for each in found) for name, found in lacking.items()}
    flipped = frozenset(
        full_name(legal.language, legal.profile)
        for legal, _emission in emissions
        if options(legal.profile).flip_y
    )
    return CompiledMaterial(shader.name, files, reasons, guards, shader, staged, emissions, flipped)


def _lacking(
    shader: Shader, staged: Staged, chosen: list[tuple[Language, Profile]]
) -> dict[str, tuple[Diagnostic, ...]]:
    """For each profile, the features that it lacks and a shader needs."""
    found = {}
    made_of = shader.expansion or shader.tessellation
    expanded = None if made_of is None else made_of.span
    places = {extern.place.name: extern.span for extern in shader.externs}
    for target, profile in chosen:
        name, report = full_name(target, profile), Report()
        program = form_for(staged, profile).program
        for excess in excesses(program, profile):
            report.add(
                rules.TOO_MANY, expanded if excess.of_expansion else places.get(excess.block),
                count=excess.count,
                what=f"{excess.what} of {shader.name}", target=name, limit=excess.limit,
                hint=excess.instead or with_as_many(excess.limit_name, excess.count),
            )  # fmt: skip
        for lack in lacks(program, profile):
            report.add(
                rules.UNSUPPORTED,
                expanded if lack.of_expansion else _place_of(shader, lack),
                target=name, feature=lack.feature,
                hint=lack.instead or way_out(lack.feature, profile, lack.needed_for),
            )  # fmt: skip
        if report.diagnostics:
            found[name] = report.diagnostics
    return found


def _place_of(shader: Shader, lack: Lack) -> Span | None:
    """The place in the source that needs a feature which a profile lacks."""
    targets = shader.results_of(TARGET)
    if lack.target is not None and targets:
        return targets[lack.target].span
    return shader.notes.spans.get(lack.node)


def _warn_of_targets_without_lines(chosen: list[tuple[Language, Profile]], report: Report) -> None:
    for name in dict.fromkeys(target.name for target, _ in chosen if not target.line_directive):
        report.add(rules.NO_LINE_DIRECTIVES, None, target=name)


def _output(
    shader: Shader,
    legal: Legal,
    file: EmittedFile,
    options: EmitOptions,
) -> OutputFile:
    target, profile = legal.language, legal.profile
    default = profile is target.profiles[0]
    parts = (shader.name, file.suffix) if default else (shader.name, profile.name, file.suffix)
    name, spans = ".".join(parts), located(shader, file.origins, legal.program.shader.notes)
    shown = Directed(file.text, spans, ())
    if options.line_directives and target.line_directive:
        shown = directed(file.text, spans, target.line_directive, name)
    return OutputFile(
        name=name,
        target=target.name,
        profile=profile.name,
        stage=file.stage,
        entry_points=file.entries,
        text=shown.text,
        checkers=profile.checkers,
        spans=shown.spans,
        sources=shown.sources,
    )


_RUNTIME = {
    "Instance": "instances.instance",
    "MissingValuesError": "instances.host_values",
    "ParameterError": "instances.values",
    "PictureError": "textures.kinds",
    "Texture": "textures.texture",
}
"""The modules of the runtime's names, which programs that only compile never load."""


def __getattr__(name: str) -> Any:
    """Load the runtime on first use."""
    if name in _RUNTIME:
        return getattr(import_module(f"..targets.runner.{_RUNTIME[name]}", __package__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
