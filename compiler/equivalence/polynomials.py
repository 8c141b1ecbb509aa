"""Proves that two terms are equal by algebra: their difference, multiplied out, vanishes.

A difference is a polynomial with exact coefficients, whose variables ("atoms") are terms. An atom
is replaced by what it is made of, the youngest one first, so that what both terms share cancels
before anybody looks into it. Roots, choices and quotients are atoms with a relation: the square of
a root is what is under it, and a condition is its own square.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Mapping, Sequence
from fractions import Fraction

from .products import (
    ONE,
    Monomial,
    Polynomial,
    alone,
    difference,
    exponent_of,
    made,
    put,
    times,
)
from .term import Term, value_of
from .terms import Terms

LARGEST = 1500
"""The most products in a polynomial; what has more is not decided by algebra."""
MOST_STEPS = 600
"""The most atoms that are replaced in one difference."""
MOST_WORK = 40_000
"""The most products that one difference may take."""


class UnwieldyError(Exception):
    """A difference has too many products, or takes too many steps."""


class Algebra:
    """Multiplies differences out; ``work`` counts the products that it has made."""

    def __init__(self, terms: Terms) -> None:
        self._terms = terms
        self._conditions: dict[frozenset[tuple[Monomial, Fraction]], int] = {}
        """For each comparison, as a difference of which is asked if it is positive, an atom."""
        self._powers: dict[object, Term] = {}
        """Powers by their bases and their exponents, multiplied out."""
        self._simple: set[Monomial] = set()
        """Products for which there is no relation."""
        self._same: dict[int, Polynomial] = {}
        """Comparisons as others that ask the same."""
        self.work = 0
        self._asked: set[int] = set()
        """The terms that are compared."""
        self._until = MOST_WORK
        """The work up to which the present difference may go."""

    def are_equal(self, x: Term, y: Term, kept: Sequence[Container[int]] = ()) -> bool:
        """True if the difference of two terms vanishes everywhere.

        ``kept`` are sets of terms, by their ids, which are tried one after the other: these terms
        stay as they are. Where a difference vanishes that is made of what both programs have, it
        does so in few steps. In the end, all terms are looked into.
        """
        self._asked = {x.id, y.id}
        for root, other in ((x, y), (y, x)):
            if root.op == "sqrt" and other.op != "sqrt" and other.span.low >= 0:
                square = made((ONE, other, other), (-ONE, root.args[0]))
                if self._is_nothing(square, kept):
                    return True
        return self._is_nothing(difference(x, y), kept)

    def difference(self, x: Term, y: Term, shared: Container[int]) -> Term:
        """The difference of two terms as a sum of products, of which as many as possible cancel.

        What is ``shared`` stays as it is. Bounds of such a sum are often much tighter.
        """
        numbers = [self._terms.term(self._terms.as_float(each)) for each in (x, y)]
        plain = self._terms.term(numbers[0] - numbers[1])
        self._until = self.work + MOST_WORK
        try:
            return self._sum(self._expanded(difference(x, y), shared))
        except UnwieldyError:
            return plain

    def _sum(self, polynomial: Polynomial) -> Term:
        """The term that a polynomial is."""
        total = self._terms.constant(0.0)
        for product, factor in sorted(polynomial.items()):
            part = self._terms.node("constant", (), (factor, "f"))
            for id_, exponent in product:
                for _ in range(exponent):
                    part = self._terms.mul(part, self._terms.as_float(self._terms.all[id_]))
            total = self._terms.add(total, part)
        return total

    def _is_nothing(self, polynomial: Polynomial, all_kept: Sequence[Container[int]]) -> bool:
        for kept in (*all_kept, ()):
            self._until = self.work + MOST_WORK
            try:
                if self._vanishes(polynomial, kept, 0):
                    return True
            except UnwieldyError:
                continue
        return False

    def _vanishes(self, polynomial: Polynomial, kept: Container[int], depth: int) -> bool:
        for _ in range(MOST_STEPS):
            polynomial = self._reduced(polynomial)
            if not polynomial:
                return True
            atoms = sorted({id_ for product in polynomial for id_, _ in product}, reverse=True)
            if not atoms:
                return False
            for atom in atoms:
                if self._is_kept(atom, kept):
                    continue
                made_of = self._definition(self._terms.all[atom], atoms)
                if made_of is not None:
                    polynomial = self._replaced(polynomial, atom, made_of)
                    break
            else:
                return self._without_quotients(polynomial, atoms, kept, depth)
        raise UnwieldyError

    def _is_kept(self, atom: int, kept: Container[int]) -> bool:
        return atom in kept and atom not in self._asked and self._terms.all[atom].op != "constant"

    def _without_quotients(
        self, polynomial: Polynomial, atoms: list[int], kept: Container[int], depth: int
    ) -> bool:
        """Multiplies by a divisor, if there is one: it is not zero."""
        for atom in atoms:
            term = self._terms.all[atom]
            if term.op not in ("reciprocal", "inverse") or depth > 8:
                continue
            cleared = self._cleared(polynomial, atom, term.args[0].id)
            if term.op == "reciprocal":
                return self._vanishes(cleared, kept, depth + 1)
            alone = self._replaced(polynomial, atom, {})
            return self._vanishes(alone, kept, depth + 1) and self._vanishes(
                cleared, kept, depth + 1
            )
        return False

    def _cleared(self, polynomial: Polynomial, atom: int, divisor: int) -> Polynomial:
        """The polynomial times a power of a divisor, so that its reciprocal is gone."""
        highest = max(exponent_of(product, atom) for product in polynomial)
        found: Polynomial = {}
        for product, factor in polynomial.items():
            power = highest - exponent_of(product, atom)
            rest = tuple((id_, e) for id_, e in product if id_ != atom)
            put(found, times(rest, ((divisor, power),) if power else ()), factor)
        return found

    # --- replacing --------------------------------------------------------------------------------

    def _replaced(self, polynomial: Polynomial, atom: int, made_of: Polynomial) -> Polynomial:
        """The polynomial with another one in place of an atom."""
        found: Polynomial = {}
        powers: list[Polynomial] = [{(): ONE}]
        for product, factor in polynomial.items():
            exponent = exponent_of(product, atom)
            if not exponent:
                put(found, product, factor)
                continue
            while len(powers) <= exponent:
                powers.append(self._product(powers[-1], made_of))
            rest = tuple((id_, e) for id_, e in product if id_ != atom)
            for other, by in powers[exponent].items():
                put(found, times(rest, other), factor * by)
            self._spend(len(powers[exponent]), found)
        return found

    def _product(self, x: Polynomial, y: Polynomial) -> Polynomial:
        found: Polynomial = {}
        for one, a in x.items():
            for other, b in y.items():
                put(found, times(one, other), a * b)
            self._spend(len(y), found)
        return found

    def _spend(self, products: int, made: Polynomial) -> None:
        self.work += products
        if len(made) > LARGEST or self.work > self._until:
            raise UnwieldyError

    def _reduced(self, polynomial: Polynomial) -> Polynomial:
        """The polynomial with what follows from relations in place of powers of atoms."""
        while True:
            self._spend(sum(map(len, polynomial)) // 4, polynomial)
            found: Polynomial = {}
            changed = False
            for product, factor in polynomial.items():
                other = None if product in self._simple else self._related(product)
                if other is None:
                    self._simple.add(product)
                    put(found, product, factor)
                    continue
                changed = True
                for one, by in other.items():
                    put(found, one, factor * by)
            if not changed:
                return found
            polynomial = found

    def _related(self, product: Monomial) -> Polynomial | None:
        """What a product is by a relation; ``None`` if there is none."""
        for number, (id_, exponent) in enumerate(product):
            term = self._terms.all[id_]
            rest = product[:number] + product[number + 1 :]
            if term.op in ("reciprocal", "inverse_root") and (
                shorter := self._cancelled(term, exponent, rest)
            ):
                return shorter
            if exponent < 2:
                continue
            square = self._square(term)
            if square is not None:
                left = ((id_, exponent - 2),) if exponent > 2 else ()
                around = times(rest, left)
                return {times(around, one): by for one, by in square.items()}
        return self._joined(product)

    def _cancelled(self, term: Term, exponent: int, rest: Monomial) -> Polynomial | None:
        """A reciprocal times what it is the reciprocal of."""
        of = term.args[0].id
        if term.op == "inverse_root":
            roots = (id_ for id_, _ in rest if self._is_root(id_, term.args[0]))
            of = next(roots, -1)
        beside = exponent_of(rest, of)
        if not beside:
            return None
        both = min(beside, exponent)
        others = tuple((i, e - both if i == of else e) for i, e in rest if i != of or e > both)
        left = ((term.id, exponent - both),) if exponent > both else ()
        return {times(others, left): ONE}

    def _is_root(self, atom: int, of: Term) -> bool:
        term = self._terms.all[atom]
        return term.op == "sqrt" and term.args[0] is of

    def _square(self, term: Term) -> Polynomial | None:
        """The square of an atom, if there is a relation for it."""
        if term.kind == "b":
            return alone(term)
        if term.op == "sqrt":
            return alone(term.args[0])
        if term.op == "abs":
            return {((term.args[0].id, 2),): ONE}
        if term.op == "inverse_root":
            return alone(self._terms.term(self._terms.reciprocal(term.args[0])))
        if term.op == "sin":
            return {(): ONE, ((self._terms.node("cos", term.args).id, 2),): -ONE}
        if term.id in self._terms.units:
            lanes = self._terms.units[term.id]
            return {(): ONE, **{((lane.id, 2),): -ONE for lane in lanes}}
        return None

    def _joined(self, product: Monomial) -> Polynomial | None:
        """Powers of one base, joined to one."""
        bases: dict[tuple[str, int], list[tuple[Term, int]]] = {}
        for id_, exponent in product:
            term = self._terms.all[id_]
            if term.op in ("exp2", "power"):
                base = term.args[0].id if term.op == "power" else -1
                bases.setdefault((term.op, base), []).append((term, exponent))
        for (op, _), found in bases.items():
            if len(found) < 2 and found[0][1] < 2:
                continue
            total: Polynomial = {}
            for term, exponent in found:
                put(total, ((term.args[-1].id, 1),), Fraction(exponent))
            joined = self._power_of(op, found[0][0].args[:-1], self._expanded(total))
            ids = {term.id for term, _ in found}
            rest = tuple((id_, e) for id_, e in product if id_ not in ids)
            return {times(rest, ((joined.id, 1),)): ONE}
        return None

    def _power_of(self, op: str, base: tuple[Term, ...], exponent: Polynomial) -> Term:
        """The power of a base with an exponent that is given as a polynomial."""
        key = (op, *(term.id for term in base)), frozenset(exponent.items())
        if key not in self._powers:
            total = self._sum(exponent)
            self._powers[key] = self._terms.term(self._terms.make(op, (*base, total)))
        return self._powers[key]

    # --- what atoms are made of -------------------------------------------------------------------

    def _definition(self, term: Term, beside: list[int]) -> Polynomial | None:
        """What an atom is made of; ``None`` if nothing is known of that."""
        if (found := _plainly(term)) is not None:
            return found
        rule = _DEFINITIONS.get(term.op)
        if rule is not None:
            return rule(self, term)
        if term.op == "less":
            return self._comparison(term)
        if term.op == "exp2":
            joined = self._power_of("exp2", (), self._expanded(alone(term.args[0])))
            return None if joined is term else alone(joined)
        if term.op == "sqrt":
            inverse = self._terms.node("inverse_root", term.args)
            return made((ONE, term.args[0], inverse)) if inverse.id in beside else None
        return None

    def _comparison(self, term: Term) -> Polynomial | None:
        """A comparison as another one that was met before and asks the same."""
        if term.id not in self._same:
            x, y = term.args
            self._same[term.id] = alone(term)
            try:
                asked = self._expanded(difference(y, x))
            except UnwieldyError:
                return None
            if asked:
                scale = abs(asked[max(asked)])
                key = frozenset((product, by / scale) for product, by in asked.items())
                first = self._conditions.setdefault(key, term.id)
                self._same[term.id] = alone(self._terms.all[first])
        same = self._same[term.id]
        return None if same == alone(term) else same

    def _expanded(self, polynomial: Polynomial, kept: Container[int] = ()) -> Polynomial:
        """The polynomial of the atoms in which sums and products end."""
        for _ in range(MOST_STEPS):
            polynomial = self._reduced(polynomial)
            atoms = sorted({id_ for product in polynomial for id_, _ in product}, reverse=True)
            for atom in atoms:
                term = self._terms.all[atom]
                made_of = None if atom in kept and term.args else _plainly(term)
                if made_of is not None:
                    polynomial = self._replaced(polynomial, atom, made_of)
                    break
            else:
                return polynomial
        raise UnwieldyError

    def _choice(self, condition: object, x: Term, y: Term) -> Polynomial:
        """``x`` where a condition holds, else ``y``."""
        if isinstance(condition, bool):
            return alone(x if condition else y)
        assert isinstance(condition, Term)
        return made((ONE, condition, x), (ONE, y), (-ONE, condition, y))


def _extreme(algebra: Algebra, term: Term) -> Polynomial:
    x, y = term.args
    less = algebra._terms.less(x, y)
    return algebra._choice(less, *((x, y) if term.op == "min" else (y, x)))


def _absolute(algebra: Algebra, term: Term) -> Polynomial:
    (x,) = term.args
    below = algebra._terms.less(x, 0.0)
    return algebra._choice(below, algebra._terms.negative(x), x)


def _power(_algebra: Algebra, term: Term) -> Polynomial | None:
    """A power with a whole part as a product with the rest of it."""
    base, exponent = term.args
    value = value_of(exponent)
    if value is None or value <= 1:
        return None
    whole = min(int(value), 16)
    rest = _algebra._terms.term(_algebra._terms.power(
        base, _algebra._terms.node("constant", (), (value - whole, "f"))))  # fmt: skip
    return {times(((base.id, whole),), ((rest.id, 1),)): ONE}


def _plainly(term: Term) -> Polynomial | None:
    """What a sum, a product or a constant is; ``None`` for all others."""
    if term.op == "constant":
        return {(): term.data[0]} if term.data[0] else {}
    if term.op == "add":
        return made((ONE, term.args[0]), (ONE, term.args[1]))
    if term.op == "mul":
        return made((ONE, *term.args))
    return alone(term.args[0]) if term.op == "float" else None


_DEFINITIONS: Mapping[str, Callable[[Algebra, Term], Polynomial | None]] = {
    "not": lambda _a, term: {(): ONE, ((term.args[0].id, 1),): -ONE},
    "and": lambda _a, term: made((ONE, *term.args)),
    "where": lambda a, term: a._choice(*term.args),
    "min": _extreme,
    "max": _extreme,
    "abs": _absolute,
    "power": _power,
}
