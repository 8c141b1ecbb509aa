"""Every example compiles for every target, and the real front ends take the texts."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from burnish import CompileResult
from burnish.targets.runner.codes import modules
from burnish.targets.runner.routes import ROUTES
from burnish.targets.toolchain import Job, Toolchain, Verdict

from ..targets.standings import PROFILES
from .kit import EXAMPLES, VARIANTS, Variant, jobs_of

OF_ROUTES = {route.compiler for route in ROUTES.values()}
"""The checkers that compile for routes, by which every example is drawn as well."""


def jobs(result: CompileResult) -> Iterator[Job]:
    for material in result.materials:
        yield from jobs_of(material)


@pytest.mark.parametrize("variant", VARIANTS, ids=str)
def test_accepted(variant: Variant, toolchain: Toolchain) -> None:
    result = variant.compile()
    assert not result.diagnostics
    assert result.materials
    asked = list(jobs(result))
    made = modules([job for job in asked if job.checker in OF_ROUTES], toolchain)
    verdicts = toolchain.check([job for job in asked if job.checker not in OF_ROUTES])
    verdicts += [each for each in made.values() if isinstance(each, Verdict)]
    refused = [verdict.report() for verdict in verdicts if verdict.status != "accepted"]
    assert not refused, "\n".join(refused)
    wanted = sum(
        len(material.staged.program.stages) * (len(PROFILES) - len(material.lacking))
        for material in result.materials
    )
    assert len(asked) >= wanted


def test_every_example_is_tried() -> None:
    assert {variant.path for variant in VARIANTS} == set(EXAMPLES)


@pytest.mark.parametrize("variant", VARIANTS, ids=str)
def test_only_profiles_that_lack_something_are_left_out(variant: Variant) -> None:
    for material in variant.compile():
        assert material.lacking.keys() == variant.lacking(material.name), material.name
