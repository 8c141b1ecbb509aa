"""What networks of nodes and the places that they are written to know of each other."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from types import MappingProxyType
from typing import NamedTuple, Protocol

from .expressions import Expression
from .model import Definition, Graph, Node, Port


class Function(NamedTuple):
    """A definition as a function or a term of Burnish.

    ``inputs`` are the inputs of the definition that it takes, in its order, with the names of the
    arguments for them. ``sees_surface`` is true
    for a term, which reads slots of the surface and so cannot be called by functions.
    """

    name: str
    inputs: Mapping[str, str]
    sees_surface: bool
    is_closure: bool
    defaults: frozenset[str] = frozenset()
    """The inputs that may be left out."""
    members: Mapping[str, str] = MappingProxyType({})
    """The members of its structure by the names of the outputs; none if there is only one output.
    """


class StructureTypes(Protocol):
    """What networks ask of the types with members that a document has."""

    def has(self, kind: str) -> bool:
        """True for a type with members."""

    def value(self, text: str | None, kind: str) -> Expression:
        """The constant that a text means, or that a type has without one."""

    def member(self, value: Expression, kind: str, name: str) -> tuple[Expression, str]:
        """A member of a value, with its type."""


class Texts(Protocol):
    """What networks ask of the place that their expressions are written to."""

    def surface(self, slot: str) -> Expression:
        """A slot of the surface. Raises ``NeedsSurfaceError`` in a function."""

    def parameter(self, scope: Scope, port: Port) -> Expression:
        """The value of an input of a graph that a person may set."""

    @property
    def structures(self) -> StructureTypes:
        """The types with members that the document has."""

    def texture(self, port: Port, sampling: Sampling, node: Node) -> Expression | None:
        """The texture of the file that a node reads, or nothing if the input names none."""

    def tiles(self, file: str) -> tuple[int, ...]:
        """The squares of a chart for which a set of files has files; none for one file."""

    def read(self, texture: str, place: Expression) -> Expression:
        """The texel of a texture at a place."""

    def text(self, name: str) -> str:
        """The text that an argument of a function has. Raises ``NeedsTextsError``."""

    def function(self, definition: Definition) -> Function | None:
        """The function that a definition becomes, or nothing if it has to be written out."""

    def attribute(self, name: str, kind: str, doc: str) -> str:
        """An input of the vertices; gives its name."""

    def library(self, name: str) -> str:
        """A name of ``std.mtlx``, which is imported."""

    def part(self, name: str, value: Expression, node: Node) -> Expression:
        """Write a part down; gives the name by which it is used."""


@dataclass(frozen=True, eq=False)
class Scope:
    """A graph at one place of use.

    ``bound`` has its inputs as expressions where it is the body of a function or a model. ``node``
    is the node that it stands for in ``outer``, or nothing for a graph that only groups nodes.
    """

    graph: Graph
    outer: Scope | None = None
    node: Node | None = None
    bound: Mapping[str, Expression] | None = None


class Sampling(NamedTuple):
    """How a texture is read. ``is_encoded`` is true for colours in sRGB, which are decoded before
    filtering."""

    u: str
    v: str
    filter: str
    is_encoded: bool
    tiles: tuple[int, ...] = ()
    """The numbers of the squares of a chart that have files of their own; none for one file."""


class NeedsSurfaceError(Exception):
    """A function would have to read the surface."""


class NeedsTextsError(Exception):
    """A function would have to know texts, such as the name of a geometric property."""
