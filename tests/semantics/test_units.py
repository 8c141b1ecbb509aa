"""Numbers with units: angles in radians, lengths in metres."""

from __future__ import annotations

from fractions import Fraction
from math import pi

import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.units import LENGTHS, UNITS, value_of

from . import kit

VALUES = {
    "5mm * 1000": 5.0,
    "1km / 1000m": 1.0,
    "12in / 1ft": 1.0,
    "5280ft / 1mi": 1.0,
    "3ft / 1yd": 1.0,
    "1.5e3nm / 1um": 1.5,
    "100cm": 1.0,
    "0.25turn": pi / 2,
    "90deg + 0.25turn": pi,
    "0.5rad": 0.5,
    "(if uv.x > 0 then 1mm else 1m) * 1000": 1.0,
    "width": 0.005,
}


@pytest.mark.parametrize("expression", VALUES)
def test_numbers_with_units(expression: str) -> None:
    text = "param width : float in 1mm..10cm = 5mm"
    found = kit.color(f"material M : Surface {{ {text}  color = vec3({expression}) }}")[0]
    assert found == pytest.approx(VALUES[expression], rel=1e-15)


@pytest.mark.parametrize("unit", LENGTHS)
def test_lengths_are_rounded_once(unit: str) -> None:
    for digits in ("0.1", "1", "3.3", "123456.789", "7e-3"):
        assert value_of(digits, unit) == float(Fraction(digits) * Fraction(LENGTHS[unit]))


HINTS = {
    "5px": "units are `deg`, `rad`, `turn` for angles and `nm`, `um`, `mm`, `cm`, `m`, `km`, `in`, "
    "`ft`, `yd`, `mi` for lengths",
    "3millimeters": "write `3mm`",
    "2Inches": "write `2in`",
    "0.5turns": "write `0.5turn`",
    "40degrees": "write `40deg`",
    "5 mm": "a length is one word: `5mm`",
    "5 deg": "an angle is one word: `5deg`",
}


@pytest.mark.parametrize("number", HINTS)
def test_other_ways_to_write_a_unit_are_told(number: str) -> None:
    with pytest.raises(CompileError) as raised:
        kit.shader(f"material M : Surface {{ alpha = sin({number}) }}")
    assert raised.value.diagnostics[0].hint == HINTS[number]


def test_a_length_is_no_angle() -> None:
    with pytest.raises(CompileError, match="is not an angle"):
        kit.shader("material M : Surface { param cone : angle = 5mm  alpha = cone }")


def test_a_host_sets_lengths_and_angles_with_their_units() -> None:
    compiled = burnish.compile(
        "material M : Surface { param width : float in 0m..1m = 5mm  param cone : angle = 5deg\n"
        "    alpha = width * cone }",
        "glsl",
    )
    instance = compiled.materials[0].instance()
    instance.set("width", "2cm")
    instance.set("cone", "0.5turn")
    assert instance.get("width") == pytest.approx(0.02, rel=1e-6)
    assert instance.get("cone") == pytest.approx(pi, rel=1e-6)
    for name, wrong in (("width", "2deg"), ("cone", "2cm"), ("width", "mm"), ("width", "2px")):
        with pytest.raises(ValueError, match=name):
            instance.set(name, wrong)


def test_the_grammar_has_all_units() -> None:
    for unit in UNITS:
        assert kit.color(f"material M : Surface {{ color = vec3(1{unit} / 1{unit}) }}")[0] == 1
