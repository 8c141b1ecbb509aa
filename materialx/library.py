"""The library of nodes that the installed MaterialX brings along, and what is asked of it."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import MaterialX


@cache
def library() -> MaterialX.Document:
    """The nodes of MaterialX, parsed once a process."""
    import MaterialX

    document = MaterialX.createDocument()
    MaterialX.loadLibraries(
        MaterialX.getDefaultDataLibraryFolders(), MaterialX.getDefaultDataSearchPath(), document
    )
    return document
