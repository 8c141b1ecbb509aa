"""Puts a material on a floor that its shadow falls on, for ``--floor``: a frame around its file.

``render`` and ``view`` compile the file with the frame behind it, and then draw it as any other
frame, with a model of the material and one of the floor.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ..api.entry_points import CompiledFrame

Color = tuple[float, float, float, float]

STANDING = "standing"
"""The name that the frame has for the material's models."""
ROOM = 1.7
"""The part of the scene that its camera sees, as a multiple of what the model fills: the shadow has
its place there."""

_SOURCE = """

import std.frames.{{seen_from}}
import std.shadows.{{DepthOnly, share_lit}}

/// A matt floor in the light of one lamp above, and of a studio that the shadow leaves.
material Floor_ {{
    map shadow : depth2d
    param from_lamp : transform<world, clip>
    color = vec3(0.2) * mix(0.25, 1, share_lit(shadow, from_lamp, position, 0.004, 2))
}}

pass Standing_ : Forward {{
    raster {{ samples = {samples} }}
    clear {{ color = vec4({background}) }}
    target color : rgba16f = vec4(color, alpha)
}}

frame {material}_on_floor {{
    models {standing} : {material}
    models floor    : Floor_
    lamp      : point<world>           = vec3(-3, 6, 3)
    from_lamp : transform<world, clip> = seen_from(lamp, vec3(0) - lamp, 30deg, 1, 20)

    seen  = DepthOnly({standing}, 512) with {{ view_projection = from_lamp, eye = lamp }}
    lit   = Standing_({standing})
    drawn = Standing_(floor, lit) with {{ shadow = seen.depth, from_lamp = from_lamp }}
    output color = drawn.color
}}
"""


def standing(
    file: Path,
    material: str,
    rig: str | None,
    profiles: Sequence[str],
    *,
    background: Color,
    samples: int,
    search_path: Sequence[Path],
    hoist: bool,
) -> CompiledFrame:
    """The frame that shows a material of a file on a floor.

    The file has been compiled before: its own mistakes and warnings are told then. Raises
    ``PlanError`` where the file declares a name that the frame needs, such as ``DepthOnly``, or has
    a block of the host for the camera.
    """
    from ..api import entry_points as api
    from ..compiler.diagnostics.diagnostic import CompileError
    from ..targets.runner.frames.checking import PlanError

    written = ", ".join(map(repr, background))
    frame = _SOURCE.format(
        material=material, standing=STANDING, samples=samples, background=written
    )
    try:
        result = api.compile(
            file.read_text("utf-8") + frame, profiles, material=f"{material}_on_floor", rig=rig,
            search_path=(file.parent, *search_path), hoist=hoist, keep_graphs=True,
        )  # fmt: skip
    except CompileError as error:
        raise PlanError(
            f"{material} cannot stand on a floor, whose frame does not fit its file: "
            f"{error.diagnostics[0].message}"
        ) from error
    return result.frames[0]
