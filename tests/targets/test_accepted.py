"""The real front ends take what the backends write. The tools are those of ``make tools``."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

import burnish
from burnish.compiler.ir.program import Program
from burnish.targets.emit.emitter import EmitOptions
from burnish.targets.toolchain import Job, Toolchain

from ..suite.verdicts import refused
from .kit import PROFILES, Selected, can_have, printed, program_of_rows
from .programs import odd, plastic
from .test_names import program_of_words

STAGES = {"vertex": "vert", "fragment": "frag"}


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


def words(selected: Selected) -> Program:
    return program_of_words(sorted(selected.language.reserved().words))


def programs(selected: Selected) -> list[Program]:
    given = [plastic(), odd(), program_of_rows(selected.profile), words(selected)]
    return [program for program in given if can_have(selected, program)]


def jobs(selected: Selected, program: Program) -> Iterator[Job]:
    profile = selected.profile
    for single in (False, True) if profile.single_file else (False,):
        options = EmitOptions(single_file=single)
        for file in printed(program, selected, options).files:
            for stage, entry in file.entries.items():
                for checker in profile.checkers:
                    name = f"{selected} {program.shader.name}"
                    yield Job(checker, STAGES[stage], file.text, entry, name)


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_accepted(selected: Selected, toolchain: Toolchain) -> None:
    asked = [job for program in programs(selected) for job in jobs(selected, program)]
    found = [
        f"{verdict.job.checker}, {verdict.job.stage} of {verdict.job.name}: {verdict.messages[:3]}"
        for verdict in refused(asked, toolchain)
    ]
    assert not found, "\n".join(found)


@pytest.mark.parametrize("kind", ["float", "int", "vec2", "rgb", "vec4", "mat3"])
@pytest.mark.parametrize("length", [1, 2, 3])
def test_an_array_of_a_whole_block(toolchain: Toolchain, kind: str, length: int) -> None:
    """DXC read the block at the computed place, where SPIR-V knows none."""
    names = [f"part_{number}" for number in range(length)]
    members = "\n".join(f"param {name} : {kind}" for name in names)
    text = f"material M {{ {members}\n part = [{', '.join(names)}][int(uv.x * 3)]\n"
    lane = {"mat3": "part[0].x", "float": "part", "int": "float(part)"}.get(kind, "part.x")
    made = burnish.compile(f"{text} color = vec3({lane}) }}", "hlsl").materials[0]
    asked = [
        Job(checker, "frag", file.text, file.entry_points["fragment"], file.name)
        for file in made.files
        if file.stage == "fragment"
        for checker in file.checkers
    ]
    assert asked
    assert not [verdict.messages for verdict in refused(asked, toolchain)]


NUMBERS = ("0.7", "-0.0", "1e-39", "-1e-45", "1.1754944e-38", "-1.1754942e-38", "3.4028235e38")


def test_numbers_at_the_ends_of_the_range(toolchain: Toolchain) -> None:
    """DXC crashed where both sides of a choice are numbers, and one of them is subnormal."""
    chosen = [f"(if front_facing then {a} else {b})" for a in NUMBERS for b in NUMBERS if a != b]
    made = burnish.compile(f"material M {{ alpha = {' + '.join(chosen)} }}", "all").materials[0]
    asked = [
        Job(checker, "frag", file.text, file.entry_points["fragment"], file.name)
        for file in made.files
        if file.stage == "fragment"
        for checker in file.checkers
    ]
    found = [each.report() for each in refused(asked, toolchain)]
    assert asked and not found, "\n".join(found)
