"""Spells the names of Burnish in the manner of a host's language.

Names of materials, lights and parameters are a user's own: they may be words of the host's
language, differ in their capitals alone, or have letters that it does not take. Each comes out as a
name that is allowed and that no other has.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Callable, Iterable

Case = Callable[[list[str]], str]


def words(name: str) -> list[str]:
    """The words of a name, in small letters: ``torch.axis``, ``objectToWorld``."""
    return [word.lower() for part in re.split(r"[\W_]+", name) for word in _words(part)]


def _words(part: str) -> Iterable[str]:
    return re.findall(r"[A-Z]+(?![a-z])[0-9]*|[A-Z]?[^A-Z]+", part)


def snake(found: list[str]) -> str:
    """``torch_axis``."""
    return "_".join(found)


def camel(found: list[str]) -> str:
    """``torchAxis``."""
    return found[0] + pascal(found[1:]) if found else ""


def pascal(found: list[str]) -> str:
    """``TorchAxis``."""
    return "".join(word[:1].upper() + word[1:] for word in found)


def screaming(found: list[str]) -> str:
    """``TORCH_AXIS``."""
    return "_".join(found).upper()


def in_ascii(name: str) -> str:
    """The name in letters that every compiler takes: accents are left out, others are numbers."""
    plain = unicodedata.normalize("NFKD", name)
    found = (
        each if each.isascii() else "" if unicodedata.combining(each) else f"u{ord(each):x}"
        for each in plain
    )  # fmt: skip
    return "".join(found)


class Scope:
    """Names that stand side by side, each of which is given once."""

    def __init__(self, reserved: Iterable[str], *, only_ascii: bool, outer: Scope | None = None):
        """``reserved`` are the words that are no names; those of ``outer`` are not taken either."""
        self._reserved = frozenset(reserved)
        self._only_ascii = only_ascii
        self._outer = outer
        self._known: dict[tuple[str, str], str] = {}
        self._taken: set[str] = set()

    def name(self, kind: str, name: str, case: Case) -> str:
        """The spelling of a name; two things of one kind with the same name are the same thing."""
        key = kind, name
        if key not in self._known:
            plain = in_ascii(name) if self._only_ascii else unicodedata.normalize("NFC", name)
            self._known[key] = self._free(case(words(plain)) or "_")
            self._taken.add(self._known[key])
        return self._known[key]

    def _free(self, wish: str) -> str:
        if wish[0].isdigit():
            wish = f"_{wish}"
        if wish in self._reserved:
            wish = f"{wish}_"
        found, number = wish, 1
        while self._has(found):
            number += 1
            found = f"{wish}_{number}"
        return found

    def _has(self, name: str) -> bool:
        inside = name in self._taken or name in self._reserved
        return inside or (self._outer is not None and self._outer._has(name))
