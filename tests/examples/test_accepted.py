"""Every example compiles for every target, and the real front ends take the texts."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest

import burnish
from burnish import CompileResult
from burnish.targets.runner.codes import modules
from burnish.targets.runner.routes import ROUTES
from burnish.targets.toolchain import Job, Toolchain, Verdict

from ..frames.kit import EXAMPLES as FRAMES
from ..frames.kit import LACKING as LACKING_OF_FRAMES
from ..suite.verdicts import refused
from ..targets.standings import PROFILES
from .kit import EXAMPLES, VARIANTS, Variant, jobs_of

OF_ROUTES = {route.compiler for route in ROUTES.values()}
"""The checkers that compile for routes, by which every example is drawn as well."""


def jobs(result: CompileResult) -> Iterator[Job]:
    for material in result.materials:
        yield from jobs_of(material)


def check_accepted(result: CompileResult, toolchain: Toolchain) -> None:
    assert not result.diagnostics
    assert result.materials
    asked = list(jobs(result))
    made = modules([job for job in asked if job.checker in OF_ROUTES], toolchain)
    found = refused([job for job in asked if job.checker not in OF_ROUTES], toolchain)
    found += [each for each in made.values() if isinstance(each, Verdict)]
    assert not found, "\n".join(verdict.report() for verdict in found)
    wanted = sum(
        len(material.staged.program.stages) * (len(PROFILES) - len(material.lacking))
        for material in result.materials
    )
    assert len(asked) >= wanted


@pytest.mark.parametrize("variant", VARIANTS, ids=str)
def test_accepted(variant: Variant, toolchain: Toolchain) -> None:
    check_accepted(variant.compile(), toolchain)


@pytest.mark.parametrize("path", FRAMES, ids=lambda path: path.stem)
def test_frames_are_accepted(path: Path, toolchain: Toolchain) -> None:
    """Each frame, for all profiles that can do what it shows."""
    result = burnish.compile(path, PROFILES, partial=True)
    lacking = {name for material in result.materials for name in material.lacking}
    assert lacking == LACKING_OF_FRAMES.get(path.stem, frozenset())
    check_accepted(result, toolchain)


def test_every_example_is_tried() -> None:
    assert {variant.path for variant in VARIANTS} == set(EXAMPLES)


@pytest.mark.parametrize("variant", VARIANTS, ids=str)
def test_only_profiles_that_lack_something_are_left_out(variant: Variant) -> None:
    for material in variant.compile():
        assert material.lacking.keys() == variant.lacking(material.name), material.name
