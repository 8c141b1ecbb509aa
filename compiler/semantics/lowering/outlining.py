"""Outlining: functions whose body serves several calls.

In a checked tree, a call is the function's value for its arguments, with an annotation that says so
(``call_marks.py``). When the trees have become a graph, each function that is called repeatedly
gets a body in which variables stand for the arguments. A call becomes an ``apply`` of that body
where this is the same value: with the arguments in place of the variables they are one node. Where
they are not, the body depends on the arguments in other ways, and the call stays written out.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator
from itertools import islice
from typing import TypeAlias

from ....support.frozen import record
from ...ir import build
from ...ir.binding import close, freed, is_opened, open_body
from ...ir.leaves import Buffer, Texture
from ...ir.node import Formals, Graph, Node, Roots, reachable
from ...ir.operations import MEMBER
from ...ir.ranges import Ranges
from ...ir.rewrite import rewrite
from ...ir.shader import Notes
from ..checking.applications import checked_body
from ..checking.call_marks import Callee
from ..state.conditions import Conditions
from ..state.constants import ConstantValues
from ..state.context import Context
from ..types.meanings import erased
from .interning import Interning
from .structures import Structures

Fixed: TypeAlias = tuple[Node | None, ...]
"""For each argument of a call, its constant value in the body, if it has one there."""

_Candidate: TypeAlias = tuple[Callee, Fixed, tuple[Node, Formals]]
"""A body that calls may share, as a tree, with its variables."""


def lowered(ctx: Context, roots: Iterable[Node]) -> tuple[list[Node], Graph, Notes]:
    """Checked trees as bare numbers in a graph, where functions called repeatedly are applied."""
    graph = Interning(ctx.notes)
    sharing = _Sharing(ctx, graph)
    return sharing.roots(sharing.lowered(roots)), graph.graph, graph.notes


@record
class _Group:
    """Calls that may share a body."""

    callee: Callee
    fixed: Fixed
    formals: Formals
    body: Node
    """The body, with call-site annotations of its own."""
    applied: Node | None = None
    """The body, closed, once it is known to serve several calls."""

    def varying(self, arguments: tuple[Node, ...]) -> tuple[Node, ...]:
        """The arguments for which the body has variables."""
        return tuple(a for a, fixed in zip(arguments, self.fixed, strict=True) if fixed is None)


class _Sharing:
    def __init__(self, ctx: Context, graph: Interning) -> None:
        self._ctx = ctx
        self._interning = graph
        self._graph, self._notes = graph.graph, graph.notes
        self._moved = graph.notes.follow
        constants = ConstantValues(ctx.report, lambda _: False, ctx.records.work)
        self._conditions = Conditions(constants, Ranges(()))
        self._structures = Structures(graph.graph, graph.notes)
        self._groups: dict[tuple[Callee, Fixed], _Group] = {}
        """Callees before those that call them: a mark is younger than the marks in its value."""
        self._group_of: dict[int, _Group] = {}
        """The groups, by the ids of the annotations of calls."""
        self._names: set[str] = set()

    def lowered(self, trees: Iterable[Node]) -> list[Node]:
        """The graph's nodes for these trees, where no call delivers a structure."""
        return self._structures.taken_apart(self._interning.interned(trees))

    def roots(self, roots: list[Node]) -> list[Node]:
        """Lowers the roots as ``lowered`` says."""
        # A body may call functions itself, so calls are looked for in the bodies, too. Callees come
        # first: their bodies are closed before those that apply them.
        self._find_bodies(roots)
        # A body is outlined only if several calls have its value for their arguments.
        self._find_calls([*roots, *(group.body for group in self._groups.values())])
        uses = Counter(self._group_of.values())
        for group in self._groups.values():
            if uses[group] > 1:
                group.applied = self._at_rest(group)
        return list(self._rewritten(roots))

    # --- bodies ----------------------------------------------------------------------------------

    def _find_bodies(self, roots: list[Node]) -> None:
        """The bodies of all functions that are called more than once."""
        # The candidates of all functions are trees first, and become nodes of the graph together.
        found = [
            candidate
            for callee, marks in _by_callee(roots).items()
            if len(marks) > 1
            for candidate in self._candidates(callee, marks)
        ]
        bodies = self.lowered(value for *_, (value, _) in found)
        for (callee, fixed, (_, formals)), body in zip(found, bodies, strict=True):
            self._groups[callee, fixed] = _Group(callee, fixed, formals, body)

    def _candidates(self, callee: Callee, marks: list[Node]) -> Iterator[_Candidate]:
        """One body for all calls; where constants have to be known, one for those with the same."""
        # A body with a variable for each argument serves all calls.
        nothing: Fixed = (None,) * len(marks[0].operands[1:])
        whole = self._checked(callee, nothing)
        if whole is not None:
            yield callee, nothing, whole
            return
        # Otherwise some argument must be constant, such as the number of turns of a loop.
        for fixed, count in Counter(map(_constants, marks)).items():
            if count > 1 and any(fixed) and (checked := self._checked(callee, fixed)):
                yield callee, fixed, checked

    def _checked(self, callee: Callee, fixed: Fixed) -> tuple[Node, Formals] | None:
        """The tree of a body, and its variables, if there is such a body."""
        tree = self._ctx.tree
        constants = [c and tree.node(c.op, c.type, (), c.data) for c in fixed]
        return checked_body(self._ctx, self._interning.written[callee], constants)

    def _at_rest(self, group: _Group) -> Node:
        """The body of a group, closed, with what texts show of the function."""
        # Calls within the body are applied first; then its variables become those of a function.
        (body,) = self._rewritten([group.body])
        closed = close(self._graph, body, group.formals, self._moved)
        notes, function = self._notes, group.callee.symbol.declaration
        notes.functions.setdefault(closed.id, self._name(group))
        notes.arguments.setdefault(closed.id, tuple(formal.name for formal in group.formals))
        if function.doc:
            notes.docs.setdefault(closed.id, function.doc)
        return closed

    def _name(self, group: _Group) -> str:
        """The function's name, with its textures and buffers.

        Further functions of this name are told apart by their types.
        """
        kept = (given.data for given in group.callee.given if isinstance(given, Node))
        bound = [leaf.name for leaf in kept if isinstance(leaf, Texture | Buffer)]
        name = "_".join([group.callee.symbol.name, *bound])
        if name in self._names:
            types = [given[0] for given in group.callee.given if not isinstance(given, Node)]
            name = "_".join([name, *dict.fromkeys(map(str, types))])
        self._names.add(name)
        return name

    # --- calls -----------------------------------------------------------------------------------

    def _find_calls(self, roots: list[Node]) -> None:
        """Find the calls whose values are those of a group's body."""
        # Close the body of each group: its variables become the parameters of a function.
        groups = self._groups.values()
        marks = [mark for marks in _by_callee(roots).values() for mark in marks]
        bodies = {
            group: close(self._graph, body, group.formals)
            for group, body in zip(groups, self._plain([g.body for g in groups]), strict=True)
        }
        # Put the arguments of each call into the body of its group.
        groups_of = [self._group(mark) for mark in marks]
        called = [(mark, group) for mark, group in zip(marks, groups_of, strict=True) if group]
        flat = self._plain([operand for mark, _ in called for operand in mark.operands])
        plain = iter(freed(self._graph, flat))
        values, opened = [], []
        for mark, group in called:
            value, *arguments = islice(plain, len(mark.operands))
            values.append(value)
            varying = group.varying(tuple(arguments))
            is_it = is_opened(self._graph, bodies[group], varying, value)
            opened.append(value if is_it else open_body(self._graph, bodies[group], varying))
        # Equal expressions are one node (hash-consing): where the body with these arguments is the
        # node of the call's value, the body serves the call.
        for (mark, group), value, body in zip(called, values, self._plain(opened), strict=True):
            if body is value:
                self._group_of[mark.id] = group

    def _group(self, mark: Node) -> _Group | None:
        assert isinstance(mark.data, Callee)
        nothing: Fixed = (None,) * len(mark.operands[1:])
        whole = self._groups.get((mark.data, nothing))
        return whole or self._groups.get((mark.data, _constants(mark)))

    def _plain(self, roots: list[Node]) -> Roots:
        """The roots without marks, with members of what was put together as what was put there.

        A choice whose condition is constant is the side that is taken, as the library's functions
        have it where the arguments of a call are constant.
        """
        return rewrite(
            self._graph, erased(self._graph, roots), self._part, ops=("member", "select")
        )

    def _part(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        if node.op == "member":
            return build.member(graph, operands[0], MEMBER.data(node))
        holds = self._conditions.value(operands[0])
        return None if holds is None else operands[1 if holds else 2]

    def _rewritten(self, roots: list[Node]) -> Roots:
        return rewrite(self._graph, roots, self._rule, self._moved, ("as", "called"))

    def _rule(self, graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node:
        group = self._group_of.get(node.id)
        # A call that shares no body stays written out: the first operand is its value.
        if group is None or group.applied is None:
            return operands[0]
        return build.apply(graph, group.applied, group.varying(operands[1:]))


def _by_callee(roots: list[Node]) -> dict[Callee, list[Node]]:
    """The marks of calls, by the function that is called."""
    found: dict[Callee, list[Node]] = {}
    for node in reachable(roots):
        if isinstance(node.data, Callee):
            found.setdefault(node.data, []).append(node)
    return found


def _constants(mark: Node) -> Fixed:
    return tuple(o if o.op == "constant" else None for o in mark.operands[1:])
