"""Words of Burnish as nodes: the rows of ``materialx.leaves``, read in the other direction."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

from ...compiler.diagnostics.diagnostic import Report
from ...compiler.diagnostics.source import Source
from ...compiler.syntax import ast
from ...compiler.syntax.parser import parse
from ..leaves import ROWS
from ..leaves.application import SUFFIXES, Written
from ..leaves.catalogue import PACKAGE, catalogue
from ..leaves.closures import CLOSURE_ROWS


class Way(NamedTuple):
    """A node for a word: its category, and the inputs that the operands are."""

    category: str
    inputs: tuple[str, ...]


@cache
def ways() -> dict[str, Way]:
    """The nodes for builtins and operators, by the words."""
    found: dict[str, Way] = {}
    for category, row in ROWS.items():
        if isinstance(row, Written):
            for word, inputs in ((row.word, row.inputs), *row.also.items()):
                found.setdefault(word, Way(category, inputs))
    return found


@cache
def closure_ways() -> dict[str, Way]:
    """The nodes for functions of ``std.mtlx.asking`` that put closures together."""
    rows = dict(CLOSURE_ROWS)
    layer = ROWS["layer"]
    assert isinstance(layer, Written)
    rows["layer"] = layer
    return {row.word: Way(category, row.inputs) for category, row in rows.items()}


def leaf_category(module: str, name: str) -> str:
    """The category of nodes for a function of ``std.mtlx``; empty if it is no node."""
    from ..known import categories

    if not module.startswith(f"std.{PACKAGE}.") or name not in catalogue():
        return ""
    stems = [name, *(name.removesuffix(suffix) for suffix in SUFFIXES.values() if suffix)]
    return next((found for stem in stems for found in categories().get(stem, ())), "")


_WRITTEN_OUT = """burnish 1
fn step<T: floats>(edge: T, x: T) -> T = choose(x >= edge, 1, 0)
fn smoothstep<T: floats>(low: T, high: T, x: T) -> T = share * share * (3 - 2 * share) where {
    share = clamp((x - low) / (high - low), 0, 1)
}
fn inversesqrt<T: floats>(x: T) -> T = 1 / sqrt(x)
fn exp2<T: floats>(x: T) -> T = pow(2, x)
fn log2<T: floats>(x: T) -> T = log(x) / 0.6931471805599453
fn log10<T: floats>(x: T) -> T = log(x) / 2.302585092994046
fn degrees<T: floats>(x: T) -> T = x * 57.29577951308232
fn radians<T: floats>(x: T) -> T = x * 0.017453292519943295
fn sinh<T: floats>(x: T) -> T = (exp(x) - exp(-x)) / 2
fn cosh<T: floats>(x: T) -> T = (exp(x) + exp(-x)) / 2
fn tanh<T: floats>(x: T) -> T = 1 - 2 / (exp(2 * x) + 1)
fn trunc<T: floats>(x: T) -> T = sign(x) * floor(abs(x))
fn fma<T: floats>(x: T, y: T, z: T) -> T = x * y + z
fn reflect(i: vec3, n: vec3) -> vec3 = i - n * (2 * dot(n, i))
fn atan(x: float) -> float = atan2(x, 1.0)
"""
"""Builtins without a node, as what they mean."""


@cache
def written_out() -> dict[str, ast.Function]:
    """The functions in place of builtins that no node means, by their names."""
    file = parse(Source("<builtins>", _WRITTEN_OUT), Report())
    return {each.name.text: each for each in file.declarations if isinstance(each, ast.Function)}
