"""The lengths of the shaders beside hand-written ones, with the same meaning and with none.

``floors`` is the surface as short as hand can write it, with no care for what happens at the edges.
``twins`` is the floor plus what the meaning asks for, and nothing else:

* ``normalize`` of the interpolated normal, which may vanish, is ``v * inversesqrt(max(dot(v, v),
  2^-126))``, since the builtin is undefined for zero.
* ``smoothstep`` may have edges the wrong way round, for which the builtin is undefined, and equal
  ones. So the host computes the inverse of their distance, which is finite in any case, and the
  builtin gets edges of 0 and 1.
* The other uses of ``normalize`` need nothing: the host promises that neither the eye nor a lamp
  stands on the surface.
* ``pow`` needs nothing: its base is clamped to 0..1, and the exponent is at least 1.
* The directions need nothing: a host keeps them at length one.

Each language has the highlight in the form that its compiler makes least of: a branch in GLSL, a
choice of values in HLSL and WGSL.

What depends on parameters alone comes from the host, for Burnish and the twins: the normal matrix,
the cosine of the outer cone, and the inverse width of the falloff. The floors' vertex shader has no
normal matrix: it takes normals as if no object were stretched.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import burnish
from burnish.compiler.passes.guard import Guard
from burnish.targets.toolchain import Job, Toolchain, count_instructions, optimise

from .table import Row, Section

HERE = Path(__file__).parent
LIMIT = 1.08
"""The largest length of fragment shaders, as a multiple of the unguarded floor's."""
TEXT_LIMIT = 2400
STAGES = {"vertex": "vert", "fragment": "frag"}
AUTHORS = ("burnish", "twins", "floors")


@dataclass(frozen=True, slots=True)
class Route:
    """A downstream compiler, and where to find hand-written text for it."""

    checker: str
    target: str
    file: str
    entries: tuple[str, str]
    """The entry points of the hand-written vertex and fragment shader."""


ROUTES = (
    Route("glslang-vulkan", "glsl", "phong.{stage}.glsl", ("main", "main")),
    Route("dxc-spirv", "hlsl", "phong.hlsl", ("vsmain", "main")),
    Route("naga", "wgsl", "phong.wgsl", ("vsmain", "fsmain")),
)

Key = tuple[str, str, str]
"""Checker, stage and author."""


def measure() -> Iterator[Section]:
    """Instructions, sizes of the texts, and the guards that stay."""
    material = burnish.compile(HERE / "surface.burnish").materials[0]
    jobs = _jobs(material)
    modules = _modules(jobs)
    yield Section("instructions", "Instructions in function bodies", _counts(modules))
    yield Section("text", f"Bytes of text, at most {TEXT_LIMIT} a fragment shader", _sizes(jobs))
    guards: list[Row] = [
        {"builtin": guard.builtin, "source": _source(guard), "reason": guard.reason}
        for guard in material.guards
    ]
    yield Section("guards", "Guards that stay, in the shader or in what the host computes", guards)


def _jobs(material: burnish.CompiledMaterial) -> dict[Key, Job]:
    jobs = {}
    for route in ROUTES:
        for (stage, short), entry in zip(STAGES.items(), route.entries, strict=True):
            text = material.text(route.target, "vertex" if stage == "vertex" else "fragment")
            jobs[route.checker, stage, "burnish"] = Job(route.checker, short, text, name="burnish")
            for author in ("twins", "floors"):
                path = HERE / author / route.file.format(stage=short)
                text = path.read_text(encoding="utf-8")
                jobs[route.checker, stage, author] = Job(
                    route.checker, short, text, entry, path.name
                )
    return jobs


def _modules(jobs: dict[Key, Job]) -> dict[Key, bytes]:
    with Toolchain() as toolchain:
        verdicts = toolchain.check(list(jobs.values()), keep_modules=True)
    modules = {}
    for key, verdict in zip(jobs, verdicts, strict=True):
        if verdict.spirv is None:
            raise SystemExit(verdict.report())
        modules[key] = verdict.spirv
    return modules


def _counts(modules: dict[Key, bytes]) -> list[Row]:
    rows: list[Row] = []
    for route in ROUTES:
        for stage in STAGES:
            plain = {author: modules[route.checker, stage, author] for author in AUTHORS}
            best = {author: optimise(module) for author, module in plain.items()}
            if route.checker == "dxc-spirv":
                rows.append(_count(route.checker, stage, plain))
            rows.append(_count(f"{route.checker}, spirv-opt -O", stage, best))
    return rows


def _count(compiler: str, stage: str, modules: dict[str, bytes]) -> Row:
    counts = {author: count_instructions(module) for author, module in modules.items()}
    ratio = counts["burnish"] / counts["floors"]
    return {
        "compiler": compiler,
        "stage": stage,
        "burnish": counts["burnish"],
        "twin": counts["twins"],
        "unguarded floor": counts["floors"],
        "ratio to the floor": ratio,
        f"at most {LIMIT}": ratio <= LIMIT if stage == "fragment" else None,
    }


def _sizes(jobs: dict[Key, Job]) -> list[Row]:
    rows: list[Row] = []
    for route in ROUTES:
        for stage in STAGES:
            size = len(jobs[route.checker, stage, "burnish"].text.encode())
            fits = size <= TEXT_LIMIT if stage == "fragment" else None
            rows.append({"target": route.target, "stage": stage, "bytes": size, "fits": fits})
    return rows


def _source(guard: Guard) -> str:
    span = guard.span
    return "" if span is None else span.source.text[span.start : span.end]
