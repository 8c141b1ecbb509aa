"""The record of what one file of a command line has become."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

from ..support.frozen import frozen

if TYPE_CHECKING:
    from ..compiler.diagnostics.diagnostic import Diagnostic
    from ..compiler.inputs import Inputs


@frozen
class Compiled:
    """What one file has become."""

    texts: Mapping[str, str]
    """The shaders, by the name of the file for them."""
    reflections: Mapping[str, str]
    plans: Mapping[str, str]
    lines: tuple[str, ...]
    """A line for each material and frame, which says what it has become."""
    remarks: tuple[str, ...]
    """Lines about languages."""
    diagnostics: tuple[Diagnostic, ...]
    inputs: Inputs | None
    """The files that were read; ``None`` if there are errors."""
