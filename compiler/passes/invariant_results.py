"""Makes passes do the same to positions, whatever else a shader computes.

Positions that have to be invariant are computed in the same way in all shaders only if no pass
decides about them by what other results need: whether a body is called often enough to be a
function, or whether a value is used where nothing is known of it. So passes that decide in such a
way look at these results apart from all others. What both need is still one node, where both come
to the same. ``pipeline.py`` makes an ``InvariantResults`` for each shader.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence, Set

from ...support.frozen import frozen
from ..ir.node import Node, Roots
from ..ir.shader import Result

Change = Callable[[Roots, Roots], Sequence[Node]]
"""A change that a pass makes to values. It is also given all values that may use them."""


@frozen
class InvariantResults:
    """The numbers of results that are looked at by themselves, and of all others."""

    placing: tuple[int, ...]
    others: tuple[int, ...]

    @classmethod
    def of(cls, results: Iterable[Result], placing: Set[str]) -> InvariantResults:
        """Separates the results of the kinds ``placing`` from all others."""
        numbered = list(enumerate(results))
        return cls(
            tuple(number for number, result in numbered if result.kind in placing),
            tuple(number for number, result in numbered if result.kind not in placing),
        )

    def each(self, roots: Roots, change: Change) -> Roots:
        """The values of all results, with positions changed apart.

        Positions do not know of others that use the same values; but these know of positions, as a
        change that is only safe for some uses must not be shared with more.
        """
        if not self.placing:
            return _as_roots(change(roots, roots))
        own, others = ([roots[number] for number in which] for which in (self.placing, self.others))
        positions = Roots(own)
        made = dict(zip(self.placing, change(positions, positions), strict=True))
        made.update(zip(self.others, change(Roots(others), roots), strict=True))
        return Roots([made[number] for number in range(len(roots))])


def _as_roots(values: Sequence[Node]) -> Roots:
    return values if isinstance(values, Roots) else Roots(values)
