"""Functions as other languages write them, and how Burnish writes them.

``advice.py`` asks here where a function's head has the type in front, or its body stands in braces.
"""

from __future__ import annotations

from collections.abc import Mapping

from ..diagnostics.fixes import Hint, fix_it
from .foreign_syntax import QUALIFIERS, types
from .forms import DECLARATIONS
from .quoting import shortened
from .token_view import TokenView

ENTRY_POINT = (
    "entry points are not written: `material Name { color = … }` says what a surface looks like, "
    "and each target's shaders follow from it"
)


_ENTRY_POINTS = frozenset(
    ("main", "mainImage", "fragment", "vertex", "frag", "vert", "surf", "PSMain", "VSMain")
)
"""The names that shaders' entry points usually have elsewhere."""

_NO_RESULT = frozenset(("fn", "void", "def", "func", "function"))
"""Words before a function's name that are no type."""


def function_hint(view: TokenView, name: int, *, outside: bool = True) -> Hint:
    """The hint for the foreign function whose name stands at ``name``.

    Only ``outside`` of materials may functions be declared, so only there an edit is offered.
    """
    if view.text(name) in _ENTRY_POINTS:
        return ENTRY_POINT
    if view.token(name + 1).kind != "(" or view.token(view.closing(name + 1)).kind != ")":
        return DECLARATIONS["fn"]
    head, opening = _head(view, name)
    body, last = "", view.closing(opening)
    if view.token(opening).kind == "{":
        body = _body(view, opening)
    value = opening + (view.text(opening) == ":")  # As in Python.
    value += view.text(value) == "return"
    if value > opening or view.text(opening - 1) == "=":
        end = view.value_end(value)
        body, last = view.written(value, end), end - 1
    shown = f"`{head} = {shortened(body) or '…'}`"
    if not outside:
        return f"a function stands outside of all materials: {shown}"
    said = f"a function is one expression: {shown}"
    if "…" in head or not body:
        return said
    first = name
    while view.token(first - 1).kind == "NAME" and not view.outline.begins_line(first):
        first -= 1
    return fix_it(said, (view.span(first, last), f"{head} = {body}"))


def _head(view: TokenView, name: int) -> tuple[str, int]:
    """The head of the function, with ``…`` for impossible arguments, and the index behind it."""
    closing = view.closing(name + 1)
    arguments = _arguments(view, name + 2, closing)
    listed = "…" if arguments is None else ", ".join(arguments)
    result = "" if view.text(name - 1) in _NO_RESULT else _type(view.text(name - 1))
    behind = closing + 1
    if view.token(behind).kind == "->":
        result = _type(view.text(behind + 1))
        behind += 2
    behind += view.token(behind).kind == "="
    head = f"fn {view.text(name)}({listed})"
    return (f"{head} -> {result}" if result else head), behind


def _type(word: str) -> str:
    return types().get(word, word)


def _arguments(view: TokenView, first: int, closing: int) -> list[str] | None:
    """The arguments between parentheses, each as ``name: type``; None if one is something else."""
    if first == closing:
        return []
    commas = [i for i in range(first, closing) if view.token(i).kind == ","]
    starts, ends = [first, *(comma + 1 for comma in commas)], [*commas, closing]
    found = [_argument(view, *bounds) for bounds in zip(starts, ends, strict=True)]
    return found if all(found) else None


def _argument(view: TokenView, first: int, end: int) -> str:
    """``float x``, ``in float x`` or ``x: f32``; empty for others, and for output arguments."""
    words = [token.text for token in view.tokens[first:end]]
    if {"out", "inout"} & set(words):
        return ""
    words = [word for word in words if word not in QUALIFIERS]
    if len(words) == 3 and words[1] == ":":
        return f"{words[0]}: {_type(words[2])}"
    if len(words) == 1:  # As in languages without types; most arguments are numbers.
        return f"{words[0]}: float"
    return f"{words[1]}: {_type(words[0])}" if len(words) == 2 else ""


def _body(view: TokenView, opening: int) -> str:
    """The result of a body in braces, with names for its parts behind ``where``.

    Empty where it has statements that no expression can stand for.
    """
    parts: dict[str, str] = {}
    first, closing = opening + 1, view.closing(opening)
    if view.token(closing).kind != "}":
        return ""
    while first < closing:
        end = next((i for i in range(first, closing) if view.token(i).kind == ";"), closing)
        result = first + (view.text(first) == "return")
        if result > first or end == closing:
            is_last = all(kind == ";" for kind in view.kinds(end, closing - end))
            return _with_parts(view.written(result, end), parts) if is_last else ""
        equals = next((i for i in range(first, end) if view.token(i).kind == "="), first)
        name, value = _declared(view, first, equals), view.written(equals + 1, end)
        if not name or not value or name in parts:
            return ""
        parts[name] = value
        first = end + 1
    return ""


def _declared(view: TokenView, first: int, equals: int) -> str:
    """The name that a statement such as ``const float y = …`` declares; empty if it is another."""
    words = [token.text for token in view.tokens[first:equals]]
    if ":" in words:
        words = words[: words.index(":")]
    return words[-1] if len(words) > 1 and all(map(str.isidentifier, words)) else ""


def _with_parts(value: str, parts: Mapping[str, str]) -> str:
    named = "; ".join(f"{name} = {part}" for name, part in parts.items())
    return f"{value} where {{ {named} }}" if value and parts else value
