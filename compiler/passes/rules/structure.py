"""Simplification rules for joining values, taking parts of them, selecting, and crossing stages."""

from __future__ import annotations

from ...ir import build
from ...ir.node import HEADS, Node
from ...ir.operations import SWIZZLE
from ...ir.refinements import OPPOSITES
from ...ir.types import Scalar, Type, Vector, width
from .builder import Builder
from .conditions import are_same, is_vector, is_whole
from .rule import Rule
from .terms import Data, Several, Variable, computed, condition, function
from .vocabulary import (
    a,
    c,
    cross,
    index,
    lanes,
    member,
    member_name,
    mode,
    not_,
    select,
    splat,
    swizzle,
    vector,
    x,
    xs,
    y,
)

Lanes = tuple[int, ...]

# --- lanes ---------------------------------------------------------------------------------------


@computed
def _picked_twice(_builder: Builder, _type: Type, first: Lanes, then: Lanes) -> Lanes:
    return tuple(first[lane] for lane in then)


@computed
def _filled(builder: Builder, _type: Type, lane: Node, picked: Lanes) -> Node:
    return build.splat(builder.graph, lane, len(picked))


@computed
def _picked_of_part(
    builder: Builder, type_: Type, parts: tuple[Node, ...], wanted: Lanes
) -> Node | None:
    """Lanes of a joined vector, where they all come from one of its parts."""
    first = 0
    for part in parts:
        last = first + width(part.type)
        if all(first <= lane < last for lane in wanted):
            if isinstance(part.type, Scalar):
                return build.splat(builder.graph, part, len(wanted))
            return builder.make("swizzle", type_, (part,), tuple(lane - first for lane in wanted))
        first = last
    return None


@condition("{1} are all lanes of {0} in order")
def _are_all(_builder: Builder, _type: Type, source: Node, picked: Lanes) -> bool:
    return picked == tuple(range(width(source.type)))


@condition("all of {} are one scalar")
def _are_one_scalar(_builder: Builder, _type: Type, values: tuple[Node, ...]) -> bool:
    first = values[0]
    return isinstance(first.type, Scalar) and all(value is first for value in values)


@computed
def _first(_builder: Builder, _type: Type, values: tuple[Node, ...]) -> Node:
    return values[0]


@computed
def _rejoined(builder: Builder, type_: Type, parts: tuple[Node, ...]) -> Node | None:
    """Lanes of one vector, taken apart and joined again."""
    sources = {each.operands[0] if each.op == "swizzle" else each for each in parts}
    if len(sources) != 1 or not isinstance((source := sources.pop()).type, Vector):
        return None
    found: Lanes = ()
    for each in parts:
        is_whole = each.op != "swizzle"
        found += tuple(range(width(each.type))) if is_whole else SWIZZLE.data(each)
    return builder.make("swizzle", type_, (source,), found)


# --- parts ---------------------------------------------------------------------------------------


def _number(position: Node) -> int:
    assert isinstance(position.data, int)
    return position.data


@computed
def _lane(_builder: Builder, _type: Type, position: Node) -> Lanes:
    return (_number(position),)


@computed
def _part(_builder: Builder, _type: Type, whole: Node, position: Node) -> Node:
    return whole.operands[_number(position)]


@computed
def _given_member(builder: Builder, _type: Type, whole: Node, name: str) -> Node:
    return build.member(builder.graph, whole, name)


# --- choices -------------------------------------------------------------------------------------


@condition("{} is no constant")
def _is_computed(_builder: Builder, _type: Type, value: Node) -> bool:
    return value.op != "constant"


_CHOICE = function(".select", "choose")
_INNER = Data("inner")
_SWIZZLES = Several("xs", some=frozenset({HEADS["swizzle"]}))
_MADE = Variable("m", frozenset({HEADS["matrix"], HEADS["array"]}))
_STRUCT = Variable("s", frozenset({HEADS["struct"]}))
_ARRAY = function(".array")
_COMPARED = Variable("a", frozenset(OPPOSITES))

STRUCTURE = (
    Rule("lanes of lanes", swizzle[lanes](swizzle[_INNER](x)),
         swizzle[_picked_twice(_INNER, lanes)](x),
         "Lanes of lanes are lanes of the vector itself."),
    Rule("lanes of one scalar", swizzle[lanes](splat(x)), _filled(x, lanes),
         "Every lane of a filled vector is the scalar."),
    Rule("lanes of a part", swizzle[lanes](vector(xs)), _picked_of_part(xs, lanes),
         "Lanes that come from one part of a joined vector are that part's."),
    Rule("all lanes in order", swizzle[lanes](x), x,
         "All lanes in their order are the vector itself.", where=_are_all(x, lanes)),
    Rule("one scalar joined", vector(xs), splat(_first(xs)),
         "A vector of one scalar in all lanes is filled with it.", where=_are_one_scalar(xs)),
    Rule("joined again", vector(_SWIZZLES), _rejoined(_SWIZZLES),
         "Lanes of one vector, taken apart and joined, are lanes of that vector."),
    Rule("element of equal ones", index(_ARRAY(xs), x), _first(xs),
         "Of elements that are all one value, each is that value.", where=are_same(xs)),
    Rule("lane by number", index(x, c), swizzle[_lane(c)](x),
         "A vector indexed by a constant is one of its lanes.", where=is_vector(x)),
    Rule("part by number", index(_MADE, c), _part(_MADE, c),
         "A column or element of what was put together is what was put there."),
    Rule("member of a structure", member[member_name](_STRUCT), _given_member(_STRUCT, member_name),
         "A member of what was put together is what was put there."),
    Rule("chosen already", _CHOICE(True, x, y), x, "A choice by a constant is no choice."),
    Rule("refused already", _CHOICE(False, x, y), y, "A choice by a constant is no choice."),
    Rule("equal sides", _CHOICE(a, x, x), x,
         "A choice between a value and itself is that value."),
    Rule("chosen by an opposite", select[mode](not_(a), x, y), select[mode](a, y, x),
         "A choice by the opposite of a bool is that by the bool, the other way round."),
    Rule("computing side first", select[mode](_COMPARED, c, x), select[mode](not_(_COMPARED), x, c),
         "The side that computes something comes first: it is the one that a branch may skip.",
         where=_is_computed(x)),
    Rule("bool chosen", select(a, True, False), a,
         "A choice between true and false is the condition.", where=is_whole(a)),
    Rule("constant crossing", cross(c), c, "A constant is the same in every stage."),
)  # fmt: skip
