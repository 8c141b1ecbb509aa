"""Lets pytest keep what it makes of the tests' modules, and of those of its plugins.

``pyproject.toml`` makes this the first plugin of pytest, in each worker of pytest-xdist too. pytest
rewrites the ``assert`` of all these modules, which takes a process up to half a minute, and keeps
them as bytecode, unless ``PYTHONDONTWRITEBYTECODE`` is set: then each process would rewrite them
again. Programs that tests start are not affected.
"""

from __future__ import annotations

import sys

sys.dont_write_bytecode = False
