"""Captures the vertices of a job by Vulkan's transform feedback (VK_EXT_transform_feedback)."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from typing import Any

import vulkan as vk

from ..capture_job import Captured, CaptureJob
from ..checks import check_capture
from ..device import DriverError
from ..draw_job import Job
from ..pipeline import Code, Pipeline
from .device import Gpu
from .job import Painter
from .limits import check_limits
from .memory import Buffer, make_buffer
from .stream_decorations import decorated

CAPTURES = vk.VK_BUFFER_USAGE_TRANSFORM_FEEDBACK_BUFFER_BIT_EXT
COUNTS = vk.VK_BUFFER_USAGE_TRANSFORM_FEEDBACK_COUNTER_BUFFER_BIT_EXT

COUNTER_SIZE = 4


def capture_job(gpu: Gpu, job: CaptureJob) -> list[Captured]:
    """What each draw captures. Raises ``DriverError``, and ``VkError`` for calls that fail."""
    check_capture(job)
    if not gpu.transform_feedback:
        raise DriverError("the device has no transform feedback (VK_EXT_transform_feedback)")
    drawn = Job(_saying_places(job.pipeline), job.draws)
    check_limits(gpu, drawn)
    with ExitStack() as owned:
        painter = Painter(owned, gpu, drawn)
        stream = drawn.pipeline.stream_output
        assert stream is not None
        found = []
        for draw, most in zip(job.draws, job.most, strict=True):
            target = _Target.of(owned, gpu, max(most, 1) * stream.stride)
            painter.render(draw, target.recording, target.read_back)
            found.append(target.captured(stream.stride))
        return found


def _saying_places(pipeline: Pipeline) -> Pipeline:
    """The pipeline with a last stage whose module says where its outputs go.

    A text in HLSL cannot say that, as Direct3D is told beside it.
    """
    stream = pipeline.stream_output
    assert stream is not None
    if stream.in_text:
        return pipeline
    name, last = list(pipeline.stages.items())[-1]
    code = Code(last.entry, spirv=decorated(last.spirv, stream))
    return replace(pipeline, stages={**pipeline.stages, name: code})


@dataclass(frozen=True, slots=True)
class _Target:
    """The buffer that gets the vertices, and the one that gets the number of bytes."""

    gpu: Gpu
    vertices: Buffer
    counter: Buffer

    @classmethod
    def of(cls, owned: ExitStack, gpu: Gpu, size: int) -> _Target:
        """Room for so many bytes."""
        return cls(
            gpu,
            make_buffer(owned, gpu, CAPTURES, size),
            make_buffer(owned, gpu, COUNTS, COUNTER_SIZE),
        )

    @contextmanager
    def recording(self, commands: Any) -> Iterator[None]:
        """Capture what is recorded inside."""
        bind, begin, end = (
            vk.vkGetDeviceProcAddr(self.gpu.device, name)
            for name in (
                "vkCmdBindTransformFeedbackBuffersEXT",
                "vkCmdBeginTransformFeedbackEXT",
                "vkCmdEndTransformFeedbackEXT",
            )
        )
        bind(commands, 0, 1, [self.vertices.handle], [0], [self.vertices.size])
        begin(commands, 0, 0, None, None)
        yield
        end(commands, 0, 1, [self.counter.handle], [0])

    def read_back(self, commands: Any) -> None:
        """Let the host read the vertices and their number when the commands have been run."""
        barrier = vk.VkMemoryBarrier(
            srcAccessMask=vk.VK_ACCESS_TRANSFORM_FEEDBACK_WRITE_BIT_EXT
            | vk.VK_ACCESS_TRANSFORM_FEEDBACK_COUNTER_WRITE_BIT_EXT,
            dstAccessMask=vk.VK_ACCESS_HOST_READ_BIT,
        )
        vk.vkCmdPipelineBarrier(
            commands,
            vk.VK_PIPELINE_STAGE_TRANSFORM_FEEDBACK_BIT_EXT,
            vk.VK_PIPELINE_STAGE_HOST_BIT,
            0, 1, [barrier], 0, None, 0, None,
        )  # fmt: skip

    def captured(self, stride: int) -> Captured:
        """What was captured, after the commands were run."""
        (written,) = struct.unpack("<I", bytes(self.counter.mapped[0:COUNTER_SIZE]))
        if written > self.vertices.size or written % stride:
            raise DriverError(f"{written} bytes were captured, into {self.vertices.size}")
        return Captured(written // stride, bytes(self.vertices.mapped[0:written]))
