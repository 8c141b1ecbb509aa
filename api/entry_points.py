"""The library's entry points: from a material to shader texts and their reflection.

Users call ``compile`` and ``check`` as ``burnish.compile`` and ``burnish.check``. The commands call
them too, and ``variants`` besides. ``compiling.py`` runs the compiler's phases.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from functools import cache
from importlib import import_module
from pathlib import Path
from types import NoneType
from typing import TYPE_CHECKING, Any

from ..compiler.diagnostics.diagnostic import CompileError, Diagnostic, Report
from ..compiler.documents.writing import to_json
from ..compiler.frontend import Frontend, current_library
from ..compiler.passes.pipeline import Options
from ..compiler.semantics.names.modules import Module
from ..support.arguments import expect, expect_all
from ..support.frozen import EMPTY, frozen
from ..support.garbage import seldom_collected
from ..targets.emit.emitter import EmitOptions
from ..targets.selection import DEFAULT
from .compiled import CompiledFrame, CompiledMaterial, CompileResult, OutputFile
from .compiling import Asked, check_filtering, opened, program_of, result_of, sources
from .remembered import Remembered

if TYPE_CHECKING:
    from ..compiler.semantics.equations.model import Equations
    from ..targets.runner.instances.host_values import MissingValuesError
    from ..targets.runner.instances.instance import Instance
    from ..targets.runner.instances.values import ParameterError
    from ..targets.runner.textures.kinds import PictureError
    from ..targets.runner.textures.texture import Texture
    from .compiled_functions import FunctionsResult
    from .sameness import Comparison, SameError, same

__all__ = [
    "Comparison",
    "CompileResult",
    "CompiledFrame",
    "CompiledMaterial",
    "Instance",
    "MissingValuesError",
    "OutputFile",
    "ParameterError",
    "PictureError",
    "SameError",
    "Texture",
    "check",
    "compile",
    "functions",
    "same",
    "to_json",
]


GivenValue = str | float | Sequence[float]
"""A value of a parameter, or a range as a text: ``"0.3..0.5"``."""


def compile(
    source: str | Path,
    targets: str | Iterable[str] = DEFAULT,
    *,
    material: str | None = None,
    rig: str | None = None,
    pass_: str | None = None,
    search_path: Sequence[str | Path] = (),
    values: Mapping[str, GivenValue] = EMPTY,
    specialise: bool = True,
    hoist: bool = True,
    flip_y: bool = False,
    single_file: bool = False,
    line_directives: bool = False,
    partial: bool = False,
    native_stages: bool = False,
    keep_graphs: bool = False,
) -> CompileResult:
    """Compile a file, or a text, for some targets.

    ``source`` is a path, or the text itself (a ``str`` that contains a line break or a brace).
    ``targets`` are names such as ``"wgsl"``, or with a profile ``"glsl:es300"``; ``"all"`` means
    every profile that need not be named, and ``"default"`` the first profile of every language that
    is not marked as unproven. All materials that are not abstract are compiled, unless ``material``
    names one; then only what it uses is checked, but all of the file is read, with its syntax.
    ``rig`` and ``pass_`` are only needed if a file has several. Texts serve only the ``values`` and
    ranges that parameters are given; with ``specialise=False`` they serve all, and materials only
    have these defaults and ranges for hosts, so that both draw the same. With ``hoist=False`` the
    shaders compute everything themselves. With ``line_directives``, texts have ``#line`` directives
    that name the material's lines, if the language has them. If a profile lacks something that a
    material needs, this is an error; with ``partial``, that material has no text for this profile,
    and its ``lacking`` says why. With ``native_stages``, a material that expands primitives or
    divides patches has the stages for it that a target provides; otherwise each primitive or patch
    is drawn as an instance. With ``keep_graphs``, the graphs behind the texts stay as long as the
    result; otherwise only those of the last results do. Whatever needs the graphs of another one,
    such as its first ``reflection``, then takes as long as compiling it once more.

    Raises ``CompileError``, whose ``diagnostics`` are all errors, and ``TypeError`` for arguments
    of other types.
    """
    _check_names(material=material, rig=rig, pass_=pass_)
    _check_flags(
        specialise=specialise, hoist=hoist, flip_y=flip_y, single_file=single_file,
        line_directives=line_directives, partial=partial, native_stages=native_stages,
        keep_graphs=keep_graphs,
    )  # fmt: skip
    asked = Asked(
        tuple(_names_of_targets(targets)), *sources(source, search_path), material, rig, pass_,
        Options(hoist), EmitOptions(flip_y, single_file, line_directives), partial, native_stages,
        keep_graphs, _texts_of(values), specialise,
    )  # fmt: skip
    library = current_library()
    result = _REMEMBERED.find(asked, library)
    if result is None:
        result = result_of(asked)
        _REMEMBERED.keep(asked, library, result)
    return result


_REMEMBERED = Remembered()
"""The results of the last calls of ``compile``."""


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
            check_filtering(frames, cache(program_of), report)
    return report.diagnostics


def functions(
    source: str | Path,
    targets: str | Iterable[str] = DEFAULT,
    *,
    material: str | None = None,
    rig: str | None = None,
    slots: Sequence[str] = (),
    together: bool = False,
    prefix: str | None = None,
    search_path: Sequence[str | Path] = (),
    values: Mapping[str, GivenValue] = EMPTY,
) -> FunctionsResult:
    """Compile slots of the materials of a file, or a text, to functions that an engine calls.

    ``slots`` are names such as ``"roughness"``; ``"height@vertex"`` is computed for vertices.
    Without them, all slots are compiled to which a material itself, or a model that it extends,
    gives a value, and which need no lights. Where ``rig`` is named, its lights are arguments, and
    slots may need them. There is one function for each slot; with ``together``, one for pixels and
    one for vertices, which return structures. All names in a text begin with ``prefix``, or else
    with that of the material. ``source``, ``targets``, ``material``, ``search_path`` and ``values``
    are as for ``compile``.

    Raises ``CompileError``, whose ``diagnostics`` are all errors, and ``TypeError`` for arguments
    of other types.
    """
    from .compiling_functions import AskedFunctions, functions_of

    _check_names(material=material, rig=rig, prefix=prefix)
    _check_flags(together=together)
    expect_all("slots", slots, str, "names of slots")
    asked = AskedFunctions(
        tuple(_names_of_targets(targets)), *sources(source, search_path), material, rig,
        tuple(slots), together, prefix, _texts_of(values),
    )  # fmt: skip
    return functions_of(asked)


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


def equations(
    source: str | Path,
    *,
    material: str | None = None,
    rig: str | None = None,
    pass_: str | None = None,
    search_path: Sequence[str | Path] = (),
) -> list[Equations]:
    """The own equations of the materials of a file, as graphs; for ``burnish graph``.

    Raises ``CompileError``.
    """
    report = Report()
    frontend, module = _opened(source, search_path, report)
    found = [] if module is None else frontend.equations(module, material, rig, pass_)
    if report.failed:
        raise CompileError(report.diagnostics)
    return found


@frozen
class Declared:
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


def _opened(
    source: str | Path, search_path: Sequence[str | Path], report: Report
) -> tuple[Frontend, Module | None]:
    """The module of a path or a text, and its front end; ``None`` if it cannot be read."""
    given, folders = sources(source, search_path)
    frontend = Frontend(report, folders)
    return frontend, opened(given, frontend)


def _names_of_targets(targets: str | Iterable[str]) -> list[str]:
    if isinstance(targets, str):
        return targets.split(",")
    return expect_all("targets", targets, str, "names of targets")


def _texts_of(values: Mapping[str, GivenValue]) -> tuple[tuple[str, str], ...]:
    """Values as a command line has them."""
    expect("values", values, Mapping, "a mapping of names to values")
    return tuple((name, _text_of(name, value)) for name, value in values.items())


def _text_of(name: str, value: GivenValue) -> str:
    expect("values", name, str, "names of parameters")
    if isinstance(value, bool):
        return str(value).lower()
    wanted = "numbers, sequences of numbers, and texts"
    expect("values", value, (str, int, float, Sequence), wanted)
    if isinstance(value, str | int | float):
        return str(value)
    return ",".join(map(str, expect_all("values", value, (int, float), wanted)))


def _check_names(**names: str | None) -> None:
    for argument, name in names.items():
        expect(argument, name, (str, NoneType), "a name")


def _check_flags(**flags: bool) -> None:
    for argument, flag in flags.items():
        expect(argument, flag, bool, "True or False")


_OF_SAMENESS = ("Comparison", "SameError", "same")
"""The names of comparing materials, which need NumPy."""

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
    if name in _OF_SAMENESS:
        return getattr(import_module(".sameness", __package__), name)
    if name in _RUNTIME:
        return getattr(import_module(f"..targets.runner.{_RUNTIME[name]}", __package__), name)
    raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
