"""Records with the leaves that their instances read."""

from __future__ import annotations

from typing import TYPE_CHECKING

from ..ir.node import Node
from .overrides import check_overrides
from .parameters import Leaves
from .records import Record
from .scope import Instance

if TYPE_CHECKING:
    from .lower import Lowering


def instance_of(low: Lowering, record: Record, leaves: Leaves) -> Instance:
    """A material or pass whose parameters, textures and vertex inputs are ``leaves``."""
    nodes: dict[str, Node] = {}
    for info in leaves.parameters:
        short = info.parameter.name.rpartition(".")[2]
        nodes[short] = low.graph.node("parameter", info.parameter.type, (), info.parameter)
    for attribute in leaves.attributes:
        leaf = attribute.attribute
        nodes[leaf.name] = low.graph.node("attribute", leaf.type, (), leaf)
    resources = {}
    for texture in leaves.resources:
        read = texture.resource
        short = read.name.rpartition(".")[2]
        resources[short] = low.graph.node("resource", read.type, (), read)
    instance = Instance(record, parameters=nodes, resources=resources)
    check_overrides(low, instance)
    return instance
