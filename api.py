"""The library's entry points: from a material to shader texts and their reflection.

Users call ``compile``, ``check`` and ``variants`` as ``burnish.compile`` and so on, and the
commands call them too. This module runs the compiler's phases in order.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from importlib import import_module
from itertools import chain
from os import PathLike
from pathlib import Path
from types import NoneType
from typing import TYPE_CHECKING, Any

from .arguments import expect, expect_all
from .compiler.diagnostics import rules
from .compiler.diagnostics.diagnostic import CompileError, Diagnostic, Report
from .compiler.diagnostics.nearest import suggestion
from .compiler.diagnostics.source import Source, Span
from .compiler.frontend import Frontend
from .compiler.inputs import Inputs
from .compiler.ir.shader import Shader
from .compiler.passes.guard import Guard
from .compiler.passes.pipeline import Options, Staged, stage
from .compiler.semantics.names.modules import Module
from .compiler.source_map import located
from .frozen import frozen
from .garbage import seldom_collected
from .targets import registry
from .targets.description.profile import Profile
from .targets.description.shading_language import Language
from .targets.emit.directives import Directed, directed
from .targets.emit.emitter import Emission, EmitOptions, EmittedFile, emit
from .targets.emit.reflection import backend_table
from .targets.legalise.guards import keeps
from .targets.legalise.legalise import legalise
from .targets.legalise.limits import excesses, lacks

if TYPE_CHECKING:
    from .compiler.passes.proofs import Proof
    from .targets.runner.instances.instance import Instance, MissingValuesError
    from .targets.runner.instances.values import ParameterError
    from .targets.runner.textures.kinds import PictureError
    from .targets.runner.textures.texture import Texture

__all__ = [
    "CompileResult",
    "CompiledMaterial",
    "Instance",
    "MissingValuesError",
    "OutputFile",
    "ParameterError",
    "PictureError",
    "Texture",
    "check",
    "compile",
    "select_targets",
]

DEFAULT = "default"
"""Means the first profile of every target that is not marked as unproven."""

ALL = "all"
"""Means every profile of every target."""

StageName = str
"""A stage, such as ``vertex`` or ``fragment``; ``both`` for a text that contains all stages."""


@dataclass(frozen=True, slots=True)
class OutputFile:
    """One emitted shader text."""

    name: str
    """The name of the file: ``Plastic.frag.wgsl``; if the profile is not the target's default,
    ``Plastic.gl330.frag.glsl``."""
    target: str
    profile: str
    stage: StageName
    entry_points: Mapping[StageName, str]
    """The entry point of each stage in the text."""
    text: str
    checkers: tuple[str, ...] = ()
    """The downstream compilers that must accept it."""
    spans: Mapping[int, Span] = field(default_factory=dict)
    """The source map: for each line of ``text``, counted from 1, the part of the material that its
    statement belongs to. Every statement has one."""
    sources: tuple[Source, ...] = ()
    """The files that line directives in ``text`` name; their numbers count from 1."""


@dataclass(frozen=True)
class CompiledMaterial:
    """The results of compiling one material."""

    name: str
    files: tuple[OutputFile, ...]
    lacking: Mapping[str, str]
    """For each profile without texts, the feature that it lacks and the material needs."""
    guards: tuple[Guard, ...]
    """Operations that keep a guard in some text, because their operands could not be proven
    safe."""
    shader: Shader = field(repr=False)
    """The shader before any pass, which the reference draws."""
    _staged: Staged = field(repr=False)
    _emissions: tuple[tuple[Language, Profile, Emission], ...] = field(repr=False)
    _flip_y: bool = field(repr=False)

    def text(self, target: str, stage: StageName) -> str:
        """The text of one stage for one target (``"glsl"`` or ``"glsl:gl330"``).

        Raises ``KeyError`` if the material was not compiled for it.
        """
        for file in self.files:
            if file.stage == stage and target in (file.target, f"{file.target}:{file.profile}"):
                return file.text
        raise KeyError(f"{self.name} has no {stage} text for {target}")

    @cached_property
    def reflection(self) -> dict[str, Any]:
        """What a host needs to bind, as data for JSON (``compiler/reflection`` has the schema)."""
        from .compiler.reflection import reflect

        tables = {
            _name(target, profile): backend_table(
                self._staged.program, target, profile, emission, self._files(target, profile),
                flip_y=self._flip_y, source_maps=self._source_maps(target, profile),
            )
            for target, profile, emission in self._emissions
        }  # fmt: skip
        derived = {value.parameter: value.expression for value in self._staged.derived}
        return reflect(self.shader, self._staged.program, tables, derived)

    @property
    def staged(self) -> Staged:
        """The program that is written in each language, with the passes' decision records."""
        return self._staged

    @cached_property
    def proofs(self) -> tuple[Proof, ...]:
        """Why operations have no guard, were removed, or keep their guard."""
        from .compiler.passes.proofs import Proofs

        evidence = self._staged.evidence
        return tuple(Proofs(evidence.ranges, evidence.notes).explain(evidence.remarks))

    def instance(self) -> Instance:
        """An instance with named values to draw the material with; they start as its defaults."""
        from .targets.runner.instances.instance import Instance

        return Instance(self.reflection)

    def _source_maps(self, target: Language, profile: Profile) -> dict[str, Mapping[int, Span]]:
        return {
            file.name: file.spans
            for file in self.files
            if (file.target, file.profile) == (target.name, profile.name)
        }

    def _files(self, target: Language, profile: Profile) -> dict[str, str]:
        return {
            file.stage: file.name
            for file in self.files
            if (file.target, file.profile) == (target.name, profile.name)
        }


