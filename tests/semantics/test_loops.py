"""Folds over run-time counts, and states from turn to turn, by value."""

from __future__ import annotations

import pytest

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.namespace import Lanes

from .kit import lanes, number, shader

HEAD = """
struct Walk { place : vec2, length : float, steps : int }
fn collatz(n: int) -> int = if n mod 2 == 0 then n / 2 else 3 * n + 1
"""
MEMBERS = """
param n : int in 0..8
param any_number : int
param x : float
param w : float[4]
"""
GIVEN: dict[str, Lanes] = {
    "n": (3,), "any_number": (-5,), "x": (0.25,), "w": ((4.0,), (-1.0,), (3.0,), (9.0,)),
}  # fmt: skip
VALUES: dict[str, float] = {
    "sum i in 0..n : float(i)": 3,
    "sum i in 0..n + 1 : w[i]": 15,
    "sum i in n..2 * n : float(i)": 12,
    "sum i in n..1 : float(i)": 0,
    "sum i in 0..n from 0.5 : 1.0": 3.5,
    "product i in 1..n : float(i) + x": 1.25 * 2.25,
    "sum i in 0..any_number up to 8 : 1.0": 0,
    "sum i in any_number..4 up to 4 : float(i)": -5 - 4 - 3 - 2,
    "sum i in 0..12 up to 5 : 1.0": 5,
    "sum i in 0..clamp(any_number + 9, 0, 6) : 1.0": 4,
    "min i in 0..n from 5 : w[i]": -1,
    "min i in 0..0 from 5 : w[i]": 5,
    "max i in 0..4 : w[i]": 9,
    "max i in 1..3 : w[i]": 3,
    "min i in 2..3 : w[i]": 3,
    "float(min i in 0..n from 5 : i - 2)": -2,
    "float(any i in 0..n : w[i] < 0.0)": 1,
    "float(any i in 0..0 : true)": 0,
    "float(all i in 0..n : w[i] < 4.0)": 0,
    "float(all i in 1..n : w[i] < 4.0)": 1,
    "sum i in 0..n : (sum j in 0..i : w[j])": 4 + 3,
    "iterate t from 1.0 up to 3 : 2 * t": 8,
    "iterate t from 1.0 up to n : 2 * t": 8,
    "iterate t from 1.0 up to 16 while t < 30.0 : 2 * t": 32,
    "iterate t from 1.0 up to 16 while false : 2 * t": 1,
    "iterate t from 1.0 for i in 0..n : t + float(i)": 4,
    "iterate t from 1.0 for i in n..n + 2 : t + float(i)": 8,
    "iterate t from 1.0 for i in 0..any_number up to 9 : 2 * t": 1,
    "float(iterate k from 7 up to 99 while k != 1 : collatz(k))": 1,
    "(iterate p from vec2(1, 2) up to 3 : p.yx).x": 2,
    "(iterate m from mat2(1) up to 3 : m * mat2(2))[1].y": 8,
    "(iterate l from Walk(vec2(0), 0, 0) up to 9 while l.length < 3.5 : "
    "Walk(l.place + 1, length(l.place), l.steps + 1)).length": 2**0.5 * 3,
    "float((iterate l from Walk(vec2(0), 0, 0) up to 9 while l.length < 3.5 : "
    "Walk(l.place + 1, length(l.place), l.steps + 1)).steps)": 4,
    "(iterate f from [0.0, 1.0] up to 10 : [f[1], f[0] + f[1]])[0]": 55,
    "(iterate a from [1.0, x] up to 3 : [a[0] * 2, a[1]])[1]": 0.25,
    "iterate t from x up to 3 : t": 0.25,
    "iterate a from 0.0 up to 3 : (iterate b from a up to 2 : b + 1)": 6,
    "iterate a from 0.0 for i in 0..3 : (sum j in 0..i : a + float(j)) + 1": 6,
}  # fmt: skip


@pytest.mark.parametrize(("text", "expected"), VALUES.items(), ids=VALUES)
def test_values(text: str, expected: float) -> None:
    assert number(text, MEMBERS, HEAD, **GIVEN) == pytest.approx(expected)


