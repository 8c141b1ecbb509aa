"""Tone mapping, against formulas and tables of those who published it."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pytest

from .functions import spread, values
from .kit import Floats, close
from .test_color_spaces import OF_RGB
from .truth import truth

CURVES = (
    "reinhard(c)", "reinhard_extended(c, 4)", "reinhard_luminance(c, 4)", "exponential(c)",
    "hable(c)", "aces_narkowicz(c)", "aces(c)", "agx(c)", "agx_punchy(c)", "agx_golden(c)",
    "khronos_neutral(c)",
)  # fmt: skip
LIGHT = np.concatenate(
    [
        spread(5, 0, 0.3), spread(5, 0, 4), spread(3, 5, 40),
        [[0, 0, 0], [0.18, 0.18, 0.18], [1, 1, 1], [0, 2, 0], [3, 0.1, 0]],
    ]
)  # fmt: skip
BT709 = np.array([0.2126, 0.7152, 0.0722])


def found(call: str, light: Floats = LIGHT) -> Floats:
    return values("tone_mapping", call, c=light)


EVERY = tuple(f"std.tone_mapping.{call.split('(')[0]}" for call in CURVES)


@truth("std.tone_mapping.bounded", *EVERY)
@pytest.mark.parametrize("call", CURVES)
def test_what_is_shown_lies_between_black_and_white(call: str) -> None:
    """Also of light that there is not, and of more than 16-bit floats hold: it counts as 65 504."""
    light = np.array([[-1, -1e9, 0.5], [1e9, 1e30, 3e38], [65504, 65504, 65504], [0, 0.0, 0.5]])
    shown = found(call, light)
    assert (shown > -1e-9).all()
    assert (shown <= 1).all()
    assert shown[0] == close(shown[3])
    assert shown[1] == close(shown[2])


@truth("std.tone_mapping.bounded")
def test_light_is_bounded() -> None:
    assert found("bounded(c)", np.array([[-1, 3, 1e9]])) == close([[0, 3, 65504]])


@truth("std.tone_mapping.reinhard", "std.tone_mapping.exponential")
def test_simple_curves() -> None:
    assert found("reinhard(c)") == close(LIGHT / (1 + LIGHT))
    assert found("exponential(c)") == close(1 - np.exp(-LIGHT))


@truth("std.tone_mapping.reinhard_extended")
def test_white_is_where_reinhard_wants_it() -> None:
    wanted = np.minimum(LIGHT * (1 + LIGHT / 2.5**2) / (1 + LIGHT), 1)
    assert found("reinhard_extended(c, 2.5)") == close(wanted)
    assert found("reinhard_extended(c, 2.5)", np.full((1, 3), 2.5)) == close(np.ones((1, 3)))


@truth("std.tone_mapping.reinhard_luminance")
def test_reinhard_by_luminance_keeps_hues() -> None:
    before = (LIGHT @ BT709)[:, None]
    after = before * (1 + before / 3.5**2) / (1 + before)
    wanted = np.minimum(LIGHT * np.divide(after, before, where=before > 0, out=after * 0), 1)
    assert found("reinhard_luminance(c, 3.5)") == close(wanted)


def uncharted(x: Floats) -> Floats:
    """Hable's curve, by his letters."""
    a, b, c, d, e, f = 0.15, 0.50, 0.10, 0.20, 0.02, 0.30
    return np.asarray((x * (a * x + c * b) + d * e) / (x * (a * x + b) + d * f) - e / f)


@truth("std.tone_mapping.hable", "std.tone_mapping.hable_curve")
def test_hable_has_a_toe_and_a_shoulder() -> None:
    wanted = np.minimum(uncharted(2 * LIGHT) / uncharted(np.array(11.2)), 1)
    assert found("hable(c)") == close(wanted)
    assert found("hable_curve(c)") == close(uncharted(LIGHT))
    assert found("hable(c)", np.full((1, 3), 5.6)) == close(np.ones((1, 3)))


# --- ACES ----------------------------------------------------------------------------------------


@truth("std.tone_mapping.aces_narkowicz")
def test_the_short_fit_to_aces() -> None:
    a, b, c, d, e = 2.51, 0.03, 2.43, 0.59, 0.14
    wanted = np.clip(LIGHT * (a * LIGHT + b) / (LIGHT * (c * LIGHT + d) + e), 0, 1)
    assert found("aces_narkowicz(c)") == close(wanted)


RRT_SAT = np.array(
    [[0.59719, 0.35458, 0.04823], [0.07600, 0.90834, 0.01566], [0.02840, 0.13383, 0.83777]]
)
ODT_SAT = np.array(
    [[1.60475, -0.53108, -0.07367], [-0.10208, 1.10813, -0.00605], [-0.00327, -0.07276, 1.07602]]
)
"""As Hill's shader has them, row by row."""


@truth("std.tone_mapping.aces", "std.tone_mapping.rrt_of_rgb", "std.tone_mapping.rgb_of_odt")
def test_the_fit_of_hill_to_aces() -> None:
    v = LIGHT @ RRT_SAT.T
    a = v * (v + 0.0245786) - 0.000090537
    b = v * (0.983729 * v + 0.4329510) + 0.238081
    assert found("aces(c)") == close(np.clip(a / b @ ODT_SAT.T, 0, 1))


