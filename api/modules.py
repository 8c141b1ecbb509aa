"""The entry point ``burnish.modules``: compiles texts for drivers that take no texts.

``burnish compile --emit spirv,dxil`` calls ``modules_of``. The compilers are those that
``--validate`` checks texts with. What they make is validated, and with ``--optimize`` made shorter
by spirv-opt and validated again.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import TYPE_CHECKING, Literal

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import CompileError, Diagnostic, Report
from ..compiler.documents.backends import ModuleRow
from ..compiler.ir.stages import STAGES
from ..support.arguments import expect_all
from ..support.frozen import changed, frozen
from ..targets.toolchain import Job, Toolchain, Verdict
from ..targets.toolchain.spirv import SpirvError, insist_on_valid, optimise
from .compiled import CompiledMaterial, OutputFile
from .validating import tell

if TYPE_CHECKING:
    from ..compiler.documents.reflection import Reflection


@frozen
class ModuleFormat:
    """One row: a format of modules, and how it is made."""

    name: Literal["spirv", "dxil"]
    """The word of ``--emit``, and in reflections."""
    profile: str
    """The profile whose texts are compiled."""
    checker: str
    """The checker that compiles them."""
    extension: str
    """The end of the files' names."""


FORMATS: dict[str, ModuleFormat] = {
    row.name: row
    for row in (
        ModuleFormat("spirv", "glsl:vulkan", "glslang-vulkan", "spv"),
        ModuleFormat("dxil", "hlsl:sm6", "dxc-dxil", "dxil"),
    )
}


@frozen
class Module:
    """A text that was compiled."""

    format: ModuleFormat
    row: ModuleRow
    """What reflections say of it: its stage, its entry point, and the name of the file for it."""
    content: bytes
    """The bytes that a driver takes."""


def modules(
    material: CompiledMaterial,
    formats: str | Iterable[str] = ("spirv",),
    *,
    optimize: bool = False,
) -> tuple[Module, ...]:
    """A compiled material for drivers that take no texts: a module for each stage and format.

    ``"spirv"`` is made of the GLSL for Vulkan and ``"dxil"`` of the HLSL, so the material has to be
    compiled for these. With ``optimize``, spirv-opt makes SPIR-V shorter. All bindings are those of
    the text that a module is made of: ``material.reflection.backends["glsl:vulkan"]``.

    Raises ``CompileError`` if a text is refused or not there, or if a tool is missing;
    ``ValueError`` for a format that there is not, and ``TypeError`` for arguments of other types.
    """
    if not isinstance(material, CompiledMaterial):
        raise TypeError(f"`material` is a compiled material, not {type(material).__name__}")
    names = (formats,) if isinstance(formats, str) else tuple(formats)
    expect_all("formats", names, str, "names of formats")
    for name in names:
        if name not in FORMATS:
            known = " and ".join(f"`{each}`" for each in FORMATS)
            raise ValueError(f"no format of modules is called `{name}`: there are {known}")
    found, _ = modules_of([material], dict.fromkeys(names), optimised=optimize)
    return tuple(found.get(material.stem, ()))


def modules_of(
    materials: Sequence[CompiledMaterial], names: Iterable[str], *, optimised: bool
) -> tuple[dict[str, list[Module]], tuple[Diagnostic, ...]]:
    """The modules of each material, by its stem, in the formats with these names; and warnings.

    Raises ``CompileError`` if one cannot be made.
    """
    report = Report()
    asked = [
        (material, format_, file, stage, job)
        for format_ in map(FORMATS.__getitem__, names)
        for material in materials
        for file, stage, job in _jobs(material, format_, report)
    ]
    if report.failed:
        raise CompileError(report.diagnostics)
    with Toolchain() as toolchain:
        verdicts = toolchain.check([job for *_, job in asked], keep_modules=True)
    found: dict[str, list[Module]] = {}
    for (material, format_, file, stage, _), verdict in zip(asked, verdicts, strict=True):
        name = f"{material.stem}.{STAGES[stage].suffix}.{format_.extension}"
        content = _content(file, verdict, report, optimised=optimised)
        row = ModuleRow(
            stage=stage, file=name, format=format_.name, entry_point=file.entry_points[stage]
        )
        found.setdefault(material.stem, []).append(Module(format_, row, content))
    if report.failed:
        raise CompileError(report.diagnostics)
    return found, report.diagnostics


def with_modules(reflection: Reflection, modules: Iterable[Module]) -> Reflection:
    """The reflection with a row for each module, beside the texts that it was made of."""
    rows: dict[str, list[ModuleRow]] = {}
    for module in modules:
        rows.setdefault(module.format.profile, []).append(module.row)
    backends = {
        name: changed(backend, modules=tuple(rows[name])) if name in rows else backend
        for name, backend in reflection.backends.items()
    }
    return changed(reflection, backends=backends)


def _jobs(
    material: CompiledMaterial, format_: ModuleFormat, report: Report
) -> Iterator[tuple[OutputFile, str, Job]]:
    """A job for each stage of a material; reported if no text is there to compile."""
    files = [
        file for file in material.files if f"{file.target}:{file.profile}" == format_.profile
    ]  # fmt: skip
    if not files:
        report.add(rules.NO_TEXT_OF_MODULE, None, format=format_.name, profile=format_.profile)
    for file in files:
        for stage, entry in file.entry_points.items():
            yield file, stage, Job(
                format_.checker, STAGES[stage].suffix, file.text, entry, file.name
            )  # fmt: skip


def _content(file: OutputFile, verdict: Verdict, report: Report, *, optimised: bool) -> bytes:
    """The module that a compiler has made; reported if it has made none."""
    tell(file, verdict, report)
    if verdict.dxil is not None:
        return verdict.dxil
    if verdict.spirv is None:
        return b""
    if not optimised:
        return verdict.spirv
    try:
        module = optimise(verdict.spirv)
        insist_on_valid(module)
        return module
    except SpirvError as error:
        report.add(rules.NOT_OPTIMISED, None, file=file.name, reason=" ".join(str(error).split()))
        return b""
