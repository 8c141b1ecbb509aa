"""The scope of an expression in a random program: the names and abilities that it may use."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace

from .tree import Node, expression

SURFACE = "surface"
"""The slots of ``Surface`` are visible."""
LIT = "lit"
"""Terms that are summed over the lights may be called."""
FRAGMENT = "fragment"
"""The value is computed in the fragment stage."""
UNIFORM = "uniform"
"""Neighbouring pixels compute the value together, so that it may contain derivatives."""
GROUPS = "groups"
"""The value is computed by the work groups of a kernel over buffers."""
CROSSING = "crossing"
"""``@vertex`` may be written."""
LIGHT = "light"
"""The ability to use the current light."""

SPACES = "spaces"
"""The file declares the space ``bench``, and the material knows the way to it."""
TRANSFORMS = "transforms"
"""The file imports ``std.transforms``."""

ANYWHERE = frozenset[str]()
AT_VERTICES = frozenset({SURFACE, LIT, SPACES, TRANSFORMS})
IN_TERM = frozenset({SURFACE})
IN_MATERIAL = frozenset({SURFACE, LIT, FRAGMENT, UNIFORM, CROSSING})


@dataclass(frozen=True)
class Signature:
    """A function, a term or a structure that can be called."""

    name: str
    formals: tuple[str, ...]
    result: str
    needs: frozenset[str] = ANYWHERE
    names: tuple[str, ...] = ()
    """The names by which arguments may be given; empty if none may."""
    optional: int = 0
    """The number of the last arguments that may be left out."""


@dataclass(frozen=True)
class Map:
    """A texture that can be read."""

    name: str
    type: str


@dataclass(frozen=True)
class Scope:
    """The names and the abilities at one place."""

    leaves: tuple[Node, ...] = ()
    """References to variables: what has to be written, with its type."""
    callables: tuple[Signature, ...] = ()
    maps: tuple[Map, ...] = ()
    can: frozenset[str] = ANYWHERE

    def of(self, type_: str) -> list[Node]:
        """The variables of a type."""
        return [leaf for leaf in self.leaves if leaf.type == type_ and leaf.needs <= self._allowed]

    def arrays(self, element: str) -> list[Node]:
        """The variables that are arrays of a type."""
        allowed = self._allowed
        return [
            leaf for leaf in self.leaves
            if element_of(leaf.type) == element and leaf.needs <= allowed
        ]  # fmt: skip

    @property
    def _allowed(self) -> frozenset[str]:
        local = {need for leaf in self.leaves for need in leaf.needs if need.startswith("local ")}
        return self.can | local

    def having(self, *leaves: Node) -> Scope:
        """The scope with more variables."""
        return replace(self, leaves=(*self.leaves, *leaves))

    def turning(self, *leaves: Node) -> Scope:
        """The scope of a loop that some pixels may leave earlier than others."""
        return replace(self.having(*leaves), can=self.can - {UNIFORM})

    def at_vertices(self) -> Scope:
        """The scope of what stands behind ``@vertex``."""
        leaves = tuple(leaf for leaf in self.leaves if leaf.needs <= AT_VERTICES)
        return replace(self, leaves=leaves, can=self.can & AT_VERTICES)


def element_of(type_: str) -> str:
    """The type of an array's elements; empty for other types."""
    return type_[: type_.rindex("[")] if type_.endswith("]") else ""


def variable(name: str, type_: str, needs: Iterable[str] = (), role: str = "variable") -> Node:
    """A reference to what is declared outside of the expression."""
    return expression(type_, name, role=role, needs=needs, name=name)


def local(name: str, type_: str) -> Node:
    """A reference to what a loop, a function or a part behind ``where`` declares."""
    return variable(name, type_, {f"local {name}"}, "local")
