"""The framebuffer that a job draws to, and from which its picture is read back."""

from __future__ import annotations

import ctypes
from collections.abc import Sequence

import moderngl

from ..pipeline import Pipeline
from ..readback import to_float
from ..render_state import DepthFormat, RenderTarget, TargetFormat
from .blending import write_all_lanes
from .context import (
    GL_COLOR,
    GL_COLOR_ATTACHMENT0,
    GL_COLOR_BUFFER_BIT,
    GL_DEPTH,
    GL_DEPTH32F_STENCIL8,
    GL_DEPTH_ATTACHMENT,
    GL_DEPTH_COMPONENT32F,
    GL_DEPTH_STENCIL_ATTACHMENT,
    GL_DRAW_FRAMEBUFFER,
    GL_FRAMEBUFFER,
    GL_NEAREST,
    GL_READ_FRAMEBUFFER,
    GL_RENDERBUFFER,
    GL_STENCIL,
    Functions,
)

STORAGE: dict[TargetFormat, tuple[int, str, int]] = {
    "r8unorm": (1, "f1", 0x8229),
    "rg8unorm": (2, "f1", 0x822B),
    "rgba8unorm": (4, "f1", 0x8058),
    "rgba8unorm-srgb": (4, "f1", 0x8C43),
    "r16float": (1, "f2", 0x822D),
    "rg16float": (2, "f2", 0x822F),
    "rgba16float": (4, "f2", 0x881A),
    "r32float": (1, "f4", 0x822E),
    "rg32float": (2, "f4", 0x8230),
    "rgba32float": (4, "f4", 0x8814),
}
"""The number of lanes, moderngl's type of a lane, and OpenGL's internal format."""


DEPTHS: dict[DepthFormat, tuple[int, int]] = {
    "depth32float": (GL_DEPTH_COMPONENT32F, GL_DEPTH_ATTACHMENT),
    "depth32float-stencil8": (GL_DEPTH32F_STENCIL8, GL_DEPTH_STENCIL_ATTACHMENT),
}
"""OpenGL's internal format, and what it is attached as."""
STENCIL_BITS = 0xFF


class Screen:
    """Colour targets and a depth buffer of one size, without a window.

    It calls OpenGL directly for what moderngl lacks: clearing and blending each target separately,
    and a depth buffer of 32-bit floats.
    """

    def __init__(
        self,
        context: moderngl.Context,
        functions: Functions,
        pipeline: Pipeline,
        size: tuple[int, int],
    ) -> None:
        self._context = context
        self._functions = functions
        self._targets = targets = pipeline.targets
        self._depths = DEPTHS[pipeline.depth_format]
        self._size = size
        samples = pipeline.samples
        self._framebuffer = context.framebuffer([_make(context, size, t) for t in targets])
        self._drawn = self._framebuffer
        if samples > 1:
            several = [_make(context, size, target, samples) for target in targets]
            self._drawn = context.framebuffer(several)
        self._drawn.use()
        self._depth = ctypes.c_uint()
        functions.glGenRenderbuffers(1, ctypes.byref(self._depth))
        functions.glBindRenderbuffer(GL_RENDERBUFFER, self._depth)
        storage, attachment = self._depths
        stored = samples if samples > 1 else 0  # OpenGL counts none where there is one.
        functions.glRenderbufferStorageMultisample(GL_RENDERBUFFER, stored, storage, *size)
        functions.glFramebufferRenderbuffer(
            GL_FRAMEBUFFER, attachment, GL_RENDERBUFFER, self._depth
        )

    def clear(self, colors: Sequence[tuple[float, float, float, float]], depth: float) -> None:
        """Clear every target to its colour, the depths, and stencil values to 0."""
        write_all_lanes(self._functions, len(colors))
        for number, color in enumerate(colors):
            lanes = (ctypes.c_float * 4)(*color)
            self._functions.glClearBufferfv(GL_COLOR, number, lanes)
        clear_depths(self._functions, depth, self._depths[1])

    def read(self, pipeline: Pipeline) -> tuple[bytes, ...]:
        """Each target in the form of a ``Picture``."""
        if self._drawn is not self._framebuffer:
            self._resolve()
        return tuple(self._read(number, pipeline) for number in range(len(self._targets)))

    def _resolve(self) -> None:
        """Write the mean of each pixel's samples to the targets that are read."""
        functions, area = self._functions, (0, 0, *self._size)
        functions.glBindFramebuffer(GL_READ_FRAMEBUFFER, self._drawn.glo)
        functions.glBindFramebuffer(GL_DRAW_FRAMEBUFFER, self._framebuffer.glo)
        for number in range(len(self._targets)):
            point = GL_COLOR_ATTACHMENT0 + number
            drawn = [0] * number + [point]
            functions.glReadBuffer(point)
            functions.glDrawBuffers(len(drawn), (ctypes.c_uint * len(drawn))(*drawn))
            functions.glBlitFramebuffer(*area, *area, GL_COLOR_BUFFER_BIT, GL_NEAREST)

    def _read(self, number: int, pipeline: Pipeline) -> bytes:
        widened = widened_format(self._targets[number].format)
        kind = "f4" if widened == "rgba32float" else "f1"
        texels = self._framebuffer.read(components=4, attachment=number, dtype=kind)
        return to_float(texels, widened, *self._size, pipeline.first_row)

    def release(self) -> None:
        """Free the targets and the depth buffer."""
        # When moderngl makes a framebuffer, it binds the last one again, which must still exist.
        self._context.detect_framebuffer(0).use()
        self._functions.glDeleteRenderbuffers(1, ctypes.byref(self._depth))
        for framebuffer in dict.fromkeys((self._drawn, self._framebuffer)):
            for attachment in framebuffer.color_attachments:
                attachment.release()
            framebuffer.release()


def clear_depths(functions: Functions, depth: float, attachment: int) -> None:
    """Clear the depths of the framebuffer that is bound, and stencil values to 0 if it has any."""
    functions.glDepthMask(1)
    functions.glStencilMask(STENCIL_BITS)
    functions.glClearBufferfv(GL_DEPTH, 0, (ctypes.c_float * 1)(depth))
    if attachment == GL_DEPTH_STENCIL_ATTACHMENT:
        functions.glClearBufferiv(GL_STENCIL, 0, (ctypes.c_int * 1)(0))


def widened_format(encoded: TargetFormat) -> TargetFormat:
    """The format of four lanes in which a target is read back."""
    if encoded.endswith("unorm"):
        return "rgba8unorm"
    return "rgba8unorm-srgb" if encoded.endswith("srgb") else "rgba32float"


def _make(
    context: moderngl.Context, size: tuple[int, int], target: RenderTarget, samples: int = 0
) -> moderngl.Texture:
    lanes, kind, internal_format = STORAGE[target.format]
    return context.texture(
        size, lanes, samples=samples, dtype=kind, internal_format=internal_format
    )
