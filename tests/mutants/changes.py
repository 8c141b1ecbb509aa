"""The small changes that make a mutant, found in the syntax tree of a module.

Each is an edit of the text: operators, comparisons, constants, arguments, conditions, statements,
neighbouring entries of tables, and placeholders in the strings of languages' tables.
"""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeGuard

from .edit import Edit


@dataclass(frozen=True, slots=True)
class Change(Edit):
    """One edit of a module, or of an emitted text."""

    kind: str
    """The kind of thing that is changed: ``comparison``, ``constant`` and so on."""

    def told(self, text: str | bytes) -> str:
        """The line, and what is replaced by what."""
        before, after = _short(self.replaced(text)), _short(self.replacement)
        return f"{self.line(text)} {self.kind}: {before} -> {after}"


_COMPARISONS: dict[type[ast.cmpop], str] = {
    ast.Lt: "<=", ast.LtE: "<", ast.Gt: ">=", ast.GtE: ">", ast.Eq: "!=", ast.NotEq: "==",
    ast.Is: "is not", ast.IsNot: "is", ast.In: "not in", ast.NotIn: "in",
}  # fmt: skip
_OPERATORS: dict[type[ast.operator], str] = {
    ast.Add: "-", ast.Sub: "+", ast.Mult: "+", ast.Div: "*", ast.FloorDiv: "*", ast.Mod: "//",
    ast.Pow: "*", ast.BitAnd: "|", ast.BitOr: "&", ast.LShift: ">>", ast.RShift: "<<",
}  # fmt: skip
_IN_STRINGS = (
    ("{0", "{1"), (" + ", " - "), (" - ", " + "), (" * ", " / "), (" / ", " * "), (" < ", " <= "),
    (" <= ", " < "), (" > ", " >= "), (" == ", " != "), (" && ", " || "), (" || ", " && "),
    (".xy", ".yx"), (".x", ".y"), (".y", ".x"), ("0.0", "1.0"), ("1.0", "0.0"), ("true", "false"),
)  # fmt: skip
"""Edits of the texts in languages' tables; each exchanges what it finds first."""


def changes(source: bytes) -> list[Change]:
    """All changes of a module, in the order of the text."""
    found = {change for change in _Finder(source).found() if change.applied(source) != source}
    return sorted(found, key=lambda change: (change.start, change.end, change.replacement))


class _Finder:
    """Looks for changes in one module."""

    def __init__(self, source: bytes) -> None:
        self._source = source
        self._lines = [0]
        for line in source.splitlines(keepends=True):
            self._lines.append(self._lines[-1] + len(line))

    def found(self) -> Iterator[Change]:
        waiting: list[ast.AST] = [ast.parse(self._source)]
        while waiting:
            node = waiting.pop()
            yield from self._of(node)
            waiting.extend(_parts(node))

    def _of(self, node: ast.AST) -> Iterator[Change]:
        match node:
            case ast.Compare(ops=[operator]):
                yield self._between(
                    node.left, node.comparators[0], _COMPARISONS[type(operator)], "comparison"
                )
            case ast.BinOp(op=operator) if type(operator) in _OPERATORS:
                yield self._between(node.left, node.right, _OPERATORS[type(operator)], "operator")
            case ast.BoolOp(op=operator, values=[first, second, *_]):
                word = "or" if isinstance(operator, ast.And) else "and"
                yield self._between(first, second, word, "and/or")
            case ast.UnaryOp(op=ast.Not() | ast.USub(), operand=operand):
                yield self._edit(node, f"({self._text(operand)})", "sign")
            case ast.Constant(value=value):
                yield from self._of_constant(node, value)
            case ast.Call(args=[first, second, *_]):
                yield self._exchanged(first, second, "arguments")
            case ast.IfExp(test=test) | ast.If(test=test) | ast.While(test=test):
                yield self._edit(test, f"not ({self._text(test)})", "condition")
            case ast.comprehension(ifs=[test]):
                yield self._edit(test, f"not ({self._text(test)})", "condition")
            case ast.Dict(values=values):
                yield from self._of_entries(values)
            case ast.Tuple(elts=values, ctx=ast.Load()) | ast.List(elts=values, ctx=ast.Load()):
                yield from self._of_entries(values)
        if isinstance(node, ast.stmt) and _can_be_dropped(node):
            yield self._edit(node, "pass", "statement")

    def _of_constant(self, node: ast.Constant, value: object) -> Iterator[Change]:
        match value:
            case bool():
                yield self._edit(node, str(not value), "constant")
            case int():
                yield self._edit(node, str(value + 1), "constant")
                if value > 0:
                    yield self._edit(node, str(value - 1), "constant")
            case float():
                yield self._edit(node, repr(value + 1.0), "constant")
                yield self._edit(node, repr(value * 1.001), "constant")
            case str():
                yield from self._of_text(node, value)

    def _of_text(self, node: ast.Constant, value: str) -> Iterator[Change]:
        text = self._text(node)
        for old, new in _IN_STRINGS:
            if old not in value or old not in text:
                continue
            if old == "{0":
                turned = re.sub(r"\{([01])", lambda m: "{" + "10"[int(m[1])], text)
                yield self._edit(node, turned, "text")
            else:
                yield self._edit(node, text.replace(old, new, 1), "text")

    def _of_entries(self, values: list[ast.expr]) -> Iterator[Change]:
        for one, other in pairwise(values):
            if isinstance(one, ast.Constant) and isinstance(other, ast.Constant):
                yield self._exchanged(one, other, "entries")

    # --- places in the text -----------------------------------------------------------------------

    def _edit(self, node: ast.expr | ast.stmt, replacement: str, kind: str) -> Change:
        return Change(*self._span(node), replacement, kind)

    def _exchanged(self, one: ast.expr, other: ast.expr, kind: str) -> Change:
        (start, first_end), (second, end) = self._span(one), self._span(other)
        between = self._source[first_end:second].decode()
        return Change(start, end, f"{self._text(other)}{between}{self._text(one)}", kind)

    def _between(self, left: ast.expr, right: ast.expr, word: str, kind: str) -> Change:
        """Replace the operator between two operands, which may be in parentheses."""
        start, end = self._span(left)[1], self._span(right)[0]
        text = self._source[start:end].decode()
        opened = re.match(r"[\s)]*", text)
        closed = re.search(r"[\s(]*$", text)
        assert opened is not None and closed is not None
        return Change(start, end, f"{opened[0]} {word} {closed[0]}", kind)

    def _span(self, node: ast.expr | ast.stmt) -> tuple[int, int]:
        assert node.end_lineno is not None and node.end_col_offset is not None
        start = self._lines[node.lineno - 1] + node.col_offset
        return start, self._lines[node.end_lineno - 1] + node.end_col_offset

    def _text(self, node: ast.expr) -> str:
        start, end = self._span(node)
        return self._source[start:end].decode()


