"""A material with a parameter of every kind, and helpers to set its instances."""

from __future__ import annotations

from typing import Any

import numpy as np

import burnish
from burnish import Instance

EVERYTHING = """
import std.lights.{Point, Spot}
import std.terms.{lambert}

struct Cone { width : float  soft : bool }
struct Layer { tint : vec3  cone : Cone  weights : float[3] }

material All {
    param power  : float in 1..512 = 48               /// Specular exponent
    param base   : rgb = #b5651d
    param veil   : rgba = #00000080
    param tilt   : angle = 30deg
    param offset : ivec2 in -3..3 = ivec2(0)
    param tag    : uint in 0..7 = 3u
    param big    : uint = 0u
    param steps  : int = 0
    param shiny  : bool = true
    param mask   : bvec2 = bvec2(true, false)
    param turn   : mat2                               /// Turns the texture
    param bones  : mat3[2]
    param ways   : direction<world>[2]
    param layer  : Layer
    param values : float = 2
    param wind   : direction<world> = vec3(1, 0, 0)
    param floor  : normal<world> = vec3(0, 1, 0)
    map   albedo : texture2d = gray

    color = lambert(base) * power * cos(tilt) + veil.rgb * layer.tint * layer.weights[1]
          + vec3(turn * uv, values) + bones[1] * ways[0] * wind.x * floor.y
          + (if shiny and layer.cone.soft and mask.x then vec3(float(offset.x)) else albedo(uv).rgb)
          + vec3(float(big), float(steps) + float(tag), layer.cone.width)
}

rig Stage {
    lamps : Point[<= 3]
    torch : Spot
    pair  : Point[2]
}
"""
REFLECTION = burnish.compile(EVERYTHING, ("wgsl",))["All"].reflection


def complete(instance: Instance) -> Instance:
    """The instance with a value for everything that has no default."""
    instance.set("turn", ((1, 0), (0, 1)))
    instance.set("bones", [np.eye(3), np.eye(3)])
    instance.set("ways", [(1, 0, 0), (0, 1, 0)])
    cone = {"width": 0.25, "soft": False}
    instance.set("layer", {"tint": (1, 2, 3), "cone": cone, "weights": (4, 5, 6)})
    instance.set("torch.place", (0, 0, 1))
    instance.set("pair", [{"place": (0, 0, 2)}, {"place": (0, 0, 3)}])
    return instance


def state(instance: Instance) -> dict[str, Any]:
    return {row.name: instance.get(row.name) for row in REFLECTION.parameters}


def at(name: str) -> tuple[str, int]:
    """Block and offset of a parameter."""
    (row,) = (row for row in REFLECTION.parameters if row.name == name)
    assert row.block is not None and row.offset is not None
    return row.block, row.offset
