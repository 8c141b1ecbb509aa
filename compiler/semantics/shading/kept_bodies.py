"""Keeps bodies of library functions, so that a process checks each of them once for a signature.

``signatures`` asks for the body of a function when it meets a signature for the first time in an
elaboration. A body of the library is checked in an elaboration of its own, in which nothing is the
user's: it depends on its signature alone. A call is then this body once more, with its arguments,
as all calls with a known signature are. Nothing is taken from here while graphs are verified or
shown (``is_watched``), as in tests.
"""

from __future__ import annotations

from collections.abc import Iterable

from ....support.locks import lock
from ...diagnostics.diagnostic import Report
from ...ir.node import AGE, Graph, Node, reachable
from ...ir.shader import Notes
from ...ir.types import BOOL, Struct
from ...watching import is_watched
from ..checking.call_marks import Callee
from ..checking.expressions import RULES
from ..checking.shapes import is_fixed
from ..checking.signatures import SharedCall, check_body
from ..inheritance.flattening import Records
from ..names.kept_of_library import KeptOfLibrary
from ..state.context import Context, KeptBody, NotedNode, SharedBody, Signature

MOST_KEPT = 256
"""The largest number of signatures whose bodies are kept: some 100 kB each."""
MOST_NODES = 20_000
"""The number of nodes behind which another elaboration is begun: the bodies that are kept stay."""


class KeptBodies:
    """Bodies of library functions by their signatures. Threads may share it."""

    def __init__(self, most: int = MOST_KEPT) -> None:
        self._kept: KeptOfLibrary[KeptBody | str] = KeptOfLibrary(most)
        self._checks: KeptOfLibrary[Context] = KeptOfLibrary(1)
        """The elaboration in which bodies are checked."""
        self._lock = lock()
        """Held while a body is checked: each elaboration is for one thread at a time."""

    def __len__(self) -> int:
        return len(self._kept)

    def of(self, signature: Signature, parts: tuple[Node, ...]) -> KeptBody | None:
        """The body for a signature; ``None`` if it is no function of the library alone.

        ``parts`` are those of the arguments of a call with this signature.
        """
        symbol = signature.symbol
        if is_watched() or not symbol.module.is_standard or not _says_all(signature):
            return None
        known = self._kept.find(symbol, signature)
        if known is None:
            with self._lock:
                known = self._checked(signature, parts) or _OF_USERS
            self._kept.keep(symbol, signature, known)
        return None if isinstance(known, str) else known

    def _checked(self, signature: Signature, parts: tuple[Node, ...]) -> KeptBody | None:
        symbol = signature.symbol
        ctx = self._checks.find(symbol, ()) or _begun()
        self._checks.keep(symbol, (), _begun())  # For the next one, unless all goes well here.
        before = len(ctx.tree)
        if signature not in ctx.bodies.known:
            pairs = zip(parts, signature.shapes, strict=True)
            given = tuple(
                _copy(ctx.tree, part) if is_fixed(shape) else part for part, shape in pairs
            )
            check_body(ctx, SharedCall(signature, given), symbol.declaration.name.span)
        found, made = ctx.bodies.known[signature], len(ctx.tree) - before
        if not isinstance(found, SharedBody) or not _is_clear(ctx):
            return None
        if len(ctx.tree) < MOST_NODES:
            self._checks.keep(symbol, (), ctx)
        return _kept(ctx, found, made)


KEPT_BODIES = KeptBodies()
"""The bodies of this process."""
_OF_USERS = "checked in each elaboration"


def _begun() -> Context:
    return Context(Report(), Records(Report()), RULES)


def _says_all(signature: Signature) -> bool:
    """True if a signature has no values of the elaboration in which the call stands."""
    return signature.surface is None and not any(isinstance(g, Node) for g in signature.given)


def _is_clear(ctx: Context) -> bool:
    """True if nothing was found in an elaboration that others would have to know."""
    progress = ctx.progress
    return not (
        ctx.report.count
        or any(ctx.bodies.withheld.values())
        or len(ctx.deferred)
        or ctx.types.ways
        or progress.joins_groups
        or progress.reads_view
    )


def _copy(graph: Graph, constant: Node) -> Node:
    """A constant expression in another graph."""
    made: dict[Node, Node] = {}
    for node in reachable((constant,)):
        operands = tuple([made[operand] for operand in node.operands])
        made[node] = (
            operands[0] if node.op == "called"
            else graph.node(node.op, node.type, operands, node.data)
        )  # fmt: skip
    return made[constant]


def _kept(ctx: Context, body: SharedBody, made: int) -> KeptBody | None:
    """A body with what it takes to repeat it elsewhere; ``None`` if it depends on more."""
    needed = _below(body.value, body.parts)
    if not all(map(_is_closed, needed)) or _has_conditions_in_loops(needed):
        return None
    changing = set(body.parts)
    for node in needed:
        if not changing.isdisjoint(node.operands):
            changing.add(node)
    notes = ctx.notes
    told = Notes(names=notes.names, docs=notes.docs)
    has_structures = any(isinstance(node.type, Struct) for node in needed)
    return KeptBody(
        value=body.value,
        formals=body.formals,
        parts=tuple(NotedNode(part, told.about(part)) for part in body.parts),
        constants=tuple(NotedNode(n, notes.about(n)) for n in needed if n not in changing),
        own=tuple(NotedNode(n, notes.about(n)) for n in needed if n in changing),
        applicable=frozenset(ctx.bodies.applicable.intersection(needed)),
        structures=tuple(ctx.types.structs.items()) if has_structures else (),
        made=made,
    )


def _below(value: Node, parts: Iterable[Node]) -> list[Node]:
    """The nodes that a value needs, without the parts of the arguments, operands before users."""
    seen = {value, *parts}
    found = [value] if value not in parts else []
    for node in found:  # The list grows on the way.
        new = [operand for operand in node.operands if operand not in seen]
        seen.update(new)
        found += new
    return sorted(found, key=AGE)


def _has_conditions_in_loops(nodes: Iterable[Node]) -> bool:
    """True if conditions may depend on how far a loop runs: that is known where it was checked."""
    loops = any(node.op in ("fold", "iterate") for node in nodes)
    return loops and any(node.type == BOOL and node.free for node in nodes)


def _is_closed(node: Node) -> bool:
    """True if a node of a body can be made elsewhere, where nothing of its elaboration is known."""
    if isinstance(node.data, Callee):
        return not any(isinstance(given, Node) for given in node.data.given)
    return bool(node.operands) or node.op in ("constant", "bound")
