"""No pass changes what a random program means, and every backend and front end takes it."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import HealthCheck, given, note, reject, settings
from hypothesis import strategies as st

import burnish
from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.passes.pipeline import Options
from burnish.targets import registry
from burnish.targets.toolchain import Job, Toolchain

from .agreement import disagreements
from .kit import World, shader
from .programs import programs

SLOW = (HealthCheck.too_slow, HealthCheck.data_too_large, HealthCheck.filter_too_much)
TARGETS = [
    f"{target.name}:{profile.name}"
    for target in map(registry.load, registry.names())
    for profile in target.profiles
]
MISTAKES = {each.code for each in (rules.ZERO_DIVISOR, rules.OUT_OF_BOUNDS, rules.NUMBER_TOO_LARGE)}
"""What is wrong with some of the programs, since constants are drawn too."""


@settings(max_examples=60, suppress_health_check=SLOW)
@given(text=programs(), seed=st.integers(0, 2**16), hoist=st.booleans())
def test_random_programs_keep_their_value(text: str, seed: int, hoist: bool) -> None:
    note(text)
    worlds = [World(seed), World(seed, traps=True)]
    try:
        given_shader = shader(text)
    except CompileError as error:
        _only_mistakes(error)
        reject()
    assert not disagreements(given_shader, worlds, Options(hoist)), text


@settings(max_examples=30, suppress_health_check=SLOW)
@given(text=programs())
def test_random_programs_compile_for_every_target(text: str) -> None:
    note(text)
    try:
        compiled = burnish.compile(text, TARGETS)
    except CompileError as error:
        _only_mistakes(error)
        reject()
    assert compiled.materials[0].reflection


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


@settings(max_examples=2, suppress_health_check=list(HealthCheck))
@given(texts=st.lists(programs(), min_size=3, max_size=3))
def test_random_programs_are_accepted(texts: list[str], toolchain: Toolchain) -> None:
    jobs: list[Job] = []
    for text in texts:
        try:
            jobs += _jobs(text)
        except CompileError as error:
            _only_mistakes(error)
    refused = [
        f"{verdict.report()}\n{verdict.job.name}\n{verdict.job.text}"
        for verdict in toolchain.check(jobs)
        if verdict.status != "accepted"
    ]
    assert not refused, "\n".join(refused)


def _jobs(text: str) -> Iterator[Job]:
    for file in burnish.compile(text, TARGETS).materials[0].files:
        for stage, entry in file.entry_points.items():
            for checker in file.checkers:
                yield Job(checker, stage[:4], file.text, entry, f"{file.name} of\n{text}")


def _only_mistakes(error: CompileError) -> None:
    unexpected = [d for d in error.diagnostics if d.rule.code not in MISTAKES]
    assert not unexpected, [f"{d.message} {d.span}" for d in unexpected]
