"""The settings of a frame's step besides its shaders' inputs: areas, and values to clear to.

``with { viewport = …, clear.color = … }``: these are numbers that the host computes. ``steps.py``
makes ``Settings`` of the text behind ``with`` for each pass that a frame applies.
"""

from __future__ import annotations

from collections.abc import Mapping

from ....support.frozen import fresh, record
from ...diagnostics import rules
from ...diagnostics.source import Span
from ...ir import build
from ...ir.blending import OF_CONSTANT, REPLACES
from ...ir.frame import DEPTH
from ...ir.image_sizes import Sides, hidden, outside
from ...ir.node import Node
from ...ir.shader import RenderTarget, Shader
from ...ir.stages import TARGET
from ...ir.types import FLOAT, IVEC4, VEC4, Type
from ...syntax import ast
from ..checking.step_needs import BLEND_CONSTANT, SCISSOR, VIEWPORT
from ..checking.unknown_names import unknown
from ..declarations.fitting import typed
from ..names.duplicates import check_once
from ..shading.passes.formats import cleared_depth, cleared_value
from ..state.context import Context
from ..state.scope import Failure, Scope
from .inputs import Replacements
from .values import Numbers, on_host

AREAS: Mapping[str, tuple[Type, str]] = {
    VIEWPORT: (IVEC4, "ivec4 of left, top, width and height"),
    SCISSOR: (IVEC4, "ivec4 of left, top, width and height"),
    BLEND_CONSTANT: (VEC4, "vec4"),
}
"""The settings of a whole step, with their types."""
FLOATS = "32f"
"""The ending of the names of formats that not every device blends."""
CLEAR = "clear."
"""The prefix of the names of clear values."""


@record
class Settings:
    """The settings of one step."""

    ctx: Context
    numbers: Numbers
    written: Mapping[str, tuple[ast.Name, ast.Expression]]
    scope: Scope
    failed: bool = False
    """True if there is an error, which has been reported."""
    _known: dict[str, object] = fresh(factory=dict)
    """The values of settings of the whole step that are known when compiling."""
    _cleared: set[str] = fresh(factory=set)
    """The names of the clear values that belong to something."""

    @classmethod
    def parted(
        cls, ctx: Context, numbers: Numbers, given: Replacements, scope: Scope
    ) -> tuple[Settings, Replacements]:
        """The settings among the replacements behind ``with``, and all other ones."""
        own = [row for row in given if row[0].text in AREAS or row[0].text.startswith(CLEAR)]
        check_once(ctx.report, (name for name, _ in own))
        written = {name.text: (name, value) for name, value in own}
        return cls(ctx, numbers, written, scope), [row for row in given if row not in own]

    def number(self, name: str) -> int | None:
        """The number of the value of a setting of the whole step, if it is set."""
        if name not in self.written:
            return None
        _, value = self.written[name]
        node = typed(self.ctx, value, self.scope, *AREAS[name])
        if not isinstance(node, Failure):
            self._known[name] = self.ctx.constants.known(node)
        return self._numbered(node, value.span)

    def cleared(self, target: str, state: RenderTarget | float, over: Span | None) -> int | None:
        """The number of the clear value of a target, or of depths.

        It is that of the step or else of the pass, whose ``state`` this is; ``None`` for
        transparent black or a depth of 1. ``over`` is the span that says that the step draws over
        something.
        """
        name = f"{CLEAR}{target}"
        if name not in self.written:
            return self._usual(state) if over is None else None
        self._cleared.add(name)
        written, value = self.written[name]
        if over is not None:
            self.failed = True
            self.ctx.report.add(rules.NOT_CLEARED, written.span, name=target)
            return None
        node = (
            cleared_value(self.ctx, state.format, value, self.scope)
            if isinstance(state, RenderTarget)
            else cleared_depth(self.ctx, value, self.scope)
        )
        return self._numbered(node, value.span)

    def _usual(self, state: RenderTarget | float) -> int | None:
        """The clear value of the pass itself."""
        tree = self.ctx.tree
        if isinstance(state, RenderTarget):
            if state.clear is None:
                return None
            return self._numbered(build.constant(tree, VEC4, state.clear), None)
        return None if state == 1.0 else self._numbered(build.constant(tree, FLOAT, state), None)

    def _numbered(self, node: Node | Failure, span: Span | None) -> int | None:
        known = node if span is None else on_host(self.ctx, node, span)
        number = self.numbers.number(known)
        if isinstance(number, Failure):
            self.failed = True
            return None
        return number

    def check(self, shader: Shader, step: str, span: Span, sides: Sides | None) -> bool:
        """True if all settings of the step are right; errors are reported.

        ``sides`` are the width and height of its targets, if they are known.
        """
        self._check_blending(shader, step, span)
        self._check_areas(step, sides)
        known = [result.name for result in shader.results_of(TARGET)]
        for name, (written, _) in self.written.items():
            if name.startswith(CLEAR) and name not in self._cleared:
                self.failed = True
                found = name.removeprefix(CLEAR)
                unknown(self.ctx, "target", found, written.span, [*known, DEPTH])
        return not self.failed

    def _check_areas(self, step: str, sides: Sides | None) -> None:
        """Report a constant viewport outside of the targets, and a scissor without any of them."""
        for name, misfit in ((VIEWPORT, outside), (SCISSOR, hidden)):
            match self._known.get(name):
                case (int(left), int(top), int(width), int(height)):
                    if reason := misfit((left, top, width, height), sides):
                        self.failed = True
                        _, value = self.written[name]
                        self.ctx.report.add(
                            rules.AREA_OUTSIDE, value.span, area=name, step=step, reason=reason
                        )

    def _check_blending(self, shader: Shader, step: str, span: Span) -> None:
        """Reports targets that cannot be blended, or whose blend constant nobody has set.

        A blend constant that no target uses is reported, too.
        """
        states = [result.state for result in shader.results_of(TARGET) if result.state is not None]
        takes = any(not OF_CONSTANT.isdisjoint(state.blend.factors) for state in states)
        if BLEND_CONSTANT in self.written and not takes:
            self.failed = True
            written, _ = self.written[BLEND_CONSTANT]
            self.ctx.report.add(rules.BLEND_CONSTANT_UNUSED, written.span, step=step)
        for result in shader.results_of(TARGET):
            state, name = result.state, result.name
            if state is None or state.blend == REPLACES:
                continue
            by_constant = not OF_CONSTANT.isdisjoint(state.blend.factors)
            if by_constant and BLEND_CONSTANT not in self.written:
                self.failed = True
                self.ctx.report.add(rules.NO_BLEND_CONSTANT, span, step=step, target=name)
            if state.format.endswith(FLOATS):
                self.failed = True
                self.ctx.report.add(
                    rules.NOT_BLENDED, span, step=step, target=name, format=state.format
                )
