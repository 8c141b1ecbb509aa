"""What a pass asks of the pipeline: which faces are drawn, and what the depth test does.

``elaborate.py`` checks it for every pass, and gives it to the shader. Each setting is inherited by
itself: the nearest record that has it counts.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import cast, get_args

from ...ir.render_state import Compare, Cull, DepthState, RenderState
from ...syntax import ast
from ..declarations.maps import unknown_word
from ..inheritance.records import Record
from ..names.duplicates import check_once
from ..state.context import Context

Stated = type[ast.Raster] | type[ast.Depth]

SETTINGS: Mapping[Stated, Mapping[str, tuple[str, ...]]] = {
    ast.Raster: {"cull": get_args(Cull)},
    ast.Depth: {"compare": get_args(Compare), "write": ("true", "false")},
}
"""What can be said in members of each kind, each with its values."""


def render_state_of(drawn: Record, cleared: float | None = None) -> RenderState:
    """What a pass asks for; where it says nothing, or something wrong, the defaults hold.

    ``cleared`` is what it wants depths to be at first (``clears.py``)."""
    raster, depth, usual = _said(drawn, ast.Raster), _said(drawn, ast.Depth), DepthState()
    return RenderState(
        cull=cast(Cull, raster.get("cull", RenderState().cull)),
        depth=DepthState(
            compare=cast(Compare, depth.get("compare", usual.compare)),
            write=depth["write"] == "true" if "write" in depth else usual.write,
            clear=usual.clear if cleared is None else cleared,
        ),
    )


def _said(drawn: Record, kind: Stated) -> dict[str, str]:
    """The settings in the members of one kind that mean something; the nearest record's count."""
    return {
        name.text: value.text
        for member, *_ in drawn.every(kind)
        for name, value in member.settings
        if value.text in SETTINGS[kind].get(name.text, ())
    }


def check_render_state(ctx: Context, drawn: Record) -> None:
    """Report settings that stand twice in one place, and words that mean nothing there."""
    for kind, known in SETTINGS.items():
        for member, *_ in drawn.every(kind):
            check_once(ctx.report, (name for name, _ in member.settings))
            for name, value in member.settings:
                if name.text not in known:
                    unknown_word(ctx, f"{ast.kind_of(member).word} setting", name, known)
                elif value.text not in known[name.text]:
                    unknown_word(ctx, f"value for `{name.text}`", value, known[name.text])
