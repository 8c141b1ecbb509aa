"""Rows for geometric vectors: products, lengths, reflection, and lighting coefficients."""

from __future__ import annotations

from ...support.frozen import changed
from .accuracy import CORRECT, EXACT, Inherited, in_table, inherited, promised, silent
from .exponential import ROOT_ERROR
from .facts import SMALLEST_NORMAL, UNIT, UNIT_SLACK, UNKNOWN, Fact
from .intervals import around, product, products, rounded, squares
from .row import Builtin, nowhere
from .weakest import relative

_PAIR = ("V, V -> S",)
_WHOLE_PAIR = tuple(
    f"{kind}vec{lanes}, {kind}vec{lanes} -> {scalar}"
    for kind, scalar in (("i", "int"), ("u", "uint"))
    for lanes in (2, 3, 4)
)
_NARROWEST, _WIDEST = 2, 4
_SUM_ERROR = relative(*[CORRECT] * _WIDEST)
"""The error of a sum of as many products in any order, as a part of their magnitudes' sum.

Each product is rounded once, and then with every term that is added to it.
"""
_FLUSHED = _WIDEST * SMALLEST_NORMAL
"""The further loss of such a sum, where products are flushed to zero."""
_LENGTH_ERROR = (1.0 + _SUM_ERROR) * (1.0 + ROOT_ERROR) - 1.0
SHORTEST = 2.0**-60
"""The least length whose square is far above the numbers that a device may flush to zero."""


def _is_float(facts: tuple[Fact, ...]) -> bool:
    return facts[0].kind == "float"


def _inner(facts: tuple[Fact, ...], same: bool) -> Fact:
    x, y = facts
    if not _is_float(facts):
        return Fact().as_kind(x.kind)
    lo, hi = squares(x) if same else products(x, y)
    lo, hi = min(_NARROWEST * lo, _WIDEST * lo), max(_NARROWEST * hi, _WIDEST * hi)
    error = product(_WIDEST * product(x.most, y.most), _SUM_ERROR) + _FLUSHED
    total = around(Fact(lo, hi), error)
    total = Fact(max(total.lo, 0.0), total.hi) if lo >= 0 else total
    if same and x.length:
        shortest = product(x.length, x.length) * (1.0 - _SUM_ERROR) - _FLUSHED
        total = total.meet(Fact(max(shortest, 0.0)))
    return total.meet(UNIT_PRODUCT) if x.unit and y.unit else total


UNIT_PRODUCT = Fact(-1.0 - UNIT_SLACK, 1.0 + UNIT_SLACK)
"""The range of the product of two vectors of length one.

Rounding may make it larger than 1, so ``acos`` keeps its clamp.
"""


def _outer(facts: tuple[Fact, ...], _same: bool) -> Fact:
    x, y = facts
    if x.unit and y.unit:
        return UNIT_PRODUCT
    bound = product(2.0 * product(x.most, y.most), 1.0 + _SUM_ERROR)
    return Fact(-bound, bound)


def _norm(facts: tuple[Fact, ...], _same: bool) -> Fact:
    (x,) = facts
    # In four dimensions, the diagonal of a box is at most twice its side.
    longest = 1.0 + UNIT_SLACK if x.unit else product(2.0 * x.most, 1.0 + _LENGTH_ERROR)
    shortest = x.length * (1.0 - _LENGTH_ERROR) if x.length >= SHORTEST else 0.0
    return Fact(min(shortest, longest), longest)


def _apart(facts: tuple[Fact, ...], same: bool) -> Fact:
    x, y = facts
    if same:
        return Fact(0.0, 0.0)
    return _norm((rounded(x.lo - y.hi, x.hi - y.lo),), False)


def _direction(_facts: tuple[Fact, ...], _same: bool) -> Fact:
    return UNIT


def _mirrored(facts: tuple[Fact, ...], _same: bool) -> Fact:
    incident, normal = facts
    return UNIT if incident.unit and normal.unit else UNKNOWN


def _turned(facts: tuple[Fact, ...], _same: bool) -> Fact:
    normal = facts[0]
    return Fact(-normal.most, normal.most, normal.nonzero, normal.unit)


def _promised(facts: tuple[Fact, ...], _same: bool) -> Fact:
    (x,) = facts
    return changed(x, length=max(x.length, SHORTEST))


def _has_direction(facts: tuple[Fact, ...]) -> bool:
    (x,) = facts
    return x.unit or x.length >= SHORTEST


