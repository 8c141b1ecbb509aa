"""Runs kernels: the values of an instance as a dispatch, and its answer as elements.

``conform`` and tests call it; ``compiler/reference/kernel.py`` computes the same by the reference.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from .drivers.draw import Dispatch
from .instances.instance import Instance


def dispatch_of(instance: Instance) -> Dispatch:
    """The bytes that a driver computes with, in the order of the reflection."""
    reflection: Mapping[str, Any] = instance.reflection
    blocks, textures, buffers = instance.blocks(), instance.textures(), instance.buffers()
    return Dispatch(
        count=instance.extent(),
        blocks=tuple(blocks[row["name"]] for row in reflection["blocks"]),
        textures=tuple(
            textures[row["name"]].image() for row in reflection["textures"] if row["stages"]
        ),
        buffers=tuple(buffers[row["name"]].bound for row in reflection["buffers"] if row["stages"]),
    )
