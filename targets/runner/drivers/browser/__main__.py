"""The worker process: ``python -m burnish.targets.runner.drivers.browser webgpu|webgl2``."""

from __future__ import annotations

import sys

from ..serve import serve
from .driver import APIS, Browser

if __name__ == "__main__":
    if len(sys.argv) != 2 or sys.argv[1] not in APIS:
        sys.exit(f"usage: python -m burnish.targets.runner.drivers.browser {'|'.join(APIS)}")
    driver = Browser(sys.argv[1])
    try:
        serve(driver)
    finally:
        driver.close()
