"""Terms summed over the lights of a rig.

The body of a ``per light`` term is lowered once, with the slots of ``light`` as variables, and
applied to each light of the rig. So what all lights share is one node, and becomes one function or
one loop body in the output.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir import build
from ...ir.binding import close
from ...ir.leaves import Parameter
from ...ir.node import Formal, Node
from ...ir.types import INT, Array, Scalar, Struct, Vector, scalar_kind
from ...syntax import ast
from ...trampoline import Step
from ..declarations import contracts
from ..declarations.overrides import check_overrides
from ..declarations.written_types import numbers_of
from ..names.modules import Symbol
from ..state.scope import FAILURE, Failure, Instance, LightVariable, RigEntry, Scope, Value
from . import lookup
from .functions import bound, entered, fit_result
from .loops import changing, folded

if TYPE_CHECKING:
    from ..state.context import Lowering


def per_light(
    low: Lowering, symbol: Symbol, arguments: tuple[Node, ...], span: Span, scope: Scope
) -> Step[Value]:
    """The sum of a term over the rig."""
    surface = scope.surface
    if surface is None or not low.rig:
        if surface is None:
            low.report.add(rules.TERM_WITHOUT_SURFACE, span, name=symbol.name)
        elif not low.report.failed:  # The rig may be empty because its entries were wrong.
            low.report.add(rules.EMPTY_RIG, span, name=symbol.name)
        return FAILURE
    if not entered(low, symbol, span):
        return FAILURE
    total: Value = yield _summed(low, symbol, arguments, span, surface)
    low.active.pop(symbol)
    return total


def _summed(
    low: Lowering, symbol: Symbol, arguments: tuple[Node, ...], span: Span, surface: Instance
) -> Step[Node | Failure]:
    shared = yield _shared_body(low, symbol, arguments, surface)
    if isinstance(shared, Failure):
        return FAILURE
    body, names = shared
    total: Node | None = None
    for entry in low.rig:
        instance, formal = light_instance(low, entry, surface)
        contribution = yield _contribution(low, body, names, instance, span)
        if isinstance(contribution, Failure):
            return FAILURE
        if formal is not None:
            count = None if entry.count is None else _parameter(low, entry.count)
            contribution = folded(
                low.graph, "add", entry.bound, contribution, formal, low.notes.follow, count
            )
        low.notes.spans.setdefault(contribution.id, span)
        total = contribution if total is None else low.graph.node(
            "call", total.type, (total, contribution), "add"
        )  # fmt: skip
    assert total is not None
    return total


def _shared_body(
    low: Lowering, symbol: Symbol, arguments: tuple[Node, ...], surface: Instance
) -> Step[tuple[Node, dict[str, Node]] | Failure]:
    """The term's body with ``light``'s slots bound, and those slots in order."""
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    instance, _ = light_instance(low, low.rig[0], surface)
    light = LightVariable({}, instance.record, instance)
    locals_: dict[str, Value] = {"light": light}
    for formal, argument in zip(function.arguments, arguments, strict=True):
        locals_[formal.name.text] = argument
    variables = bound(low, function, arguments) or {}
    values = {**numbers_of(low, variables), **locals_}
    scope = Scope(symbol.module, surface=surface, locals=values, variables=variables)
    body = yield lookup.body(low, function, scope)
    body = fit_result(low, symbol, body, arguments)
    if isinstance(body, Failure):
        return FAILURE
    if not isinstance(body.type, Scalar | Vector) or scalar_kind(body.type) == "bool":
        low.report.add(
            rules.WRONG_TYPE, function.body.span, expected="a number or a vector", found=body.type
        )
        return FAILURE
    if body.type == INT and isinstance(body.data, int) and body.op == "constant":
        body = build.floating(low.graph, float(body.data))
    formals = [node.data for node in light.variables.values() if isinstance(node.data, Formal)]
    for node in changing((body,), set(formals)):
        if node.op == "cross":
            where = low.notes.spans.get(node.id, function.body.span)
            low.report.add(rules.CROSSING_PER_LIGHT, where)
            return FAILURE
    closed = close(low.graph, body, formals, low.notes.follow)
    low.notes.functions.setdefault(closed.id, symbol.name)
    low.notes.terms.setdefault(closed.id, symbol.name)
    low.notes.arguments.setdefault(closed.id, tuple(light.variables))
    return closed, light.variables


def _contribution(
    low: Lowering, body: Node, slots: dict[str, Node], instance: Instance, span: Span
) -> Step[Node | Failure]:
    """The body applied to one light."""
    if not slots:
        return body
    given = []
    for name, variable in slots.items():
        if not instance.has(name):
            place = instance.record.symbol.declaration.name.span
            low.report.add(
                rules.LIGHT_LACKS_SLOT, span, light=instance.record.name, slot=name,
                labels=[Label(place, "this light")],
            )  # fmt: skip
            return FAILURE
        node = yield lookup.slot(low, instance, name, span)
        declared = low.variables[variable.id]
        fitted = low.fit(node, declared.type, declared.text, span)
        if isinstance(fitted, Node):
            fitted = contracts.meant(low, fitted, declared, span)
        if isinstance(fitted, Failure):
            return FAILURE
        given.append(fitted)
    return build.apply(low.graph, body, tuple(given))


def light_instance(
    low: Lowering, entry: RigEntry, surface: Instance
) -> tuple[Instance, Formal | None]:
    """One light of the rig as seen from a surface; for an array, its element at a formal index."""
    key = (entry.name, surface)
    if key not in low.lights:
        low.lights[key] = _new_instance(low, entry, surface)
    return low.lights[key]


def _new_instance(
    low: Lowering, entry: RigEntry, surface: Instance
) -> tuple[Instance, Formal | None]:
    resources = {
        resource.name.removeprefix(f"{entry.name}."): low.graph.node(
            "resource", resource.type, (), resource
        )
        for resource in entry.resources
    }
    instance = Instance(
        entry.record, entry.name, surface, resources=resources, replaced=dict(entry.replaced)
    )
    check_overrides(low, instance)
    if entry.kind == "single":
        instance.parameters = {
            parameter.name.removeprefix(f"{entry.name}."): _parameter(low, parameter)
            for parameter in entry.parameters
        }
        return instance, None
    formal = Formal("i")
    (array,) = entry.parameters
    element = build.index(
        low.graph, _parameter(low, array), low.graph.node("formal", INT, (), formal)
    )
    assert isinstance(array.type, Array) and isinstance(array.type.element, Struct)
    instance.parameters = {
        name: build.member(low.graph, element, name) for name, _ in array.type.element.members
    }
    return instance, formal


def _parameter(low: Lowering, parameter: Parameter) -> Node:
    return low.graph.node("parameter", parameter.type, (), parameter)