@frozen
class CompileResult:
    """All materials of a file, with the diagnostics (only warnings, since it compiled)."""

    materials: tuple[CompiledMaterial, ...]
    diagnostics: tuple[Diagnostic, ...]
    inputs: Inputs
    """The files that were read, and the places where files were searched."""

    def __iter__(self) -> Iterator[CompiledMaterial]:
        """The materials in the order of the file."""
        return iter(self.materials)

    def __len__(self) -> int:
        """The number of materials."""
        return len(self.materials)

    def __getitem__(self, name: str) -> CompiledMaterial:
        """The material called ``name``; ``KeyError`` if there is none."""
        for material in self.materials:
            if material.name == name:
                return material
        raise KeyError(name)


@seldom_collected
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
) -> CompileResult:
    """Compile a file, or a text, for some targets.

    ``source`` is a path, or the text itself (a ``str`` that contains a line break or a brace).
    ``targets`` are names such as ``"wgsl"``, or with a profile ``"glsl:es300"``; ``"all"`` means
    every profile, and ``"default"`` the first profile of every language that is not marked as
    unproven. All materials that are not abstract are compiled, unless ``material`` names one.
    ``rig`` and ``pass_`` are only needed if a file has several. With ``hoist=False`` the shaders
    compute everything themselves. With ``line_directives``, texts have ``#line`` directives that
    name the material's lines, if the language has them. If a profile lacks something that a
    material needs, this is an error; with ``partial``, that material has no text for this profile,
    and its ``lacking`` says why.

    Raises ``CompileError``, whose ``diagnostics`` are all errors, and ``TypeError`` for arguments
    of other types.
    """
    report = Report()
    _check_names(material=material, rig=rig, pass_=pass_)
    _check_flags(
        hoist=hoist, flip_y=flip_y, single_file=single_file,
        line_directives=line_directives, partial=partial,
    )  # fmt: skip
    chosen = select_targets(_names_of_targets(targets), report, single_file=single_file)
    frontend, module = _opened(source, search_path, report)
    shaders = [] if module is None else frontend.shaders(module, material, rig, pass_)
    if report.failed:
        raise CompileError(report.diagnostics)
    options = EmitOptions(flip_y, single_file, line_directives)
    if line_directives:
        _warn_of_targets_without_lines(chosen, report)
    compiled = []
    for shader in shaders:
        staged = stage(shader, Options(hoist))
        lacking = _lacking(shader, staged, chosen)
        if not partial:
            report.extend(chain.from_iterable(lacking.values()))
        compiled.append(_compiled(shader, staged, lacking, chosen, options))
    if report.failed:
        raise CompileError(report.diagnostics)
    return CompileResult(tuple(compiled), report.diagnostics, frontend.inputs)


@seldom_collected
def check(
    source: str | Path,
    *,
    rig: str | None = None,
    pass_: str | None = None,
    search_path: Sequence[str | Path] = (),
) -> tuple[Diagnostic, ...]:
    """All diagnostics of a file or text; nothing is emitted.

    Raises ``TypeError`` for arguments of other types, and nothing else.
    """
    report = Report()
    _check_names(rig=rig, pass_=pass_)
    frontend, module = _opened(source, search_path, report)
    if module is not None:
        frontend.check(module, rig, pass_)
    return report.diagnostics


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


