"""Finds the first named value in which two programs differ at a point.

``comparing.py`` asks for it, to tell a person where to look.
"""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np

from ...support.frozen import frozen
from ..diagnostics.source import Span
from ..ir.node import Node, reachable
from ..ir.shader import Shader
from ..reference.evaluate import Evaluator
from .domain import Domain
from .leaves import Leaves
from .numbers import Numbers
from .programs import Observer, flat
from .symbols import Symbols
from .terms import Terms


@frozen
class NamedValue:
    """An equation of both programs, with its numbers in each."""

    name: str
    first: tuple[float, ...]
    second: tuple[float, ...]
    first_place: Span | None
    second_place: Span | None


def named_values(
    terms: Terms,
    shaders: tuple[Shader, Shader],
    domains: tuple[Domain, Domain],
    numbers: Numbers,
    epsilon: float,
) -> NamedValue | None:
    """The named value that is computed first, of those that differ at a point."""
    ours, theirs = (_named(shader) for shader in shaders)
    shared = [name for name in ours if name in theirs and ours[name].type == theirs[name].type]
    values = [
        _values(terms, shader, domain, {name: nodes[name] for name in shared}, numbers)
        for shader, domain, nodes in zip(shaders, domains, (ours, theirs), strict=True)
    ]
    for name in shared:
        x, y = values[0][name], values[1][name]
        if any(
            np.isfinite(a) and np.isfinite(b) and abs(a - b) > 1e-3 * epsilon * max(1.0, abs(a))
            for a, b in zip(x, y, strict=True)
        ):
            places = [
                shader.notes.spans.get(nodes[name].id)
                for shader, nodes in zip(shaders, (ours, theirs), strict=True)
            ]
            return NamedValue(name, x, y, *places)
    return None


def _named(shader: Shader) -> Mapping[str, Node]:
    """The values with names that are under no binder, in the order in which they are computed."""
    found: dict[str, Node] = {}
    for node in reachable([result.value for result in shader.results]):
        name, span = shader.notes.names.get(node.id), shader.notes.spans.get(node.id)
        if span is None or span.source.name.startswith("std/"):
            continue
        if name and not node.free and not node.variables and node.operands:
            found[name] = node
    return found


def _values(
    terms: Terms, shader: Shader, domain: Domain, nodes: Mapping[str, Node], numbers: Numbers
) -> Mapping[str, tuple[float, ...]]:
    leaves = Leaves(terms, domain, shader.parameters)
    evaluator = Evaluator(leaves, Symbols(terms), Observer(terms))
    found = {}
    for name, node in nodes.items():
        lanes = [terms.term(lane) for lane in flat(evaluator.value(node))]
        try:
            values = numbers.of(lanes)
        except KeyError:  # It depends on what no result depends on.
            values = [np.asarray([np.nan])] * len(lanes)
        found[name] = tuple(float(np.asarray(value, np.float64)[0]) for value in values)
    return found
