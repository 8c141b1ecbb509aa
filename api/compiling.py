"""Compiles a file or a text: runs the compiler's phases in order, and makes the records of results.

``entry_points.py`` calls ``result_of`` with everything that its caller has asked for. The graphs of
an earlier result are made again by the same phases, from the inputs that were noted then.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from functools import partial
from itertools import chain, islice
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from ..compiler.cache import digest
from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import CompileError, Diagnostic, Report
from ..compiler.diagnostics.source import Span
from ..compiler.frontend import Frontend
from ..compiler.inputs import Inputs, Recorded
from ..compiler.ir.program import Program
from ..compiler.ir.shader import Shader
from ..compiler.ir.stages import COMPUTED, TARGET
from ..compiler.passes.lower_stages import keep_stages, lower_stages
from ..compiler.passes.pipeline import Options, Staged, stage
from ..compiler.semantics.names.modules import Module
from ..compiler.source_map import SourceMap
from ..support.arguments import expect, expect_all
from ..support.frozen import changed, frozen
from ..support.garbage import seldom_collected
from ..targets.availability import way_out, within
from ..targets.description.profile import LIMITED, Profile
from ..targets.description.shading_language import Language
from ..targets.emit.directives import Directed, directed
from ..targets.emit.emitter import EmitOptions, EmittedFile, emit
from ..targets.legalise.bindings import clashes
from ..targets.legalise.forms import form_for
from ..targets.legalise.guards import keeps
from ..targets.legalise.lacks import Lack, lacks
from ..targets.legalise.legal import Legal
from ..targets.legalise.legalise import legalise
from ..targets.legalise.limits import demands, excesses
from ..targets.selection import full_name, select_targets
from .compiled import CompiledFrame, CompiledMaterial, CompileResult, OutputFile
from .graphs import KeptGraphs, PlaceOfGraphs, ResultGraphs, ShaderGraphs, SpansOfText
from .shared_texts import shared_texts

if TYPE_CHECKING:
    from ..compiler.ir.frame import Frame, FrameShader


MOVED = "give the host's block another number, or have `--bindings` move the others (`first`)"
"""The advice about a binding number that is occupied."""


class Asked(NamedTuple):
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
    keep_graphs: bool
    values: tuple[tuple[str, str], ...]
    """Values and ranges of parameters, by name, to which the texts are limited."""
    specialise: bool = True
    """False if the texts serve all values, and only hosts are told of these."""
    bindings: Path | str | None = None
    """The file of a binding scheme, or a scheme as JSON; ``None`` for the usual one."""
    languages: tuple[tuple[Language, Profile], ...] = ()
    """The language of an engine, instead of ``targets``."""


@seldom_collected
def result_of(asked: Asked) -> CompileResult:
    """Compile a file, or a text. Raises ``CompileError``."""
    report, inputs = Report(), Inputs()
    found = _computed(asked, inputs, report)
    again = partial(_made_again, asked, inputs, _digest(found.graphs))
    kept = KeptGraphs(again, found.graphs, stay=asked.keep_graphs)
    materials = [
        _material(
            each, reasons, found.chosen, asked.emit, PlaceOfGraphs(kept, number), found.variant
        )
        for number, (each, reasons) in enumerate(
            zip(found.graphs.shaders, found.lacking, strict=True)
        )
    ]
    frames = _frames(found.graphs.frames, materials, found.variant, kept)
    return CompileResult(tuple(materials), report.diagnostics, inputs, tuple(frames))


@frozen
class _Computed:
    """Everything that a compile computes before it makes the records of a result."""

    graphs: ResultGraphs
    lacking: tuple[Mapping[str, Sequence[Diagnostic]], ...]
    """What each shader needs and profiles lack."""
    chosen: Sequence[tuple[Language, Profile]]
    variant: tuple[str, ...]
    """The names of the pass and the rig that tell files apart from those of others."""


def _computed(asked: Asked, inputs: Inputs, report: Report) -> _Computed:
    """Run all phases, from reading to printing. Raises ``CompileError``."""
    chosen = list(asked.languages) or select_targets(
        asked.targets, report, single_file=asked.emit.single_file
    )
    if asked.bindings is not None:
        chosen = _bound(chosen, asked.bindings, inputs, report)
    frontend = Frontend(report, asked.search_path, inputs)
    module = opened(asked.source, frontend)
    frames: list[Frame] | None = None
    variant: tuple[str, ...] = ()
    if module is None:
        shaders = []
    elif frontend.has_frames(module, asked.material):
        frames = frontend.frames(module, asked.material, asked.rig)
        shaders = [each.shader for frame in frames for each in frame.shaders]
    else:
        shaders = frontend.shaders(module, asked.material, asked.rig, asked.pass_)
    if asked.values and not report.failed:
        shaders, frames = _specialised(shaders, frames, asked, report)
    if report.failed:
        raise CompileError(report.diagnostics)
    if module is not None:
        variant = frontend.told_apart_by(module, asked.rig, asked.pass_ if frames is None else None)
    if asked.emit.line_directives:
        _warn_of_targets_without_lines(chosen, report)
    made, lacking = [], []
    for elaborated in shaders:
        shader = keep_stages(elaborated) if asked.native_stages else lower_stages(elaborated)
        staged = stage(shader, asked.options)
        lacking.append(lacking_features(shader, partial(_program_for, staged), chosen))
        if not asked.partial:
            report.extend(chain.from_iterable(lacking[-1].values()))
        printed = [each for each in chosen if full_name(*each) not in lacking[-1]]
        _warn_of_demands(shader, staged, printed, report)
        made.append(_printed(shader, staged, printed, asked.emit, to_textures=frames is not None))
    if frames:
        made = _of_frames(made, frames, asked.emit, report)
    if report.failed:
        raise CompileError(report.diagnostics)
    graphs = ResultGraphs(tuple(made), tuple(frames or ()))
    return _Computed(graphs, tuple(lacking), chosen, variant)


def _of_frames(
    made: list[ShaderGraphs], frames: Iterable[Frame], options: EmitOptions, report: Report
) -> list[ShaderGraphs]:
    """The shaders of frames, which share texts; reports what they filter and cannot."""
    programs = {each.shader.name: each.staged.program for each in made}
    check_filtering(frames, lambda shader: programs[shader.name], report)
    # With directives, a text says which material each line is of.
    return made if options.line_directives else shared_texts(made)


def _bound(
    chosen: Sequence[tuple[Language, Profile]],
    bindings: Path | str,
    inputs: Inputs,
    report: Report,
) -> list[tuple[Language, Profile]]:
    """The profiles with a scheme of the user's, whose mistakes are reported."""
    from json import loads

    from ..targets.binding_schemes import IN_MEMORY, scheme_in, scheme_of, with_scheme

    if isinstance(bindings, str):
        scheme = scheme_of(loads(bindings), IN_MEMORY, report)
    else:
        scheme = scheme_in(bindings, inputs, report)
    return (
        list(chosen)
        if scheme is None
        else [(language, with_scheme(profile, scheme)) for language, profile in chosen]
    )


