"""Runs glslangValidator on jobs. It starts slowly, so one process checks many texts if possible."""

from __future__ import annotations

import tempfile
from collections.abc import Iterator, Mapping, Sequence
from itertools import groupby
from operator import attrgetter
from pathlib import Path

from .job import Job, Verdict
from .messages import read_glslang
from .process import Outcome
from .toolbox import Toolbox
from .verdicts import accepted_unless_error, judge_spirv, rejected, undone

_LIMITS = "limits.conf"
"""The file with the resources of devices; glslang knows it by its ending."""
APPENDIX_A: Mapping[str, int] = {
    **dict.fromkeys(("nonInductiveForLoops", "whileLoops", "doWhileLoops"), 0),
    "generalUniformIndexing": 0,
    "generalAttributeMatrixVectorIndexing": 0,
    "generalVaryingIndexing": 0,
    "generalSamplerIndexing": 0,
    "generalVariableIndexing": 0,
    "generalConstantMatrixVectorIndexing": 0,
    "MaxVertexAttribs": 8,
    "MaxVertexTextureImageUnits": 0,
    "MaxTextureImageUnits": 8,
    "MaxVaryingVectors": 8,
    "MaxDrawBuffers": 1,
}
"""The features that devices may leave out by Appendix A of the specification of GLSL ES 1.00, and
the resources that its section 7.4 promises."""
_TO_VULKAN = ("-V", "--target-env", "vulkan1.1")


def check_vulkan_glsl(jobs: Sequence[Job], toolbox: Toolbox) -> list[Verdict]:
    """Compile GLSL for Vulkan to SPIR-V, and validate that."""
    return _each_program(jobs, toolbox, ())


def check_hlsl(jobs: Sequence[Job], toolbox: Toolbox) -> list[Verdict]:
    """Compile HLSL to SPIR-V, and validate that."""
    return [
        verdict
        for entry, alike in groupby(jobs, key=attrgetter("entry"))
        for verdict in _each_program(list(alike), toolbox, ("-D", "-e", entry))
    ]


def _each_program(
    jobs: Sequence[Job], toolbox: Toolbox, language: tuple[str, ...]
) -> list[Verdict]:
    """Compile to SPIR-V, a program at a time; ``language`` are arguments that name the language.

    Before the text, glslang reads the declarations of all functions that the language has, which
    takes far longer. So the stages of a program share a process, which answers for all of them if
    it accepts them without a word. Otherwise each job gets its own process, so that it is clear
    what is wrong with which one.
    """
    return [
        verdict for program in _programs(jobs) for verdict in _program(program, toolbox, language)
    ]


def _programs(jobs: Sequence[Job]) -> Iterator[list[Job]]:
    """The jobs in their order, those that follow each other together while their stages differ."""
    program: list[Job] = []
    for job in jobs:
        if job.stage in {other.stage for other in program}:
            yield program
            program = []
        program.append(job)
    yield program


def _program(jobs: Sequence[Job], toolbox: Toolbox, language: tuple[str, ...]) -> list[Verdict]:
    if len(jobs) == 1:
        return [_to_spirv(jobs[0], toolbox, language)]
    files = [f"shader.{job.stage}" for job in jobs]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, job in zip(files, jobs, strict=True):
            (folder / file).write_text(job.text, encoding="utf-8")
        arguments = (*language, *_TO_VULKAN, *jobs[0].flags, *files)
        outcome = toolbox.run("glslang", *arguments, folder=folder)
        silent = outcome.log.split() == files
        if outcome.ending != "ended" or outcome.code != 0 or not silent:
            return [_to_spirv(job, toolbox, language) for job in jobs]
        modules = [(folder / f"{job.stage}.spv").read_bytes() for job in jobs]
    return [
        judge_spirv(Verdict(job, "accepted", log=f"{file}\n"), module, toolbox)
        for job, file, module in zip(jobs, files, modules, strict=True)
    ]


def _to_spirv(job: Job, toolbox: Toolbox, language: tuple[str, ...]) -> Verdict:
    arguments = (*language, *_TO_VULKAN, "-S", job.stage, *job.flags)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "shader").write_text(job.text, encoding="utf-8")
        outcome = toolbox.run("glslang", *arguments, "-o", "spv", "shader", folder=folder)
        verdict = _verdict(job, outcome)
        if verdict.status != "accepted":
            return verdict
        module = (folder / "spv").read_bytes()
    return judge_spirv(verdict, module, toolbox)


def _verdict(job: Job, outcome: Outcome) -> Verdict:
    """The verdict on a job that had a process of its own."""
    if outcome.ending != "ended":
        return undone(job, outcome.ending, outcome.log)
    messages = read_glslang(outcome.log)
    if outcome.code != 0:
        return rejected(job, messages, outcome.log)
    return accepted_unless_error(job, messages, outcome.log)


def check_glsl(
    jobs: Sequence[Job], toolbox: Toolbox, limits: Mapping[str, int] | None = None
) -> list[Verdict]:
    """Check GLSL for OpenGL and OpenGL ES, all jobs in one process.

    ``limits`` are resources of devices that differ from glslang's own, by its names. If the process
    crashes, or its answers cannot be assigned to jobs, each job gets its own process.
    """
    files = [f"{number}.{job.stage}" for number, job in enumerate(jobs)]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, job in zip(files, jobs, strict=True):
            (folder / file).write_text(job.text, encoding="utf-8")
        if limits is not None:
            (folder / _LIMITS).write_text(_with_limits(limits, toolbox), encoding="utf-8")
        given = (*jobs[0].flags, *([_LIMITS] if limits is not None else ()), *files)
        outcome = toolbox.run("glslang", *given, folder=folder)
    if len(jobs) == 1:
        return [_verdict(jobs[0], outcome)]
    verdicts = _split(jobs, files, outcome)
    return verdicts or [check_glsl([job], toolbox, limits)[0] for job in jobs]


def check_webgl1(jobs: Sequence[Job], toolbox: Toolbox) -> list[Verdict]:
    """Check GLSL ES 1.00 for a device that leaves out everything that it may leave out."""
    return check_glsl(jobs, toolbox, APPENDIX_A)


def _with_limits(limits: Mapping[str, int], toolbox: Toolbox) -> str:
    """The text of glslang's configuration, with other numbers for some resources."""
    with tempfile.TemporaryDirectory() as name:
        own = toolbox.run("glslang", "-c", folder=Path(name)).output.decode(errors="replace")
    rows = (line.split() for line in own.splitlines())
    return "".join(f"{row[0]} {limits.get(row[0], row[1])}\n" for row in rows if len(row) == 2)


def _split(jobs: Sequence[Job], files: Sequence[str], outcome: Outcome) -> list[Verdict]:
    """A verdict for each job; an empty list if the answers contradict the exit code.

    glslangValidator writes a file's name on a line of its own, and its messages below.
    """
    logs: dict[str, str] = {}
    current = ""
    for line in outcome.output.decode(errors="replace").splitlines():
        if line in files:
            current = line
            logs[current] = ""
        elif current:
            logs[current] += f"{line}\n"
    if outcome.ending != "ended" or list(logs) != list(files):
        return []
    verdicts = [
        accepted_unless_error(job, read_glslang(log), log)
        for job, log in zip(jobs, logs.values(), strict=True)
    ]
    refused = any(verdict.status == "rejected" for verdict in verdicts)
    return verdicts if refused == (outcome.code != 0) else []