def test_lights_inside_of_loops() -> None:
    text = """
    import std.lights
    term counted() per light = vec3(light.falloff * 2)
    material M { color = iterate c from vec3(0) up to 3 : c + counted() }
    rig R { a : Point, b : Point[3] }
    """
    assert shader(text).results_of(TARGET)


def test_loops_inside_of_lights() -> None:
    text = "sum i in 0..3 : 1.0"
    head = "light Steps : Light { to_light = vec3(0, 1, 0); falloff = sum i in 0..3 : float(i) }"
    assert number(text, "", head) == 3


WORDS = (
    "min",
    "max",
    "any",
    "all",
    "sum",
    "product",
    "iterate",
    "from",
    "up",
    "to",
    "while",
    "for",
)


@pytest.mark.parametrize("word", WORDS)
def test_words_of_loops_are_names_elsewhere(word: str) -> None:
    assert number(f"{word} + 1", f"{word} = x * 2\nparam x : float", x=(3.0,)) == 7
    head = f"fn twice({word}: float) -> float = 2 * {word}"
    assert number("twice(4)", "", head) == 8


def test_a_words_call_is_that_of_the_builtin() -> None:
    assert lanes("vec3(min(1.0, 2), max(1.0, 2), iterate)", "iterate = min(3.0, 4)") == (1, 2, 3)


def test_one_failure_is_told_once() -> None:
    text = "material M { color = vec3(iterate x from nothing up to 4 while x < 1 : x + 1) }"
    with pytest.raises(CompileError) as caught:
        shader(text)
    assert [found.rule.code for found in caught.value.diagnostics] == ["B0201"]


def size(text: str) -> int:
    """The number of nodes in a material's shader."""
    return len(shader(text).graph)


@pytest.mark.parametrize("word", ["min", "max"])
def test_extremes_in_extremes_grow_with_their_number(word: str) -> None:
    def nested(levels: int) -> str:
        value = "sin(uv.x)"
        for i in range(levels):
            value = f"({word} i{i} in 0..5 : cos({value} + float(i{i})))"
        return f"material M {{ alpha = {value} }}"

    assert size(nested(16)) - size(nested(8)) == 2 * (size(nested(8)) - size(nested(4)))


def test_folds_of_crossings_are_written_out_so_far_only() -> None:
    def nested(levels: int) -> str:
        sums = " + ".join(f"{i}.5 * float(i{i})" for i in range(levels))
        value = f"@vertex sin(uv.x * ({sums}))"
        for i in range(levels):
            value = f"(sum i{i} in 0..8 : {value})"
        return f"material M {{ alpha = {value} }}"

    assert size(nested(2)) > 128
    with pytest.raises(CompileError) as caught:
        shader(nested(5))
    (error,) = caught.value.diagnostics
    assert error.message == "a value that changes in a loop cannot be computed at the vertices"


def test_loops_of_called_functions_nest_in_those_around_the_call() -> None:
    def nested(levels: int) -> str:
        functions = "\n".join(
            f"fn f{i}(x: float) -> float = sum i in 0..3 : f{i + 1}(x + float(i))"
            for i in range(levels)
        )
        last = f"fn f{levels}(x: float) -> float = sin(x)"
        return f"{functions}\n{last}\nmaterial M {{ alpha = f0(uv.x) }}"

    assert shader(nested(48))
    with pytest.raises(CompileError) as caught:
        shader(nested(49))
    (error,) = caught.value.diagnostics
    assert error.message == "loops are nested too deeply: more than 48"


@pytest.mark.parametrize("first", ["uv.x", "sum i in 0..3 : chain(uv.x + float(i))"])
def test_loops_that_read_others_are_not_nested(first: str) -> None:
    """Neither by themselves nor in a loop around all of them."""
    links = "\n".join(f"s{k} = sum j in 0..9 : sin(s{k - 1} * float(j))" for k in range(1, 60))
    chain = f"fn chain(s0: float) -> float = s59 where {{\n{links}\n}}"
    assert shader(f"{chain}\nmaterial M {{ alpha = chain({first}) }}")
