"""The subjects of ``burnish conform``: every material of its files, with every rig and pass."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

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


Subjects = list[tuple[str, "CompiledMaterial | CompiledFrame"]]
"""Materials, kernels and frames, each with the label that the table shows."""


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
    from ..compiler.diagnostics.diagnostic import CompileError

    profiles = sorted({route.profile for route in routes} | set(further))
    found: Subjects = []
    warnings: list[Diagnostic] = []
    errors: list[Diagnostic] = []
    for path in request.files:
        try:
            for variant in _variants(path, request):
                for result in _compiled(path, variant, request, profiles, native_stages):
                    warnings += result.diagnostics
                    read(result.inputs)
                    for subject in result.frames or result.materials:
                        label = _label(path, request.files, subject.name, variant)
                        found.append((label, subject))
        except CompileError as error:
            errors += error.diagnostics
    if errors:
        raise CompileError(errors)
    if not native_stages:  # The same is said of both forms.
        show(warnings)
    return found


def _compiled(
    path: Path,
    variant: Variant,
    request: ConformRequest,
    profiles: Sequence[str],
    native_stages: bool,
) -> list[CompileResult]:
    """The materials of a file with a rig and a pass.

    Materials that lack a slot for the pass are left out, with a remark. Raises ``CompileError``,
    also if no material has the slot.
    """
    from ..api import entry_points as api
    from ..compiler.diagnostics import rules
    from ..compiler.diagnostics.diagnostic import CompileError

    def compiled(material: str | None, pass_: str | None) -> CompileResult:
        return api.compile(
            path, profiles, material=material, rig=variant[0], pass_=pass_,
            search_path=request.search_path, hoist=request.hoist, partial=True,
            native_stages=native_stages, keep_graphs=True,
        )  # fmt: skip

    try:
        return [compiled(None, variant[1])]
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
            remark("warning", f"{label}: not drawn, as it does not fit this pass: {message}")
        return fitting


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
