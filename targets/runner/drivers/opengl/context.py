"""Creates an OpenGL context without a window, and calls functions that moderngl does not wrap."""

from __future__ import annotations

import ctypes
import os
from typing import Any

import moderngl

from ....toolchain.tools import tool_named
from .. import mesa
from ..choice import chosen
from ..device import DriverError

SOFTWARE = {"LIBGL_ALWAYS_SOFTWARE": "1", **mesa.SETTINGS}
"""Variables that make Mesa's software draw."""
SOFTWARE_NAMES = ("llvmpipe", "softpipe", "swrast")
"""The beginnings of the names of devices that are no hardware."""

CLIP_CONTROL = {
    "GL_LOWER_LEFT": 0x8CA1,
    "GL_UPPER_LEFT": 0x8CA2,
    "GL_NEGATIVE_ONE_TO_ONE": 0x935E,
    "GL_ZERO_TO_ONE": 0x935F,
}
"""The constants of ``glClipControl`` by their names."""

GL_COLOR = 0x1800
GL_DEPTH = 0x1801
GL_BLEND = 0x0BE2
GL_SCISSOR_TEST = 0x0C11
GL_FRAMEBUFFER = 0x8D40
GL_FRAMEBUFFER_SRGB = 0x8DB9
GL_COLOR_ATTACHMENT0 = 0x8CE0
GL_DEPTH_ATTACHMENT = 0x8D00
GL_DEPTH_COMPONENT32F = 0x8CAC
GL_DEPTH_STENCIL_ATTACHMENT = 0x821A
GL_DEPTH32F_STENCIL8 = 0x8CAD
GL_STENCIL = 0x1802
GL_TEXTURE_2D_MULTISAMPLE = 0x9100
GL_DRAW_FRAMEBUFFER = 0x8CA9
GL_COLOR_BUFFER_BIT = 0x4000
GL_NEAREST = 0x2600


class Functions:
    """OpenGL's own functions by their names: ``functions.glEnablei(GL_BLEND, 0)``.

    Arguments are ints, ``ctypes`` values and arrays; they are not checked.
    """

    def __init__(self) -> None:
        find = ctypes.CDLL("libEGL.so.1").eglGetProcAddress
        find.restype = ctypes.c_void_p
        find.argtypes = [ctypes.c_char_p]
        self._find = find

    def __getattr__(self, name: str) -> Any:
        address = self._find(name.encode())
        if not address:
            raise DriverError(f"the OpenGL driver has no {name}")
        function = ctypes.CFUNCTYPE(None)(address)
        setattr(self, name, function)
        return function


def create_context(wanted: str | None) -> moderngl.Context:
    """Create a context and make it current. Raises ``DriverError``, which says what to install.

    ``wanted`` is a part of a device's name, or its number; empty for the first one that is
    hardware, and ``None`` for Mesa's software, even if there is a GPU: its pictures are the same
    everywhere.
    """
    for name, value in (SOFTWARE if wanted is None else mesa.SETTINGS).items():
        os.environ.setdefault(name, value)
    if wanted is None:
        context = _software()
    else:
        # glcontext would believe this variable more than the number that it is given.
        os.environ.pop("GLCONTEXT_DEVICE_INDEX", None)
        context = _created(_chosen(wanted))
    context.gc_mode = "auto"
    # Colours are cleared and drawn in linear light, and stored as the target's format requires.
    context.enable_direct(GL_FRAMEBUFFER_SRGB)
    return context


def _software() -> moderngl.Context:
    try:
        return _created(0)
    except Exception as error:  # moderngl raises bare ``Exception`` for whatever EGL lacks
        install = tool_named("llvmpipe").install
        raise DriverError(f"there is no OpenGL 4.5: {error}; to install it: {install}") from None


def _created(number: int) -> moderngl.Context:
    # moderngl's stubs do not know the backend's arguments.
    settings: dict[str, Any] = {"backend": "egl", "device_index": number}
    return moderngl.create_context(require=450, standalone=True, **settings)


def _chosen(wanted: str) -> int:
    """The number of a device. EGL does not tell their names, so each has to be opened. Raises
    ``DriverError``."""
    numbers, names, problems = [], [], []
    for number in range(_device_count()):
        try:
            context = _created(number)
        except Exception as error:  # moderngl raises bare ``Exception`` for whatever EGL lacks
            problems.append(f"number {number}: {error}")
            continue
        names.append(context.info["GL_RENDERER"])
        numbers.append(number)
        context.release()
    if not numbers and problems:
        raise DriverError(f"no device has OpenGL 4.5: {'; '.join(problems)}")
    hardware = [not name.startswith(SOFTWARE_NAMES) for name in names]
    return numbers[chosen(names, hardware, wanted)]


def _device_count() -> int:
    """The number of EGL's devices. Raises ``DriverError``."""
    try:
        query, count = Functions().eglQueryDevicesEXT, ctypes.c_int()
    except OSError as error:
        raise DriverError(f"there is no EGL: {error}") from None
    query(0, None, ctypes.byref(count))
    return count.value
