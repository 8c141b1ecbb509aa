"""Errors about values of constants are reported only if a program can come to them.

Those that a declaration is given from elsewhere are warnings.
"""

from __future__ import annotations

import re
from collections.abc import Iterable

import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.diagnostics.render import render_all

from . import kit
from .kit import shader

FUNCTIONS = (
    "fn over(a: float, b: float) -> float = if b == 0 then 0 else a / b",
    "fn named(a: float, b: float) -> float = if b == 0 then 0 else q where { q = a / b }",
    "fn lanewise<T: floats>(a: T, b: T) -> T = choose(b == 0, 0, a / b)",
    "fn near(a: float, b: float) -> float = choose(abs(b) < 0.1, 0, 1 - (1 - a) / b)",
    "fn both(a: float, b: float) -> float = if b != 0 and a / b > 1 then 1 else 0",
    "fn swapped(a: float, b: float) -> float = if a / b > 1 and b != 0 then 1 else 0",
    "fn either(a: float, b: float) -> float = if b == 0 or a / b > 1 then 1 else 0",
    "fn model(m: int, a: float, b: float) -> float = "
    "if m == 0 then 1 else if m == 1 then a / b else over(a, b)",
    "fn total(n: int, b: float) -> float = sum i in 0..n : float(i) / b",
    "fn steady(n: int, b: float) -> float = sum i in 0..n : 1.0 / b",
    "fn looped(n: int, b: float) -> float = iterate s from 1.0 for i in 0..n : s / b",
    "fn stopped(go: bool, b: float) -> float = iterate s from 1.0 up to 9 while go : s / b",
    "fn pick(a: float[2], i: int) -> float = if i < 2 then a[i] else 0",
    "fn lane(v: vec3, i: int) -> float = if i >= 0 and i < 3 then v[i] else 0",
    "fn least(n: int, x: float) -> float = if n == 0 then 0 else min i in 0..n : x + float(i)",
    "fn long(n: int) -> float = if n > 4096 then 0 else sum i in 0..n : float(i)",
    "fn grown(x: float) -> float = if x > 80 then 0 else exp(x)",
    "fn chosen(m: int, a: float, b: float) -> float = if m == 0 then a else b",
    "struct Pair { a : float, b : float } fn first(p: Pair) -> float = p.a",
    "term term_(m: int) = if m == 1 then kd / zero else kd",
)
RIGHT = {
    "a guard": "over(uv.x, 0)",
    "a guard of constants": "over(1, 0)",
    "choose": "lanewise(uv.x, 0) + lanewise(vec3(uv, 1), vec3(0)).x",
    "choose, by a comparison": "near(uv.x, 0) + near(1, 0)",
    "a part": "named(uv.x, 0)",
    "and": "both(uv.x, 0)",
    "and, the other way round": "swapped(uv.x, 0)",
    "or": "either(uv.x, 0)",
    "a choice in a choice": "model(2, uv.x, 0) + model(0, uv.x, 0)",
    "calls in calls": "named(over(uv.x, 0), 0)",
    "a sum of nothing": "total(0, 0)",
    "a sum of nothing that does not depend on the turn": "steady(0, 0)",
    "a loop without turns": "looped(0, 0)",
    "a loop that stops at once": "stopped(false, 0)",
    "an element": "pick([1.0, 2.0], 2)",
    "a lane": "lane(vec3(uv, 1), 5)",
    "a least of nothing": "least(0, uv.x)",
    "a fold that is too long": "long(5000)",
    "overflow": "grown(100)",
    "an argument on the side that is not taken": "chosen(0, 1, 1 / zero)",
    "a slot": "if on then inverse_ else 2",
    "an element that is not taken": "if on then [1 / zero, 2.0][1] else 2",
    "a member that is not taken": "if on then first(Pair(uv.x, 1 / zero)) else 2",
    "in a loop": "sum i in 0..3 : over(float(i), 0)",
    "by the index of a loop": "sum i in 0..3 : (if i > 5 then 1 / zero else 1)",
    "by an index around": "sum i in 0..3 : (sum j in 0..3 : (if i < 5 then 1 else 1 / zero))",
    "by a range": "if few > 5 then 1 / zero else 1",
    "at the vertices": "@vertex over(position.x, 0)",
    "a term": "term_(0).x",
}
DOUBTED = {
    "a call": "a / b\nover(uv.x, 0)",
    "a side that may be taken": "a / b\nif uv.x > 0.5 then over(1, 0) else 1",
    "a part that is not read": "1 where { q = a / b }\nover(uv.x, 0)",
    "a quotient of what is doubted": "a / b\n1 / over(1, 0)",
    "what a call gives": "a * b\n1 / over(1, 0)",
}
WRONG = {
    "a side that is taken": "0\nif on then 1 else 1 / zero",
    "an argument that is not read": "1\nover(1 / zero, 2)",
    "an element that is not read": "0\n[1 / zero, 2.0][1]",
    "what is wrong with what is wrong": "0\n1 / (1 / zero)",
    "a side that one loop takes": "0\n(sum i in 0..3 : (if i > 5 then 1 / zero else 1))"
    " + (sum i in 0..9 : (if i > 5 then 1 / zero else 1))",
    "a side that the first loop takes": "0\n(sum i in 0..9 : (if i > 5 then 1 / zero else 1))"
    " + (sum i in 0..3 : (if i > 5 then 1 / zero else 1))",
    "a condition": "0\nif 1 / zero > 1 then 1 else 2",
}


