"""The numbers of elements of a kernel's buffers, and the values they can be computed from.

``kernels/kernel.py`` and ``scattering.py`` call these functions for each buffer or image.
"""

from __future__ import annotations

from collections.abc import Sequence

from ....diagnostics import rules
from ....diagnostics.source import Span
from ....ir.host import KNOWN_IN_TREES
from ....ir.kernel import WRITTEN_GROUP
from ....ir.leaves import Buffer
from ....ir.node import Node, bare, reachable
from ....ir.operations import CROSS, joins_group
from ....ir.shader import BufferInfo, count_info
from ....ir.types import INT, RuntimeArray, Type
from ....syntax import ast
from ...declarations.buffers import element_info
from ...declarations.fitting import typed
from ...state.context import Context
from ...state.crossings import missing_in_kernels
from ...state.scope import Failure, Scope
from ...types.typenames import Declared
from .images import reads_only_sizes

_LOOPS = frozenset({"apply", "bound", "fold"})
_KNOWN_TO_HOST = KNOWN_IN_TREES - _LOOPS
"""Operations by which a host computes how many elements a result has, or of which size it is."""

ELEMENTS = "number of elements"
"""The name of an extent in messages, if it is not that of an image."""


def declared_extent(
    ctx: Context,
    name: str,
    declared: ast.TypeName,
    scope: Scope,
    type_: Type = INT,
    what: str = ELEMENTS,
) -> Node | None:
    """The extent in brackets behind a type; ``None`` after reporting an error."""
    if declared.count is None:
        ctx.report.add(rules.NO_EXTENT, declared.span, name=name, what=what)
        return None
    return known_extent(ctx, name, declared.count, scope, type_, what)


def known_extent(
    ctx: Context,
    name: str,
    written: ast.Expression,
    scope: Scope,
    type_: Type = INT,
    what: str = ELEMENTS,
) -> Node | None:
    """The number of elements: the same all over a dispatch, and known to the host."""
    node = typed(ctx, written, scope, type_, str(type_))
    if isinstance(node, Failure):
        return None
    if not all(_is_known_to_host(part) for part in reachable((node,))):
        ctx.report.add(rules.EXTENT_VARIES, written.span, name=name, what=what)
        return None
    for side in _sides(node):
        if (found := ctx.ranges.of(side)).hi < 1:
            ctx.report.add(
                rules.NEVER_POSITIVE, written.span, name=name, what=what, found=found.in_words()
            )
            return None
    return node


def _sides(extent: Node) -> Sequence[Node]:
    """The width and the height of an image, if they are written one by one.

    If they are not, the extent itself.
    """
    known = bare(extent)
    return known.operands if known.op == "vector" else (extent,)


def _is_known_to_host(node: Node) -> bool:
    return node.op in _KNOWN_TO_HOST and reads_only_sizes(node) and not joins_group(node)


def exists_in_kernels(ctx: Context, value: Node, written: Span) -> bool:
    """True if a kernel has all that a value is computed from; reported if not."""
    missing = missing_in_kernels(value)
    if missing is not None:
        span = ctx.places.within(missing, written)
        what = f"@{CROSS.data(missing).origin}" if missing.op == "cross" else missing.data
        ctx.report.add(rules.NOT_IN_KERNEL, span, what=f"`{what}`")
    return missing is None


def written_buffer(name: ast.Name, doc: str, element: Declared) -> BufferInfo:
    """The storage buffer that a member of a kernel declares, which the kernel writes."""
    buffer = Buffer(name.text, RuntimeArray(element.type), WRITTEN_GROUP, fact=element.fact)
    described, count = element_info(element, name.span), count_info(buffer, name.span)
    return BufferInfo(buffer, f"{element.text}[]", doc, name.span, described, count)
