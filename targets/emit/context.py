"""What printing any part of a program needs to know."""

from __future__ import annotations

from collections.abc import Mapping

from ...compiler.ir.program import Program
from ...frozen import frozen
from .description import PipelineInput, Profile, Spelling, Target
from .names import Names
from .spelling import TypeSpeller


@frozen
class Context:
    """A program, the language to print it in, and what was decided for all of it."""

    program: Program
    target: Target
    profile: Profile
    names: Names
    flip_y: bool

    @property
    def types(self) -> TypeSpeller:
        """Writes types, with the final names of structs."""
        return TypeSpeller(self.target.types, self.names.structs)

    @property
    def natives(self) -> Mapping[str, str | Spelling]:
        """Spellings of builtins under the profile."""
        return {**self.target.natives, **self.profile.natives}

    @property
    def inputs(self) -> Mapping[str, PipelineInput]:
        """How the pipeline's values are read under the profile."""
        upside_down = self.profile.rows_up and not self.flip_y
        turned = self.profile.inputs_rows_up if upside_down else {}
        return {**self.target.inputs, **self.profile.inputs, **turned}
