"""Derives the bounds of a value from those of its operands: a rule for each operation.

``Ranges`` (``ranges.py``) looks the rule up by the operation, hands it the facts of the values that
this one needs, and keeps the derived fact. Every rule has a name (``rulebook.py``), by which proofs
cite it. The rules of builtins stand in the builtins' own rows.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from functools import lru_cache
from typing import Protocol

from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.facts import SMALLEST_NORMAL, UNIT, UNKNOWN, Fact
from ...stdlib.builtins.intervals import product
from ...stdlib.builtins.row import RangeRule as OfBuiltin
from ...stdlib.builtins.weakest import ROUNDING
from ...support.frozen import changed, frozen
from . import rulebook
from .build import in_body
from .leaves import Argument, Buffer, Parameter
from .node import Formal, Node
from .operations import (
    ASCRIBE,
    CALL,
    CONSTANT,
    CROSS,
    FOLD,
    FORMAL,
    INPUT,
    ITERATE,
    MEMBER,
    OPERATIONS,
    Constant,
)
from .refinements import refinements
from .types import Array, Matrix, RuntimeArray, Struct

MOST_KEPT = 8192
"""Calls with different facts that are remembered; a program has some hundreds."""


class Analysis(Protocol):
    """The interface of the analysis for rules, besides the facts of the values they need."""

    @property
    def without(self) -> frozenset[str]:
        """Names of rules that are not applied."""

    def so_far(self, node: Node) -> Fact:
        """The fact of a value so far, while another is derived that needs it."""

    def in_turns(self, state: Formal, starts: Sequence[Fact]) -> Fact:
        """The fact of a loop's state in every iteration, for these facts of the initial states."""

    def bound_of(self, index: Formal) -> int:
        """The largest number of values that a fold's index takes."""


@frozen
class RangeRule:
    """A rule that derives the fact of an operation from those of the values it needs."""

    name: Callable[[Node], str]
    derive: Callable[[Analysis, Node, Sequence[Fact]], Fact]


def _union(facts: Sequence[Fact]) -> Fact:
    if not facts:
        return UNKNOWN
    result = facts[0]
    for fact in facts[1:]:
        result = result.union(fact)
    return result


def _constant(_ranges: Analysis, node: Node, _known: Sequence[Fact]) -> Fact:
    if isinstance(node.type, Matrix):
        return UNKNOWN
    data = CONSTANT.data(node)
    return _of_lanes(data if isinstance(data, tuple) else (data,))


@lru_cache(maxsize=MOST_KEPT)
def _of_lanes(lanes: tuple[Constant, ...]) -> Fact:
    # Adding zero takes the sign from a zero: facts have none.
    numbers = [float(lane) + 0.0 for lane in lanes if not isinstance(lane, tuple)]
    return Fact(min(numbers), max(numbers), nonzero=all(abs(n) >= SMALLEST_NORMAL for n in numbers))


def _declared(_ranges: Analysis, node: Node, _known: Sequence[Fact]) -> Fact:
    """The fact that the host promises of a parameter, or of a buffer's elements."""
    return _leaf(node).fact


def _contract(node: Node) -> str:
    return rulebook.UNIT if _leaf(node).fact.unit else rulebook.DECLARED


def _leaf(node: Node) -> Parameter | Buffer | Argument:
    leaf: Parameter | Buffer | Argument = OPERATIONS[node.op].data(node)
    return leaf


def _call(ranges: Analysis, node: Node, known: Sequence[Fact]) -> Fact:
    operands = node.operands
    same = len(operands) > 1 and operands.count(operands[0]) == len(operands)
    same = same and rulebook.SAME not in ranges.without
    return _of_call(BUILTINS[CALL.data(node)].range, tuple(known), same)


@lru_cache(maxsize=MOST_KEPT)
def _of_call(rule: OfBuiltin, known: tuple[Fact, ...], same: bool) -> Fact:
    """The fact of a call, by the facts of its operands alone: many calls have the same ones.

    The check asks for it, passes ask before and after guards are decided, and so do other programs.
    Two zeros are the same number here, whatever their signs, and no result has a zero with a sign:
    so it does not depend on who asked first.
    """
    fact = rule(known, same)
    return fact if fact.lo and fact.hi else changed(fact, lo=fact.lo + 0.0, hi=fact.hi + 0.0)


