"""Makes the host's table of builtins: JavaScript functions that compute what the reference does.

``modules.py`` gives it to pages as the module ``generated/builtins.js``, and ``generate.py`` has it
made when the package is built. Each overload is evaluated once, with the names of its operands'
lanes (``compiler/tracing.py``), and printed by ``javascript.py``.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

from ....compiler.precomputed import Precomputations, key, precomputed
from ....compiler.reference.functions import WHOLE, evaluate
from ....compiler.tracing import Tracing, given, wrapped
from ....stdlib.builtins import Builtin
from ....stdlib.builtins.overloads import COMPUTING, Overload, Shape, overloads
from .javascript import function

_HEAD = """\
// The builtins, generated from compiler/reference by burnish.targets.web_host.serving.

/**
 * A number is one lane; a vector its lanes; a matrix its columns. Truth is 1 or 0.
 * @typedef {number[] | number[][]} Lanes
 */
/** @typedef {"float" | "int" | "uint" | "bool"} Kind */

/**
 * The nearest whole number, and the even one in the middle between two.
 * @param {number} x
 */
function nearest(x) {
  const found = Math.round(x);
  return Math.abs(x % 1) === 0.5 && found % 2 !== 0 ? found - 1 : found;
}

/**
 * The remainder of the quotient rounded down; it has the sign of `y`.
 * @param {number} x
 * @param {number} y
 */
function remainder(x, y) {
  const rest = x % y;
  return rest !== 0 && rest < 0 !== y < 0 ? rest + y : rest;
}

/** @type {(x: number) => number} */
const whole = (x) => (Number.isFinite(x) ? Math.trunc(x) : 0);

/**
 * The exponent of a number whose fraction is at least a half and below one.
 * @param {number} x
 */
function exponentOf(x) {
  if (x === 0) return 0;
  const found = Math.floor(Math.log2(Math.abs(x))) + 1;
  // Logarithms are rounded.
  const fraction = Math.abs(x) / 2 ** found;
  return fraction >= 1 ? found + 1 : fraction < 0.5 ? found - 1 : found;
}

/** @type {(x: number) => number} */
const fractionOf = (x) => x / 2 ** exponentOf(x);
"""

_LANEWISE = """
/**
 * Functions that work lane by lane, by name and the type of the operands' lanes.
 * @type {Record<string, (...lanes: number[]) => number>}
 */
export const LANEWISE = """

_OF_WHOLE = """
/**
 * Other functions, by name, this type, and the lanes of each operand.
 * @type {Record<string, (...operands: any[]) => Lanes>}
 */
export const WHOLE = """

_LETTERS = "xyzw"
_PACKAGE = Path(__file__).parents[3]
_SOURCES = (
    "compiler/javascript.py",
    "compiler/tracing.py",
    "compiler/reference",
    "stdlib/builtins",
    "targets/web_host/serving",
)
"""The files and folders of the package that decide what the table says."""


@cache
def builtins_module() -> str:
    """The text of the module. It is computed here where it was not when the package was built, or
    where something that it depends on has changed since."""
    found: str | None = precomputed("builtin_table", _key())
    return _module() if found is None else found


def module_to_generate() -> Precomputations:
    """The text that ``builtins_module`` looks for."""
    return {_key(): _module}


def _key() -> str:
    paths = (path for each in _SOURCES for path in _files(_PACKAGE / each))
    return key(*(path.read_text("utf-8") for path in paths))


def _files(path: Path) -> list[Path]:
    return sorted(path.glob("*.py")) if path.is_dir() else [path]


def _module() -> str:
    return f"{_HEAD}{_LANEWISE}{_rows(dict(_lanewise()))}{_OF_WHOLE}{_rows(dict(_whole()))}"


def _rows(texts: dict[str, str]) -> str:
    rows = "".join(f'  "{name}": {text},\n' for name, text in texts.items())
    return f"{{\n{rows}}};\n"


def _lanewise() -> Iterator[tuple[str, str]]:
    for row in COMPUTING:
        for overload in overloads(row):
            if not _is_whole(row, overload):
                kind: Any = overload.operands[0].kind
                names = [_LETTERS[at] for at, _ in enumerate(overload.operands)]
                lanes = [
                    (given(name, kind=_kind(shape), is_natural=shape.kind in ("uint", "bool")),)
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
        given(f"{name}[{at}]", kind=kind, is_natural=is_natural) for at in range(shape.width)
    )


def _kind(shape: Shape) -> Any:
    return "int" if shape.kind in ("int", "uint") else "float"


def _written(shape: Shape) -> str:
    return f"{shape.columns}x{shape.width}" if shape.columns else f"{shape.width}"
