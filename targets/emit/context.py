"""The data that all printers of one program share: the program, its names, and its dialect.

The emitter makes one ``Context`` for each program and profile, and hands it to every printer.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from ...compiler.ir.node import Node
from ...compiler.ir.program import StageName
from ...compiler.ir.types import Type
from ..description.profile import Profile
from ..description.shading_language import Language
from ..description.spellings import PipelineInput, Spellings
from ..legalise.legal import Legal
from ..legalise.resource_arguments import NOTHING, Passed
from .names import Names
from .precedence import Printed, Writer
from .spelling import TypeSpeller, TypeTexts
from .texture_declarations import TextureSpeller


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
        self.spellings: dict[tuple[str, tuple[Type, ...]], str] = {}
        """The spellings of all others, by the types of their operands. ``natives.py`` adds them."""
        self.types = TypeTexts({}, {}, {})
        """Texts of scalars, vectors and matrices under the profile."""


@lru_cache(maxsize=64)
def dialect(language: Language, profile: Profile, rows_up: bool) -> Dialect:
    """The dialect of a profile; ``rows_up`` if the rows of its pictures count upwards."""
    return Dialect(language, profile, rows_up)


class Context:
    """A program, its language, and the decisions that hold for all of its texts."""

    def __init__(self, legal: Legal, names: Names, flip_y: bool) -> None:
        program, language, profile = legal.program, legal.language, legal.profile
        # True if the picture's rows count upwards, against Burnish's own y.
        rows_up = profile.framebuffer.rows_up and not flip_y
        self.program = program
        self.dialect = dialect(language, profile, rows_up)
        """Everything that is the same for all programs of this language and profile."""
        self.language = language
        self.profile = profile
        self.names = names
        self.flip_y = flip_y
        self.definitions = legal.definitions
        """The functions that replace builtins that the profile lacks."""
        self.members = {
            member.parameter: (block.name, member.name, member.type)
            for block in program.blocks
            for member in block.members
            if member.parameter is not None
        }
        """The block, the name there and the stored type of each parameter."""
        self.read_parameters: dict[Node, Printed] = {}
        """The texts of parameters that were printed before."""
        self.types = TypeSpeller(language.types, names.structs, self.dialect.types)
        """Writes types, with the final names of structs."""
        self.textures = TextureSpeller(language.textures, program)
        """Writes the types of textures and samplers."""
        self.in_place = legal.in_place
        """Values that are printed in place, without a name of their own."""
        self._passed = legal.passed

    def passed(self, stage: StageName, body: Node) -> Passed:
        """The blocks and textures that a function of a stage gets as arguments, by its body."""
        return self._passed.get((stage, body), NOTHING)
