"""Real compilers take the functions of all examples, called from trivial entry points."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.api.compiled_functions import CompiledFunctions
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.targets.toolchain import Toolchain

from ..suite.verdicts import refused
from .callers import jobs

EXAMPLES = Path(__file__).parents[2] / "examples"
FILES = sorted(EXAMPLES.glob("*.burnish"))
TARGETS = ("wgsl", "glsl", "glsl:es300", "glsl:gl330", "hlsl")
WITHOUT = {"B0904", "B0905", "B0906", "B0206", "B0701"}
"""Why a file has no functions: buffers place its vertices, it makes vertices, needs lights, has no
material, or a profile cannot have it."""
GROUPS = 4


def made(file: Path, *, together: bool) -> list[CompiledFunctions]:
    try:
        return list(burnish.functions(file, TARGETS, together=together))
    except CompileError as error:
        codes = {found.rule.code for found in error.diagnostics if found.severity == "error"}
        assert codes <= WITHOUT, file.name
        return []


@pytest.mark.parametrize("group", range(GROUPS))
def test_functions_of_examples_are_accepted(group: int) -> None:
    found = [
        each
        for number, file in enumerate(FILES[group::GROUPS])
        for each in made(file, together=number % 2 == 0)
    ]
    assert len(found) > 10
    asked = [job for each in found for job in jobs(each)]
    with Toolchain() as toolchain:
        wrong = [
            f"{verdict.job.checker} {verdict.job.name}: {verdict.messages[:3]}"
            for verdict in refused(asked, toolchain)
        ]
    assert not wrong, "\n".join(wrong)


def test_lights_are_arguments_where_a_rig_is_named() -> None:
    found = burnish.functions(
        EXAMPLES / "plastic.burnish", TARGETS, rig="Studio", slots=["color", "object_position"]
    )
    asked = [job for each in found for job in jobs(each)]
    with Toolchain() as toolchain:
        assert not [(v.job.name, v.messages[:3]) for v in refused(asked, toolchain)]
    (document,) = (each.document for each in found)
    assert document.rig == "Studio"
    lamps = next(row for row in document.arguments if row.name == "lamps")
    assert (lamps.representation, lamps.group) == ("Point[8]", "rig")
    assert [member.name for member in lamps.members] == ["diffuse_color", "specular_color", "place"]
