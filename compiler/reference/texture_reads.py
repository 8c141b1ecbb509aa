"""Defines the meaning of texture reads, by asking the value of the texture.

``functions.py`` has them in its table. How texels are found, blended and compared depends on the
texture and its sampler. So the single lane of a texture is a ``Reader``, such as those of
``picture/sampler.py``. The rows of ``stdlib/builtins/texture.py`` say what each read means.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from ...stdlib.builtins import BUILTINS
from . import floats
from .namespace import Lanes, Namespace


class Reader(Protocol):
    """The single lane of a texture. Coordinates, layers and levels are clamped to the edge."""

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of the builtin ``name``; ``operands`` are those after the texture."""


def reading(name: str) -> Callable[..., Lanes]:
    """The function for the read that is the builtin ``name``."""

    compares = BUILTINS[name].sampler == "comparison"

    def read(xp: Namespace, texture: tuple[Reader], *operands: Lanes) -> Lanes:
        (reader,) = texture
        if compares:
            *place, reference = operands
            operands = (*place, tuple(floats.saturate(xp, lane) for lane in reference))
        return reader.read(name, operands)

    return read
