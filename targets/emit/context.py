"""What printing any part of a program needs to know."""

from __future__ import annotations

from collections.abc import Mapping

from ...compiler.ir.program import Program
from ...frozen import frozen
from .definitions import Definitions
from .description import PipelineInput, Profile, Spellings, Target
from .names import Names
from .spelling import TypeSpeller
from .textures import TextureSpeller


@frozen
class Context:
    """A program, the language to print it in, and what was decided for all of it."""

    program: Program
    target: Target
    profile: Profile
    names: Names
    flip_y: bool
    definitions: Definitions
    """The functions for what the profile lacks."""

    @property
    def types(self) -> TypeSpeller:
        """Writes types, with the final names of structs."""
        return TypeSpeller(self.target.types, self.names.structs)

    @property
    def textures(self) -> TextureSpeller:
        """Writes the types of textures and samplers."""
        return TextureSpeller(self.target.textures, self.program)

    @property
    def natives(self) -> Spellings:
        """Spellings of builtins under the profile."""
        turned = self.profile.natives_rows_up if self._rows_up else {}
        return {**self.target.natives, **self.profile.natives, **turned}

    @property
    def inputs(self) -> Mapping[str, PipelineInput]:
        """How the pipeline's values are read under the profile."""
        turned = self.profile.inputs_rows_up if self._rows_up else {}
        return {**self.target.inputs, **self.profile.inputs, **turned}

    @property
    def _rows_up(self) -> bool:
        """Whether the picture's rows count upwards, against Burnish's own y."""
        return self.profile.rows_up and not self.flip_y
