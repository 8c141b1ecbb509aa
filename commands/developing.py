"""Develops pictures: what a screen shows of their light, by an exposure and a tone mapping.

One frame of a single step does it, in the language and by the library's own curves.
``burnish render`` has the reference draw it, and ``burnish view`` sends it to its page as a
package, so that both show the same.
"""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from ..targets.runner.pictures import cut_off
from .options import TONES

if TYPE_CHECKING:
    from ..targets.runner.frames.host import FrameHost
    from ..targets.web_host.serving.packages import Package

Floats = NDArray[np.float64]

LIGHT, STOPS, TONE = "light", "stops", "tone"
"""The names of the frame's texture, and of its parameters."""
_NONE, *_CURVES = TONES
_CURVES_OF_LIGHT = ", ".join(f"{curve}(exposed)" for curve in _CURVES)
_SOURCE = f"""
import std.color.{{exposure}}
import std.frames.{{FullScreen}}
import std.tone_mapping.{{{", ".join(_CURVES)}}}

pass Developed : FullScreen {{
    map light : texture2d of rgb
    param stops : float = 0
    param tone  : int in 0..{len(_CURVES)} = 0

    exposed = exposure(light.load(ivec2(vec2(light.size()) * uv)).rgb, stops)
    target color : rgba8_srgb = vec4([saturate(exposed), {_CURVES_OF_LIGHT}][tone], 1)
}}

frame Development {{
    map light : texture2d of rgb
    param stops : float = 0
    param tone  : int in 0..{len(_CURVES)} = 0
    developed = Developed(screen, light.size()) with {{ light = light, stops = stops, tone = tone }}
    output picture = developed.color
}}
"""
"""The frame: texel by texel, so that neither filters nor the order of rows change anything."""
_MOST_TEXELS = 1 << 20
"""The texels that are developed at once, so that a large picture needs no more memory."""
_BRIGHTEST = float(np.finfo(np.float32).max)


class Development(NamedTuple):
    """The way from light to what a screen shows."""

    stops: float = 0.0
    """The exposure: each stop doubles the light."""
    tone: str = _NONE
    """One of ``TONES``."""

    def applied(self, light: Floats) -> Floats:
        """What a screen shows of light, (height, width, 3), before it is encoded: from 0 to 1."""
        if self == Development():
            return cut_off(light)
        rows = max(_MOST_TEXELS // light.shape[1], 1)
        parts = [light[top : top + rows] for top in range(0, light.shape[0], rows)]
        return np.concatenate([self._developed(part) for part in parts])

    def _developed(self, light: Floats) -> Floats:
        from ..targets.runner.frames.by_reference import ReferenceFrames
        from ..targets.runner.textures.texture import Texture

        host = _host(())
        bounded = np.clip(light, 0.0, _BRIGHTEST).astype(np.float32)
        host.set(LIGHT, Texture.of_array(bounded))
        host.set(STOPS, self.stops)
        host.set(TONE, TONES.index(self.tone))
        drawing = ReferenceFrames(host)
        drawing.draw()
        picture: Floats = drawing.output("picture").levels[0][0][0]
        return picture[..., :3]


@cache
def development_package(profile: str) -> Package:
    """The package of the frame for a page that draws by the texts of a profile.

    The page gives it its texture, and sets its parameters.
    """
    from ..targets.runner.textures.texture import Texture
    from ..targets.web_host.package import frame_package

    host = _host((profile,))
    host.set(LIGHT, Texture.solid("#000000"))
    return frame_package(host, (profile,))


def _host(profiles: tuple[str, ...]) -> FrameHost:
    """The frame, without values."""
    from ..targets.runner.frames.host import FrameHost
    from ..targets.runner.frames.scenery import Scenery

    return FrameHost(_compiled(profiles), Scenery(()), (1, 1))


@cache
def _compiled(profiles: tuple[str, ...]) -> Any:
    from ..api import entry_points as api

    (frame,) = api.compile(_SOURCE, profiles, keep_graphs=True).frames
    return frame
