"""Turns a material's texts into what a route's driver takes: SPIR-V by real compilers, or text.

``render`` and ``conform`` call it before they draw. Compilers run in parallel, and a store keeps
their results: the same text, flags and tools give the same module. Nothing is kept of a text that
was refused.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import Protocol

from ...compiler.diagnostics.source import Span
from ...compiler.ir.program import StageName
from ...compiler.ir.stages import STAGES
from ..toolchain import Job, Message, Toolchain, Verdict
from ..toolchain import __file__ as toolchain_file
from .drivers.pipeline import Code
from .routes import Route
from .store import Store, digest, digest_of_sources

STORE = "spirv"
"""The name of the store that keeps SPIR-V modules."""


class ShaderFile(Protocol):
    """An emitted text, as ``burnish.compile`` returns it."""

    @property
    def name(self) -> str:
        """The name of its file, such as ``Rubber.frag.glsl``."""

    @property
    def target(self) -> str:
        """The language, such as ``glsl``."""

    @property
    def profile(self) -> str:
        """The profile, such as ``vulkan``."""

    @property
    def entry_points(self) -> Mapping[StageName, str]:
        """The entry point of each stage in the text."""

    @property
    def text(self) -> str:
        """The whole text."""

    @property
    def spans(self) -> Mapping[int, Span]:
        """For each line of the text, counted from 1, the part of the material that it computes."""


@dataclass(frozen=True, slots=True)
class Request:
    """One material that shall be compiled for one route."""

    route: Route
    files: Sequence[ShaderFile]
    """The material's texts; those of other profiles are ignored."""


@dataclass(frozen=True, slots=True)
class Codes:
    """The stages of one material in the form that a driver takes."""

    stages: Mapping[StageName, Code]


class CodeError(Exception):
    """A route's compiler refused a text; says why, and which part of the material it concerns."""


def compile_one(route: Route, files: Sequence[ShaderFile], toolchain: Toolchain) -> Codes:
    """Compile the stages of one material for one route.

    Raises ``CodeError`` if the route's compiler is missing, crashes or refuses a text, and
    ``KeyError`` if the files have no text for the route.
    """
    (result,) = compile_all([Request(route, files)], toolchain)
    if isinstance(result, CodeError):
        raise result
    return result


def compile_all(requests: Sequence[Request], toolchain: Toolchain) -> list[Codes | CodeError]:
    """Compile the stages of each request, in parallel; an error stands for stages that were
    refused.

    Raises ``KeyError`` if a request's files have no text for its route.
    """
    jobs = [
        _job(request.route, stage, file)
        for request in requests
        if request.route.compiler
        for stage, file in _texts(request).items()
    ]
    made = modules(list(dict.fromkeys(jobs)), toolchain)
    return [_codes(request, made) for request in requests]


def modules(jobs: Sequence[Job], toolchain: Toolchain) -> dict[Job, bytes | Verdict]:
    """A module for each job of a checker that makes SPIR-V, or its verdict if it has refused it.

    Tests that check texts call it as well: a text that a route has compiled is not compiled again.
    """
    store = Store(STORE)
    versions = {name: toolchain.versions(name) for name in {job.checker for job in jobs}}
    names = {job: _digest(job, versions[job.checker]) for job in jobs}
    kept = {job: store.read(name) for job, name in names.items()}
    made: dict[Job, bytes | Verdict] = {job: data for job, data in kept.items() if data is not None}
    verdicts = toolchain.check([job for job in jobs if job not in made], keep_modules=True)
    for verdict in verdicts:
        made[verdict.job] = verdict.spirv or verdict
        if verdict.spirv:
            store.write(names[verdict.job], verdict.spirv)
    return made


def _codes(request: Request, made: Mapping[Job, bytes | Verdict]) -> Codes | CodeError:
    codes: dict[StageName, Code] = {}
    for stage, file in _texts(request).items():
        entry = file.entry_points[stage]
        if request.route.compiler is None:
            codes[stage] = Code(entry, text=file.text)
            continue
        module = made[_job(request.route, stage, file)]
        if isinstance(module, Verdict):
            return CodeError(_refusal(request.route, file, module))
        codes[stage] = Code(entry, spirv=module)
    return Codes(codes)


def _texts(request: Request) -> Mapping[StageName, ShaderFile]:
    """The text of each stage for the request's route."""
    profile = request.route.profile
    files = [file for file in request.files if f"{file.target}:{file.profile}" == profile]
    if not files:
        raise KeyError(f"no text for {profile}, which {request.route.name} draws")
    return {stage: file for file in files for stage in file.entry_points}


def _job(route: Route, stage: StageName, file: ShaderFile) -> Job:
    entry = file.entry_points[stage]
    return Job(route.compiler or "", STAGES[stage].suffix, file.text, entry, file.name, route.flags)


def _digest(job: Job, versions: Sequence[str]) -> str:
    return digest(
        _toolchain_digest(), *versions, job.checker, job.stage, job.entry, *job.flags, job.text
    )


@cache
def _toolchain_digest() -> str:
    """A digest of the code that decides on the compilers' command lines."""
    return digest_of_sources(Path(toolchain_file).parent)


def _refusal(route: Route, file: ShaderFile, verdict: Verdict) -> str:
    checker = verdict.job.checker
    if verdict.status != "rejected":
        return f"{route.name}: {checker} on {file.name}: {verdict.status}: {verdict.log.strip()}"
    errors = [message for message in verdict.messages if message.severity == "error"]
    lines = [line for message in errors for line in _located(file, message)]
    return "\n".join([f"{route.name}: {checker} rejects {file.name}", *lines])


def _located(file: ShaderFile, message: Message) -> Iterator[str]:
    """A compiler's message, and the line of the material that it concerns."""
    place = ":".join(str(part) for part in (file.name, message.line, message.column) if part)
    yield f"  {place}: {message.text}"
    span = file.spans.get(message.line) if message.line else None
    if span is not None:
        number, _ = span.source.position(span.start)
        yield f"    from {span}: {span.source.line(number).strip()}"
