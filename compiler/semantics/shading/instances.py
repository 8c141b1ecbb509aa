"""Records with the leaves that their instances read."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import chain

from ...ir import build
from ...ir.node import Node
from ...ir.shader import AttributeInfo, BufferInfo, ParameterInfo, TextureInfo
from ..declarations.overrides import check_overrides
from ..declarations.parameters import Leaves, of_kind
from ..inheritance.records import Record
from ..names.modules import Symbol
from ..state.context import Context
from ..state.scope import Instance, Scope


def instance_of(ctx: Context, record: Record, leaves: Leaves) -> Instance:
    """A material or pass whose parameters, textures, buffers and vertex inputs are ``leaves``."""
    instance = Instance(record, leaves=dict(_reads(ctx, leaves)))
    check_overrides(ctx, instance)
    return instance


def pass_scope(owner: Symbol, passing: Instance, level: int) -> Scope:
    """The scope of expressions in a member of a pass; ``owner`` is the record that declares it."""
    surface = passing.surface
    assert surface is not None
    return Scope(owner.module, passing, level, surface, {"material": surface})


_KINDS = (ParameterInfo, TextureInfo, BufferInfo, AttributeInfo)
"""The kinds of leaves in the order in which graphs show them."""


def _reads(ctx: Context, leaves: Leaves) -> Iterator[tuple[str, Node]]:
    """Yields the read of each leaf, by its own name; a matrix is put together from its columns."""
    columns: dict[str, list[Node]] = {}
    for info in chain.from_iterable(of_kind(kind, leaves) for kind in _KINDS):
        node = build.read(ctx.tree, info.leaf)
        if isinstance(info, AttributeInfo) and info.matrix:
            columns.setdefault(info.matrix, []).append(node)
        else:
            yield info.leaf.short_name, node
    for name, nodes in columns.items():
        yield name, build.matrix(ctx.tree, tuple(nodes))
