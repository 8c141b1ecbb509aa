"""Steps that are repeated: for layers, faces and mip levels, for lights, and one after the other.

``steps.py`` asks for the steps of ``each``, ``sum`` and ``iterate``.
"""

from __future__ import annotations

from collections.abc import Callable

from ....support.frozen import changed
from ...diagnostics import rules
from ...ir import build
from ...ir.frame import ImageDimension
from ...ir.types import INT
from ...syntax import ast
from ..declarations.fitting import fit
from ..state.context import Context
from ..state.evaluation import node_of
from ..state.scope import FAILURE, Failure
from .step_context import AttachmentPoint, StepContext
from .values import Made, no_step

FACES = 6
MOST_STEPS = 256
"""The largest number of steps of one repetition."""


class Repetitions:
    """Repeats steps of one frame."""

    def __init__(self, ctx: Context, made: Callable[[ast.Expression, StepContext], Made]) -> None:
        """``made`` evaluates an expression about steps."""
        self._ctx = ctx
        self._made = made

    def repeated(self, e: ast.Fold | ast.FoldOver, around: StepContext) -> Made:
        if isinstance(e, ast.Fold):
            turns = self._range(e.turns, around)
            return FAILURE if turns is None else self._layers(e, "2d_array", turns, around)
        over = e.over
        match over, e.operator:
            case ast.Reference(name="rig"), "sum":
                return self._made(e.body, changed(around, light=True))
            case ast.Reference(name="cube"), "each":
                return self._layers(e, "cube", range(FACES), around)
            case ast.Call(callee=ast.Reference(name="mips"), arguments=(most,)), "each":
                levels = self._integer(most, around)
                return FAILURE if levels is None else self._levels(e, levels, around)
        self._ctx.report.add(rules.NO_RANGE_OF_STEPS, over.span)
        return FAILURE

    def _layers(
        self,
        e: ast.Fold | ast.FoldOver,
        dimension: ImageDimension,
        turns: range,
        around: StepContext,
    ) -> Made:
        outer = around.place or AttachmentPoint()
        if outer.layers > 1:
            return no_step(self._ctx, e.span)
        variable = e.turns.variable if isinstance(e, ast.Fold) else e.variable
        made: Made = FAILURE
        for layer, turn in enumerate(turns):
            place = changed(
                outer, dimension=dimension, layers=len(turns), layer=layer,
                suffix=f"{outer.suffix}.{turn}",
            )  # fmt: skip
            made = self._turn(e.body, variable, turn, changed(around, place=place))
            if isinstance(made, Failure):
                return FAILURE
        return made

    def _levels(self, e: ast.FoldOver, levels: int, around: StepContext) -> Made:
        outer = around.place or AttachmentPoint()
        if outer.levels > 1:
            return no_step(self._ctx, e.span)
        made: Made = FAILURE
        for level in range(levels):
            place = changed(
                outer, levels=levels, level=level, suffix=f"{outer.suffix}.level{level}"
            )
            made = self._turn(e.body, e.variable, level, changed(around, place=place))
            if isinstance(made, Failure):
                return FAILURE
        return made

    def _turn(
        self, body: ast.Expression, variable: ast.Name, turn: int, around: StepContext
    ) -> Made:
        number = build.constant(self._ctx.tree, INT, turn)
        local = {**around.scope.locals, variable.text: number} if variable.text else {}
        scope = changed(around.scope, locals=local or around.scope.locals)
        return self._made(body, changed(around, scope=scope))

    def iterated(self, e: ast.Iterate, around: StepContext) -> Made:
        """``iterate s from first up to n : Step(screen) with { before = s.value }``."""
        turns = self._range(e.turns, around)
        if turns is None:
            return FAILURE
        if e.condition is not None:
            self._ctx.report.add(rules.NO_RANGE_OF_STEPS, e.condition.span)
            return FAILURE
        state = self._made(e.initial, changed(around, name=f"{around.name}.first"))
        for number, turn in enumerate(turns):
            if isinstance(state, Failure):
                return FAILURE
            last = number == len(turns) - 1
            name = around.name if last else f"{around.name}.{number}"
            states = {**around.states, e.state.text: state}
            inner = changed(around, states=states, name=name)
            state = self._turn(e.body, e.turns.variable, turn, inner)
        return state

    def _range(self, turns: ast.Turns, around: StepContext) -> range | None:
        start, end = self._integer(turns.start, around), self._integer(turns.end, around)
        if start is None or end is None:
            return None
        if not 0 < end - start <= MOST_STEPS:
            self._ctx.report.add(rules.NO_RANGE_OF_STEPS, turns.end.span)
            return None
        return range(start, end)

    def _integer(self, e: ast.Expression, around: StepContext) -> int | None:
        """A number that is known when compiling, 1 or more where it counts levels."""
        node = fit(self._ctx, node_of(self._ctx, e, around.scope), INT, "int", e.span)
        if isinstance(node, Failure):
            return None
        known = self._ctx.constants.known_integer(node)
        if known is None or known > MOST_STEPS:
            self._ctx.report.add(rules.NO_RANGE_OF_STEPS, e.span)
            return None
        return known
