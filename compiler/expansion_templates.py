"""Lowers the builtins' expansions and definitions once, as templates that fit into any graph.

A template is a function of ``stdlib/meaning.burnish``, lowered for one signature. The passes
``expand_builtins`` and ``guard`` build its operations into the graph of a shader, and ``legalise``
prints some as functions.
"""

from __future__ import annotations

from collections.abc import Hashable, Mapping
from functools import cache

from ..stdlib.builtins import BUILTINS
from ..support.frozen import changed, frozen
from .diagnostics.diagnostic import Report
from .diagnostics.source import Span
from .ir.node import Formal, Node, Op, reachable
from .ir.types import Scalar, Type, Vector
from .library import MEANING, expansion
from .semantics.checking.applications import apply_body
from .semantics.checking.candidates import best
from .semantics.checking.expressions import RULES
from .semantics.inheritance.flattening import Records
from .semantics.lowering.interning import Interning
from .semantics.names.modules import Named
from .semantics.state.context import Context
from .semantics.state.scope import Failure
from .semantics.types.meanings import erased
from .syntax import ast


@frozen
class TemplateStep:
    """One node of a template; operands are numbers of earlier steps."""

    op: Op
    type: Type
    operands: tuple[int, ...]
    data: Hashable
    role: str = ""
    """The function of ``meaning.burnish`` whose value this is."""


@frozen(eq=False)
class Template:
    """An expansion as steps; the first ones are its parameters."""

    name: str
    doc: str
    parameters: tuple[str, ...]
    steps: tuple[TemplateStep, ...]
    result: int
    """The step that is the value."""
    lanewise: bool = False
    """Declared on scalars: applies to each lane of vector operands."""

    @property
    def operations(self) -> tuple[TemplateStep, ...]:
        """The steps that compute something."""
        return self.steps[len(self.parameters) :]


@cache
def template(name: str, types: tuple[Type, ...]) -> Template:
    """The expansion of builtin ``name`` for operands of these types."""
    return _template_of(BUILTINS[name].expansion, types)


@cache
def definition(name: str, types: tuple[Type, ...]) -> Template:
    """The definition of builtin ``name`` in other operations, for operands of these types."""
    return _template_of(BUILTINS[name].definition, types)


def _template_of(function: str, types: tuple[Type, ...]) -> Template:
    found = _lowered(function, types)
    if found is not None:
        return found
    lanes = tuple(Scalar(t.kind) if isinstance(t, Vector) else t for t in types)
    scalar = _lowered(function, lanes)
    assert scalar is not None, f"no {function} of {MEANING} takes {types}"
    return changed(scalar, lanewise=True)


def _lowered(name: str, types: tuple[Type, ...]) -> Template | None:
    report = Report()
    ctx = Context(report, Records(report), RULES)
    arguments = tuple(
        ctx.tree.node("formal", type_, (), Formal(f"x{i}")) for i, type_ in enumerate(types)
    )
    found = best(ctx, expansion(name), arguments)
    if not found:
        return None
    (symbol,) = found
    value = apply_body(ctx, symbol, arguments, Span(symbol.module.file.source, 0, 0))
    assert not isinstance(value, Failure), report.diagnostics
    graph = Interning(ctx.notes)
    *interned, value = graph.interned((*arguments, value))
    (value,) = erased(graph.graph, (value,), graph.notes.follow)
    return _template(symbol.declaration, tuple(interned), value, graph.notes.roles)


def _template(
    function: Named, arguments: tuple[Node, ...], value: Node, roles: Mapping[int, str]
) -> Template:
    assert isinstance(function, ast.Function)
    number = {argument.id: i for i, argument in enumerate(arguments)}
    steps = [TemplateStep(node.op, node.type, (), None) for node in arguments]
    for node in reachable((value,)):
        if node.id in number:
            continue
        number[node.id] = len(steps)
        operands = tuple(number[operand.id] for operand in node.operands)
        role = "" if node is value else roles.get(node.id, "")
        steps.append(TemplateStep(node.op, node.type, operands, node.data, role))
    names = tuple(argument.name.text for argument in function.arguments)
    return Template(function.name.text, function.doc, names, tuple(steps), number[value.id])
