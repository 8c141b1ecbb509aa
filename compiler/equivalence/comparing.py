"""Compares two shaders: proves that they mean the same, or finds where they do not.

``api/sameness.py`` calls ``compare`` with the shaders that semantics has made of two materials.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Literal

import numpy as np

from ...support.frozen import frozen
from ..ir.shader import Shader
from .boxes import Region, cut, whole
from .domain import Domain
from .interfaces import check_types, notes_of, with_common
from .names import NamedValue, named_values
from .numbers import Array, Numbers
from .programs import Lane, NotComparableError, lanes_of
from .searching import Found, Search
from .shrinking import simplest, start_of
from .subdividing import Proof, subdivided
from .sweeping import swept
from .term import Term, below
from .terms import Terms

Verdict = Literal["same", "different", "undecided"]
Means = Literal["expression", "algebra", "bounds", "points"]
"""By what it was decided: both are the same expression; terms are equal by algebra; bounds of the
difference over boxes; or a point at which they differ."""

EPSILON = 1e-4
"""The difference that is allowed by default: less than a step of a display with 12 bits."""
WORK = 10_000_000
"""The number of terms in all boxes that are looked at by default."""
MOST_BOXES = 200_000
"""The most boxes that are looked at by default."""
_FOR_CUT = 0.25
"""The part of the boxes that may go into what both programs have in common."""


@frozen
class Settings:
    """What a comparison is asked for."""

    epsilon: float = EPSILON
    boxes: int | None = None
    """The most boxes that are looked at; without one, as many as ``WORK`` allows."""
    seed: int = 1
    first: Domain = Domain({}, {})
    second: Domain = Domain({}, {})
    tell: Callable[[float], None] = lambda _share: None
    """Called with the share of the space that is proven so far."""


@frozen
class Witness:
    """A point at which both programs differ by more than is allowed."""

    values: Mapping[str, float]
    """What the result depends on, by name."""
    read: Mapping[str, float]
    """What is read of textures and buffers there, by name; of several reads, with a number."""
    special: tuple[str, ...]
    """The names of those that are not at their defaults: zero, if none is declared."""
    lane: str
    """The lane that differs most."""
    first: float
    second: float
    lanes: Mapping[str, tuple[float, float]]
    """Both numbers of each lane of the same result."""
    source: NamedValue | None
    """The first named value that differs at this point."""
    is_edge: bool
    """True if they differ only where two compared numbers are equal."""

    @property
    def difference(self) -> float:
        """The distance of both numbers."""
        return abs(self.first - self.second)


@frozen
class OpenBox:
    """The largest box for which nothing was proven."""

    ranges: Mapping[str, tuple[float, float]]
    bound: float
    """The largest difference that there may be in all that is not proven."""


@frozen
class Comparison:
    """What is known of two programs."""

    verdict: Verdict
    means: Means | None
    proven: float
    """The share of the space in which they are equal, from 0 to 1."""
    bound: float
    """The largest difference that there may be where it is proven that they are equal."""
    boxes: int = 0
    points: int = 0
    seen: float = 0.0
    """The largest difference that was seen at a point, as a part of what is allowed."""
    witness: Witness | None = None
    open: OpenBox | None = None
    notes: tuple[str, ...] = ()
    domain: Mapping[str, tuple[float, float]] = {}
    """The variables on which the results depend, with their ranges."""


def compare(first: Shader, second: Shader, settings: Settings) -> Comparison:
    """Compares two shaders. Raises ``NotComparableError`` and ``programs.TooLargeError``."""
    terms = Terms()
    return _Comparing(terms, first, second, settings).result()


class _Comparing:
    def __init__(self, terms: Terms, first: Shader, second: Shader, settings: Settings) -> None:
        self._terms, self._shaders, self._settings = terms, (first, second), settings
        check_types(first, second)
        ours, theirs = (with_common(first, second, d) for d in (settings.first, settings.second))
        lanes = lanes_of(first, terms, ours)
        others = lanes_of(second, terms, theirs)
        self._lanes = lanes
        self._pairs = list(_paired(lanes, others, first.name, second.name))
        self._notes = tuple(notes_of(first, second))
        self._points, self._seen = 0, 0.0

    def result(self) -> Comparison:
        """What is known of both."""
        pairs = [(x, y) for x, y in self._pairs if x.term is not y.term]
        if not pairs:
            return self._same("expression")
        firsts, seconds = [x for x, _ in pairs], [y for _, y in pairs]
        found = self._searched(_terms(firsts), _terms(seconds), rounds=1)
        if found is not None and not found.is_edge:
            return self._different(found, firsts)
        ours, theirs = swept(self._terms, _terms(firsts), _terms(seconds), self._settings.seed)
        left = [i for i, (x, y) in enumerate(zip(ours, theirs, strict=True)) if x is not y]
        if not left:
            return self._same("algebra")
        lanes = [firsts[i] for i in left]
        ours, theirs = [ours[i] for i in left], [theirs[i] for i in left]
        further = self._searched(ours, theirs, rounds=3) or found
        if further is not None:
            return self._different(further, firsts if further is found else lanes)
        return self._by_bounds(lanes, ours, theirs)

    def _searched(self, first: list[Term], second: list[Term], rounds: int) -> Found | None:
        search = Search(self._terms, first, second, self._settings.epsilon, self._settings.seed)
        found = search.found(rounds)
        if found is not None:
            found = simplest(search, found)
        self._points += search.seen
        self._seen = max(self._seen, search.worst)
        return found

    # --- verdicts ---------------------------------------------------------------------------------

    def _same(self, means: Means, proof: Proof | None = None) -> Comparison:
        bound, boxes = (0.0, 0) if proof is None else (proof.bound, proof.boxes)
        return Comparison(
            "same", means, 1.0, bound, boxes, self._points, self._seen, notes=self._notes,
            domain=self._domain(),
        )  # fmt: skip

    def _by_bounds(self, lanes: list[Lane], first: list[Term], second: list[Term]) -> Comparison:
        """What boxes show, of what both have in common, and then of what comes from outside."""
        epsilon, tell = self._settings.epsilon, self._settings.tell
        near = cut(self._terms, first, second)
        common = subdivided(near, epsilon, max(1, int(self._most(near) * _FOR_CUT)))
        if common.is_complete:
            return self._same("bounds", common)
        region = whole(self._terms, first, second)
        if not all(np.isfinite(term.span).all() for term in region.variables):
            return self._undecided(region, Proof(0.0, 0.0, common.boxes))
        search = Search(self._terms, first, second, epsilon, self._settings.seed)
        met: list[Found] = []

        def look(low: Array, high: Array) -> bool:
            points = {
                term.id: _as_kind(term, 0.5 * (low[row] + high[row]))
                for row, term in enumerate(region.variables)
                if term.op == "variable"
            }
            if len(points) < len(search.places.variables):
                return False
            found = search.among(points, low.shape[1])
            met.extend([found] if found is not None else [])
            return found is not None

        proof = subdivided(region, epsilon, self._most(region), look, tell)
        self._points += search.seen
        self._seen = max(self._seen, search.worst)
        if met:
            return self._different(simplest(search, met[0]), lanes)
        if proof.is_complete:
            return self._same("bounds", proof)
        return self._undecided(region, proof)

    def _most(self, region: Region) -> int:
        """The number of boxes of a region that may be looked at."""
        usual = min(MOST_BOXES, WORK // (len(region.inside) + 1))
        return usual if self._settings.boxes is None else self._settings.boxes

    def _undecided(self, region: Region, proof: Proof) -> Comparison:
        ranges = {
            _name(term): (low, high)
            for term, low, high in zip(
                region.variables, proof.open_low, proof.open_high, strict=False
            )
        }
        return Comparison(
            "undecided", None, proof.proven, proof.bound, proof.boxes, self._points, self._seen,
            open=OpenBox(ranges, proof.open_bound), notes=self._notes, domain=self._domain(),
        )  # fmt: skip

    def _different(self, found: Found, lanes: Sequence[Lane]) -> Comparison:
        return Comparison(
            "different", "points", 0.0, 0.0, 0, self._points, self._seen,
            self._witness(found, lanes), notes=self._notes, domain=self._domain(),
        )  # fmt: skip

    def _witness(self, found: Found, lanes: Sequence[Lane]) -> Witness:
        lane = lanes[found.lane]
        point = {id_: np.asarray([value]) for id_, value in found.values.items()}
        pairs = [(x, y) for x, y in self._pairs if x.result == lane.result]
        needed = below([term for x, y in pairs for term in (x.term, y.term)])
        missing = {
            t.id: _as_kind(t, np.asarray([start_of(t)])) for t in needed if t.op == "variable"
        }
        numbers = Numbers(
            {**missing, **{id_: _as_kind(self._terms.all[id_], v) for id_, v in point.items()}},
            1, np.float64, found.seed,
        )  # fmt: skip
        values = numbers.of([term for x, y in pairs for term in (x.term, y.term)])
        every = [float(np.asarray(value, np.float64)[0]) for value in values]
        both = {x.name: (every[2 * i], every[2 * i + 1]) for i, (x, _) in enumerate(pairs)}
        matters = [t for t in needed if t.op == "variable" and t.id in found.values]
        given = {t.data.name: found.values[t.id] for t in matters}
        special = [t.data.name for t in matters if found.values[t.id] != start_of(t)]
        read = {
            f"{t.data} at #{t.id}": float(np.asarray(numbers.known[t.id], np.float64).flat[0])
            for t in needed
            if t.op in ("read", "element")
        }
        return Witness(
            given, dict(_numbered(read)), tuple(special), lane.name,
            found.first, found.second, both, self._source(numbers), found.is_edge,
        )  # fmt: skip

    def _source(self, numbers: Numbers) -> NamedValue | None:
        """The first named value of both programs that differs at a point."""
        return named_values(
            self._terms, self._shaders, (self._settings.first, self._settings.second), numbers,
            self._settings.epsilon,
        )  # fmt: skip

    def _domain(self) -> Mapping[str, tuple[float, float]]:
        found = below([lane.term for pair in self._pairs for lane in pair])
        return {
            _name(term): (term.span.low, term.span.high)
            for term in found
            if term.op in ("variable", "read", "element")
        }


def _paired(
    first: list[Lane], second: list[Lane], name: str, other_name: str
) -> Iterator[tuple[Lane, Lane]]:
    """The lanes of both programs that are compared. Raises ``NotComparableError``."""
    ours = {lane.name: lane for lane in first}
    theirs = {lane.name: lane for lane in second}
    for one, other, delivers, lacks in (
        (ours, theirs, name, other_name), (theirs, ours, other_name, name),
    ):  # fmt: skip
        missing = [each for each in one if each not in other]
        if missing:
            names = ", ".join(dict.fromkeys(one[each].result for each in missing))
            raise NotComparableError(f"{delivers} delivers {names}, and {lacks} does not")
    for each in first:
        yield each, theirs[each.name]


def _numbered(read: Mapping[str, float]) -> Iterator[tuple[str, float]]:
    """Reads by the names of what is read: the second one of a name is called ``albedo.x #2``."""
    counted: Counter[str] = Counter()
    for place, value in read.items():
        name = place.rpartition(" at #")[0]
        counted[name] += 1
        yield name if counted[name] == 1 else f"{name} #{counted[name]}", value


def _terms(lanes: Sequence[Lane]) -> list[Term]:
    return [lane.term for lane in lanes]


def _name(term: Term) -> str:
    if term.op in ("variable", "read", "element"):
        return str(term.data)
    return f"a value of {_name(term.args[0])}" if term.args else term.op


def _as_kind(term: Term, values: Array) -> Array:
    if term.kind == "b":
        return np.asarray(values) > 0.5
    return np.rint(values).astype(np.int64) if term.kind == "i" else np.asarray(values, np.float64)
