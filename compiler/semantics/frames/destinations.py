"""The destinations of passes: new images of a size, or results of others to draw over.

``steps.py`` asks for it, by the second argument of a pass.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping

from ....support.frozen import changed
from ...diagnostics import rules
from ...diagnostics.source import Span
from ...ir import build
from ...ir.frame import Size, StepTexture
from ...ir.image_sizes import halved, misfit
from ...ir.types import INT, IVEC2
from ...syntax import ast
from ..checking.step_needs import applied
from ..declarations.fitting import fit
from ..state.context import Context
from ..state.evaluation import node_of
from ..state.scope import OUTERMOST, Failure, Instance, Scope
from .step_context import StepContext
from .values import Made, Numbers, StepValue, no_result, on_host


class Destinations:
    """Finds the destinations of the passes of one frame."""

    def __init__(
        self,
        ctx: Context,
        frame: Instance,
        numbers: Numbers,
        made: Callable[[ast.Expression, StepContext], Made],
    ) -> None:
        """``made`` evaluates an expression about steps."""
        self._ctx = ctx
        self._frame = frame
        self._numbers = numbers
        self._made = made

    def of(self, e: ast.Call, around: StepContext) -> Mapping[str, StepTexture] | Size | None:
        """The destination of a pass: the size of new images, or results of others to draw over."""
        if len(e.arguments) == 1:
            return self._whole_size(e)
        written = e.arguments[1]
        parts = written.elements if isinstance(written, ast.Array) else (written,)
        if not all(self._is_step(part, around) for part in parts):
            return self._size(written, around.scope)
        found: dict[str, StepTexture] = {}
        for number, part in enumerate(parts):
            left = self._made(part, changed(around, name=f"{around.name}{number or ''}"))
            if isinstance(left, Failure):
                return None
            if isinstance(left, StepValue):
                images = {n: i for n, i in left.left.items() if isinstance(i, StepTexture)}
            elif isinstance(left, StepTexture):
                images = {left.target: left}
            else:
                no_result(self._ctx, left, part.span)
                return None
            for name in found.keys() & images.keys():
                reason = f"both are called `{name}`, and a pass draws over one of this name"
                self._differ(found[name], images[name], reason, part.span)
                return None
            found |= images
        first, *others = found.values()
        for other in others:
            if (other.dimension, other.layers) != (first.dimension, first.layers):
                self._differ(first, other, "they have different layers", written.span)
                return None
            one, two = (self.known_size(each.size, each.size.level) for each in (first, other))
            if one and two and one != two:
                reason = f"one is {one[0]} x {one[1]}, the other {two[0]} x {two[1]}"
                self._differ(first, other, reason, written.span)
                return None
        return found

    def check_size(self, image: StepTexture, span: Span) -> bool:
        """True if an image can have its size, as far as that is known; reported if not."""
        whole = self.known_size(image.size, 0)
        if whole is None:
            return True
        reason = misfit("2d", 1, *whole)
        if not reason:
            width, height = (halved(side, image.size.level) for side in whole)
            reason = misfit(image.dimension, image.levels, width, height)
        if reason:
            self._ctx.report.add(rules.NO_SUCH_SIZE, span, name=image.name, reason=reason)
        return not reason

    def known_size(self, size: Size, level: int) -> tuple[int, int] | None:
        """A size in a mip level, if it is known when compiling."""
        if size.value is None:
            return None
        match self._ctx.constants.known(self._numbers.nodes[size.value]):
            case (int(width), int(height)):
                return (halved(width, level), halved(height, level)) if level else (width, height)
        return None

    def _differ(self, first: StepTexture, second: StepTexture, reason: str, span: Span) -> None:
        """Report that two results cannot be drawn over at once."""
        self._ctx.report.add(
            rules.PLACES_DIFFER, span, first=first.name, second=second.name, reason=reason
        )

    def _is_step(self, e: ast.Expression, around: StepContext) -> bool:
        """True if an expression is about steps, and no number."""
        if applied(e, around.scope.module) is not None:
            return True
        while isinstance(e, ast.Field | ast.With):
            e = e.operand
        if isinstance(e, ast.Reference):
            named = (e.name, OUTERMOST)
            return e.name in around.states or around.owner.dependencies.is_step(named)
        return applied(e, around.scope.module) is not None

    def _whole_size(self, e: ast.Call) -> Size | None:
        """The size of the picture that the host shows: the frame's own ``size``."""
        reference = ast.Reference(e.span, "size")
        return self._size(reference, Scope(self._frame.record.root.module, self._frame))

    def _size(self, written: ast.Expression, scope: Scope) -> Size | None:
        node = node_of(self._ctx, written, scope)
        if isinstance(node, Failure):
            return None
        if node.type == INT:
            node = build.splat(self._ctx.tree, node, 2)
        fitted = fit(self._ctx, node, IVEC2, "ivec2", written.span)
        number = self._numbers.number(on_host(self._ctx, fitted, written.span))
        return None if isinstance(number, Failure) else Size(number)
