"""The modules of the tree and what each imports: at its top, in functions, and for types only."""

from __future__ import annotations

import ast
from collections.abc import Iterable, Iterator, Mapping
from functools import cache
from pathlib import Path

from .kit import ROOT, files

PACKAGE = "burnish"

Graph = Mapping[str, frozenset[str]]
"""The modules of the tree that each module imports. Names are full: ``burnish.compiler.cache``;
a package stands for its ``__init__``."""


def imported(path: Path, modules: frozenset[str]) -> Iterator[str]:
    """The full names of the modules that a file imports, of any package.

    If ``from a import b`` takes the module ``a.b`` out of a package, that module is imported.
    Python also runs the ``__init__`` of each package on the way; those are edges of their own.
    """
    package = (PACKAGE, *path.relative_to(ROOT).parent.parts)
    for node in ast.walk(ast.parse(path.read_text("utf-8"))):
        if isinstance(node, ast.Import):
            yield from (alias.name for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            base = package[: len(package) + 1 - node.level] if node.level else ()
            module = ".".join((*base, *((node.module,) if node.module else ())))
            for alias in node.names:
                inner = f"{module}.{alias.name}"
                yield inner if inner in modules else module


def name(path: Path) -> str:
    """The full name of the module in a file."""
    parts = path.relative_to(ROOT).with_suffix("").parts
    return ".".join((PACKAGE, *(parts[:-1] if parts[-1] == "__init__" else parts)))


@cache
def modules() -> Graph:
    """Every module of the tree, tests included; the programs of examples are none."""
    examples = ROOT / "examples"
    found = (path for path in files(ROOT) if path.suffix == ".py")
    paths = {name(path): path for path in found if examples not in path.parents}
    known = frozenset(paths)
    return {
        module: frozenset(imported(path, known)) & known - {module}
        for module, path in paths.items()
    }


def circles(graph: Graph) -> list[list[str]]:
    """Groups of modules of which each imports every other one, if not at first hand.

    Strongly connected components of more than one module, by Tarjan's algorithm.
    """
    number: dict[str, int] = {}
    lowest: dict[str, int] = {}
    open_: list[str] = []
    found: list[list[str]] = []

    def visit(module: str) -> None:
        number[module] = lowest[module] = len(number)
        open_.append(module)
        for other in sorted(graph[module]):
            if other not in number:
                visit(other)
                lowest[module] = min(lowest[module], lowest[other])
            elif other in open_:
                lowest[module] = min(lowest[module], number[other])
        if lowest[module] == number[module]:
            start = open_.index(module)
            if len(open_) > start + 1:
                found.append(sorted(open_[start:]))
            del open_[start:]

    for module in sorted(graph):
        if module not in number:
            visit(module)
    return found


def between(graph: Graph, folders: Iterable[str]) -> dict[tuple[str, str], list[str]]:
    """Imports that lead from one folder to another, by the two folders.

    A folder is a package with all that is below it, or one module; each module counts for the
    innermost folder of those given that it lies in, and not at all where it lies in none.
    """
    places = sorted(folders, key=len)
    found: dict[tuple[str, str], list[str]] = {}
    for module, others in graph.items():
        start = _place(module, places)
        for other in sorted(others):
            end = _place(other, places)
            if start and end and start != end:
                found.setdefault((start, end), []).append(f"{module} imports {other}")
    return found


def _place(module: str, places: Iterable[str]) -> str:
    inside = [place for place in places if f"{module}.".startswith(f"{place}.")]
    return inside[-1] if inside else ""
