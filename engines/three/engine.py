"""three.js, whose node materials take functions in WGSL and GLSL."""

from __future__ import annotations

from ..engine import Engine
from . import slots
from .module import GLSL, WGSL, write

ENGINE = Engine(
    name="three", title="three.js", targets=(WGSL, GLSL), write=write, taken=slots.TAKEN
)
