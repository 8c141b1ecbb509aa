"""A binding whose derived block has the value of every builtin, for each type of its operands."""

from __future__ import annotations

import math
import random
import struct
from functools import cache
from typing import Any, NamedTuple

from burnish.bindings.blocks import computing
from burnish.bindings.derivation import Values
from burnish.bindings.fields import Field, Numbers, Structure
from burnish.bindings.helpers import Helpers
from burnish.bindings.model import Binding, Block, Derivation, Source
from burnish.bindings.statements import Place
from burnish.compiler.reference.functions import evaluate
from burnish.stdlib.builtins.overloads import COMPUTING, Shape, overloads

FLOATS = (0.0, 1.0, -1.0, 0.5, -0.75, 2.0, 3.5, -2.5, 1e-38, 1e-42, 7e9, -3e20, 100.0, -0.0)
WHOLE = (0, 1, 2, 3, 7, 31, 32, 255, 65535, 2**31 - 1)
ROUNDS = 6


class Called(NamedTuple):
    """One overload: its operands, and the field of its result."""

    function: str
    kind: Any
    operands: tuple[tuple[Field, Shape], ...]
    result: Field


@cache
def every_builtin() -> tuple[Binding, tuple[Called, ...]]:
    """The binding, and what it computes."""
    helpers = Helpers()
    fields: list[Field] = []
    results: list[Field] = []
    rows: list[Called] = []
    for row in COMPUTING:
        for overload in overloads(row):
            operands = tuple(
                (_field(f"{row.name}_{len(rows)}_{at}", shape, fields), shape)
                for at, shape in enumerate(overload.operands)
            )
            result = _field(f"{row.name}_{len(rows)}", overload.result, results, computed=True)
            rows.append(Called(row.name, overload.operands[0].kind, operands, result))
    values = Values({field.name: ("Operands", field) for field in fields}, helpers, {})
    plain = []
    for each in rows:
        given = [values.parameter(field.name) for field, _ in each.operands]
        found = values.applied(each.function, each.kind, given)
        plain.append((Place(block="Results", way=(each.result.word,)), each.result, found))
    taken = Structure(name="Operands", size=_end(fields), fields=tuple(fields))
    computed = Structure(name="Results", size=_end(results), fields=tuple(results))
    derivation = Derivation(
        sources=(Source(plain_name="Operands", name="Operands"),),
        statements=computing(plain, (), {}),
    )
    blocks = (
        Block(structure=taken, plain_name="Operands", group="draw", layout_id="1"),
        Block(
            structure=computed, plain_name="Results", group="draw", layout_id="2",
            derivation=derivation,
        ),
    )  # fmt: skip
    binding = Binding(
        sources=(), namespace="builtins", structures=(), blocks=blocks, helpers=helpers.found,
        materials=(),
    )  # fmt: skip
    return binding, tuple(rows)


def _field(word: str, shape: Shape, fields: list[Field], *, computed: bool = False) -> Field:
    truth = shape.kind == "bool"
    stored = 4 if shape.columns else shape.width
    kind: Any = "uint" if truth else shape.kind
    type_ = Numbers(
        kind=kind, truth=truth, lanes=shape.width,
        columns=shape.columns, stored_lanes=stored,
    )  # fmt: skip
    field = Field(name=word, word=word, type=type_, offset=_end(fields), computed=computed)
    fields.append(field)
    return field


def _end(fields: list[Field]) -> int:
    return fields[-1].offset + -(-fields[-1].size // 16) * 16 if fields else 0


def operands(seed: int) -> dict[str, Any]:
    """Values of all operands by their words: edges, and numbers between them."""
    _, rows = every_builtin()
    chance = random.Random(seed)
    return {field.word: _value(shape, chance) for row in rows for field, shape in row.operands}


def _value(shape: Shape, chance: random.Random) -> Any:
    if shape.columns:
        return tuple(_value(Shape(shape.kind, shape.width), chance) for _ in range(shape.columns))
    return tuple(_lane(shape, chance) for _ in range(shape.width))


def _lane(shape: Shape, chance: random.Random) -> Any:
    if shape.kind == "bool":
        return chance.random() < 0.5
    if shape.kind == "float":
        wish = chance.choice((*FLOATS, chance.uniform(-4, 4)))
        return struct.unpack("<f", struct.pack("<f", wish))[0]
    wish = chance.choice(WHOLE)
    return -wish if shape.kind == "int" and chance.random() < 0.5 else wish


def expected(row: Called, values: dict[str, Any]) -> list[Any]:
    """The lanes of a builtin's value, column by column, as a block stores them."""
    found = evaluate(row.function, [values[f.word] for f, _ in row.operands], kind=row.kind)
    lanes = [x for each in found for x in (each if isinstance(each, tuple) else (each,))]
    return [_stored(x, row.result) for x in lanes]


def _stored(lane: Any, field: Field) -> Any:
    assert isinstance(field.type, Numbers)
    if field.type.kind != "float":
        return int(lane) & 0xFFFFFFFF
    try:
        return struct.unpack("<f", struct.pack("<f", lane))[0]
    except OverflowError:
        return math.copysign(math.inf, lane)


def stored(row: Called, block: bytes) -> list[Any]:
    """The lanes of a value in the bytes of the block of results."""
    kind = row.result.type
    assert isinstance(kind, Numbers)
    code = "f" if kind.kind == "float" else "I"
    found: list[Any] = []
    for column in range(kind.columns or 1):
        at = row.result.offset + 4 * kind.stored_lanes * column
        found += struct.unpack_from(f"<{kind.lanes}{code}", block, at)
    return found


def is_close(one: Any, other: Any) -> bool:
    """True for equal numbers, for neighbours, and if both are no numbers."""
    if isinstance(one, int) or isinstance(other, int):
        return bool(one == other)
    if math.isnan(one) or math.isnan(other):
        return math.isnan(one) and math.isnan(other)
    return one == other or math.isclose(one, other, rel_tol=3e-7, abs_tol=1e-37)
