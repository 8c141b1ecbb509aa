"""Syntax trees of library files, which are made when the package is built.

``library.py`` asks for them. ``generate.py`` writes what ``tree_to_generate`` and
``declarations_to_generate`` return into a module of the package ``generated``. A file that has
changed since, or that is not of this library, is parsed; so is everything if the parser has
changed.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from functools import cache

from .cache import digest
from .diagnostics.diagnostic import Report
from .diagnostics.source import Source
from .precomputed import Precomputations, key, precomputed
from .semantics.names.modules import Named
from .semantics.names.standard_library import Parse
from .syntax import ast
from .syntax.parser import parse
from .syntax.stored import loaded, stored

_FOLDERS = ("compiler/syntax", "compiler/syntax/ast")
_FILES = ("compiler/library_trees.py", "compiler/diagnostics/source.py", "support/frozen.py")
"""The folders and further files of the package that decide how a tree looks."""


def parse_library(source: Source, report: Report) -> ast.File:
    """The tree of a library file; ``report`` gets the mistakes."""
    tree = precomputed("library", _key(source))
    if tree is None:
        return parse(source, report)
    file: ast.File = loaded(tree, source)
    return file


def declarations(source: Source) -> Mapping[str, bytes]:
    """The declarations of a library file by their names, each as stored bytes.

    Several functions with different arguments may have one name, so each stands for a list.
    This is for a large file of which a compile needs few declarations.
    """
    found: dict[str, bytes] | None = precomputed("library", _key_of_declarations(source))
    return _declarations(source) if found is None else found


def tree_to_generate(source: Source) -> Precomputations:
    """The tree that ``parse_library`` looks for."""
    return {_key(source): lambda: stored(flawless(source, parse))}


def declarations_to_generate(source: Source) -> Precomputations:
    """The trees that ``declarations`` looks for."""
    return {_key_of_declarations(source): lambda: _declarations(source)}


def flawless(source: Source, parse: Parse) -> ast.File:
    """The tree of a file in which there are no mistakes, unless somebody is changing it."""
    report = Report()
    file = parse(source, report)
    assert not report.diagnostics, report.diagnostics
    return file


def _declarations(source: Source) -> dict[str, bytes]:
    declared: dict[str, list[Named]] = {}
    for declaration in flawless(source, parse).declarations:
        assert not isinstance(declaration, ast.Import)
        declared.setdefault(declaration.name.text, []).append(declaration)
    return {name: stored(overloaded) for name, overloaded in declared.items()}


def _key(source: Source) -> str:
    return key(_parser_digest(), source.text)


def _key_of_declarations(source: Source) -> str:
    return key(_parser_digest(), "declarations", source.text)


@cache
def _parser_digest() -> str:
    """A digest of all code that decides how a tree looks: a part of each key."""
    package = os.path.dirname(os.path.dirname(__file__))  # noqa: PTH120 - objects are slower
    paths = [f"{package}/{name}" for name in _FILES]
    for folder in _FOLDERS:
        names = sorted(os.listdir(f"{package}/{folder}"))  # noqa: PTH208
        paths += [f"{package}/{folder}/{name}" for name in names if name.endswith((".py", ".lark"))]
    return digest(b"\0".join(map(_content, paths)))


def _content(path: str) -> bytes:
    with open(path, "rb") as file:  # noqa: PTH123
        return file.read()
