"""The peers of the bench: those that can be used here, and the reasons why others cannot."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from itertools import count

from ..table import Row
from . import materialx, slang
from .peer import MissingPeerError, Texts

_NUMBERS = count()
"""A number for each material, so that no compiler sees the same one again."""


@dataclass(frozen=True, slots=True)
class Peer:
    """A compiler in one way to use it."""

    name: str
    what: str
    """The work that it does."""
    made: Texts | None
    problem: str = ""
    """The reason why it is not there."""

    @property
    def is_there(self) -> bool:
        """True if it can be used here."""
        return self.made is not None

    def texts(self) -> Sequence[str]:
        """The texts of a material that it has not seen before."""
        assert self.made is not None, "it is there"
        return self.made(next(_NUMBERS))

    def row(self) -> Row:
        """The peer as a row of a table."""
        return {"peer": self.name, "does": self.what, "not run because": self.problem or None}


def found_peers() -> list[Peer]:
    """Every peer in every way."""
    return [
        *_of(materialx.WAYS, materialx.ways),
        *_of(slang.WAYS, slang.ways),
    ]


def _of(described: Mapping[str, str], ways: Callable[[], Mapping[str, Texts]]) -> list[Peer]:
    try:
        made = ways()
    except MissingPeerError as error:
        return [Peer(way, what, None, str(error)) for way, what in described.items()]
    return [Peer(way, what, made[way]) for way, what in described.items()]
