"""A copy of the repository, from which pip installs Burnish without a network.

pip finds all that Burnish needs in one folder of links to the packages of this environment, as if
they were installed already. It builds the wheel of the copy with them, too.
"""

from __future__ import annotations

import os
import shutil
import sysconfig
from collections.abc import Mapping
from importlib.metadata import distribution
from pathlib import Path

from ..docs.kit import ROOT
from ..suite.package import copy_package
from .kit import INTEGRATIONS, environment

NEEDED = ("click", "jinja2", "lark", "markupsafe", "platformdirs", "setuptools")
"""The packages that Burnish needs to be built and to run."""
TOP = (
    ".pre-commit-hooks.yaml", "CHANGELOG.md", "CONTRIBUTING.md", "LICENSE", "MANIFEST.in",
    "README.md", "SECURITY.md", "action.yml", "py.typed", "pyproject.toml",
)  # fmt: skip
"""The files of the root that belong to a clone, besides the modules."""


def copied(folder: Path) -> Path:
    """A copy of what a clone of the repository has, apart from tests, pages and examples."""
    copy_package(folder)
    shutil.copytree(INTEGRATIONS, folder / "integrations")
    for name in TOP:
        shutil.copy2(ROOT / name, folder)
    return folder


def offline(folder: Path, **more: str) -> Mapping[str, str]:
    """An environment in which pip installs the copy."""
    links = folder / "links"
    if not links.is_dir():
        links.mkdir()
        for name in NEEDED:
            for path in _tops(name):
                (links / path.name).symlink_to(path)
    settings = {"PIP_NO_INDEX": "1", "PIP_NO_BUILD_ISOLATION": "0", "PIP_NO_COMPILE": "1"}
    return environment(**settings, PYTHONPATH=str(links), **more)


def _tops(name: str) -> set[Path]:
    """The folders of a package beside each other: its modules, and what is said about it."""
    site = Path(sysconfig.get_path("purelib"))
    files = distribution(name).files or ()
    tops = {site / file.parts[0] for file in files if os.pardir not in file.parts}
    return {path for path in tops if path.is_dir() and path.name != "__pycache__"}
