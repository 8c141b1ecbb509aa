"""Makes the files that TypeScript needs beside the host's modules to check their types.

``python -m burnish.generate`` writes them beside the modules, so that editors find them, and the
tests write them into a copy of the host. Git ignores them, and they are not served.
"""

from __future__ import annotations

from pathlib import Path

from ...compiler.documents.typescript import typescript
from .serving.builtin_table import builtins_module
from .serving.modules import BUILTINS, SHAPES
from .serving.packages import Package
from .serving.shapes import shapes_module

_TYPES = "generated/documents.d.ts"
"""The path at which the modules import the types of documents."""
_BANNER = "// Made of the records of documents by `python -m burnish.generate`: do not edit."


def write_for_checking(host: Path) -> None:
    """Write the types of documents, and the modules that are generated, into a folder with the
    host's modules, unless they are there already. Raises ``OSError``."""
    made = {
        _TYPES: f"{_BANNER}\n\n{typescript(Package)}",
        BUILTINS: builtins_module(),
        SHAPES: shapes_module(),
    }
    for name, text in made.items():
        path = host / name
        if not path.is_file() or path.read_text("utf-8") != text:
            path.parent.mkdir(exist_ok=True)
            path.write_text(text, encoding="utf-8")
