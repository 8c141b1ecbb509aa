"""Reads of textures: what the reader of a picture answers.

How texels are found, mixed and compared depends on the texture and on the state of its sampler, so
a texture's one lane is an object that reads; the rows of ``stdlib/builtins/texture.py`` say what.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from ...stdlib.builtins import BUILTINS
from . import floats
from .namespace import Lanes, Namespace


class Reader(Protocol):
    """A texture's one lane. Places, layers and levels beyond the edge are those at the edge."""

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of builtin ``name``; ``operands`` are those behind the texture."""


def reading(name: str) -> Callable[..., Lanes]:
    """The meaning of the read that is builtin ``name``."""

    compares = BUILTINS[name].sampler == "comparison"

    def read(xp: Namespace, texture: tuple[Reader], *operands: Lanes) -> Lanes:
        (reader,) = texture
        if compares:
            *place, reference = operands
            operands = (*place, tuple(floats.saturate(xp, lane) for lane in reference))
        return reader.read(name, operands)

    return read
