"""The overload that a call means: its arguments change least, in any order of declarations."""

from __future__ import annotations

from itertools import permutations

import pytest

from burnish.compiler.diagnostics.diagnostic import CompileError

from . import kit
from .kit import number

CALLS: dict[str, tuple[tuple[str, ...], str]] = {
    # The first overload of each row is meant.
    "a number": (("x: float", "x: vec3"), "1"),
    "a number of its kind": (("x: int", "x: float", "x: uint", "x: vec3"), "1"),
    "a float before bits": (("x: float", "x: uint", "x: ivec2"), "-1"),
    "a choice": (("x: float", "x: vec2"), "if alpha > 0.5 then 1 else 2"),
    "lanes of its kind": (("x: ivec3", "x: vec3", "x: uvec3"), "1"),
    "elements": (("x: float[2]", "x: vec2[2]"), "[1, 2]"),
    "no literal": (("x: vec3", "x: float"), "position"),
    "a vector": (("x: vec3", "x: rgb"), "vec3(1)"),
    "a colour": (("x: rgb", "x: vec3"), "#ffffff"),
    "a direction": (("x: direction<world>", "x: vector<world>", "x: vec3"), "to_eye"),
    "a normal": (("x: direction<world>", "x: vector<world>", "x: vec3"), "normal"),
    "one as a vector": (("x: vector<world>", "x: vec3"), "to_eye"),
    "one of two": (("x: vec3, y: float", "x: vec3, y: vec3"), "1, 2"),
    "the worst counts": (("x: float, y: float", "x: int, y: vec3"), "1, 2"),
    "a type before any": (("x: float", "<T: floats>(x: T)"), "1.5"),
    "any before another": (("<T: numbers>(x: T)", "x: float"), "1"),
    "a part of a type": (("<S: spaces>(x: point<S>)", "<T: vectors>(x: T)"), "position"),
    "vectors before any": (("<N: widths>(x: vec<float, N>)", "<T: floats>(x: T)"), "uv"),
    "fewer type parameters": (
        ("<A: spaces>(x: transform<A, clip>)", "<A: spaces, B: spaces>(x: transform<A, B>)"),
        "view_projection",
    ),
}


@pytest.mark.parametrize(("overloads", "arguments"), CALLS.values(), ids=CALLS)
def test_the_least_change_wins_in_any_order(overloads: tuple[str, ...], arguments: str) -> None:
    for order in permutations(range(len(overloads))):
        heads = (
            overloads[i] if overloads[i].startswith("<") else f"({overloads[i]})" for i in order
        )
        bodies = zip(heads, order, strict=True)
        functions = "\n".join(f"fn f{head} -> float = {10.0 + number}" for head, number in bodies)
        assert number("k", f"k = f({arguments})", functions) == 10


def test_what_nothing_decides_is_told() -> None:
    functions = "fn f(x: vec2) -> float = 1.0\nfn f(x: vec3) -> float = 2.0"
    with pytest.raises(CompileError) as caught:
        number("k", "k = f(1)", functions)
    (found,) = caught.value.diagnostics
    assert found.message == "several functions `f` take (int) equally well"
    assert len(found.labels) == 2


BY_RESULT = """\
fn noise(p: vec2, scale: float = 1) -> float = scale
fn noise(p: vec2, scale: float = 1) -> vec3 = vec3(2, 3, 4)
fn noise(p: vec2, scale: float = 1) -> rgb = rgb(5, 6, 7)
fn both(v: vec2, w: vec3) -> float = v.x + w.y
fn one(x: float) -> float = x
fn one(x: int) -> float = 100.0
fn given(p: vec2) -> vec3 = noise(p)
fn later(p: vec2) -> vec3 = part where { part : vec3 = noise(p) }
fn preset(v: vec3 = noise(vec2(1))) -> float = v.z
struct Pair { one : float, two : vec3 }
fixed : vec3 = noise(vec2(0))
material M : Surface {
    param start : rgb = noise(vec2(0))
    slot : vec3 = noise(uv)
    color = vec3(EXPRESSION)
}
"""
WANTED = {
    "an argument": ("both(uv, noise(uv))", 3.25),
    "an argument of overloads": ("one(noise(uv, scale = 8))", 8.0),
    "a named argument": ("both(w = noise(uv), v = uv)", 3.25),
    "a result": ("given(uv).x", 2.0),
    "a part": ("later(uv).y", 3.0),
    "a default": ("preset()", 4.0),
    "a written type": ("(noise(uv, 9) as float)", 9.0),
    "a written meaning": ("(noise(uv) as rgb).x", 5.0),
    "a constant": ("fixed.x", 2.0),
    "a parameter": ("start.r", 5.0),
    "a slot": ("slot.y", 3.0),
    "members of a structure": ("Pair(noise(uv), noise(uv)).two.z", 4.0),
    "another side": ("(if uv.x > 0 then noise(uv) else vec3(9)).x", 2.0),
    "another side in front": ("(if uv.x < 0 then vec3(9) else noise(uv)).x", 2.0),
    "both sides": ("one(if uv.x > 0 then noise(uv, 6) else noise(uv.yx))", 6.0),
    "a literal beside it": ("one(if uv.x > 0 then 1 else noise(uv))", 1.0),
}


@pytest.mark.parametrize("name", WANTED)
def test_of_equal_arguments_the_wanted_result_decides(name: str) -> None:
    expression, expected = WANTED[name]
    assert kit.color(BY_RESULT.replace("EXPRESSION", expression))[0] == expected


def test_a_call_of_a_type_that_there_is_not_is_told_once() -> None:
    with pytest.raises(CompileError) as raised:
        kit.shader(BY_RESULT.replace("EXPRESSION", "(noise(uv) as float9)"))
    assert [one.rule.code for one in raised.value.diagnostics] == ["B0201"]


def test_functions_of_equal_arguments_need_different_written_results() -> None:
    for first, second in (("float", "float"), ("float", ""), ("", "")):
        results = [f" -> {each}" if each else "" for each in (first, second)]
        text = "".join(f"fn f(x: float){result} = x\n" for result in results)
        with pytest.raises(CompileError) as raised:
            kit.shader(f"{text}material M : Surface {{ alpha = f(1) }}")
        assert raised.value.diagnostics[0].message == "`f` is declared twice"


def test_both_of_two_results_may_be_used() -> None:
    text = BY_RESULT.replace("EXPRESSION", "(noise(uv, 4) as float) * (noise(uv) as vec3)")
    assert kit.color(text) == (8, 12, 16)