def _specialised(
    shaders: Sequence[Shader], frames: list[Frame] | None, asked: Asked, report: Report
) -> tuple[list[Shader], list[Frame] | None]:
    """Shaders and frames whose texts serve no other values than asked for."""
    from .specialising import specialised, specialised_frames

    if frames is None:
        return specialised(shaders, asked.values, report, told=not asked.specialise), None
    frames = specialised_frames(frames, asked.values, report)
    return [each.shader for frame in frames for each in frame.shaders], frames


@seldom_collected
def _made_again(asked: Asked, inputs: Inputs, texts: str) -> ResultGraphs:
    """The graphs of a result whose inputs were noted, and whose texts have this digest.

    Raises ``RuntimeError`` if this Burnish makes other texts of them.
    """
    try:
        found = _computed(asked, Recorded(inputs), Report())
    except CompileError:
        found = None
    if found is None or _digest(found.graphs) != texts:
        raise RuntimeError(
            "the graphs of this result cannot be made again, because another Burnish has compiled "
            "it, or with another library: compile its source again"
        )
    return found.graphs


def _digest(graphs: ResultGraphs) -> str:
    """A digest of all texts."""
    texts = (file.text for each in graphs.shaders for _legal, file in each.files())
    return digest("\0".join(texts).encode())


def opened(source: str | Path, frontend: Frontend) -> Module | None:
    """The module of a text or of a file; ``None`` if it cannot be read, which is reported."""
    if isinstance(source, str):
        return frontend.open_text(source, "<text>")
    return frontend.open_file(source)


def sources(
    source: str | Path, search_path: Sequence[str | Path]
) -> tuple[str | Path, tuple[Path, ...]]:
    """The text itself or the path of a file, and the folders in which imports are looked for."""
    expect("source", source, (str, PathLike), "a path or a text")
    folders = expect_all("search_path", search_path, (str, PathLike), "a sequence of folders")
    is_text = isinstance(source, str) and ("\n" in source or "{" in source)
    return source if is_text else Path(source), tuple(map(Path, folders))


def program_of(shader: FrameShader) -> Program:
    """The program of a frame's shader, before it is made legal for any profile."""
    return stage(lower_stages(shader.shader), Options()).program


def check_filtering(
    frames: Iterable[Frame], program_of: Callable[[FrameShader], Program], report: Report
) -> None:
    """Report results that are filtered and have a format that many devices cannot filter."""
    from ..compiler.reflection.filtering import filtered_in

    for found in chain.from_iterable(filtered_in(frame, program_of) for frame in frames):
        report.add(
            rules.NOT_FILTERED, found.span, name=found.name, step=found.step, format=found.format
        )


def _frames(
    frames: Iterable[Frame],
    compiled: Iterable[CompiledMaterial],
    variant: Iterable[str],
    kept: KeptGraphs,
) -> Iterator[CompiledFrame]:
    """The records of frames, with their shaders, which were compiled in the same order."""
    shaders = iter(compiled)
    for number, frame in enumerate(frames):
        own = tuple(islice(shaders, len(frame.shaders)))
        yield CompiledFrame(frame.name, ".".join((frame.name, *variant)), own, kept, number)


