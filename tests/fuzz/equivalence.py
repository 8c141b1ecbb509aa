"""Compares the values of a random program with those of its rewritings."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace
from random import Random

from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.ir.shader import Shader

from ..passes.agreement import lanes, noisy, tolerances
from ..passes.kit import World, shaders
from .rates import Rated, literal_as_parameter, parameter_as_literal
from .rewritings import rewritten
from .tree import Node

Variant = tuple[str | None, str | None]
"""The names of a rig and a pass."""

LATER, EARLIER = "a literal as a parameter", "a parameter as a literal"

REFUSED = {
    each.code
    for each in (
        rules.ZERO_DIVISOR,
        rules.OUT_OF_BOUNDS,
        rules.NUMBER_TOO_LARGE,
        rules.UNBOUNDED_LOOP,
    )
}
"""The errors for which a rewriting may be refused.

With constants, mistakes come to light; with an argument in place of a value of a known range, the
number of iterations is not known.
"""


def differences(
    tree: Node, original: Shader, variant: Variant, world: World, seed: str, only: str = ""
) -> Iterator[tuple[str, str, str]]:
    """The rewritings that change the value: the name, what happened in a word, and the story.

    With ``only``, no other rewriting is tried.
    """
    roots = list(original.roots)
    expected = lanes(roots, world)
    allowed = tolerances(noisy(original.graph, roots), expected, world)
    for name, rated in _rewritings(tree, original, world, seed, only):
        try:
            other = shaders(str(rated.tree), *variant)[-1]
        except CompileError as error:
            codes = {each.rule.code for each in error.diagnostics} - REFUSED
            if codes:
                yield name, f"refused {min(codes)}", f"{error}\n{rated.tree}"
            continue
        values = lanes(list(other.roots), replace(world, fixed=rated.fixed))
        if (story := _first_difference(values, expected, allowed)) is not None:
            yield name, "", f"{story}, traps={world.traps}\n{rated.tree}"


def _first_difference(
    values: list[float], expected: list[float], allowed: list[float]
) -> str | None:
    if len(values) != len(expected):
        return f"{len(values)} lanes instead of {len(expected)}"
    for index, (value, wanted) in enumerate(zip(values, expected, strict=True)):
        if math.isfinite(wanted) and not abs(value - wanted) <= allowed[index]:
            return f"lane {index} is {value} instead of {wanted}"
    return None


def _rewritings(
    tree: Node, shader: Shader, world: World, seed: str, only: str
) -> Iterator[tuple[str, Rated]]:
    for name, found in rewritten(tree, seed, only):
        yield name, Rated(found)
    if only in ("", LATER) and (rated := literal_as_parameter(tree, Random(seed))) is not None:
        yield LATER, rated
    if only in ("", EARLIER):
        rated = parameter_as_literal(tree, Random(seed), shader, world)
        if rated is not None:
            yield EARLIER, rated
