"""Simplification rules for bools and for operations on bits."""

from __future__ import annotations

from ...ir.node import Node
from ...ir.types import Type, scalar_kind, width, with_width
from .builder import Builder, uniform_lane
from .rule import Rule
from .terms import computed, condition, either, function
from .vocabulary import c, x

BITS = 32


@condition("all bits of {} are set")
def _has_all_bits(_builder: Builder, _type: Type, value: Node) -> bool:
    every = -1 if scalar_kind(value.type) == "int" else 2**BITS - 1
    return uniform_lane(value) == every


@condition("{} is a multiple of 32")
def _is_no_shift(_builder: Builder, _type: Type, amount: Node) -> bool:
    by = uniform_lane(amount)
    return by is not None and by % BITS == 0


@computed
def _modulo_32(builder: Builder, _type: Type, amount: Node) -> Node | None:
    """The `uint` below 32 by which every backend shifts, if the amount is not that already."""
    by, kind = uniform_lane(amount), scalar_kind(amount.type)
    if by is None or (0 <= by < BITS and kind == "uint"):
        return None
    return builder.constant(with_width("uint", width(amount.type)), by % BITS)


def _connective(name: str, absorbing: bool) -> tuple[Rule, ...]:
    """``and`` (absorbed by false) and ``or`` (absorbed by true)."""
    joined = function(name)
    return (
        Rule(f"{name} decided", either(joined(absorbing, x)), absorbing,
             "One side decides the whole, whatever the other is."),
        Rule(f"{name} undecided", either(joined(not absorbing, x)), x,
             "One side is known not to matter, so the other decides."),
        Rule(f"{name} itself", joined(x, x), x, "A bool joined with itself is that bool."),
    )  # fmt: skip


def _undone(name: str) -> Rule:
    undoing = function(name)
    return Rule(f"{name} twice", undoing(undoing(x)), x, "The function undoes itself.")


_SHIFT = function("shift_left", "shift_right")

BIT_RULES = (
    *_connective("and", False),
    *_connective("or", True),
    Rule("no bits kept", either(x & 0), 0, "No bit is set that is not set in both operands."),
    Rule("all bits kept", either(c & x), x,
         "A mask with all bits set keeps the value.", where=_has_all_bits(c)),
    Rule("bit_and itself", x & x, x, "A value masked with itself is that value."),
    Rule("no bits added", either(x | 0), x, "Adding no bits keeps the value."),
    Rule("all bits added", either(c | x), c,
         "With all bits added, all bits are set.", where=_has_all_bits(c)),
    Rule("bit_or itself", x | x, x, "A value joined with itself is that value."),
    Rule("no bits changed", either(x ^ 0), x, "Changing no bits keeps the value."),
    Rule("all bits changed", either(c ^ x), ~x,
         "Changing all bits is `bit_not`.", where=_has_all_bits(c)),
    Rule("bit_xor itself", x ^ x, 0, "No bit of a value differs from itself."),
    *map(_undone, ("bit_not", "reverse_bits")),
    Rule("zero shifted", _SHIFT(0, x), 0, "Zero, shifted, is zero."),
    Rule("shifted by nothing", _SHIFT(x, c), x,
         "Amounts count modulo 32, so a multiple of 32 shifts nothing.", where=_is_no_shift(c)),
    Rule("shifted by less", _SHIFT(x, c), _SHIFT(x, _modulo_32(c)),
         "Amounts count modulo 32; every backend takes a `uint` below 32."),
)  # fmt: skip
