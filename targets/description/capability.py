"""The records of the table of capabilities, and the function that computes one of its cells.

``capabilities.py`` has the rows and says who reads them. A row does not say which profiles have the
capability: that follows from what a ``Profile`` says of itself, by the *needs* of the row.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Literal, get_args

from ...compiler.ir.stages import StageRow
from ...support.frozen import frozen
from .profile import Profile


@frozen(eq=False)
class Need:
    """A requirement that a profile meets or does not meet."""

    feature: str
    """The name of the feature, which follows "… has no" in messages."""
    is_met: Callable[[Profile], bool]
    builtins: frozenset[str] = frozenset()
    """The builtins that need the feature."""


def feature_of_stage(row: StageRow) -> str:
    """The name of the missing feature, for a message, where a profile lacks a stage."""
    return f"{row.name} stage"


def a_stage(row: StageRow) -> Need:
    """The need of a stage."""
    return Need(feature_of_stage(row), lambda profile: row in profile.stages)


def some_builtins(feature: str, *names: str) -> Need:
    """The need of builtins that nothing can replace."""
    needed = frozenset(names)
    return Need(feature, lambda profile: not needed & profile.cannot, needed)


def words_for(feature: str, *names: str) -> Need:
    """The need of a word of the language for each of some builtins."""
    return Need(feature, lambda profile: not profile.lacks.intersection(names))


@frozen
class Way:
    """One way to implement a capability, and the needs that a profile has to meet for it."""

    needs: tuple[Need, ...]
    how: str = ""
    """The compiler's replacement, if these are not the profile's own means: a sentence without its
    capital letter and its full stop."""


@frozen(eq=False)
class Capability:
    """One row of the table."""

    name: str
    """The name in tables, and the key in JSON."""
    doc: str
    """Describes the capability, and how a program asks for it."""
    ways: tuple[Way, ...]
    """The ways in order; the first one uses the profile's own means. If these are missing, or not
    asked for, the compiler takes the first of the other ways whose needs are met."""
    instead: str = ""
    """Advice for a user where no way works: an imperative that follows "help:"."""
    on_request: bool = False
    """True if a profile's own means are used only with ``--native-stages``."""


Kind = Literal["native", "lowered", "absent"]
KINDS: tuple[Kind, ...] = get_args(Kind)


@frozen
class Standing:
    """One cell of the table: how a profile implements a capability, if it does."""

    kind: Kind
    how: str = ""
    """The compiler's replacement, if the capability is lowered."""
    missing: tuple[str, ...] = ()
    """The features that the profile lacks; empty if the capability is native."""


def standing(capability: Capability, profile: Profile) -> Standing:
    """The cell of a capability and a profile."""
    missing = _missing(capability.ways[0], profile)
    if not missing:
        return Standing("native")
    instead = lowering(capability, profile)
    return Standing("lowered", instead.how, missing) if instead else Standing("absent", "", missing)


def lowering(capability: Capability, profile: Profile) -> Way | None:
    """The way that a profile uses instead of its own means; ``None`` if there is none."""
    return next((way for way in capability.ways[1:] if not _missing(way, profile)), None)


def is_only_on_request(capability: Capability, profile: Profile) -> bool:
    """True if a profile has a capability, but refuses it without ``--native-stages``."""
    is_native = not _missing(capability.ways[0], profile)
    return is_native and capability.on_request and lowering(capability, profile) is None


def _missing(way: Way, profile: Profile) -> tuple[str, ...]:
    return tuple(need.feature for need in way.needs if not need.is_met(profile))
