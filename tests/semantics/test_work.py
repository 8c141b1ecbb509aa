"""Checking looks at each value a fixed number of times: twice the program is twice the work.

Work is counted in executed lines of Python, not in time.
"""

from __future__ import annotations

import sys
from collections.abc import Callable
from types import FrameType
from typing import Any
from unittest.mock import patch

import pytest

import burnish
from burnish.compiler.syntax import incremental
from burnish.compiler.syntax.incremental import KnownSections


def lines(count: int, line: Callable[[int], str]) -> str:
    return "\n".join(map(line, range(1, count)))


def divisors(count: int) -> str:
    links = lines(count, lambda i: f"c{i} = 2.0 / c{i - 1}")
    return f"c0 = 2.0\n{links}\nmaterial M {{ alpha = c{count - 1} }}"


def at_the_vertices(count: int) -> str:
    links = lines(count, lambda i: f"a{i} = @vertex (a{i - 1} * 2)")
    return f"material M {{\na0 = uv.x\n{links}\nalpha = a{count - 1}\n}}"


def functions(count: int) -> str:
    links = lines(count, lambda i: f"fn f{i}(x: float) -> float = f{i - 1}(x) + 1")
    return f"fn f0(x: float) -> float = x\n{links}\nmaterial M {{ alpha = f{count - 1}(uv.x) }}"


def functions_twice(count: int) -> str:
    links = lines(count, lambda i: f"fn f{i}(x: float) -> float = f{i - 1}(x) * f{i - 1}(x + 1)")
    return f"fn f0(x: float) -> float = x\n{links}\nmaterial M {{ alpha = f{count - 1}(uv.x) }}"


def signs(count: int) -> str:
    return f"material M {{ alpha = {'-' * count}uv.x }}"


def unread_lights(count: int) -> str:
    declared = lines(count, lambda i: f"light L{i} : Unknown {{ }}")
    return f"{declared}\nmaterial M {{ }}"


def kinds_of_lights(count: int) -> str:
    declared = lines(count, lambda i: f"light L{i} : Light {{ param place : float }}")
    return f"{declared}\nmaterial M {{ }}"


def structures(count: int) -> str:
    declared = lines(count, lambda i: f"struct S{i} {{ a : float }}")
    return f"{declared}\nmaterial M {{ }}"


def work(program: str) -> int:
    """The number of lines of Python that run to check a program of which nothing is known."""
    lines_run = 0

    def trace(_frame: FrameType, event: str, _argument: object) -> Any:
        nonlocal lines_run
        lines_run += event == "line"
        return trace

    before = sys.gettrace()
    sys.settrace(trace)
    try:
        with patch.object(incremental, "KNOWN_SECTIONS", KnownSections()):
            burnish.check(program)
    finally:
        sys.settrace(before)
    return lines_run


@pytest.mark.parametrize(
    ("program", "size"),
    [
        (divisors, 100),
        (at_the_vertices, 100),
        (functions, 150),
        (functions_twice, 100),
        (signs, 200),
        (unread_lights, 24),
        (kinds_of_lights, 24),
        (structures, 400),
    ],
)
def test_twice_the_program_is_twice_the_work(program: Callable[[int], str], size: int) -> None:
    burnish.check(program(2))  # What is loaded once is no work of the program's.
    assert work(program(2 * size)) < 2.4 * work(program(size))


def loops(rows: int) -> str:
    """A value that has to be known, and takes so many times 4096 turns of a loop."""
    turns = f"sum i in 0..{rows} : sum j in 0..4096 : i mod (j + 1)"
    return f"fn n() -> int = {turns}\nmaterial M {{ param p : float[n() + 1]  alpha = p[0] }}"


def test_a_value_whose_loops_alone_exceed_the_limit_is_not_computed() -> None:
    assert not burnish.check(loops(1))
    (said,) = burnish.check(loops(4096))
    assert said.message.endswith("takes more than 500000 operations")
    assert work(loops(4096)) < work(loops(1)) / 4