def statement_lines(source: bytes, offset: int) -> range:
    """The lines of the innermost statement at an offset of a module; of one that has statements in
    it, only those before them."""
    line = source.count(b"\n", 0, offset) + 1
    found = range(line, line + 1)
    for node in ast.walk(ast.parse(source)):  # outer ones come first
        if isinstance(node, ast.stmt) and node.end_lineno is not None:
            inner = [part.lineno for part in ast.walk(node) if _is_inside(part, node)]
            end = max(node.lineno, min(inner, default=node.end_lineno + 1) - 1)
            if node.lineno <= line <= end:
                found = range(node.lineno, end + 1)
    return found


def _is_inside(part: ast.AST, node: ast.stmt) -> TypeGuard[ast.stmt]:
    return isinstance(part, ast.stmt) and part is not node


def _parts(node: ast.AST) -> Iterator[ast.AST]:
    """The parts of a node in which a change can matter: no types, docstrings or messages."""
    for name, value in ast.iter_fields(node):
        if name in ("annotation", "returns", "decorator_list", "type_params", "bases"):
            continue
        if isinstance(node, ast.Raise | ast.Assert | ast.JoinedStr):
            continue
        for part in value if isinstance(value, list) else [value]:
            if isinstance(part, ast.AST) and not _says_nothing(part):
                yield part


def _says_nothing(node: ast.AST) -> bool:
    """True if a statement is a docstring, an import, or only for the checker of types."""
    match node:
        case ast.Expr(value=ast.Constant()) | ast.Import() | ast.ImportFrom():
            return True
        case ast.If(test=ast.Name(id="TYPE_CHECKING")):
            return True
        case ast.Assign(value=ast.Subscript(value=ast.Name(id="Literal" | "Callable" | "Mapping"))):
            return True
    return False


def _can_be_dropped(node: ast.stmt) -> bool:
    match node:
        case ast.Expr(value=ast.Call()) | ast.AugAssign() | ast.Continue() | ast.Break():
            return True
        case ast.Assign(targets=[ast.Attribute() | ast.Subscript()]):
            return True
    return False


def _short(text: str) -> str:
    return " ".join(text.split())[:70] or "nothing"


def template_changes(source: bytes) -> list[Change]:
    """The changes of a template: conditions turned round, and lines left out."""
    found = []
    for test in re.finditer(rb"\{%-? (?:el)?if (.*?) -?%\}", source):
        found.append(Change(*test.span(1), f"not ({test[1].decode()})", "condition"))
    for line in re.finditer(rb"^(?!.*\{%).*\S.*\n", source, re.MULTILINE):
        found.append(Change(*line.span(), "", "line"))
    return found
