"""The type of simplification rules.

A rule says that two terms are equal: an operation that looks like ``left`` has the value of
``right``, if the conditions ``where`` hold. That is so for all finite operands; the sign of a zero
is not part of the meaning. No operation makes an infinite value or a NaN of finite operands, so
finite operands are all that there are.

``terms.py`` has the terms, ``simplify.py`` applies the rules, and ``table.py`` collects them.
``docs/passes.md`` lists them and explains how to add one; ``tests/passes/test_rules.py`` tries each
rule on random and special values.
"""

from __future__ import annotations

from collections.abc import Hashable

from ....support.frozen import cached_property, frozen
from ...ir.node import Node, Op
from ...ir.types import Type
from .builder import Builder
from .matching import Case, orders
from .terms import Condition, Operand, Operation, as_term


@frozen(eq=False)
class Rule:
    """One rule."""

    name: str
    """The name of the rule in tests and in ``Options.without``."""
    left: Operation
    right: Operand
    """The simpler value; computed values and numbers have its type."""
    says: str
    """The effect of the rule and why it is right, in a sentence."""
    where: Condition | tuple[Condition, ...] = ()
    """Further conditions on types and ranges."""
    also: tuple[tuple[Operation, Operand], ...] = ()
    """Further equations that are true for the same reason, of the same operation."""
    of_calls: bool = False
    """True if the rule is for calls only.

    Hardware operations, and with them the expansions of builtins, are then left as they are: their
    rounding was chosen on purpose.
    """
    drops: bool = False
    """True if the rule removes an operation of the user because of known facts about the operands.

    This is worth a remark.
    """

    @property
    def heads(self) -> tuple[str, ...]:
        """The operations that it is for, as nodes have them in ``Node.head``."""
        return self.left.function.heads

    @property
    def conditions(self) -> tuple[Condition, ...]:
        """All conditions."""
        return self.where if isinstance(self.where, tuple) else (self.where,)

    @property
    def equations(self) -> tuple[tuple[Operation, Operand], ...]:
        """The left and the right sides."""
        return ((self.left, self.right), *self.also)

    @cached_property
    def cases(self) -> tuple[Case, ...]:
        """Each equation in each order of operands, in the order in which they are tried."""
        return tuple(
            Case(ordered, as_term(right), self.conditions, self.of_calls)
            for left, right in self.equations
            for ordered in orders(left)
        )

    def apply(
        self, builder: Builder, op: Op, type_: Type, operands: tuple[Node, ...], data: Hashable
    ) -> Node | None:
        """The simpler value of one of the operations that it is for, if it has one."""
        heads = tuple(operand.head for operand in operands)
        cases = (case for case in self.cases if case.admits(heads))
        found = (case.apply(builder, op, type_, operands, data) for case in cases)
        return next((value for value in found if value is not None), None)
