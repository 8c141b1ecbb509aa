"""Changes one place of a plan after the other: whatever may go wrong when a plan is made or edited.

``test_planted.py`` asks of each changed plan who notices.
"""

from __future__ import annotations

import copy
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

Path = tuple[str | int, ...]

FREE = frozenset(("doc", "source", "sources"))
"""The members of a plan that only people read, so that they may be changed freely."""


@dataclass(frozen=True, slots=True)
class Change:
    """Another value at one place."""

    path: Path
    said: str
    value: Any

    @property
    def name(self) -> str:
        """The place, and what changes there."""
        return f"{'.'.join(map(str, self.path))}: {self.said}"

    def made(self, plan: dict[str, Any]) -> dict[str, Any]:
        """The plan with it; what does not change is shared."""
        whole: Any = copy.copy(plan)
        place = whole
        *outer, last = self.path
        for part in outer:
            place[part] = copy.copy(place[part])
            place = place[part]
        place[last] = self.value
        found: dict[str, Any] = whole
        return found


def changes(plan: dict[str, Any]) -> Iterator[Change]:
    """All changes of one place that are tried."""
    known = _known(plan)
    for path, value in _places(plan, ()):
        for said, other in _others(path, value, known):
            yield Change(path, said, other)


def _known(plan: dict[str, Any]) -> dict[str, list[Any]]:
    """All values that stand under a key, anywhere in a plan: what can be meant there."""
    found: dict[str, list[Any]] = defaultdict(list)
    for path, value in _places(plan, ()):
        key = _key(path)
        if not isinstance(value, list | dict) and value not in found[key]:
            found[key].append(value)
    return found


def _places(value: Any, path: Path) -> Iterator[tuple[Path, Any]]:
    if path:
        yield path, value
    if isinstance(value, dict):
        for key, inner in value.items():
            if key not in FREE:
                yield from _places(inner, (*path, key))
    elif isinstance(value, list):
        for number, inner in enumerate(value):
            yield from _places(inner, (*path, number))


def _key(path: Path) -> str:
    return next(str(part) for part in reversed(path) if isinstance(part, str))


def _others(path: Path, value: Any, known: dict[str, list[Any]]) -> Iterator[tuple[str, Any]]:
    """The other values that a place might have, each with a sentence about the change."""
    if isinstance(value, list):
        yield from _other_lists(value)
        return
    if isinstance(value, dict):
        return
    for other in known[_key(path)]:
        if other != value or type(other) is not type(value):
            yield f"{value!r} becomes {other!r}", other
    if isinstance(value, bool):
        yield f"{value} becomes {not value}", not value
    elif isinstance(value, int):
        for other in (value + 1, value - 1):
            yield f"{value} becomes {other}", other
    elif isinstance(value, str):
        yield f"{value!r} gets a letter", f"{value}x"


def _other_lists(value: Sequence[Any]) -> Iterator[tuple[str, list[Any]]]:
    """Other lists: without a row, with a row twice, with two rows exchanged."""
    for number, row in enumerate(value):
        yield f"without row {number}", [*value[:number], *value[number + 1 :]]
        yield f"row {number} twice", [*value[: number + 1], *value[number:]]
        if number and value[number - 1] != row:
            swapped = [*value[: number - 1], row, value[number - 1], *value[number + 1 :]]
            yield f"row {number} before the one before it", swapped
