"""Computes what a kernel writes: every result for all elements at once, with bounds.

It evaluates the same graphs by the same definitions as the pictures. A device's value of each lane
has to lie between two numbers.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..ir.kernel import invocations
from ..ir.leaves import Resource
from ..ir.node import Node
from ..ir.scattering import scattered
from ..ir.shader import Shader, Store
from ..ir.stages import COMPUTED, STORE
from .bounds import Bounded, Errors, exact
from .evaluate import Evaluator
from .held_values import HeldValues, as_rounded, rounded_constants
from .in_groups import InGroups
from .namespace import Lanes
from .picture.sampler import TextureReader
from .picture.scene import RasterRules, Texels
from .picture.texels import Image
from .scattering import joined

Array = NDArray[Any]


@dataclass(frozen=True, slots=True)
class Lane:
    """One lane of what a result writes, for all elements."""

    store: Store
    lane: int
    kind: str
    """``f`` for floats, ``i`` for integers."""
    value: Array
    low: Array
    high: Array


def computed(
    shader: Shader,
    values: Mapping[str, Any],
    textures: Mapping[str, Texels],
    count: int,
    lengths: Mapping[str, int],
    errors: Errors,
    rules: RasterRules,
) -> Sequence[Lane]:
    """The lanes of every part that the kernel writes, in the order of its results.

    ``values`` are those of parameters and buffers by name, ``count`` is how many invocations there
    are, and ``lengths`` says how many elements each buffer has that is written. Raises
    ``ValueError`` for a shader that is no kernel, and where a value is missing.
    """
    if shader.chain != COMPUTED:
        raise ValueError(f"{shader.name} is no kernel.")
    index = exact(np.arange(count, dtype=np.int64))
    held = HeldValues(values, as_rounded)
    readers: dict[Resource, TextureReader] = {}

    def leaves(node: Node) -> Lanes | None:
        if node.op == "input":
            return (index,)
        if isinstance(node.data, Resource):
            if node.data not in readers:
                image = Image(textures[node.data.name], node.data, rules)
                readers[node.data] = TextureReader(image)
            return (readers[node.data],)
        return held.value(node)

    assert shader.work_group is not None
    groups = InGroups(errors, count, invocations(shader.work_group))
    evaluator = Evaluator(leaves, groups, rounded_constants)

    def of_all(node: Node) -> list[Bounded]:
        lanes = evaluator.value(node)
        bounded = (lane if isinstance(lane, Bounded) else exact(lane) for lane in lanes)
        return [lane.spread((count,)) for lane in bounded]

    found: list[Lane] = []
    with np.errstate(all="ignore"):
        for result in shader.results_of(STORE):
            assert result.store is not None
            for number, whole in enumerate(of_all(result.value)):
                each = slice(None, None, result.store.of_group or 1)
                ends = (whole.value, whole.low, whole.high)
                arrays = (np.asarray(end)[each] for end in ends)
                found.append(Lane(result.store, number, whole.kind, *arrays))
        for row in scattered(shader.results):
            parts = (of_all(part)[0] for part in (row.value, row.place, row.condition))
            length = lengths[row.store.buffer.name]
            found.append(Lane(row.store, 0, "i", *joined(row.store, length, *parts)))
    return found
