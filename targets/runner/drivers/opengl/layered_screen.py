"""The framebuffer of a job whose targets have layers, all of which one draw can reach."""

from __future__ import annotations

import ctypes

import moderngl

from ..pipeline import Pipeline
from ..readback import to_float
from .context import (
    GL_COLOR_ATTACHMENT0,
    GL_FRAMEBUFFER,
    GL_TEXTURE_2D_ARRAY,
    Functions,
)
from .screen import STORAGE, Screen, widened_format

GL_RGBA, GL_FLOAT, GL_UNSIGNED_BYTE = 0x1908, 0x1406, 0x1401


class LayeredScreen(Screen):
    """Colour targets and a depth buffer, each of which is an array of pictures of one size.

    moderngl has no framebuffers with layers, so this one is OpenGL's own. The other one, which it
    stands before, keeps what moderngl knows of the viewport.
    """

    def __init__(
        self,
        context: moderngl.Context,
        functions: Functions,
        pipeline: Pipeline,
        size: tuple[int, int],
    ) -> None:
        super().__init__(context, functions, pipeline, size)
        self._layers, targets = pipeline.layers, pipeline.targets
        self._arrays = (ctypes.c_uint * (len(targets) + 1))()
        functions.glGenTextures(len(self._arrays), self._arrays)
        self._layered = ctypes.c_uint()
        functions.glGenFramebuffers(1, ctypes.byref(self._layered))
        functions.glBindFramebuffer(GL_FRAMEBUFFER, self._layered)
        for number, target in enumerate(targets):
            _, _, internal_format = STORAGE[target.format]
            self._attach(number, GL_COLOR_ATTACHMENT0 + number, internal_format)
        storage, attachment = self._depths
        self._attach(len(targets), attachment, storage)
        drawn = range(GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT0 + len(targets))
        functions.glDrawBuffers(len(targets), (ctypes.c_uint * len(targets))(*drawn))

    def _attach(self, number: int, attachment: int, internal_format: int) -> None:
        functions, array = self._functions, self._arrays[number]
        functions.glBindTexture(GL_TEXTURE_2D_ARRAY, array)
        functions.glTexStorage3D(GL_TEXTURE_2D_ARRAY, 1, internal_format, *self._size, self._layers)
        functions.glFramebufferTexture(GL_FRAMEBUFFER, attachment, array, 0)

    def _read(self, number: int, pipeline: Pipeline) -> bytes:
        widened = widened_format(self._targets[number].format)
        width, height = self._size
        whole = (ctypes.c_float if widened == "rgba32float" else ctypes.c_ubyte) * (
            4 * width * height * self._layers
        )
        texels = whole()
        kind = GL_FLOAT if widened == "rgba32float" else GL_UNSIGNED_BYTE
        self._functions.glBindTexture(GL_TEXTURE_2D_ARRAY, self._arrays[number])
        self._functions.glGetTexImage(GL_TEXTURE_2D_ARRAY, 0, GL_RGBA, kind, texels)
        data = bytes(texels)
        size = len(data) // self._layers
        return b"".join(
            to_float(data[start : start + size], widened, width, height, pipeline.first_row)
            for start in range(0, len(data), size)
        )

    def release(self) -> None:
        """Free everything."""
        super().release()
        self._functions.glDeleteFramebuffers(1, ctypes.byref(self._layered))
        self._functions.glDeleteTextures(len(self._arrays), self._arrays)
