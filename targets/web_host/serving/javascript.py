"""Prints traced expressions as JavaScript, for ``builtin_table.py``.

Numbers of JavaScript are floats of 64 bits, and so are integers here: shifts are products, which
are exact. Operators on bits have the lowest 32 bits alone, as tracing expects of them.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from typing import Any

from ....compiler.javascript import MATH
from ....compiler.tracing import Expression, shared, wrapped

_PAIRS = {"mul_int", "minimum", "maximum", "power", "arctan2"}
"""The functions of ``Math`` of two numbers."""

_FORMS: Mapping[str, str] = {
    **{op: f"{name}({{}}, {{}})" if op in _PAIRS else f"{name}({{}})" for op, name in MATH.items()},
    "add": "{} + {}",
    "sub": "{} - {}",
    "mul": "{} * {}",
    "div": "{} / {}",
    "floordiv": "Math.floor({} / {})",
    "mod": "remainder({}, {})",
    "remainder": "remainder({}, {})",
    "neg": "-{}",
    "lt": "{} < {}",
    "le": "{} <= {}",
    "gt": "{} > {}",
    "ge": "{} >= {}",
    "eq": "{} === {}",
    "ne": "{} !== {}",
    "and": "{} & {}",
    "or": "{} | {}",
    "xor": "{} ^ {}",
    "invert": "~{}",
    "low_bits": "{} >>> 0",
    "wrap": "{} | 0",
    "lshift": "{} * 2 ** {}",
    "rshift": "Math.floor({} / 2 ** {})",
    "where": "{} ? {} : {}",
    "float64": "{}",
    "int64": "whole({})",
    "logical_and": "{} && {}",
    "logical_or": "{} || {}",
    "logical_not": "!{}",
    "rint": "nearest({})",
    "exp2": "Math.pow(2, {})",
    "ldexp": "{} * 2 ** {}",
    "fraction": "fractionOf({})",
    "exponent": "exponentOf({})",
}
"""The form of each operation, with braces for its operands."""

_CALL = re.compile(r"[\w.]+\(({}|\d+)(, {})*\)")
"""The form of a call, whose arguments take no parentheses."""
_SHORT = 60
"""The most characters of a list that stands on one line."""


def function(parameters: str, results: Expression | tuple[Any, ...]) -> str:
    """The arrow function with these results, which are nested like columns. Operands that several
    expressions have get a name in it. Its lines behind the first are those of a row of a table."""
    names: dict[int, str] = {}
    lines: list[str] = []
    for each in shared(_lanes(results)):
        text = _text(each, names, is_whole=True)
        names[id(each)] = f"v{len(names)}"
        lines.append(f"const {names[id(each)]} = {text};")
    if not lines:
        return f"({parameters}) => {_written(results, names, 2)}"
    body = "".join(f"    {line}\n" for line in (*lines, f"return {_written(results, names, 4)};"))
    return f"({parameters}) => {{\n{body}  }}"


def _lanes(results: Any) -> Iterator[Expression]:
    if isinstance(results, tuple):
        for each in results:
            yield from _lanes(each)
    else:
        yield wrapped(results)


def _written(results: Any, names: dict[int, str], indent: int) -> str:
    """A list of lanes, or of columns, on one line if it is short; or else a lane."""
    if isinstance(results, tuple):
        parts = [_written(each, names, indent + 2) for each in results]
        line = f"[{', '.join(parts)}]"
        if len(line) <= _SHORT and "\n" not in line:
            return line
        inside = "".join(f"{' ' * (indent + 2)}{part},\n" for part in parts)
        return f"[\n{inside}{' ' * indent}]"
    lane = wrapped(results)
    text = _text(lane, names, is_whole=True)
    return f"Number({text})" if lane.kind == "bool" else text


def _text(each: Expression, names: dict[int, str], *, is_whole: bool = False) -> str:
    """An expression; in parentheses, unless it is a whole one or needs none."""
    if id(each) in names:
        return names[id(each)]
    form = _form(each)
    is_call = _CALL.fullmatch(form) is not None
    parts = [_text(operand, names, is_whole=is_call) for operand in each.operands]
    text = form.format(*parts)
    is_closed = not each.operands or form.endswith(")") or form == "{}"
    return text if is_whole or is_closed else f"({text})"


def _form(each: Expression) -> str:
    if each.op == "input":
        return str(each.value)
    if each.op == "constant":
        return str(each.value).lower().removesuffix(".0")
    return _FORMS[each.op]
