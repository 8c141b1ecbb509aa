"""The library of nodes that the installed MaterialX brings along, and what is asked of it."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING


if TYPE_CHECKING:
    import MaterialX as mx



@cache
def library() -> mx.Document:
    """The nodes of MaterialX, parsed once a process."""
    import MaterialX as mx

    document = mx.createDocument()
    mx.loadLibraries(mx.getDefaultDataLibraryFolders(), mx.getDefaultDataSearchPath(), document)
    return document
