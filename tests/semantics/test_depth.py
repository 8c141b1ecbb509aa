"""Programs that chain and nest far deeper than Python's stack, which nothing may recurse over."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

import burnish

from .kit import shader

LONG = 1_500


def _joined(line: Callable[[int], str]) -> str:
    return "\n".join(map(line, range(LONG)))


CHAINS = {
    "equations": f"""
        material M {{
            {_joined(lambda i: f"s{i} = s{i + 1} + 1.0")}
            s{LONG} = uv.x
            alpha = s0
        }}""",
    "constants": f"""
        {_joined(lambda i: f"c{i} = c{i + 1} + 1.0")}
        c{LONG} = 0.5
        material M {{ alpha = c0 }}""",
    "functions": f"""
        {_joined(lambda i: f"fn f{i}(x: float) -> float = f{i + 1}(x) + 1.0")}
        fn f{LONG}(x: float) -> float = sin(x)
        material M {{ alpha = f0(uv.x) }}""",
    "generic functions": f"""
        {_joined(lambda i: f"fn f{i}<T: floats>(x: T) -> T = f{i + 1}(x) + 1.0")}
        fn f{LONG}<T: floats>(x: T) -> T = sin(x)
        material M {{ alpha = f0(uv.x) }}""",
    "parts of a function": f"""
        fn f(x: float) -> float = p0 where {{
            {_joined(lambda i: f"p{i} = p{i + 1} + x")}
            p{LONG} = sin(x)
        }}
        material M {{ alpha = f(uv.x) }}""",
    "terms": f"""
        import std.terms.{{lambert}}
        {_joined(lambda i: f"term t{i}(k: rgb) = t{i + 1}(k * 0.5)")}
        term t{LONG}(k: rgb) = lambert(k)
        material M {{ color = t0(vec3(1)) }}""",
    "terms with other slots": f"""
        import std.terms.{{lambert}}
        {_joined(lambda i: f"term t{i}(k: rgb) = t{i + 1}(k) with {{ normal = -normal }}")}
        term t{LONG}(k: rgb) = lambert(k)
        material M {{ color = t0(vec3(1)) }}""",
    "signs": f"material M {{ alpha = {'- ' * LONG}uv.x }}",
    "branches": f"material M {{ alpha = {'if uv.x > 0.5 then ' * LONG}1.0{' else 0.0' * LONG} }}",
    "sums": f"material M {{ alpha = {' + '.join(['uv.x'] * LONG)} }}",
}


@pytest.mark.parametrize("chain", CHAINS)
def test_chains_have_no_limit(chain: str) -> None:
    assert len(shader(CHAINS[chain]).graph) > 0


def test_counts_of_arrays_chain_without_limit() -> None:
    links = "\n".join(f"a{i} : int[a{i + 1}[0]] = [a{i + 1}[0]]" for i in range(300))
    text = f"{links}\na300 : int[1] = [1]\nmaterial M {{ param p : float[a0[0]]\nalpha = p[0] }}"
    (parameter,) = [info for info in shader(text).parameters if info.leaf.name == "p"]
    assert parameter.declared_type == "float[1]"


def test_a_long_cycle_is_told_as_a_short_one() -> None:
    links = "\n".join(f"s{i} = s{(i + 1) % 100} + 1.0" for i in range(100))
    with pytest.raises(burnish.CompileError) as failed:
        burnish.compile(f"material M {{\n{links}\nalpha = s0\n}}")
    (error,) = failed.value.diagnostics
    assert error.message.count("→") == 100
    assert error.message.startswith("`s0` is defined by itself: s0 → s1 → s2")


def test_imports_chain_without_limit(tmp_path: Path) -> None:
    for i in range(400):
        text = f"import m{i + 1}.{{f{i + 1}}}\nfn f{i}(x: float) -> float = f{i + 1}(x) + 1.0\n"
        (tmp_path / f"m{i}.burnish").write_text(text, "utf-8")
    (tmp_path / "m400.burnish").write_text("fn f400(x: float) -> float = sin(x)\n", "utf-8")
    main = tmp_path / "main.burnish"
    main.write_text("import m0.{f0}\nmaterial M { alpha = f0(uv.x) }\n", "utf-8")
    assert shader(main).name == "M"
