"""Polynomials with exact coefficients, whose variables are terms, by their ids.

``polynomials.py`` multiplies differences out with them.
"""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction

from .term import Term

Monomial = tuple[tuple[int, int], ...]
"""The ids of atoms with their exponents, in order."""
Polynomial = dict[Monomial, Fraction]
ONE = Fraction(1)


def is_linear(term: Term) -> bool:
    """True for a sum, and for a multiple of one term."""
    return term.op == "add" or (term.op == "mul" and term.args[0].op == "constant")


def difference(x: Term, y: Term) -> Polynomial:
    return made((ONE, x), (-ONE, y))


def alone(term: Term) -> Polynomial:
    return {((term.id, 1),): ONE}


def made(*products: tuple[Fraction | Term, ...]) -> Polynomial:
    """A polynomial of products of terms, each behind its factor."""
    found: Polynomial = {}
    for factor, *atoms in products:
        assert isinstance(factor, Fraction)
        product: Monomial = ()
        for atom in _terms_of(atoms):
            product = times(product, ((atom.id, 1),))
        put(found, product, factor)
    return found


def _terms_of(atoms: list[Fraction | Term]) -> Iterator[Term]:
    for atom in atoms:
        assert isinstance(atom, Term)
        yield atom


def exponent_of(product: Monomial, atom: int) -> int:
    return next((exponent for id_, exponent in product if id_ == atom), 0)


def put(polynomial: Polynomial, product: Monomial, factor: Fraction) -> None:
    """Add a product to a polynomial; what cancels is gone."""
    total = polynomial.get(product, 0) + factor
    if total:
        polynomial[product] = Fraction(total)
    else:
        polynomial.pop(product, None)


def times(x: Monomial, y: Monomial) -> Monomial:
    """The product of two products."""
    if not x or not y:
        return x or y
    powers = dict(x)
    for id_, exponent in y:
        powers[id_] = powers.get(id_, 0) + exponent
    return tuple(sorted(powers.items()))
