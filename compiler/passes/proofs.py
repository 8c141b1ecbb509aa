"""Derives for a reader why an operation needs no guard, or why it keeps one.

``burnish graph --why`` asks for proofs. Range analysis keeps facts but not how it found them, so a
proof follows each fact back to its sources. It omits what does not matter: an operand is mentioned
only if the conclusion would be false without its fact.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Sequence

from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.facts import UNKNOWN, Fact
from ...support.frozen import changed, frozen
from ..diagnostics.source import Span
from ..formula import Formulas
from ..ir.leaves import Attribute, Buffer, Parameter, Texture
from ..ir.node import Node
from ..ir.ranges import Ranges
from ..ir.shader import Notes
from .path_conditions import PathRefinement
from .remarks import Outcome, Remark
from .rules.notation import conditions, equations
from .rules.table import RULES

LONGEST = 16
"""Steps of one proof that are shown."""

WIDEST = 400
"""The number of values that are searched for unknown facts."""


@frozen
class ProofStep:
    """One link of the chain: the fact of a value, and the rule that derives it."""

    depth: int
    """Distance from the operation. The steps that this one rests on follow it, one deeper."""
    text: str
    fact: str
    rule: str
    """The name of the rule in the ``rulebook``, or of a builtin; empty where nothing is known."""
    span: Span | None
    where: str = ""
    """The condition behind which it holds."""


@frozen
class Proof:
    """The decision about one operation, and the facts that made it necessary."""

    builtin: str
    outcome: Outcome
    text: str
    span: Span | None
    needs: str
    """The condition on the operands, in words."""
    steps: tuple[ProofStep, ...]
    omitted: int = 0
    """Further steps that there are."""
    missing: tuple[str, ...] = ()
    """The facts that are not known and would be needed, for a guard that stays."""
    otherwise: str = ""
    """The defined result that the guard is for."""
    rule: str = ""
    """The simplification rule that has removed it."""
    equation: str = ""
    """The equation of that rule."""


class Proofs:
    """Explains remarks."""

    def __init__(self, ranges: Ranges, notes: Notes) -> None:
        """``notes`` as they were when the remarks were made."""
        self._ranges = ranges
        self._notes = notes
        self._formulas = Formulas(notes)

    def explain(self, remarks: Iterable[Remark]) -> Iterator[Proof]:
        """Each remark with its reasons; those with the same words once."""
        seen: set[tuple[object, ...]] = set()
        for remark in remarks:
            proof = self._proof(remark)
            place = None if proof.span is None else (proof.span.source.name, proof.span.start)
            words = (place, proof.builtin, proof.outcome, *(step.fact for step in proof.steps))
            if words not in seen:
                seen.add(words)
                yield proof

    def _proof(self, remark: Remark) -> Proof:
        row = BUILTINS[remark.builtin]
        guarded = remark.outcome == "guarded"
        chosen = remark.operands if guarded else self._decisive(remark)
        chosen = [operand for operand in chosen if operand.op != "constant"]
        steps = [step for operand in chosen for step in self._chain(operand, guarded)]
        steps += self._conditions(remark.conditions)
        return Proof(
            builtin=row.name,
            outcome=remark.outcome,
            text=self._formulas.call(row.name, remark.operands),
            span=remark.span,
            needs=row.needs,
            steps=tuple(steps[:LONGEST]),
            omitted=max(0, len(steps) - LONGEST),
            missing=tuple(self._unknown(remark.operands)) if guarded else (),
            otherwise=row.outside if guarded else "",
            rule=remark.rule,
            equation=_equation(remark.rule),
        )

    def _decisive(self, remark: Remark) -> list[Node]:
        """The operands without whose facts the conclusion would fail."""
        facts = [self._ranges.of(operand) for operand in remark.operands]
        if remark.outcome == "dropped":
            return [o for o, f in zip(remark.operands, facts, strict=True) if tells(f)]
        domain = BUILTINS[remark.builtin].domain
        if remark.conditions or not domain(tuple(facts)):
            return []
        return [
            operand
            for i, operand in enumerate(remark.operands)
            if not domain(tuple(_without(facts, i)))
        ]

    def _chain(self, root: Node, shallow: bool) -> Iterator[ProofStep]:
        """Yields the known facts about a value and, unless ``shallow``, those they rest on."""
        seen: set[int] = set()
        pending = [(root, 1)]
        while pending:
            node, depth = pending.pop()
            fact = self._ranges.of(node)
            if node.id in seen or not (tells(fact) or depth == 1):
                continue
            seen.add(node.id)
            rule = self._ranges.reason(node) if tells(fact) else None
            yield ProofStep(
                depth, self._formulas.text(node), described(fact), rule or "",
                self._notes.spans.get(node.id),
            )  # fmt: skip
            if not shallow:
                pending += [(need, depth + 1) for need in reversed(self._supports(node, fact))]

    def _supports(self, node: Node, fact: Fact) -> list[Node]:
        """The values on which the fact of a value rests; constants need no support."""
        needs = self._ranges.needs(node)
        known = [self._ranges.of(need) for need in needs]
        return [
            need
            for i, need in enumerate(needs)
            if need.op != "constant"
            and tells(known[i])
            and self._ranges.derived(node, _without(known, i)) != fact
        ]

    def _conditions(self, conditions: Sequence[PathRefinement]) -> Iterator[ProofStep]:
        for one in dict.fromkeys(one.refinement for one in conditions):
            holds = "holds" if one.holds else "does not hold"
            yield ProofStep(
                depth=1,
                text=self._formulas.text(one.about),
                fact=described(one.fact),
                rule=one.rule,
                span=self._notes.spans.get(one.condition.id),
                where=f"{self._formulas.text(one.condition)} {holds}",
            )

    def _unknown(self, operands: Sequence[Node]) -> Iterator[str]:
        """The leaves about which nothing is known, each with a way to make it known."""
        pending = [o for o in reversed(operands) if not self._ranges.of(o).unit]
        seen: set[int] = set()
        told: set[str] = set()
        while pending and len(seen) < WIDEST:
            node = pending.pop()
            if node.id in seen:
                continue
            seen.add(node.id)
            text = "" if tells(self._ranges.of(node)) else self._leaf(node)
            if text and text not in told:
                told.add(text)
                yield text
            pending += [o for o in reversed(node.operands) if not tells(self._ranges.of(o))]

    def _leaf(self, node: Node) -> str:
        match node.data:
            case Parameter(name=name, type=type_) if str(type_) in ("float", "int", "uint"):
                return f"`{name}` has no declared range"
            case Parameter(name=name):
                return f"`{name}` may be anything"
            case Attribute(name=name):
                return f"`{name}` comes from the mesh"
            case Texture(name=name) | Buffer(name=name):
                return f"`{name}` may hold anything"
            case _:
                return ""


def _equation(name: str) -> str:
    """The equation of a simplification rule, with its conditions."""
    for rule in RULES:
        if rule.name == name:
            where = conditions(rule)
            return " and ".join(equations(rule)) + (f", where {where}" if where else "")
    return ""


def tells(fact: Fact) -> bool:
    """True if a fact says more than the type does."""
    return described(fact) not in ("anything", "any int", "any uint", "true or false")


def _without(facts: Sequence[Fact], position: int) -> list[Fact]:
    """A copy of the facts, with nothing known of one value."""
    return [UNKNOWN.as_kind(fact.kind) if i == position else fact for i, fact in enumerate(facts)]


def described(fact: Fact) -> str:
    """A fact in words."""
    if fact.unit:
        return "of length one"
    if fact.kind != "float" and changed(fact, nonzero=False) == UNKNOWN.as_kind(fact.kind):
        word = "true or false" if fact.kind == "bool" else f"any {fact.kind}"
        return f"{word} but 0" if fact.nonzero else word
    lo, hi = fact.lo + 0.0, fact.hi + 0.0  # no zero has a sign
    if lo == hi:
        return f"{lo:g}"
    if fact.length and not fact.excludes_zero:
        return f"a vector of length {fact.length:g} or more"
    spared = fact.nonzero and lo <= 0 <= hi
    match math.isfinite(lo), math.isfinite(hi):
        case True, True:
            return f"{lo:g}..{hi:g}" + (", not 0" if spared else "")
        case True, False:
            return f"> {lo:g}" if spared and lo == 0 else f"≥ {lo:g}"
        case False, True:
            return f"< {hi:g}" if spared and hi == 0 else f"≤ {hi:g}"
        case _:
            return "not 0" if fact.nonzero else "anything"
