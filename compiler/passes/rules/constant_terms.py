"""Simplification rules that gather the constants of sums and products.

Functions that remap or blend leave chains such as ``(x - 0.5) * 1 + 0.5`` once their arguments are
constants. What the constants come to is computed here, with fewer roundings than the chain has.
A value with a name is probably used elsewhere, too. Nothing would be saved by computing a second
one beside it, so its constant is only gathered if this leaves nothing to compute.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...ir.node import Node
from ...ir.types import Type, Vector, scalar_kind
from ...reference.operations import constant_lanes
from .builder import Builder, uniform_lane
from .conditions import gives_float, is_no_matrix, is_whole
from .rule import Rule
from .terms import Variable, computed, condition, either
from .vocabulary import c, d, x

LARGEST_TERM = 1024.0
"""Larger constants are left alone: adding one and subtracting it again may be there to round."""
LARGEST_FACTOR = 1e15
"""The largest factor; the smallest is its inverse.

No product of two such factors leaves float32.
"""


def _magnitudes(*constants: Node) -> Iterator[float]:
    return (abs(float(v)) for each in constants for v in constant_lanes(each.type, each.data))


@condition("{} and {} are no large floats")
def _are_terms(_builder: Builder, type_: Type, one: Node, other: Node) -> bool:
    is_float = scalar_kind(type_) == "float"
    return not is_float or all(each <= LARGEST_TERM for each in _magnitudes(one, other))


@condition("{} and {} are neither large nor small floats")
def _are_factors(_builder: Builder, type_: Type, one: Node, other: Node) -> bool:
    is_float = scalar_kind(type_) == "float"
    return not is_float or all(
        1 / LARGEST_FACTOR <= each <= LARGEST_FACTOR for each in _magnitudes(one, other)
    )


# --- sums ----------------------------------------------------------------------------------------
# The rules at the end find the chain and compute the constant; these functions write what is left:
# without a term of 0, and as a difference where the constant is negative.


@computed
def _plus(builder: Builder, type_: Type, inner: Node, value: Node, term: Node) -> Node | None:
    """A value plus a constant, in place of a chain with ``inner``."""
    # A term of 0 leaves the value, without any operation, so a name of ``inner`` does not matter.
    if uniform_lane(term) == 0:
        return builder.fitted(value, type_)
    # A named value stays for its other users, so a new sum would be computed beside it.
    if inner.id in builder.notes.names:
        return None
    # Write ``x - 2`` and not ``x + -2``; ``uint`` has no negative constants.
    lanes = constant_lanes(term.type, term.data)
    if scalar_kind(term.type) != "uint" and all(lane < 0 for lane in lanes):
        return builder.call("sub", type_, value, builder.call("neg", term.type, term))
    return builder.call("add", type_, value, term)


@computed
def _minus(builder: Builder, type_: Type, inner: Node, value: Node, term: Node) -> Node | None:
    """A value minus a constant, in place of a chain with ``inner``."""
    # The steps are those of ``_plus``, with the opposite sign.
    if uniform_lane(term) == 0:
        return builder.fitted(value, type_)
    if inner.id in builder.notes.names:
        return None
    lanes = constant_lanes(term.type, term.data)
    if scalar_kind(term.type) == "uint" or all(lane > 0 for lane in lanes):
        return builder.call("sub", type_, value, term)
    return builder.call("add", type_, value, builder.call("neg", term.type, term))


@computed
def _from(builder: Builder, type_: Type, inner: Node, value: Node, term: Node) -> Node | None:
    """A constant minus a value, in place of a chain with ``inner``."""
    if inner.id in builder.notes.names:
        return None
    return builder.call("sub", type_, term, value)


# --- products ------------------------------------------------------------------------------------
# Here a factor of 1 leaves the value itself, by the rule for such products.


@computed
def _times(builder: Builder, type_: Type, inner: Node, value: Node, factor: Node) -> Node | None:
    """A value times a constant, in place of a chain with ``inner``."""
    if inner.id in builder.notes.names and uniform_lane(factor) != 1:
        return None
    return builder.call("mul", type_, value, factor)


@computed
def _over(builder: Builder, type_: Type, inner: Node, value: Node, divisor: Node) -> Node | None:
    """A value over a constant, in place of a chain with ``inner``."""
    if inner.id in builder.notes.names:
        return None
    return builder.call("div", type_, value, divisor)


@computed
def _quotient(builder: Builder, type_: Type, dividend: Node, divisor: Node) -> Node | None:
    """A constant over another one, for floats only: whole numbers would lose the remainder."""
    if scalar_kind(type_) != "float":
        return None
    wide = dividend.type if isinstance(dividend.type, Vector) else divisor.type
    return builder.call("div", wide, dividend, divisor)


# --- rules ---------------------------------------------------------------------------------------
# ``_SUM @ (x + c)`` gives the inner operation a name, so that a rule can ask whether the user named
# it. Rules are for calls only: hardware operations round where their expansions want it.

_SUM, _PRODUCT = Variable("s"), Variable("p")
_ARE_NO_MATRICES = tuple(map(is_no_matrix, (x, c, d)))
_OF_TERMS = (is_whole(_SUM), *_ARE_NO_MATRICES, _are_terms(c, d))
_OF_FACTORS = (is_whole(_PRODUCT), *_ARE_NO_MATRICES, _are_factors(c, d))

CONSTANT_TERMS = (
    Rule("constants added", either(_SUM @ either(x + c) + d), _plus(_SUM, x, c + d),
         "Of two constants that are added, one after the other, one is enough.",
         also=(
             (either(_SUM @ (x - c) + d), _plus(_SUM, x, d - c)),
             (either(_SUM @ (c - x) + d), _from(_SUM, x, c + d)),
         ),
         where=_OF_TERMS, of_calls=True),
    Rule("constants subtracted", _SUM @ either(x + c) - d, _plus(_SUM, x, c - d),
         "The constants of a sum and of a difference are one constant.",
         also=(
             (_SUM @ (x - c) - d, _minus(_SUM, x, c + d)),
             (_SUM @ (c - x) - d, _from(_SUM, x, c - d)),
         ),
         where=_OF_TERMS, of_calls=True),
    Rule("sum subtracted", d - _SUM @ either(x + c), _from(_SUM, x, d - c),
         "A constant minus a sum with another one is a difference with one.",
         also=(
             (d - _SUM @ (x - c), _from(_SUM, x, c + d)),
             (d - _SUM @ (c - x), _plus(_SUM, x, d - c)),
         ),
         where=_OF_TERMS, of_calls=True),
    Rule("constant factors", either(_PRODUCT @ either(x * c) * d), _times(_PRODUCT, x, c * d),
         "Of two constant factors, one after the other, one is enough.",
         also=((either(_PRODUCT @ (x / c) * d), _times(_PRODUCT, x, _quotient(d, c))),),
         where=_OF_FACTORS, of_calls=True),
    Rule("constant divisors", _PRODUCT @ either(x * c) / d, _times(_PRODUCT, x, _quotient(c, d)),
         "Dividing by a constant joins a factor or divisor before it.",
         also=((_PRODUCT @ (x / c) / d, _over(_PRODUCT, x, c * d)),),
         where=(*_OF_FACTORS, gives_float()), of_calls=True),
)  # fmt: skip
