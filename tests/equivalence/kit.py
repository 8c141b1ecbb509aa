"""Materials to compare, and a second opinion: the reference's numbers at random points."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from typing import Any
from zlib import crc32

import numpy as np

from burnish.compiler.equivalence.comparing import Comparison, Settings, compare
from burnish.compiler.equivalence.domain import Domain
from burnish.compiler.equivalence.leaves import Leaves, Source
from burnish.compiler.equivalence.programs import flat, name_of
from burnish.compiler.equivalence.term import Term
from burnish.compiler.equivalence.terms import Terms
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.shader import Shader
from burnish.compiler.reference.evaluate import Evaluator
from burnish.compiler.reference.namespace import Lanes

from ..passes.kit import shader

NUMBERS = "\n".join(f"param {name} : float in 0..1 = 0.5" for name in "xyz")
EVERYWHERE = Domain({}, {})


def material(equations: str, parameters: str = NUMBERS) -> str:
    """A file with one material; a single expression is the grey of its colour."""
    if not re.search(r"(?<![<>=])=(?!=)", equations):
        equations = f"color = vec3({equations})"
    return f"burnish 1\nmaterial M {{\n{parameters}\n{equations}\n}}\n"


def compared(first: str, second: str, parameters: str = NUMBERS, **settings: Any) -> Comparison:
    """The comparison of two materials with the same parameters."""
    one, other = (shader(material(each, parameters)) for each in (first, second))
    return compare(one, other, Settings(**settings))


def numbers(given: Shader, count: int, seed: int) -> dict[str, list[Any]]:
    """The lanes of each result at random points, by the reference alone."""
    roots = [result.value for result in given.results]
    evaluator = Evaluator(_Values(given, count, seed), np)
    with np.errstate(all="ignore"):
        values = [evaluator.value(root) for root in roots]
    return {
        name_of(result): [np.broadcast_to(lane, (count, 1, 1)) for lane in flat(value)]
        for result, value in zip(given.results, values, strict=True)
    }


class _Values:
    """Random numbers for each variable that a leaf consists of, and smooth textures."""

    def __init__(self, given: Shader, count: int, seed: int) -> None:
        self._leaves = Leaves(Terms(), EVERYWHERE, given.parameters)
        self._shape, self._seed = (count, 1, 1), seed
        """Each point is a quad of pixels that are all alike."""

    def __call__(self, node: Node) -> Lanes | None:
        found = self._leaves(node)
        if found is None or node.op in ("texture", "buffer"):
            return found if found is None else (_Contents(found[0], self),)
        return self.of(found)

    def of(self, lanes: Lanes) -> Lanes:
        """The numbers of terms that are variables."""
        return tuple(
            self.of(lane) if isinstance(lane, tuple) else self.number(lane) for lane in lanes
        )

    def number(self, lane: Any) -> Any:
        """The numbers of one variable: some at the ends of its range."""
        variable = lane.data
        chance = np.random.default_rng(crc32(variable.name.encode()) + self._seed)
        found = chance.uniform(variable.low, variable.high, self._shape)
        ends = np.asarray([variable.low, variable.high, 0.0, 1.0])
        end = np.clip(ends[chance.integers(0, 4, self._shape)], variable.low, variable.high)
        found = np.where(chance.uniform(0.0, 1.0, self._shape) < 0.2, end, found)
        if variable.kind == "b":
            return found > 0.5
        if variable.vector:  # A fixed direction has length one at all points.
            return np.asarray({"x": 0.36, "y": 0.48, "z": 0.8}[variable.name[-1]])
        return np.rint(found).astype(np.int64) if variable.kind == "i" else found


class _Contents:
    """A texture or a buffer whose numbers change smoothly with the place."""

    def __init__(self, symbolic: Any, values: _Values) -> None:
        self._symbolic, self._values = symbolic, values

    def read(self, name: str, operands: Sequence[Lanes]) -> Lanes:
        """What a texture has at a place."""
        lanes = self._symbolic.read(name, ())
        place = [lane for operand in operands for lane in operand]
        return tuple(_smooth(lane, place) for lane in lanes)

    def element(self, position: Any) -> Lanes:
        """An element of a buffer."""
        return self._of(self._symbolic.element(0), position)

    def _of(self, lanes: Lanes, position: Any) -> Lanes:
        return tuple(
            self._of(lane, position) if isinstance(lane, tuple) else _smooth(lane, [position])
            for lane in lanes
        )


def _smooth(lane: Term, place: Sequence[Any]) -> Any:
    source = lane.data
    assert isinstance(source, Source)
    chance = np.random.default_rng(crc32(source.name.encode()))
    wave: Any = 1.0
    for coordinate in place:
        wave = wave + chance.uniform(0.5, 2.0) * coordinate
    value = source.low + (source.high - source.low) * (0.5 + 0.5 * np.sin(wave))
    if source.kind == "b":
        return value > 0.5
    return np.floor(value).astype(np.int64) if source.kind == "i" else value


def apart(one: Shader, other: Shader, count: int, seed: int) -> Iterator[tuple[str, float]]:
    """The lanes that differ at random points, with the largest difference beside what they are."""
    first, second = (numbers(each, count, seed) for each in (one, other))
    for name, lanes in first.items():
        for x, y in zip(lanes, second[name], strict=True):
            x, y = np.asarray(x, np.float64), np.asarray(y, np.float64)  # noqa: PLW2901
            with np.errstate(all="ignore"):
                difference = np.abs(x - y) / np.maximum(1.0, np.maximum(np.abs(x), np.abs(y)))
            counted = (np.abs(x) < 1e30) & (np.abs(y) < 1e30)
            yield name, float(np.where(counted, difference, 0.0).max())
