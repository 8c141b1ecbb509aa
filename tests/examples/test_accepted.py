"""Every example compiles for every target, and the real front ends take the texts."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from burnish import CompileError, CompileResult, compile
from burnish.targets.toolchain import Job, Toolchain

from .kit import EXAMPLES, VARIANTS, Variant, jobs_of


def jobs(result: CompileResult) -> Iterator[Job]:
    for material in result.materials:
        yield from jobs_of(material)


@pytest.mark.parametrize("variant", VARIANTS, ids=str)
def test_accepted(variant: Variant, toolchain: Toolchain) -> None:
    result = variant.compile()
    assert not result.diagnostics
    assert result.materials
    verdicts = toolchain.check(list(jobs(result)))
    refused = [verdict.report() for verdict in verdicts if verdict.status != "accepted"]
    assert not refused, "\n".join(refused)
    stages = sum(len(material.staged.program.stages) for material in result.materials)
    assert len(verdicts) >= stages * len(variant.profiles)


def test_every_example_is_tried() -> None:
    assert {variant.path for variant in VARIANTS} == set(EXAMPLES)


@pytest.mark.parametrize("variant", [v for v in VARIANTS if v.lacking], ids=str)
def test_no_more_profiles_are_left_out_than_lack_something(variant: Variant) -> None:
    for profile in variant.lacking:
        with pytest.raises(CompileError) as refused:
            compile(variant.path, profile, rig=variant.rig, pass_=variant.pass_)
        assert {each.rule.code for each in refused.value.diagnostics} == {"B0701"}
