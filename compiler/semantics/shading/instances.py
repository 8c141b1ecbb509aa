"""Records with the leaves that their instances read."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...ir.node import Node
from ...ir.shader import AttributeInfo
from ...ir.types import Matrix
from ..declarations.overrides import check_overrides
from ..declarations.parameters import Leaves
from ..inheritance.records import Record
from ..names.modules import Symbol
from ..state.context import Context
from ..state.scope import Instance, Scope


def instance_of(ctx: Context, record: Record, leaves: Leaves) -> Instance:
    """A material or pass whose parameters, textures, buffers and vertex inputs are ``leaves``."""
    nodes: dict[str, Node] = {}
    for declared in leaves.parameters:
        short = declared.parameter.name.rpartition(".")[2]
        nodes[short] = ctx.tree.node("parameter", declared.parameter.type, (), declared.parameter)
    resources = {}
    for texture in leaves.resources:
        read = texture.resource
        short = read.name.rpartition(".")[2]
        resources[short] = ctx.tree.node("resource", read.type, (), read)
    for info in leaves.buffers:
        short = info.buffer.name.rpartition(".")[2]
        resources[short] = ctx.tree.node("buffer", info.buffer.type, (), info.buffer)
    inputs = dict(_vertex_inputs(ctx, leaves.attributes))
    instance = Instance(record, parameters=nodes, resources=resources, attributes=inputs)
    check_overrides(ctx, instance)
    return instance


def pass_scope(owner: Symbol, passing: Instance, level: int) -> Scope:
    """The scope of expressions in a member of a pass; ``owner`` is the record that declares it."""
    surface = passing.surface
    assert surface is not None
    return Scope(owner.module, passing, level, surface, {"material": surface})


def _vertex_inputs(ctx: Context, infos: Iterable[AttributeInfo]) -> Iterator[tuple[str, Node]]:
    """Yields the read of each declared vertex input; a matrix is put together from its columns."""
    columns: dict[str, list[Node]] = {}
    for info in infos:
        leaf = info.attribute
        node = ctx.tree.node("attribute", leaf.type, (), leaf)
        if info.matrix:
            columns.setdefault(info.matrix, []).append(node)
        else:
            yield leaf.name, node
    for name, nodes in columns.items():
        yield name, ctx.tree.node("matrix", Matrix(len(nodes)), tuple(nodes))
