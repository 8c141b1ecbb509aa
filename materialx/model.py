"""A document of MaterialX as records: nodes, their inputs, graphs, and definitions.

``reading`` makes them of what the package ``MaterialX`` has parsed; all that follows knows only
these records. Types, categories and values are the texts that documents have.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import cached_property


@dataclass(frozen=True)
class Link:
    """Where a value comes from: an output of a node, or one of a graph beside it."""

    node: str = ""
    graph: str = ""
    output: str = ""
    """Empty for the only output."""


@dataclass(frozen=True)
class Port:
    """An input or an output, of a node, a graph or a definition."""

    name: str
    type: str
    value: str | None = None
    link: Link | None = None
    interface: str = ""
    """The input of the surrounding graph whose value this one has, or nothing."""
    geometry: str = ""
    """The geometric property that an unconnected input of a definition has, such as ``Nworld``."""
    color_space: str = ""
    unit: str = ""
    unit_type: str = ""
    hints: Mapping[str, str] = field(default_factory=dict)
    """Attributes for people: ``doc``, to which the comment before the element is added,
    ``uiname``, ``uimin`` and so on, ``enum``."""


@dataclass(frozen=True)
class Node:
    """A node in a graph. ``definition`` is nothing where MaterialX knows of none that fits."""

    name: str
    category: str
    type: str
    path: str
    inputs: Mapping[str, Port]
    definition: Definition | None
    hints: Mapping[str, str] = field(default_factory=dict)
    inherit: str = ""
    """The node whose inputs this one takes over, or nothing."""

    def output(self, name: str) -> str:
        """The name of an output: the only one has none in links, and of several the first is meant
        by links that name none."""
        outputs = list(self.definition.outputs) if self.definition is not None else []
        return name or outputs[0] if len(outputs) > 1 else ""

    def output_type(self, name: str) -> str:
        """The type of an output, which the node states itself if it has only one."""
        output = self.output(name)
        if self.definition is None or not output:
            return self.type
        return self.definition.outputs[output].type


@dataclass(frozen=True)
class Graph:
    """Nodes between inputs and outputs: the document itself, one of its graphs, or what a
    definition means."""

    name: str
    path: str
    inputs: Mapping[str, Port]
    nodes: Mapping[str, Node]
    outputs: Mapping[str, Port]
    graphs: Mapping[str, Graph] = field(default_factory=dict)
    hints: Mapping[str, str] = field(default_factory=dict)


@dataclass(frozen=True)
class Structure:
    """A type of a document that has members, with their types and defaults."""

    name: str
    members: Mapping[str, Port]


@dataclass(frozen=True)
class Definition:
    """What a node of some category and types is: its inputs with their defaults, and its meaning.

    ``body`` gives the graph that the node stands for, or nothing for a leaf.
    """

    name: str
    category: str
    inputs: Mapping[str, Port]
    outputs: Mapping[str, Port]
    is_library: bool
    body: Callable[[], Graph | None]
    hints: Mapping[str, str] = field(default_factory=dict)
    source: str = ""
    """The expression that a leaf of a document gives for its value, such as ``{{in}}.ss``."""

    @cached_property
    def graph(self) -> Graph | None:
        return self.body()

    def __hash__(self) -> int:
        return hash(self.name)

    def __eq__(self, other: object) -> bool:
        # Names are unique, and a definition of the library is met from more than one document.
        return isinstance(other, Definition) and self.name == other.name


@dataclass(frozen=True)
class Document:
    """A whole document with its definitions."""

    name: str
    version: str
    top: Graph
    lines: Mapping[str, tuple[str, int]]
    """The file and the line of each named element, by its path."""
    structures: Mapping[str, Structure] = field(default_factory=dict)
    """The types that have members, by their names."""
    repeated: Mapping[str, tuple[str, int]] = field(default_factory=dict)
    """The same of elements whose names are taken, which MaterialX does not read."""
    comment: str = ""
    """The comment that stands before everything."""

    def place(self, path: str) -> str:
        """``FILE:LINE`` of an element, or of the nearest one around it."""
        while path and path not in self.lines:
            path = path.rpartition("/")[0]
        file, line = self.lines.get(path, (self.name, 1))
        return f"{file}:{line}"
