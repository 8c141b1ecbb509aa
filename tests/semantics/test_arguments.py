"""Arguments by name, and defaults of those that calls leave out."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError

from .kit import color, lanes, number

WEIGHED = "fn w(a: float, b: float = 20, c: float = 300) -> float = a + b + c"
CALLS: dict[str, tuple[str, str, float]] = {
    "by position": (WEIGHED, "w(1, 2, 3)", 6),
    "the last left out": (WEIGHED, "w(1, 2)", 303),
    "all with a default left out": (WEIGHED, "w(1)", 321),
    "one in the middle left out": (WEIGHED, "w(1, c = 3)", 24),
    "in another order": (WEIGHED, "w(c = 3, a = 1, b = 2)", 6),
    "a comma at the end": (WEIGHED, "w(1, c = 3,)", 24),
    "over several lines": (WEIGHED, "w(\n    1,\n    c = 3,\n    b = 2\n)", 6),
    "a call in an argument": (WEIGHED, "w(1, b = w(0, c = 0), c = 0)", 21),
    "several calls": (WEIGHED, "w(1) - w(1, 2) + w(c = 3, a = 1)", 321 - 303 + 24),
    "a name that is one outside, too": (WEIGHED, "w(b = b, a = 5) - b", 305),
    "only defaults": ("fn f(a: float = 2, b: float = 3) -> float = a - b", "f() + f(b = 1)", 0),
    "no default behind one": ("fn f(a: float = 2, b: float) -> float = a - b", "f(b = 5)", -3),
    "an expression": ("fn f(a: float = 2 * sqrt(4)) -> float = a", "f()", 4),
    "a constant of the file": ("k = 3.0\nfn f(a: float = k) -> float = a", "f()", 3),
    "a constant, not the slot": ("b = 3.0\nfn f(a: float = b) -> float = a", "f() + b", 5),
    "a function": ("fn g() -> float = 7\nfn f(a: float = g()) -> float = a", "f()", 7),
    "one before": ("fn f(a: float, b: float = 2 * a) -> float = a + b", "f(1) + f(2)", 9),
    "one before by name": (
        "fn f(a: float, b: float = 2 * a) -> float = a + b", "f(a = uv.y)", 2.25,
    ),
    "one before that is left out": (
        "fn f(a: float = 3, b: float = 2 * a, c: float = a + b) -> float = c", "f() + f(b = 1)",
        13,
    ),
    "a loop with its name": (
        "fn f(a: int = sum b in 0..3 : b, b: int = 5) -> float = float(a * b)", "f()", 15,
    ),
    "adapted to its type": ("fn f(a: vec2 = vec2(1), b: float = 2) = a.x / b", "f()", 0.5),
    "of any type": (
        "fn f<T: floats>(a: T, k: T = 2) -> T = a * k", "f(3) + f(vec2(1, 4)).y", 14,
    ),
    "of any type by name": (
        "fn f<T: floats>(a: T, k: T = 2) -> T = a - k", "f(k = 3, a = uv).x", -2.75,
    ),
    "with a number of its type": (
        "fn f<N: widths>(v: vec<float, N>, n: int = N) = float(n)", "f(uv) + f(position)", 5,
    ),
    "members of a structure": (
        "struct P { a : float, b : float }\nfn f(p: P = P(b = 1, a = 5)) -> float = p.a - p.b",
        "f() + f(P(b = 3, a = 1))", 2,
    ),
    "elements": ("fn f(a: float[2] = [1, 2], i: int = 1) -> float = a[i]", "f() + f([3, 4], 0)", 5),
}  # fmt: skip


@pytest.mark.parametrize(("head", "called", "expected"), CALLS.values(), ids=CALLS)
def test_calls(head: str, called: str, expected: float) -> None:
    assert number(called, "b = 2.0" if " b" in called else "", head) == pytest.approx(expected)


OVERLOADS: dict[str, tuple[tuple[str, ...], str]] = {
    # The first overload of each row is meant.
    "the name decides": (("x: float, a: float = 1", "x: float, b: vec2 = vec2(1)"), "1, a = 2"),
    "the type decides": (("x: vec2, a: float = 1", "x: vec3, a: float = 1"), "uv, a = 2"),
    "nothing left out": (("x: float", "x: float, a: float = 1"), "1.0"),
    "less left out": (("x: float, a: int = 1", "x: float, b: float = 1, c: float = 1"), "1.0"),
    "a change counts more": (("x: float, a: float = 1", "x: vec3"), "1.0"),
    "a default before any type": (("<T: floats>(x: T)", "x: float, a: float = 1"), "1.0"),
}  # fmt: skip


@pytest.mark.parametrize(("overloads", "arguments"), OVERLOADS.values(), ids=OVERLOADS)
@pytest.mark.parametrize("turned", (False, True))
def test_overloads(overloads: tuple[str, ...], arguments: str, turned: bool) -> None:
    heads = [head if head.startswith("<") else f"({head})" for head in overloads]
    functions = [f"fn f{head} -> float = {10 + i}" for i, head in enumerate(heads)]
    written = "\n".join(reversed(functions) if turned else functions)
    assert number(f"f({arguments})", "", written) == 10


LIT = """
import std.lights.{{Directional}}
term shade(k: rgb, n: vec3 = normal, gain: float = 2) per light =
    k * gain * dot(vec3(n), vec3(light.to_light))
