"""The table of builtin functions and operators, by name.

Each module holds the rows of one theme. ``row.py`` says what the columns mean and who reads them.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

from . import (
    arithmetic,
    bits,
    common,
    comparison,
    conversion,
    derivative,
    exponential,
    geometry,
    hyperbolic,
    matrix,
    packing,
    texture,
    trigonometry,
    work_group,
)
from .row import Builtin

_THEMES = (
    arithmetic,
    comparison,
    common,
    exponential,
    trigonometry,
    hyperbolic,
    geometry,
    matrix,
    conversion,
    bits,
    packing,
    texture,
    derivative,
    work_group,
)

BUILTINS: Mapping[str, Builtin] = MappingProxyType(
    {row.name: row for theme in _THEMES for row in theme.ROWS}
)
"""Every builtin, in the order of the manual."""

__all__ = ["BUILTINS", "Builtin"]
