"""Lists the modules of the host for web pages with their texts, for whoever gives them to a page.

``burnish view`` and the driver for browsers serve what ``host_modules`` returns, and people who put
a frame into a page of their own call ``write_modules`` (docs/hosts.md). The modules are the files
``*.js`` of ``targets/web_host``, and two that no file has: the table of builtins, and the shape of
packages.
"""

from __future__ import annotations

from pathlib import Path

from .builtin_table import builtins_module
from .shapes import shapes_module

BUILTINS = "generated/builtins.js"
"""The path at which the host imports the table of builtins."""
SHAPES = "generated/shapes.js"
"""The path at which the host imports the shape of packages."""

_FOLDER = Path(__file__).parents[1]
_PARTS = (".", "webgl2", "webgpu")
"""The folders with the host's files. What an editor has in ``generated`` is not served."""


def host_modules() -> dict[str, str]:
    """The text of each module by its path in the host; pages import ``host.js``."""
    paths = [path for part in _PARTS for path in sorted((_FOLDER / part).glob("*.js"))]
    found = {path.relative_to(_FOLDER).as_posix(): path.read_text("utf-8") for path in paths}
    return {**found, BUILTINS: builtins_module(), SHAPES: shapes_module()}


def write_modules(folder: Path) -> None:
    """Write all modules into a folder, which is made if it is not there. Raises ``OSError``."""
    for name, text in host_modules().items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
