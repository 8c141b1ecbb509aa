"""The subjects of ``burnish conform``: every material of its files, with every rig and pass."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import click

from .console import remark, show

if TYPE_CHECKING:
    from ..api.entry_points import CompiledFrame, CompiledMaterial, CompileResult
    from ..compiler.diagnostics.diagnostic import Diagnostic
    from ..compiler.inputs import Inputs
    from ..targets.runner.routes import Route


class ConformRequest(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    files: tuple[Path, ...]
    routes: str
    device: str
    report: Path | None
    strict: bool
    explain: tuple[int, int] | None
    case: str | None
    seed: int
    rig: str | None
    pass_: str | None
    search_path: tuple[Path, ...]
    hoist: bool
    native_stages: bool
    measure: bool = False
    golden: Path | None = None
    values: tuple[tuple[str, str], ...] = ()
    scheduler: str | None = None
    """The address of the farm that compares, instead of this machine."""


Subjects = list[tuple[str, "CompiledMaterial | CompiledFrame"]]
"""Materials, kernels and frames, each with the label that the table shows."""


class Said(NamedTuple):
    """Whatever the compiler has to say about one file."""

    warnings: tuple[Diagnostic, ...] = ()
    errors: tuple[Diagnostic, ...] = ()
    remarks: tuple[str, ...] = ()
    """Warnings that belong to no place in the file."""


def subjects_of(
    request: ConformRequest,
    routes: Sequence[Route],
    *,
    native_stages: bool,
    further: Sequence[str] = (),
    read: Callable[[Inputs], None] = lambda _inputs: None,
) -> Subjects:
    """Every material with every rig and pass, each with the label that the table shows.

    With ``native_stages``, only routes can draw materials with such stages. ``further`` are
    profiles for which texts are needed besides those of the routes. ``read`` is called with the
    inputs of each compile. Raises ``CompileError`` with the errors of all files.
    """
    profiles = profiles_of(routes) | set(further)
    found = [
        subjects_in(path, request, profiles, native_stages=native_stages, read=read)
        for path in request.files
    ]
    show_said([said for _subjects, said in found])
    return [each for subjects, _said in found for each in subjects]


def profiles_of(routes: Sequence[Route]) -> set[str]:
    """The profiles whose texts some routes draw."""
    return {route.profile for route in routes}


def subjects_in(
    path: Path,
    request: ConformRequest,
    profiles: Iterable[str],
    *,
    native_stages: bool,
    specialise: bool = True,
    read: Callable[[Inputs], None] = lambda _inputs: None,
) -> tuple[Subjects, Said]:
    """The subjects of one file of a request; there are none if there are errors in it.

    Without ``specialise``, they serve all values of parameters, whatever the request narrows.
    """
    from ..compiler.diagnostics.diagnostic import CompileError

    found: Subjects = []
    warnings: list[Diagnostic] = []
    remarks: list[str] = []
    wanted = sorted(profiles)
    try:
        for variant in _variants(path, request):
            for result in _results(
                path, variant, request, wanted, remarks,
                native_stages=native_stages, specialise=specialise,
            ):  # fmt: skip
                warnings += result.diagnostics
                read(result.inputs)
                for subject in result.frames or result.materials:
                    label = _label(path, request.files, subject.name, variant)
                    found.append((label, subject))
    except CompileError as error:
        return [], Said(errors=tuple(error.diagnostics), remarks=tuple(remarks))
    # The same is said of both forms.
    return found, Said() if native_stages else Said(tuple(warnings), (), tuple(remarks))


def show_said(about: Sequence[Said]) -> None:
    """Print the warnings about all files; or raise ``CompileError`` with the errors in them."""
    from ..compiler.diagnostics.diagnostic import CompileError

    for said in about:
        for text in said.remarks:
            remark("warning", text)
    if errors := [error for said in about for error in said.errors]:
        raise CompileError(errors)
    show(warning for said in about for warning in said.warnings)


def _results(
    path: Path,
    variant: Variant,
    request: ConformRequest,
    profiles: Sequence[str],
    remarks: list[str],
    *,
    native_stages: bool,
    specialise: bool,
) -> list[CompileResult]:
    """The materials of a file with a rig and a pass.

    Materials that lack a slot for the pass are left out, and ``remarks`` say so. Raises
    ``CompileError``, also if no material has the slot.
    """
    from ..api import entry_points as api
    from ..compiler.diagnostics import rules
    from ..compiler.diagnostics.diagnostic import CompileError

    def compiled(material: str | None, pass_: str | None) -> CompileResult:
        return api.compile(
            path, profiles, material=material, rig=variant[0], pass_=pass_,
            search_path=request.search_path, hoist=request.hoist, partial=True,
            native_stages=native_stages, keep_graphs=True, values=dict(request.values),
            specialise=specialise,
        )  # fmt: skip

    try:
        found = compiled(None, variant[1])
        _check_frames(found, request)
        return [found]
    except CompileError as error:
        if variant[1] is None or {one.rule for one in error.diagnostics} != {rules.UNKNOWN_NAME}:
            raise
        fitting: list[CompileResult] = []
        lacking: dict[str, str] = {}
        for name in [material.name for material in compiled(None, None)]:
            try:
                fitting.append(compiled(name, variant[1]))
            except CompileError as reason:
                lacking[name] = reason.diagnostics[0].message
        if not fitting:
            raise
        for name, message in lacking.items():
            label = _label(path, request.files, name, variant)
            remarks.append(f"{label}: not drawn, as it does not fit this pass: {message}")
        return fitting


def _check_frames(found: CompileResult, request: ConformRequest) -> None:
    """Raise ``UsageError`` for versions of frames, which are compared with nothing."""
    if request.values and found.frames:
        raise click.UsageError(
            f"--set compares versions of materials and kernels, and `{found.frames[0].name}` is a "
            "frame: draw the files of its materials"
        )


Variant = tuple[str | None, str | None]
"""The names of a rig and of a pass; ``None`` means the library's."""


def _variants(path: Path, request: ConformRequest) -> list[Variant]:
    """The combinations of rig and pass that the command line does not exclude."""
    from ..api import entry_points as api

    found = api.variants(path, search_path=request.search_path)
    if api.has_frames(path, search_path=request.search_path):
        # A frame says by itself which passes it draws.
        found = tuple((rig, None) for rig, _pass in found)
    chosen = [(request.rig or rig, request.pass_ or pass_) for rig, pass_ in found]
    return list(dict.fromkeys(chosen))


def _label(path: Path, paths: Sequence[Path], material: str, variant: Variant) -> str:
    """The label of a material: its file's name, or the whole path if two names are equal."""
    from ..compiler.diagnostics.file_names import readable

    alike = sum(other.name == path.name for other in paths) > 1
    file = readable(str(path) if alike else path.name)
    return " × ".join([f"{file}: {material}", *filter(None, variant)])
