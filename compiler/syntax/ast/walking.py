"""The parts of any node, for those who look for something that may stand anywhere in a tree."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import chain

from . import declarations, expressions, members


def parts(node: object) -> Sequence[object]:
    """What a node, or a tuple of nodes, directly consists of; nothing for words and places."""
    if isinstance(node, tuple):
        return node
    return [getattr(node, field) for field in _FIELDS.get(type(node), ())]


def _fields() -> Iterator[tuple[type, tuple[str, ...]]]:
    """Each class of nodes with the names of its fields."""
    modules = declarations, expressions, members
    for kind in chain.from_iterable(vars(module).values() for module in modules):
        if isinstance(kind, type) and kind.__module__.startswith(__package__):
            yield kind, getattr(kind, "__match_args__", ())


_FIELDS = dict(_fields())
