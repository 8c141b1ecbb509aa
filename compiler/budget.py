"""Limits of what received data may take of this machine, and how a user raises them.

Scenes, pictures, plans and the values of a frame may come from anybody. Code that reads or draws
them counts what that will take before it allocates anything, and calls ``check``. The commands that
draw have the option ``--budget``, which raises a limit for as long as the command runs; a program
that uses Burnish as a library writes ``with raised({"memory": 4 * 10**9}):``.

Limits hold for the whole process, as those of the operating system do. So nothing hands them on,
but for a command that starts processes which read files of the user: it gives them ``current``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass


class BudgetError(ValueError):
    """An amount is larger than its limit; the text says which, and how to raise the limit."""


@dataclass(frozen=True, slots=True)
class Limit:
    """One row: something that is counted."""

    name: str
    """The name of the limit for ``--budget``."""
    most: int
    """The amount that is allowed unless somebody raises it."""
    unit: str
    """The unit, as a message says it behind a number."""
    of: str
    """The thing that has that many, for the help and the manual."""

    @property
    def in_bytes(self) -> bool:
        """True if bytes are counted, of which there are kB, MB and GB."""
        return self.unit == "bytes"


LIMITS: Mapping[str, Limit] = {
    row.name: row
    for row in (
        Limit("memory", 10**9, "bytes", "what is drawn or computed at the same time"),
        Limit(
            "operations", 10**10, "operations",
            "what is computed without a sign of how far it is; for many pixels, each counts",
        ),
        Limit("document", 64 * 10**6, "bytes", "a plan, or the JSON of a scene"),
        Limit(
            "values", 3 * 10**6, "values",
            "a plan with its reflections, the JSON of a scene, or the tags of its nodes",
        ),
        Limit("steps", 4 * 10**6, "steps", "what a host computes and sets for one frame"),
        Limit("file", 256 * 10**6, "bytes", "a picture, a buffer, or another file that is read"),
        Limit("pixels", 2**25, "pixels", "a picture"),
        Limit("nodes", 10**5, "nodes", "a scene"),
        Limit("objects", 2**12, "objects", "a scene, with its cameras and lights"),
        Limit("vertices", 4 * 10**6, "vertices", "all objects of a scene together"),
        Limit("numbers", 2**26, "numbers", "the accessors of a scene, each time one is read"),
    )
}  # fmt: skip
"""All limits, by name."""

_SCALES: Mapping[str, int] = {"": 1, "k": 10**3, "M": 10**6, "G": 10**9}
"""The factor for a letter behind a number."""
_AMOUNT = re.compile(r"([0-9]{1,15})([kMG]?)")

_raised: dict[str, int] = {}
"""The limits that were raised, by name."""
_held: ContextVar[int] = ContextVar("held", default=0)
"""The memory in bytes that this thread has counted for objects that it still has."""


def allowed(name: str) -> int:
    """The amount that is allowed by the row called ``name``."""
    return _raised.get(name, LIMITS[name].most)


def current() -> dict[str, int]:
    """All limits that were raised, for a process that this one starts."""
    return dict(_raised)


def check(name: str, amount: int, what: str) -> None:
    """Raise ``BudgetError`` if an amount is more than is allowed.

    ``what`` begins the sentence and ends with its verb: "`chair.glb` has", "the frame needs".
    """
    most = allowed(name)
    if amount <= most:
        return
    row = LIMITS[name]
    raise BudgetError(
        f"{what} {amount_with_unit(amount, row)}, and the limit is {amount_with_unit(most, row)}: "
        f"`--budget {name}={rounded_up(amount)}` raises it"
    )


@contextmanager
def holding(amount: int, what: str) -> Iterator[None]:
    """Counts memory while the ``with`` block runs, on top of what this thread has.

    Raises as ``check`` does.
    """
    before = _held.get()
    check("memory", before + amount, what)
    token = _held.set(before + amount)
    try:
        yield
    finally:
        _held.reset(token)


@contextmanager
def raised(limits: Mapping[str, int]) -> Iterator[None]:
    """Have other limits inside the ``with`` block, for all threads of this process."""
    before = current()
    for name, amount in limits.items():
        _raised[LIMITS[name].name] = amount
    try:
        yield
    finally:
        _raised.clear()
        _raised.update(before)


class Tally:
    """The amount that something takes of one limit, piece by piece, such as mesh after mesh."""

    def __init__(self, name: str, what: str) -> None:
        """``name`` and ``what`` are those of ``check``."""
        self._name = name
        self._what = what
        self._total = 0

    def begin(self) -> None:
        """Forgets all amounts that were counted."""
        self._total = 0

    def add(self, amount: int, *, passing: int = 0) -> None:
        """Counts a piece before it is there, and the memory that is needed while it is made.

        Raises ``BudgetError`` if that is more than there may be.
        """
        self._total += amount
        check(self._name, self._total + passing, self._what)


def amount_of(text: str) -> int:
    """The number that ``--budget`` is given, such as ``4G``; raises ``ValueError``."""
    found = _AMOUNT.fullmatch(text)
    if not found:
        raise ValueError(f"'{text}' is no amount, which would be like 500k, 20M or 4G")
    return int(found[1]) * _SCALES[found[2]]


def rounded_up(amount: int) -> str:
    """An amount as ``amount_of`` takes it, with few digits and never less."""
    letter, scale = _largest_scale(amount // 10)
    return f"{-(-amount // scale)}{letter}"


def amount_with_unit(amount: int, row: Limit) -> str:
    """An amount with its unit, as people read it: "12.9 GB", "5,000,000 nodes"."""
    if not row.in_bytes:
        return f"{amount:,} {row.unit}"
    letter, scale = _largest_scale(amount)
    if not letter:
        return f"{amount} bytes"
    shown = amount / scale
    return f"{shown:,.0f} {letter}B" if shown >= 100 else f"{shown:.3g} {letter}B"


def _largest_scale(amount: int) -> tuple[str, int]:
    """The letter of the largest scale that is no more than an amount, and its factor."""
    found = "", 1
    for letter, scale in _SCALES.items():
        if scale <= amount:
            found = letter, scale
    return found
