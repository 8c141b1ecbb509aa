"""Simplification rules for bools and for operations on bits."""

from __future__ import annotations

from ...ir.node import Node
from ...ir.types import scalar_kind, width, with_width
from .rule import (
    ANY,
    CONSTANT,
    Builder,
    Rule,
    Site,
    are_same,
    builtin,
    constant,
    inner,
    lanes,
    operand,
    uniform_lane,
)

BITS = 32


def _all_set(_b: Builder, at: Site) -> bool:
    """Whether every bit of the first operand is set."""
    every = -1 if scalar_kind(at.type) == "int" else 2**BITS - 1
    return uniform_lane(at.operands[0]) == every


def _connective(name: str, absorbing: bool) -> tuple[Rule, ...]:
    """``and`` (absorbed by false) and ``or`` (absorbed by true)."""
    return (
        Rule(f"{name} decided", "One side decides the whole, whatever the other is.",
             (name,), (lanes(absorbing), ANY), constant(absorbing), either=True),
        Rule(f"{name} undecided", "One side is known not to matter, so the other decides.",
             (name,), (lanes(not absorbing), ANY), operand(1), either=True),
        Rule(f"{name} itself", "A bool joined with itself is that bool.",
             (name,), (ANY, ANY), operand(0), are_same),
    )  # fmt: skip


def _shifts_nothing(_b: Builder, at: Site) -> bool:
    amount = uniform_lane(at.operands[1])
    return amount is not None and amount % BITS == 0


def _shifts_otherwise(_b: Builder, at: Site) -> bool:
    """Whether the amount is not yet the `uint` below 32 by which every backend shifts."""
    amount = uniform_lane(at.operands[1])
    if amount is None or amount % BITS == 0:
        return False
    return not (0 < amount < BITS and scalar_kind(at.operands[1].type) == "uint")


def _shifted_less(b: Builder, at: Site) -> Node:
    shifted, amount = at.operands
    by = uniform_lane(amount)
    assert by is not None
    lanes_ = with_width("uint", width(amount.type))
    return b.make(at.op, at.type, (shifted, b.constant(lanes_, by % BITS)), at.data)


_SHIFTS = ("shift_left", "shift_right")

BIT_RULES = (
    *_connective("and", False),
    *_connective("or", True),
    Rule("no bits kept", "No bit is set that is not set in both operands.",
         ("bit_and",), (lanes(0), ANY), constant(0), either=True),
    Rule("all bits kept", "A mask with all bits set keeps the value.",
         ("bit_and",), (CONSTANT, ANY), operand(1), _all_set, either=True),
    Rule("bit_and itself", "A value masked with itself is that value.",
         ("bit_and",), (ANY, ANY), operand(0), are_same),
    Rule("no bits added", "Adding no bits keeps the value.",
         ("bit_or",), (lanes(0), ANY), operand(1), either=True),
    Rule("all bits added", "With all bits added, all bits are set.",
         ("bit_or",), (CONSTANT, ANY), operand(0), _all_set, either=True),
    Rule("bit_or itself", "A value joined with itself is that value.",
         ("bit_or",), (ANY, ANY), operand(0), are_same),
    Rule("no bits changed", "Changing no bits keeps the value.",
         ("bit_xor",), (lanes(0), ANY), operand(1), either=True),
    Rule("all bits changed", "Changing all bits is `bit_not`.",
         ("bit_xor",), (CONSTANT, ANY),
         lambda b, at: b.call("bit_not", at.type, b.fitted(at.operands[1], at.type)),
         _all_set, either=True),
    Rule("bit_xor itself", "No bit of a value differs from itself.",
         ("bit_xor",), (ANY, ANY), constant(0), are_same),
    *(
        Rule(f"{name} twice", "The function undoes itself.", (name,), (builtin(name),), inner)
        for name in ("bit_not", "reverse_bits")
    ),
    Rule("zero shifted", "Zero, shifted, is zero.",
         _SHIFTS, (lanes(0), ANY), constant(0)),
    Rule("shifted by nothing", "Amounts count modulo 32, so a multiple of 32 shifts nothing.",
         _SHIFTS, (ANY, CONSTANT), operand(0), _shifts_nothing),
    Rule("shifted by less", "Amounts count modulo 32; every backend takes a `uint` below 32.",
         _SHIFTS, (ANY, CONSTANT), _shifted_less, _shifts_otherwise),
)  # fmt: skip
