"""The worker process: ``python -m burnish.targets.runner.drivers.vulkan ICD [SECONDS]``.

``ICD`` is the JSON file that announces a driver to Vulkan's loader, and ``SECONDS`` is how long one
draw may take.
"""

from __future__ import annotations

import os
import sys

from ..serve import serve
from .driver import VulkanDriver

SECONDS = 60.0

LAVAPIPE = {
    # Its fast path for rgba8 textures rounds a filter's weights and sums to 8 bits, which is wrong
    # by up to 1.5 steps of the texture; the general path is exact to 4e-7. Its other approximations
    # (brilinear, rho_approx) are off by default.
    "GALLIVM_PERF": "no_aos_sampling",
    # The number of rasterising threads. Most time is spent on compiling shaders, which takes one
    # thread in any case, and there is a worker for each core.
    "LP_NUM_THREADS": "1",
}
"""The variables that Mesa's software driver reads when it starts; other drivers ignore them."""


def main(icd: str, seconds: str = "") -> None:
    """Serve until the input ends."""
    os.environ |= {"VK_DRIVER_FILES": icd, "VK_ICD_FILENAMES": icd, **LAVAPIPE}
    with VulkanDriver(icd, float(seconds or SECONDS)) as driver:
        serve(driver)


if __name__ == "__main__":
    main(*sys.argv[1:])
