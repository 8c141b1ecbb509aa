"""The rules by which a picture lies within its bounds, number by number."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from burnish.targets.conformance.golden.within import (
    Encoding,
    GoldenError,
    Verdict,
    Worst,
    judged,
    only,
    outputs_of,
    sentence,
    srgb,
)

from .kit import bounds, flat, small_golden, write_case, write_golden


def verdict(
    root: Path, picture: NDArray[Any], encoding: Encoding = "linear", case: str | None = None
) -> Verdict:
    """The verdict about a picture of the only case."""
    return judged(picture, only(outputs_of(root), case), encoding)


def test_both_ends_are_within(tmp_path: Path) -> None:
    golden = small_golden(tmp_path)
    for value in (0.25, 0.3, 0.5):
        assert verdict(golden, flat(value)).is_good
    found = verdict(golden, flat(np.nextafter(0.5, 1)))
    assert found.outside.all()


def test_the_worst_is_the_first_of_the_farthest(tmp_path: Path) -> None:
    picture = flat(0.3)
    picture[0, 2, 1], picture[1, 0, 3], picture[1, 2, 0] = 0.6, 0.15, 0.7
    picture[1, 1, 2] = 0.05
    found = verdict(small_golden(tmp_path), picture)
    assert found.worst == Worst(1, 1, 2, 0.05, 0.25, 0.5)
    assert (found.compared, found.undecided, int(found.outside.sum())) == (6, 0, 4)


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_what_is_no_number_is_infinitely_far(tmp_path: Path, value: float) -> None:
    picture = flat(0.3)
    picture[0, 1, 3], picture[1, 1, 0] = 1e30, value
    worst = verdict(small_golden(tmp_path), picture).worst
    assert worst is not None
    assert (worst.x, worst.y, worst.lane) == (1, 1, 0)


def test_nan_is_outside_even_where_nothing_is_known(tmp_path: Path) -> None:
    golden = write_golden(tmp_path, write_case(tmp_path, *bounds(-np.inf, np.inf)))
    for value in (1e300, -np.inf, np.inf):
        assert verdict(golden, flat(value)).is_good
    assert verdict(golden, flat(np.nan)).outside.all()


def test_undecided_pixels_are_not_compared(tmp_path: Path) -> None:
    undecided = np.array([[1, 0, 0], [0, 0, 1]], "u1")
    golden = write_golden(tmp_path, write_case(tmp_path, *bounds(), undecided))
    picture = flat(0.3)
    picture[undecided == 1] = np.nan
    found = verdict(golden, picture)
    assert (found.is_good, found.compared, found.undecided) == (True, 4, 2)


def test_nothing_compared_is_not_good(tmp_path: Path) -> None:
    golden = write_golden(tmp_path, write_case(tmp_path, *bounds(), np.ones((2, 3), "u1")))
    with pytest.raises(GoldenError, match="nothing is compared"):
        verdict(golden, flat(0.3))


@pytest.mark.parametrize("lanes", [1, 2, 3])
def test_missing_lanes_are_not_compared(tmp_path: Path, lanes: int) -> None:
    low, high = bounds()
    low[..., lanes:], high[..., lanes:] = 7, 8
    golden = write_golden(tmp_path, write_case(tmp_path, low, high))
    assert verdict(golden, flat(0.3, lanes)).is_good
    if lanes == 1:
        assert verdict(golden, flat(0.3)[..., 0]).is_good


@pytest.mark.parametrize("kind", ["<f2", "<f4", ">f4", "<f8"])
def test_floats_of_every_size(tmp_path: Path, kind: str) -> None:
    golden = small_golden(tmp_path)
    assert verdict(golden, flat(0.3).astype(kind)).is_good
    assert not verdict(golden, flat(0.51).astype(kind)).is_good


def test_whole_numbers_may_be_rounded_to_either_neighbour(tmp_path: Path) -> None:
    """0.25 and 0.5 are 63.75 and 127.5 of 255; and 16383.75 and 32767.5 of 65535."""
    golden = small_golden(tmp_path)
    for kind, least, most in (("u1", 63, 128), ("<u2", 16383, 32768)):
        for code in (least, most):
            assert verdict(golden, flat(code).astype(kind)).is_good
        for code in (least - 1, most + 1):
            found = verdict(golden, flat(code).astype(kind))
            assert found.outside.all()
    top = np.iinfo("u1").max
    worst = verdict(golden, flat(130).astype("u1")).worst
    assert worst == Worst(0, 0, 0, 130 / top, 63 / top, 128 / top, top)


def test_bounds_are_clamped_for_whole_numbers(tmp_path: Path) -> None:
    golden = write_golden(tmp_path, write_case(tmp_path, *bounds(-8, -8)))
    assert verdict(golden, flat(0).astype("u1")).is_good
    assert not verdict(golden, flat(1).astype("u1")).is_good
    other = write_golden(tmp_path / "o", write_case(tmp_path / "o", *bounds(2, np.inf)))
    assert verdict(other, flat(255).astype("u1")).is_good
    assert not verdict(other, flat(254).astype("u1")).is_good


def test_srgb_is_of_colours_and_not_of_alpha(tmp_path: Path) -> None:
    """0.25 and 0.5 are encoded as 136.96 and 187.52 (IEC 61966-2-1)."""
    golden = small_golden(tmp_path)
    picture = flat(136).astype("u1")
    picture[..., 3] = 128
    assert verdict(golden, picture, "srgb").is_good
    picture[..., :3] = 188
    assert verdict(golden, picture, "srgb").is_good
    for lane, code in ((0, 135), (1, 189), (3, 136)):
        wrong = picture.copy()
        wrong[1, 2, lane] = code
        worst = verdict(golden, wrong, "srgb").worst
        assert worst is not None
        assert (worst.x, worst.y, worst.lane) == (2, 1, lane)


def test_the_curve_of_srgb() -> None:
    linear = np.array([0.0, 0.001, 0.0031308, 0.214041, 1.0])
    assert srgb(linear) == pytest.approx([0, 0.01292, 0.04045, 0.5, 1], abs=2e-6)


def test_the_words(tmp_path: Path) -> None:
    golden = small_golden(tmp_path)
    assert sentence(verdict(golden, flat(0.3))) == (
        "within its bounds: 6 pixels compared, 0 undecided"
    )
    picture = flat(0.3)
    picture[1, 2, 1] = 0.625
    assert sentence(verdict(golden, picture)) == (
        "outside of its bounds: 1 of 6 pixels compared, 0 undecided\n"
        "  the worst is pixel 2,1, lane 1 (g): 0.625 is not within 0.25 and 0.5"
    )
