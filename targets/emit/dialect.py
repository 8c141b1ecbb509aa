"""Keeps everything that depends on the profile, but not on the program that is printed.

``context.py`` asks for the ``Dialect`` of a profile. It is made for the first program that is
printed in the profile, and used for all others.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from ..description.profile import Profile
from ..description.shading_language import Language
from ..description.spellings import PipelineInput, Spellings
from .precedence import Writer
from .spelling import TypeTexts


class Dialect:
    """The rows of a language under one of its profiles."""

    def __init__(self, language: Language, profile: Profile, rows_up: bool) -> None:
        framebuffer = profile.framebuffer
        self.natives: Spellings = {
            **language.natives, **profile.natives, **(framebuffer.natives if rows_up else {})
        }  # fmt: skip
        """Spellings of builtins under the profile."""
        self.inputs: Mapping[str, PipelineInput] = {
            **language.inputs, **profile.inputs, **(framebuffer.inputs if rows_up else {})
        }  # fmt: skip
        """Spellings of the pipeline's values under the profile."""
        self.writers: dict[str, Writer] = {}
        """Functions that print builtins whose spelling does not depend on the operands.
        ``natives.py`` adds those that it has found."""
        self.types = TypeTexts({}, {}, {})
        """Texts of scalars, vectors and matrices under the profile."""


@lru_cache(maxsize=64)
def dialect(language: Language, profile: Profile, rows_up: bool) -> Dialect:
    """The dialect of a profile; ``rows_up`` if the rows of its pictures count upwards."""
    return Dialect(language, profile, rows_up)
