"""The parts of a function or term that are named behind ``where``."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.reference.namespace import Lanes

from .kit import color, lanes, number

FUNCTIONS: dict[str, tuple[str, str, float]] = {
    "any order": ("fn f(x: float) = y + z where { y = z * 2  z = x + 1 }", "f(3)", 12),
    "written types": ("fn f(x: float) = v.x + v.y where { v : vec2 = x }", "f(3)", 6),
    "literals adapt": ("fn f(x: float) = x * y where { y : float = 2 }", "f(3)", 6),
    "each call has its own": ("fn f(x: float) = y where { y = x * x }", "f(2) + f(3) + f(4)", 29),
    "before the file": ("y = 5.0\nfn f(x: float) = x * y where { y = 2 * x }", "f(3) + y", 23),
    "behind an index": ("fn f(n: int) = sum i in 0..n up to 9 : i where { i = 7 }", "f(4)", 6),
    "without the index": ("fn f(n: int) = sum i in 0..3 : i + k where { k = 2 * n }", "f(4)", 27),
    "loops in a part": ("fn f(n: int) = s where { s = sum i in 0..n up to 9 : i }", "f(4)", 6),
    "structures": (
        "struct P { a : float, b : float }\nfn f(x: float) = p.a - p.b where { p = P(x, 2 * x) }",
        "f(3)",
        -3,
    ),
    "type parameters": (
        "fn f<T: vectors>(v: T) -> float = dot(w, w) where { w : T = v * 2 }", "f(vec3(1)) + f(uv)",
        12 + 4 * (0.25**2 + 0.75**2),
    ),
    "lengths": (
        "fn f<N: counts>(a: float[N]) = t / n where { t = sum i in 0..N : a[i]  n = float(N) }",
        "f([1.0, 2.0, 6.0])",
        3,
    ),
    "the word is a name": ("fn f(where: float) = where where { y = where }", "f(3)", 3),
    "no parts": ("fn f(x: float) = x where { }", "f(3)", 3),
}  # fmt: skip


@pytest.mark.parametrize(("head", "called", "expected"), FUNCTIONS.values(), ids=FUNCTIONS)
def test_parts_of_functions(head: str, called: str, expected: float) -> None:
    assert number(called, "", head) == pytest.approx(expected)


def lit(body: str) -> Lanes:
    """A material's colour under a term with this body, and two lights."""
    return color(
        f"""
    import std.lights.{{Directional}}
    term shade(k: rgb) per light = {body}
    material M {{ tint = vec3(0.5)  color = shade(vec3(1)) }}
    rig R {{ one : Directional {{ direction = normalize(vec3(0, 3, -4)) }}  two : Directional[2] }}
    """,
        {"two": LIGHTS},
    )


WHITE: Lanes = (1.0,) * 3
LIGHTS: Lanes = ((WHITE, WHITE, (0.0, 0.0, -1.0)), (WHITE, WHITE, (0.0, 0.6, -0.8)))


def test_parts_of_terms_see_the_surface_and_the_light() -> None:
    named = lit("k * tint * nl where { nl : float = dot(normal, light.to_light) }")
    assert named == lit("k * tint * dot(normal, light.to_light)") == pytest.approx((1.3,) * 3)


def test_parts_follow_replaced_slots() -> None:
    head = "term mine() = n where { n = vec3(alpha) }"
    assert lanes("mine() + (mine() with { alpha = 0.25 })", "alpha = 0.5", head) == (0.75,) * 3


def test_a_part_is_called_in_the_text_what_it_is_called_in_the_source() -> None:
    source = """
    fn f(x: float) -> float = bent * bent + sin(bent) where {
        /// Why it is so.
        bent = cos(x)
    }
    material M { param a : float = 1  color = vec3(f(a * uv.x)) }"""
    text = burnish.compile(source, ("glsl",))["M"].text("glsl", "fragment")
    assert "// Why it is so.\n    float bent = cos(" in text
