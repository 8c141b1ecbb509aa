"""Leaves: nodes that are no graphs of others. A row says how nodes of a category are written."""

from __future__ import annotations

from types import MappingProxyType

from ..expressions import Expression
from ..model import Node
from ..networks import Network, Row
from ..places import Texts
from . import arithmetic, catalogue, channels, closures, geometry, procedural, textures

ROWS = MappingProxyType(
    arithmetic.ROWS
    | channels.ROWS
    | geometry.ROWS
    | textures.ROWS
    | procedural.ROWS
    | closures.ROWS
)


def network(texts: Texts, asked: Expression | None = None, outer: Network | None = None) -> Network:
    """A network of nodes whose leaves are those of these rows."""
    return Network(row_of, texts, asked, outer)


def row_of(node: Node) -> Row | None:
    """The row for a node; nothing if the node stands for a graph, or has no meaning here."""
    if node.category in closures.CLOSURE_ROWS and closures.is_closure(node.type):
        return closures.CLOSURE_ROWS[node.category]
    assert node.definition is not None
    if channels.gives_member(node.definition):
        return channels.member
    if node.category in ROWS and node.definition.is_library:
        return ROWS[node.category]
    if node.definition.is_library and catalogue.leaf_named(node.category, node.type):
        return catalogue.application
    return None
