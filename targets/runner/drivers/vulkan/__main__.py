"""The worker process: ``python -m burnish.targets.runner.drivers.vulkan ICD [DEVICE [SECONDS]]``.

``ICD`` is the JSON file that announces a driver to Vulkan's loader; if it is empty, the loader
finds all drivers of the machine. ``DEVICE`` is a part of a device's name, or its number in the list
of all; if it is empty, the first one that is real hardware is taken, or else the first one.
``SECONDS`` is how long one draw may take.
"""

from __future__ import annotations

import os
import sys

from .. import mesa
from ..serve import serve
from .driver import VulkanDriver

SECONDS = 60.0


def main(icd: str, device: str = "", seconds: str = "") -> None:
    """Serve until the input ends."""
    os.environ |= mesa.SETTINGS
    if icd:
        os.environ |= {"VK_DRIVER_FILES": icd, "VK_ICD_FILENAMES": icd}
    with VulkanDriver(icd, float(seconds or SECONDS), device) as driver:
        serve(driver)


if __name__ == "__main__":
    main(*sys.argv[1:])
