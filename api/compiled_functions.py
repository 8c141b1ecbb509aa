"""The results of compiling materials to functions that an engine calls."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ..compiler.diagnostics.diagnostic import Diagnostic
from ..compiler.documents.functions import Functions
from ..compiler.inputs import Inputs
from ..support.frozen import cached_property, frozen
from ..targets.emit.functions import FunctionEmission


@frozen
class FunctionFile:
    """The functions of one material for one profile."""

    name: str
    """The name of the file: ``Plastic.functions.wgsl``."""
    target: str
    profile: str
    emission: FunctionEmission
    """The text, and its parts for engines that take single functions."""

    @property
    def text(self) -> str:
        """The whole text."""
        return self.emission.text


@frozen
class CompiledFunctions:
    """The functions of one material."""

    name: str
    files: tuple[FunctionFile, ...]
    _document: Callable[[], Functions]

    def file(self, target: str) -> FunctionFile:
        """The file for a target (``"glsl"`` or ``"glsl:es300"``).

        Raises ``KeyError`` if the material was not compiled for it.
        """
        for file in self.files:
            if target in (file.target, f"{file.target}:{file.profile}"):
                return file
        raise KeyError(f"{self.name} has no functions for {target}")

    @cached_property
    def document(self) -> Functions:
        """The signatures of all functions; ``to_json`` makes data for JSON of it."""
        return self._document()


@frozen
class FunctionsResult:
    """The functions of all materials of a file, with the warnings about it."""

    materials: tuple[CompiledFunctions, ...]
    diagnostics: tuple[Diagnostic, ...]
    inputs: Inputs
    """The files that were read, and the places where files were searched."""

    def __iter__(self) -> Iterator[CompiledFunctions]:
        """The materials in the order of the file."""
        return iter(self.materials)

    def __getitem__(self, name: str) -> CompiledFunctions:
        """The material called ``name``; ``KeyError`` if there is none."""
        for material in self.materials:
            if material.name == name:
                return material
        raise KeyError(name)
