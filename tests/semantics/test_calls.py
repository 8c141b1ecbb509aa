"""A call is the function's checked body with its arguments: as if it were checked by itself."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.diagnostics.render import render_all
from burnish.compiler.diagnostics.source import Span
from burnish.compiler.semantics.checking import applications, signatures
from burnish.compiler.semantics.checking.signatures import SharedCall
from burnish.compiler.semantics.state.context import Context, Signature

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*.burnish"))

RIGHT = {
    "a sign": "fn f(a: float, b: float) -> float = a * b - b\n c = f(uv.x, -2) + f(uv.y, -2.0)",
    "no float": "fn f(a: int, b: float) -> float = float(a + 1) * b\n c = f(3, 2) + f(3, uv.x)",
    "a sum of constants": (
        "fn f(a: vec3, i: int) -> float = a[i]\nc = f(uv.xyx, 1 + 1) + f(uv.xxy, 2)"
    ),
    "an index": "fn f(a: vec3, i: int) -> float = a[i]\n c = f(uv.xyx, int(uv.x)) + f(vec3(1), 0)",
    "a splat": (
        "fn f(p: point<world>, b: vec3) -> vec3 = vec3(p + b)\n"
        "c = f(place, vec3(uv.x)).x + f(place, uv.xyx).y"
    ),
    "a bare splat": "fn f(a: vec3, b: vec3) -> vec3 = a + b\n c = f(vec3(place), vec3(uv.x)).x",
    "splats of other numbers": (
        "fn f(a: vec3, b: vec3) -> vec3 = a.zyx * b + a\n"
        "c = f(vec3(uv.x), uv.xyx).x + f(vec3(uv.y), vec3(uv.x)).y + f(vec3(1), uv.xyx).z"
    ),
    "a splat in a structure": (
        "struct S { a : vec2, b : float }\nfn f(s: S) -> vec2 = s.a * s.b + s.a.y\n"
        "c = f(S(vec2(uv.x), uv.y)).x + f(S(vec2(2), uv.y)).y + f(S(uv, 2)).x"
    ),
    "vectors of constants": (
        "fn f(a: vec3, b: float) -> vec3 = a / length(a) * b\n"
        "c = f(vec3(1, 2, 3), uv.x).x + f(vec3(1, 2, 3), uv.y).y + f(vec3(2) * 3, uv.x).z"
    ),
    "a long constant": (
        "fn f(a: float, b: float) -> float = a / b\n"
        "c = f(uv.x, 1.0 + 2 + 3 + 4 + 5 + 6) + f(uv.y, 1.0 + 2 + 3 + 4 + 5 + 6)"
    ),
    "a choice": (
        "fn f(a: int) -> float = float(a) * 0.5\n"
        "c = f(if uv.x > 0.5 then 1 else 2) + f(if uv.x > 0.5 then 1 else 2)"
    ),
    "a range": (
        "fn f(n: int) -> float = sum i in 0..n : sin(float(i) + uv_.x) where { uv_ = vec2(1, 2) }\n"
        "c = f(few) + f(many) + f(3) + f(3)"
    ),
    "a loop around": (
        "fn f(a: float, i: int) -> float = a * float(i)\nc = sum i in 0..few : f(uv.x, i)"
    ),
    "a loop inside": (
        "fn f(a: float) -> float = sum i in 0..4 : sin(a * float(i))\nc = f(uv.x) + f(uv.y)"
    ),
    "a state": (
        "fn f(a: float) -> float = iterate x from a up to 5 while x < 9 : x * 2 + a\n"
        "c = f(uv.x) + f(uv.y)"
    ),
    "columns": (
        "fn f(m: mat3, v: vec3) -> float = dot(m[0], v) + m[1].x\n"
        "c = f(mat3(uv.xyx, vec3(1), uv.yxy), uv.xxx) + f(turn, uv.xyy)"
    ),
    "a vertex": "fn f(a: float) -> float = @vertex (a * 2)\n c = f(uv.x) + f(4.0) + f(uv.y)",
    "a length": (
        "fn f(d: vec3) -> direction<world> = (d as direction<world>)\n"
        "c = f(normalize(place - vec3(0))).x + f(normal).y"
    ),
    "overloads by length": (
        "fn g(d: direction<world>) -> float = d.x\nfn g(d: vec3) -> float = d.y\n"
        "fn f(d: vec3) -> float = g(d)\n c = f(normalize(uv.xyx)) + f(uv.xyx)"
    ),
    "itself": "fn f(a: float) -> float = a\n c = f(sin(uv.x)) + f(f(cos(uv.y)))",
    "a name for an argument": (
        "fn f(a: float) -> float = k * k + k where { k = a }\nc = f(sin(uv.x))"
    ),
    "names": (
        "fn f(a: float) -> float = wide + thin where { wide = sin(a)\n thin = wide * cos(a) }\n"
        "c = f(uv.x) + f(uv.y)"
    ),
    "a structure": (
        "struct S { a : float, b : vec2 }\nfn f(s: S) -> S = S(s.a + 1, s.b * s.a)\n"
        "c = f(f(S(uv.x, uv))).b.x + f(S(2, uv.yx)).a"
    ),
    "a table": (
        "fn f(t: float[3], i: int) -> float = t[i]\nc = f([1, 2, 3], 1) + f(rows, few) + f(rows, 2)"
    ),
    "a texture": (
        "fn f(t: texture2d, p: vec2) -> float = t(p).x\n"
        "c = f(grain, uv) + f(dust, uv) + f(grain, uv * 2)"
    ),
    "a lane": (
        "fn f(t: texture2d, i: int) -> vec4 = t.gather(vec2(0.5), i)\n"
        "c = f(grain, 1).x + f(grain, 2).y"
    ),
    "type parameters": (
        "fn f<T: floats>(a: T, b: T) -> T = mix(a, b, 0.5) * 2\n"
        "c = f(uv.x, 1) + f(uv, uv.yx).x + f(vec3(1), uv.xyx).z"
    ),
    "a count": (
        "fn f<N: widths>(v: vec<float, N>) -> float = dot(v, v) / float(N)\n"
        "c = f(uv) + f(uv.xyx) + f(uv.yx)"
    ),
    "spaces": (
        "fn f(p: point<world>, from_: point<world>) -> float = length(p - from_)\n"
        "fn g(d: vector<world>, e: vector<world>) -> vector<world> = d * 2 + e\n"
        "c = f(place, eye) + g(place - eye, (vec3(1) as vector<world>)).x"
    ),
    "unguarded": "fn f(a: float) -> float = unguarded(sqrt(a))\n c = f(uv.x) + f(uv.y)",
    "unguarded inside": "fn f(a: float) -> float = unguarded(a)\n c = f(sqrt(uv.x))",
}
WRONG = {
    "a body": "fn f(a: float) -> float = sin(a, 1)\n c = f(uv.x) + f(uv.y)",
    "a generic body": "fn f<T: floats>(a: T) -> float = a\n c = f(uv.x) + f(uv) + f(uv.yx)",
    "a bound": (
        "fn f(n: int) -> float = sum i in 0..n : float(i)\nc = f(few) + f(int(uv.x * 9000))"
    ),
    "no length": "fn f(d: vec3) -> direction<world> = d\n c = f(uv.xyx).x + f(normal).x",
    "a circle": (
        "fn f(a: float) -> float = g(a)\nfn g(a: float) -> float = f(a)\nc = f(uv.x) + g(uv.y)"
    ),
    "an argument": "fn f(a: float) -> float = a\n c = f(uv) + f(true) + f(uv.x)",
}
DOUBTED = {
    "a zero": (
        "fn f(a: float, b: float) -> float = a / b\nc = f(uv.x, 0) + f(uv.y, 0) + f(uv.x, 2)"
    ),
    "a zero in all lanes": (
        "fn f(a: vec2, b: vec2) -> vec2 = a / b\nc = f(uv, vec2(0)).x + f(uv, vec2(2)).x"
    ),
    "a difference that is zero": (
        "fn f(a: float, b: float) -> float = a / b\nc = f(uv.x, 2 - 2.0) + f(uv.y, 3 - 2.0)"
    ),
    "an index outside": "fn f(a: vec3, i: int) -> float = a[i]\n c = f(vec3(1), 3) + f(uv.xyx, 4)",
}


def program(text: str) -> str:
    """Declarations, and a material whose colour is the ``c`` behind them."""
    declarations, _, color = text.rpartition("\n")
    return f"""
