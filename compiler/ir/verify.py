"""Checks that a graph is well formed, which every pass may rely on and has to preserve.

The table of operations says what each node has to be like, and ``operations.Form`` what a graph may
contain after which pass. The tests verify every graph after every pass; elsewhere
``BURNISH_VERIFY=1`` does it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from threading import local
from typing import Any

from .domains import Domains, MixedDomainsError, exists
from .node import Binder, Formal, Node, Op, Roots, binders, bodies_of, reachable
from .operations import (
    BOUND,
    BUFFER,
    CROSS,
    FORMAL,
    OPERATIONS,
    PARAMETER,
    Form,
    Operation,
)
from .shader import Result, Shader
from .stages import CONTROL, EDGE_LEVEL, INNER_LEVEL, PATCHES, TESSELLATED, Chain, joined_in
from .storage import stored_type
from .types import FLOAT, Type

Variables = frozenset[tuple[Formal | int, Type]]
"""Variables of binders further out, by formal or de Bruijn index, and the types of their uses."""


class InvalidGraphError(Exception):
    """A pass (or semantics) made a graph that is not well formed."""

    def __init__(self, node: Node, reason: str) -> None:
        operands = "".join(f"\n  {operand!r}" for operand in node.operands)
        super().__init__(f"{reason}: {node!r}{operands}")
        self.node = node


class _Known(local):
    """The nodes of one graph that this thread has found to be well formed.

    Nodes never change, and most of them stay from pass to pass, so none is looked at twice. A node
    of another graph, which has the id of a known one, begins anew.
    """

    def __init__(self) -> None:
        self._nodes: dict[int, Node] = {}
        self.forget()

    def forget(self) -> None:
        """Begin with another graph."""
        self._nodes = {}
        self.fitting: dict[Form, set[int]] = {}
        """The ids of the nodes that a graph of each form may have."""
        self.variables: dict[int, Variables] = {}
        self.domains = Domains()

    def meet(self, nodes: Iterable[Node]) -> None:
        """Called with all nodes that are verified next."""
        if any(self._nodes.setdefault(node.id, node) is not node for node in nodes):
            self.forget()
            self._nodes = {node.id: node for node in nodes}


_KNOWN = _Known()


def verify(roots: Iterable[Node], *, stage: Form) -> None:
    """Raise ``InvalidGraphError`` at the first node under ``roots`` that is not well formed."""
    wanted = roots if isinstance(roots, Roots) else list(roots)
    nodes = reachable(wanted)
    _KNOWN.meet(nodes)
    fitting = _KNOWN.fitting.setdefault(stage, set())
    for node in nodes:
        if node.id not in fitting:
            _check(node, stage)
            fitting.add(node.id)
    for root in wanted:
        for variable, _type in _KNOWN.variables[root.id]:
            raise InvalidGraphError(root, f"{variable} is used outside its binder")


def _check(node: Node, stage: Form) -> None:
    """Checks a node whose operands are well formed."""
    row = OPERATIONS[node.op]
    _check_order(node)
    _check_form(node, row, stage)
    _check_row(node, row, stage)
    _KNOWN.variables[node.id] = _variables(node, _KNOWN.variables)
    try:
        _KNOWN.domains.of(node)
    except MixedDomainsError as error:
        raise InvalidGraphError(error.node, str(error)) from error


def verify_results(results: Sequence[Result], chain: Chain) -> None:
    """Raise ``InvalidGraphError`` where results or crossings do not fit the chain of stages."""
    domains = Domains()
    joined = joined_in(chain)
    for node in reachable([result.value for result in results]):
        if node.op == "cross":
            crossing = CROSS.data(node)
            if (crossing.origin, crossing.destination) not in joined:
                raise InvalidGraphError(node, "no two stages that follow each other are joined so")
    for result in results:
        if result.stage not in chain:
            raise InvalidGraphError(result.value, f"no {result.stage.name} stage in the chain")
        if result.kind not in result.stage.delivers:
            problem = f"a {result.stage.name} stage does not deliver a {result.kind}"
            raise InvalidGraphError(result.value, problem)
        if not exists(domains.of(result.value), result.stage.domain):
            raise InvalidGraphError(result.value, f"no value per {result.stage.domain}")


def verify_levels(shader: Shader) -> None:
    """Checks the levels of a shader with a control stage.

    Raises ``InvalidGraphError`` where it lacks a level of its patches, or reads a control point
    that they do not have.
    """
    if CONTROL not in shader.chain:
        return
    patches, roots = shader.tessellation, shader.roots
    if patches is None:
        raise InvalidGraphError(roots[0], "a control stage without patches")
    for kind, wanted in ((EDGE_LEVEL, patches.kind.edges), (INNER_LEVEL, patches.kind.inner)):
        levels = shader.results_of(kind)
        if len(levels) != len(wanted) or any(level.value.type != FLOAT for level in levels):
            raise InvalidGraphError(roots[0], f"not {len(wanted)} floats as {kind}")
    for node in reachable(roots):
        if node.op != "cross" or CROSS.data(node).mode != "corner":
            continue
        number = node.operands[1].data
        of_patch = CROSS.data(node).destination in (PATCHES, TESSELLATED)
        if of_patch and isinstance(number, int) and not 0 <= number < patches.points:
            raise InvalidGraphError(node, "a control point that the patch does not have")


def _check_order(node: Node) -> None:
    if any(operand.id >= node.id for operand in node.operands):
        raise InvalidGraphError(node, "an operand is not older than its user")


def _check_form(node: Node, row: Operation[Any], form: Form) -> None:
    if form not in row.forms and not row.stays(node):
        raise InvalidGraphError(node, _TOO_LATE.get(node.op, f"a {node.op} in a graph {form}"))
    if form != "semantics" and binders(node):
        raise InvalidGraphError(node, _TOO_LATE["bound"])


_TOO_LATE: Mapping[Op, str] = {
    "bound": "a binder that has not been opened",
    "call": "a builtin that has not been guarded",
    "struct": "a structure that has not been taken apart",
}


# --- variables -----------------------------------------------------------------------------------


def _variables(node: Node, known: Mapping[int, Variables]) -> Variables:
    """The variables in ``node`` that binders further out have to bind."""
    if node.op == "bound":
        return frozenset(((BOUND.data(node), node.type),))
    if node.op == "formal":
        return frozenset(((FORMAL.data(node), node.type),))
    inside = bodies_of(node)
    others = [known[o.id] for i, o in enumerate(node.operands) if i not in inside]
    bodies = [_bound(node, known[node.operands[i].id]) for i in inside]
    found = [variables for variables in (*others, *bodies) if variables]
    return found[0].union(*found[1:]) if found else frozenset()


def _bound(node: Node, used: Variables) -> Variables:
    """The variables in a body of ``node`` that it does not bind."""
    if not used:
        return used
    types = _variable_types(node)
    count = binders(node)
    left: set[tuple[Formal | int, Type]] = set()
    for variable, type_ in used:
        wanted = types.get(variable)
        if wanted is not None and wanted != type_:
            raise InvalidGraphError(node, f"{variable} is a {wanted}, used as a {type_}")
        if wanted is None:
            left.add((variable - count if isinstance(variable, int) else variable, type_))
    return frozenset(left)


def _variable_types(node: Node) -> dict[Formal | int, Type]:
    """The types of the variables that ``node`` binds in its body."""
    data = node.data
    assert isinstance(data, Binder)
    types = data.types([operand.type for operand in node.operands])
    return dict(zip(data.variables or range(len(types)), types, strict=True))


# --- rows of the table ---------------------------------------------------------------------------


def _check_row(node: Node, row: Operation[Any], form: Form) -> None:
    """Checks that data, operands and type are as the table of operations demands."""
    if not isinstance(node.data, row.kinds):
        raise InvalidGraphError(node, "operands or data that the operation does not take")
    fits = len(node.operands) == row.arity if row.arity is not None else bool(node.operands)
    wanted = _wanted(node, row, form) if fits else None
    if wanted is None:
        raise InvalidGraphError(node, "operands or data that the operation does not take")
    if wanted != node.type:
        raise InvalidGraphError(node, f"has type {node.type} instead of {wanted}")


def _wanted(node: Node, row: Operation[Any], form: Form) -> Type | None:
    declared = row.result(node)
    if row in (PARAMETER, BUFFER) and form == "stored" and declared is not None:
        return stored_type(declared)
    return declared
