"""The rendered text of the explanation of a pixel's error."""

from __future__ import annotations

import math
from dataclasses import replace

from burnish.compiler.diagnostics.source import Source, Span
from burnish.compiler.reference.attribution.explanation import (
    Explanation,
    Expression,
    Kind,
    Loss,
    Tipping,
)
from burnish.targets.conformance.error_words import blamed, causes, lines, small

TEXT = "material M {\n    wave  = sin(uv.x)\n    color = vec3(fract(wave * 9000))\n}\n"
SOURCE = Source("m.burnish", TEXT)


def expression(
    text: str, value: float, error: float, own: float = 0.0, part: float = 0.0,
    magnification: float = 1.0, kind: Kind = "operation",
) -> Expression:  # fmt: skip
    """An expression that stands in the text."""
    start = TEXT.index(text)
    span = Span(SOURCE, start, start + len(text))
    return Expression(text, kind, span, (value,), error, own, part, magnification)


SINE = expression("sin(uv.x)", 0.5, 6e-4, own=5e-4, part=0.9, magnification=1800.0)
PLACE = expression("uv", 0.25, 2e-6, 2e-6, 0.1, 3.0, kind="interpolation")
PRODUCT = expression("wave * 9000", 4500.25, 1.25, own=5e-4, part=0.0005)
FRACTION = expression("fract(wave * 9000)", 0.25, 0.9)
FOUND = Explanation(
    36, 28, 0, 1, (0.75, 0.25, 1.0), 1.0,
    contributions=(SINE, PLACE, PRODUCT),
    losses=(Loss(FRACTION, 18000.0), Loss(PRODUCT, 99.5)),
    tippings=(Tipping(FRACTION, "a whole number", True, 0.25, 1.25, 1.0),),
    way=(FRACTION, PRODUCT, SINE),
)  # fmt: skip

WHOLE = """\
rounding may change g = 0.25 by 1, to first order

where precision is lost:
  `fract(wave * 9000)` magnifies rounding 2·10^4 times (m.burnish:3)
  `wave * 9000` magnifies rounding 99.5 times (m.burnish:3)

what contributes:
  part  own error  magnified     expression
  90%   5.0e-04    2·10^3 times  `sin(uv.x)` (m.burnish:2)
  10%   2.0e-06    3 times       `uv` (m.burnish:2)
  <1%   5.0e-04    1 times       `wave * 9000` (m.burnish:3)

the way of the largest contribution:
                                      value    error
  `fract(wave * 9000)` (m.burnish:3)  0.25     0.9
  └ `wave * 9000` (m.burnish:3)       4500.25  1.25
    └ `sin(uv.x)` (m.burnish:2)       0.5      6.0e-04
"""


def test_the_whole_explanation() -> None:
    assert "".join(f"{line}\n" for line in lines(FOUND)) == WHOLE


def test_an_exact_pixel() -> None:
    exact = replace(FOUND, error=0.0, contributions=(), losses=(), tippings=(), way=())
    assert list(lines(exact)) == ["rounding may change g = 0.25 by 0, to first order"]
    assert list(causes(exact)) == list(blamed(exact)) == []


def test_causes() -> None:
    """The worst loss, the worst jump of another expression, and an inaccurate operation."""
    assert list(causes(FOUND)) == [
        "`fract(wave * 9000)` magnifies rounding 2·10^4 times (m.burnish:3)",
        "`sin(uv.x)` may itself be off by 5.0e-04 (m.burnish:2)",
    ]
    rough = replace(PLACE, own=0.002)
    without = replace(FOUND, losses=(), contributions=(rough,))
    assert list(causes(without)) == [
        "the operand of `fract(wave * 9000)` may be off by 1.25: anything may follow (m.burnish:3)",
        "`uv` is interpolated, and may be off by 0.002 (m.burnish:2)",
    ]


def test_what_overflows_comes_first() -> None:
    """All that follows may be anything, and what else is said of the pixel matters less."""
    found = replace(FOUND, overflows=(PRODUCT,))
    told = "`wave * 9000` is too large for float32: anything may follow (m.burnish:3)"
    assert next(causes(found)) == told
    assert list(lines(found))[2:4] == ["what overflows:", f"  {told}"]


def test_wide_bounds_without_a_cause() -> None:
    assert small(replace(FOUND, error=1.1e-4), 0.25) == (
        "no expression magnifies rounding much: at (36, 28) it amounts to 1.1e-04, to first order, "
        "but the bounds are 0.25 wide, as they do not see how errors cancel out"
    )


def test_jumps() -> None:
    """A message gives the distance of a jump, and its effect on the pixel."""
    close = Tipping(FRACTION, "a whole number", True, 2e-7, 5e-7, 0.75)
    discards = replace(close, effect=math.inf)
    found = replace(FOUND, losses=(), tippings=(close, discards))
    start = "  `fract(wave * 9000)` is 2.0e-07 from a whole number, and may be off by 5.0e-07: "
    assert [line for line in lines(found) if "whole number" in line] == [
        f"{start}the pixel would change by 0.75 (m.burnish:3)",
        f"{start}the pixel would be discarded (m.burnish:3)",
    ]


def test_jumps_that_change_nothing_by_themselves() -> None:
    """A jump is told if there is no better cause, as the bounds allow for several jumps at once."""
    tie = Tipping(FRACTION, "equality", False, 0.0, 5e-7, 0.0)
    found = replace(FOUND, losses=(), contributions=(), tippings=(tie,))
    assert list(causes(found)) == [
        "`fract(wave * 9000)` is 0 from equality, and may be off by 5.0e-07: the bounds are those "
        "of both sides, though this alone changes nothing (m.burnish:3)"
    ]
    assert tie.words not in "".join(causes(replace(FOUND, tippings=(tie,))))


def test_blame() -> None:
    """One operation is to blame if it explains nearly all of the error."""
    assert list(blamed(FOUND)) == ["90% of what it may be off is due to `sin(uv.x)` (m.burnish:2)"]
    assert list(blamed(replace(FOUND, error=2.0))) == []
