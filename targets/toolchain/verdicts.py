"""Functions that turn the answers of tools into verdicts; all checkers use them."""

from __future__ import annotations

from dataclasses import replace

from .job import Job, Message, Verdict
from .process import Ending
from .spirv import SpirvError, entry_points, without_source
from .toolbox import Toolbox

DX_LAYOUT_FLAGS = frozenset({"-fvk-use-dx-layout", "-fvk-use-scalar-layout"})
"""With these flags DXC packs members more closely than Vulkan's standard layout allows, so that
spirv-val must check against the scalar layout.
"""


def undone(job: Job, ending: Ending, log: str) -> Verdict:
    """The verdict if a tool crashed or took too long, which says nothing about the shader."""
    return Verdict(job, "timeout" if ending == "timeout" else "crashed", log=log)


def rejected(job: Job, messages: tuple[Message, ...], log: str) -> Verdict:
    """The verdict of a tool that refused the text; if it named no error, its log is the error."""
    if not any(message.severity == "error" for message in messages):
        messages = (*messages, Message("error", None, None, log.strip() or "refused, silently"))
    return Verdict(job, "rejected", messages, log=log)


def accepted_unless_error(job: Job, messages: tuple[Message, ...], log: str) -> Verdict:
    """The verdict that follows from a tool's messages alone."""
    refused = any(message.severity == "error" for message in messages)
    return Verdict(job, "rejected" if refused else "accepted", messages, log=log)


def judge_spirv(verdict: Verdict, module: bytes, toolbox: Toolbox) -> Verdict:
    """The verdict after examining the SPIR-V that a compiler made from an accepted text.

    The module must contain the requested entry point, because naga accepts one of another stage,
    and it must pass spirv-val.
    """
    job = verdict.job
    try:
        module = without_source(module)
        if (job.stage, job.entry) not in entry_points(module):
            return _refuse(verdict, f"there is no {job.stage} entry point named '{job.entry}'")
    except SpirvError as error:
        return _refuse(verdict, str(error))
    outcome = toolbox.run("spirv-tools", *_rules(job), stdin=module)
    if outcome.ending != "ended":
        return undone(job, outcome.ending, verdict.log + outcome.log)
    if outcome.code != 0:
        return _refuse(verdict, f"spirv-val: {outcome.log.strip()}")
    return replace(verdict, spirv=module)


def _rules(job: Job) -> tuple[str, ...]:
    close_packing = ("--scalar-block-layout",) if DX_LAYOUT_FLAGS & {*job.flags} else ()
    return ("--target-env", "vulkan1.1", *close_packing)


def _refuse(verdict: Verdict, text: str) -> Verdict:
    messages = (*verdict.messages, Message("error", None, None, text))
    return replace(verdict, status="rejected", messages=messages, log=f"{verdict.log}\n{text}")
