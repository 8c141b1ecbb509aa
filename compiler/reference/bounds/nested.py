"""Values of several lanes, which are tuples in tuples, lane by lane."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from .bounded import Bounded, as_bounded


def flat(value: Any) -> Iterator[Bounded]:
    """The lanes of a value, in order."""
    if isinstance(value, tuple):
        for part in value:
            yield from flat(part)
    else:
        yield as_bounded(value)


def rebuilt(value: Any, lanes: Iterator[Bounded]) -> Any:
    """A value of the same form with other lanes."""
    if isinstance(value, tuple):
        return tuple([rebuilt(part, lanes) for part in value])
    return next(lanes)
