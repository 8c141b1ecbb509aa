"""Counts the work and the memory of a job, before it is sent to a driver.

Jobs and answers travel as texts, of which both ends have copies; ``runner.py`` asks before it makes
any of them. How long a program runs is measured as if the reference ran it.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...compiler.budget import check
from ...compiler.ir.shader import Shader
from ...compiler.reference.cost import check_operations
from ...compiler.reference.picture import PIXELS_AT_ONCE
from .drivers.capture_job import CaptureJob
from .drivers.draw_job import Draw, Job
from .drivers.kernel_job import KernelJob
from .drivers.texels import Image

TEXEL = 16
"""Bytes of a texel that is read back: four lanes of float32."""
COPIES = 8
"""The memory of all copies of a job and its answer, as a factor of their size: both ends have
bytes, a text, and the numbers that are made of it."""


def check_work(shader: Shader) -> None:
    """Raise ``BudgetError`` if loops of a program run for too many iterations.

    The limit is that of the reference: drivers that compute on processors would not end either.
    """
    check_operations([result.value for result in shader.results], PIXELS_AT_ONCE, shader.name)


def check_draws(job: Job) -> None:
    """Raise ``BudgetError`` if a job of draws sends and reads back too much."""
    of_pixel = TEXEL * len(job.pipeline.targets) * max(job.pipeline.layers, 1)
    back = sum(draw.width * draw.height * max(len(draw.layers), 1) for draw in job.draws)
    _check(back * of_pixel + sum(map(_sent, job.draws)))


def check_dispatches(job: KernelJob) -> None:
    """Raise ``BudgetError`` if a kernel job, with its buffers, sends and reads back too much."""
    of_texel = TEXEL * len(job.pipeline.images)
    size = 0
    for dispatch in job.dispatches:
        width, height, depth = dispatch.extent
        size += width * height * depth * of_texel + 2 * _lengths(dispatch.buffers)
        size += _lengths(dispatch.blocks) + sum(map(_texels, dispatch.textures))
    _check(size)


def check_captures(job: CaptureJob) -> None:
    """Raise ``BudgetError`` if a job of captures sends and reads back too much."""
    output = job.pipeline.stream_output
    back = 0 if output is None else output.stride * sum(job.most)
    _check(back + sum(map(_sent, job.draws)))


def _check(size: int) -> None:
    check("memory", size * COPIES, "what a driver is sent and sends back needs")


def _sent(draw: Draw) -> int:
    """The bytes of a draw."""
    parts = (*draw.vertices, draw.indices, *draw.blocks, *draw.buffers)
    layers = sum(map(_lengths, draw.layers))
    return _lengths(parts) + layers + sum(map(_texels, draw.textures))


def _texels(image: Image) -> int:
    return _lengths(image.levels)


def _lengths(parts: Iterable[bytes]) -> int:
    return sum(map(len, parts))
