"""The surface of an object as a file describes it, in words that ``stdlib/scene.toml`` maps."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from .textures.texture import Texture


@dataclass(frozen=True, eq=False, slots=True)
class Look:
    """Values for parameters and textures of whichever material draws a model."""

    name: str = ""
    """The name of the material in the file."""
    parameters: Mapping[str, Any] = field(default_factory=dict)
    textures: Mapping[str, Texture] = field(default_factory=dict)
    needs: Mapping[str, str] = field(default_factory=dict)
    """What the file says beyond the core of its format, each with the word of a value that a
    material needs for it."""


PLAIN = Look()
"""The look of models about which no file says anything."""
