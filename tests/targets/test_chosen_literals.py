"""Real front ends take choices between two literals as operands of every builtin, and shifted ones.

HLSL's literals have no type of their own: DXC takes a choice between two of them for a double, and
DXIL has no sine of one.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count

import burnish
from burnish.api.compiled import CompileResult
from burnish.compiler.ir.types import Scalar
from burnish.stdlib.builtins import BUILTINS
from burnish.targets.toolchain import Job, Toolchain, Verdict

from .kit import instances

SIDES = {"float": "1.5 else 0.25", "int": "3 else -2", "uint": "uint(3) else uint(2)"}


def uses() -> Iterator[str]:
    """Each builtin of numbers with a choice as every operand, as a float."""
    numbers = count(1)
    for row in BUILTINS.values():
        if not (row.operator or row.method is not None or row.constants or row.of_group):
            for operands, result in instances(row):
                kinds = [type_.kind for type_ in operands if isinstance(type_, Scalar)]
                if len(kinds) == len(operands) and SIDES.keys() >= set(kinds):
                    chosen = ", ".join(
                        f"if uv.x > {next(numbers) / 4096} then {SIDES[kind]}" for kind in kinds
                    )
                    lane = "" if isinstance(result, Scalar) else ".x"
                    yield f"float({row.name}({chosen}){lane})"


def test_choices_between_literals() -> None:
    found = burnish.compile(f"material M {{ alpha = {' + '.join(uses())} }}", "all", partial=True)
    refused = [one.report() for one in verdicts(found) if one.status != "accepted"]
    assert not refused, "\n".join(refused)


def test_shifted_literals() -> None:
    """DXC remarks that it does not know how wide a shifted literal is."""
    text = "material M { n = int(8 * uv.x) alpha = float((1 << n) + n) + float((-2 >> n) - n) }"
    found = burnish.compile(text, "all", partial=True)
    assert "(int(1) << n) + n" in found["M"].text("hlsl", "fragment")
    assert "(int(-2) >> n) - n" in found["M"].text("hlsl", "fragment")
    assert "int(1)" not in found["M"].text("glsl:vulkan", "fragment")
    assert [one.log for one in verdicts(found) if one.status != "accepted" or one.messages] == []


def verdicts(found: CompileResult) -> list[Verdict]:
    """The verdicts of the real front ends about the fragment shaders."""
    jobs = [
        Job(checker, "frag", file.text, file.entry_points["fragment"], file.name)
        for file in found.materials[0].files
        if "fragment" in file.entry_points
        for checker in file.checkers
    ]
    assert jobs
    with Toolchain() as toolchain:
        return list(toolchain.check(jobs))
