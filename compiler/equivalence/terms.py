"""Terms: what a program computes, as expressions of real numbers with hardly any operations left.

``symbols.py`` evaluates programs with terms in place of numbers, so that vectors, functions, loops
and names are gone, and every builtin is what the reference defines it to be. Both programs that
are compared are evaluated in one ``Terms``, where equal terms are one object (hash-consing).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from .arithmetic import Arithmetic, is_tiny, ordered
from .term import Term, below, plain, value_of
from .variables import Variable


class Terms(Arithmetic):
    """Makes terms in a simple form, each one once."""

    def __init__(self) -> None:
        super().__init__()
        self.neighbour: Callable[[Variable, int, int], Variable | None] = lambda *_: None
        """The variable that has a variable's value at a neighbouring pixel."""
        self._at_neighbours: dict[tuple[int, int], dict[int, Term]] = {}

    # --- conditions -------------------------------------------------------------------------------

    def less(self, x: Any, y: Any) -> Any:
        """True where the first number is below the second one."""
        x, y = self.term(x), self.term(y)
        if x is y or x.span.low >= y.span.high:
            return False
        if x.span.high < y.span.low:
            return True
        return self.node("less", (x, y))

    def equal(self, x: Any, y: Any) -> Any:
        """True where both are equal."""
        x, y = ordered(self.term(x), self.term(y))
        if x is y:
            return True
        if x.span.high < y.span.low or y.span.high < x.span.low:
            return False
        if x.kind == "b" and (value := value_of(x)) is not None:
            return y if value else self.opposite(y)
        if x.span.low == x.span.high == y.span.low == y.span.high:
            return True
        return self.node("equal", (x, y))

    def opposite(self, x: Any) -> Any:
        """True where a condition does not hold."""
        if isinstance(x, bool):
            return not x
        return x.args[0] if x.op == "not" else self.node("not", (x,))

    def both(self, x: Any, y: Any) -> Any:
        """True where both conditions hold."""
        if not isinstance(x, Term):
            return y if x else False
        if not isinstance(y, Term):
            return x if y else False
        x, y = ordered(x, y)
        if x is y:
            return x
        return False if self.opposite(x) is y else self.node("and", (x, y))

    def either(self, x: Any, y: Any) -> Any:
        """True where at least one condition holds."""
        return self.opposite(self.both(self.opposite(x), self.opposite(y)))

    def where(self, condition: Any, x: Any, y: Any) -> Any:
        """``x`` where the condition holds, else ``y``."""
        if not isinstance(condition, Term):
            return x if condition else y
        if (value := value_of(condition)) is not None:
            return x if value else y
        x, y = self.term(x), self.term(y)
        if x is y:
            return x
        if condition.op == "not":
            return self.where(condition.args[0], y, x)
        if x.kind == "b":
            return self._chosen_condition(condition, x, y)
        if condition.op == "less":
            a, b = condition.args
            if value_of(x) == 0 and is_tiny(b) and (found := self._guarded(a, y, condition)):
                return found
            if x is a and y is b:
                return self.least(a, b)
            if (x is b and y is a) or (is_tiny(b) and value_of(x) == 0 and y is a):
                return self.greatest(a, x)
        return self.node("where", (condition, x, y))

    def _guarded(self, magnitude: Term, quotient: Term, condition: Term) -> Any:
        """A quotient that is zero where its divisor is; ``None`` if it is no such quotient."""
        parts = quotient.args if quotient.op == "mul" else (quotient,)
        for number, part in enumerate(parts):
            divisor = part.args[0] if part.op == "reciprocal" else part
            if divisor.op == "where" and divisor.args[0] is condition:
                _, one, own = divisor.args
                if value_of(one) == 1 and self.absolute(own) is magnitude:
                    others = [each for i, each in enumerate(parts) if i != number]
                    return self.mul(self.constant(1.0) if not others else others[0],
                                    self.inverse(own))  # fmt: skip
        return None

    def _chosen_condition(self, condition: Term, x: Term, y: Term) -> Any:
        x, y = plain(x), plain(y)
        return self.either(self.both(condition, x), self.both(self.opposite(condition), y))

    # --- neighbours and earlier stages ------------------------------------------------------------

    def at_neighbour(self, term: Term, axis: int, index: int) -> Term:
        """The value at a pixel of the quad: at its first or second row or column."""
        known = self._at_neighbours.setdefault((axis, index), {})

        def moved(each: Term, args: list[Term]) -> Any:
            if not each.is_varying:
                return each
            if each.op == "variable":
                there = self.neighbour(each.data, axis, index)
                return each if there is None else self.variable(there)
            return self.make(each.op, args, each.data)

        return self.rebuilt(term, moved, known)

    def crossed(self, term: Term, mode: str) -> Term:
        """The value in a later stage of one of an earlier stage.

        Interpolation is linear, so it goes past sums and past factors that are the same for the
        whole draw. What it makes of other values is not known: each is a value of its own, between
        the ends of what is interpolated.
        """

        def moved(each: Term, args: list[Term]) -> Any:
            if not each.is_varying or (each.op == "variable" and mode == "perspective"):
                return each
            if each.op == "add" or (each.op == "mul" and not all(a.is_varying for a in each.args)):
                return self.make(each.op, args)
            if each.op == "where" and not each.args[0].is_varying:
                return self.make("where", (each.args[0], *args[1:]))
            return self.node("crossed", (each,), mode)

        return self.rebuilt(term, moved, {})

    def rebuilt(
        self, root: Term, change: Callable[[Term, list[Term]], Any], known: dict[int, Term]
    ) -> Term:
        """``root`` with all terms below it replaced; ``known`` has what was replaced before."""
        for term in below([root], known):
            known[term.id] = self.term(change(term, [known[arg.id] for arg in term.args]))
        return known[root.id]
