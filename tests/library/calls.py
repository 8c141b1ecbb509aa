"""Calls of functions of the library with many arguments at once, for truths with NumPy."""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.stages import TARGET
from burnish.compiler.reference.evaluate import evaluate

from ..semantics.kit import leaves, shader
from .kit import MESH, Floats

TEXTURES = ("texture2d", "texture2d_array")
"""Types of arguments that are no numbers."""


def called(imports: str, expression: str, width: int = 1, /, **given: Any) -> Floats:
    """The values of an expression, one row for each of the arguments that it names.

    An argument is an array of numbers, of vectors in rows, or of matrices; or a reader of a
    texture. With ``width`` lanes of more than one, the last axis has the lanes.
    """
    kinds = tuple((name, _kind(value)) for name, value in given.items())
    whole = _shader(imports, expression, width, kinds)
    values = {name: _lanes(value) for name, value in given.items()}
    with np.errstate(all="ignore"):
        root = whole.results_of(TARGET)[0].value
        found = evaluate(root, leaves(whole, {**MESH, **values}), np)
    shape = np.broadcast_shapes(*(lane.shape for value in values.values() for lane in flat(value)))
    rows = [_pixels(np.broadcast_to(np.asarray(lane, np.float64), shape)) for lane in found[:width]]
    return np.stack(rows, axis=-1) if width > 1 else rows[0]


def _pixels(lane: Floats) -> Floats:
    """One lane of all rows, or of a quad of pixels."""
    return lane.reshape(-1) if lane.shape[-2:] == (1, 1) else lane


def flat(value: Any) -> list[Floats]:
    """The lanes of an argument that has some."""
    if not isinstance(value, tuple):
        return []
    return [each for lane in value for each in (flat(lane) if isinstance(lane, tuple) else [lane])]


@cache
def _shader(
    imports: str, expression: str, width: int, kinds: tuple[tuple[str, str], ...]
) -> Shader:
    members = [f"{'map' if kind in TEXTURES else 'param'} {name} : {kind}" for name, kind in kinds]
    filled = ", ".join([expression, *["0"] * (4 - width)])
    return shader(
        f"{imports}\nmaterial M {{\n" + "\n".join(members) + f"\nfound = vec4({filled})\n}}\n"
        "pass P { target found : rgba32f = material.found }",
        pass_="P",
    )


class Quad:
    """A number or a vector for each of 2 by 2 neighbouring pixels; lanes come last. Vectors may
    have a first axis, for many quads."""

    def __init__(self, pixels: Any) -> None:
        self.pixels = np.asarray(pixels, np.float64)

    @property
    def lanes(self) -> tuple[Floats, ...]:
        """Each lane of the pixels."""
        return tuple(np.moveaxis(self.pixels, -1, 0)) if self.pixels.ndim > 2 else (self.pixels,)


def _kind(value: Any) -> str:
    """The type of an argument in the language."""
    if hasattr(value, "read"):
        return str(value.kind)
    if isinstance(value, Quad):
        return f"vec{len(value.lanes)}" if len(value.lanes) > 1 else "float"
    array = np.asarray(value)
    if array.ndim == 3:
        return f"mat{array.shape[-1]}"
    if array.ndim == 2:
        return f"vec{array.shape[-1]}"
    return "int" if array.dtype.kind == "i" else "float"


def _lanes(value: Any) -> Any:
    """An argument as the evaluator takes it: a tuple of lanes, each with all rows.

    Two more axes say that all pixels of a quad have the same.
    """
    if isinstance(value, Quad):
        return value.lanes
    if hasattr(value, "read"):
        return value
    array = np.asarray(value)[..., None, None]
    if array.ndim == 5:
        rows, columns = range(array.shape[1]), range(array.shape[2])
        return tuple(tuple(array[:, i, j] for i in rows) for j in columns)
    if array.ndim == 4:
        return tuple(array[:, i] for i in range(array.shape[1]))
    return (array,)


def scattered(count: int, width: int, reach: float = 1.0, seed: int = 5) -> Floats:
    """Points without a pattern, each lane up to ``reach`` away from 0."""
    return np.random.default_rng(seed).uniform(-reach, reach, (count, width))


def directions(count: int, seed: int = 7) -> Floats:
    """Directions without a pattern, of length one."""
    drawn = np.random.default_rng(seed).normal(size=(count, 3))
    return np.asarray(drawn / np.linalg.norm(drawn, axis=1, keepdims=True))


class Picture:
    """A texture whose reads are a function of the coordinate, and of the layer if there are any. It
    notes derivatives."""

    def __init__(
        self, color: Callable[..., tuple[Any, ...]], size: tuple[int, int] = (1, 1), *,
        layered: bool = False,
    ) -> None:  # fmt: skip
        self._color = color
        self._places = 2 if layered else 1
        self.kind = "texture2d_array" if layered else "texture2d"
        self._size = size
        self.steps: list[Any] = []
        """Both derivatives of each read that was given some."""

    def read(self, name: str, operands: tuple[Any, ...]) -> tuple[Any, ...]:
        """The value of a read."""
        if name == "texture_size":
            return self._size
        assert name in ("sample", "sample_grad", "sample_level"), name
        if name == "sample_grad":
            self.steps += operands[self._places :]
        return self._color(*(lane for place in operands[: self._places] for lane in place))
