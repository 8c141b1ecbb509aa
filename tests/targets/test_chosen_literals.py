"""Real front ends take choices between two literals as operands of every builtin.

HLSL's literals have no type of their own: DXC takes a choice between two of them for a double, and
DXIL has no sine of one.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count

import burnish
from burnish.compiler.ir.types import Scalar
from burnish.stdlib.builtins import BUILTINS
from burnish.targets.toolchain import Job, Toolchain

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
    jobs = [
        Job(checker, "frag", file.text, file.entry_points["fragment"], file.name)
        for file in found.materials[0].files
        if "fragment" in file.entry_points
        for checker in file.checkers
    ]
    with Toolchain() as toolchain:
        verdicts = toolchain.check(jobs)
    refused = [verdict.report() for verdict in verdicts if verdict.status != "accepted"]
    assert jobs and not refused, "\n".join(refused)
