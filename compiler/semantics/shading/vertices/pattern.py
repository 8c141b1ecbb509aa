"""The places of the vertices of patches, for pipelines that do not divide patches themselves.

``vertices/tessellation.py`` asks for the pattern of a tessellation, where there has to be one. Its
arithmetic is that of the library's tessellator, ``stdlib/tessellator.burnish``, whose functions are
called here.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import get_args

from ....diagnostics.source import Span
from ....ir import build
from ....ir.host import KNOWN_IN_TREES
from ....ir.node import Node, reachable
from ....ir.shader import PatchPattern, Result
from ....ir.stages import EDGE_LEVEL, INNER_LEVEL, OF_PATCH, PATTERN_VERTEX
from ....ir.tessellation import PATCH_KINDS, Patch, Spacing
from ....ir.types import INT, width
from ....library import tessellator
from ...checking.applications import library_call
from ...state.context import Context

_FUNCTIONS: Mapping[Patch, str] = {
    "triangle": "triangle_vertex",
    "quad": "quad_vertex",
    "isoline": "line_vertex",
}
_SPACINGS: tuple[Spacing, ...] = get_args(Spacing)
"""The spacings in the order of the library's numbers."""


def pattern_of(
    ctx: Context, patch: Patch, spacing: Spacing, levels: Sequence[Result], span: Span
) -> PatchPattern:
    """The place of a vertex by its number, where these are the levels of its patch.

    To check the functions takes several times as long as a plain material, so nobody asks where a
    host makes the pattern once for all patches.
    """
    tree = ctx.tree
    by_kind = (
        tuple(build.cross(tree, level.value, OF_PATCH) for level in levels if level.kind == kind)
        for kind in (EDGE_LEVEL, INNER_LEVEL)
    )
    given = [build.vector(tree, levels) for levels in by_kind if levels]
    number = tree.node("input", INT, (), PATTERN_VERTEX)
    arguments = (*given, build.constant(tree, INT, _SPACINGS.index(spacing)), number)
    (function,) = tessellator().find(_FUNCTIONS[patch])
    found = library_call(ctx, function, arguments, span)
    assert isinstance(found, Node), ctx.report.diagnostics
    place = build.member(tree, found, "place")
    lanes = tuple(range(width(PATCH_KINDS[patch].coordinate.type)))
    return PatchPattern(build.swizzle(tree, place, lanes), build.member(tree, found, "there"))


def known_to_host(ctx: Context, levels: Sequence[Result]) -> bool:
    """True if levels are the same for all patches of a draw, and a host can compute them."""
    values = [level.value for level in levels]
    return all(ctx.crossings.domain(value) is None for value in values) and all(
        node.op in KNOWN_IN_TREES for node in reachable(values)
    )
