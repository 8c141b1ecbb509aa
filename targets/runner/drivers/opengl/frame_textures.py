"""The textures of a frame: made through OpenGL's own functions, attached, copied and read back."""

from __future__ import annotations

import ctypes
from dataclasses import dataclass

from .....compiler.documents.plan import ResolveRow
from ..frame_job import Attachment, FrameTexels, FrameTexture
from ..readback import depths_to_float, to_float
from ..slots import TextureSlot
from .context import (
    GL_COLOR_ATTACHMENT0,
    GL_FRAMEBUFFER,
    GL_TEXTURE_2D_MULTISAMPLE,
    Functions,
)
from .formats import DEPTHS, STORAGE, widened_format
from .texture_units import (
    GL_DEPTH_COMPONENT,
    GL_FLOAT,
    GL_RGBA,
    GL_TEXTURE0,
    GL_TEXTURE_CUBE_MAP_POSITIVE_X,
    GL_TEXTURE_CUBE_MAP_SEAMLESS,
    GL_UNSIGNED_BYTE,
    TARGETS,
    set_state,
)

GL_PACK_ALIGNMENT = 0x0D05
GL_WRITE_ONLY = 0x88B9
GL_DEPTH_STENCIL = 0x84F9
GL_FLOAT_32_UNSIGNED_INT_24_8_REV = 0x8DAD
FACES = 6


@dataclass(slots=True)
class MadeTexture:
    """A texture on the device."""

    functions: Functions
    description: FrameTexture
    name: ctypes.c_uint
    internal_format: int

    @property
    def target(self) -> int:
        """The target by which OpenGL binds the texture: the constant of its type."""
        if self.description.samples > 1:
            return GL_TEXTURE_2D_MULTISAMPLE
        return TARGETS[self.description.dimension]

    def size(self, level: int) -> tuple[int, int]:
        """The width and the height of a level."""
        made = self.description
        return max(made.width >> level, 1), max(made.height >> level, 1)

    def point(self, number: int) -> int:
        """The attachment point of the texture, if it is the render target of this number."""
        match self.description.format:
            case "depth32float" | "depth32float-stencil8" as depths:
                return DEPTHS[depths][1]
            case _:
                return GL_COLOR_ATTACHMENT0 + number

    def attach(self, at: Attachment | ResolveRow, number: int, to: int = GL_FRAMEBUFFER) -> None:
        """Attach the texture to the bound framebuffer: as a target, or as the depths.

        If several layers are attached, a geometry stage chooses among all layers of the texture.
        """
        point = self.point(number)
        if self.description.dimension == "2d" or (isinstance(at, Attachment) and at.layers > 1):
            self.functions.glFramebufferTexture(to, point, self.name, at.level)
        else:
            self.functions.glFramebufferTextureLayer(to, point, self.name, at.level, at.layer)

    def bind(self, slot: TextureSlot, unit: int) -> None:
        """Bind the texture to a unit, with the state of a slot's sampler."""
        functions = self.functions
        functions.glEnable(GL_TEXTURE_CUBE_MAP_SEAMLESS)
        functions.glActiveTexture(GL_TEXTURE0 + unit)
        functions.glBindTexture(self.target, self.name)
        set_state(functions, self.target, slot, self.description.levels)

    def bind_image(self, unit: int) -> None:
        """Bind the first level as an image that a kernel writes."""
        self.functions.glBindImageTexture(
            unit, self.name, 0, 0, 0, GL_WRITE_ONLY, self.internal_format
        )

    def clear(self) -> None:
        """Clear the texture to transparent black, or depths to the far plane."""
        for level in range(self.description.levels):
            self.functions.glClearTexImage(self.name, level, *self._cleared())

    def _cleared(self) -> tuple[int, int, ctypes.Array[ctypes.c_float]]:
        """The lanes, their type and the contents of a texel that is cleared."""
        if self.description.has_stencil:
            # A depth, followed by a word that ends in the stencil value.
            return GL_DEPTH_STENCIL, GL_FLOAT_32_UNSIGNED_INT_24_8_REV, (ctypes.c_float * 2)(1.0)
        if self.description.is_depth:
            return GL_DEPTH_COMPONENT, GL_FLOAT, (ctypes.c_float * 1)(1.0)
        return GL_RGBA, GL_FLOAT, (ctypes.c_float * 4)()

    def copy_to(self, other: MadeTexture) -> None:
        """Copy the whole texture."""
        for level in range(self.description.levels):
            width, height = self.size(level)
            self.functions.glCopyImageSubData(
                self.name, self.target, level, 0, 0, 0, other.name, other.target, level, 0, 0, 0,
                width, height, self.description.layers,
            )  # fmt: skip

    def read(self) -> FrameTexels:
        """The texels of the first level."""
        made = self.description
        self.functions.glPixelStorei(GL_PACK_ALIGNMENT, 1)
        self.functions.glActiveTexture(GL_TEXTURE0)
        self.functions.glBindTexture(self.target, self.name)
        if made.dimension == "cube":
            faces = range(GL_TEXTURE_CUBE_MAP_POSITIVE_X, GL_TEXTURE_CUBE_MAP_POSITIVE_X + FACES)
            texels = b"".join(self._read(face, 1) for face in faces)
        else:
            texels = self._read(self.target, made.layers)
        return FrameTexels(made.width, made.height, made.layers, texels)

    def _read(self, part: int, layers: int) -> bytes:
        made = self.description
        count = made.width * made.height * layers
        match made.format:
            case "depth32float" | "depth32float-stencil8":
                depths = (ctypes.c_float * count)()
                self.functions.glGetTexImage(part, 0, GL_DEPTH_COMPONENT, GL_FLOAT, depths)
                return depths_to_float(bytes(depths))
            case colours:
                widened = widened_format(colours)
        is_float = widened == "rgba32float"
        texels = ((ctypes.c_float if is_float else ctypes.c_ubyte) * (4 * count))()
        kind = GL_FLOAT if is_float else GL_UNSIGNED_BYTE
        self.functions.glGetTexImage(part, 0, GL_RGBA, kind, texels)
        return to_float(bytes(texels), widened, made.width, made.height * layers)

    def release(self) -> None:
        """Free the texture."""
        self.functions.glDeleteTextures(1, ctypes.byref(self.name))


def make_frame_texture(functions: Functions, wanted: FrameTexture) -> MadeTexture:
    """A texture of a frame."""
    name = ctypes.c_uint()
    functions.glGenTextures(1, ctypes.byref(name))
    match wanted.format:
        case "depth32float" | "depth32float-stencil8" as depths:
            internal = DEPTHS[depths][0]
        case colours:
            internal = STORAGE[colours]
    made = MadeTexture(functions, wanted, name, internal)
    functions.glBindTexture(made.target, name)
    size = wanted.width, wanted.height
    if wanted.samples > 1:
        functions.glTexStorage2DMultisample(made.target, wanted.samples, internal, *size, 1)
    elif wanted.dimension == "2d_array":
        functions.glTexStorage3D(made.target, wanted.levels, internal, *size, wanted.layers)
    else:
        functions.glTexStorage2D(made.target, wanted.levels, internal, *size)
    return made
