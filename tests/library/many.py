"""Values of the library's functions for many arguments: for tests of formulas and integrals.

A kernel computes an expression for each element, as the reference does, in float64.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

import burnish
from burnish.compiler.reference.kernel import computed
from burnish.compiler.reference.picture import RasterRules
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.reference import texels_of, values_for

Array = NDArray[np.float64]
COUNT = 64


def singles(values: Any) -> Array:
    """The numbers that float32 has, which buffers hold."""
    return np.asarray(values, np.float32).astype(np.float64)


def numbers(low: float, high: float, seed: int, lanes: int = 1, count: int = COUNT) -> Array:
    """Numbers without a pattern; with several lanes, an array of vectors."""
    shape = count if lanes == 1 else (count, lanes)
    return singles(np.random.default_rng(seed).uniform(low, high, shape))


def directions(seed: int, *, above: bool = False, count: int = COUNT) -> Array:
    """Vectors of length one, to all sides or only to those with z above 0."""
    arrows = np.random.default_rng(seed).normal(size=(count, 3))
    if above:
        arrows[:, 2] = np.abs(arrows[:, 2]) + 0.05
    return singles(arrows / np.linalg.norm(arrows, axis=1, keepdims=True))


def values(module: str, expression: str, kind: str = "float", /, **given: Any) -> Array:
    """An expression of some kind for each element of what is given: numbers, or vectors with their
    lanes last. What is given is as long as the longest, or a single number or vector.
    """
    arrays = {name: np.atleast_1d(np.asarray(value, np.float32)) for name, value in given.items()}
    longest = max(arrays, key=lambda name: len(arrays[name]))
    members = "\n".join(
        f"buffer {name}_of : {'float' if array.ndim == 1 else f'vec{array.shape[1]}'}[]\n"
        f"{name} = {name}_of[index mod {name}_of.count]"
        for name, array in arrays.items()
    )
    kernel = burnish.compile(
        f"import {module}\nkernel Many {{\n{members}\n"
        f"result found : {kind}[{longest}_of.count] = {expression}\n}}",
        (), keep_graphs=True,
    )["Many"]  # fmt: skip
    instance = Instance(kernel.reflection)
    for name, array in arrays.items():
        instance.set(f"{name}_of", array)
    lanes = computed(
        kernel.shader, values_for(kernel.shader, instance), texels_of(instance), instance.extent(),
        instance.result_counts(), None, RasterRules(1, 1),
    )  # fmt: skip
    found = [np.asarray(lane.value, np.float64) for lane in lanes]
    return found[0] if kind == "float" else np.stack(found[: int(kind[-1])], axis=-1)


def dots(a: Array, b: Array) -> Array:
    """The products of vectors, one by one."""
    return np.asarray((a * b).sum(axis=-1))


def halves(a: Array, b: Array) -> Array:
    """The directions halfway between others."""
    both = a + b
    return np.asarray(both / np.linalg.norm(both, axis=-1, keepdims=True))


def half_sphere(rings: int = 96, spokes: int = 192) -> tuple[Array, Array]:
    """Directions around +z with their solid angles: Gauss's rings, and equal steps around."""
    nodes, weights = np.polynomial.legendre.leggauss(rings)
    z, turn = np.meshgrid(
        (nodes + 1) / 2, 2 * np.pi * (np.arange(spokes) + 0.5) / spokes, indexing="ij"
    )
    r = np.sqrt(1 - z**2)
    arrows = np.stack([r * np.cos(turn), r * np.sin(turn), z], axis=-1).reshape(-1, 3)
    return singles(arrows), np.repeat(weights / 2 * 2 * np.pi / spokes, spokes)


def seen_from(cosine: float, turn: float = 0.4) -> Array:
    """The direction at this cosine above the surface."""
    r = np.sqrt(1 - cosine**2)
    return singles([[r * np.cos(turn), r * np.sin(turn), cosine]])


def albedo(module: str, reflectance: str, cosine: float, /, **given: Any) -> float:
    """The share of light that is sent to all sides of light from one: of a reflectance, per
    steradian, of ``to_light`` and ``to_eye``.
    """
    arrows, weights = half_sphere()
    found = values(module, reflectance, to_light=arrows, to_eye=seen_from(cosine), **given)
    return float((found * arrows[:, 2] * weights).sum())
