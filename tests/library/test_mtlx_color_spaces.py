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


def _from_srgb() -> Floats:
    """The curve of IEC 61966-2-1."""
    curved = ((np.maximum(COLORS, 0) + 0.055) / 1.055) ** 2.4
    return np.asarray(np.where(COLORS <= 0.04045, COLORS / 12.92, curved))


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


def test_these_are_all_spaces_of_the_library() -> None:
    text = (libraries() / "cmlib" / "cmlib_ng.mtlx").read_text("utf-8")
    assert set(re.findall(r'"NG_(\w+)_to_lin_rec709_color3"', text)) == set(EXPECTED)
