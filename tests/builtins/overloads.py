"""Programs in which several overloads of builtins are called.

An overload's operands are read from textures of float32 and of integers, texel by texel, so that
every device has exactly the same numbers. ``programs`` puts as many overloads into a program as
its render targets have lanes for: drawing one more sample is cheap, one more pipeline is not.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from burnish.stdlib.builtins.overloads import Overload, Shape

TARGETS = 8
LANES = 4 * TARGETS
"""Numbers that a program can return for each sample."""

_WORDS = {"and": "and", "or": "or", "not": "not ", "mod": "mod"}
_CONSTRUCTORS = {"to_float": "float", "to_int": "int", "to_uint": "uint"}

FLOAT_MAPS, INT_MAPS = 8, 4
"""The textures of operands: one for each operand, or for each column of two matrices."""

_HEAD = """burnish 1

/// The bits of an integer, folded into 24 that a float holds.
fn folded(u: uint) -> float = float((u ^ (u >> 11)) & 0xFFFFFFu)

fn folded(i: int) -> float = folded(uint(i))

material Cells {
"""
_SWIZZLES = ("", "x", "xy", "xyz", "xyzw")


@dataclass(frozen=True)
class Lane:
    """The content of one lane of the targets: the number of a lane of an overload's result."""

    overload: Overload
    lane: int


@dataclass(frozen=True)
class Program:
    """A text that calls overloads, and the contents of its targets' lanes."""

    text: str
    lanes: tuple[Lane, ...]

    def __str__(self) -> str:
        names = list(dict.fromkeys(lane.overload.row.name for lane in self.lanes))
        return " ".join(names)


def programs(wanted: Sequence[Overload]) -> tuple[Program, ...]:
    """Programs that together call each of these overloads once."""
    found: list[Program] = []
    batch: list[Overload] = []
    for overload in wanted:
        if sum(each.result.lanes for each in (*batch, overload)) > LANES:
            found.append(_program(batch))
            batch = []
        batch.append(overload)
    return (*found, _program(batch))


def _program(batch: Sequence[Overload]) -> Program:
    lines = [_HEAD]
    lines += [f"    map f{number} : texture2d" for number in range(FLOAT_MAPS)]
    lines += [f"    map i{number} : itexture2d" for number in range(INT_MAPS)]
    lines += ["    at = ivec2(frag_coord.xy)"]
    lines += [f"    a{number} = f{number}.load(at, 0)" for number in range(FLOAT_MAPS)]
    lines += [f"    n{number} = i{number}.load(at, 0)" for number in range(INT_MAPS)]
    numbers: list[str] = []
    lanes: list[Lane] = []
    for place, overload in enumerate(batch):
        operands = [_operand(first_map(overload, k), s) for k, s in enumerate(overload.operands)]
        written = call(overload, operands)
        lines.append(f"    r{place} = {written}")
        numbers += _numbers(f"r{place}", overload.result)
        lanes += [Lane(overload, lane) for lane in range(overload.result.lanes)]
    lines += ["}", "", "pass Returned {", "    clip_position = vec4(vertex_position, 1)"]
    for target, start in enumerate(range(0, len(numbers), 4)):
        four = [*numbers[start : start + 4], "0", "0", "0"][:4]
        lines.append(f"    target t{target} : rgba32f = vec4({', '.join(four)})")
    return Program("\n".join([*lines, "}", ""]), tuple(lanes))


def first_map(overload: Overload, operand: int) -> int:
    """The first texture of an operand. Beside matrices each has four, one for each column, so
    that no operand is read from the same texture as another one."""
    return operand * (4 if any(shape.columns for shape in overload.operands) else 1)


def call(overload: Overload, operands: Sequence[str]) -> str:
    """A builtin as it is written."""
    name = overload.row.name
    if name in _CONSTRUCTORS:
        shape = Shape(_CONSTRUCTORS[name], overload.operands[0].width)
        return f"{shape}({operands[0]})"
    if overload.row.operator:
        sign = _WORDS.get(name, overload.row.operator)
        return f"{sign}{operands[0]}" if len(operands) == 1 else f" {sign} ".join(operands)
    return f"{name}({', '.join(operands)})"


def _operand(first: int, shape: Shape) -> str:
    """The text of an operand, read from the textures that begin with this one."""
    swizzle = _SWIZZLES[shape.width]
    if shape.columns:
        columns = [f"a{first + column}.{swizzle}" for column in range(shape.columns)]
        return f"{shape}({', '.join(columns)})"
    if shape.kind == "float":
        return f"a{first}.{swizzle}"
    if shape.kind == "bool":
        return f"(n{first}.{swizzle} & 1 == 1)"
    read = f"n{first}.{swizzle}"
    return read if shape.kind == "int" else f"{shape}({read})"


def _numbers(name: str, shape: Shape) -> Iterator[str]:
    """The lanes of a result, as floats."""
    for lane in lane_names(name, shape):
        if shape.kind == "float":
            yield lane
        else:
            yield f"float({lane})" if shape.kind == "bool" else f"folded({lane})"


def lane_names(name: str, shape: Shape) -> list[str]:
    """The lanes of a value as they are written, those of a matrix column by column."""
    if shape.columns:
        return [
            f"{name}[{c}].{lane}" for c in range(shape.columns) for lane in "xyzw"[: shape.width]
        ]
    return [f"{name}.{lane}" for lane in "xyzw"[: shape.width]] if shape.width > 1 else [name]
