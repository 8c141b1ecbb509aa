"""Digests by which hosts see that two layouts are the same."""

from __future__ import annotations


def layout_digest(*facts: object) -> str:
    """A digest of all that a layout says, as 16 hexadecimal digits."""
    return f"{_fnv_1a(repr(facts)):016x}"


def _fnv_1a(text: str) -> int:
    """A hash of 64 bits (Fowler, Noll and Vo, http://www.isthe.com/chongo/tech/comp/fnv).

    Python's better ones take several milliseconds to import.
    """
    found = 0xCBF29CE484222325
    for byte in text.encode():
        found = (found ^ byte) * 0x100000001B3 & 0xFFFFFFFFFFFFFFFF
    return found
