"""What a person can set in the page of ``burnish view``, and what is left out."""

from __future__ import annotations

from typing import Any

import pytest

import burnish
from burnish.targets.runner.frames.host import FrameHost, FrameSubject
from burnish.targets.runner.frames.single import single_frame, single_scenery
from burnish.targets.web_view.controls import controls

from ..frames.kit import FOLDER, compiled

LAMPS = """
import std.lights.{Directional, Point}
import std.terms.{lambert}

struct Grain { size : float, tint : rgb }

/// Clay
material Clay {
    param base  : rgb = #b5651d              /// Of the clay
    param clear : rgba = #ffffff80
    param bumps : float in 0..2 = 0.5
    param turn  : angle in 0..90deg = 45deg
    param along : direction<world> = direction<world>(0, 1, 0)
    param parts : int in 1..8 = 2
    param is_wet : bool = true
    param grain : Grain = Grain { size = 0.25, tint = #ffffff }
    param weights : float[3] = [0.5, 0.25, 0.125]
    param many  : float[64]
    param moved : vec2 = vec2(0.5, 0.25)
    param shown_with : mat2 = mat2(1, 0, 0, 1)
    param time per frame : float = 0
    param unread : float = 1
    map dirt : texture2d = white             /// On the clay

    color = lambert(base * clear.rgb * dirt(uv).r) * bumps * cos(turn) * dot(along, normal)
        * float(parts) * (is_wet ? 1.0 : 0.5) * grain.size * grain.tint * weights[1] * many[0]
        * (shown_with * moved).x * sin(time)
}

rig Studio { sun : Directional, lamps : Point[<= 2] }
"""


def rows_of(frame: FrameSubject, host: FrameHost | None = None) -> dict[str, dict[str, Any]]:
    return {row["name"]: dict(row) for row in controls(host or FrameHost(frame, _scenery(frame), (8, 8)))}


def _scenery(frame: FrameSubject) -> Any:
    from burnish.targets.runner.frames.scenery import in_a_row

    tags = {row["name"]: row["materials"] for row in frame.plan["models"]}
    materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
    return in_a_row(materials, tags, "sphere")
