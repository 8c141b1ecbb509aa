"""The colour spaces of ``std.mtlx.color`` against the numbers of MaterialX's own library."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from functools import cache

import numpy as np
import pytest

from .calls import called, scattered
from .kit import Floats
from .materialx import libraries
from .truth import truth

COLORS = scattered(64, 3, 1.2)


@cache
def _graph(space: str) -> str:
    """The node graph of MaterialX that takes colours of a space to linear Rec. 709."""
    text = (libraries() / "cmlib" / "cmlib_ng.mtlx").read_text("utf-8")
    name = f"NG_{space}_to_lin_rec709_color3"
    (graph,) = re.findall(rf'<nodegraph name="{name}".*?</nodegraph>', text, re.DOTALL)
    return str(graph)


def _matrix(space: str) -> Floats:
    """The matrix in the graph of a space, whose columns it lists one after the other."""
    (listed,) = re.findall(r'type="matrix33" value="(.*?)"', _graph(space))
    return np.array([float(number) for number in listed.split(",")]).reshape(3, 3).T


def _gamma(space: str) -> float:
    """The exponent in the graph of a space."""
    return float(re.findall(r'name="in2" type="float" value="([1-9].*?)"', _graph(space))[-1])


def _decoded(space: str, gamma: float = 0) -> Floats:
    """Colours of a space as they are without its curve."""
    return np.asarray(np.maximum(COLORS, 0) ** (gamma or _gamma(space)))


def _from_srgb(colors: Floats = COLORS) -> Floats:
    """The curve of IEC 61966-2-1."""
    curved = ((np.maximum(colors, 0) + 0.055) / 1.055) ** 2.4
    return np.asarray(np.where(colors <= 0.04045, colors / 12.92, curved))


ADOBE = 563 / 256
EXPECTED: Mapping[str, Callable[[], Floats]] = {
    "g18_rec709": lambda: _decoded("g18_rec709"),
    "g22_rec709": lambda: _decoded("g22_rec709"),
    "rec709_display": lambda: _decoded("rec709_display"),
    "srgb_texture": _from_srgb,
    "acescg": lambda: COLORS @ _matrix("acescg").T,
    "g22_ap1": lambda: _decoded("g22_ap1") @ _matrix("acescg").T,
    "lin_displayp3": lambda: COLORS @ _matrix("lin_displayp3").T,
    "srgb_displayp3": lambda: _from_srgb() @ _matrix("srgb_displayp3").T,
    "lin_adobergb": lambda: COLORS @ _matrix("lin_adobergb").T,
    "adobergb": lambda: _decoded("adobergb", ADOBE) @ _matrix("lin_adobergb").T,
}


@truth(*(f"std.mtlx.color.from_{space}" for space in EXPECTED), "std.mtlx.color.rgb_of_adobe_rgb")
@pytest.mark.parametrize("space", EXPECTED)
def test_colors_of_a_space_become_linear(space: str) -> None:
    """The matrix of MaterialX for Display P3 has five digits."""
    found = called("import std.mtlx.color", f"from_{space}(c)", 3, c=COLORS)
    near = 4e-5 if space.endswith("displayp3") else 1e-8
    assert found == pytest.approx(EXPECTED[space](), rel=near, abs=near)
    covered = called("import std.mtlx.color", f"from_{space}(vec4(c, 0.25 * c.x))", 4, c=COLORS)
    assert (covered == np.column_stack([found, 0.25 * COLORS[:, 0]])).all()


WHITE = (0.3127, 0.3290)
REC_709 = ((0.64, 0.33), (0.30, 0.60), (0.15, 0.06))
REC_2020 = ((0.708, 0.292), (0.170, 0.797), (0.131, 0.046))
AP0, AP1 = (
    ((0.7347, 0.2653), (0.0, 1.0), (0.0001, -0.0770)),
    ((0.713, 0.293), (0.165, 0.830), (0.128, 0.044)),
)
OF_ACES = (0.32168, 0.33767)
"""The white of both sets of primaries of ACES."""
BRADFORD = np.array(
    [[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]]
)
"""The matrix of K. Lam, 1985, as ICC.1:2022, annex E, has it."""
Place = tuple[float, float]


def _xyz(place: Place) -> Floats:
    """The colour with this chromaticity and Y = 1."""
    x, y = place
    return np.array([x / y, 1, (1 - x - y) / y])


def _to_xyz(primaries: tuple[Place, ...], white: Place) -> Floats:
    """The matrix to CIE XYZ. (SMPTE RP 177:1993, 3.3.)"""
    columns = np.array([[x, y, 1 - x - y] for x, y in primaries]).T
    return np.asarray(columns * np.linalg.solve(columns, _xyz(white)))


def _to_rec_709(primaries: tuple[Place, ...], white: Place = WHITE) -> Floats:
    """The matrix to the primaries of Rec. 709, with white adapted to white."""
    seen, wanted = BRADFORD @ _xyz(white), BRADFORD @ _xyz(WHITE)
    adapted = np.linalg.solve(BRADFORD, np.diag(wanted / seen) @ BRADFORD)
    return np.asarray(np.linalg.solve(_to_xyz(REC_709, WHITE), adapted @ _to_xyz(primaries, white)))


STOPS = np.vstack([COLORS, [[-0.4, -0.30137, -0.30136], [0.15525, 0.15526, 0.1], [1.46, 1.47, 2]]])
"""Colours with numbers at both ends of the curves of ACES."""


def _by_stops(toe: Callable[[Floats], Floats], end: float) -> Floats:
    """Numbers that are encoded by stops, with another curve up to an end. (S-2014-003, 4.4.)"""
    light = np.where(STOPS < 1.4679964, 2.0 ** (STOPS * 17.52 - 9.72), 65504)
    return np.asarray(np.where(end >= STOPS, toe(STOPS), light))


OF_OPEN_COLOR_IO: Mapping[str, Callable[[], Floats]] = {
    "aces2065_1": lambda: STOPS @ _to_rec_709(AP0, OF_ACES).T,
    "acescc": lambda: (
        _by_stops(lambda x: (2.0 ** (x * 17.52 - 9.72) - 2.0**-16) * 2, -0.3013698630)
        @ _to_rec_709(AP1, OF_ACES).T
    ),
    "acescct": lambda: (
        _by_stops(lambda x: (x - 0.0729055341958355) / 10.5402377416545, 0.155251141552511)
        @ _to_rec_709(AP1, OF_ACES).T
    ),
    "srgb_ap1": lambda: _from_srgb(STOPS) @ _to_rec_709(AP1, OF_ACES).T,
    "lin_rec2020": lambda: STOPS @ _to_rec_709(REC_2020).T,
    "lin_ciexyzd65": lambda: STOPS @ np.linalg.inv(_to_xyz(REC_709, WHITE)).T,
}


@truth(
    *(f"std.mtlx.color.from_{space}" for space in OF_OPEN_COLOR_IO),
    "std.mtlx.color.rgb_of_ap0", "std.mtlx.color.stops_to_light",
)  # fmt: skip
@pytest.mark.parametrize("space", OF_OPEN_COLOR_IO)
def test_spaces_of_open_color_io_become_linear(space: str) -> None:
    """By the primaries and whites of the standards."""
    found = called("import std.mtlx.color", f"from_{space}(c)", 3, c=STOPS)
    assert found == pytest.approx(OF_OPEN_COLOR_IO[space](), rel=1e-6, abs=1e-8)
    covered = called("import std.mtlx.color", f"from_{space}(vec4(c, 0.25 * c.x))", 4, c=STOPS)
    assert (covered == np.column_stack([found, 0.25 * STOPS[:, 0]])).all()


ONE_PATCH = {
    "aces2065_1": (0.3687, 0.3279, 0.2760),
    "acescg": (0.3983, 0.3299, 0.2765),
    "srgb_texture": (0.7021, 0.6026, 0.5532),
    "srgb_displayp3": (0.6858, 0.6062, 0.5600),
    "lin_ciexyzd65": (0.3491, 0.3451, 0.3005),
    "lin_displayp3": (0.4280, 0.3259, 0.2738),
    "lin_rec2020": (0.4004, 0.3299, 0.2745),
    "adobergb": (0.6697, 0.5970, 0.5504),
    "rec709_display": (0.7176, 0.6233, 0.5765),
}
"""One colour, (0.4510, 0.3216, 0.2667) in linear Rec. 709, as other spaces have it: computed by
OpenColorIO for MaterialX's own test of spaces."""


@pytest.mark.parametrize("space", ONE_PATCH)
def test_a_color_is_the_same_in_all_spaces(space: str) -> None:
    found = called("import std.mtlx.color", f"from_{space}(c)", 3, c=np.array([ONE_PATCH[space]]))
    assert found[0] == pytest.approx((0.4510, 0.3216, 0.2667), abs=1.5e-4)


def test_these_are_all_spaces_of_the_library() -> None:
    text = (libraries() / "cmlib" / "cmlib_ng.mtlx").read_text("utf-8")
    assert set(re.findall(r'"NG_(\w+)_to_lin_rec709_color3"', text)) == set(EXPECTED)
