"""How a language spells operations: forms that know which parentheses they need.

A language has a row for each operation of ``compiler/tracing``. ``C_LIKE`` has those that are the
same in the languages that have C's operators.
"""

from __future__ import annotations

from collections.abc import Mapping

from ..compiler.tracing import Expression, Kind
from ..support.frozen import frozen

WHOLE = 100
"""The strength of names, numbers and calls."""


@frozen
class Form:
    """The spelling of an operation."""

    text: str
    """The text, with the operands' numbers in braces."""
    level: int = WHOLE
    """The strength with which it holds its parts together."""
    inner: tuple[int, ...] = ()
    """The least strength of each operand that takes no parentheses; 0 where none is given."""
    helper: str = ""
    """The function of the skeleton that it calls, if that has to be there for it."""


def infix(operator: str, level: int, operands: int | None = None) -> Form:
    """An operator between its operands; equal ones associate to the left.

    ``operands`` is the strength of operands, where compilers warn of mixed operators.
    """
    inner = (level, level + 1) if operands is None else (operands, operands)
    return Form(f"{{0}} {operator} {{1}}", level, inner)


def prefix(operator: str, level: int) -> Form:
    """An operator before its operand."""
    return Form(f"{operator}{{0}}", level, (level + 1,))


def calls(
    functions: Mapping[str, str], operands: Mapping[str, int] | None = None
) -> dict[str, Form]:
    """Functions by operation."""
    counts = operands or {}
    return {
        op: Form(
            f"{name}({', '.join(f'{{{n}}}' for n in range(counts.get(op, _ARITY.get(op, 1))))})"
        )
        for op, name in functions.items()
    }


_ARITY = {"minimum": 2, "maximum": 2, "power": 2, "arctan2": 2, "remainder": 2, "mod": 2,
          "floordiv": 2, "mul_int": 2, "ldexp": 2, "lshift": 2, "rshift": 2}  # fmt: skip

OR, AND, EQUAL, ORDER, SUM, PRODUCT, UNARY = 10, 20, 40, 50, 70, 80, 90
CHOICE = 5
BITS = 30
"""Operators on bits: operands of other strengths always stand in parentheses."""

C_LIKE: Mapping[str, Form] = {
    "add": infix("+", SUM),
    "sub": infix("-", SUM),
    "mul": infix("*", PRODUCT),
    "div": infix("/", PRODUCT),
    "neg": prefix("-", UNARY),
    "lt": infix("<", ORDER, SUM),
    "le": infix("<=", ORDER, SUM),
    "gt": infix(">", ORDER, SUM),
    "ge": infix(">=", ORDER, SUM),
    "eq": infix("==", EQUAL, SUM),
    "ne": infix("!=", EQUAL, SUM),
    "and": infix("&", BITS, UNARY),
    "or": infix("|", BITS, UNARY),
    "xor": infix("^", BITS, UNARY),
    "invert": prefix("~", UNARY),
    "low_bits": Form("{0} & 0xFFFFFFFF", BITS, (UNARY,)),
    "where": Form("{0} ? {1} : {2}", CHOICE, (OR, CHOICE + 1, CHOICE)),
    "logical_and": infix("&&", AND, EQUAL),
    "logical_or": infix("||", OR, EQUAL),
    "logical_not": prefix("!", UNARY),
}


def operand_kinds(each: Expression) -> tuple[Kind, ...]:
    """The kinds that an operation wants its operands to have."""
    given: tuple[Kind, ...] = tuple(operand.kind for operand in each.operands)
    own: Kind = each.kind
    count = len(given)
    match each.op:
        case "where":
            return "bool", own, own
        case "lt" | "le" | "gt" | "ge" | "eq" | "ne":
            common: Kind = given[0] if given[0] == given[1] else "float"
            return common, common
        case "logical_and" | "logical_or" | "logical_not":
            return _same("bool", count)
        case "ldexp":
            return "float", "int"
        case "call":
            kinds: tuple[Kind, ...] = each.value[1]
            return kinds
        case "exponent" | "int64":
            return ("int",) if given == ("bool",) else ("float",)
        case "load":
            return _same("int", count)
        case "float64":
            return given
        case "add" | "sub" | "mul" | "neg" | "abs" | "minimum" | "maximum":
            return _same(own, count)
        case _:
            return _same(own if own == "int" else "float", count)


def _same(kind: Kind, count: int) -> tuple[Kind, ...]:
    return (kind,) * count