_BY_ROOT = Inherited("x * inversesqrt(dot(x, x))")
UNIT_LENGTH = promised(
    Inherited("x / length(x)"),
    {
        **in_table("vulkan", _BY_ROOT),
        **silent(_BY_ROOT, "HLSL's compiler writes it so", "direct3d"),
    },
)

ROWS = (
    Builtin(
        name="dot",
        signatures=(*_PAIR, *_WHOLE_PAIR),
        meaning="measure",
        doc="Inner product: the sum of the products of the lanes. Integers wrap.",
        definition="sum_of_products",
        range=_inner,
        accuracy=inherited("the sum of x[i] * y[i]"),
        cost=1,
    ),
    Builtin(
        name="cross",
        signatures=("vec3, vec3 -> vec3",),
        meaning="perpendicular",
        doc="The vector perpendicular to both, by the right-hand rule.",
        range=_outer,
        accuracy=inherited("x[i] * y[j] - x[j] * y[i]"),
        cost=2,
    ),
    Builtin(
        name="length",
        signatures=("V -> S",),
        meaning="measure",
        doc="Length of a vector.",
        range=_norm,
        accuracy=inherited("sqrt(dot(x, x))"),
        cost=6,
        samples=((0.0,), (1e-30,)),
    ),
    Builtin(
        name="distance",
        signatures=_PAIR,
        meaning="distance",
        doc="Distance between two points: length(x - y).",
        range=_apart,
        accuracy=inherited("length(x - y)"),
        cost=7,
    ),
    Builtin(
        name="normalize",
        signatures=("V -> V",),
        meaning="unit",
        doc="The vector of length one in the same direction.",
        domain=_has_direction,
        needs="the vector has a length above 0",
        outside=(
            "v * inversesqrt(max(dot(v, v), 2^-126)): 0 for the zero vector, and continuous; "
            "a vector shorter than 2^-63 stays shorter than one."
        ),
        expansion="normalize",
        range=_direction,
        accuracy=UNIT_LENGTH,
        cost=6,
        samples=((0.0,), (1e-30,), (3.0,)),
    ),
    Builtin(
        name="nonzero",
        signatures=("V -> V",),
        meaning="negation",
        doc=(
            "The vector itself, with the promise that it is not zero: the host, or whoever writes "
            "this, promises a length of at least 2^-60. So `normalize`, and a division by its "
            "length, need no guard."
        ),
        domain=nowhere,
        is_promise=True,
        outside="The vector itself. If the promise is broken, what depends on it is undefined.",
        expansion="nonzero",
        range=_promised,
        accuracy=EXACT,
        cost=0,
        samples=((3.0,),),
    ),
    Builtin(
        name="reflect",
        signatures=("V, V -> V",),
        meaning="reflected",
        doc="reflect(i, n): i - 2 * dot(n, i) * n, which mirrors i if n has length one.",
        range=_mirrored,
        accuracy=inherited("x - 2 * dot(x, y) * y"),
        cost=3,
        samples=((1.0, 0.0), (1.0, 2.0)),
    ),
    Builtin(
        name="refract",
        signatures=("V, V, S -> V",),
        meaning="reflected",
        doc="refract(i, n, eta): i refracted at a surface; 0 at total reflection.",
        outside="The same formula is used for vectors whose length is not one.",
        accuracy=inherited("z * x - (z * dot(y, x) + sqrt(k)) * y"),
        cost=10,
        samples=((0.5, 0.5, 1.5), (0.6, -0.6, 0.75)),
    ),
    Builtin(
        name="faceforward",
        signatures=("V, V, V -> V",),
        meaning="turned",
        doc="faceforward(n, i, r): n where dot(r, i) < 0, else -n.",
        range=_turned,
        accuracy=inherited("dot(z, y) < 0 ? x : -x"),
        cost=2,
    ),
    Builtin(
        name="lit",
        signatures=("float, float, float -> vec4",),
        meaning="numbers",
        doc="lit(nl, nh, power): ambient, diffuse and specular coefficient of Blinn and Phong, 1.",
        domain=nowhere,
        outside="(1, max(nl, 0), 0 where nl < 0 or nh < 0 else pow(nh, power), 1).",
        expansion="lit",
        cost=12,
        samples=((0.5, 0.5, 8.0), (-0.5, 0.5, 8.0), (0.5, -0.5, 8.0), (0.0, 0.0, 0.0)),
    ),
)
