"""Captures the vertices of a job by Vulkan's transform feedback (VK_EXT_transform_feedback)."""

from __future__ import annotations

import struct
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import dataclass, replace
from typing import Any

import vulkan as vk

from ..device import DriverError
from ..frame_job import Captured
from ..pipeline import Code, Pipeline
from .device import Gpu
from .memory import Buffer, make_buffer
from .stream_decorations import decorated

CAPTURES = vk.VK_BUFFER_USAGE_TRANSFORM_FEEDBACK_BUFFER_BIT_EXT
COUNTS = vk.VK_BUFFER_USAGE_TRANSFORM_FEEDBACK_COUNTER_BUFFER_BIT_EXT

COUNTER_SIZE = 4


def saying_places(pipeline: Pipeline) -> Pipeline:
    """The pipeline; if it captures, the module of its last stage says where the outputs go.

    A text in HLSL cannot say that, as Direct3D is told beside it.
    """
    stream = pipeline.stream_output
    if stream is None or stream.in_text:
        return pipeline
    name, last = list(pipeline.stages.items())[-1]
    code = Code(last.entry, spirv=decorated(last.spirv, stream))
    return replace(pipeline, stages={**pipeline.stages, name: code})


@dataclass(frozen=True, slots=True)
class Captures:
    """The buffer that gets the vertices of a draw, and the one that gets the number of bytes."""

    gpu: Gpu
    stride: int
    vertices: Buffer
    counter: Buffer

    @classmethod
    def of(cls, owned: ExitStack, gpu: Gpu, most: int, stride: int) -> Captures:
        """Room for so many vertices of so many bytes. Raises ``DriverError`` if the device does not
        capture any."""
        if not gpu.transform_feedback:
            raise DriverError("the device has no transform feedback (VK_EXT_transform_feedback)")
        return cls(
            gpu,
            stride,
            make_buffer(owned, gpu, CAPTURES, max(most, 1) * stride),
            make_buffer(owned, gpu, COUNTS, COUNTER_SIZE),
        )

    @contextmanager
    def recording(self, commands: Any) -> Iterator[None]:
        """Capture the vertices of the commands that are recorded inside the ``with`` block."""
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

    def wait_for_host(self, commands: Any) -> None:
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

    def captured(self) -> Captured:
        """The captured vertices, after the commands were run. Raises ``DriverError``."""
        (written,) = struct.unpack("<I", bytes(self.counter.mapped[0:COUNTER_SIZE]))
        if written > self.vertices.size or written % self.stride:
            raise DriverError(f"{written} bytes were captured, into {self.vertices.size}")
        return Captured(written // self.stride, bytes(self.vertices.mapped[0:written]))
