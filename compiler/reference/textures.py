"""Reads of textures: what the reader of a picture answers.

How texels are found, mixed and compared depends on the texture and on the state of its sampler, so
a texture's one lane is an object that reads; the rows of ``stdlib/builtins/texture.py`` say what.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Protocol

from .namespace import Lanes, Namespace


class Reader(Protocol):
    """A texture's one lane."""

    def read(self, name: str, operands: tuple[Lanes, ...]) -> Lanes:
        """The value of builtin ``name``; ``operands`` are those behind the texture."""


def reading(name: str) -> Callable[..., Lanes]:
    """The meaning of the read that is builtin ``name``."""

    def read(_xp: Namespace, texture: tuple[Reader], *operands: Lanes) -> Lanes:
        (reader,) = texture
        return reader.read(name, operands)

    return read
