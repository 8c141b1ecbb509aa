"""Tells what a shader does not compute, since known values of parameters make it dead, and why.

``burnish compile --why`` asks for this. The passes leave out a dead value wherever they meet it, so
nobody notes each. ``Removals`` looks at the shader as it was before all simplification, from its
results down, by the same ranges: what it finds first is the whole of what is dead.
"""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping

from ...stdlib.builtins.facts import Fact
from ...support.frozen import frozen
from ..diagnostics.source import Span
from ..formula import Formulas
from ..ir.comparisons import HOLDS
from ..ir.leaves import Attribute, Buffer, Leaf, Parameter, Texture
from ..ir.node import Node, Roots, reachable
from ..ir.operations import BUILTIN_OPS, LOOPS, builtin_of
from ..ir.ranges import Ranges
from ..ir.refinements import OPPOSITES
from ..ir.shader import Notes
from .proofs import described, tells

_NOUNS: Mapping[type, str] = {
    Texture: "map", Buffer: "buffer", Attribute: "attribute", Parameter: "parameter"
}  # fmt: skip
_ENDS = ((0.0, 0), (1.0, 1))
"""The weights with which ``mix`` is one of its operands, and which one."""


@frozen
class Removal:
    """One value that a shader does not compute, as it is known when compiling."""

    text: str
    """The way it is computed in the source: ``coat_weight * coat(…)``."""
    becomes: str
    """A number, or the operand that it is."""
    known: tuple[str, ...]
    """The facts that show it: ``coat_weight`` is 0."""
    span: Span | None
    unread: tuple[str, ...]
    """What nothing reads any more: ``the map `coat_map```."""
    loops: int
    """The number of loops that are gone with it."""

    @property
    def sentence(self) -> str:
        """All of this, for a person."""
        because = f"{_listed(self.known)}, so " if self.known else ""
        said = f"{because}`{self.text}` is {self.becomes}."
        if self.unread:
            said += f" Nothing reads {_listed(self.unread)} any more."
        if self.loops:
            said += " A loop is gone." if self.loops == 1 else f" {self.loops} loops are gone."
        return said


