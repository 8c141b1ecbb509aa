"""Random programs as trees, which can be shrunk and rewritten, and printed as text."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, replace

Path = tuple[int, ...]
"""The way from a root to a node: the index of a part at each level."""


@dataclass(frozen=True)
class Node:
    """A part of a program: an expression, a member, a declaration, or the whole file."""

    form: str
    """The text, in which each ``{}`` stands for one part; or for all parts, if there is a joint."""
    parts: tuple[Node, ...] = ()
    type: str = ""
    """The type of an expression, as it is written; empty for everything else."""
    role: str = ""
    """The node's role, for functions that rewrite programs: ``add``, ``if``, ``slot`` …"""
    needs: frozenset[str] = frozenset()
    """The needs of an expression: an ability of ``scope.py`` that its place must have, or
    ``local x`` for a name that a loop or a function binds."""
    joint: str | None = None
    """The text between the parts of a list."""
    optional: bool = False
    """True if the node stands in a list and the program may still be correct without it."""
    name: str = ""
    """The name that a declaration declares, or that a reference means."""

    def __str__(self) -> str:
        texts = [str(part) for part in self.parts]
        return (
            self.form.format(*texts)
            if self.joint is None
            else self.form.format(self.joint.join(texts))
        )

    @property
    def size(self) -> int:
        """The number of nodes."""
        return 1 + sum(part.size for part in self.parts)


def expression(
    type_: str,
    form: str,
    parts: Iterable[Node] = (),
    role: str = "",
    needs: Iterable[str] = (),
    binds: Iterable[str] = (),
    name: str = "",
) -> Node:
    """An expression, which needs what its parts need, except for the names that it binds."""
    operands = tuple(parts)
    inherited = frozenset[str]().union(*(part.needs for part in operands))
    bound = {f"local {each}" for each in binds}
    return Node(form, operands, type_, role, (inherited - bound) | {*needs}, name=name)


def listed(form: str, items: Iterable[Node], joint: str = "\n", role: str = "") -> Node:
    """A list, from which shrinking may drop what is optional."""
    return Node(form, tuple(items), role=role, joint=joint)


def walk(root: Node, path: Path = ()) -> Iterator[tuple[Path, Node]]:
    """All nodes with their paths, each before its parts."""
    yield path, root
    for index, part in enumerate(root.parts):
        yield from walk(part, (*path, index))


def at(root: Node, path: Path) -> Node:
    """The node at the end of a path."""
    for index in path:
        root = root.parts[index]
    return root


def changed(root: Node, path: Path, change: Callable[[Node], Node | None]) -> Node:
    """The tree with one node replaced, or left out of its list if the change gives ``None``."""
    if not path:
        found = change(root)
        assert found is not None, "the whole program cannot be left out"
        return found
    index, *rest = path
    if not rest and (found := change(root.parts[index])) is None:
        return replace(root, parts=root.parts[:index] + root.parts[index + 1 :])
    part = changed(root.parts[index], tuple(rest), change)
    return replace(root, parts=(*root.parts[:index], part, *root.parts[index + 1 :]))


def substituted(root: Node, role: str, values: dict[str, Node]) -> Node:
    """The tree with references of one role replaced by the values of their names."""
    if root.role == role and root.name in values:
        return values[root.name]
    parts = tuple(substituted(part, role, values) for part in root.parts)
    return root if parts == root.parts else replace(root, parts=parts)
