"""The small changes of an expression of the library that make a mutant of it.

Each is an edit of a file's text: an operator, a comparison, a number, the sides of a choice, an
argument, a lane or a function is exchanged, as somebody could by mistake.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise

from burnish.compiler.diagnostics.diagnostic import Report
from burnish.compiler.diagnostics.source import Source, Span
from burnish.compiler.syntax import ast
from burnish.compiler.syntax.parser import parse


@dataclass(frozen=True)
class Change:
    """One edit of a file of the library."""

    file: str
    """The file's name without its ending."""
    declaration: str
    """The full name of the declaration that it changes."""
    start: int
    end: int
    replacement: str

    def applied(self, text: str) -> str:
        """The file's text with the edit."""
        return text[: self.start] + self.replacement + text[self.end :]

    def told(self, text: str) -> str:
        """The declaration, and what is replaced by what."""
        before, after = (
            " ".join(each.split()) for each in (text[self.start : self.end], self.replacement)
        )
        return f"{self.declaration}: {before} -> {after}"

    def line(self, text: str) -> int:
        """The number of the line, from 1."""
        return text.count("\n", 0, self.start) + 1


_OPERATORS = {
    "+": "-", "-": "+", "*": "/", "/": "*", "mod": "+", "&": "|", "|": "&", "<<": ">>", ">>": "<<",
    "==": "!=", "!=": "==", "<": ">", "<=": ">", ">": "<", ">=": "<", "and": "or", "or": "and",
}  # fmt: skip
_FUNCTIONS = {
    "min": "max", "max": "min", "sin": "cos", "cos": "sin", "saturate": "abs", "abs": "-",
    "length": "-length", "dot": "-dot", "normalize": "2 * normalize", "sqrt": "2 * sqrt",
    "reflect": "-reflect", "transpose": "inverse", "inverse": "transpose",
}  # fmt: skip
_COMMUTATIVE = {"dot", "min", "max", "distance"}
"""Functions of two arguments whose order does not count."""
_FOLDS = {"sum": "max", "min": "max", "max": "min", "any": "all", "all": "any"}
_LANES = {"x": "y", "y": "x", "z": "x", "w": "z", "r": "g", "g": "r", "b": "g", "a": "r"}


def changes(name: str, text: str) -> list[Change]:
    """All changes of a file of the library, in the order of its text."""
    file = parse(Source(name, text), Report())
    found = set()
    for declaration in file.declarations:
        if isinstance(declaration, ast.Import):
            continue
        full = f"std.{name}.{declaration.name.text}"
        for node in _expressions(declaration):
            for start, end, replacement in _edits(node, text):
                found.add(Change(name, full, start, end, replacement))
    return sorted(found, key=lambda each: (each.start, each.end, each.replacement))


def _expressions(root: object) -> Iterator[object]:
    """All records of a syntax tree below one."""
    waiting = [root]
    while waiting:
        node = waiting.pop()
        if isinstance(node, tuple | list):
            waiting += node
        elif type(node).__module__.startswith(ast.__name__) and not isinstance(node, ast.TypeName):
            yield node
            fields: tuple[str, ...] = vars(type(node))["__match_args__"]
            waiting += [getattr(node, field) for field in fields]


def _edits(node: object, text: str) -> Iterator[tuple[int, int, str]]:
    """The edits of one node: from where to where, and what is there then."""
    match node:
        case ast.Binary(operator=operator, left=left, right=right) if operator in _OPERATORS:
            between = text[left.span.end : right.span.start]
            at = left.span.end + between.index(operator)
            yield at, at + len(operator), _OPERATORS[operator]
        case ast.Number(span=span, text=digits, kind=kind):
            yield span.start, span.start + len(digits), _other_number(digits, kind)
        case ast.Conditional(then=then, otherwise=otherwise):
            yield from _exchanged(text, then.span, otherwise.span)
        case ast.Unary(span=span, operator="-", operand=operand):
            yield span.start, operand.span.start, ""
        case ast.Call(callee=ast.Reference(name=name, span=span), arguments=arguments):
            if name in _FUNCTIONS:
                yield span.start, span.end, _FUNCTIONS[name]
            if name not in _COMMUTATIVE:
                yield from _other_arguments(text, arguments)
        case ast.Field(name=ast.Name(text=lanes, span=span)) if set(lanes) <= _LANES.keys():
            yield span.start, span.start + 1, _LANES[lanes[0]]
        case ast.Fold(span=span, operator=word) if word in _FOLDS:
            yield span.start, span.start + len(word), _FOLDS[word]


def _other_number(digits: str, kind: str) -> str:
    """Another number of the same kind: 1 more, or 1 for 2."""
    if kind in ("int", "uint") or digits.isdigit():
        return str(int(digits) + 1) if not digits.startswith("0x") else f"{int(digits, 16) + 1}"
    return repr(float(digits) * 1.25 + 0.0625 * (float(digits) == 0))


def _other_arguments(
    text: str, arguments: Sequence[ast.Expression]
) -> Iterator[tuple[int, int, str]]:
    """Two neighbouring arguments exchanged, if they are not written alike."""
    for one, other in pairwise(arguments):
        yield from _exchanged(text, one.span, other.span)


def _exchanged(text: str, one: Span, other: Span) -> Iterator[tuple[int, int, str]]:
    first, last = text[one.start : one.end], text[other.start : other.end]
    if first != last:
        yield one.start, other.end, last + text[one.end : other.start] + first
