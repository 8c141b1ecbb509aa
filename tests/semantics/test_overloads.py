"""The overload that a call means: its arguments change least, in any order of declarations."""

from __future__ import annotations

from itertools import permutations

import pytest

from burnish.compiler.diagnostics.diagnostic import CompileError

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