rows = [1.0, 2.0, 4.0]
{declarations}
material M {{
    map grain : texture2d
    map dust : texture2d
    param few : int in 0..4 = 2
    param many : int in 0..9 = 3
    param turn : mat3 = mat3(1)
    place = position
    {color.strip()}
    color = vec3(c)
}}
"""


def told(source: str | Path) -> dict[str, str] | str:
    """The texts of a program and its warnings, or what is wrong with it."""
    try:
        result = burnish.compile(source, "glsl")
    except CompileError as error:
        return render_all(error.diagnostics)
    texts = {file.name: file.text for material in result.materials for file in material.files}
    return {**texts, "warnings": render_all(result.diagnostics)}


@pytest.fixture
def alone(monkeypatch: pytest.MonkeyPatch) -> Callable[[str | Path], dict[str, str] | str]:
    """The function ``told``, but with every call checked by itself."""

    def compiled(source: str | Path) -> dict[str, str] | str:
        with monkeypatch.context() as patched:
            patched.setattr(applications, "shared_call", lambda *_: None)
            return told(source)

    return compiled


@pytest.mark.parametrize("name", RIGHT)
def test_a_call_is_what_it_would_be_alone(
    name: str, alone: Callable[[str | Path], dict[str, str] | str]
) -> None:
    text = program(RIGHT[name])
    texts = told(text)
    assert isinstance(texts, dict), texts
    assert texts == alone(text)


@pytest.mark.parametrize("name", WRONG)
def test_what_is_wrong_is_told_once_and_where_it_would_be_alone(
    name: str, alone: Callable[[str | Path], dict[str, str] | str]
) -> None:
    text = program(WRONG[name])
    messages = told(text)
    assert isinstance(messages, str)
    assert messages == alone(text)


@pytest.mark.parametrize("name", DOUBTED)
def test_a_constant_that_is_doubted_is_told_as_it_would_be_alone(
    name: str, alone: Callable[[str | Path], dict[str, str] | str]
) -> None:
    text = program(DOUBTED[name])
    texts = told(text)
    assert isinstance(texts, dict), texts
    assert "given from elsewhere" in texts["warnings"]
    assert texts == alone(text)


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_are_the_same(
    path: Path, alone: Callable[[str | Path], dict[str, str] | str]
) -> None:
    assert (told(path) == alone(path)) == (path.stem not in TOLD_OTHERWISE)


TOLD_OTHERWISE = {"clouds", "noises", "weathered"}
"""Examples whose shared bodies know less: ranges of arguments do not limit loops in them, and a
factor of a result stays apart from one outside of the call."""


def test_a_body_is_checked_once_for_each_signature(monkeypatch: pytest.MonkeyPatch) -> None:
    checked: list[Signature] = []
    check = signatures.check_body

    def noted(ctx: Context, call: SharedCall, span: Span) -> None:
        checked.append(call.signature)
        check(ctx, call, span)

    monkeypatch.setattr(signatures, "check_body", noted)
    calls = " + ".join(f"f(uv.x * {i}.5, 2) + f(uv.y, {i})" for i in range(4))
    told(program(f"fn f(a: float, n: int) -> float = sin(a) * float(n)\n c = {calls}"))
    assert len(set(checked)) == len(checked)
    # One for each number, and one for any number, of which a function of the text could be made.
    assert sum(signature.symbol.name == "f" for signature in checked) == 5
