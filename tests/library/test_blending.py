"""Blend modes, against the pseudo code of the W3C and the usual definitions, number by number."""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import product

import numpy as np
import pytest

from .functions import spread, values
from .kit import Floats, close
from .truth import truth

STEPS = (0.0, 0.1, 0.22, 0.25, 0.3, 0.45, 0.5, 0.625, 0.9, 1.0)
PAIRS = np.array(list(product(STEPS, repeat=2)))
"""Every pair of a base and a blend value; both ends, and both sides of each limit."""
Mode = Callable[[float, float], float]


def hard_light(b: float, s: float) -> float:
    return 2 * b * s if s <= 0.5 else b + (2 * s - 1) - b * (2 * s - 1)


def soft_light(b: float, s: float) -> float:
    if s <= 0.5:
        return b - (1 - 2 * s) * b * (1 - b)
    d = ((16 * b - 12) * b + 4) * b if b <= 0.25 else math.sqrt(b)
    return b + (2 * s - 1) * (d - b)


def color_dodge(b: float, s: float) -> float:
    if b == 0:
        return 0
    return 1 if s == 1 else min(1, b / (1 - s))


def color_burn(b: float, s: float) -> float:
    if b == 1:
        return 1
    return 0 if s == 0 else 1 - min(1, (1 - b) / s)


MODES: dict[str, Mode] = {
    "multiply": lambda b, s: b * s,
    "darken": min,
    "color_burn": color_burn,
    "linear_burn": lambda b, s: max(b + s - 1, 0),
    "subtract": lambda b, s: max(b - s, 0),
    "screen": lambda b, s: 1 - (1 - b) * (1 - s),
    "lighten": max,
    "color_dodge": color_dodge,
    "linear_dodge": lambda b, s: min(b + s, 1),
    "divide": lambda b, s: 1 if s <= b else b / s,
    "overlay": lambda b, s: hard_light(s, b),
    "hard_light": hard_light,
    "soft_light": soft_light,
    "vivid_light": lambda b, s: color_burn(b, 2 * s) if s <= 0.5 else color_dodge(b, 2 * s - 1),
    "linear_light": lambda b, s: min(max(b + 2 * s - 1, 0), 1),
    "pin_light": lambda b, s: min(b, 2 * s) if s <= 0.5 else max(b, 2 * s - 1),
    "hard_mix": lambda b, s: float(b + s >= 1),
    "difference": lambda b, s: abs(b - s),
    "exclusion": lambda b, s: b + s - 2 * b * s,
}


def lanes_of(pairs: Floats) -> tuple[Floats, Floats]:
    """Colours whose lanes are three neighbouring pairs."""
    rows = np.stack([pairs, np.roll(pairs, 1, axis=0), np.roll(pairs, 5, axis=0)], axis=2)
    return rows[:, 0], rows[:, 1]


@truth(*(f"std.blending.{name}" for name in MODES))
@pytest.mark.parametrize("name", MODES)
def test_lanes_blend_as_defined(name: str) -> None:
    base, blend = lanes_of(PAIRS)
    found = values("blending", f"{name}(a, b)", a=base, b=blend)
    wanted = np.vectorize(MODES[name], otypes=[float])(base, blend)
    assert found == close(wanted)


@truth("std.blending.color_burn", "std.blending.color_dodge", "std.blending.vivid_light")
def test_lanes_beyond_the_range_stay_at_its_ends() -> None:
    outside = {"a": [[1.5, 1.5, 0.5]], "b": [[-1, 0.5, -0.5]]}
    assert values("blending", "color_burn(a, b)", **outside) == close([[1, 1, 0]])
    outside = {"a": [[-1, -0.5, 0.5]], "b": [[0.5, 2, 1.5]]}
    assert values("blending", "color_dodge(a, b)", **outside) == close([[0, 0, 1]])


# --- hue, saturation, luminosity -----------------------------------------------------------------


def lum(c: Floats) -> float:
    return float(0.3 * c[0] + 0.59 * c[1] + 0.11 * c[2])


def sat(c: Floats) -> float:
    return float(c.max() - c.min())


def clip_color(c: Floats) -> Floats:
    grey, n, x = lum(c), c.min(), c.max()
    if n < 0:
        c = grey + ((c - grey) * grey) / (grey - n)
    if x > 1:
        c = grey + ((c - grey) * (1 - grey)) / (x - grey)
    return np.asarray(c)


