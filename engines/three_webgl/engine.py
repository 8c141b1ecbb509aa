"""three.js's ``WebGLRenderer``, which takes whole shaders in GLSL."""

from __future__ import annotations

from ..engine import Engine
from .language import language
from .module import write

ENGINE = Engine(
    name="three-webgl", title="three.js's WebGLRenderer", targets=(), dialect=language,
    write_shaders=write,
)  # fmt: skip
