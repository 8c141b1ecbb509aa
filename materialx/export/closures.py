"""Colours that are made of closures, in the form that importing writes, as surfaces of MaterialX.

Such a colour is the sum of a term over the lights, of the same closures asked for the light from
everywhere and for what passes, and of what the surface sends out; all of it may be multiplied by an
opacity. What is not of this form is no surface.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

from ...compiler.semantics.equations.reads import MeantSlot, Where, called
from ...compiler.semantics.names.modules import Symbol
from ...compiler.syntax import ast
from .nodes import Nodes
from .table import closure_ways
from .values import Several, Value

ASKING = "std.mtlx.asking"
ASKED = Several({})
"""What closures are asked, which nodes do not say; also what a closure is that is not there."""
_QUESTIONS = ("from_everywhere", "passing")


class MixedColor(NamedTuple):
    """Two colours side by side, of which one at least is lit."""

    back: SurfaceColor
    front: SurfaceColor
    amount: ast.Expression


class LitColor(NamedTuple):
    """A colour as the parts of a surface."""

    closures: Symbol
    """The term of the closures."""
    emission: Sequence[ast.Expression]
    """What it sends out; its summands."""
    opacity: ast.Expression | None
    passes: bool
    """True if it is asked what passes."""


SurfaceColor = LitColor | MixedColor | ast.Expression
"""A colour as a surface; an expression is a colour without light."""


def surface_of(e: ast.Expression, where: Where) -> LitColor | MixedColor | None:
    """The surface that a colour is; nothing if it is not made of closures."""
    if isinstance(e, ast.Call) and _is_mix(e):
        back, front = (surface_of(each, where) for each in e.arguments[:2])
        if back is None and front is None:
            return None
        return MixedColor(back or e.arguments[0], front or e.arguments[1], e.arguments[2])
    return _lit_color(e, where)


def _is_mix(e: ast.Call) -> bool:
    is_named_so = isinstance(e.callee, ast.Reference) and e.callee.name == "mix"
    return is_named_so and len(e.arguments) == 3 and not e.names


def _lit_color(e: ast.Expression, where: Where) -> LitColor | None:
    """A colour of closures in the form that importing writes."""
    opacity = None
    summands = _summands(e)
    if len(summands) == 1 and isinstance(e, ast.Binary) and e.operator == "*":
        opacity, summands = e.left, _summands(e.right)
    lit, asked, rest = [], {}, []
    for summand in summands:
        symbol = _summed(summand, where)
        question = _asked(summand, where)
        if symbol is not None:
            lit.append(symbol)
        elif question is not None:
            asked[question[1]] = question[0]
        else:
            rest.append(summand)
    if not asked:
        return None
    closures = set(asked.values())
    if len(closures) != 1 or len(lit) != 1 or "from_everywhere" not in asked:
        return None
    (term,) = closures
    if not _is_lit_by(lit[0], term):
        return None
    return LitColor(term, rest, opacity, "passing" in asked)


def closure_node(nodes: Nodes, symbol: Symbol, given: Mapping[str, Value]) -> Value | None:
    """The node for a function that puts closures together; nothing for other functions."""
    if not symbol.module.is_standard or symbol.module.import_path != ASKING:
        return None
    values = list(given.values())
    if symbol.name == "absorbing_volume":
        return nodes.node("absorption_vdf", {"absorption": values[1]})
    name = "layer" if symbol.name == "layer_on_volume" else symbol.name
    if name not in closure_ways():
        return None
    way = closure_ways()[name]
    inputs = dict(zip(way.inputs, values, strict=True))
    present = {word: value for word, value in inputs.items() if value != ASKED}
    return nodes.node(way.category, present, "BSDF", must=True)


def emission(nodes: Nodes, values: Sequence[Value]) -> Value:
    """The sum of what a surface sends out; plain colours are sent out evenly."""
    found = [nodes.converted(value, "EDF") for value in values]
    whole = found[0]
    for other in found[1:]:
        whole = nodes.node("add", {"in1": whole, "in2": other}, "EDF", must=True)
    return whole


def _summands(e: ast.Expression) -> list[ast.Expression]:
    found: list[ast.Expression] = []
    while isinstance(e, ast.Binary) and e.operator == "+":
        found.append(e.right)
        e = e.left
    return [e, *reversed(found)]


def _symbol(e: ast.Expression, where: Where) -> Symbol | None:
    """The one function that a call names."""
    if not isinstance(e, ast.Call) or not isinstance(e.callee, ast.Reference):
        return None
    found = called(e.callee.name, where)
    return None if isinstance(found, MeantSlot) or not found else found[0]


def _summed(e: ast.Expression, where: Where) -> Symbol | None:
    """The term over all lights that a summand is."""
    symbol = _symbol(e, where)
    if symbol is None or not isinstance(symbol.declaration, ast.Function):
        return None
    return symbol if symbol.declaration.per is not None else None


def _asked(e: ast.Expression, where: Where) -> tuple[Symbol, str] | None:
    """The term of closures that a summand asks, and the name of the question."""
    if not isinstance(e, ast.Field) or e.name.text != "response":
        return None
    symbol = _symbol(e.operand, where)
    if symbol is None or not isinstance(e.operand, ast.Call) or len(e.operand.arguments) != 1:
        return None
    question = _symbol(e.operand.arguments[0], where)
    if question is None or question.name not in _QUESTIONS:
        return None
    given = " ".join(e.operand.arguments[0].span.text.split())
    return (symbol, question.name) if given.endswith("(to_eye, ambient_light)") else None


def _is_lit_by(symbol: Symbol, term: Symbol) -> bool:
    """True if a term over lights asks closures about each of them, as importing writes it."""
    function = symbol.declaration
    assert isinstance(function, ast.Function)
    text = " ".join(function.body.span.text.split())
    asked = f"{term.name}(by_light(light.to_light, to_eye)).response"
    return text == f"pi * light.diffuse * {asked}" and not function.parts
