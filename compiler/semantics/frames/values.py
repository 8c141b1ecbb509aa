"""The results of a frame's steps, while they are put together, and the numbers they are given."""

from __future__ import annotations

from collections.abc import Mapping

from ....support.frozen import fresh, frozen, record
from ...diagnostics import rules
from ...diagnostics.source import Span
from ...ir.frame import Elements, FromHost, Previous, StepTexture
from ...ir.host import KNOWN_IN_TREES
from ...ir.node import Node, reachable
from ..shading.kernels.images import reads_only_sizes
from ..state.context import Context
from ..state.scope import FAILURE, Failure

_CALLED: Mapping[str, str] = {"iterate": "`iterate`", "struct": "a structure"}
"""The names in messages of operations that a host lacks.

Other operations read texels or belong to a stage.
"""


@frozen(eq=False)
class StepValue:
    """The results of a step, by name: images, and the buffers of a kernel."""

    name: str
    left: Mapping[str, StepTexture | Elements]


Made = StepValue | StepTexture | Elements | Previous | FromHost | Failure
"""The value of an expression about steps."""


@record
class Numbers:
    """The numbers that the host computes for a frame; the plan refers to them by their places."""

    nodes: list[Node] = fresh(factory=list)

    def number(self, node: Node | Failure) -> int | Failure:
        """The place of a value among them."""
        if isinstance(node, Failure):
            return FAILURE
        self.nodes.append(node)
        return len(self.nodes) - 1


def on_host(ctx: Context, node: Node | Failure, written: Span) -> Node | Failure:
    """``node``, if a host can compute it; reported if not."""
    if isinstance(node, Failure):
        return node
    for part in reachable((node,)):
        if part.op not in KNOWN_IN_TREES or not reads_only_sizes(part):
            span, what = ctx.places.within(part, written), _CALLED.get(part.op, "this")
            ctx.report.add(rules.NOT_ON_HOST, span, what=what)
            return FAILURE
    return node


def no_step(ctx: Context, span: Span) -> Failure:
    """Report an expression that is no step."""
    ctx.report.add(rules.NO_STEP, span)
    return FAILURE


def no_result(ctx: Context, found: Made, span: Span, what: str = "result of a step") -> Failure:
    """Reports that something is not a result of a step, unless more has been said about it.

    Of a whole step, it says which results there are.
    """
    hint = ""
    if isinstance(found, StepValue):
        hint = f"a step leaves its results: {', '.join(f'`.{name}`' for name in found.left)}"
    if not isinstance(found, Failure):
        ctx.report.add(rules.NOT_LEFT, span, what=what, hint=hint)
    return FAILURE