def program(expression: str, functions: Iterable[str] = FUNCTIONS) -> str:
    """A material of this colour, with the functions that it calls and that these call."""
    text = expression
    for function in reversed(list(functions)):
        name = re.split("[(<]", function)[0].split()[1]
        if f"{name}(" in text:
            text = f"{function}\n{text}"
    declarations = text.removesuffix(expression)
    return f"""
{declarations}
material M {{
    param few : int in 0..4 = 2
    on : bool = false
    zero : float = 0
    inverse_ = if zero == 0 then 1 else 1 / zero
    kd = vec3(uv, 1)
    color = vec3({expression})
}}
"""


@pytest.mark.parametrize("name", RIGHT)
def test_a_side_that_is_never_taken_may_divide_by_zero(name: str) -> None:
    assert "B0415" not in warnings(program(RIGHT[name]))


@pytest.mark.parametrize("name", WRONG)
def test_what_a_program_can_come_to_is_reported_once(name: str) -> None:
    body, expression = WRONG[name].split("\n")
    functions = f"fn over(a: float, b: float) -> float = {body}"
    with pytest.raises(CompileError) as raised:
        shader(program(expression, (functions,)))
    assert [found.rule.code for found in raised.value.diagnostics] == ["B0401"]


@pytest.mark.parametrize("name", DOUBTED)
def test_a_zero_that_is_given_is_a_warning_and_told_once(name: str) -> None:
    body, expression = DOUBTED[name].split("\n")
    functions = f"fn over(a: float, b: float) -> float = {body}"
    assert warnings(program(expression, (functions,))) == ["B0415"]


def warnings(source: str) -> list[str]:
    """The codes of the warnings about a program, which is right."""
    compiled = burnish.compile(source, "glsl")
    return [found.rule.code for found in compiled.diagnostics if found.rule.code != "B0211"]


def test_a_slot_that_with_replaces_and_a_parameter_that_a_rig_sets_are_given() -> None:
    source = """light Lamp {
    param wide : float = 1
    to_light = (vec3(0, 0, 1) as direction<world>)
    radiance = vec3(1 / wide)
}
rig Stage { lamp : Lamp { wide = 0 } }
term halved() = 1 / width
term lit() per light = light.radiance
material M {
    width : float = 2
    alpha = halved() with { width = 0 }
    color = lit()
}
"""
    assert warnings(source) == ["B0415", "B0415"]


def test_an_error_is_told_where_the_same_value_was_doubted_before() -> None:
    source = "fn over(a: float, b: float) -> float = a / b\nmaterial M { color = vec3({}) }"
    for terms in ("over(uv.x, 0) + uv.x / 0", "uv.x / 0 + over(uv.x, 0)"):
        with pytest.raises(CompileError) as raised:
            shader(source.replace("{}", terms))
        assert "B0401" in [found.rule.code for found in raised.value.diagnostics]


def test_what_is_unguarded_has_no_value_for_a_zero_that_is_given() -> None:
    source = (
        "fn over(a: float, b: float) -> float = unguarded(a / b)\nmaterial M { alpha = over(1, 0) }"
    )
    with pytest.raises(CompileError, match="this divisor is always zero"):
        shader(source)


def test_a_doubted_quotient_is_zero_in_shaders_and_in_defaults() -> None:
    source = """fn over(a: float, b: float) -> float = a / b
fn left(a: int, b: int) -> int = a mod b
material M {
    param p : float in over(1, 0)..1 = over(2, 0) + float(left(7, 0))
    color = vec3(over(uv.x, 0), over(1, 0), over(uv.y, 2))
}
"""
    found = shader(source)
    (p,) = (info for info in found.parameters if info.leaf.name == "p")
    assert p.default == 0
    assert kit.color(source) == (0, 0, 0.375)


def test_all_of_them_together_come_to_one_shader() -> None:
    everything = " + ".join(f"({each})" for each in RIGHT.values())
    assert shader(program(everything)).results


def test_the_message_says_where_the_constant_comes_from() -> None:
    source = (
        "fn over(a: float, b: float) -> float = a / b\nmaterial M { color = vec3(over(uv.x, 0)) }\n"
    )
    assert render_all(burnish.compile(source, "glsl").diagnostics) == RENDERED


