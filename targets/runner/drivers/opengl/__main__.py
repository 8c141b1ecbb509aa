"""The worker process: ``python -m burnish.targets.runner.drivers.opengl [DEVICE]``.

Without ``DEVICE`` it draws with Mesa's software. Otherwise that is a part of the name of a device
of the machine, or its number; if it is empty, the first one that is hardware is taken, or else the
first one.
"""

from __future__ import annotations

import sys

from ..serve import serve
from .driver import OpenGL

if __name__ == "__main__":
    serve(OpenGL(*sys.argv[1:]))