@truth("std.tone_mapping.rrt_of_rgb", "std.tone_mapping.rgb_of_odt")
def test_matrices_of_aces_are_those_of_its_specification() -> None:
    """To AP1 and back, less saturated by the factors 0.96 and 0.93 of ACES 1.0, whose luminance has
    the weights of AP1."""
    weights = np.array([0.2722287168, 0.6740817658, 0.0536895174])
    rrt, odt = (share * np.eye(3) + (1 - share) * weights for share in (0.96, 0.93))
    into, back = (found(f"{name} * c", np.eye(3)).T for name in ("rrt_of_rgb", "rgb_of_odt"))
    assert into == pytest.approx(rrt @ OF_RGB["acescg"], abs=2e-4)
    assert back == pytest.approx(np.linalg.solve(OF_RGB["acescg"], odt), abs=2e-3)


# --- AgX -----------------------------------------------------------------------------------------

INSET = np.array(
    [
        [0.856627153315983, 0.0951212405381588, 0.0482516061458583],
        [0.137318972929847, 0.761241990602591, 0.101439036467562],
        [0.11189821299995, 0.0767994186031903, 0.811302368396859],
    ]
)
OUTSET = np.array(
    [
        [1.1271005818144368, -0.11060664309660323, -0.016493938717834573],
        [-0.1413297634984383, 1.157823702216272, -0.016493938717834257],
        [-0.14132976349843826, -0.11060664309660294, 1.2519364065950405],
    ]
)
"""As Filament and three.js have them, row by row."""


def fitted(x: Floats) -> Floats:
    """Wrensch's polynomial."""
    return np.asarray(np.polyval([15.5, -40.14, 31.96, -6.868, 0.4298, 0.1191, -0.00232], x))


def sigmoid(x: Floats) -> Floats:
    """Sobotka's curve, which the polynomial fits: slope 2 at the pivot, powers 3 and 3.25."""
    pivot = 10 / 16.5
    up = x > pivot
    power = np.where(up, 3.25, 3.0)
    end = np.where(up, 1 - pivot, pivot)
    # So that the curve ends at 0 and 1.
    scale = (2 * end) ** power / 0.5**power - 1
    return np.asarray(
        0.5 + 2 * (x - pivot) / (1 + scale * (np.abs(x - pivot) / end) ** power) ** (1 / power)
    )


def encoded(curve: Callable[[Floats], Floats]) -> Floats:
    inset = LIGHT @ OF_RGB["rec2020"].T @ INSET.T
    return curve(np.clip((np.log2(np.maximum(inset, 1e-30)) + 12.47393) / 16.5, 0, 1))


def decoded(shown: Floats) -> Floats:
    light = np.maximum(shown @ OUTSET.T, 0) ** 2.2
    return np.asarray(np.clip(light @ np.linalg.inv(OF_RGB["rec2020"]).T, 0, 1))


@truth("std.tone_mapping.agx_encoded", "std.tone_mapping.agx_of_rec2020")
def test_agx_has_the_curve_of_its_author() -> None:
    """The fit is near the curve, which has middle grey at one half."""
    shown = found("agx_encoded(c)")
    assert shown == pytest.approx(encoded(fitted), abs=1e-8)
    assert shown == pytest.approx(encoded(sigmoid), abs=8e-3)
    assert shown[14] == pytest.approx([0.5] * 3, abs=5e-3)


@truth("std.tone_mapping.agx", "std.tone_mapping.agx_decoded", "std.tone_mapping.rec2020_of_agx")
def test_agx_turns_back_to_linear_light() -> None:
    assert found("agx(c)") == pytest.approx(decoded(encoded(fitted)), abs=1e-7)
    assert found("agx_decoded(c)", spread(8)) == pytest.approx(decoded(spread(8)), abs=1e-7)


def looking(slope: Floats, power: float, share: float) -> Floats:
    """A look after ASC CDL: slope, power, and saturation with the weights of Rec. 709."""
    shown = np.maximum(encoded(fitted) * slope, 0) ** power
    grey = (shown @ BT709)[:, None]
    return decoded(grey + share * (shown - grey))


@truth(
    "std.tone_mapping.agx_look", "std.tone_mapping.agx_punchy", "std.tone_mapping.agx_golden",
    "std.tone_mapping.agx_encoded",
)  # fmt: skip
def test_looks_of_agx() -> None:
    slope = np.array([0.9, 1.1, 0.7])
    assert found("agx_punchy(c)") == pytest.approx(looking(np.ones(3), 1.35, 1.4), abs=1e-7)
    golden = looking(np.array([1, 0.9, 0.5]), 0.8, 0.8)
    assert found("agx_golden(c)") == pytest.approx(golden, abs=1e-7)
    own = found("agx_look(c, vec3(0.9, 1.1, 0.7), 1.2, 0.6)")
    assert own == pytest.approx(looking(slope, 1.2, 0.6), abs=1e-7)


# --- Khronos -------------------------------------------------------------------------------------


def neutral(color: Floats) -> Floats:
    """The specification's steps."""
    start, desaturation = 0.8 - 0.04, 0.15
    x = color.min()
    color = color - (x - 6.25 * x * x if x < 0.08 else 0.04)
    peak = color.max()
    if peak < start:
        return color
    d = 1 - start
    new_peak = 1 - d * d / (peak + d - start)
    g = 1 - 1 / (desaturation * (peak - new_peak) + 1)
    return np.asarray(color * (new_peak / peak) * (1 - g) + new_peak * g)


@truth("std.tone_mapping.khronos_neutral")
def test_neutral_tones_are_those_of_khronos() -> None:
    assert found("khronos_neutral(c)") == close([neutral(color) for color in LIGHT])
    dark = np.array([[0.079, 0.5, 0.2], [0.081, 0.5, 0.2], [0.3, 0.79, 0.5], [0.3, 0.81, 0.5]])
    assert found("khronos_neutral(c)", dark) == close([neutral(color) for color in dark])
    assert found("khronos_neutral(c)", dark[2:3]) == close(dark[2:3] - 0.04)
