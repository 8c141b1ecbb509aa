"""Expressions to nodes.

``Lowering`` walks expressions as generators (see ``trampoline``), looks names up through ``Scope``
and never stops at the first error: what could not be lowered is a ``FAILURE``, about which nothing
more is reported. Each kind of expression has its function in ``expressions`` or a file of its own.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ...diagnostics import rules
from ...diagnostics.diagnostic import Report
from ...diagnostics.fixes import Hint
from ...diagnostics.source import Span
from ...ir.node import Formal, Graph, Node, reachable
from ...ir.ranges import Ranges
from ...ir.shader import Notes
from ...ir.types import (
    Type,
    scalar_kind,
)
from ...syntax import ast
from ...trampoline import Reply, Step
from ..declarations import contracts
from ..declarations.externs import Externs
from ..hints import advice
from ..inheritance.records import Records
from ..lowering import combinations, lookup
from ..lowering.expressions import LOWER, component
from ..lowering.operands import no_signature
from ..names.modules import Symbol
from ..types import overloads
from ..types.coercion import coerce
from ..types.meanings import Meanings
from ..types.typenames import Declared, TypeResolver
from .constants import ConstantValues
from .crossings import Stages
from .scope import (
    FAILURE,
    Application,
    Failure,
    Inherited,
    Instance,
    LightVariable,
    RigEntry,
    Scope,
    Value,
)


class Lowering:
    """One shader's lowering: the graph being built and everything its expressions can refer to."""

    def __init__(
        self, report: Report, records: Records, types: TypeResolver, rig: tuple[RigEntry, ...] = ()
    ) -> None:
        self.report = report
        self.records = records
        self.externs = Externs(self)
        self.types = types
        self.rig = rig
        self.graph = Graph()
        self.notes = Notes()
        self.stages = Stages(self.graph, report, self.notes)
        self.constants = ConstantValues(report)
        self.meanings = Meanings(self.graph)
        self.ranges = Ranges(())
        """What is known of values already: by it loops are bounded, and lengths proven."""
        self.passing: Instance | None = None
        """The pass, whose transforms are in scope everywhere."""
        self.applied: dict[Application, Node | Failure] = {}
        self.active: dict[Any, tuple[str, Span]] = {}
        """What is being lowered right now, outermost first: finding it again is a cycle."""
        self.cyclic: set[object] = set()
        """What is defined by itself, which has been reported."""
        self.entered: set[Symbol] = set()
        """Functions and terms whose bodies were lowered."""
        self.stand_ins: set[Node] = set()
        """Arguments and slots in a declaration that is checked by itself."""
        self.recursive: set[Symbol] = set()
        """Functions that call themselves, which has been reported."""
        self.structs: dict[Symbol, Declared | None] = {}
        self.struct_members: dict[str, tuple[tuple[str, Type], ...]] = {}
        """The members of structures, by the names that texts call them."""
        self.declared: dict[ast.TypeName, Declared | None] = {}
        """Written types that were looked up already."""
        self.variables: dict[int, Declared] = {}
        """How the slots of `light` are declared, by the variables that stand for them in terms."""
        self.lights: dict[tuple[str, Instance], tuple[Instance, Formal | None]] = {}

    def reached(self) -> Iterator[Symbol]:
        """The functions, terms, constants and structures that were checked by being used."""
        yield from self.entered
        yield from self.structs
        yield from (symbol for symbol, *_ in self.applied)

    def is_left_to_a_use(self, node: Node) -> bool:
        """Whether what has to be known here is for a use to say, so that nothing is wrong yet."""
        return not self.stand_ins.isdisjoint(reachable((node,)))

    def expression(self, expression: ast.Expression, scope: Scope) -> Step[Value]:
        """The value of ``expression``; nodes get the expression's span."""
        value: Value = yield LOWER[type(expression)](self, expression, scope)
        if isinstance(value, Node):
            self.notes.spans.setdefault(value.id, expression.span)
        return value

    def node(self, expression: ast.Expression, scope: Scope) -> Reply[Node | Failure]:
        """The value of ``expression`` where only a plain value will do."""
        lowered = LOWER[type(expression)](self, expression, scope)
        if isinstance(lowered, Node):
            self.notes.spans.setdefault(lowered.id, expression.span)
            return lowered
        return self._node_later(lowered, expression)

    def _node_later(
        self, lowered: Reply[Value], expression: ast.Expression
    ) -> Step[Node | Failure]:
        value = yield lowered
        if isinstance(value, Node):
            self.notes.spans.setdefault(value.id, expression.span)
            return value
        if isinstance(value, Failure):
            return value
        self.report.add(rules.NOT_A_VALUE, expression.span)
        return FAILURE

    def part(self, value: Value, e: ast.Field) -> Reply[Value]:
        """``value.name``."""
        match value:
            case Failure():
                return FAILURE
            case Node():
                return component(self, value, e)
            case LightVariable():
                return lookup.light_slot(self, value, e.name)
            case Inherited(instance, level):
                return lookup.inherited(self, instance, level, e.name)
            case Instance():
                return lookup.slot_or_report(self, value, e.name.text, e.name.span)

    def typed(
        self, expression: ast.Expression, scope: Scope, wanted: Type, declared: str
    ) -> Step[Node | Failure]:
        """The value of ``expression`` as a ``wanted``; ``declared`` is how messages call that."""
        node = yield self.node(expression, scope)
        return self.fit(node, wanted, declared, expression.span)

    def fit(self, node: Node | Failure, wanted: Type, declared: str, span: Span) -> Node | Failure:
        """``node`` as a ``wanted``, or a report at ``span``."""
        if isinstance(node, Failure):
            return FAILURE
        fitted = coerce(self.graph, node, wanted)
        if fitted is None:
            self.report.add(
                rules.WRONG_TYPE, span, expected=declared, found=node.type,
                hint=_way_to_fit(node, wanted, declared, span),
                caption=f"this is `{node.type}`",
            )  # fmt: skip
            return FAILURE
        return fitted

    def as_declared(
        self,
        node: Node | Failure,
        declared: Declared,
        written: ast.Expression,
        scope: Scope | None = None,
    ) -> Node | Failure:
        """The value of ``written`` as what was declared: its type, its meaning, its contract."""
        if contracts.is_apart(node, self, declared):
            return contracts.meant(self, node, declared, written.span, written, scope)
        fitted = self.fit(node, declared.type, declared.text, written.span)
        if isinstance(fitted, Failure):
            return FAILURE
        return contracts.meant(self, fitted, declared, written.span, written, scope)

    def builtin(
        self,
        name: str,
        operands: tuple[Node, ...],
        span: Span,
        shown: str,
        written: tuple[ast.Expression, ...] = (),
        scope: Scope | None = None,
    ) -> Node | Failure:
        """A call of builtin ``name``, its operands coerced to the signature that fits.

        ``written`` and ``scope``, where they are known, are for messages about the operands.
        """
        found = overloads.resolve(name, tuple(map(overloads.operand, operands)))
        if found is None:
            return no_signature(self, name, operands, span, shown, written)
        fitted = []
        for operand, type_ in zip(operands, found.operands, strict=True):
            # Arithmetic between scalars and vectors exists as such; elsewhere a scalar broadcasts.
            lane = coerce(self.graph, operand, type_, broadcast=True)
            if lane is None:  # A negative literal is no `uint`.
                return no_signature(self, name, operands, span, shown, written)
            fitted.append(lane)
        node = self.graph.node("call", found.result, tuple(fitted), name)
        return combinations.checked(self, node, shown, span, written, scope)


def _way_to_fit(node: Node, wanted: Type, declared: str, span: Span) -> Hint:
    cut = advice.cut_quotient((node,), (span,)) if scalar_kind(wanted) == "float" else ""
    return cut or advice.fitting_type(node.type, wanted, declared, span)
