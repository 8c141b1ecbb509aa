"""Views of a scene for pipelines that draw one view at a time: each view is a draw of its own.

``lower_stages.py`` calls ``lower_views`` before anything else or, where one draw is to reach all
views at once, ``count_views``. Each view is drawn to a layer of the render targets, so the host
sets the same kind of parameter as for layers: the number of the layer, which is that of the view.
"""

from __future__ import annotations

from ...stdlib.builtins.facts import Fact
from ...support.frozen import changed
from ..ir import build
from ..ir.leaves import Parameter
from ..ir.node import Graph, Node
from ..ir.operations import INPUT
from ..ir.rewrite import rewrite
from ..ir.shader import ParameterInfo, Shader
from ..ir.stages import LAYER, VIEW_INDEX
from ..ir.types import INT
from .draw_parameters import unused_name

VIEW_OF_DRAW = "draw.view_index"
"""The name of the parameter that says for which view a draw is."""


def lower_views(shader: Shader) -> Shader:
    """The shader of a draw of one view, with a parameter in place of ``view_index``."""
    if not _has_layers(shader):
        return _of_only_view(shader)
    last = shader.views - 1
    name = unused_name(VIEW_OF_DRAW, shader.parameters)
    number = Parameter(name, INT, "draw", fact=Fact(0.0, float(last), kind="int"))
    doc = "The number of the view that is drawn, and of its layer of the render targets"
    # A pass without targets has no result with a span.
    spans = (*(result.span for result in shader.results), *shader.notes.spans.values())
    span = next(span for span in spans if span is not None)
    info = ParameterInfo(number, str(INT), doc, span, range=(0.0, float(last)), default=0)
    return changed(
        _with_numbers(shader, shader.graph.node("parameter", INT, (), number)),
        parameters=(*shader.parameters, info),
        layer=number,
        views=0,
    )


def count_views(shader: Shader) -> Shader:
    """Notes the range of the numbers of a shader's views."""
    if not _has_layers(shader):
        return _of_only_view(shader)
    row = changed(VIEW_INDEX, most=shader.views - 1)
    return _with_numbers(shader, shader.graph.node("input", row.type, (), row))


def _has_layers(shader: Shader) -> bool:
    """True if the pass says how many views it draws, and so has a layer for each."""
    return shader.layers > 0 and not shader.results_of(LAYER)


def _of_only_view(shader: Shader) -> Shader:
    """The shader under a pass that says nothing of views: it draws one, whose number is 0."""
    return changed(_with_numbers(shader, build.constant(shader.graph, INT, 0)), views=0)


def _with_numbers(shader: Shader, number: Node) -> Shader:
    """The shader with a value in place of ``view_index``."""

    def rule(_graph: Graph, node: Node, _operands: tuple[Node, ...]) -> Node | None:
        return number if INPUT.data(node) == VIEW_INDEX else None

    values = rewrite(shader.graph, shader.roots, rule, shader.notes.follow, ("input",))
    results = (changed(r, value=v) for r, v in zip(shader.results, values, strict=True))
    return changed(shader, results=tuple(results))
