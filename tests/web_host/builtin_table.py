"""Writes the host's table of builtins: what each means, as the reference says it.

``generated.py`` puts it into the tree. Each overload is asked for its value once, with the names of
its operands' lanes (``tracing.py``).
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from burnish.compiler.reference.functions import WHOLE, evaluate
from burnish.stdlib.builtins import Builtin

from ..builtins.overloads import COMPUTING, Overload, Shape, overloads
from .tracing import Tracing, function, made, wrapped

_HEAD = """
/** A number is one lane; a vector its lanes; a matrix its columns. Truth is 1 or 0. */
export type Lanes = number[] | number[][];
export type Kind = "float" | "int" | "uint" | "bool";

/** The nearest whole number, and the even one in the middle between two. */
function nearest(x: number): number {
  const found = Math.round(x);
  return Math.abs(x % 1) === 0.5 && found % 2 !== 0 ? found - 1 : found;
}

/** The remainder of the quotient rounded down; it has the sign of `y`. */
function remainder(x: number, y: number): number {
  const rest = x % y;
  return rest !== 0 && rest < 0 !== y < 0 ? rest + y : rest;
}

const whole = (x: number) => (Number.isFinite(x) ? Math.trunc(x) : 0);

/** The exponent of a number whose fraction is at least a half and below one. */
function exponentOf(x: number): number {
  if (x === 0) return 0;
  const found = Math.floor(Math.log2(Math.abs(x))) + 1;
  // Logarithms are rounded.
  const fraction = Math.abs(x) / 2 ** found;
  return fraction >= 1 ? found + 1 : fraction < 0.5 ? found - 1 : found;
}

const fractionOf = (x: number) => x / 2 ** exponentOf(x);
"""

_LETTERS = "xyzw"


def table() -> str:
    """The module of TypeScript, not yet laid out."""
    single = dict(_lanewise())
    whole = dict(_whole())
    return (
        f"{_HEAD}\n"
        "/** Functions that work lane by lane, by name and the type of the operands' lanes. */\n"
        f"export const LANEWISE: Record<string, (...lanes: number[]) => number> = {_rows(single)}\n"
        "/** Other functions, by name, this type, and the lanes of each operand. */\n"
        f"export const WHOLE: Record<string, (...operands: any[]) => Lanes> = {_rows(whole)}"
    )


def _rows(texts: dict[str, str]) -> str:
    return "{" + ",\n".join(f'"{key}": {text}' for key, text in texts.items()) + "};\n"


def _lanewise() -> Iterator[tuple[str, str]]:
    for row in COMPUTING:
        for overload in overloads(row):
            if not _is_whole(row, overload):
                kind: Any = overload.operands[0].kind
                names = [_LETTERS[at] for at, _ in enumerate(overload.operands)]
                lanes = [
                    (made(name, kind=_kind(shape), is_natural=shape.kind in ("uint", "bool")),)
                    for name, shape in zip(names, overload.operands, strict=True)
                ]
                (found,) = _stored(overload, evaluate(row.name, lanes, Tracing(), kind))
                yield f"{row.name} {kind}", function(", ".join(names), found)


def _whole() -> Iterator[tuple[str, str]]:
    for row in COMPUTING:
        for overload in overloads(row):
            if _is_whole(row, overload):
                kind: Any = overload.operands[0].kind
                letters = _LETTERS[: len(overload.operands)]
                pairs = list(zip(letters, overload.operands, strict=True))
                values = [_value(*each) for each in pairs]
                found = _stored(overload, evaluate(row.name, values, Tracing(), kind))
                shapes = " ".join(_written(shape) for _, shape in pairs)
                yield f"{row.name} {kind} {shapes}", function(", ".join(letters), found)


def _stored(overload: Overload, found: tuple[Any, ...]) -> tuple[Any, ...]:
    """A result as it is kept: numbers of ``uint`` without a sign."""
    if overload.result.kind != "uint":
        return found
    return tuple(lane if wrapped(lane).is_natural else lane & 0xFFFFFFFF for lane in found)


def _is_whole(row: Builtin, overload: Overload) -> bool:
    has_columns = any(shape.columns for shape in overload.operands)
    return row.name in WHOLE or row.name == "dot" or has_columns


def _value(name: str, shape: Shape) -> tuple[Any, ...]:
    """The lanes of an operand."""
    if shape.columns:
        column = Shape(shape.kind, shape.width)
        return tuple(_value(f"{name}[{at}]", column) for at in range(shape.columns))
    kind = _kind(shape)
    is_natural = shape.kind in ("uint", "bool")
    return tuple(
        made(f"{name}[{at}]", kind=kind, is_natural=is_natural) for at in range(shape.width)
    )


def _kind(shape: Shape) -> Any:
    return "int" if shape.kind in ("int", "uint") else "float"


def _written(shape: Shape) -> str:
    return f"{shape.columns}x{shape.width}" if shape.columns else f"{shape.width}"
