"""Simplification rules that gather the constants of sums and products.

Functions that remap or blend leave chains such as ``(x - 0.5) * 1 + 0.5`` once their arguments are
constants. What the constants come to is computed here, with fewer roundings than the chain has.
A value with a name is probably used elsewhere, too. Nothing would be saved by computing a second
one beside it, so its constant is only gathered if this leaves nothing to compute.
"""

from __future__ import annotations

from ....frozen import frozen
from ...ir.node import Node
from ...ir.types import Matrix, Vector, scalar_kind
from ...reference.operations import constant_lanes
from .rule import CONSTANT, Builder, Rule, Site, builtin, uniform_lane

LARGEST_TERM = 1024.0
"""Larger constants are left alone: adding one and subtracting it again may be there to round."""
LARGEST_FACTOR = 1e15
"""With factors up to this, and not below its inverse, no product of two of them leaves float32."""


@frozen
class _Chain:
    """An operation of a constant and of another operation, of a constant and a value."""

    outer: Node
    inner: Node
    within: Node
    value: Node

    @property
    def constants(self) -> tuple[Node, Node]:
        """The inner constant and the outer one."""
        return self.within, self.outer


def _chain(at: Site) -> _Chain | None:
    """The parts of a chain of scalars and vectors in which both operations have one width."""
    outer, inner = at.operands if at.operands[0].op == "constant" else at.operands[::-1]
    if at.op != "call" or inner.op != "call" or inner.type != at.type:
        return None
    if any(isinstance(each.type, Matrix) for each in (outer, *inner.operands)):
        return None
    left, right = inner.operands
    if right.op == "constant":
        return _Chain(outer, inner, right, left)
    return _Chain(outer, inner, left, right) if left.op == "constant" else None


def _magnitudes(chain: _Chain) -> list[float]:
    return [abs(float(v)) for c in chain.constants for v in constant_lanes(c.type, c.data)]


def _joined(b: Builder, name: str, left: Node, right: Node) -> Node:
    """An operation of two constants, of which one may be a scalar."""
    wide = left.type if isinstance(left.type, Vector) else right.type
    return b.call(name, wide, left, right)


# --- sums ----------------------------------------------------------------------------------------


def _gathered_terms(b: Builder, at: Site) -> Node | None:
    chain = _chain(at)
    if chain is None:
        return None
    is_float = scalar_kind(at.type) == "float"
    if is_float and any(each > LARGEST_TERM for each in _magnitudes(chain)):
        return None
    inner, outer, within = chain.inner, chain.outer, chain.within
    is_subtracted = inner.data == "sub" and inner.operands[1] is chain.value
    if inner.data == "sub" and not is_subtracted:
        within = b.call("neg", within.type, within)
    if at.data == "add":
        term = _joined(b, "add", within, outer)
    elif at.operands[1] is outer:
        term = _joined(b, "sub", within, outer)
    else:
        term, is_subtracted = _joined(b, "sub", outer, within), not is_subtracted
    if not is_subtracted and uniform_lane(term) == 0:
        return b.fitted(chain.value, at.type)
    if inner.id in b.notes.names:
        return None
    if is_subtracted:
        return b.call("sub", at.type, term, chain.value)
    if all(value < 0 for value in constant_lanes(term.type, term.data)):
        return b.call("sub", at.type, chain.value, b.call("neg", term.type, term))
    return b.call("add", at.type, chain.value, term)


# --- products ------------------------------------------------------------------------------------


def _gathered_factors(b: Builder, at: Site) -> Node | None:
    chain = _chain(at)
    if chain is None or (chain.within is chain.inner.operands[0] and chain.inner.data == "div"):
        return None
    outer, within = chain.outer, chain.within
    divisions = chain.inner.data == "div", at.data == "div"
    if scalar_kind(at.type) != "float":
        if any(divisions):
            return None
    elif not all(1 / LARGEST_FACTOR <= each <= LARGEST_FACTOR for each in _magnitudes(chain)):
        return None
    is_named = chain.inner.id in b.notes.names
    match divisions:
        case (True, True):
            divisor = _joined(b, "mul", within, outer)
            return None if is_named else b.call("div", at.type, chain.value, divisor)
        case (True, False):
            factor = _joined(b, "div", outer, within)
        case (False, True):
            factor = _joined(b, "div", within, outer)
        case _:
            factor = _joined(b, "mul", within, outer)
    if is_named and uniform_lane(factor) != 1:
        return None
    return b.call("mul", at.type, chain.value, factor)


_SUM = builtin("add", "sub")
_PRODUCT = builtin("mul", "div")

CONSTANT_TERMS = (
    Rule("constants added", "Of two constants that are added, one after the other, one is enough.",
         ("add",), (_SUM, CONSTANT), _gathered_terms, either=True),
    Rule("constants subtracted", "The constants of a sum and of a difference are one constant.",
         ("sub",), (_SUM, CONSTANT), _gathered_terms),
    Rule("sum subtracted", "A constant minus a sum with another one is a difference with one.",
         ("sub",), (CONSTANT, _SUM), _gathered_terms),
    Rule("constant factors", "Of two constant factors, one after the other, one is enough.",
         ("mul",), (_PRODUCT, CONSTANT), _gathered_factors, either=True),
    Rule("constant divisors", "Dividing by a constant joins a factor or divisor before it.",
         ("div",), (_PRODUCT, CONSTANT), _gathered_factors),
)  # fmt: skip
