"""Surfaces and displacements that are mixed: what they are made of, however often each is a side.

A document may use one node as a side of many mixes, and these in turn. If each of them were written
wherever it is used, the text could double with each mix. So ``mixes`` and ``displacements`` ask
here first, write each node once, and give those that are used again a name.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable
from typing import NamedTuple

from .model import Node
from .places import Scope
from .problems import UnsupportedError

Place = tuple[Node, Scope]
"""A node, and where the graph is used in which it stands."""
Key = tuple[Scope, str]
"""The same for tables: the name of a node says which one it is in its graph."""


def key(place: Place) -> Key:
    """The key of a node at one place of use."""
    node, scope = place
    return scope, node.name


class Sides(NamedTuple):
    """All nodes that one is made of, each once, and how often each is a side of others."""

    places: list[Place]
    uses: Counter[Key]

    def is_shared(self, place: Place) -> bool:
        """True if a node is used more than once."""
        return self.uses[key(place)] > 1


def sides_of(start: Place, sides: Callable[[Node, Scope], Iterable[Place | None]]) -> Sides:
    """Finds what a node is made of; ``sides`` gives the sides of a node, ``None`` for empty ones.

    Raises ``UnsupportedError`` if a node is a side of itself.
    """
    places, uses = [start], Counter[Key]()
    below: dict[Key, list[Place]] = {}
    for place in places:  # The list grows on the way.
        below[key(place)] = found = [side for side in sides(*place) if side is not None]
        for side in found:
            uses[key(side)] += 1
            if uses[key(side)] == 1 and key(side) != key(start):
                places.append(side)
    _check_circles(places, below, Counter(uses))
    return Sides(places, uses)


def _check_circles(places: list[Place], below: dict[Key, list[Place]], left: Counter[Key]) -> None:
    """Raise ``UnsupportedError`` for a node that is below itself: no order of all nodes exists."""
    ordered = [place for place in places if not left[key(place)]]
    for place in ordered:  # The list grows on the way.
        for side in below[key(place)]:
            left[key(side)] -= 1
            if not left[key(side)]:
                ordered.append(side)
    if len(ordered) < len(places):
        raise UnsupportedError("this node depends on itself", places[0][0].path)
