"""Every overload of every builtin that computes, and programs in which several are called.

An overload's operands are read from textures of float32 and of integers, texel by texel, so that
every device has exactly the same numbers. ``programs`` puts as many overloads into a program as
its render targets have lanes for: drawing one more sample is cheap, one more pipeline is not.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

from burnish.stdlib.builtins import BUILTINS, Builtin

TARGETS = 8
LANES = 4 * TARGETS
"""Numbers that a program can return for each sample."""

_PREFIXES = {"float": "", "int": "i", "uint": "u", "bool": "b"}
_FAMILIES: dict[str, tuple[str, ...]] = {
    "T": ("float",), "V": ("float",), "N": ("float", "int", "uint"), "I": ("int", "uint"),
    "B": ("bool",), "P": ("float", "int", "uint", "bool"),
}  # fmt: skip
_SAME_WIDTH = {"Q": "bool", "U": "uint", "J": "int"}
_WORDS = {"and": "and", "or": "or", "not": "not ", "mod": "mod"}
_CONSTRUCTORS = {"to_float": "float", "to_int": "int", "to_uint": "uint"}


@dataclass(frozen=True)
class Shape:
    """A type: lanes of a kind, in columns if it is a matrix."""

    kind: str
    width: int
    columns: int = 0

    def __str__(self) -> str:
        if self.columns:
            return f"mat{self.width}"
        return self.kind if self.width == 1 else f"{_PREFIXES[self.kind]}vec{self.width}"

    @property
    def lanes(self) -> int:
        """All lanes there are."""
        return self.width * max(self.columns, 1)


@dataclass(frozen=True)
class Overload:
    """A builtin with the types of its operands and of its result."""

    row: Builtin
    operands: tuple[Shape, ...]
    result: Shape

    def __str__(self) -> str:
        return f"{self.row.name}({', '.join(map(str, self.operands))})"

    def map(self, number: int) -> int:
        """The first texture of an operand. Beside matrices each has four, one for each column, so
        that no operand is read from the same texture as another one."""
        return number * (4 if any(shape.columns for shape in self.operands) else 1)

    def call(self, operands: Sequence[str]) -> str:
        """The builtin as it is written."""
        name = self.row.name
        if name in _CONSTRUCTORS:
            shape = Shape(_CONSTRUCTORS[name], self.operands[0].width)
            return f"{shape}({operands[0]})"
        if self.row.operator:
            sign = _WORDS.get(name, self.row.operator)
            return f"{sign}{operands[0]}" if len(operands) == 1 else f" {sign} ".join(operands)
        return f"{name}({', '.join(operands)})"


def overloads(row: Builtin) -> Iterator[Overload]:
    """All overloads of a builtin. A pair of equal types stands for every pair of them."""
    seen = set()
    for signature in row.signatures:
        operands, result = signature.split(" -> ")
        words = [*operands.split(", "), result]
        for kind, width in _choices(words):
            shapes = [_shape(word, kind, width) for word in words]
            found = Overload(row, tuple(shapes[:-1]), shapes[-1])
            if str(found) not in seen:
                seen.add(str(found))
                yield found


def _choices(words: Sequence[str]) -> list[tuple[str, int]]:
    """The kinds and widths for which the letters of a signature can stand."""
    letters = {word for word in words if len(word) == 1}
    if not letters:
        return [("float", 1)]
    narrowest = 2 if letters & {"V", "M"} else 1
    kinds = next((_FAMILIES[letter] for letter in letters if letter in _FAMILIES), ("float",))
    return list(product(kinds, range(narrowest, 5)))


def _shape(word: str, kind: str, width: int) -> Shape:
    if word in _SAME_WIDTH:
        return Shape(_SAME_WIDTH[word], width)
    if word == "M":
        return Shape("float", width, width)
    if word in ("S", "L"):
        return Shape(kind, 1)
    if word == "C":
        return Shape("float", width)
    if word in _FAMILIES:
        return Shape(kind, width)
    (prefix, form, size) = re.fullmatch(r"([iub]?)(vec|mat)?(\w+)", word).groups()  # type: ignore
    if form is None:
        return Shape(word, 1)
    lanes = int(size)
    named = {short: long for long, short in _PREFIXES.items()}[prefix]
    return Shape(named, lanes, lanes if form == "mat" else 0)


COMPUTING = tuple(
    row for row in BUILTINS.values() if row.method is None and not row.uniform_control_flow
)
"""The builtins whose results depend on their operands only."""

# --- programs -------------------------------------------------------------------------------------

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
    """Where the number of one lane of a result is in the targets."""

    overload: Overload
    lane: int


@dataclass(frozen=True)
class Program:
    """A text that calls overloads, and what each of its targets' lanes is."""

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
        call = overload.call(
            [_operand(overload.map(k), s) for k, s in enumerate(overload.operands)]
        )
        lines.append(f"    r{place} = {call}")
        numbers += _numbers(f"r{place}", overload.result)
        lanes += [Lane(overload, lane) for lane in range(overload.result.lanes)]
    lines += ["}", "", "pass Returned {", "    clip_position = vec4(vertex_position, 1)"]
    for target, start in enumerate(range(0, len(numbers), 4)):
        four = [*numbers[start : start + 4], "0", "0", "0"][:4]
        lines.append(f"    target t{target} : rgba32f = vec4({', '.join(four)})")
    return Program("\n".join([*lines, "}", ""]), tuple(lanes))


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
    lanes = [name]
    if shape.columns:
        lanes = [
            f"{name}[{c}].{lane}" for c in range(shape.columns) for lane in "xyzw"[: shape.width]
        ]
    elif shape.width > 1:
        lanes = [f"{name}.{lane}" for lane in "xyzw"[: shape.width]]
    for lane in lanes:
        if shape.kind == "float":
            yield lane
        else:
            yield f"float({lane})" if shape.kind == "bool" else f"folded({lane})"
