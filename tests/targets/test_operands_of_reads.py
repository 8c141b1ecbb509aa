"""Real front ends take reads and derivatives whose operands choose, loop, or call a function.

SPIR-V wants a read in the block in which texture and sampler were joined, and a compiler may begin
a new block for each operation that leaves an operand out. So every operation that some language
writes as a choice stands here in every operand of every read.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import count, product

import pytest

import burnish
from burnish.compiler.ir.types import Scalar, TextureType, Type, Vector, scalar_kind
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.row import Builtin
from burnish.targets.toolchain import Job, Toolchain

from ..suite.verdicts import refused
from .kit import instances

CHOOSING = {
    "choice": "(if uv.x > {k} then sin(uv.y) else 2)",
    "branch": "(if uv.x > {k} then pow(sin(uv.x) + 2, pow(cos(uv.y) + 2, sin(uv.x + {k}))) else 2)",
    "and": "(if uv.x > {k} and sin(uv.y) > {k} then 1.5 else 0.5)",
    "or": "(if uv.x > {k} or sin(uv.y) > {k} then 1.5 else 0.5)",
    "index by a choice": "places[if uv.x > {k} and uv.y > {k} then 1 else 3].x",
    "index by a remainder": "places[(n + {n}) mod 5].y",
    "column": "m[if uv.x > {k} then 1 else 3].x",
    "element": "[uv.x, uv.y, {k}][if uv.x > {k} or uv.y > {k} then n mod 3 else 2]",
    "quotient": "(uv.x / (uv.y - {k}))",
    "quotient of integers": "float((n + {n}) / (n - {n}))",
    "power": "pow(uv.x - {k}, uv.y)",
    "root": "sqrt(uv.x - {k})",
    "direction": "normalize(uv - {k}).x",
    "smoothstep": "smoothstep(uv.x, uv.y, {k})",
    "remainder": "((uv.x - {k}) mod uv.y)",
    "inverse": "inverse(m * {k})[1].x",
    "loop": "(sum i in 0..n : uv.x * float(i) + {k})",
    "call": "bent(uv.x + {k})",
}  # fmt: skip
"""Expressions of type float. The numbers make each of them another one, as what is used twice has
a name anyway."""

HEAD = """
fn bent(x: float) -> float = sum i in 0..9 : sin(x * float(i))
material M {
    param places : vec4[8]
    param m      : mat4
    param n      : int in 0..9
"""
READS = [row for row in BUILTINS.values() if row.method is not None and row.parameters]
DERIVATIVES = [row for row in BUILTINS.values() if row.compares_pixels and row not in READS]


def operand(type_: Type, lane: str) -> str:
    """An operand of a type, of which one lane is the expression ``lane``."""
    kind = scalar_kind(type_)
    assert kind is not None
    value = lane if kind == "float" else f"{kind}({lane})"
    return value if isinstance(type_, Scalar) else f"{type_}({value})"


def uses(row: Builtin) -> Iterator[tuple[TextureType | None, str]]:
    """Uses of a builtin as floats, and the textures that they read: each choosing expression once
    in each operand."""
    numbers = count(1)
    for operands, result in shapes(row):
        texture = operands[0] if isinstance(operands[0], TextureType) else None
        given = operands[1:] if texture else operands
        for place, form in product(range(len(given) - len(row.constants)), CHOOSING.values()):
            n = next(numbers)
            lanes = ["uv.x"] * len(given)
            lanes[place] = form.format(k=n / 4096, n=n)
            arguments = [operand(*pair) for pair in zip(given, lanes, strict=True)]
            if row.constants:
                arguments[-1] = "1"
            name = f"t_{texture}.{row.method}" if row.method else f"t_{texture}"
            lane = ".x" if isinstance(result, Vector) else ""
            yield texture, f"float({name if texture else row.name}({', '.join(arguments)}){lane})"


def shapes(row: Builtin) -> Iterator[tuple[tuple[Type, ...], Type]]:
    """An instance for each number of operands: arrays of textures have one more."""
    found = {len(operands): (operands, result) for operands, result in instances(row)}
    yield from found.values()


def material(row: Builtin) -> str:
    """A material with all uses of a builtin."""
    textures, used = zip(*uses(row), strict=True)
    maps = "\n".join(f"    map t_{one} : {one}" for one in dict.fromkeys(textures) if one)
    return f"{HEAD}{maps}\n    alpha = {' + '.join(used)}\n}}"


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


@pytest.mark.parametrize("row", [*READS, *DERIVATIVES], ids=lambda row: row.name)
def test_operands_may_choose(row: Builtin, toolchain: Toolchain) -> None:
    jobs = [
        Job(checker, "frag", file.text, file.entry_points["fragment"], file.name)
        for found in burnish.compile(material(row), "all", partial=True).materials
        for file in found.files
        if "fragment" in file.entry_points
        for checker in file.checkers
    ]
    found = [verdict.report() for verdict in refused(jobs, toolchain)]
    assert jobs and not found, "\n".join(found)
