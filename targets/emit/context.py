"""The data that all printers of one program share: the program, its names, and its dialect.

The emitter makes one ``Context`` for each program and profile, and hands it to every printer.
"""

from __future__ import annotations

from ...compiler.ir.node import Node
from ...compiler.ir.program import StageName
from ..legalise.legal import Legal
from ..legalise.resource_arguments import NOTHING, Passed
from .dialect import dialect
from .names import Names
from .precedence import Printed
from .spelling import TypeSpeller
from .texture_declarations import TextureSpeller


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
