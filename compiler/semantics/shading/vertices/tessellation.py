"""Surfaces whose patches are divided by a ``tessellate`` member.

``assembly.py`` calls ``tessellated`` when the parts of a shader have been put together.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import cast, get_args

from .....support.frozen import changed
from ....diagnostics import rules
from ....diagnostics.diagnostic import Label
from ....ir.node import Node
from ....ir.stages import CONTROL, CONTROL_POINT, EVALUATION, PATCH_INDEX
from ....ir.tessellation import MOST_POINTS, PATCH_KINDS, Patch, PatchKind, Spacing, Tessellation
from ....ir.types import INT
from ....syntax import ast
from ...checking.unknown_names import unknown
from ...declarations.fitting import typed
from ...names.modules import Symbol
from ...state.context import Context
from ...state.crossings import INPUTS
from ...state.origins import MixedEnds
from ...state.scope import Corners, DerivedVertices, Instance, Scope, Value, VertexGroup
from ..passes.captures import captures
from .derived import apart, by_vertices, slots_set
from .levels import Levels
from .pattern import known_to_host, pattern_of

SPACINGS: tuple[Spacing, ...] = get_args(Spacing)


def tessellated(ctx: Context, surface: Instance, passing: Instance | None) -> Instance:
    """The surface at the vertices that patches are divided into; itself where none are.

    The pass becomes a pass at these vertices. There is none where a mixin is checked alone.
    """
    written = list(surface.record.every(ast.Tessellate))
    if not written:
        return surface
    (member, owner, level), *others = written
    if others:
        label = Label(member.patch.span, "divided here")
        span, name = others[0][0].patch.span, surface.record.name
        ctx.report.add(rules.TWO_TESSELLATIONS, span, name=name, labels=[label])
    patch = _patch(ctx, member)
    if patch is None:
        return surface
    return _Tessellating(ctx, surface, passing, member, patch, owner, level).surface()


def _patch(ctx: Context, member: ast.Tessellate) -> Patch | None:
    if member.patch.text in PATCH_KINDS:
        return cast(Patch, member.patch.text)
    unknown(ctx, "kind of patch", member.patch.text, member.patch.span, PATCH_KINDS)
    return None


def _moved(passing: Instance | None, slots: DerivedVertices, surface: Instance) -> Instance | None:
    """A pass as it is where a surface is that has other vertices than the mesh."""
    if passing is not None:
        passing.made = slots
        passing.surface = surface
        passing.values.clear()
    return passing


class _Tessellating:
    def __init__(
        self,
        ctx: Context,
        surface: Instance,
        passing: Instance | None,
        member: ast.Tessellate,
        patch: Patch,
        owner: Symbol,
        level: int,
    ) -> None:
        self._ctx = ctx
        self._member = member
        self._patch = patch
        self._kind: PatchKind = PATCH_KINDS[patch]
        self._owner = owner
        self._level = level
        self._surface = surface
        self._passing = passing
        self._base, self._own = apart(surface, passing)

    def surface(self) -> Instance:
        """The surface at the vertices that patches are divided into."""
        ctx, member, coordinate = self._ctx, self._member, self._coordinate()
        points = self._points()
        ends = self._ends(points)
        spacing = self._spacing()
        slots = DerivedVertices(
            self._base,
            self._own,
            points or self._kind.ends,
            (CONTROL, EVALUATION),
            {**INPUTS, PATCH_INDEX.name: PATCH_INDEX},
            MixedEnds(self._patch, ends or self._default_ends(), coordinate),
        )
        unset, passing = apart(self._surface, self._passing)
        slots.unset = changed(unset, made=slots, values={})
        slots.passing_unset = _moved(passing, slots, slots.unset)
        set_anew = slots_set(ctx, self._base, member.equations)
        made = changed(self._surface, made=slots).with_replaced(by_vertices(set_anew))
        _moved(self._passing, slots, made)
        corners = Corners("corner", self._base, tuple(range(slots.corners)), CONTROL_POINT)
        names: dict[str, Value] = {"corner": corners, "inherited": slots.unset}
        if member.coordinate is not None:
            names[member.coordinate.text] = coordinate
        equations = {equation.name.text: equation for equation in member.equations}
        slots.groups = (VertexGroup(equations, self._scope(made, names)),)
        levels = Levels(ctx, self._scope(self._base, {}), member, self._patch)
        results = levels.results(ends or self._default_ends(), slots.corners)
        if points is not None and ends is not None and spacing is not None:
            slots.results = results
            if results and (self._is_captured or not known_to_host(ctx, results)):
                span = member.patch.span
                slots.pattern = pattern_of(ctx, self._patch, spacing, results, span)
            slots.tessellation = Tessellation(self._patch, points, ends, spacing, member.patch.span)
        return made

    @property
    def _is_captured(self) -> bool:
        """True if vertices are captured: a kernel does this, which no host gives a pattern."""
        return self._passing is not None and captures(self._passing.record)

    def _scope(self, instance: Instance, names: dict[str, Value]) -> Scope:
        known = {"material": instance, **names}
        return Scope(self._owner.module, instance, self._level, instance, known)

    def _coordinate(self) -> Node:
        row = self._kind.coordinate
        return self._ctx.tree.node("input", row.type, (), row)

    def _default_ends(self) -> tuple[int, ...]:
        return tuple(range(self._kind.ends))

    def _points(self) -> int | None:
        """The number of control points of a patch."""
        written, least = self._member.points, self._kind.ends
        if written is None:
            return least
        count = self._integer(written)
        if count is not None and not least <= count <= MOST_POINTS:
            self._ctx.report.add(
                rules.WRONG_POINTS, written.span,
                patch=self._patch, count=count, least=least, most=MOST_POINTS,
            )  # fmt: skip
            return None
        return count

    def _ends(self, points: int | None) -> tuple[int, ...] | None:
        """The numbers of the control points that are its corners."""
        written = self._member.ends
        if written is None:
            return self._default_ends()
        if len(written) != self._kind.ends:
            self._ctx.report.add(
                rules.WRONG_ENDS, written[0].span.to(written[-1].span),
                patch=self._patch, wanted=self._kind.ends, count=len(written),
            )  # fmt: skip
            return None
        found = [self._end(number, points) for number in written]
        ends = tuple(end for end in found if end is not None)
        if len(ends) < len(found):
            return None
        return ends if self._all_differ(ends, written) else None

    def _end(self, written: ast.Expression, points: int | None) -> int | None:
        number = self._integer(written)
        if number is not None and points is not None and not 0 <= number < points:
            self._ctx.report.add(rules.NO_SUCH_END, written.span, index=number, last=points - 1)
            return None
        return number

    def _all_differ(self, ends: Sequence[int], written: Sequence[ast.Expression]) -> bool:
        for place, end in enumerate(ends):
            if end in ends[:place]:
                first = Label(written[ends.index(end)].span, "an end here already")
                span = written[place].span
                self._ctx.report.add(rules.END_TWICE, span, index=end, labels=[first])
                return False
        return True

    def _spacing(self) -> Spacing | None:
        written = self._member.spacing
        if written is None:
            return "equal"
        if written.text in SPACINGS:
            return written.text
        unknown(self._ctx, "spacing", written.text, written.span, SPACINGS)
        return None

    def _integer(self, written: ast.Expression) -> int | None:
        scope = Scope(self._owner.module)
        node = typed(self._ctx, written, scope, INT, "int")
        return self._ctx.constants.integer(node, written.span)
