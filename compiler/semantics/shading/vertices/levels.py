"""Tessellation levels: into how many steps the edges and the inside of patches are divided.

``vertices/tessellation.py`` asks for the levels as results of the control stage. So that no crack
can be written, an edge's level depends on its two ends only, and does not on which of them comes
first: it is the larger of both ways round.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce

from .....support.frozen import changed
from ....diagnostics import rules
from ....diagnostics.diagnostic import Rule
from ....diagnostics.source import Span
from ....ir import build
from ....ir.domains import MixedDomainsError, exists
from ....ir.node import Node
from ....ir.shader import Result
from ....ir.stages import CONTROL, EDGE_LEVEL, INNER_LEVEL, PATCH_CORNER, PATCHES
from ....ir.tessellation import MOST_LEVEL, PATCH_KINDS, Patch
from ....ir.types import FLOAT, VEC2
from ....syntax import ast
from ...declarations.fitting import fit
from ...state.context import Context
from ...state.evaluation import node_of
from ...state.scope import FAILURE, Corners, Failure, Scope, Value


class Levels:
    """The levels of one tessellation."""

    def __init__(self, ctx: Context, scope: Scope, member: ast.Tessellate, patch: Patch) -> None:
        """``scope`` knows the surface as it is at the control points."""
        assert scope.instance is not None
        self._ctx = ctx
        self._scope = scope
        self._base = scope.instance
        self._member = member
        self._patch = patch
        self._kind = PATCH_KINDS[patch]

    def results(self, ends: tuple[int, ...], points: int) -> tuple[Result, ...]:
        """The results of the control stage; none where there is an error."""
        is_known = self._checked_words()
        edges = self._edges(ends)
        inner = self._inner(edges, points)
        if not is_known or isinstance(edges, Failure) or isinstance(inner, Failure):
            return ()
        return (
            *(Result(EDGE_LEVEL, CONTROL, level) for level in edges),
            *(Result(INNER_LEVEL, CONTROL, level) for level in inner),
        )

    def _checked_words(self) -> bool:
        """True if nothing is said that this kind of patch does not have."""
        has_lines = None in self._kind.edges
        for word, written, is_there in (
            ("inside", self._member.inside, bool(self._kind.inner)),
            ("lines", self._member.lines, has_lines),
        ):
            if written is not None and not is_there:
                rule = rules.NOT_OF_THIS_PATCH
                self._ctx.report.add(rule, written.span, patch=self._patch, word=word)
                return False
        return True

    # --- edges -----------------------------------------------------------------------------------

    def _edges(self, ends: tuple[int, ...]) -> list[Node] | Failure:
        """The level of each edge, in the order in which they are delivered."""
        found: list[Node] = []
        for edge in self._kind.edges:
            level = self._lines() if edge is None else self._edge((ends[edge[0]], ends[edge[1]]))
            if isinstance(level, Failure):
                return FAILURE  # The others are wrong in the same way, and one report is enough.
            found.append(level)
        return found

    def _lines(self) -> Node | Failure:
        """The number of lines of a patch, which is delivered as the level of an edge.

        It decides for all patches alike.
        """
        written = self._member.lines
        if written is None:
            return build.floating(self._ctx.tree, 1.0)
        return self._level(written, {}, rules.LEVEL_DIFFERS)

    def _edge(self, ends: tuple[int, int]) -> Node | Failure:
        """The larger of the levels from one end to the other and back."""
        there = self._from(ends)
        if isinstance(there, Failure) or self._ctx.crossings.domain(there) is None:
            return there
        back = self._from(ends[::-1])
        return FAILURE if isinstance(back, Failure) else self._greatest([there, back])

    def _from(self, ends: tuple[int, ...]) -> Node | Failure:
        corners = Corners("end", self._base, ends, PATCH_CORNER)
        return self._level(self._member.level, {"end": corners}, rules.LEVEL_DIFFERS)

    # --- the inside ------------------------------------------------------------------------------

    def _inner(self, edges: list[Node] | Failure, points: int) -> list[Node] | Failure:
        """The levels inside; where nothing is said those of the finest edges that lie so."""
        written = self._member.inside
        if isinstance(edges, Failure):
            return FAILURE
        if written is None or not self._kind.inner:
            return [self._greatest([edges[k] for k in along]) for along in self._kind.inner]
        corners = Corners("corner", self._base, tuple(range(points)), PATCH_CORNER)
        names: dict[str, Value] = {"corner": corners}
        node = self._node(written, names, rules.INNER_LEVEL_DIFFERS)
        if isinstance(node, Node) and node.type == VEC2 and len(self._kind.inner) > 1:
            lanes = [build.swizzle(self._ctx.tree, node, (lane,)) for lane in (0, 1)]
            return lanes if all(self._in_range(lane, written.span) for lane in lanes) else FAILURE
        level = self._fitted(node, written.span)
        return FAILURE if isinstance(level, Failure) else [level] * len(self._kind.inner)

    # --- one level -------------------------------------------------------------------------------

    def _level(
        self, written: ast.Expression, names: dict[str, Value], differs: Rule
    ) -> Node | Failure:
        return self._fitted(self._node(written, names, differs), written.span)

    def _node(
        self, written: ast.Expression, names: dict[str, Value], differs: Rule
    ) -> Node | Failure:
        """A value that is the same all over a patch; ``differs`` is told where it is not."""
        ctx = self._ctx
        scope = changed(self._scope, locals={**self._scope.locals, **names})
        node = node_of(ctx, written, scope)
        if isinstance(node, Failure):
            return FAILURE
        try:
            fits = exists(ctx.crossings.domain(node), PATCHES)
        except MixedDomainsError:
            fits = False
        if not fits:
            ctx.report.add(differs, written.span)
            return FAILURE
        return node

    def _fitted(self, node: Node | Failure, span: Span) -> Node | Failure:
        level = fit(self._ctx, node, FLOAT, "float", span)
        return level if isinstance(level, Node) and self._in_range(level, span) else FAILURE

    def _in_range(self, level: Node, span: Span) -> bool:
        """True if a level can be one that divides an edge."""
        fact = self._ctx.ranges.of(level)
        if fact.hi > 0 and fact.lo <= MOST_LEVEL:
            return True
        found = fact.in_words()
        self._ctx.report.add(rules.LEVEL_OUT_OF_RANGE, span, level=found, most=MOST_LEVEL)
        return False

    def _greatest(self, levels: Sequence[Node]) -> Node:
        tree = self._ctx.tree
        distinct = list(dict.fromkeys(levels))
        return reduce(lambda a, b: tree.node("call", FLOAT, (a, b), "max"), distinct)