def _printed(
    shader: Shader,
    staged: Staged,
    chosen: Iterable[tuple[Language, Profile]],
    options: EmitOptions,
    *,
    to_textures: bool = False,
) -> ShaderGraphs:
    """The texts of a shader for some profiles, with what they were printed from.

    ``to_textures`` is True if the shader draws textures that others read, so that the first row of
    the picture lies first in memory.
    """
    # The images of a kernel have their first row at the top, also if a pass draws them.
    turned = options.flip_y and shader.chain != COMPUTED
    emissions = []
    flipped = set()
    for target, profile in chosen:
        flip_y = profile.framebuffer.rows_up if to_textures else turned
        form = form_for(staged, profile)
        legal = legalise(form.program, target, profile, form.undecided)
        emissions.append((legal, emit(legal, changed(options, flip_y=flip_y))))
        if flip_y:
            flipped.add(full_name(target, profile))
    return ShaderGraphs(shader, staged, tuple(emissions), frozenset(flipped))


def _material(
    graphs: ShaderGraphs,
    lacking: Mapping[str, Sequence[Diagnostic]],
    chosen: Iterable[tuple[Language, Profile]],
    options: EmitOptions,
    place: PlaceOfGraphs,
    variant: Iterable[str] = (),
) -> CompiledMaterial:
    """The record of a shader, from whose graphs it has the texts."""
    name = graphs.shader.name
    parts = tuple(variant) if graphs.shader.pass_name else ()
    files = tuple(
        _output(graphs, legal, file, ".".join((file.owner or name, *parts)), options, place)
        for legal, file in graphs.files()
    )
    profiles = [profile for _target, profile in chosen]
    guards = (g for g in graphs.staged.guards if any(keeps(profile, g) for profile in profiles))
    reasons = {name: "; ".join(each.message for each in told) for name, told in lacking.items()}
    stem = ".".join((name, *parts))
    return CompiledMaterial(name, stem, files, reasons, tuple(guards), place)


def _program_for(staged: Staged, profile: Profile) -> Program:
    return form_for(staged, profile).program


def lacking_features(
    shader: Shader,
    program_for: Callable[[Profile], Program],
    chosen: Iterable[tuple[Language, Profile]],
) -> dict[str, tuple[Diagnostic, ...]]:
    """For each profile, the features that it lacks and a shader needs."""
    found = {}
    made_of = shader.expansion or shader.tessellation
    expanded = None if made_of is None else made_of.span
    places = {
        **{extern.place.name: extern.span for extern in shader.externs},
        **{
            info.leaf.name: info.span
            for info in (*shader.textures, *shader.buffers, *shader.written)
        },
    }
    for target, profile in chosen:
        name, report = full_name(target, profile), Report()
        program = program_for(profile)
        for excess in excesses(program, profile):
            report.add(
                rules.TOO_MANY, expanded if excess.of_expansion else places.get(excess.declared),
                count=excess.count,
                what=f"{excess.what} of {shader.name}", target=name, limit=excess.limit,
                hint=excess.instead or within(excess.limit_name, excess.count, profile),
            )  # fmt: skip
        for clash in clashes(program, profile):
            report.add(
                rules.OCCUPIED, places.get(clash.name) or places.get(clash.other),
                name=clash.name, other=clash.other, group=clash.slot.set,
                binding=clash.slot.binding, target=name, hint=MOVED,
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


def _warn_of_demands(
    shader: Shader, staged: Staged, printed: Iterable[tuple[Language, Profile]], report: Report
) -> None:
    """Report what a host has to ask devices for."""
    for target, profile in printed:
        for demand in demands(form_for(staged, profile).program, profile):
            report.add(
                rules.ASKED_OF_DEVICES, None, count=demand.count,
                what=f"{demand.what} of {shader.name}", target=full_name(target, profile),
                limit=demand.limit, hint=LIMITED[demand.limit_name].instead,
            )  # fmt: skip


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
    graphs: ShaderGraphs,
    legal: Legal,
    file: EmittedFile,
    stem: str,
    options: EmitOptions,
    place: PlaceOfGraphs,
) -> OutputFile:
    """The record of a text. Its source map is found when asked for, unless the text shows it."""
    target, profile = legal.language, legal.profile
    default = profile.name == target.profiles[0].name
    parts = (stem, file.suffix) if default else (stem, profile.name, file.suffix)
    if options.line_directives and target.line_directive:
        spans = graphs.spans(full_name(target, profile), file.stage)
        shown = directed(file.text, spans, target.line_directive, ".".join(parts))
    else:
        find = SpansOfText(place, full_name(target, profile), file.stage)
        shown = Directed(file.text, SourceMap(find), ())
    return OutputFile(
        name=".".join(parts),
        target=target.name,
        profile=profile.name,
        stage=file.stage,
        entry_points=file.entries,
        text=shown.text,
        checkers=file.checkers,
        spans=shown.spans,
        sources=shown.sources,
    )
