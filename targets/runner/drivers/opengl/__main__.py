"""The worker process: ``python -m burnish.targets.runner.drivers.opengl``."""

from __future__ import annotations

from ..serve import serve
from .driver import OpenGL

if __name__ == "__main__":
    serve(OpenGL())
