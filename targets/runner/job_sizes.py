"""Counts the work and the memory of a job, before it is sent to a driver.

The bytes of a job follow its packet through a pipe, as those of the answer do, and both ends have
some copies of them; ``runner.py`` asks before it makes any. How long a program runs is measured as
if the reference ran it.
"""

from __future__ import annotations

from collections.abc import Iterable

from ...compiler.budget import check
from ...compiler.ir.shader import Shader
from ...compiler.reference.cost import check_operations
from ...compiler.reference.picture import PIXELS_AT_ONCE
from .drivers.frame_job import FrameDraw, FrameJob, FrameStep
from .drivers.texels import Image

TEXEL = 16
"""Bytes of a texel that is read back: four lanes of float32."""
COPIES = 5
"""The memory of all copies of a job and its answer, as a factor of their size. Both ends have the
parts of a record and these joined for the pipe, and the store has them packed and compressed. With
128 MB, both processes together took at most 3.3 times the size of eight-bit textures and of
buffers, and 5.0 times that of float32 textures on a device in the same memory."""


def check_work(shader: Shader) -> None:
    """Raise ``BudgetError`` if loops of a program run for too many iterations.

    The limit is that of the reference: drivers that compute on processors would not end either.
    """
    check_operations([result.value for result in shader.results], PIXELS_AT_ONCE, shader.name)


def check_job(job: FrameJob) -> None:
    """Raise ``BudgetError`` if a job sends and reads back too much."""
    size = sum(each.size for each in job.buffers)
    for step in job.steps:
        size += _read_back(job, step) + sum(map(_sent, step.draws))
    check("memory", size * COPIES, "what a driver is sent and sends back needs")


def _read_back(job: FrameJob, step: FrameStep) -> int:
    textures = (job.textures[number] for number in step.read)
    size = sum(TEXEL * each.width * each.height * each.layers for each in textures)
    size += sum(job.buffers[number].size for number in step.read_buffers)
    if step.captures is not None:
        outputs = (job.pipelines[each.pipeline].stream_output for each in step.draws)
        size += sum(step.captures * output.stride for output in outputs if output is not None)
    return size


def _sent(drawn: FrameDraw) -> int:
    """The bytes of a draw or a dispatch."""
    values, draw = drawn.values, drawn.draw
    parts = [*values.blocks, *values.buffers]
    if draw is not None:
        parts += [*draw.vertices, draw.indices]
    return _lengths(parts) + sum(map(_texels, values.textures))


def _texels(image: Image) -> int:
    return _lengths(image.levels)


def _lengths(parts: Iterable[bytes]) -> int:
    return sum(map(len, parts))
