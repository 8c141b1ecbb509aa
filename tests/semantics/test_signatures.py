"""Functions that come to many bodies are evaluated once for each signature, and mean the same."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.reference import cost
from burnish.compiler.semantics.checking import signatures
from burnish.compiler.semantics.lowering import structures

from .kit import color, shader


def calls(levels: int, first: str, later: str) -> str:
    """Functions of which each calls the one before it twice."""
    functions = [later.format(i=i, before=i - 1) for i in range(1, levels)]
    return "\n".join([first, *functions])


PLAIN = (
    "fn g0(a: float) -> float = sin(a)",
    "fn g{i}(a: float) -> float = g{before}(a * {i}.5) * 0.5 + g{before}(a)",
)
GENERIC = (
    "fn g0<T: floats>(a: T) -> T = sin(a)",
    "fn g{i}<T: floats>(a: T) -> T = g{before}(a * {i}.5) * 0.5 + g{before}(a)",
)
COUNTED = (
    "fn g0(a: float, n: int) -> float = sum i in 0..n : sin(a * float(i))",
    "fn g{i}(a: float, n: int) -> float = g{before}(a * {i}.5, n) * 0.5 + g{before}(a, 3)",
)
DIRECTED = (
    "fn g0(d: direction<world>, a: float) -> direction<world> = d",
    "fn g{i}(d: direction<world>, a: float) -> direction<world> = "
    "normalize(g{before}(d, a * {i}.5) * a + g{before}(d, a))",
)
STRUCTURED = (
    "struct S { a : float, b : vec2 }\nfn g0(s: S) -> float = s.a * s.b.x",
    "fn g{i}(s: S) -> float = g{before}(S(s.a * {i}.5, s.b)) * 0.5 + g{before}(s)",
)
BUILT = (
    "struct S { a : float, b : vec2 }\nfn g0(x: float) -> S = S(sin(x), vec2(x, cos(x)))",
    "fn g{i}(x: float) -> S = S(first.a * second.b.x + {i}, first.b + second.a) "
    "where {{ first = g{before}(x * {i}.5)\n second = g{before}(x) }}",
)
LAYERED = (
    "struct S { a : float, b : vec2 }\nfn over(s: S, t: S) -> S = S(s.a + s.b.x * t.a, s.b * t.b)\n"
    "fn g0(x: float) -> S = S(sin(x), vec2(x, 0.5))",
    "fn g{i}(x: float) -> S = over(S(cos(x * {i}.5), vec2(0.5, x)), g{before}(x * 0.5))",
)
MIXED = (
    "struct S { a : float, b : float, c : float }\n"
    "fn g0(x: float) -> S = S(sin(x) + cos(x * 0.5), cos(x), x * x)",
    "fn g{i}(x: float) -> S = "
    "S(sin(p.a * q.b) + q.c * 0.5, cos(p.b + q.c) - p.a, p.c * 0.5 + sin(q.b)) "
    "where {{ p = g{before}(x * {i}.5)\n q = g{before}(x + {i}.25) }}",
)
CHOSEN = (
    "struct S { a : float, b : vec2 }\nfn g0(x: float) -> S = S(sin(x), vec2(0.5))",
    "fn g{i}(x: float) -> S = if first.a > x then first else g{before}(x) "
    "where {{ first = g{before}(x * {i}.5) }}",
)
NESTED = (
    "struct S { a : float, b : vec2 }\nstruct T { s : S, n : int }\n"
    "fn g0(x: float) -> T = T(S(sin(x), vec2(x)), 1)",
    "fn g{i}(x: float) -> T = "
    "T(S(first.s.a - second.s.b.y, second.s.b), max(first.n, second.n) + 1) "
    "where {{ first = g{before}(x * {i}.5)\n second = g{before}(first.s.a) }}",
)
SHADED = (
    "import std.terms.{lambert}\nterm g0(k: rgb) = lambert(k)",
    "term g{i}(k: rgb) = (g{before}(k) with {{ normal = normalize(normal + {i}.5) }}) * 0.5 "
    "+ g{before}(k * 0.5)",
)
PROGRAMS = {
    "plain": (PLAIN, "vec3({last}(uv.x))"),
    "generic": (GENERIC, "{last}(vec3(uv, 0.5)) + {last}(uv.x)"),
    "counted": (COUNTED, "vec3({last}(uv.x, 4))"),
    "directed": (DIRECTED, "vec3({last}(normal, uv.x))"),
    "structured": (STRUCTURED, "vec3({last}(S(uv.x, uv)))"),
    "built": (BUILT, "vec3({last}(uv.x).a, {last}(uv.y).b)"),
    "layered": (LAYERED, "vec3({last}(uv.x).a, {last}(uv.x).b)"),
    "mixed": (MIXED, "vec3({last}(uv.x).a, {last}(uv.x).b, {last}(uv.x).c)"),
    "chosen": (CHOSEN, "vec3({last}(uv.x).a, {last}(uv.y).b)"),
    "nested": (NESTED, "vec3({last}(uv.x).s.a, {last}(uv.x).s.b) / float({last}(uv.y).n)"),
    "shaded": (SHADED, "{last}(vec3(uv, 0.5))"),
}


def program(name: str, levels: int) -> str:
    """A program of ``PROGRAMS`` with ``levels`` functions."""
    (first, later), color = PROGRAMS[name]
    functions = calls(levels, first, later)
    return f"{functions}\nmaterial M {{ color = {color.format(last=f'g{levels - 1}')} }}"


@pytest.mark.parametrize("name", PROGRAMS)
def test_a_shared_body_gives_what_each_call_would(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = program(name, 9)
    monkeypatch.setattr(signatures, "MOST_BODIES", 8)
    monkeypatch.setattr(structures, "LARGEST_COPIES", 64)
    shared, value = shader(text), color(text)
    monkeypatch.setattr(signatures, "MOST_BODIES", 10**9)
    alone = shader(text)
    if name != "layered":  # There each function is called once.
        assert len(shared.graph) < len(alone.graph)
    assert value == pytest.approx(color(text), rel=1e-12)


def operations(text: str) -> int:
    """The operations that the shader of a text comes to, with all that functions compute."""
    return cost.operations([result.value for result in shader(text).results])


@pytest.mark.parametrize("name", PROGRAMS)
def test_sharing_bodies_leaves_the_work_of_the_shader(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = program(name, 8)
    monkeypatch.setattr(signatures, "MOST_BODIES", 8)
    shared = operations(text)
    monkeypatch.setattr(signatures, "MOST_BODIES", 10**9)
    assert shared <= 1.5 * operations(text)


@pytest.mark.parametrize("name", PROGRAMS)
def test_work_grows_with_the_number_of_functions(
    name: str, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(structures, "LARGEST_COPIES", 1024)
    few, many = (len(shader(program(name, levels)).graph) for levels in (100, 200))
    assert many < 2.5 * few


def told(text: str) -> list[str]:
    """The messages about a text."""
    with pytest.raises(CompileError) as failed:
        burnish.compile(text, "wgsl")
    return [found.message for found in failed.value.diagnostics]


def test_a_mistake_in_a_shared_body_is_told_once() -> None:
    _first, later = PLAIN
    functions = calls(12, "fn g0(a: float) -> float = sin(b)", later)
    assert told(f"{functions}\nmaterial M {{ color = vec3(g11(uv.x)) }}") == ["unknown name `b`"]


def test_a_constant_that_is_wrong_is_told_though_only_shared_bodies_read_it() -> None:
    _first, later = PLAIN
    functions = calls(12, "fn g0(a: float) -> float = sin(a) * wrong", later)
    text = f"wrong = sin(true)\n{functions}\nmaterial M {{ color = vec3(g11(uv.x)) }}"
    assert told(text) == ["`sin` cannot be called with (bool)"]


def test_a_shared_choice_between_constants_adapts_to_its_use() -> None:
    functions = calls(
        12,
        "fn g0(a: float) -> int = if a > 0.5 then 1 else 2",
        "fn g{i}(a: float) -> int = if g{before}(a * 2) + g{before}(a) > 2 then 1 else 2",
    )
    text = f"{functions}\nmaterial M {{ color = vec3(g11(uv.x)) * 0.5 }}"
    assert color(text) == (1.0, 1.0, 1.0)
