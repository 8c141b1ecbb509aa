"""Writes proofs as text: why each guard was left out, or what a kept guard lacks."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...compiler.diagnostics.source import Span
from ...compiler.ir.rulebook import RULES
from ...compiler.passes.proofs import Proof, ProofStep
from ...compiler.passes.remarks import Outcome

_HEADINGS: dict[Outcome, str] = {
    "native": "Proven: these need no guard",
    "dropped": "Left away: these change nothing",
    "guarded": "Guarded: not enough is known",
}


def written(title: str, proofs: Iterable[Proof]) -> str:
    """All proofs of a material, under headings."""
    found = tuple(proofs)
    lines = [title]
    for outcome, heading in _HEADINGS.items():
        chosen = [proof for proof in found if proof.outcome == outcome]
        if chosen:
            lines += ["", f"{heading} ({len(chosen)})"]
            for proof in chosen:
                lines += ["", *_proof(proof)]
    if not found:
        lines += ["", "Nothing in it could need a guard."]
    return "\n".join([*lines, *_cited(found)]) + "\n"


def _cited(proofs: Iterable[Proof]) -> Iterator[str]:
    """The rules that proofs cite, with explanations; a builtin's rule has the builtin's name."""
    cited = {step.rule for proof in proofs for step in proof.steps}
    rules = {name: words for name, words in RULES.items() if name in cited}
    if rules:
        yield from ("", "Rules")
        yield ""
        width = max(map(len, rules))
        yield from (f"  {name:<{width}}  {words}" for name, words in rules.items())


def _proof(proof: Proof) -> Iterator[str]:
    yield f"  {proof.text}{_at(proof.span)}"
    if proof.outcome == "guarded" and proof.needs:
        yield f"    needed: {proof.needs}"
    elif proof.outcome == "native":
        yield f"    shown: {proof.needs}"
    elif proof.equation:
        yield f"    rule: {proof.equation}  [{proof.rule}]"
    for step in proof.steps:
        yield _step(step, proof.span)
    if proof.omitted:
        yield f"    - and so on, for {proof.omitted} more"
    for text in proof.missing:
        yield f"    missing: {text}"
    if proof.otherwise:
        yield f"    instead: {proof.otherwise}"


def _step(step: ProofStep, around: Span | None) -> str:
    indent = "  " * (step.depth + 1)
    where = f" where {step.where}" if step.where else ""
    rule = f"  [{step.rule}]" if step.rule else ""
    place = _at(step.span) if step.span is not None and _elsewhere(step.span, around) else ""
    return f"{indent}- {step.text} is {step.fact}{where}{rule}{place}"


def _elsewhere(span: Span, around: Span | None) -> bool:
    """True if a step's place has to be printed, because it is not within the place of the whole."""
    if around is None or span.source is not around.source:
        return True
    return not around.start <= span.start <= around.end


def _at(span: Span | None) -> str:
    return "" if span is None else f"   ({span})"
