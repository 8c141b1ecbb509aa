"""The values that a person can set in the page of ``burnish view``, and those that are left out."""

from __future__ import annotations

import math

import pytest

import burnish
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row
from burnish.targets.runner.frames.single import single_frame, single_scenery
from burnish.targets.web_view.controls import controls

from ..frames.kit import FOLDER, compiled

CLAY = """
import std.lights.{Directional, Point}
import std.terms.{lambert}

enum Mode { add, mix, cover }
struct Grain { size : float, tint : rgb }

/// Clay
material Clay {
    param base    : rgb = #b5651d            /// Of the clay
    param clear   : rgba = #ffffff80
    param bumps   : float in 0..2 = 0.5
    param turn    : angle in 0deg..90deg = 45deg
    param along   : direction<world> = direction(0, 1, 0)
    param parts   : int in 1..8 = 2
    param is_wet  : bool = true
    param mode    : Mode = Mode.mix
    param grain   : Grain = Grain(0.25, #ffffff)
    param weights : float[3] = [0.5, 0.25, 0.125]
    param many    : float[64]
    param moved   : vec2 = vec2(0.5, 0.25)
    param frame   : mat2 = mat2(vec2(1, 0), vec2(0, 1))
    param time    : float per frame = 0
    map dirt : texture2d = white             /// On the clay

    scale = float(parts) * bumps * cos(turn) * grain.size * weights[1] * many[0] * sin(time)
    tint  = base * clear.rgb * dirt(uv).rgb * grain.tint
    color = lambert(tint) * scale * (frame * moved).x * (if is_wet then along.y else 0.5)
    alpha = if mode == Mode.mix then 1 else 0.5
}

rig Studio { sun : Directional, lamps : Point[<= 2] }
"""


def test_a_material() -> None:
    (material,) = burnish.compile(CLAY, ("wgsl",)).materials
    frame = single_frame(material)
    host = FrameHost(frame, single_scenery(frame, "sphere", 1), (8, 8))
    host.set_text("bumps", "1.5")
    host.set_text("mode", "cover")
    rows = {row["name"]: row for row in controls(host)}
    own = {name: (row["kind"], row["value"]) for name, row in rows.items() if not row["is_light"]}
    base = own.pop("base")
    assert (base[0], base[1]) == ("color", pytest.approx((0.46208, 0.13014, 0.01229), abs=1e-5))
    assert own == {
        "clear": ("color", (1.0, 1.0, 1.0, pytest.approx(128 / 255))),
        "bumps": ("number", 1.5),
        "turn": ("angle", pytest.approx(math.pi / 4)),
        "along": ("direction", (0.0, 1.0, 0.0)),
        "parts": ("number", 2),
        "is_wet": ("checkbox", True),
        "mode": ("member", 2),
        "grain.size": ("number", 0.25),
        "grain.tint": ("color", (1.0, 1.0, 1.0)),
        "weights[0]": ("number", 0.5),
        "weights[1]": ("number", 0.25),
        "weights[2]": ("number", 0.125),
        "moved": ("vector", (0.5, 0.25)),
        "frame": ("matrix", ((1.0, 0.0), (0.0, 1.0))),
        "time": ("number", 0.0),
        "dirt": ("texture", "white"),
    }
    assert (rows["bumps"]["range"], rows["parts"]["whole"]) == ((0.0, 2.0), True)
    assert [name for name, row in rows.items() if row.get("is_timed")] == ["time"]
    assert rows["mode"]["choices"] == ("add", "mix", "cover")
    assert rows["dirt"]["intent"] == "color"
    assert (rows["base"]["doc"], rows["dirt"]["doc"]) == ("Of the clay", "On the clay")
    assert rows["base"]["section"] == "Clay"


def test_lights_come_last_and_arrays_say_how_many_shine() -> None:
    (material,) = burnish.compile(CLAY, ("wgsl",)).materials
    frame = single_frame(material)
    found = controls(FrameHost(frame, single_scenery(frame, "sphere", 1), (8, 8)))
    lights = [row for row in found if row["is_light"]]
    assert found[-len(lights) :] == lights
    assert [(row["name"], row["section"]) for row in lights] == [
        ("sun.diffuse_color", "sun"),
        ("sun.direction", "sun"),
        ("lamps.count", "lamps"),
        ("lamps[0].diffuse_color", "lamps"),
        ("lamps[0].place", "lamps"),
        ("lamps[1].diffuse_color", "lamps"),
        ("lamps[1].place", "lamps"),
    ]
    last = lights[-1]
    assert last["element"] == {"count": "lamps.count", "index": 1}
    assert lights[0]["element"] is None


