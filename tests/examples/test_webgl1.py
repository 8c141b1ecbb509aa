"""The examples in GLSL ES 1.00: those that WebGL 1 can have, and what is said of the others.

``BURNISH_UPDATE_GOLDEN=1`` writes anew what is said.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from pathlib import Path

import pytest

import burnish
from burnish.api.entry_points import CompiledMaterial
from burnish.targets.toolchain import Job, Toolchain

from ..suite.verdicts import refused
from .kit import VARIANTS, jobs_of

PROFILE = "glsl:es100"
SAID = Path(__file__).with_name("webgl1.txt")
Compiled = dict[str, CompiledMaterial]


@pytest.fixture(scope="module")
def compiled() -> Compiled:
    """All materials and kernels of the examples, by example, rig, pass and name."""
    return dict(_compiled())


def _compiled() -> Iterator[tuple[str, CompiledMaterial]]:
    for variant in VARIANTS:
        rig, pass_ = variant.rig, variant.pass_
        for material in burnish.compile(variant.path, PROFILE, rig=rig, pass_=pass_, partial=True):
            yield f"{variant}.{material.name}", material


@pytest.mark.xdist_group("webgl1")
def test_what_can_be_had_is_accepted_without_all_that_devices_may_leave_out(
    compiled: Compiled,
) -> None:
    jobs = [job for material in compiled.values() for job in jobs_of(material)]
    assert len(jobs) > 140 and {job.checker for job in jobs} == {"glslang-es100"}
    with Toolchain() as toolchain:
        found = refused(jobs, toolchain)
    assert not found, "\n".join(each.report() for each in found)


@pytest.mark.xdist_group("webgl1")
def test_what_cannot_be_had_is_told(compiled: Compiled) -> None:
    said = "".join(
        f"{name}:\n" + "".join(f"    {each}\n" for each in material.lacking[PROFILE].split("; "))
        for name, material in compiled.items()
        if material.lacking
    )
    if os.environ.get("BURNISH_UPDATE_GOLDEN"):
        SAID.parent.mkdir(exist_ok=True)
        SAID.write_text(said, encoding="utf-8")
    assert said == SAID.read_text(encoding="utf-8")


BEYOND_APPENDIX_A = {
    "for (int i = 0; i < n; i++) { sum += 1.0; }": "constant",
    "sum = a[n];": "index",
    "while (sum < 2.0) { sum += 1.0; }": "while",
}
"""Statements that glslang takes of ES 1.00 unless it is told what devices may leave out, each with
a word of what it then says."""


def test_the_checker_knows_what_devices_may_leave_out() -> None:
    text = (
        "#version 100\nprecision highp float;\nuniform int n;\nuniform float a[4];\n"
        "void main() {{\n    float sum = 0.0;\n    {}\n    gl_FragColor = vec4(sum);\n}}\n"
    )
    jobs = [
        Job("glslang-es100", "frag", text.format(each), "main", each)
        for each in ("sum = a[2];", *BEYOND_APPENDIX_A)
    ]
    with Toolchain() as toolchain:
        fine, *others = toolchain.check(jobs)
    assert fine.status == "accepted"
    for verdict, word in zip(others, BEYOND_APPENDIX_A.values(), strict=True):
        assert verdict.status == "rejected" and word in verdict.report(), verdict.report()
