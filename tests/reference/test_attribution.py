"""The way of the error: which operations make a pixel inexact, and where in the source."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import Any

import numpy as np
import pytest

from burnish.compiler.reference.attribution import Explanation, UncoveredError, explain
from burnish.compiler.reference.bounds import Errors
from burnish.compiler.reference.picture import RasterRules, Texels
from burnish.compiler.reference.picture.scene import Derivatives

from .kit import WHITE, defaults
from .test_drawing import FULL, passing, triangles

RULES = RasterRules(8, 8, varying_bits=22, subtexel_bits=8)
NEAR = 0.4374999
TRIANGLE = triangles(*FULL, s=[(0, 0), (2, 0), (0, 2)], t=[-NEAR, 2 - NEAR, -NEAR])
"""In pixel (x, y), ``s`` is ((x + 0.5) / 8, (7.5 - y) / 8), and ``t`` nearly 0 where x is 3."""


def _one_step(_name: str, _operand: Any, result: Any) -> Any:
    return 2.0**-23 * np.abs(result)


def explained(
    members: str,
    x: int = 3,
    y: int = 4,
    errors: Errors = _one_step,
    discard: str = "",
    texture: Texels = WHITE,
    rules: RasterRules = RULES,
) -> Explanation:
    """Explain one pixel of a material that draws ``value``; ``s`` is interpolated."""
    given = passing(f"attribute s : vec2\nattribute t : float\n{members}", discard=discard)
    textures = {info.leaf.name: texture for info in given.textures}
    return explain(given, defaults(given), textures, TRIANGLE, rules, errors, x, y)


ILL_CONDITIONED = {
    "a hash": (
        "value = vec4(fract(sin(s.x * 12.9898) * 43758.5453))",
        "fract(sin(s.x * 12.9898) * 43758.5453)", 1e4,
    ),
    "a large number comes and goes": (
        "value = vec4((s.x * 0.01 + 3000) - 3000)",
        "(s.x * 0.01 + 3000) - 3000", 1e4,
    ),
    "a root near zero": (
        "value = vec4(sqrt(abs(t)))",
        "sqrt(abs(t))", 1e3,
    ),
    "a vector of nearly no length": (
        "value = vec4(normalize(vec3(t, 1e-7, 0)), 1)",
        "normalize(vec3(t, 1e-7, 0))", 1e5,
    ),
    "the edge of a cone": (
        "param inner : float = 0.9000001\nparam outer : float = 0.9\n"
        "value = vec4(smoothstep(outer, inner, s.x * 2 + 0.02500005))",
        "smoothstep(outer, inner, s.x * 2 + 0.02500005)", 1e4,
    ),
    "cancellation": (
        "value = vec4((1 - cos(s.x * 1e-3)) / (s.x * s.x) * 2e6)",
        "1 - cos(s.x * 1e-3)", 1e4,
    ),
}  # fmt: skip


@pytest.mark.parametrize(("members", "guilty", "least"), ILL_CONDITIONED.values(),
                         ids=list(ILL_CONDITIONED))  # fmt: skip
def test_the_place_where_precision_is_lost(members: str, guilty: str, least: float) -> None:
    found = explained(members)
    worst = found.losses[0]
    assert worst.expression.text == guilty
    span = worst.expression.span
    assert span is not None and " ".join(span.text.split()) == guilty
    assert least < worst.times < 1e9
    assert found.way[0].text == guilty or guilty in {part.text for part in found.way}


def test_errors_add_up_to_first_order() -> None:
    """Each operation contributes its own error times the slope of what follows."""
    found = explained("value = vec4(s.x * s.x * 5, 0, 0, 1)")
    off = {part.text: part for part in found.contributions}
    x, interpolated = 3.5 / 8, off["s"].own
    assert interpolated >= 2.0 * 2.0**-22
    assert found.target == found.lane == 0 and found.value[0] == 5 * x * x
    assert off["s"].contribution == pytest.approx(interpolated * 2 * x * 5, rel=1e-5)
    assert off["s"].magnification == pytest.approx(2, rel=1e-5)
    assert sum(part.contribution for part in found.contributions) == pytest.approx(found.error)
    # A square of 3.5 / 8 is a float32, and so is five times that: neither is rounded.
    assert set(off) == {"s"} and found.losses == ()


def test_what_does_not_matter_is_no_loss() -> None:
    """A difference that is nearly zero by chance, and is added to something larger."""
    found = explained("value = vec4(3 + (s.x - 0.4374999))")
    assert found.losses == ()
    assert found.error < 2e-6


def test_an_inaccurate_function_is_the_source() -> None:
    def errors(name: str, operand: Any, result: Any) -> Any:
        return 2.0**-11 if name == "sin" else _one_step(name, operand, result)

    found = explained("value = vec4(0.5 + 0.5 * sin(s.x))", errors=errors)
    worst = found.contributions[0]
    assert worst.text == "sin(s.x)" and worst.own == pytest.approx(2.0**-11, rel=1e-3)
    assert worst.contribution == pytest.approx(2.0**-12, rel=1e-3)
    assert [part.text for part in found.way] == [
        "0.5 + 0.5 * sin(s.x)", "0.5 * sin(s.x)", "sin(s.x)",
    ]  # fmt: skip


JUMPS = {
    "value = vec4(floor(s.x * 8 - 0.4999999))": ("floor(s.x * 8 - 0.4999999)", "a whole number", 1),
    "value = vec4(if s.x < 0.43750001 then 0.25 else 0.75)": (
        "s.x < 0.43750001", "equality", 0.5,
    ),
    "value = vec4(step(0.43750001, s.x) * 3)": ("step(0.43750001, s.x)", "its edge", 3),
    "value = vec4(float(int(s.x * 16 + 1e-7)))": ("int(s.x * 16 + 1e-7)", "a whole number", 1),
    "value = vec4(s.x mod 0.21875001)": ("s.x mod 0.21875001", "a multiple", 0.21875001),
}  # fmt: skip


@pytest.mark.parametrize("members", JUMPS)
def test_jumps_that_rounding_may_tip(members: str) -> None:
    text, words, effect = JUMPS[members]
    (tipping,) = explained(members).tippings
    assert tipping.expression.text == text and tipping.words.startswith(words)
    assert tipping.distance < tipping.error < 1e-4
    assert tipping.effect == pytest.approx(effect, rel=1e-3)


def test_a_jump_that_is_far_away_cannot_tip() -> None:
    assert explained("value = vec4(floor(s.x * 8 + 0.1))").tippings == ()


def test_loops_functions_and_the_vertex_stage() -> None:
    """Turns of one expression count together; its place is where it is written."""
    found = explained(
        "value = vec4(sum i in 0..4 : sqrt(s.x + float(i) * 0.3) + (at_vertex - at_vertex * 0.999))"
        "\nat_vertex = @vertex (s.x * 1.7)"
    )
    texts = [part.text for part in found.contributions]
    assert "sqrt(s.x + float(i) * 0.3)" in texts and "s.x * 1.7" in texts
    assert len(texts) == len({(part.text, str(part.span)) for part in found.contributions})


def test_reads_of_textures_round_the_place_that_they_filter() -> None:
    """Between a black and a white texel, a step of the filter is a step of grey."""
    texels = np.zeros((1, 2, 4))
    texels[:, 1] = 1.0
    found = explained(
        "map grey : texture2d\nvalue = grey(vec2(s.x, 0.5))", texture=Texels((texels,))
    )
    (read,) = [part for part in found.contributions if part.text == "grey(vec2(s.x, 0.5))"]
    assert found.value == pytest.approx([2 * 3.5 / 8 - 0.5] * 4)
    assert 2.0**-9 <= read.own < 2.0**-7 and read.contribution == pytest.approx(read.own)
    (place,) = [part for part in found.contributions if part.text == "s"]
    assert place.contribution == pytest.approx(2 * place.own, rel=1e-3)


def test_derivatives_see_the_errors_of_two_pixels() -> None:
    found = explained("value = vec4(ddx(s.x), 0, 0, 1)")
    assert found.value[0] == 0.125
    (place,) = [part for part in found.contributions if part.text == "s"]
    assert place.contribution == pytest.approx(2 * place.own, rel=1e-3)


@pytest.mark.parametrize(("derivatives", "row"), [("own", 5.5), ("first", 4.5), ("any", 5.5)])
def test_derivatives_are_those_that_the_device_takes(derivatives: Derivatives, row: float) -> None:
    """``s.x`` grows by an eighth a pixel. If nothing is known, the other row's is an error."""
    rules = replace(RULES, derivatives=derivatives)
    found = explained("value = vec4(ddx(s.x * frag_coord.y), 0, 0, 1)", y=5, rules=rules)
    assert found.value[0] == pytest.approx(row / 8)
    assert (found.error > 0.1) == (derivatives == "any")


