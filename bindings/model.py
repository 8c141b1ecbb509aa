"""The record of a binding: what a host sets, computes and binds, in no language yet.

``gathering`` makes it of reflections and plans, and the skeletons of languages read it. Names are
those of Burnish: how a language spells them is its own affair. ``materials`` has the records of
blocks and materials, and ``frames.model`` those of frames.
"""

from __future__ import annotations

from ..support.frozen import frozen
from .fields import Enumeration, Structure
from .frames.model import Frame
from .materials import Block, Bound, Buffer, Derivation, Helper, Material, Profile, Source, Text


@frozen(kw_only=True)
class Binding:
    """All that is bound together in one text."""

    sources: tuple[str, ...]
    """Names of the files that were compiled."""
    namespace: str
    enumerations: tuple[Enumeration, ...]
    structures: tuple[Structure, ...]
    """Structures of elements, those inside others first."""
    blocks: tuple[Block, ...]
    """Blocks, each once."""
    helpers: tuple[Helper, ...]
    """Functions that derived values call, those that others call first."""
    materials: tuple[Material, ...]
    frames: tuple[Frame, ...] = ()
    """Frames, whose shaders are among the materials."""


__all__ = [
    "Binding", "Block", "Bound", "Buffer", "Derivation", "Frame", "Helper", "Material", "Profile",
    "Source", "Text",
]  # fmt: skip
