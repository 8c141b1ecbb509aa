"""What is drawn: one compiled material, as ``burnish.compile`` returns it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

from ...compiler.ir.shader import Shader
from .codes import ShaderFile


class Subject(Protocol):
    """A compiled material with its texts for the profiles of all routes that are to draw it."""

    @property
    def name(self) -> str:
        """The material's."""

    @property
    def files(self) -> Sequence[ShaderFile]:
        """The emitted texts."""

    @property
    def lacking(self) -> Mapping[str, str]:
        """Why there are no texts for some profiles."""

    @property
    def reflection(self) -> Mapping[str, Any]:
        """What a host binds by."""

    @property
    def shader(self) -> Shader:
        """What the material means, for the reference."""
