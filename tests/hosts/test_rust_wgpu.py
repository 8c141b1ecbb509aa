"""The host in Rust: built by Cargo with wgpu, it draws what Burnish's own host draws."""

from __future__ import annotations

import os
import re
import shutil
from collections.abc import Callable
from pathlib import Path

import platformdirs
import pytest

from burnish.targets.runner.routes import ROUTES

from ..integrations.kit import INTEGRATIONS, environment, tool
from ..suite.processes import run
from .expecting import SCENES, Picture, difference
from .scene import COMMON

pytestmark = pytest.mark.xdist_group("rust-wgpu")

HOST = COMMON.parent / "rust-wgpu"
GLUE = re.compile(r"// -- glue\n(.*?)\n *// -- end of glue", re.DOTALL)
MOST_GLUE = 15
"""The lines that may stand between the binding and the calls of wgpu."""
LIMIT = 1200
"""Seconds in which Cargo downloads and builds wgpu: 75 on a processor of its own."""
