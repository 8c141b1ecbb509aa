"""Names of documents as names of Burnish."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable

from ..compiler.syntax.tokens import RESERVED
from ..stdlib.builtins import BUILTINS
from .expressions import Call, Expression

_AWKWARD = {
    "in": "x",
    "st": "texcoord",
    "material": "material_value",
    "light": "light_value",
}
"""Names of MaterialX's inputs that are words of Burnish's grammar, and what they are called."""


def identifier(text: str) -> str:
    """A name as close to ``text`` as Burnish has it: ASCII, in
    snake case if it was in camel case."""
    text = re.sub(r"(?<=[a-z0-9])(?=[A-Z])", "_", text)
    text = re.sub(r"[^A-Za-z0-9]+", "_", text).strip("_")
    text = re.sub(r"__+", "_", text) or "unnamed"
    if text[0].isdigit():
        text = f"n{text}"
    return text


def slot_name(text: str) -> str:
    """The name of a slot, a parameter, an argument or a part."""
    name = identifier(text).lower()
    return _AWKWARD.get(name, name)


def record_name(text: str) -> str:
    """The name of a material or a structure, which begins with a capital letter."""
    name = identifier(text)
    words = [word[:1].upper() + word[1:] for word in name.split("_") if word]
    return "".join(words)


def part_name(name: str, value: Expression) -> str:
    """The name of a part for a node called ``name``; it is not
    that of the function that it calls."""
    return f"{name}_value" if isinstance(value, Call) and value.name == name else name


class Names:
    """The names of one scope: hands out each only once."""

    def __init__(self, taken: Iterable[str] = (), functions: Iterable[str] = ()) -> None:
        self._functions = {name.lower() for name in functions} | _NEVER
        self._taken = {name.lower() for name in taken} | self._functions

    def fresh(self, wanted: str) -> str:
        """``wanted``, or the first of ``wanted_2``, ``wanted_3`` … that is free.

        Names that differ only by case count as one, since Burnish warns of them.
        """
        if wanted.lower() in self._taken:
            ending = "Material" if wanted[:1].isupper() else "_value"
            wanted = f"{wanted}{ending}" if wanted.lower() in self._functions else wanted
        name, number = wanted, 2
        while name.lower() in self._taken:
            name, number = f"{wanted}_{number}", number + 1
        self._taken.add(name.lower())
        return name

    def take(self, names: Collection[str]) -> None:
        """Keep names from being handed out."""
        self._taken.update(name.lower() for name in names)


_NEVER = frozenset(RESERVED) | set(BUILTINS) | {"pi", "light", "in"}
"""Names that would hide a builtin that expressions call, or that the grammar reads as words."""
