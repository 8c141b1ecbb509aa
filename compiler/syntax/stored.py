"""Syntax trees as bytes, from which they are made for another text, or at another place of one.

``library_trees.py`` stores trees of library files when the package is built, and ``incremental.py``
those of a user's file from one edit to the next. They are pickles, because these are loaded much
faster than a text is parsed. The larger part of a declaration is loaded when somebody looks at it.
"""

from __future__ import annotations

import pickle
import sys
from collections.abc import Callable
from functools import cache, partial
from importlib import import_module
from io import BytesIO
from typing import Any

from ...support.late import Late, other_fields, unfinished
from ..diagnostics.source import Source, Span
from . import ast

_DEEPEST = 10_000
"""The largest number of nested calls for which the stack of a thread is surely large enough.

Pickles are made by nested calls, up to the limit that a program has set.
"""


def stored(tree: object, origin: int = 0) -> bytes:
    """A tree without its text, which is the same for all parts of it.

    Places in the text count from ``origin``. Raises ``RecursionError`` if the tree is too deep.
    """
    if sys.getrecursionlimit() > _DEEPEST:
        raise RecursionError(f"the stack may be too small for {sys.getrecursionlimit()} calls")
    stream = BytesIO()
    _Pickler(stream, origin).dump(tree)
    return stream.getvalue()


def loaded(tree: bytes, source: Source, origin: int = 0) -> Any:
    """A new tree, for a text in which the same stands at ``origin``."""
    return _Unpickler(BytesIO(tree), source, origin).load()


def text() -> Source:
    """Stands for the text in bytes; the unpickler calls a function that knows it instead."""
    raise NotImplementedError


def span(start: int, end: int) -> Span:
    """Stands for a span in the same way."""
    raise NotImplementedError(start, end)


def declaration(kind: type[Late], fields: tuple[object, ...], late: bytes) -> Late:
    """Stands for a declaration of which a part is loaded later."""
    raise NotImplementedError(kind, fields, late)


class _Pickler(pickle.Pickler):
    """Writes calls of these functions."""

    def __init__(self, stream: BytesIO, origin: int) -> None:
        super().__init__(stream, pickle.HIGHEST_PROTOCOL)
        self._origin = origin
        self.dispatch_table: dict[type, Callable[[Any], tuple[Any, ...]]] = {
            Source: lambda _: (text, ()),
            Span: lambda at: (span, (at.start - origin, at.end - origin)),
            **dict.fromkeys((ast.Record, ast.Mixin, ast.Function), self._declaration),
        }

    def _declaration(self, record: Late) -> tuple[Any, ...]:
        kind: Any = type(record)
        fields = tuple([getattr(record, name) for name in other_fields(kind)])
        return declaration, (kind, fields, stored(getattr(record, kind.late), self._origin))


class _Unpickler(pickle.Unpickler):
    """Answers these calls."""

    def __init__(self, stream: BytesIO, source: Source, origin: int) -> None:
        super().__init__(stream)
        self._answers: dict[str, Callable[..., object]] = {
            text.__name__: lambda: source,
            span.__name__: lambda start, end: Span(source, origin + start, origin + end),
            declaration.__name__: lambda kind, fields, late: unfinished(
                kind, fields, partial(loaded, late, source, origin)
            ),
        }

    def find_class(self, module: str, name: str) -> Any:
        return self._answers[name] if module == __name__ else _found(module, name)


@cache
def _found(module: str, name: str) -> Any:
    """A class; to find it takes longer than to make a node."""
    return getattr(import_module(module), name)
