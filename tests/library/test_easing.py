"""Curves, waves and ramps, against the formulas of easings.net and of those who published them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np
import pytest

from .functions import spread, values
from .kit import Floats, close
from .truth import truth

Curve = Callable[[float], float]
TIMES = np.array(
    [0, 0.03, 0.1, 0.17, 0.2, 0.26, 0.31, 0.38, 0.44, 0.5,
     0.54, 0.6, 0.66, 0.71, 0.8, 0.87, 0.9, 0.96, 1]
)  # fmt: skip
"""On each arc of each curve."""
OVERSHOOT, WIDER = 1.70158, 1.70158 * 1.525


def bounced(x: float) -> float:
    n, d = 7.5625, 2.75
    for end, place, height in ((1, 0, 0), (2, 1.5, 0.75), (2.5, 2.25, 0.9375)):
        if x < end / d:
            return n * (x - place / d) ** 2 + height
    return n * (x - 2.625 / d) ** 2 + 0.984375


def powers(n: int) -> tuple[Curve, Curve, Curve]:
    return (
        lambda x: x**n,
        lambda x: 1 - (1 - x) ** n,
        lambda x: 2 ** (n - 1) * x**n if x < 0.5 else 1 - (2 - 2 * x) ** n / 2,
    )


def with_ends(curve: Curve) -> Curve:
    """A curve whose ends are given: 0 and 1."""
    return lambda x: x if x in (0, 1) else curve(x)


EASINGS: dict[str, tuple[Curve, Curve, Curve]] = {
    "quad": powers(2),
    "cubic": powers(3),
    "quart": powers(4),
    "quint": powers(5),
    "sine": (
        lambda x: 1 - math.cos(x * math.pi / 2),
        lambda x: math.sin(x * math.pi / 2),
        lambda x: -(math.cos(math.pi * x) - 1) / 2,
    ),
    "expo": (
        with_ends(lambda x: 2 ** (10 * x - 10)),
        with_ends(lambda x: 1 - 2 ** (-10 * x)),
        with_ends(lambda x: 2 ** (20 * x - 10) / 2 if x < 0.5 else (2 - 2 ** (10 - 20 * x)) / 2),
    ),
    "circ": (
        lambda x: 1 - math.sqrt(1 - x**2),
        lambda x: math.sqrt(1 - (x - 1) ** 2),
        lambda x: (
            (1 - math.sqrt(1 - (2 * x) ** 2)) / 2
            if x < 0.5
            else (math.sqrt(1 - (2 - 2 * x) ** 2) + 1) / 2
        ),
    ),
    "back": (
        lambda x: (OVERSHOOT + 1) * x**3 - OVERSHOOT * x**2,
        lambda x: 1 + (OVERSHOOT + 1) * (x - 1) ** 3 + OVERSHOOT * (x - 1) ** 2,
        lambda x: (
            (2 * x) ** 2 * ((WIDER + 1) * 2 * x - WIDER) / 2
            if x < 0.5
            else ((2 * x - 2) ** 2 * ((WIDER + 1) * (2 * x - 2) + WIDER) + 2) / 2
        ),
    ),
    "elastic": (
        with_ends(lambda x: -(2 ** (10 * x - 10)) * math.sin((10 * x - 10.75) * 2 * math.pi / 3)),
        with_ends(lambda x: 2 ** (-10 * x) * math.sin((10 * x - 0.75) * 2 * math.pi / 3) + 1),
        with_ends(
            lambda x: (
                -(2 ** (20 * x - 10) * math.sin((20 * x - 11.125) * 2 * math.pi / 4.5)) / 2
                if x < 0.5
                else 2 ** (10 - 20 * x) * math.sin((20 * x - 11.125) * 2 * math.pi / 4.5) / 2 + 1
            )
        ),
    ),
    "bounce": (
        lambda x: 1 - bounced(1 - x),
        bounced,
        lambda x: (1 - bounced(1 - 2 * x)) / 2 if x < 0.5 else (1 + bounced(2 * x - 1)) / 2,
    ),
}
KINDS = ("ease_in", "ease_out", "ease_in_out")


def shown(call: str, t: Sequence[float] | Floats) -> Floats:
    return values("easing", call, t=t)[:, 0]


@truth(
    "std.easing.tent", "std.easing.both_halves", "std.easing.overshooting", "std.easing.swinging",
    *(f"std.easing.{kind}_{name}" for name in EASINGS for kind in KINDS),
)  # fmt: skip
@pytest.mark.parametrize("name", EASINGS)
def test_curves_are_those_of_easings_net(name: str) -> None:
    """Outside of 0 to 1 they stay at their ends."""
    for kind, curve in zip(KINDS, EASINGS[name], strict=True):
        call = f"{kind}_{name}(t)"
        assert shown(call, TIMES) == pytest.approx([*map(curve, TIMES)], abs=1e-12), call
        assert shown(call, [-3, -0.1, 1.2, 40]) == pytest.approx([0, 0, 1, 1], abs=1e-12), call


# --- ranges --------------------------------------------------------------------------------------


@truth("std.easing.inverse_lerp", "std.easing.remap")
def test_numbers_move_from_range_to_range() -> None:
    low, high, x = spread(5), spread(5) + 0.3, spread(5, -1, 2)[::-1]
    place = (x - low) / (high - low)
    assert values("easing", "inverse_lerp(a, b, c)", a=low, b=high, c=x) == close(place)
    to, end = spread(5, 3, 4), spread(5, -5, 1)
    found = values("easing", "remap(c, a, b, d, e)", a=low, b=high, c=x, d=to, e=end)
    assert found == close(to + place * (end - to))
    assert shown("inverse_lerp(t, t, 5)", [2.0]) == close([0])


EDGES = {"a": [1, 1, 1, 1, 2, 2, 2, 3, 3, 0], "b": [3, 3, 3, 3, 2, 2, 2, 1, 1, 0]}
PLACES = [0, 1.5, 2.5, 4, 1.9, 2, 2.1, 2.5, 3.1, 2.0**-66]
LINEAR = np.array([0, 0.25, 0.75, 1, 0, 0, 1, 0, 1, 0.25])


@truth("std.easing.linear_step", "std.easing.smootherstep")
def test_steps_rise_from_edge_to_edge() -> None:
    """Without a range between the edges they are hard."""
    found = values("easing", "linear_step(a, b, t)", t=PLACES, **EDGES)[:, 0]
    assert found == close(LINEAR)
    found = values("easing", "smootherstep(a, b, t)", t=PLACES, **EDGES)[:, 0]
    assert found == close(np.polyval([6, -15, 10, 0, 0, 0], LINEAR))


AMOUNTS = np.tile([0.1, 0.4, 0.5, 0.8], 7)
AT = np.repeat([0, 0.2, 0.45, 0.5, 0.55, 0.7, 1], 4)


@truth("std.easing.bias")
def test_bias_is_that_of_schlick() -> None:
    found = values("easing", "bias(t, a)", t=AT, a=AMOUNTS)[:, 0]
    assert found == close(AT / ((1 / AMOUNTS - 2) * (1 - AT) + 1))
    assert shown("bias(t, 0.3)", [-1, 0.5, 7]) == close([0, 0.3, 1])


@truth("std.easing.gain")
def test_gain_is_that_of_schlick() -> None:
    slope = (1 / AMOUNTS - 2) * (1 - 2 * AT)
    wanted = np.where(AT < 0.5, AT / (slope + 1), (slope - AT) / (slope - 1))
    assert values("easing", "gain(t, a)", t=AT, a=AMOUNTS)[:, 0] == close(wanted)
    assert shown("gain(t, 0.3)", [-1, 7]) == close([0, 1])


# --- waves ---------------------------------------------------------------------------------------


@truth("std.easing.pulse", "std.easing.square_wave")
def test_pulses_have_two_edges() -> None:
    assert shown("pulse(2, 3, t)", [1.9, 2, 2.5, 3, 4]) == close([0, 1, 1, 0, 0])
    assert shown("square_wave(t)", [0, 0.49, 0.5, 0.99, 1, -0.3]) == close([0, 0, 1, 1, 0, 1])


@truth("std.easing.triangle_wave", "std.easing.ping_pong", "std.easing.tent")
def test_triangles_go_forth_and_back() -> None:
    times = np.array([0, 0.25, 0.5, 0.8, 1, 1.1, -0.1, -1.5])
    wave = np.interp(times % 1, [0, 0.5, 1], [0, 1, 0])
    assert shown("triangle_wave(t)", times) == close(wave)
    assert shown("ping_pong(t, 0.7)", 1.4 * times) == close(0.7 * wave)
    assert shown("tent(t)", times[:4]) == close(wave[:4])


@truth("std.easing.both_halves")
def test_halves_are_turned_around() -> None:
    found = values("easing", "both_halves(t, a)", t=[0.2, 0.7], a=[0.4, 0.3])[:, 0]
    assert found == close([0.2, 0.85])


@truth("std.easing.overshooting", "std.easing.swinging")
def test_shapes_of_back_and_elastic() -> None:
    x, a = np.array([0.2, 0.6, 1]), np.array([1.0, 2, 3])
    found = values("easing", "overshooting(t, a)", t=x, a=a)[:, 0]
    assert found == close((a + 1) * x**3 - a * x**2)
    found = values("easing", "swinging(t, a)", t=x, a=a)[:, 0]
    assert found == close(-(2 ** (10 * x - 10)) * np.sin((10 * x - 10 - a / 4) * 2 * np.pi / a))


# --- ramps ---------------------------------------------------------------------------------------

STOPS = np.array([[0.1, 0.9, 0.3], [0.7, 0.2, 0.4], [0.5, 0.6, 1.0], [0.0, 0.8, 0.2]])
COLORS = f"[{', '.join(f'vec3({a}, {b}, {c})' for a, b, c in STOPS.tolist())}]"
ALONG = np.array([-1, 0, 0.1, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6, 0.7, 0.75, 0.9, 1, 3])


def between(places: Sequence[float] | Floats) -> Floats:
    return np.stack([np.interp(ALONG, places, lane) for lane in STOPS.T], axis=1)


@truth("std.easing.ramp")
def test_ramps_go_through_their_colors() -> None:
    assert values("easing", f"ramp({COLORS}, t)", t=ALONG) == close(between(np.linspace(0, 1, 4)))
    two = values("easing", "ramp([vec3(1, 2, 3), vec3(3, 2, 5)], t)", t=[0, 0.25, 1])
    assert two == close([[1, 2, 3], [1.5, 2, 3.5], [3, 2, 5]])
    assert shown("ramp([1.0, 3, 2, 7, 4, 6], t)", [0.5, 0.7, 0.9, 1]) == close([4.5, 5.5, 5, 6])


@truth("std.easing.ramp")
def test_colors_of_ramps_have_places() -> None:
    places = [0.15, 0.4, 0.55, 0.95]
    assert values("easing", f"ramp({COLORS}, {places}, t)", t=ALONG) == close(between(places))
    edge = values("easing", f"ramp({COLORS}, [0, 0.5, 0.5, 1], t)", t=[0.25, 0.5, 0.500000001])
    assert edge == pytest.approx(
        np.array([(STOPS[0] + STOPS[1]) / 2, STOPS[1], STOPS[2]]), abs=1e-6
    )


@truth("std.easing.ramp_constant")
def test_constant_ramps_have_a_part_for_each_color() -> None:
    parts = np.clip(np.floor(4 * ALONG), 0, 3).astype(int)
    assert values("easing", f"ramp_constant({COLORS}, t)", t=ALONG) == close(STOPS[parts])


@truth("std.easing.ramp", "std.easing.ramp_constant")
@pytest.mark.parametrize("t", [0, 1, 2])
def test_constant_numbers_may_be_the_ends_of_ramps(t: int) -> None:
    for ramp in ("ramp", "ramp_constant"):
        found = values("easing", f"{ramp}({COLORS}, {t}.0) * a", a=[1.0])
        assert found == close([STOPS[-1 if t else 0]])
