"""A leaf that tests draw in engines, by passes that blend it and by one that cuts it out."""

from __future__ import annotations

from .files import files_of

LEAF = """\
import std.models.{{GltfSurface}}
material Leaf : GltfSurface{tie} {{
    map picture : texture2d of rgb
    alpha = {alpha}
    {more}
}}
pass Cut : Forward {{
    {raster}
    discard when alpha < 0.5
}}
pass Added : Forward {{
    target color : rgba8_srgb = vec4(color, alpha) blend add
}}
pass Multiplied : Forward {{
    target color : rgba8_srgb = vec4(color, alpha) blend multiply
}}
pass Mixed : Forward {{
    target color : rgba8_srgb = vec4(color, alpha) blend alpha
}}
"""


def leaf(
    engine: str, *, by: str = "", alpha: str = "picture(uv).a", more: str = "", raster: str = ""
) -> str:
    """What an engine is given of a leaf."""
    tie = f" by {by}" if by else ""
    source = LEAF.format(tie=tie, alpha=alpha, more=more, raster=raster)
    return "\n".join(files_of(engine, source, "Leaf").values())