def select_targets(
    wanted: Iterable[str], report: Report, *, single_file: bool = False
) -> list[tuple[Language, Profile]]:
    """The targets and profiles that ``wanted`` names; unknown names are reported."""
    chosen: dict[tuple[str, str], tuple[Language, Profile]] = {}
    known = registry.names()
    for text in chain.from_iterable(_meant(text.strip(), known) for text in wanted):
        name, _, profile_name = text.partition(":")
        if name not in known:
            hint = suggestion(name, (*known, ALL)) or f"there are {', '.join(_listed())}, and {ALL}"
            report.add(rules.UNKNOWN_TARGET, None, name=name, hint=hint)
            continue
        target = registry.load(name)
        try:
            profile = target.profile(profile_name)
        except KeyError:
            profiles = [profile.name for profile in target.profiles]
            hint = suggestion(profile_name, profiles) or f"there are {', '.join(profiles)}"
            report.add(rules.UNKNOWN_PROFILE, None, target=name, name=profile_name, hint=hint)
            continue
        if single_file and not profile.single_file:
            feature = "text that holds both stages"
            report.add(rules.UNSUPPORTED, None, target=_name(target, profile), feature=feature)
        chosen[name, profile.name] = target, profile
    return list(chosen.values())


def _listed() -> Iterator[str]:
    """The names of all targets, with a remark for those that are not proven."""
    for target in map(registry.load, registry.names()):
        yield f"{target.name} ({target.unproven})" if target.unproven else target.name


def _meant(name: str, known: Iterable[str]) -> Iterable[str]:
    """The names that ``all`` and ``default`` mean; any other name means itself."""
    if name == DEFAULT:
        return registry.defaults()
    if name != ALL:
        return (name,)
    return [f"{each}:{profile.name}" for each in known for profile in registry.load(each).profiles]


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
    expect("source", source, (str, PathLike), "a path or a text")
    folders = expect_all("search_path", search_path, (str, PathLike), "a sequence of folders")
    frontend = Frontend(report, [Path(folder) for folder in folders])
    if isinstance(source, str) and ("\n" in source or "{" in source):
        return frontend, frontend.open_text(source, "<text>")
    return frontend, frontend.open_file(Path(source))


def _compiled(
    shader: Shader,
    staged: Staged,
    lacking: Mapping[str, Sequence[Diagnostic]],
    chosen: list[tuple[Language, Profile]],
    emit_options: EmitOptions,
) -> CompiledMaterial:
    emissions = tuple(
        (
            target,
            profile,
            emit(legalise(staged.program, target, profile, staged.undecided), emit_options),
        )
        for target, profile in chosen
        if _name(target, profile) not in lacking
    )
    files = tuple(
        _output(shader, target, profile, emission, file, emit_options)
        for target, profile, emission in emissions
        for file in emission.files
    )
    profiles = [profile for _target, profile in chosen]
    guards = tuple(g for g in staged.guards if any(keeps(profile, g) for profile in profiles))
    reasons = {name: "; ".join(each.message for each in found) for name, found in lacking.items()}
    return CompiledMaterial(
        shader.name, files, reasons, guards, shader, staged, emissions, emit_options.flip_y
    )


def _lacking(
    shader: Shader, staged: Staged, chosen: list[tuple[Language, Profile]]
) -> dict[str, tuple[Diagnostic, ...]]:
    """For each profile, the features that it lacks and a shader needs."""
    found = {}
    places = {extern.place.name: extern.span for extern in shader.externs}
    for target, profile in chosen:
        name, report = _name(target, profile), Report()
        for excess in excesses(staged.program, profile):
            report.add(
                rules.TOO_MANY, places.get(excess.block), count=excess.count,
                what=f"{excess.what} of {shader.name}", target=name, limit=excess.limit,
            )  # fmt: skip
        for lack, node in lacks(staged.program, profile):
            report.add(
                rules.UNSUPPORTED, shader.notes.spans.get(node),
                target=name, feature=lack.feature, hint=lack.instead,
            )  # fmt: skip
        if report.diagnostics:
            found[name] = report.diagnostics
    return found


def _name(target: Language, profile: Profile) -> str:
    return f"{target.name}:{profile.name}"


def _warn_of_targets_without_lines(chosen: list[tuple[Language, Profile]], report: Report) -> None:
    for name in dict.fromkeys(target.name for target, _ in chosen if not target.line_directive):
        report.add(rules.NO_LINE_DIRECTIVES, None, target=name)


def _output(
    shader: Shader,
    target: Language,
    profile: Profile,
    emission: Emission,
    file: EmittedFile,
    options: EmitOptions,
) -> OutputFile:
    default = profile is target.profiles[0]
    parts = (shader.name, file.suffix) if default else (shader.name, profile.name, file.suffix)
    name, spans = ".".join(parts), located(shader, file.origins, emission.notes)
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
    "MissingValuesError": "instances.instance",
    "ParameterError": "instances.values",
    "PictureError": "textures.kinds",
    "Texture": "textures.texture",
}
"""The modules of the runtime's names, which programs that only compile never load."""


def __getattr__(name: str) -> Any:
    """Load the runtime on first use."""
    if name in _RUNTIME:
        return getattr(import_module(f".targets.runner.{_RUNTIME[name]}", __package__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