class Removals:
    """Finds the removals in one shader."""

    def __init__(self, ranges: Ranges, notes: Notes, before: Roots, read: Collection[str]) -> None:
        """``read`` are the names of all that the finished program reads from outside."""
        self._ranges = ranges
        self._notes = notes
        self._formulas = Formulas(notes)
        self._read = read
        self._live: set[Node] = set()
        self._found: dict[Node, tuple[Node | None, tuple[Node, ...]]] = {}
        """For each removed value the operand that it is, and the operands that show it."""
        self._look_through(before)

    def told(self) -> Iterator[Removal]:
        """Each removal, those that come first in the source first; what has the same words once."""
        seen: set[tuple[str, str, Span | None]] = set()
        for node in sorted(self._found, key=self._place):
            operand, because = self._found[node]
            removal = self._removal(node, operand, because)
            words = removal.text, removal.becomes, removal.span
            if removal.known and words not in seen:
                seen.add(words)
                yield removal

    def _place(self, node: Node) -> tuple[str, int, int]:
        span = self._notes.spans.get(node.id)
        return ("", 0, node.id) if span is None else (span.source.name, span.start, node.id)

    def _look_through(self, roots: Iterable[Node]) -> None:
        """Walks from the results down, and stops wherever a value is known."""
        pending = list(roots)
        while pending:
            node = pending.pop()
            if node in self._live:
                continue
            self._live.add(node)
            found = self._decided(node)
            if found is None:
                pending += node.operands
                continue
            self._found[node] = found
            operand, _because = found
            pending += () if operand is None else (operand,)

    def _decided(self, node: Node) -> tuple[Node | None, tuple[Node, ...]] | None:
        """The operand that a value is, if it is one, and the values that show this.

        ``None`` for values that have to be computed.
        """
        if node.op == "select":
            condition, *sides = node.operands
            holds = self._holds(condition)
            return None if holds is None else (sides[not holds], (condition,))
        if builtin_of(node) == "mix":
            weight = node.operands[2]
            for number, operand in _ENDS:
                if weight.op != "constant" and self._number(weight) == number:
                    return node.operands[operand], (weight,)
        if node.op not in BUILTIN_OPS and node.op not in LOOPS:
            return None
        if self._number(node) is None:
            return None
        because = [o for o in node.operands if o.op != "constant" and self._number(o) is not None]
        return None, tuple(because)

    def _number(self, node: Node) -> float | None:
        """The only number that the lanes of a value can be."""
        fact = self._ranges.of(node)
        return fact.lo if fact.lo == fact.hi and fact.kind != "matrix" else None

    def _holds(self, condition: Node) -> bool | None:
        """The value of a condition, where ranges show it."""
        if condition.op == "constant":
            return None
        name = builtin_of(condition)
        if name == "not":
            inner = self._holds(condition.operands[0])
            return None if inner is None else not inner
        if name in OPPOSITES:
            facts = [self._ranges.of(operand) for operand in condition.operands]
            for comparison, value in ((name, True), (OPPOSITES[name], False)):
                if comparison in HOLDS and HOLDS[comparison](*facts):
                    return value
        number = self._number(condition)
        return None if number is None else bool(number)

    def _removal(self, node: Node, operand: Node | None, because: tuple[Node, ...]) -> Removal:
        if operand is None:
            becomes = _described(self._ranges.of(node))
        else:
            # Equal constants are one node: its name may be that of an unrelated one.
            is_constant = operand.op == "constant"
            words = self._formulas.computed if is_constant else self._formulas.text
            becomes = f"`{words(operand)}`"
        gone = [each for each in reachable([node]) if each not in self._live]
        loops = sum(each.op in LOOPS for each in (*gone, node)) if operand is None else 0
        return Removal(
            text=self._formulas.computed(node),
            becomes=becomes,
            known=tuple(dict.fromkeys(self._facts(because))),
            span=self._notes.spans.get(node.id),
            unread=tuple(self._unread(gone)),
            loops=loops,
        )

    def _facts(self, because: Iterable[Node]) -> Iterator[str]:
        """What is known of the parameters on which a decision rests.

        Of the operands of a value, those that are known show it alone: of a product, the zero.
        """
        pending, seen = list(because), set[Node]()
        while pending:
            node = pending.pop()
            if node in seen:
                continue
            seen.add(node)
            fact = self._ranges.of(node)
            if isinstance(node.data, Parameter) and tells(fact):
                yield f"`{node.data.name}` is {_described(fact)}"
            needs = self._ranges.needs(node)
            known = [need for need in needs if self._number(need) is not None]
            shown = known if fact.lo == fact.hi and known else needs
            pending += [need for need in shown if need.op != "constant"]

    def _unread(self, gone: Iterable[Node]) -> Iterator[str]:
        """What nothing reads any more, with the noun that it is called by."""
        names: dict[str, list[str]] = {noun: [] for noun in _NOUNS.values()}
        for node in gone:
            leaf = node.data
            if not isinstance(leaf, Leaf) or leaf.name in self._read:
                continue
            if not isinstance(leaf, Parameter) or self._number(node) is None:
                names[_NOUNS[type(leaf)]].append(f"`{leaf.name}`")
        for noun, found in names.items():
            some = list(dict.fromkeys(found))
            if some:
                yield f"the {noun}{'s' if len(some) > 1 else ''} {_listed(some)}"


def _described(fact: Fact) -> str:
    """A fact in words; the values of bools are words as well."""
    if fact.kind == "bool" and fact.lo == fact.hi:
        return "true" if fact.lo else "false"
    return described(fact)


def _listed(words: Iterable[str]) -> str:
    *first, last = words
    return f"{', '.join(first)} and {last}" if first else last
