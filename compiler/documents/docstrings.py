"""Docstrings of records and of their fields, from the source.

Python keeps the docstrings of classes, but not those of fields. Only schemas and pages need them,
so they are read from the source then.
"""

from __future__ import annotations

import ast
import inspect
import sys
from functools import cache
from typing import NamedTuple


class Docs(NamedTuple):
    """The texts of one kind of record, each in one line."""

    whole: str
    fields: dict[str, str]
    """The texts of the fields, by the fields' names."""


def docs_of(kind: type) -> Docs:
    """The docstrings of a kind of record, in the form of Markdown."""
    return _module_docs(kind.__module__)[kind.__name__]


@cache
def _module_docs(name: str) -> dict[str, Docs]:
    tree = ast.parse(inspect.getsource(sys.modules[name]))
    classes = (node for node in tree.body if isinstance(node, ast.ClassDef))
    return {each.name: _class_docs(each) for each in classes}


def _class_docs(node: ast.ClassDef) -> Docs:
    fields = {}
    for statement, following in zip(node.body, node.body[1:], strict=False):
        if isinstance(statement, ast.AnnAssign) and isinstance(statement.target, ast.Name):
            fields[statement.target.id] = _text(following)
    return Docs(_line(ast.get_docstring(node) or ""), fields)


def _text(statement: ast.stmt) -> str:
    """The docstring that a statement is; empty for any other."""
    is_text = isinstance(statement, ast.Expr) and isinstance(statement.value, ast.Constant)
    return _line(str(statement.value.value)) if is_text else ""  # type: ignore[attr-defined]


def _line(text: str) -> str:
    return " ".join(text.replace("``", "`").split())
