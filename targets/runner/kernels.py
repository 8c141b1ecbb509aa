"""Runs kernels: the values of an instance as a dispatch, and its answer as elements.

``conform`` and tests call it; ``compiler/reference/kernel.py`` computes the same by the reference.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from .drivers.draw import Dispatch, KernelJob, Pipeline, Written
from .instances.instance import Instance


def job_of(
    reflection: Mapping[str, Any], pipeline: Pipeline, dispatches: Sequence[Dispatch]
) -> KernelJob:
    """What a driver is asked to compute with the pipeline of a kernel."""
    x, y, z = reflection["work_group"]
    return KernelJob(pipeline, (x, y, z), tuple(dispatches))


def dispatch_of(instance: Instance) -> Dispatch:
    """The bytes that a driver computes with, in the order of the reflection."""
    reflection: Mapping[str, Any] = instance.reflection
    blocks, textures, buffers = instance.blocks(), instance.textures(), instance.buffers()
    count = instance.extent()
    read = [buffers[row["name"]].bound for row in reflection["buffers"] if row["stages"]]
    # No API binds a buffer of no bytes.
    written = [bytes(max(count, 1) * row["stride"]) for row in reflection["results"]]
    return Dispatch(
        extent=(count, 1, 1),
        blocks=tuple(blocks[row["name"]] for row in reflection["blocks"]),
        textures=tuple(
            textures[row["name"]].image() for row in reflection["textures"] if row["stages"]
        ),
        buffers=(*read, *written),
    )


def elements_of(
    reflection: Mapping[str, Any], dispatch: Dispatch, written: Written
) -> dict[str, bytes]:
    """The bytes of the elements of each result, by name."""
    count, _, _ = dispatch.extent
    return {
        row["name"]: data[: count * row["stride"]]
        for row, data in zip(reflection["results"], written.buffers, strict=True)
    }
