"""Prints rules as equations: ``sqrt(x * x) → abs(x)``.

``docs/passes.md`` has those of all rules, and ``burnish graph --why`` shows the ones that have
removed an operation.
"""

from __future__ import annotations

from collections.abc import Iterator

from ....stdlib.builtins import BUILTINS
from ...formula import SIGN, TIGHTNESS, WORDS
from .rule import Rule
from .terms import (
    CONSTANT,
    Computed,
    Condition,
    Function,
    Heads,
    Operation,
    Several,
    Term,
    Uniform,
    Variable,
    as_term,
)

MOST_NAMED = 6
"""Operations that are listed; the sentence of a rule describes larger sets."""


def equations(rule: Rule) -> tuple[str, ...]:
    """All equations of a rule."""
    return tuple(f"{_text(left)} → {_text(as_term(right))}" for left, right in rule.equations)


def conditions(rule: Rule) -> str:
    """The conditions of the rule's equations, in words."""
    kinds = [kind for left, _ in rule.equations for kind in _kinds(left)]
    calls = ["none is a hardware operation yet"] if rule.of_calls else []
    return ", ".join(dict.fromkeys([*kinds, *map(_condition, rule.conditions), *calls]))


def _condition(condition: Condition) -> str:
    return condition.words.format(*map(_argument, condition.arguments))


def _kinds(term: Term | Function) -> Iterator[str]:
    """The conditions on the kinds of the names in a term; ``c`` and ``d`` are always constants."""
    match term:
        case Function(name=name, heads=heads) if len(heads) > 1:
            yield from _among(name, frozenset(heads))
        case Variable(name=name, heads=heads) if heads is not None and heads != CONSTANT:
            yield from _among(name, heads)
        case Several(name=name, every=every, some=some):
            for word, heads in (("each of", every), ("some of", some)):
                if heads is not None:
                    yield from _among(f"{word} {name}", heads)
        case Operation():
            yield from _kinds(term.function)
            for operand in term.operands:
                yield from _kinds(operand)


def _among(name: str, heads: Heads) -> Iterator[str]:
    """The condition that a name stands for one of these operations."""
    words = sorted(str(head).removeprefix(".") for head in heads - CONSTANT)
    if heads >= CONSTANT:
        words.insert(0, "constant")
    if len(words) <= MOST_NAMED:
        yield f"{name} is {' or '.join(words)}"


def _argument(given: Term | Function) -> str:
    return given.name if isinstance(given, Function) else _text(given)


def _text(term: Term, tightness: int = 0) -> str:
    """A term; in parentheses, if it binds less than that."""
    match term:
        case Variable(name=name):
            return name
        case Operation(label=Variable(name=name)):
            return f"{name}@({_operation(term)})"
        case Several(name=name):
            return f"{name}…"
        case Uniform(value=value):
            return str(value).lower()
        case Computed(name=name, arguments=arguments):
            return f"{name}({', '.join(map(_argument, arguments))})"
        case Operation(function=Function(heads=(head,))):
            text = _operation(term)
            is_loose = TIGHTNESS.get(head, SIGN if _is_sign(term) else tightness) < tightness
            return f"({text})" if is_loose else text
        case Operation():
            return _operation(term)
        case _:
            return str(getattr(term, "name", term))


def _is_sign(term: Operation) -> bool:
    return len(term.operands) == 1 and _sign(term) != ""


def _sign(term: Operation) -> str:
    """The operator of a builtin that has one."""
    if len(term.function.heads) > 1 or (head := term.function.heads[0]) not in BUILTINS:
        return ""
    return WORDS.get(head) or BUILTINS[head].operator or ""


def _operation(term: Operation) -> str:
    sign, head = _sign(term), term.function.heads[0]
    if sign and len(term.operands) == 1:
        return f"{sign}{_text(term.operands[0], SIGN + 1)}"
    if sign and head in TIGHTNESS:
        left, right = term.operands
        return f"{_text(left, TIGHTNESS[head])} {sign} {_text(right, TIGHTNESS[head] + 1)}"
    data = "" if term.function.data is None else f"[{_text(term.function.data)}]"
    return f"{term.function.name}{data}({', '.join(map(_text, term.operands))})"
