"""Surfaces whose primitives turn into others by an ``expand`` member.

It stands in the material, or in the pass that draws it. ``assembly.py`` calls ``expanded`` when the
parts of a shader have been put together.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from .....support.frozen import changed, frozen
from ....diagnostics import rules
from ....diagnostics.diagnostic import Label, Rule
from ....diagnostics.fixes import fix_it
from ....ir import build
from ....ir.binding import substitute
from ....ir.domains import MixedDomainsError, exists
from ....ir.expansion import STRIP_KINDS, EmittedStrips, Expansion
from ....ir.node import Node
from ....ir.primitives import CORNERS, DrawnPrimitive
from ....ir.shader import Result
from ....ir.stages import (
    EMITTED,
    EMITTING,
    GEOMETRY,
    GROUP,
    INTO_EMITTED,
    PATCH_INDEX,
    PRIMITIVE_INDEX,
    STRIP,
    STRIP_VERTEX,
    SystemInput,
)
from ....ir.tessellation import PATCH_KINDS
from ....ir.types import BOOL, INT, Type
from ....syntax import ast
from ...checking.corners import numbered
from ...checking.slots import corner_like
from ...checking.turns import bounds_of, turns_of
from ...checking.unknown_names import unknown
from ...declarations.fitting import fit, typed
from ...names.modules import Symbol
from ...state.context import Context
from ...state.crossings import INPUTS
from ...state.evaluation import node_of
from ...state.origins import MixedEnds, OneCorner
from ...state.scope import (
    FAILURE,
    OUTERMOST,
    Corner,
    Corners,
    DerivedVertices,
    Failure,
    Instance,
    Scope,
    Value,
    VertexGroup,
)
from .derived import by_vertices, differs_in_strip, pass_of, slots_set

MOST_VERTICES = 4096
"""The largest number of vertices of one primitive."""

_NOT_WHOLE: Mapping[DrawnPrimitive, Rule] = {
    "point": rules.NO_POINTS,
    "line": rules.NO_SEGMENTS,
    "triangle": rules.NO_TRIANGLES,
}
"""The rule about vertices that make no whole number of these primitives."""


def expands(instance: Instance) -> bool:
    """True if a material or a pass has an expansion."""
    return any(True for _ in instance.record.every(ast.Expand))


def expanded(ctx: Context, surface: Instance, passing: Instance | None) -> Instance:
    """The surface as it is at the emitted vertices; itself where nothing is expanded.

    The surface may divide patches: then the triangles or lines of these are expanded. The pass's
    expansion counts before that of the surface. The pass itself becomes a pass at the emitted
    vertices. There is none where a mixin is checked alone.
    """
    holder = surface if passing is None or not expands(passing) else passing
    written = list(holder.record.every(ast.Expand))
    if not written:
        return surface
    (member, owner, level), *others = written
    if others:
        ctx.report.add(
            rules.TWO_EXPANSIONS, others[0][0].primitive.span, name=holder.record.name,
            labels=[Label(member.primitive.span, "expanded here already")],
        )  # fmt: skip
    if member.primitive.text not in CORNERS:
        unknown(ctx, "primitive", member.primitive.text, member.primitive.span, CORNERS)
        return surface
    if not _is_there(ctx, surface, member):
        return surface
    return _Expanding(ctx, surface, passing, holder, member, owner, level).surface()


def _is_there(ctx: Context, surface: Instance, member: ast.Expand) -> bool:
    """True if patches are divided into the primitives that are expanded, if any are divided."""
    origin, primitive = surface.origin, member.primitive
    if not isinstance(origin, MixedEnds) or primitive.text == PATCH_KINDS[origin.patch].drawn:
        return True
    made = PATCH_KINDS[origin.patch].drawn
    ctx.report.add(
        rules.NOT_OF_PATCHES, primitive.span,
        primitive=primitive.text, patch=origin.patch, made=made,
        hint=fix_it(f"write `expand {made} {{ … }}`", (primitive.span, made)),
    )  # fmt: skip
    return False


@frozen
class _Group:
    """The strips of one group, with their names and conditions."""

    strips: EmittedStrips | None
    emitted: Node | Failure
    """A condition: the strip exists."""
    corner: Node | Failure
    """The corner that a vertex is like."""
    names: dict[str, Value]
    """The names that only it has: those of the vertex and of the strip."""


class _Expanding:
    def __init__(
        self,
        ctx: Context,
        surface: Instance,
        passing: Instance | None,
        holder: Instance,
        member: ast.Expand,
        owner: Symbol,
        level: int,
    ) -> None:
        """``holder`` is the one of the two that has the ``member``."""
        self._ctx = ctx
        self._member = member
        self._owner = owner
        self._level = level
        self._passing = passing
        self._is_of_pass = holder is passing
        self._base = base = surface
        self._above = changed(surface, replaced=dict(surface.replaced))
        own = pass_of(base, passing)
        before = base.origin
        assert not isinstance(before, OneCorner)
        self._like_first = OneCorner(
            self._number(0), INTO_EMITTED[base.vertex_stage.domain], before
        )
        self._index = PRIMITIVE_INDEX if before is None else PATCH_INDEX
        inputs = {**INPUTS, self._index.name: self._index}
        self._slots = DerivedVertices(
            base, own, CORNERS[member.primitive.text], (GEOMETRY,), inputs
        )
        self._below = own if self._is_of_pass and own is not None else base
        """The one that has the member as it is at the mesh's own vertices."""

    def surface(self) -> Instance:
        """The surface at the emitted vertices."""
        slots = self._slots
        groups = [self._group(strips) for strips in self._member.strips]
        whole = [group.strips for group in groups if group.strips is not None]
        emitting = [group.emitted for group in groups if isinstance(group.emitted, Node)]
        corners = [group.corner for group in groups if isinstance(group.corner, Node)]
        made = self._made(list(self._set()))
        number = self._by_group(corners) if corners else self._number(0)
        slots.origin = changed(self._like_first, number=number)
        inherited = {"inherited": corner_like(self._below, slots.origin)}
        slots.groups = tuple(
            VertexGroup(
                {equation.name.text: equation for equation in strips.equations},
                self._scope(self._holder(made), {**group.names, **inherited}),
            )
            for strips, group in zip(self._member.strips, groups, strict=True)
        )
        if len(whole) == len(emitting) == len(corners) == len(groups) and self._fits(whole):
            slots.results = tuple(Result(EMITTING, GEOMETRY, value) for value in emitting)
            slots.expansion = Expansion(
                self._member.primitive.text, tuple(whole), self._member.primitive.span
            )
        return made

    def _made(self, names: Iterable[str]) -> Instance:
        """The surface with slots that some group sets, each in the pass or in the surface.

        The pass is made likewise, in its place.
        """
        base, passing = self._base, self._passing
        of_surface, of_pass = [], []
        for name in names:
            is_own = self._is_of_pass and self._below.has(name)
            if is_own:
                of_pass.append(name)
            # A slot that the pass overrides is one slot of both.
            if not is_own or name in base.replaced:
                of_surface.append(name)
        made = changed(self._above, made=self._slots).with_replaced(by_vertices(of_surface))
        if passing is not None:
            passing.made = self._slots
            passing.surface = made
            passing.replaced.update(by_vertices(of_pass))
            for name in of_pass:
                passing.values.pop((name, OUTERMOST), None)
        return made

    def _holder(self, made: Instance) -> Instance:
        """The one that has the member as it is at the emitted vertices."""
        if not self._is_of_pass:
            return made
        assert self._passing is not None
        return self._passing

    def _fits(self, groups: list[EmittedStrips]) -> bool:
        """True if a primitive turns into something, and not into more than anything could draw."""
        span, count = self._member.primitive.span, sum(group.listed for group in groups)
        emitted = {group.kind.emits for group in groups}
        if not count:
            self._ctx.report.add(rules.NO_STRIPS, span)
        elif len(emitted) > 1:
            self._ctx.report.add(rules.DIFFERENT_PRIMITIVES, span)
        elif count > MOST_VERTICES:
            self._ctx.report.add(rules.EXPANDS_TOO_FAR, span, count=count, most=MOST_VERTICES)
        return 0 < count <= MOST_VERTICES and len(emitted) == 1

    def _set(self) -> Iterator[str]:
        """The slots that some group sets; reported where there is none of that name."""
        for strips in self._member.strips:
            yield from slots_set(self._ctx, self._below, strips.equations)

    def _group(self, written: ast.Strips) -> _Group:
        ctx = self._ctx
        names: dict[str, Value] = {}
        emitted: Node | Failure = build.constant(ctx.tree, BOOL, True)
        strips = 1
        if written.turns is not None:
            turns, strips, emitted = self._turns(written.turns)
            names[written.turns.variable.text] = turns
        if written.condition is not None:
            holds = self._condition(written.condition, names, written.vertex)
            if isinstance(holds, Node) and isinstance(emitted, Node):
                emitted = ctx.tree.node("call", BOOL, (emitted, holds), "and")
            elif isinstance(holds, Failure):
                emitted = holds
        vertices = self._vertices(written)
        if written.vertex is not None:
            names[written.vertex.text] = self._counted(STRIP_VERTEX)
        corner = self._corner(written, vertices, names)
        known = None
        if vertices is not None:
            known = EmittedStrips(written.shape, vertices, strips)
            if written.vertex is not None:
                known = changed(known, vertex_name=written.vertex.text)
            if written.turns is not None:
                known = changed(known, strip_name=written.turns.variable.text)
        return _Group(known, emitted, corner, names)

    def _condition(
        self, written: ast.Expression, names: Mapping[str, Value], vertex: ast.Name | None
    ) -> Node | Failure:
        """The condition of a strip, which is the same for all of its vertices."""
        of_vertex = {} if vertex is None else {vertex.text: self._counted(STRIP_VERTEX)}
        holds = self._of_strips(written, {**of_vertex, **names}, BOOL, "bool")
        if isinstance(holds, Node) and (place := differs_in_strip(self._ctx, holds, written.span)):
            self._ctx.report.add(rules.WITHIN_STRIP, place)
            return FAILURE
        return holds

    def _turns(self, written: ast.Turns) -> tuple[Value, int, Node | Failure]:
        """The number of a strip as it is called, how many there may be, and whether one is."""
        ctx = self._ctx
        values = [self._of_strips(bound, {}, INT, "int") for bound in bounds_of(written)]
        nodes = [value for value in values if isinstance(value, Node)]
        if len(nodes) < len(values):
            return FAILURE, 1, FAILURE
        found = turns_of(ctx, written, nodes, written.variable.span)
        if isinstance(found, Failure):
            return FAILURE, 1, FAILURE
        number = self._counted(STRIP)
        index = substitute(ctx.tree, found.index, {found.formal: number}, ctx.follow)
        if found.known:
            return index, found.bound, build.constant(ctx.tree, BOOL, True)
        return index, found.bound, ctx.tree.node("call", BOOL, (number, found.count), "lt")

    def _vertices(self, written: ast.Strips) -> int | None:
        """The number of vertices of each strip of a group."""
        ctx, span = self._ctx, written.count.span
        node = typed(ctx, written.count, Scope(self._owner.module), INT, "int")
        count = ctx.constants.integer(node, span)
        kind = STRIP_KINDS[written.shape]
        if count is not None and not kind.is_whole(count):
            ctx.report.add(_NOT_WHOLE[kind.emits], span, count=count, shape=written.shape)
            return None
        return count

    def _corner(
        self, written: ast.Strips, vertices: int | None, names: dict[str, Value]
    ) -> Node | Failure:
        """The corner that a vertex is like where nothing else is said of it."""
        if written.like is not None:
            number = self._of_strips(written.like, names, INT, "int")
            corner = numbered(self._ctx, self._corners, number, written.like.span)
            return corner.number if isinstance(corner, Corner) else FAILURE
        if self._slots.corners == 1:
            return self._number(0)
        if vertices is not None and vertices > self._slots.corners:
            self._ctx.report.add(
                rules.LIKE_WHICH_CORNER, written.count.span,
                count=vertices, primitive=self._member.primitive.text, corners=self._slots.corners,
            )  # fmt: skip
            return FAILURE
        return self._counted(STRIP_VERTEX)

    def _of_strips(
        self, written: ast.Expression, names: dict[str, Value], type_: Type, text: str
    ) -> Node | Failure:
        """A value that is the same for all vertices of a strip.

        Or it tells them apart only by their numbers: it knows the surface at the corners only.
        """
        ctx = self._ctx
        scope = self._scope(self._below, {**names, self._index.name: self._index_of_all()})
        node = node_of(ctx, written, scope)
        if isinstance(node, Failure):
            return node
        try:
            fits = exists(ctx.crossings.domain(node), EMITTED)
        except MixedDomainsError:
            fits = False
        if not fits:
            ctx.report.add(rules.OF_WHICH_CORNER, written.span)
            return FAILURE
        return fit(ctx, node, type_, text, written.span)

    def _scope(self, instance: Instance, names: dict[str, Value]) -> Scope:
        surface = instance.surface or instance
        known = {"material": surface, "corner": self._corners, **names}
        return Scope(self._owner.module, instance, self._level, surface, known)

    @property
    def _corners(self) -> Corners:
        numbers = tuple(range(self._slots.corners))
        return Corners("corner", self._below, numbers, self._like_first.crossing)

    def _index_of_all(self) -> Node:
        """The number of the primitive, or of the patch that it is a part of."""
        index = self._input(self._index)
        is_of_patch = self._index == PATCH_INDEX
        return self._like_first.of_patch(self._ctx.tree, index) if is_of_patch else index

    def _input(self, row: SystemInput) -> Node:
        return self._ctx.tree.node("input", row.type, (), row)

    def _counted(self, row: SystemInput) -> Node:
        """The number of a strip, or of a vertex in it."""
        number = self._input(row)
        self._ctx.ranges.assume_counting(number, MOST_VERTICES)
        return number

    def _number(self, value: int) -> Node:
        return build.constant(self._ctx.tree, INT, value)

    def _by_group(self, values: list[Node]) -> Node:
        """The value for the group in which a vertex is emitted."""
        tree, (*others, chosen) = self._ctx.tree, values
        for number, value in reversed(list(enumerate(others))):
            if value is not chosen:
                is_this = tree.node("call", BOOL, (self._input(GROUP), self._number(number)), "eq")
                chosen = tree.node("select", INT, (is_this, value, chosen))
        return chosen