def test_the_derivative_of_what_is_the_same_everywhere_is_exact() -> None:
    found = explained("param gain : float = 0.3\nvalue = vec4(ddx(sqrt(gain)) + s.x, 0, 0, 1)")
    assert {part.text for part in found.contributions} <= {"s", "ddx(sqrt(gain)) + s.x"}


def test_an_operation_is_as_inexact_as_in_the_pixel_and_not_beside_it() -> None:
    """The curve is exactly zero in this pixel, but not in the next one of its quad."""
    found = explained("value = vec4(smoothstep(0, 0.5, 0.4 - s.x), 0, 0, 1)")
    assert found.value[0] == 0 and found.error == 0


def test_a_pixel_that_may_be_discarded() -> None:
    """A comparison that may tip is no small error: it is not one of the contributions."""
    found = explained("value = vec4(s, 0, 1)", discard="discard when material.value.x < 0.43749999")
    (tipping,) = found.tippings
    assert tipping.expression.text == "material.value.x < 0.43749999"
    assert math.isinf(tipping.effect) and found.error < 1e-5


def test_values_beyond_float32() -> None:
    """An infinite value has no slope; the rest is explained."""
    found = explained("value = vec4(exp(s.x * 5000), s.x * 1.7, 0, 1)")
    assert math.isfinite(found.error)


def test_the_first_of_the_operations_that_overflow() -> None:
    found = explained("value = vec4(1 / (1 + exp(200 * s.x + 30) * exp(100 * s.x)))")
    assert [one.text for one in found.overflows] == ["exp(200 * s.x + 30)"]
    assert explained("value = vec4(exp(s.x))").overflows == ()


def test_pixels_that_nothing_covers() -> None:
    with pytest.raises(UncoveredError):
        explained("value = vec4(s, 0, 1)", discard="discard when material.value.x < 0.9")
