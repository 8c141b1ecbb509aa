"""The table of checkers: the tools that each one needs, and the function that checks a text.

``Toolchain`` looks a job's checker up here; ``Profile.checkers`` names those of a profile.
"""

from __future__ import annotations

import base64
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

from .clang import check_against, headers_in
from .directives import foreign_directive
from .glslang import check_glsl, check_hlsl, check_vulkan_glsl, check_webgl1
from .job import Job, Message, Verdict
from .messages import read_dxc, read_naga, read_tint
from .process import RUST_PANIC
from .toolbox import Toolbox
from .verdicts import accepted_unless_error, judge_spirv, rejected, undone

Check = Callable[[Sequence[Job], Toolbox], list[Verdict]]
"""Answers jobs, in their order. All jobs of a call are for one checker and have the same flags."""

VULKAN_ATTRIBUTES_ARE_FINE = "-Wno-ignored-attributes"
"""A flag for DXIL, which has no use for the ``[[vk::location]]`` that the text has for SPIR-V."""
DXC_PROFILES = {
    "vert": "vs", "tesc": "hs", "tese": "ds", "geom": "gs", "frag": "ps", "comp": "cs",
}  # fmt: skip
"""The names of the stages in front of the version of the shader model."""
VIEWS_IN_HLSL = "SV_ViewID"
"""The semantic that needs Shader Model 6.1; all other texts are for 6.0."""
MSL_DECLARATIONS = Path(__file__).parents[1] / "msl"
"""The folder with declarations of Metal. Apple's own compiler is not available here; clang is the
only one that has ever checked these texts."""
MSL_ENTRIES = {
    "vert": r"vertex \w+ {name}\(",
    "frag": r"fragment \w+ {name}\(",
    "comp": r"kernel void {name}\(",
}
"""The definitions of entry points in Metal, as patterns by stage."""
SHOWN = 60
"""The number of characters that are shown of a refused directive."""
NAGA_NO_ENTRY = "Unable to find the entry point"


@dataclass(frozen=True, slots=True)
class Checker:
    """One way to have a shader text checked."""

    name: str
    needs: tuple[str, ...]
    """The names of the tools that it needs; all of them are required."""
    check: Check
    batch: int = 1
    """The largest number of jobs that one call of ``check`` takes."""
    together: int = 1
    """The number of jobs for one call, even if others could be done at the same time."""
    has_directives: bool = True
    """True if the language has directives. Its texts may have only those that Burnish emits."""
    headers: tuple[str, ...] = ()
    """The headers that a text may include."""

    def refusal(self, job: Job) -> Verdict | None:
        """The verdict on a text that no compiler may have; ``None`` for other texts."""
        found = foreign_directive(job.text, self.headers) if self.has_directives else None
        if found is None:
            return None
        line, directive = found
        said = f"no emitted text has the directive '{directive[:SHOWN]}', so it was not compiled"
        return rejected(job, (Message("error", line, None, said),), said)


def _each(check: Callable[[Job, Toolbox], Verdict]) -> Check:
    return lambda jobs, toolbox: [check(job, toolbox) for job in jobs]


def _dxc_spirv(job: Job, toolbox: Toolbox) -> Verdict:
    target = ("-spirv", "-fspv-target-env=vulkan1.1")
    verdict, module = _dxc(job, toolbox, target, disassemble=False)
    return judge_spirv(verdict, module, toolbox) if verdict.status == "accepted" else verdict


def _dxc_dxil(job: Job, toolbox: Toolbox) -> Verdict:
    verdict, module = _dxc(job, toolbox, (VULKAN_ATTRIBUTES_ARE_FINE,), disassemble=True)
    return replace(verdict, dxil=module) if verdict.status == "accepted" else verdict


