"""Errors about the values of constants: they are reported only if a program can come to them.

``if b == 0 then 0 else a / b`` may be called with a constant 0: the side that would divide by it is
never taken. So a rule that finds such an error defers it. The operation gets a node, with the
meaning that it has for a value that is not constant, and the error waits until all that needs the
node has been checked. Then ``report`` walks from the values that were made down to what they need,
but not into sides that are never taken, and reports what it comes upon. Errors about types are not
deferred. Warnings about such values are, in the same way; but a value with a warning is right.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from ....support.frozen import changed
from ...diagnostics.diagnostic import Diagnostic, Label, Report, Severity
from ...ir.node import Folding, Iterating, Node, bare
from .conditions import Conditions
from .tree import Tree

_MARKS = ("as", "called")
_WEIGHTS: Mapping[Severity, int] = {"note": 1, "warning": 1, "error": 2}
"""A finding counts for less than one of more weight, about the same value or what it is made of."""


class Deferred:
    """Errors that wait until it is known whether the program can come to their nodes."""

    def __init__(self, report: Report, tree: Tree, conditions: Conditions) -> None:
        self._report = report
        self._tree = tree
        self._conditions = conditions
        self._found: dict[Node, Diagnostic] = {}
        self._also: dict[Node, tuple[Node, ...]] = {}
        """Nodes that were evaluated for a node and are no part of its value."""
        self._passed: set[Node] = set()
        """Nodes that nothing may need, and whose errors count elsewhere.

        There are copies of them, or parts of them have been taken.
        """
        self._weights: dict[Node, int] = {}
        """The weight of the gravest finding about what a node needs, on whatever side.

        Nodes are left out whose weight is 0: nearly all of them.
        """
        self._weighed = 0
        """The number of nodes whose weights are known: all up to it, in the order of the tree."""
        self._reached: set[Node] = set()
        """The nodes that the program can come to, as far as ``report`` has walked."""
        self._first = 0
        """The first node that no ``report`` has seen."""

    def __len__(self) -> int:
        return len(self._found)

    def add(self, node: Node, found: Diagnostic | None, *operands: Node) -> None:
        """Defer an error about ``node``; nothing is said if an operand is wrong already."""
        if found is not None and all(self._weight(o) < _weight(found) for o in operands):
            self._keep(node, found)

    def _keep(self, node: Node, found: Diagnostic) -> None:
        """Keep the gravest finding about a node, and of equal ones the first.

        The node may have been made before, where a constant in it was given from elsewhere.
        """
        if node not in self._found or _weight(self._found[node]) < _weight(found):
            self._found[node] = found
            self._weights[node] = _weight(found)

    def explain(self, since: int, label: Label) -> None:
        """Add a label to all errors after the first ``since`` ones."""
        for node in list(self._found)[since:]:
            found = self._found[node]
            self._found[node] = changed(found, labels=(*found.labels, label))

    def forget(self, since: int) -> None:
        """Drop all errors after the first ``since`` ones."""
        for node in list(self._found)[since:]:
            del self._found[node]

    def follow(self, old: Node, new: Node) -> None:
        """``new`` is a copy of ``old``, as of a function's body for other arguments."""
        if not self._found:
            return
        if self._conditions.follow(old, new):
            self._reached.clear()
        self._passed.add(old)
        if old in self._found:
            self._keep(new, self._found[old])
        if old in self._also:
            self._also.setdefault(new, self._also[old])

    def unread(self, value: Node, evaluated: Sequence[Node], first: int | None = None) -> None:
        """Notes nodes that were evaluated for a value and are no part of it, such as an argument.

        The value was made since there were ``first`` nodes, or after the evaluated ones.
        """
        if not self._found or not evaluated:
            return
        wrong = [part for node in evaluated for part in _parts(node) if self._weight(part)]
        if not wrong:
            return
        first = 1 + max(node.id for node in evaluated) if first is None else first
        seen, pending = {value}, [value]
        for node in pending:  # The list grows on the way.
            if node.id >= first:
                new = [operand for operand in node.operands if operand not in seen]
                seen.update(new)
                pending += new
        self._passed.update(evaluated)
        # What others read that are evaluated as well, or that a function of the library leaves out,
        # counts where these do.
        seen.update(operand for node in self._tree.nodes[first:] for operand in node.operands)
        left = tuple(node for node in wrong if node not in seen)
        self._also[value] = (*self._also.get(value, ()), *left)

    def left_out(self, evaluated: Iterable[Node]) -> None:
        """Notes nodes that were evaluated for a value, of which only a dead side may need some.

        Nothing is said about those that it does not need.
        """
        if self._found:
            self._passed.update(evaluated)

    def report(self) -> None:
        """Report the errors that the program can come to."""
        first, self._first = self._first, len(self._tree)
        if self._found:
            leading = self._leading()
            nodes = [node for node in self._tree.nodes[first:] if node in leading]
            outermost = list(self._outermost(nodes))
            self._tell(self._errors(outermost, self._reached, leading))

    def concerns(self, node: Node) -> bool:
        """True if something was found about what a value needs, on whatever side."""
        return self._weight(node) > 0

    def is_wrong(self, node: Node) -> bool:
        """True if a value that is needed now has errors, which are reported."""
        if not self._weight(node):
            return False
        return self._tell(self._errors([node], set(), None))

    def _tell(self, wrong: Iterable[Node]) -> bool:
        """Report the errors of nodes in the order found, so that the first of equal ones stays.

        Gives true if there are any that are not only warnings.
        """
        nodes = set(wrong)
        told = [found for node, found in self._found.items() if node in nodes]
        self._report.extend(told)
        return any(found.severity == "error" for found in told)

    def _leading(self) -> set[Node]:
        """The nodes that need a wrong one, on whatever side: there is nothing to find in others."""
        leading = {*self._found, *self._also}
        first = min(node.id for node in leading)
        for node in self._tree.nodes[first:]:
            if not leading.isdisjoint(node.operands):
                leading.add(node)
        return leading

    def _errors(
        self, pending: list[Node], reached: set[Node], leading: set[Node] | None
    ) -> Iterator[Node]:
        """The wrong nodes that a program comes to on the way to values, but for the ``reached``.

        Only the ``leading`` nodes are looked at, if it is known which these are.
        """
        while pending:
            node = pending.pop()
            if node in reached or (leading is not None and node not in leading):
                continue
            reached.add(node)
            if node in self._found:
                yield node
            pending += self._taken(node)

    def _outermost(self, nodes: list[Node]) -> Iterator[Node]:
        """Of nodes and all that need these, those that no other one needs, but for passed ones.

        Marks do not count.
        """
        needed = {node for others in self._also.values() for node in others}
        for node in reversed(nodes):
            if node not in needed:
                if node.op in _MARKS:
                    continue
                if node not in self._passed:
                    yield node
            needed.update(node.operands)

    def _taken(self, node: Node) -> Iterator[Node]:
        """Yields the nodes that a node needs, without sides that are never taken."""
        yield from self._also.get(node, ())
        match node.op, node.data:
            case ("select", _) | ("call", "choose"):
                condition, then, otherwise = node.operands
                holds = self._conditions.value(condition)
                yield condition
                if holds is not False:
                    yield then
                if holds is not True:
                    yield otherwise
            case "call", "and" | "or":
                decisive = sorted(self._conditions.decisive(node), key=self._weight)
                yield from decisive[:1] or node.operands
            case (("fold" | "iterate"), Folding() | Iterating()):
                yield from self._turned(node)
            case "called", _:
                yield node.operands[0]
            case _:
                yield from node.operands

    def _turned(self, loop: Node) -> Iterator[Node]:
        """Yields the nodes that a loop needs: not its body, if it has no iterations."""
        assert isinstance(loop.data, Folding | Iterating)
        count, bodies = loop.operands[0], loop.data.bodies
        yield from loop.operands[: bodies.start]
        if loop.data.bound == 0 or (count.op == "constant" and count.data == 0):
            return
        if isinstance(loop.data, Iterating):
            going = loop.operands[bodies.start]
            if self._conditions.value(going) is False:
                yield going
                return
        yield from loop.operands[bodies.start :]

    def _weight(self, root: Node) -> int:
        """The weight of the gravest finding about what a node needs, on whatever side; else 0."""
        if not self._found:
            return 0
        if root.id >= self._weighed:
            self._weigh(self._tree.nodes[self._weighed :])
        return self._weights.get(root, 0)

    def _weigh(self, nodes: list[Node]) -> None:
        """Note the weights of the nodes that were made since this was last done."""
        weights = self._weights
        for node in nodes:
            for operand in node.operands:
                if operand in weights:
                    weights[node] = max(weights.get(node, 0), weights[operand])
        self._weighed += len(nodes)


def _weight(found: Diagnostic) -> int:
    return _WEIGHTS[found.severity]


def _parts(whole: Node) -> Iterator[Node]:
    """The members and elements of a value that was put together, or the value itself."""
    pending = [whole]
    while pending:
        node = bare(pending.pop())
        if node.op in ("struct", "array"):
            pending += node.operands
        else:
            yield node