def test_a_frame_sets_some_of_its_passes() -> None:
    frame = compiled(FOLDER / "deferred.burnish")
    host = FrameHost(frame, in_a_row(["Clay", "Jade"], {}, "sphere"), (8, 8))
    found = [(row["name"], row["section"]) for row in controls(host) if not row["is_light"]]
    # Both materials have a `base`; what the passes read of each other is none of the person's.
    assert found == [
        ("exposure", "Deferred"), ("Clay.base", "Clay"), ("Jade.base", "Jade"),
    ]  # fmt: skip
    host.set("Jade.base", (0, 0, 0))
    values = {row["name"]: row["value"] for row in controls(host)}
    assert values["Jade.base"] == (0, 0, 0) != values["Clay.base"]


INHERITING = """
abstract material Glazed {
    param gloss : float in 0..1 = 0.5
    param tint  : rgb = #ffffff
    map   dirt  : texture2d of rgb = white
    color = base * gloss * tint * dirt(uv).rgb
    base  : rgb
}

material Tile : Glazed {
    param glaze : rgb = #336699
    param tint  : rgb = #ff0000
    base = glaze
}
"""


def test_what_a_material_inherits_is_told_from_its_own() -> None:
    (material,) = burnish.compile(INHERITING, ("wgsl",)).materials
    of = material.reflection
    declared = {row.name: row.declared_by for row in of.parameters}
    declared |= {row.name: row.declared_by for row in of.textures}
    assert [declared[name] for name in ("glaze", "tint", "gloss", "dirt", "eye")] == [
        "Tile", "Tile", "Glazed", "Glazed", "Surface",
    ]  # fmt: skip
    frame = single_frame(material)
    found = controls(FrameHost(frame, single_scenery(frame, "sphere", 1), (8, 8)))
    own = [row for row in found if not row["is_light"]]
    assert {row["name"]: row["inherited_from"] for row in own} == {
        "glaze": None, "tint": None, "gloss": "Glazed", "dirt": "Glazed",
    }  # fmt: skip


UNREAD = """
import std.lights.{Point}
import std.terms.{ambient, lambert}

struct Grain { size : float, tint : rgb, turns : float }

material Clay {
    param base   : rgb = #b5651d
    param unread : float = 1
    param unset  : float
    param grain  : Grain = Grain(0.25, #ffffff, 1)
    param steps  : float = 2
    color = lambert(base) * grain.size * fract(grain.turns) * fract(sqrt(steps))
}

rig Studio { torch : Point, lamps : Point[<= 1] }
"""


def test_what_nothing_reads_is_not_shown() -> None:
    """But a value that hosts have to set, since it has no default."""
    (material,) = burnish.compile(UNREAD, ("wgsl",)).materials
    frame = single_frame(material)
    found = controls(FrameHost(frame, single_scenery(frame, "sphere", 1), (8, 8)))
    assert [row["name"] for row in found] == [
        "base", "unset", "grain.size", "grain.turns", "steps", "torch.diffuse_color", "torch.place",
        "lamps.count", "lamps[0].diffuse_color", "lamps[0].place",
    ]  # fmt: skip
    read = {row.name: row.read for row in material.reflection.parameters}
    assert (read["base"], read["unread"], read["steps"]) == (None, (), None)
    assert read["grain"] == ("grain.size", "grain.turns")


PASSES = """
import std.frames.{FullScreen}
import std.lights.{Point}
import std.terms.{lambert}

material Clay { color = lambert(vec3(0.5)) }
pass Lit : Forward { target color : rgba16f = vec4(color, 1) }
pass Toned : FullScreen {
    map source : texture2d
    param gain : float = 1
    target color : rgba8 = source(uv) * gain
}
frame Shown {
    param gain   : float = 1
    param unread : float = 1
    models scene
    lit   = Lit(scene)
    toned = Toned(screen, size / 2) with { source = lit.color, gain = 2 * gain }
    output picture = toned.color
}
rig Studio { torch : Point, lamps : Point[<= 1] }
"""


def test_what_nothing_in_a_frame_reads_is_not_shown() -> None:
    (frame,) = burnish.compile(PASSES, ("wgsl",)).frames
    found = controls(FrameHost(frame, in_a_row(["Clay"], {}, "sphere"), (8, 8)))
    assert [row["name"] for row in found] == [
        "gain", "torch.diffuse_color", "torch.place",
        "lamps.count", "lamps[0].diffuse_color", "lamps[0].place",
    ]  # fmt: skip
