"""Every example compiles for every target, and the real front ends take the texts."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
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


@dataclass(frozen=True, slots=True)
class Compiled:
    """A variant of an example, and all that it comes to."""

    variant: Variant
    result: CompileResult


@pytest.fixture(scope="module", params=VARIANTS, ids=str)
def compiled(request: pytest.FixtureRequest) -> Compiled:
    """Each variant; tests of one variant follow each other, so that it is compiled once."""
    return Compiled(request.param, request.param.compile())


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


def test_accepted(compiled: Compiled, toolchain: Toolchain) -> None:
    check_accepted(compiled.result, toolchain)


def test_only_profiles_that_lack_something_are_left_out(compiled: Compiled) -> None:
    for material in compiled.result:
        lacking = compiled.variant.lacking(material.name)
        assert material.lacking.keys() == lacking, material.name


@pytest.mark.parametrize("path", FRAMES, ids=lambda path: path.stem)
def test_frames_are_accepted(path: Path, toolchain: Toolchain) -> None:
    """Each frame, for all profiles that can do what it shows."""
    result = burnish.compile(path, PROFILES, partial=True)
    lacking = {name for material in result.materials for name in material.lacking}
    assert lacking == LACKING_OF_FRAMES.get(path.stem, frozenset())
    check_accepted(result, toolchain)


def test_every_example_is_tried() -> None:
    assert {variant.path for variant in VARIANTS} == set(EXAMPLES)
