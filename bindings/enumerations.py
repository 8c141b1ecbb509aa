"""The enumerations of a binding: types of the host that have the names of a parameter's choices.

Languages call ``Enumerations`` that have types for them. Two declarations may have one name in
different files; each gets a type of its own.
"""

from __future__ import annotations

from collections.abc import Iterator

from ..support.frozen import frozen
from .fields import Field, Structure
from .model import Binding


@frozen(kw_only=True)
class Enumeration:
    """An enumeration of the language, as fields have it."""

    name: str
    """Name in the binding, which nothing else has."""
    members: tuple[str, ...]
    """Names by their numbers, from 0."""


class Enumerations:
    """All enumerations that fields have."""

    def __init__(self, binding: Binding) -> None:
        self._found: dict[tuple[str, tuple[str, ...]], Enumeration] = {}
        taken = {each.name for each in binding.structures}
        taken |= {each.name for each in binding.blocks}
        for field in _fields(binding):
            key = _key(field)
            if field.choices and key not in self._found:
                name = next(each for each in _wishes(key[0]) if each not in taken)
                taken.add(name)
                self._found[key] = Enumeration(name=name, members=field.choices)

    @property
    def all(self) -> tuple[Enumeration, ...]:
        """Each once, in the order of the fields."""
        return tuple(self._found.values())

    def of(self, field: Field) -> Enumeration | None:
        """The enumeration of a field, or of its elements; ``None`` if it is a number."""
        return self._found.get(_key(field))


def _key(field: Field) -> tuple[str, tuple[str, ...]]:
    return field.meaning.partition("[")[0], field.choices


def _wishes(name: str) -> Iterator[str]:
    yield name
    yield from (f"{name}{number}" for number in range(2, 10_000))


def _fields(binding: Binding) -> Iterator[Field]:
    structures: list[Structure] = [*binding.structures]
    structures += [block.structure for block in binding.blocks]
    for structure in structures:
        yield from structure.fields
