"""What holds in all tests: every graph is verified after every pass."""

import os

from burnish.compiler.passes.checkpoint import VARIABLE

os.environ[VARIABLE] = "1"
