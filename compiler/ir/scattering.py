"""Scattered values, and the elements with which they are joined.

Stages ask it of their outputs for the texts, and the reference of a shader's results.
"""

from __future__ import annotations

from collections.abc import Iterable
from typing import Protocol

from ...support.frozen import frozen
from .node import Node
from .shader import Store
from .stages import CONDITION, PLACE, SCATTER


class _Delivered(Protocol):
    """A result of a shader, or an output of a stage."""

    @property
    def kind(self) -> str: ...

    @property
    def value(self) -> Node: ...

    @property
    def store(self) -> Store | None: ...


@frozen
class Scattered:
    """A value that an invocation joins with an element of its own choice."""

    store: Store
    value: Node
    place: Node
    condition: Node


def scattered(delivered: Iterable[_Delivered]) -> tuple[Scattered, ...]:
    """The scattered values, once for each buffer that they go to."""
    found: dict[Store, dict[str, Node]] = {}
    for each in delivered:
        if each.store is not None and each.store.operator is not None:
            found.setdefault(each.store, {})[each.kind] = each.value
    return tuple(
        Scattered(store, values[SCATTER], values[PLACE], values[CONDITION])
        for store, values in found.items()
    )
