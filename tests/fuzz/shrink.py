"""Shrinks a random program to a small one that still shows the same finding."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from functools import partial

from .rules import FLOATS
from .tree import Node, Path, changed, walk

Shows = Callable[[Node], bool]
"""A test that is true for programs that still show the finding."""

SIMPLEST = {
    "float": ("0.0", "1.0", "0.5", "2.0"), "int": ("0", "1", "2"), "uint": ("0u", "1u"),
    "bool": ("false", "true"), "rgb": ("#fff",), "angle": ("30deg",),
}  # fmt: skip
"""The texts that can replace an expression of a type, the simplest first."""


def shrunk(tree: Node, shows: Shows, seconds: float) -> Node:
    """The smallest program that was found within a time."""
    end = time.monotonic() + seconds
    found = tree
    while time.monotonic() < end:
        smaller = _once(found, shows, end)
        if smaller == found:
            break
        found = smaller
    return found


def _once(tree: Node, shows: Shows, end: float) -> Node:
    """The program after each of its nodes was tried to be left out or made simpler."""
    for halves in (8, 4, 2):
        tree = _without_groups(tree, shows, end, halves)
    position = 0
    while time.monotonic() < end:
        nodes = list(walk(tree))
        if position >= len(nodes):
            break
        path, node = nodes[position]
        for candidate in _simpler(tree, path, node):
            if time.monotonic() >= end:
                return tree
            if candidate.size <= tree.size and str(candidate) != str(tree) and shows(candidate):
                tree = candidate
                break
        else:
            position += 1
    return tree


def _without_groups(tree: Node, shows: Shows, end: float, count: int) -> Node:
    """The program without several of its optional parts at once."""
    position = 0
    while time.monotonic() < end:
        optional = [path for path, node in walk(tree) if node.optional]
        group = optional[position : position + count]
        if len(group) < 2:
            return tree
        candidate = tree
        for path in reversed(group):  # from the back, so that the other paths stay what they are
            candidate = changed(candidate, path, lambda _: None)
        if shows(candidate):
            tree = candidate
        else:
            position += count
    return tree


def _simpler(tree: Node, path: Path, node: Node) -> Iterator[Node]:
    """The programs in which one node is simpler, those with the greatest step first."""
    if node.optional:
        yield changed(tree, path, lambda _: None)
    if node.role == "base":
        yield changed(tree, path, partial(_always, Node("Surface", role="base")))
    if not node.type:
        return
    for replacement in (*_literals(node), *_inner(node)):
        yield changed(tree, path, partial(_always, replacement))


def _always(replacement: Node, _node: Node) -> Node:
    return replacement


def _literals(node: Node) -> Iterator[Node]:
    """Literals of an expression's type that are simpler than it."""
    texts = SIMPLEST.get(node.type, ())
    if node.role == "literal":
        known = node.form in texts
        texts = texts[: texts.index(node.form)] if known else texts
    elif not node.parts:
        return
    for text in texts:
        yield Node(text, type=node.type, role="literal")
    if node.type in FLOATS[1:]:
        yield Node(f"{node.type}(0.5)", type=node.type, role="literal")


def _inner(node: Node) -> list[Node]:
    """The expressions in an expression that have its type, the smallest first."""
    found = [part for _, part in walk(node) if part is not node and part.type == node.type]
    return sorted(found, key=lambda each: each.size)
