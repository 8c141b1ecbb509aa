"""Simplification rules for joining values, taking parts of them, selecting, and crossing stages."""

from __future__ import annotations

from ...ir import build
from ...ir.node import Node
from ...ir.operations import SWIZZLE
from ...ir.refinements import OPPOSITES
from ...ir.types import Scalar, Vector, width
from .rule import (
    ANY,
    CONSTANT,
    Builder,
    Rule,
    Site,
    are_same,
    builtin,
    inner,
    is_whole_bool,
    lanes,
    made,
    operand,
    swizzled_lanes,
)

# --- lanes ---------------------------------------------------------------------------------------


def _picked_twice(b: Builder, at: Site) -> Node:
    (source,) = at.operands
    first = SWIZZLE.data(source)
    return b.make(
        "swizzle", at.type, source.operands, tuple(first[lane] for lane in swizzled_lanes(at))
    )


def _picked_of_splat(b: Builder, at: Site) -> Node:
    return build.splat(b.graph, inner(b, at), len(swizzled_lanes(at)))


def _picked_of_part(b: Builder, at: Site) -> Node | None:
    """Lanes of a joined vector, where they all come from one of its parts."""
    wanted, first = swizzled_lanes(at), 0
    for part in at.operands[0].operands:
        last = first + width(part.type)
        if all(first <= lane < last for lane in wanted):
            if isinstance(part.type, Scalar):
                return build.splat(b.graph, part, len(wanted))
            return b.make("swizzle", at.type, (part,), tuple(lane - first for lane in wanted))
        first = last
    return None


def _is_whole(_b: Builder, at: Site) -> bool:
    return swizzled_lanes(at) == tuple(range(width(at.operands[0].type)))


def _are_one_scalar(b: Builder, at: Site) -> bool:
    return are_same(b, at) and isinstance(at.operands[0].type, Scalar)


def _rejoined(b: Builder, at: Site) -> Node | None:
    """Lanes of one vector, taken apart and joined again."""
    sources = {each.operands[0] if each.op == "swizzle" else each for each in at.operands}
    if len(sources) != 1 or not isinstance((source := sources.pop()).type, Vector):
        return None
    found: tuple[int, ...] = ()
    for each in at.operands:
        is_whole = each.op != "swizzle"
        found += tuple(range(width(each.type))) if is_whole else SWIZZLE.data(each)
    return b.make("swizzle", at.type, (source,), found)


# --- parts ---------------------------------------------------------------------------------------


def _position(at: Site) -> int:
    position = at.operands[1].data
    assert isinstance(position, int)
    return position


def _is_lane(_b: Builder, at: Site) -> bool:
    return isinstance(at.operands[0].type, Vector)


def _of_equal_elements(_b: Builder, at: Site) -> bool:
    elements = at.operands[0].operands
    return all(element is elements[0] for element in elements)


def _given_member(b: Builder, at: Site) -> Node:
    return build.member(b.graph, at.operands[0], str(at.data))


# --- choices -------------------------------------------------------------------------------------


def _swapped(b: Builder, at: Site) -> Node:
    condition, then, otherwise = at.operands
    return b.make("select", at.type, (condition.operands[0], otherwise, then), at.data)


def _computing_side_first(b: Builder, at: Site) -> Node:
    condition, then, otherwise = at.operands
    opposite = b.make(condition.op, condition.type, (condition,), "not")
    return b.make("select", at.type, (opposite, otherwise, then), at.data)


def _only_otherwise_computes(_b: Builder, at: Site) -> bool:
    return at.operands[2].op != "constant"


def _sides_are_same(_b: Builder, at: Site) -> bool:
    return at.operands[1] is at.operands[2]


_CHOICES = (".select", "choose")

STRUCTURE = (
    Rule("lanes of lanes", "Lanes of lanes are lanes of the vector itself.",
         (".swizzle",), (made("swizzle"),), _picked_twice),
    Rule("lanes of one scalar", "Every lane of a filled vector is the scalar.",
         (".swizzle",), (made("splat"),), _picked_of_splat),
    Rule("lanes of a part", "Lanes that come from one part of a joined vector are that part's.",
         (".swizzle",), (made("vector"),), _picked_of_part),
    Rule("all lanes in order", "All lanes in their order are the vector itself.",
         (".swizzle",), (ANY,), operand(0), _is_whole),
    Rule("one scalar joined", "A vector of one scalar in all lanes is filled with it.",
         (".vector",), ANY, lambda b, at: b.make("splat", at.type, at.operands[:1]),
         _are_one_scalar),
    Rule("joined again", "Lanes of one vector, taken apart and joined, are lanes of that vector.",
         (".vector",), ANY, _rejoined, some=made("swizzle")),
    Rule("element of equal ones", "Of elements that are all one value, each is that value.",
         (".index",), (made("array"), ANY), lambda _b, at: at.operands[0].operands[0],
         _of_equal_elements),
    Rule("lane by number", "A vector indexed by a constant is one of its lanes.",
         (".index",), (ANY, CONSTANT),
         lambda b, at: b.make("swizzle", at.type, at.operands[:1], (_position(at),)), _is_lane),
    Rule("part by number", "A column or element of what was put together is what was put there.",
         (".index",), (made("matrix", "array"), CONSTANT),
         lambda _b, at: at.operands[0].operands[_position(at)]),
    Rule("member of a structure", "A member of what was put together is what was put there.",
         (".member",), (made("struct"),), _given_member),
    Rule("chosen already", "A choice by a constant is no choice.",
         _CHOICES, (lanes(True), ANY, ANY), operand(1)),
    Rule("refused already", "A choice by a constant is no choice.",
         _CHOICES, (lanes(False), ANY, ANY), operand(2)),
    Rule("equal sides", "A choice between a value and itself is that value.",
         _CHOICES, (ANY, ANY, ANY), operand(1), _sides_are_same),
    Rule("chosen by an opposite", "A choice by the opposite of a bool is that by the bool, "
         "the other way round.",
         (".select",), (builtin("not"), ANY, ANY), _swapped),
    Rule("computing side first", "The side that computes something comes first: it is the one "
         "that a branch may skip.",
         (".select",), (builtin(*OPPOSITES), CONSTANT, ANY), _computing_side_first,
         _only_otherwise_computes),
    Rule("bool chosen", "A choice between true and false is the condition.",
         (".select",), (ANY, lanes(True), lanes(False)), operand(0), is_whole_bool(0)),
    Rule("constant crossing", "A constant is the same in every stage.",
         (".cross",), (CONSTANT,), operand(0)),
)  # fmt: skip
