"""What a pass asks of the pipeline, such as which faces are drawn.

``elaborate.py`` checks it for every pass, and gives it to the shader. Each setting is inherited by
itself: the nearest record that has it counts.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import cast, get_args

from ...ir.render_state import Cull, RenderState
from ...syntax import ast
from ..declarations.maps import unknown_word
from ..inheritance.records import Record
from ..names.duplicates import check_once
from ..state.context import Context

SETTINGS: Mapping[str, tuple[str, ...]] = {"cull": get_args(Cull)}
"""What can be said of which faces are drawn, each with its values."""


def render_state_of(drawn: Record) -> RenderState:
    """What a pass asks for; where it says nothing, or something wrong, the defaults hold."""
    said = {
        name.text: value.text
        for member, *_ in drawn.every(ast.Raster)
        for name, value in member.settings
        if value.text in SETTINGS.get(name.text, ())
    }
    return RenderState(cull=cast(Cull, said.get("cull", RenderState().cull)))


def check_render_state(ctx: Context, drawn: Record) -> None:
    """Report settings that stand twice in one place, and words that mean nothing there."""
    for member, *_ in drawn.every(ast.Raster):
        check_once(ctx.report, (name for name, _ in member.settings))
        for name, value in member.settings:
            if name.text not in SETTINGS:
                unknown_word(ctx, "raster setting", name, SETTINGS)
            elif value.text not in SETTINGS[name.text]:
                unknown_word(ctx, f"value for `{name.text}`", value, SETTINGS[name.text])