def set_lum(c: Floats, wanted: float) -> Floats:
    return clip_color(c + (wanted - lum(c)))


def set_sat(c: Floats, s: float) -> Floats:
    """As the W3C writes it: by the order of the lanes."""
    low, middle, high = np.argsort(c, kind="stable")
    result = np.zeros(3)
    if c[high] > c[low]:
        result[middle] = (c[middle] - c[low]) * s / (c[high] - c[low])
        result[high] = s
    return result


OF_TWO: dict[str, Callable[[Floats, Floats], Floats]] = {
    "blend_hue": lambda b, s: set_lum(set_sat(s, sat(b)), lum(b)),
    "blend_saturation": lambda b, s: set_lum(set_sat(b, sat(s)), lum(b)),
    "blend_color": lambda b, s: set_lum(s, lum(b)),
    "blend_luminosity": lambda b, s: set_lum(b, lum(s)),
}
CORNERS = np.array(list(product((0.0, 1.0), repeat=3)))
BASES = np.concatenate([spread(12), CORNERS, [[0.4, 0.4, 0.4]]])
BLENDS = np.concatenate([spread(12)[::-1] ** 2, CORNERS[[3, 4, 1, 6, 2, 0, 7, 5]], [[0.9, 0.2, 0]]])


@truth(*(f"std.blending.{name}" for name in OF_TWO))
@pytest.mark.parametrize("name", OF_TWO)
def test_whole_colors_blend_as_defined(name: str) -> None:
    found = values("blending", f"{name}(a, b)", a=BASES, b=BLENDS)
    assert found == close([OF_TWO[name](b, s) for b, s in zip(BASES, BLENDS, strict=True)])


@truth(
    "std.blending.luminosity", "std.blending.colorfulness", "std.blending.with_luminosity",
    "std.blending.with_colorfulness",
)  # fmt: skip
def test_parts_of_whole_colors() -> None:
    wanted = np.linspace(0, 1, len(BASES))
    pairs = list(zip(BASES, wanted.tolist(), strict=True))
    assert values("blending", "luminosity(a)", a=BASES)[:, 0] == close([*map(lum, BASES)])
    assert values("blending", "colorfulness(a)", a=BASES)[:, 0] == close([*map(sat, BASES)])
    lit = values("blending", "with_luminosity(a, t)", a=BASES, t=wanted)
    assert lit == close([set_lum(c, s) for c, s in pairs])
    assert values("blending", "luminosity(a)", a=-BASES)[:, 0] == close([*map(lum, -BASES)])
    colored = values("blending", "with_colorfulness(a, t)", a=BASES, t=wanted)
    assert colored == close([set_sat(c, s) for c, s in pairs])


# --- alpha ---------------------------------------------------------------------------------------

BELOW = np.concatenate([spread(8, lanes=4), [[0.2, 0.4, 0.6, 0], [0.2, 0.4, 0.6, 1]]])
ABOVE = np.concatenate([spread(8, lanes=4)[::-1], [[0.7, 0.1, 0.3, 0], [0.7, 0.1, 0.3, 0]]])


def composited(blended: Floats) -> Floats:
    """The general formula of the W3C, with colours that alpha has not multiplied."""
    ab, as_ = BELOW[:, 3:], ABOVE[:, 3:]
    cb, cs = BELOW[:, :3], ABOVE[:, :3]
    light = (1 - as_) * ab * cb + as_ * (1 - ab) * cs + as_ * ab * blended
    covered = as_ + ab * (1 - as_)
    color = np.divide(light, covered, where=covered > 0, out=np.zeros_like(light))
    return np.concatenate([color, covered], axis=1)


def whole(call: str) -> Floats:
    light = values("blending", f"{call}.rgb", a=BELOW, b=ABOVE)
    return np.concatenate([light, values("blending", f"{call}.a", a=BELOW, b=ABOVE)[:, :1]], axis=1)


@truth("std.blending.over", "std.blending.composite")
def test_a_color_over_another() -> None:
    assert whole("over(a, b)") == close(composited(ABOVE[:, :3]))


@truth("std.blending.composite")
def test_a_blended_color_over_another() -> None:
    screened = 1 - (1 - BELOW[:, :3]) * (1 - ABOVE[:, :3])
    assert whole("composite(a, b, screen(a.rgb, b.rgb))") == close(composited(screened))