def _joined(_ranges: Analysis, _node: Node, known: Sequence[Fact]) -> Fact:
    """A vector is as long as its longest part, at least."""
    joined = _union(known)
    longest = max(max(part.length, part.least) for part in known)
    return Fact(joined.lo, joined.hi, joined.excludes_zero, length=longest, kind=joined.kind)


def _elements(_ranges: Analysis, _node: Node, known: Sequence[Fact]) -> Fact:
    """A fact that holds of each element."""
    return _union(known)


def _filled(_ranges: Analysis, _node: Node, known: Sequence[Fact]) -> Fact:
    (lane,) = known
    return Fact(lane.lo, lane.hi, lane.nonzero, length=lane.least, kind=lane.kind)


def _lanes(_ranges: Analysis, _node: Node, known: Sequence[Fact]) -> Fact:
    (whole,) = known
    return Fact(whole.lo, whole.hi, whole.nonzero, kind=whole.kind)


def _index(_ranges: Analysis, node: Node, known: Sequence[Fact]) -> Fact:
    whole = known[0]
    if isinstance(node.operands[0].type, Matrix):
        return UNKNOWN
    if isinstance(node.operands[0].type, Array | RuntimeArray):
        return whole
    return Fact(whole.lo, whole.hi, whole.nonzero, kind=whole.kind)


def _member(_ranges: Analysis, node: Node, known: Sequence[Fact]) -> Fact:
    """The fact of a member of a light of many, or of a buffer's element, a loop's state, or a call.

    Lights and elements carry a fact for each member.
    """
    source = node.operands[0]
    if source.op == "iterate" or in_body(node) is not None:
        return _union(known)
    while source.op in ("index", "as"):
        source = source.operands[0]
    if isinstance(source.data, Parameter | Buffer | Argument) and isinstance(
        node.operands[0].type, Struct
    ):
        return dict(source.data.member_facts).get(MEMBER.data(node), UNKNOWN)
    return UNKNOWN


def _member_name(node: Node) -> str:
    return rulebook.STATE if node.operands[0].op == "iterate" else rulebook.MEMBER


def _ascribed(_ranges: Analysis, node: Node, known: Sequence[Fact]) -> Fact:
    """The fact of an ascribed value: only unit vectors are ever called directions."""
    meaning = ASCRIBE.data(node)
    contract = meaning is not None and meaning.kind == "direction"
    return known[0].meet(UNIT) if contract else known[0]


def _select(ranges: Analysis, node: Node, known: Sequence[Fact]) -> Fact:
    """One of the sides, of which its own condition may tell something.

    ``if x < 0.01 then 0.01 else x`` is at least 0.01.
    """
    condition, then, otherwise = node.operands
    sides = [known[1], known[2]]
    if rulebook.OWN_CONDITION not in ranges.without:
        for i, (side, holds) in enumerate(((then, True), (otherwise, False))):
            if side.op != "constant":
                for told in refinements(ranges.so_far, condition, holds, ranges.without):
                    if told.about is side:
                        sides[i] = sides[i].meet(told.fact)
    return sides[0].union(sides[1])


def _cross(_ranges: Analysis, node: Node, known: Sequence[Fact]) -> Fact:
    """Without interpolation, the fact of a vertex; of a mean of three vertices, nothing is known.

    A device divides a plane through the values over w by a plane through 1 / w, and each has an
    error that is a part of its largest number. Where the pixel is much farther away than the
    nearest corner, or the triangle is thin, this is more than the values themselves, so the result
    may lie anywhere: also below zero where no vertex is (``_crossed`` in ``picture/quads.py``).
    """
    return UNKNOWN if CROSS.data(node).mode == "perspective" else known[0]


def _input(_ranges: Analysis, node: Node, _known: Sequence[Fact]) -> Fact:
    """Numbers that count up to one that is known: of strips, and of vertices in them."""
    most = INPUT.data(node).most
    return UNKNOWN if most is None else Fact(0.0, float(most), kind="int")