RENDERED = """\
warning[B0415]: this divisor is zero, by a value that is given from elsewhere
 --> <text>:1:44
  |
1 | fn over(a: float, b: float) -> float = a / b
  |                                            ^
2 | material M { color = vec3(over(uv.x, 0)) }
  |                           ------------- in `over`, called here
  = help: An argument, or a slot that another record sets, makes it zero. The quotient is 0 then, \
as for every divisor that turns out to be zero when a shader runs. Where that is meant, write it: \
`if b == 0 then 0 else a / b`."""


def test_a_vector_is_as_good_a_constant_and_calls_in_calls_are_all_named() -> None:
    source = """\
fn over(a: vec2, b: vec2) -> vec2 = a / b
fn node(a: vec2, b: vec2) -> vec2 = over(a + 1, b)
material M { color = vec3(node(uv, vec2(1, 0)).x) }
"""
    (found,) = burnish.compile(source, "glsl").diagnostics
    assert [label.text for label in found.labels] == [
        "in `over`, called here", "in `node`, called here",
    ]  # fmt: skip


def test_a_default_is_not_computed_of_a_side_that_is_not_taken() -> None:
    heavy = "sum i in 0..4096 : (sum j in 0..4096 : sin(float(i * j)))"
    found = shader(f"material M {{ param p : float = if 1 == 0 then ({heavy}) else 2 }}")
    (p,) = (info for info in found.parameters if info.leaf.name == "p")
    assert p.default == 2


def test_an_error_of_types_on_such_a_side_stays_one() -> None:
    with pytest.raises(CompileError, match="no `\\+` between vec3 and vec2"):
        shader("material M { color = if false then vec3(1) + vec2(1) else vec3(1) }")


@pytest.mark.parametrize(
    ("expression", "shown", "value"),
    [
        ("exp(100.0)", "`exp(100.0)`", "2.69e+43"),
        ("3e38 + 3e38", "`3e38 + 3e38`", "6e+38"),
        ("uv.x * pow(10, 50).x", "`pow(10, 50)`", "1e+50"),
        ("(vec3(3e38, 1, 2) * vec3(3, 1, 2)).y", "`vec3(3e38, 1, 2) * vec3(3, 1, 2)`", "9e+38"),
        ("determinant(mat2(3e38))", "`determinant(mat2(3e38))`", "9e+76"),
    ],
)
def test_a_constant_beyond_float32_is_an_error(expression: str, shown: str, value: str) -> None:
    with pytest.raises(CompileError) as raised:
        shader(f"material M {{ alpha = {expression} }}")
    (found,) = raised.value.diagnostics
    assert (found.message, found.hint) == (
        f"{shown} does not fit into float", f"it comes to {value}",
    )  # fmt: skip


def cloth(weight: str, color: str = "rgb(1, 1, 1)") -> str:
    """A material with a closure of the library."""
    return f"""burnish 1
import std.mtlx.asking.{{by_light}}
import std.mtlx.closures.{{sheen_bsdf}}
zero = 0.0
material Cloth : Surface {{
    param share : float in 0..1 = 0.5
    color = sheen_bsdf(
        by_light(vec3(normal), vec3(to_eye)), {weight}, color = {color}, normal = vec3(normal)
    ).response
}}
"""


def test_the_library_does_not_evaluate_sides_that_are_never_taken() -> None:
    nothing, something = (len(shader(cloth(weight)).graph) for weight in ("0", "share"))
    plain = len(shader("burnish 1\nmaterial Plain : Surface { color = rgb(0, 0, 0) }").graph)
    assert nothing - plain < (something - plain) / 4


def test_nothing_is_said_about_what_only_such_a_side_of_the_library_reads() -> None:
    wrong = "rgb(1, 1, 1) * over(1, zero)"
    over = "fn over(a: float, b: float) -> float = a / b\n"
    assert warnings(cloth("0", wrong) + over) == []
    assert len(warnings(cloth("share", wrong) + over)) == 1


def test_a_part_counts_where_it_is_read() -> None:
    """Here on a dead side, which a function of the library leaves out besides."""
    source = (
        "import std.mtlx.asking.{Asked, Bsdf, absorbing_volume, by_light}\n"
        "fn volume(asked: Asked, depth: float) -> Bsdf =\n"
        "    absorbing_volume(asked, if depth > 0 then within else vec3(0))\n"
        "where { within = vec3(1) / depth }\n"
        "material M { color = volume(by_light(normal, normal), 0).throughput }"
    )
    assert warnings(source) == []
    read_by_a_part = (
        "fn over(a: float, b: float) -> float = a + 1 where { one = a / b two = one + 1 }\n"
        "material M { color = vec3(over(uv.x, 0)) }"
    )
    assert "B0415" in warnings(read_by_a_part)
