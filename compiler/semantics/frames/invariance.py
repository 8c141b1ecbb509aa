"""Finds the shaders of a frame that have to place vertices alike.

Two steps that draw one model to the same depths have to compute the same numbers for it, to the
last bit: else a pass does not find again what another one has drawn, or is before and behind it in
turns. So they have invariant positions. If the depths are compared for being equal, everything has
them that is drawn there, as two materials may have one shape. A pass that says otherwise goes
without. ``frames.py`` calls this when all steps are known.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ....support.frozen import changed
from ...ir.frame import Drawn, FrameShader, RenderStep, Step, Use
from ...ir.shared_depths import SharedDepths, shared_depths

Made = dict[FrameShader, FrameShader]
"""Shaders with invariant positions, by the shaders that they replace."""


def with_invariant_positions(
    shaders: Sequence[FrameShader], steps: Sequence[Step]
) -> tuple[tuple[FrameShader, ...], tuple[Step, ...]]:
    """The shaders and steps of a frame, with invariant positions where these are needed."""
    needed = (use.shader for depths in shared_depths(steps) for use in _alike(depths))
    made: Made = {
        shader: _invariant(shader)
        for shader in dict.fromkeys(needed)
        if shader.shader.render_state.invariant is None
    }
    return (
        tuple(made.get(shader, shader) for shader in shaders),
        tuple(_with(made, step) for step in steps),
    )


def _alike(depths: SharedDepths) -> Iterator[Use]:
    """The uses of shaders that have to place vertices as others do."""
    uses = [use for step in depths.steps for use in step.uses]
    if any(use.shader.shader.render_state.is_invariant for use in uses):
        yield from uses
        return
    drawn_by: dict[str, set[FrameShader]] = {}
    for use in uses:
        drawn_by.setdefault(use.material, set()).add(use.shader)
    yield from (use for use in uses if use.material and len(drawn_by[use.material]) > 1)


def _invariant(shader: FrameShader) -> FrameShader:
    state = changed(shader.shader.render_state, invariant=True)
    return changed(shader, shader=changed(shader.shader, render_state=state))


def _with(made: Made, step: Step) -> Step:
    """A step with the shaders that were made."""
    if not isinstance(step, RenderStep):
        return step
    return changed(step, draws=tuple(_drawn_with(made, drawn) for drawn in step.draws))


def _drawn_with(made: Made, drawn: Drawn) -> Drawn:
    uses = (changed(use, shader=made.get(use.shader, use.shader)) for use in drawn.uses)
    return changed(drawn, uses=tuple(uses))
