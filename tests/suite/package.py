"""The folders of the package, and copies of it that a test may change."""

from __future__ import annotations

import shutil
from pathlib import Path

ROOT = Path(__file__).parents[2]
FOLDERS = ("api", "commands", "compiler", "engines", "materialx", "stdlib", "support", "targets")
"""The folders that a wheel contains, beside ``generated``; tests are not among them."""


def copy_package(package: Path, *others: str) -> Path:
    """Copies the package to ``package``, a folder that must not exist yet, and returns it.

    ``others`` are more folders to copy, such as ``generated``. Files keep their times, so that what
    Python has compiled of them is not compiled again.
    """
    for name in (*FOLDERS, *others):
        shutil.copytree(ROOT / name, package / name)
    for path in ROOT.glob("*.py"):
        shutil.copy2(path, package)
    return package
