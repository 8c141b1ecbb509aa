"""A slot may be a constant or a parameter: what a base computes from it is right with both, or
with none."""

from __future__ import annotations

import pytest

import burnish
from burnish import CompileError

USES = {
    ("int", "3"): (
        "vec3(s * 0.5)",
        "vec3(float(s) * 0.5)",
        "vec3(uv, float(s mod 2))",
        "s * uv.xxx",
    ),
    ("float", "0.5"): ("s", "vec3(s)", "s * vec3(1)", "vec3(uv, s)", "max(vec3(uv, 1), s)"),
    ("uint", "3"): ("vec3(s * 0.5)", "vec3(float(s))", "vec3(float(s + 1))"),
    ("int[2]", "[1, 2]"): ("vec3(s[0] * 0.5)", "vec3(float(s[1]))"),
    ("bool", "true"): ("if s then vec3(1) else vec3(0)", "vec3(float(s))"),
}
"""Expressions by the type and the value of the slot that they read."""


def compiles(text: str) -> bool:
    try:
        burnish.compile(text, ())
    except CompileError:
        return False
    return True


@pytest.mark.parametrize(
    ("type_", "value", "use"), [(*slot, use) for slot, uses in USES.items() for use in uses]
)
def test_a_parameter_may_take_the_place_of_a_constant(type_: str, value: str, use: str) -> None:
    base = f"abstract material A {{ s : {type_} = {value}  color = {use} }}\n"
    constant = compiles(base + "material M : A {}")
    assert constant == compiles(base + f"material M : A {{ param s : {type_} }}")
    # An equation of its own keeps the type as well.
    assert constant == compiles(base + f"material M : A {{ s = {value} }}")
