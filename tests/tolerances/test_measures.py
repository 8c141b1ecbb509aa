"""Measures of pictures whose distance is known: by formulas on paper, or from elsewhere."""

from __future__ import annotations

import numpy as np
import pytest
from numpy.typing import NDArray

from . import measures

Floats = NDArray[np.float64]


def grey(code: float, height: int = 16, width: int = 20) -> Floats:
    """An opaque picture of one colour."""
    picture = np.full((height, width, 4), float(code))
    picture[..., 3] = 255
    return picture


def test_codes_are_those_of_srgb_and_of_plain_alpha() -> None:
    shown = measures.codes_of(np.array([[[0.5, 0.002, 2.0, 0.2], [np.nan, -1.0, 1.0, 1.0]]]))
    assert shown.tolist() == [[[188, 7, 255, 51], [0, 0, 255, 255]]]


def test_measures_of_whole_pictures() -> None:
    one, other = grey(100), grey(103)
    assert measures.largest_difference(one, other) == 3
    assert measures.mean_difference(one, other) == pytest.approx(3 * 3 / 4)
    assert measures.root_mean_square(one, other) == pytest.approx(3 * np.sqrt(3 / 4))


def test_the_ratio_of_peak_to_noise() -> None:
    one = grey(100)
    other = one + 1
    assert measures.peak_signal_to_noise(one, other) == pytest.approx(48.1308, abs=1e-4)
    assert measures.peak_signal_to_noise(one, one) == np.inf


def test_the_share_of_pixels() -> None:
    one, other = grey(100), grey(100)
    other[3, 4, 1] = 106
    other[0, 0, 0] = np.nan
    assert measures.share_beyond(one, other, 5.1) == pytest.approx(2 / 320)
    assert measures.share_beyond(one, other, 6) == pytest.approx(1 / 320)


def test_structural_similarity_of_even_pictures_is_that_of_their_means() -> None:
    steady = 2.55**2
    expected = (2 * 100 * 110 + steady) / (100**2 + 110**2 + steady)
    assert measures.structural_similarity(grey(100), grey(110)) == pytest.approx(expected)
    assert measures.structural_similarity(grey(7), grey(7)) == pytest.approx(1)


def test_structural_similarity_of_stripes_that_moved() -> None:
    one = grey(0)
    one[::2, :, :3] = 255
    steady = 7.65**2
    variance = 127.5**2
    expected = (-2 * variance + steady) / (2 * variance + steady)
    assert measures.structural_similarity(one, np.roll(one, 1, axis=0)) == pytest.approx(expected)


@pytest.mark.parametrize(("code", "share"), [(126, 0), (127, 1)])
def test_pixelmatch_has_a_threshold(code: float, share: float) -> None:
    """0.5053 · d² > 35215 · 0.1² holds from d = 26.4 on."""
    assert measures.mismatched(grey(100), grey(code), 0.1) == share


def test_pixelmatch_shows_what_is_not_opaque_over_white() -> None:
    clear = grey(0)
    clear[..., 3] = 0
    assert measures.mismatched(clear, grey(255), 0.1) == 0


def test_pixelmatch_leaves_out_smoothed_edges() -> None:
    hard, smooth = grey(0), grey(0)
    hard[:, 10:, :3] = 255
    smooth[:, 10:, :3] = 255
    smooth[:, 10, :3] = 128
    assert measures.share_beyond(hard, smooth, 26) == pytest.approx(1 / 20)
    assert measures.mismatched(hard, smooth, 0.1) == 0


def test_pixelmatch_counts_what_is_no_edge() -> None:
    dotted = grey(0)
    dotted[7, 7, :3] = 128
    assert measures.mismatched(grey(0), dotted, 0.1) == pytest.approx(1 / 320)


def test_the_worst_part() -> None:
    one, other = grey(0, 40, 40), grey(0, 40, 40)
    other[8:10, 8:10, 0] = 17
    assert measures.worst_part(one, other, 16) == pytest.approx(4 / 16)
    assert measures.worst_part(one, other, 17) == 0


def test_colours_as_seen() -> None:
    """The values are those of the documentation of `colour-science`."""
    found = measures.jzazbz(np.array([[[0.20654008, 0.12197225, 0.05136952]]]))
    assert found[0, 0] == pytest.approx([0.00535048, 0.00924302, 0.00526007], abs=5e-7)


def test_small_differences_of_colours_are_ignored() -> None:
    assert measures.mean_seen_difference(grey(100), grey(101), 0.001) == 0
    assert measures.mean_seen_difference(grey(100), grey(140), 0.001) > 0.01
