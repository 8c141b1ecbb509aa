"""Every example compiles for every target, and the real front ends take the texts."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from burnish import CompileResult
from burnish.targets.toolchain import Job, Toolchain

from ..targets.standings import PROFILES
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
    wanted = sum(
        len(material.staged.program.stages) * (len(PROFILES) - len(material.lacking))
        for material in result.materials
    )
    assert len(verdicts) >= wanted


def test_every_example_is_tried() -> None:
    assert {variant.path for variant in VARIANTS} == set(EXAMPLES)


@pytest.mark.parametrize("variant", VARIANTS, ids=str)
def test_only_profiles_that_lack_something_are_left_out(variant: Variant) -> None:
    for material in variant.compile():
        assert material.lacking.keys() == variant.lacking(material.name), material.name
