"""Blend states as drivers take them, and what they come to for two colours, worked out here."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from burnish.compiler.ir.blending import NAMED, REPLACES, Blend, BlendEquation, Factor, Operation


def as_job(blend: Blend) -> Blend | None:
    """A blend state as jobs have it."""
    return None if blend == REPLACES else blend


def named(word: str) -> Blend | None:
    """The state that the language has a word for."""
    return as_job(NAMED[word])


def both(source: Factor, destination: Factor, operation: Operation = "add") -> Blend:
    """A blend with one equation for all lanes."""
    equation = BlendEquation(source, destination, operation)
    return Blend(equation, equation)


Lane = Callable[[Sequence[float], Sequence[float], Sequence[float], int], float]

VALUES: dict[Factor, Lane] = {
    "zero": lambda _s, _d, _c, _i: 0.0,
    "one": lambda _s, _d, _c, _i: 1.0,
    "src": lambda s, _d, _c, i: s[i],
    "one_minus_src": lambda s, _d, _c, i: 1 - s[i],
    "src_alpha": lambda s, _d, _c, _i: s[3],
    "one_minus_src_alpha": lambda s, _d, _c, _i: 1 - s[3],
    "dst": lambda _s, d, _c, i: d[i],
    "one_minus_dst": lambda _s, d, _c, i: 1 - d[i],
    "dst_alpha": lambda _s, d, _c, _i: d[3],
    "one_minus_dst_alpha": lambda _s, d, _c, _i: 1 - d[3],
    "src_alpha_saturated": lambda s, d, _c, i: 1.0 if i == 3 else min(s[3], 1 - d[3]),
    "constant": lambda _s, _d, c, i: c[i],
    "one_minus_constant": lambda _s, _d, c, i: 1 - c[i],
}
"""The table of factors of OpenGL 4.6, 17.2."""

JOINED: dict[Operation, Callable[[float, float], float]] = {
    "add": lambda a, b: a + b,
    "subtract": lambda a, b: a - b,
    "reverse_subtract": lambda a, b: b - a,
    "min": min,
    "max": max,
}
"""The table of equations of OpenGL 4.6, 17.1."""


def blended(
    blend: Blend | None,
    source: Sequence[float],
    destination: Sequence[float],
    constant: Sequence[float] = (0.0,) * 4,
) -> list[float]:
    """The blend of two colours by a state, with an unlimited range."""
    if blend is None:
        return list(source)
    found = []
    for lane in range(4):
        equation = blend.alpha if lane == 3 else blend.color
        first = VALUES[equation.source](source, destination, constant, lane) * source[lane]
        second = VALUES[equation.destination](source, destination, constant, lane)
        found.append(JOINED[equation.operation](first, second * destination[lane]))
    return found
