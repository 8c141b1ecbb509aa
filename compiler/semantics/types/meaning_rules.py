"""The typing rules of meanings: the meaning of each operation's result, or why it has none.

One rule for each way of working, named by the ``meaning`` column of the builtins' rows. A rule sees
only meanings and types. A side without a meaning is a bare number, which fits everywhere: rules
then say what is certain, and never object.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise

from ....support.frozen import changed, frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Rule
from ...ir.meaning import ANGLE, ARROWS, COLORS, GEOMETRY, MAPS, Meaning
from ...ir.node import Node, bare
from ...ir.types import Matrix, Scalar, Type, Vector


@frozen
class Side:
    """An operand as the rules see it."""

    type: Type
    meaning: Meaning | None
    equal: bool = False
    """True if it is a bare number, or that number in every lane.

    It may then be a distance or a factor as well as a vector. A value that was declared to have a
    meaning has it, whatever its lanes are.
    """


@frozen
class Clash:
    """Two operands (or one, twice) that have no common meaning, and the way out."""

    rule: Rule
    left: int
    right: int
    hint: str = ""


Found = Meaning | Clash | None
AlgebraRule = Callable[[tuple[Side, ...], Type], Found]


def side(node: Node, meaning: Meaning | None) -> Side:
    """An operand for the rules."""
    alike = isinstance(node.type, Scalar) or bare(node).op == "splat"
    return Side(node.type, meaning, alike and meaning is None)


# --- shared by several rules ---------------------------------------------------------------------


def family(meaning: Meaning) -> str:
    """Meanings of two families never mix."""
    for kinds in (GEOMETRY, COLORS, MAPS):
        if meaning.kind in kinds:
            return min(kinds)
    return meaning.kind


def is_enum(meaning: Meaning | None) -> bool:
    """True for members of an enumeration: they are no numbers, and no number is one of them."""
    return meaning is not None and meaning.enumeration is not None


_EQUALITIES = ("eq", "ne")


def of_members(name: str, sides: tuple[Side, ...]) -> Clash | None:
    """The reason why a builtin does not take members of an enumeration, if one is among them.

    Only equality is more than an operation of numbers.
    """
    if name in _EQUALITIES and len(sides) == 2:
        return alike(sides)
    for i, each in enumerate(sides):
        if is_enum(each.meaning):
            return Clash(rules.NO_NUMBER, i, i)
    return None


def alike(sides: tuple[Side, ...]) -> Clash | None:
    """The reason why two values are not of one enumeration, if one of them is of any."""
    one, other = (s.meaning for s in sides)
    if one == other or not (is_enum(one) or is_enum(other)):
        return None
    if one is not None and other is not None:
        return Clash(rules.MIXED_ENUMS, 0, 1)
    return Clash(rules.MEMBER_AND_NUMBER, *((0, 0) if is_enum(one) else (1, 1)))


def fits(found: Meaning | None, wanted: Meaning | None) -> bool:
    """True if a value of one meaning may stand where another is wanted.

    Bare numbers always may, but for members of an enumeration.
    """
    if found == wanted:
        return True
    if is_enum(found) or is_enum(wanted):
        return False
    if found is None or wanted is None:
        return True
    arrows = found.kind in ARROWS and wanted.kind in ARROWS
    return arrows and found.spaces == wanted.spaces


def weakened(meaning: Meaning | None) -> Meaning | None:
    """The meaning once nothing is known of the length any more."""
    if meaning is not None and meaning.kind == "direction":
        return Meaning("vector", meaning.spaces)
    return meaning


def apart(sides: tuple[Side, ...]) -> Clash | None:
    """The reason why operands do not belong together: families that do not mix, or two spaces."""
    known = [(i, s.meaning) for i, s in enumerate(sides) if s.meaning is not None]
    for (i, first), (j, second) in pairwise(known):
        if family(first) != family(second):
            return Clash(rules.MIXED_MEANINGS, i, j, _of_families(first, second))
        if first.kind in GEOMETRY and first.spaces != second.spaces:
            return Clash(rules.MIXED_SPACES, i, j)
    return None


def _of_families(one: Meaning, other: Meaning) -> str:
    """The hint for values of two families that do not mix."""
    kinds = {one.kind, other.kind}
    if kinds & COLORS and kinds & GEOMETRY:
        return "a colour has no place and no direction: `vec3(c)` is its bare numbers"
    return ""


def joined(one: Meaning | None, other: Meaning | None) -> Meaning | None:
    """The meaning of a value that may be either of two that are not ``apart``, if there is one."""
    if one is None or other is None:
        return weakened(one or other)
    if one == other:
        return one
    if one.kind in ARROWS and other.kind in ARROWS:
        return Meaning("vector", one.spaces)
    return None


def _point(sides: tuple[Side, ...]) -> Clash | None:
    """A point is a place, with no length and no direction."""
    for i, each in enumerate(sides):
        if each.meaning is not None and each.meaning.kind == "point":
            return Clash(rules.NOT_OF_A_POINT, i, i)
    return None


def _arrow(meaning: Meaning | None, kind: str = "vector") -> Meaning | None:
    if meaning is None or meaning.kind not in ARROWS:
        return None
    return Meaning("direction" if kind == "direction" else "vector", meaning.spaces)


def _first(sides: tuple[Side, ...]) -> Meaning | None:
    return next((s.meaning for s in sides if s.meaning is not None), None)


# --- sums and products ---------------------------------------------------------------------------

MIX = "a place between two points is `mix(a, b, t)`; from one to the other leads `b - a`"


def _sum(sides: tuple[Side, ...], result: Type) -> Found:
    return apart(sides) or _summed(sides, result, _points_added)


def _difference(sides: tuple[Side, ...], result: Type) -> Found:
    return apart(sides) or _summed(sides, result, _points_subtracted)


def _summed(
    sides: tuple[Side, ...], result: Type, of_points: Callable[[tuple[Side, ...]], Found]
) -> Found:
    one, other = (s.meaning for s in sides)
    known = one or other
    if known is None or known.kind in MAPS:
        return None
    if known.kind == "angle":
        return ANGLE if isinstance(result, Scalar) else None
    if known.kind in COLORS:
        return known
    if any(s.equal for s in sides):
        return None
    if any(s.meaning is not None and s.meaning.kind == "point" for s in sides):
        return of_points(sides)
    return known if one == other and known.kind == "normal" else _arrow(known)


def _points_added(sides: tuple[Side, ...]) -> Found:
    one, other = (s.meaning for s in sides)
    if one == other:
        return Clash(rules.MIXED_MEANINGS, 0, 1, MIX)
    return one if one is not None and one.kind == "point" else other


def _points_subtracted(sides: tuple[Side, ...]) -> Found:
    one, other = (s.meaning for s in sides)
    if one is None or other is None:  # A bare number may be a point here, or a vector.
        return None
    if one == other:
        return Meaning("vector", one.spaces)
    if one.kind == "point":
        return one
    return Clash(rules.MIXED_MEANINGS, 0, 1, "from one point to another leads their difference")


def _product(sides: tuple[Side, ...], result: Type) -> Found:
    one, other = sides
    if isinstance(one.type, Matrix) or isinstance(other.type, Matrix):
        return _mapped(one, other)
    return _scaled(sides, result)


def _quotient(sides: tuple[Side, ...], result: Type) -> Found:
    one, other = sides
    if other.meaning is not None and other.meaning.kind == "angle":
        return None
    scaled = _scaled(sides, result)
    if isinstance(scaled, Clash) or one.meaning is not None:
        return scaled
    return scaled if scaled is not None and scaled.kind in COLORS else None


def _scaled(sides: tuple[Side, ...], result: Type) -> Found:
    one, other = (s.meaning for s in sides)
    turning = ANGLE in (one, other)
    clash = None if turning else apart(sides)
    known = one or other
    if clash is not None or known is None:
        return clash
    if one is not None and other is not None:
        return known if known.kind in COLORS and not turning else None
    factor = sides[0] if one is None else sides[1]
    if known.kind == "angle":
        return ANGLE if isinstance(result, Scalar) else None
    if known.kind in COLORS:
        return known
    return weakened(known) if known.kind in ARROWS and factor.equal else None


def _mapped(one: Side, other: Side) -> Found:
    """A matrix times a matrix or a vector; ``transform * point`` of three lanes is no builtin."""
    by, what = one.meaning, other.meaning
    if by is None or by.kind not in MAPS or what is None:
        return _bare_moved(by, other)
    if what.kind in MAPS:
        if what.spaces[1] != by.spaces[0]:
            hint = f"the right one leads into `{what.spaces[1]}`, the left one on from elsewhere"
            return Clash(rules.MIXED_SPACES, 0, 1, hint)
        return Meaning(by.kind, (what.spaces[0], by.spaces[1]))
    found = moved(by, what)
    # Four lanes stay homogeneous numbers, until they are said to be a point.
    return None if what.kind == "point" and isinstance(found, Meaning) else found


def _bare_moved(by: Meaning | None, other: Side) -> Meaning | None:
    if by is not None and by.kind == "basis" and isinstance(other.type, Vector):
        return Meaning("vector", (by.spaces[1],)) if other.meaning is None else None
    return None


def moved(by: Meaning, what: Meaning) -> Meaning | Clash:
    """The meaning of a point or vector that a transform or basis to its left has moved."""
    if what.kind not in GEOMETRY:
        return Clash(rules.MIXED_MEANINGS, 0, 1)
    if what.spaces != by.spaces[:1]:
        return Clash(rules.MIXED_SPACES, 0, 1)
    if what.kind == "normal":
        return Clash(rules.MIXED_MEANINGS, 0, 1)
    if what.kind == "point" and by.kind == "basis":
        hint = "a basis has no origin; it turns vectors"
        return Clash(rules.MIXED_MEANINGS, 0, 1, hint)
    return Meaning("point" if what.kind == "point" else "vector", by.spaces[1:])


def _remainder(sides: tuple[Side, ...], result: Type) -> Found:
    if sides[0].meaning == ANGLE and isinstance(result, Scalar):
        return apart(sides) or ANGLE
    return _lanes(sides, result)


def _negation(sides: tuple[Side, ...], _result: Type) -> Found:
    (only,) = (s.meaning for s in sides)
    return only if only is not None and only.kind not in MAPS | {"point"} else None


# --- lane by lane --------------------------------------------------------------------------------


def _numbers(sides: tuple[Side, ...], _result: Type) -> Found:
    """The rule of operations whose result is a mere number."""
    return apart(sides)


def _texel(sides: tuple[Side, ...], _result: Type) -> Found:
    """The rule of reads of whole texels, which mean what their texture declares."""
    return _asked(sides) or sides[0].meaning


def _of_texture(sides: tuple[Side, ...], _result: Type) -> Found:
    """The rule of other questions to a texture, whose results are mere numbers."""
    return _asked(sides)


def _asked(sides: tuple[Side, ...]) -> Clash | None:
    """The reason why the arguments of a read, behind its texture, do not belong together."""
    return apart((changed(sides[0], meaning=None), *sides[1:]))


def _lanes(sides: tuple[Side, ...], result: Type) -> Found:
    """The rule of operations lane by lane: colours stay colours, and geometry is lost."""
    known = _first(sides)
    clash = apart(sides)
    if clash is not None or known is None or known.kind not in COLORS:
        return clash
    return known if result == Vector("float", 3 if known.kind == "rgb" else 4) else None


def _limits(sides: tuple[Side, ...], result: Type) -> Found:
    """The rule of limits, which work lane by lane: colours and angles stay such."""
    found = _lanes(sides, result)
    is_angle = _first(sides) == ANGLE and isinstance(result, Scalar)
    return ANGLE if found is None and is_angle else found


def _blend(sides: tuple[Side, ...], _result: Type) -> Found:
    one, other, _share = sides
    clash = apart((one, other))
    known = one.meaning or other.meaning
    if clash is not None or known is None:
        return clash
    if known.kind in GEOMETRY and (one.equal or other.equal):
        return None
    found = weakened(joined(one.meaning, other.meaning))
    both = one.meaning is not None and other.meaning is not None
    return Clash(rules.MIXED_MEANINGS, 0, 1) if found is None and both else found


def _change(sides: tuple[Side, ...], _result: Type) -> Found:
    """The rule of differences between pixels: that of a point is the vector between them."""
    (only,) = (s.meaning for s in sides)
    if only is not None and only.kind in GEOMETRY:
        return Meaning("vector", only.spaces)
    return only


def _makes_angle(_sides: tuple[Side, ...], result: Type) -> Found:
    return ANGLE if isinstance(result, Scalar) else None


# --- geometry ------------------------------------------------------------------------------------


def _measure(sides: tuple[Side, ...], _result: Type) -> Found:
    return _point(sides) or apart(sides)


def _distance(sides: tuple[Side, ...], _result: Type) -> Found:
    kinds = {s.meaning.kind == "point" for s in sides if s.meaning is not None}
    return apart(sides) or (Clash(rules.MIXED_MEANINGS, 0, 1) if len(kinds) > 1 else None)


def _perpendicular(sides: tuple[Side, ...], _result: Type) -> Found:
    return _measure(sides, _result) or _arrow(_first(sides))


def _unit(sides: tuple[Side, ...], _result: Type) -> Found:
    known = _first(sides)
    if known is not None and known.kind == "normal":
        return known
    return _point(sides) or _arrow(known, "direction")


def _reflected(sides: tuple[Side, ...], _result: Type) -> Found:
    directions = all(s.meaning is not None and s.meaning.kind == "direction" for s in sides[:2])
    kind = "direction" if directions and len(sides) == 2 else "vector"
    return _measure(sides, _result) or _arrow(_first(sides), kind)


def _turned(sides: tuple[Side, ...], _result: Type) -> Found:
    return _measure(sides, _result) or sides[0].meaning


def _reversed(sides: tuple[Side, ...], _result: Type) -> Found:
    (only,) = (s.meaning for s in sides)
    return Meaning(only.kind, only.spaces[::-1]) if only is not None else None


RULES: Mapping[str, AlgebraRule] = {
    "sum": _sum,
    "difference": _difference,
    "product": _product,
    "quotient": _quotient,
    "remainder": _remainder,
    "negation": _negation,
    "numbers": _numbers,
    "texel": _texel,
    "of_texture": _of_texture,
    "lanes": _lanes,
    "limits": _limits,
    "blend": _blend,
    "change": _change,
    "angle": _makes_angle,
    "measure": _measure,
    "distance": _distance,
    "perpendicular": _perpendicular,
    "unit": _unit,
    "reflected": _reflected,
    "turned": _turned,
    "reversed": _reversed,
}
"""The rules, by the ``meaning`` of a builtin's row."""


def chosen(sides: tuple[Side, ...]) -> Found:
    """The meaning of a choice between two values."""
    clash = alike(sides) or apart(sides)
    if clash is not None:
        return clash
    one, other = (s.meaning for s in sides)
    found = joined(one, other)
    both = one is not None and other is not None
    return Clash(rules.MIXED_MEANINGS, 0, 1) if found is None and both else found


def gathered(sides: Sequence[Side]) -> Found:
    """The meaning of all elements of an array; a bare number among them has that of the others."""
    last, found = 0, sides[0].meaning
    for i, each in enumerate(sides[1:], 1):
        together = chosen((Side(each.type, found), each))
        if isinstance(together, Clash) and together.rule is rules.MEMBER_AND_NUMBER:
            of_enum_ = last if is_enum(found) else i
            return Clash(together.rule, of_enum_, of_enum_)
        if isinstance(together, Clash):
            return Clash(together.rule, last, i, together.hint)
        if each.meaning is not None:
            last = i
        found = together
    return found
