"""Passes look at each value a fixed number of times: twice the program is twice the work.

Work is counted in executed lines of Python (each turn of a comprehension is one), not in time. What
every program costs makes the ratio a little less than two; work that is squared, more.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import FrameType
from typing import Any
from unittest.mock import patch

import pytest

from burnish.compiler.passes.pipeline import Options, stage
from burnish.compiler.watching import VARIABLE

from .kit import shader
from .test_scale import SHAPES, chain, long_sum, nested


def work(program: str) -> int:
    """The number of lines of Python that the passes run for a program."""
    given = shader(program)
    lines = 0

    def trace(_frame: FrameType, event: str, _argument: object) -> Any:
        nonlocal lines
        lines += event == "line"
        return trace

    with patch.dict("os.environ", {VARIABLE: "0"}):
        before = sys.gettrace()
        sys.settrace(trace)
        try:
            stage(given, Options())
        finally:
            sys.settrace(before)
    return lines


def material(equations: str, color: str) -> str:
    return f"material M {{\n{equations}\ncolor = vec3({color})\n}}"


def lines(count: int, line: Callable[[int], str]) -> str:
    return "\n".join(map(line, range(1, count)))


def total(count: int) -> str:
    return " + ".join(f"s{i}" for i in range(1, count))


def choices(count: int) -> str:
    """Choices inside of choices, with one value that all conditions need."""
    links = lines(count, lambda i: f"s{i} = if uv.y > {i}.5 then s{i - 1} else sin(uv.x * {i}.0)")
    return material(f"s0 = uv.x\n{links}", f"s{count - 1}")


def guarded_choices(count: int) -> str:
    """Divisions that are safe behind their conditions."""
    links = lines(count, lambda i: f"s{i} = if s{i - 1} > {i}.0 then 1 / s{i - 1} else s{i - 1}")
    return material(f"s0 = uv.x\n{links}", f"s{count - 1}")


def functions(count: int) -> str:
    """A sum of calls of as many functions."""
    bodies = lines(
        count, lambda i: f"fn f{i}(x : float) -> float = sin(x * {i}.0) + cos(x) * sin(x + {i}.0)"
    )
    calls = lines(count, lambda i: f"s{i} = f{i}(uv.x) + f{i}(uv.y)")
    return f"{bodies}\n{material(calls, total(count))}"


def folding_calls(count: int) -> str:
    """Calls that fold to constants, each with all those before it in its argument."""
    links = lines(count, lambda i: f"s{i} = over(s{i - 1} + uv.y, 0) + {i}.5 + s{i - 1}")
    over = "fn over(a : float, b : float) -> float = if b == 0 then 0 else a / b"
    sums = material(f"s0 = uv.x\n{links}", f"s{count - 1}")
    return f"{over}\n{sums}"


def calls(count: int) -> str:
    """Functions that each call the one before: all bodies are written out, one in the other."""
    count += 64  # So many bodies are none that the passes see: semantics evaluates them.
    bodies = lines(count, lambda i: f"fn f{i}(x : float) -> float = sin(f{i - 1}(x)) + {i}.5")
    head = f"fn f0(x : float) -> float = sin(x)\n{bodies}\n"
    return head + material("", f"f{count - 1}(uv.x)")


def calls_twice(count: int) -> str:
    """Functions that each call the one before twice, and so stay functions."""
    bodies = lines(
        count, lambda i: f"fn f{i}(x : float) -> float = f{i - 1}(x * {i}.5) + f{i - 1}(x)"
    )
    head = f"fn f0(x : float) -> float = sin(x)\n{bodies}\n"
    return head + material("", f"f{count - 1}(uv.x)")


def varyings(count: int) -> str:
    """Values that cross, each by itself."""
    values = lines(count, lambda i: f"s{i} = @vertex sin(uv.x * {i}.0)")
    return material(values, " + ".join(f"s{i} * uv.y" for i in range(1, count)))


def elements(count: int) -> str:
    """An array whose elements are computed, and read one after the other."""
    values = ", ".join(f"sin(uv.x * {i}.0)" for i in range(count))
    return material(f"a = [{values}]", f"sum i in 0..{count} : a[i]")


def parameters(count: int) -> str:
    """Work for the host from as many parameters."""
    declared = lines(count, lambda i: f"param p{i} : float = 0.5")
    return material(declared, " + ".join(f"sin(p{i}) * uv.x" for i in range(1, count)))


def conditions(count: int) -> str:
    """One condition with many parts."""
    parts = " and ".join(f"uv.x > {i}.0" for i in range(count))
    return material("", f"if {parts} then sin(uv.x) else 1.0")


ALL = {
    **SHAPES,
    **{
        each.__name__: each
        for each in (
            chain, long_sum, nested, choices, guarded_choices, functions, calls, calls_twice,
            varyings, elements, parameters, conditions, folding_calls,
        )
    },
}  # fmt: skip


def short_folds(depth: int) -> str:
    """Folds of two turns in each other; each turn of each of them has a term of its own."""
    head = "".join(f"sum i{i} in 0..2 : " for i in range(depth))
    total = " + ".join(f"float(i{i}) * {i}.5" for i in range(depth))
    return material("", f"{head}sin(uv.x + {total})")


def short_loops(depth: int) -> str:
    """Loops of two turns in each other, each of which starts with the state of the one around."""
    head = "".join(f"iterate x{i} from x{i - 1} up to 2 : " for i in range(1, depth))
    return material("x0 = uv.x", f"{head}sin(x{depth - 1} + 0.5)")


@pytest.mark.parametrize("nested", [short_folds, short_loops], ids=lambda each: each.__name__)
def test_loops_in_loops_do_not_double_with_each_level(nested: Callable[[int], str]) -> None:
    """The innermost levels are written out, up to a limit; those further out stay loops."""
    small, large = (work(nested(depth)) for depth in (10, 14))
    assert large < 1.5 * small


@pytest.mark.parametrize("name", ALL)
def test_work_grows_with_the_program(name: str) -> None:
    small, large = (work(ALL[name](count)) for count in (100, 200))
    assert large < 2.05 * small