def _dxc(
    job: Job, toolbox: Toolbox, target: tuple[str, ...], *, disassemble: bool
) -> tuple[Verdict, bytes]:
    model = "6_1" if VIEWS_IN_HLSL in job.text else "6_0"
    wanted = f"{DXC_PROFILES[job.stage]}_{model}"
    arguments = [*target, "-T", wanted, "-E", job.entry, *job.flags]
    request = {"text": job.text, "arguments": arguments, "disassemble": disassemble}
    with toolbox.dxc.borrow() as worker:
        answer = worker.ask(request, toolbox.time_limit)
    if answer.ending != "ended":
        return undone(job, answer.ending, answer.log), b""
    reply = answer.reply
    messages = read_dxc(reply["log"])
    if not reply["accepted"]:
        return rejected(job, messages, reply["log"]), b""
    verdict = Verdict(job, "accepted", messages, log=reply["log"], disassembly=reply["disassembly"])
    return verdict, base64.b64decode(reply["object"])


def _naga(job: Job, toolbox: Toolbox) -> Verdict:
    """Check WGSL with naga. ``-g`` keeps the names of members, which the layout tests need."""
    arguments = ("-g", "--entry-point", job.entry, *job.flags)
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "shader.wgsl").write_text(job.text, encoding="utf-8")
        outcome = toolbox.run("naga", *arguments, "shader.wgsl", "shader.spv", folder=folder)
        if outcome.code == RUST_PANIC and NAGA_NO_ENTRY in outcome.log:
            return rejected(job, (_no_entry(job),), outcome.log)
        if outcome.ending != "ended":
            return undone(job, outcome.ending, outcome.log)
        messages = read_naga(outcome.log)
        if outcome.code != 0:
            return rejected(job, messages, outcome.log)
        module = (folder / "shader.spv").read_bytes()
    return judge_spirv(Verdict(job, "accepted", messages, log=outcome.log), module, toolbox)


def _no_entry(job: Job) -> Message:
    return Message("error", None, None, f"there is no entry point named '{job.entry}'")


def _tint(job: Job, toolbox: Toolbox) -> Verdict:
    with toolbox.tint.borrow() as worker:
        answer = worker.ask({"text": job.text}, toolbox.time_limit)
    if answer.ending != "ended":
        return undone(job, answer.ending, answer.log)
    messages = read_tint(answer.reply["messages"])
    log = "\n".join(each.text for each in messages)
    return accepted_unless_error(job, messages, log)


CHECKERS: dict[str, Checker] = {
    checker.name: checker
    for checker in (
        Checker(
            "glslang-vulkan", ("glslang", "spirv-tools"), check_vulkan_glsl,
            batch=2, together=2,  # the stages of a program
        ),
        Checker("glslang-gl330", ("glslang",), check_glsl, batch=32, together=8),
        Checker("glslang-gl450", ("glslang",), check_glsl, batch=32, together=8),
        Checker("glslang-es100", ("glslang",), check_webgl1, batch=32, together=8),
        Checker("glslang-es300", ("glslang",), check_glsl, batch=32, together=8),
        Checker("glslang-es310", ("glslang",), check_glsl, batch=32, together=8),
        Checker(
            "glslang-hlsl", ("glslang", "spirv-tools"), check_hlsl,
            batch=2, together=2,  # the stages of a program
        ),
        Checker("dxc-spirv", ("dxc", "spirv-tools"), _each(_dxc_spirv)),
        Checker("dxc-dxil", ("dxc",), _each(_dxc_dxil)),
        Checker("naga", ("naga", "spirv-tools"), _each(_naga), has_directives=False),
        Checker("tint", ("tint", "node"), _each(_tint), has_directives=False),
        Checker(
            "clang-msl", ("clang",), _each(check_against(MSL_DECLARATIONS, MSL_ENTRIES)),
            headers=headers_in(MSL_DECLARATIONS),
        ),
    )
}  # fmt: skip


def checkers_needing(tool: str) -> tuple[str, ...]:
    """The names of the checkers that cannot work without a tool."""
    return tuple(checker.name for checker in CHECKERS.values() if tool in checker.needs)
