"""The worker: ``python -m burnish.targets.runner.drivers.vulkan ICD [SECONDS]``.

``ICD`` is the JSON file by which a driver announces itself to Vulkan's loader, and ``SECONDS`` how
long one draw may take.
"""

from __future__ import annotations

import os
import sys

from ..serve import serve
from .driver import VulkanDriver

SECONDS = 60.0

LAVAPIPE = {
    # Its fast path for rgba8 textures rounds a filter's weights and sums to 8 bits, which is off by
    # up to 1.5 steps of the texture; the general path is exact to 4e-7. Its other short cuts
    # (brilinear, rho_approx) are off unless asked for.
    "GALLIVM_PERF": "no_aos_sampling",
    # Rasterising threads. Most time goes into compiling shaders, which one thread does in any case,
    # and it is for workers to share out the cores.
    "LP_NUM_THREADS": "1",
}
"""What Mesa's software driver reads when it starts; others do not look at it."""


def main(icd: str, seconds: str = "") -> None:
    """Serves until the input ends."""
    os.environ |= {"VK_DRIVER_FILES": icd, "VK_ICD_FILENAMES": icd, **LAVAPIPE}
    with VulkanDriver(icd, float(seconds or SECONDS)) as driver:
        serve(driver)


if __name__ == "__main__":
    main(*sys.argv[1:])