def _fold(_ranges: Analysis, node: Node, known: Sequence[Fact]) -> Fact:
    data = FOLD.data(node)
    count, start, body = known
    if count.hi <= 0:
        return start
    turns = count.lo >= 1 and data.bound >= 1
    if data.operator == "min":
        return Fact(min(start.lo, body.lo), min(start.hi, body.hi) if turns else start.hi)
    if data.operator == "max":
        return Fact(max(start.lo, body.lo) if turns else start.lo, max(start.hi, body.hi))
    if data.operator in ("and", "or"):
        return UNKNOWN
    if data.operator == "add":
        lo = start.lo + min(0.0, body.lo * data.bound) if data.bound else start.lo
        hi = start.hi + max(0.0, body.hi * data.bound) if data.bound else start.hi
        # Each iteration rounds once more, and a growing value never rounds to less than it was.
        error = math.expm1(data.bound * math.log1p(ROUNDING))
        slack = product(max(abs(lo), abs(hi)), error)
        return Fact(lo - slack if body.lo < 0 else lo, hi + slack if body.hi > 0 else hi)
    return Fact(0.0) if start.lo >= 0 and body.lo >= 0 else UNKNOWN


def _fold_name(node: Node) -> str:
    return _FOLDS.get(FOLD.data(node).operator, rulebook.EXTREME)


_FOLDS = {"add": rulebook.SUM, "mul": rulebook.PRODUCT}


def _iterate(_ranges: Analysis, node: Node, known: Sequence[Fact]) -> Fact:
    """The fact of a state: its initial value, or its value after an iteration."""
    if known[0].hi <= 0:
        return known[1] if ITERATE.data(node).states == 1 else UNKNOWN
    return known[1].union(known[-1]) if ITERATE.data(node).states == 1 else UNKNOWN


def _in_turn(ranges: Analysis, node: Node, known: Sequence[Fact]) -> Fact:
    return ranges.in_turns(FORMAL.data(node), known)


def _fold_index(ranges: Analysis, node: Node, _known: Sequence[Fact]) -> Fact:
    return Fact(0.0, float(max(ranges.bound_of(FORMAL.data(node)) - 1, 0)))


def _any_argument(_ranges: Analysis, _node: Node, known: Sequence[Fact]) -> Fact:
    return _union(known)


def _apply(_ranges: Analysis, _node: Node, known: Sequence[Fact]) -> Fact:
    return known[0]


def _named(name: str, derive: Callable[[Analysis, Node, Sequence[Fact]], Fact]) -> RangeRule:
    return RangeRule(lambda _node: name, derive)


FOLD_INDEX = _named(rulebook.INDEX, _fold_index)
IN_TURN = _named(rulebook.IN_TURN, _in_turn)
_BUILTIN = RangeRule(CALL.data, _call)
RULES: Mapping[str, RangeRule] = {
    "constant": _named(rulebook.CONSTANT, _constant),
    "parameter": RangeRule(_contract, _declared),
    "argument": RangeRule(_contract, _declared),
    "buffer": RangeRule(_contract, _declared),
    "as": _named(rulebook.UNIT, _ascribed),
    "call": _BUILTIN,
    "native": _BUILTIN,
    "vector": _named(rulebook.JOINED, _joined),
    "splat": _named(rulebook.FILLED, _filled),
    "swizzle": _named(rulebook.PICKED, _lanes),
    "index": _named(rulebook.ELEMENT, _index),
    "member": RangeRule(_member_name, _member),
    "select": _named(rulebook.EITHER, _select),
    "cross": _named(rulebook.FLAT, _cross),
    "input": _named(rulebook.INDEX, _input),
    "fold": RangeRule(_fold_name, _fold),
    "iterate": _named(rulebook.STATE, _iterate),
    "array": _named(rulebook.ELEMENTS, _elements),
    "formal": _named(rulebook.ARGUMENT, _any_argument),
    "apply": _named(rulebook.BODY, _apply),
    "called": _named(rulebook.BODY, _apply),
}
