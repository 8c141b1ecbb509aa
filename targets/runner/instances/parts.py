"""Parameters as attributes: ``instance.torch.axis``, ``instance.lamps[2].place``, ``rig.torch``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Any, Protocol

from ....compiler.diagnostics.nearest import suggestion
from .values import ParameterError


class Owner(Protocol):
    """The instance that parts are of: it holds all values, by their full names."""

    def get(self, name: str, /) -> Any:
        """The value of a parameter."""

    def set(self, name: str, value: object, /) -> None:
        """Set a parameter. Raises ``ParameterError``."""

    def _attribute(self, name: str, /) -> Any:
        """The value of a parameter, or the part that goes by a name."""


class Part:
    """A light, a structure or an array, whose parts can be read and set by their names."""

    __slots__ = ("_count", "_instance", "_name")

    def __init__(self, instance: Owner, name: str, count: int | None = None) -> None:
        object.__setattr__(self, "_instance", instance)
        object.__setattr__(self, "_name", name)
        object.__setattr__(self, "_count", count)

    def __getattr__(self, member: str) -> Any:
        """A member; for an array of lights, also its ``count``."""
        if member.startswith("_"):  # Copying asks for names before there are any attributes.
            raise AttributeError(member)
        return self._instance._attribute(f"{self._name}.{member}")

    def __setattr__(self, member: str, value: object) -> None:
        """Set a member. Raises ``ParameterError``."""
        self._instance.set(f"{self._name}.{member}", value)

    def __getitem__(self, position: int) -> Any:
        """An element of an array."""
        return self._instance._attribute(f"{self._name}[{position}]")

    def __setitem__(self, position: int, value: object) -> None:
        """Set an element. Raises ``ParameterError``."""
        self._instance.set(f"{self._name}[{position}]", value)

    def __len__(self) -> int:
        """The number of elements, including those that are not in use."""
        if self._count is None:
            raise TypeError(f"`{self._name}` is no array")
        length: int = self._count
        return length

    def __iter__(self) -> Iterator[Any]:
        """The elements."""
        return (self[position] for position in range(len(self)))

    def __repr__(self) -> str:
        """The name and the current value."""
        return f"<{self._name}: {self._instance.get(self._name)}>"


class Rig:
    """The lights of an instance, and all other parameters that are set per rig."""

    __slots__ = ("_instance", "_names")

    def __init__(self, instance: Owner, names: Mapping[str, str]) -> None:
        """``names`` are those of the attributes, with the names by which ``instance`` has them."""
        object.__setattr__(self, "_instance", instance)
        object.__setattr__(self, "_names", names)

    def __getattr__(self, name: str) -> Any:
        """A light, or the value of a parameter."""
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in self._names:
            raise AttributeError(self._unknown(name))
        return self._instance._attribute(self._names[name])

    def __setattr__(self, name: str, value: object) -> None:
        """Set a light or a parameter. Raises ``ParameterError``."""
        if name not in self._names:
            raise ParameterError(name, self._unknown(name))
        self._instance.set(self._names[name], value)

    def _unknown(self, name: str) -> str:
        hint = suggestion(name, self._names) or f"there are {', '.join(sorted(self._names))}"
        return f"the rig has no `{name}`: {hint}"