term facing(n: vec3 = normal) -> float = n.z
rig R {{ sun : Directional {{ direction = normalize(vec3(0, 0, -1)) }} }}
material M {{ color = {} }}
"""
TERMS: dict[str, tuple[str, float]] = {
    "a slot of the surface": ("shade(vec3(1))", 2),
    "in place of a slot": ("shade(vec3(1), n = vec3(0, 0, 3))", 6),
    "by name, summed over lights": ("shade(gain = 5, k = vec3(1))", 5),
    "a slot that is replaced": ("shade(vec3(1)) with { normal = -normal }", -2),
    "a term without arguments": ("vec3(facing())", 1),
    "two surfaces": ("vec3(facing() + 3 * (facing() with { normal = -normal }))", -2),
}


@pytest.mark.parametrize(("called", "expected"), TERMS.values(), ids=TERMS)
def test_defaults_of_terms_see_the_surface(called: str, expected: float) -> None:
    assert color(LIT.format(called)) == pytest.approx((expected,) * 3)


def text(source: str) -> str:
    """The fragment shader of the material ``M``."""
    return burnish.compile(source, targets=["glsl"])["M"].text("glsl", "fragment")


def test_reads_of_textures_have_names() -> None:
    material = "material M {{ map a : texture2d  color = a.level({}).rgb }}"
    by_name = text(material.format("level = 2, coordinate = uv"))
    assert by_name == text(material.format("uv, 2"))


def test_a_default_is_one_value_for_all_calls() -> None:
    """Calls that leave an argument out are as if all of them wrote the same."""
    head = "fn f(x: float, y: float = sin(2.0)) -> float = x * y + sin(x)"
    material = "\nmaterial M {{ color = vec3({}) }}"
    left_out = text(head + material.format("f(uv.x) + f(x = uv.y)"))
    assert left_out == text(head + material.format("f(uv.x, sin(2.0)) + f(uv.y, sin(2.0))"))


def test_a_function_hides_another_with_its_defaults(tmp_path: Path) -> None:
    (tmp_path / "wide.burnish").write_text("fn wide(x: float, by: float = 2) -> float = x * by")
    own = "fn wide(x: float, by: float) -> float = x + by"
    with pytest.raises(CompileError) as caught:
        burnish.compile(
            f'import "wide.burnish"\n{own}\nmaterial M {{ color = vec3(wide(1)) }}',
            targets=["glsl"], search_path=[tmp_path],
        )  # fmt: skip
    assert caught.value.diagnostics[0].message == "`wide` takes 2 arguments, found 1"


def test_a_default_is_checked_although_all_calls_give_the_argument() -> None:
    with pytest.raises(CompileError) as caught:
        burnish.compile(
            "term t(a: float = missing) -> float = a\nmaterial M { color = vec3(t(1)) }",
            targets=["glsl"],
        )
    (found,) = caught.value.diagnostics
    assert found.message == "unknown name `missing`"


def test_chains_of_defaults_stay_small() -> None:
    """Each default calls the function before it twice; no value is computed more than once."""
    functions = ["fn f0(x: float = 1) -> float = x + 1"]
    functions += [f"fn f{n}(x: float = f{n - 1}() + f{n - 1}()) -> float = x" for n in range(1, 60)]
    assert number("log2(f59())", "", "\n".join(functions)) == pytest.approx(60)


def test_lanes_by_name() -> None:
    head = "fn laid(a: vec2, b: float = 3) -> vec3 = vec3(a, b)"
    assert lanes("laid(b = 9, a = uv)", "", head) == pytest.approx((0.25, 0.75, 9))
