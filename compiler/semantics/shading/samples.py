"""Checks if a pass can have several samples for each pixel, which are joined at its end.

``elaborate.py`` asks for every pass, and once more when it is known what a material draws.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir.render_state import RenderState
from ...syntax import ast
from ..inheritance.records import Record
from ..state.context import Context
from ..state.scope import MadeSlots
from .render_states import render_state_of

UNRESOLVED = frozenset(("r32f", "rg32f", "rgba32f"))
"""The formats of which WebGPU makes no means of samples."""


def check_samples(ctx: Context, drawn: Record, state: RenderState) -> None:
    """Reports settings of a pass that need a single sample, if it asks for several."""
    if state.samples == 1:
        return
    for target, *_ in drawn.every(ast.Target):
        if target.format.text in UNRESOLVED:
            reason = f"`{target.name.text}` holds floats of 32 bits"
            _report(ctx, drawn, reason, target.format.span)
    for layers, *_ in drawn.every(ast.Layers):
        _report(ctx, drawn, "its targets have layers", layers.span)
    if state.fill == "lines":
        filled = [written.span for name, written in _settings(drawn) if name.text == "fill"]
        _report(ctx, drawn, "it draws lines", filled[0])


def check_samples_of_lines(ctx: Context, drawn: Record, step: MadeSlots) -> None:
    """Report that a step of the material makes lines, if the pass asks for several samples."""
    lines = None
    if step.expansion is not None and step.expansion.emits == "line":
        lines = step.expansion.span
    if step.tessellation is not None and step.tessellation.kind.drawn == "line":
        lines = step.tessellation.span
    if lines is not None and render_state_of(ctx, drawn).samples > 1:
        _report(ctx, drawn, "this draws lines", lines)


def _report(ctx: Context, drawn: Record, reason: str, span: Span) -> None:
    said = [written.span for name, written in _settings(drawn) if name.text == "samples"]
    ctx.report.add(
        rules.ONE_SAMPLE, said[0], name=drawn.name, reason=reason,
        labels=[Label(span, "goes with one sample only")],
    )  # fmt: skip


def _settings(drawn: Record) -> Iterator[tuple[ast.Name, ast.Expression]]:
    """The settings of a pass, those that count first."""
    for member, *_ in reversed(list(drawn.every(ast.Raster))):
        yield from member.settings
