"""The declarations of a material or of a frame that have values of their own."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Protocol

from ....compiler.documents.drawing import TextureRow
from ....compiler.documents.plan import HostTextureRow
from ....compiler.documents.steps import StepRow
from ....compiler.documents.values import BufferRow, DerivedRow, LightRow, ParameterRow

TextureDeclaration = TextureRow | HostTextureRow
"""A texture that a host binds."""


class Declared(Protocol):
    """The declarations that ``HostValues`` sets: a ``Reflection``, or ``FrameDeclarations``."""

    @property
    def material(self) -> str:
        """The name of the material or frame in messages."""

    @property
    def rig(self) -> str:
        """The rig of its lights."""

    @property
    def parameters(self) -> Sequence[ParameterRow]:
        """The declared parameters."""

    @property
    def derived(self) -> Sequence[DerivedRow]:
        """The values that the host computes and keeps in blocks."""

    @property
    def lights(self) -> Sequence[LightRow]:
        """The lights of the rig."""

    @property
    def buffers(self) -> Sequence[BufferRow]:
        """The storage buffers that it reads."""

    @property
    def textures(self) -> Sequence[TextureDeclaration]:
        """The textures that it reads."""

    @property
    def computed(self) -> Iterable[Sequence[StepRow]]:
        """The steps of all values that the host computes."""
