"""The worker process: ``python -m burnish.targets.runner.drivers.wgpu [DEVICE]``.

``DEVICE`` is a part of a device's name, or its number in the list of all; without it, the first one
that is real hardware is taken, or else the first one.
"""

from __future__ import annotations

import os
import sys
import tempfile

from .. import mesa
from ..serve import serve
from .driver import Wgpu

if __name__ == "__main__":
    # Some Vulkan loaders write a message to the terminal if it is not set; nothing is put there.
    os.environ.setdefault("XDG_RUNTIME_DIR", tempfile.gettempdir())
    os.environ |= mesa.SETTINGS
    serve(Wgpu(*sys.argv[1:]))
