"""The record that describes an engine, and what it makes its file of."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from ..compiler.documents.functions import (
    ArgumentRow,
    FunctionRow,
    Functions,
    FunctionTextureRow,
)
from ..support.frozen import EMPTY, cached_property, frozen
from ..targets.description.profile import Profile
from ..targets.description.shading_language import Language
from ..targets.emit.functions import EmittedPart, EmittedSignature, FunctionEmission
from .inputs import COLOR, LIT, with_names


class EngineError(Exception):
    """An engine cannot have a material; the text says in a sentence why, with the slot."""


@frozen
class Given:
    """A value that the engine is given: a function of the material and what is known of it."""

    row: FunctionRow
    signature: EmittedSignature

    @property
    def slot(self) -> str:
        """The slot that the function returns."""
        return self.row.slots[0].name

    @property
    def is_parameter(self) -> bool:
        """True if the slot is a parameter, so that its function only hands on what it gets."""
        return self.row.arguments == (self.slot,) and not self.row.textures

    @property
    def type(self) -> str:
        """Its type on the machine: ``vec3``."""
        return self.row.slots[0].representation


@frozen
class Surface:
    """A material as functions, for an engine that lights it."""

    document: Functions
    emission: FunctionEmission
    renamed: Mapping[str, str] = EMPTY
    """Slots that a user has named for an input."""

    @property
    def name(self) -> str:
        """The name of the material."""
        return self.document.material

    @cached_property
    def inputs(self) -> Mapping[str, Given]:
        """The function for each value that the material gives."""
        found = {}
        for row in with_names(self.renamed):
            ranked = [
                (rank, number, given)
                for number, given in enumerate(self._all.values())
                if given.row.stage == row.stage
                and (rank := row.rank(given.row.slots[0])) is not None
            ]
            if ranked:
                found[row.name] = min(ranked)[-1]
        return found

    @property
    def is_lit(self) -> bool:
        """True if the engine lights it; else it sends out light of its own.

        Raises ``EngineError`` for a surface that gives neither.
        """
        if LIT & self.inputs.keys() and COLOR not in self.inputs:
            return True
        if COLOR in self.inputs:
            return False
        raise EngineError(
            f"`{self.name}` says how it is lit itself, and no slot of it is one by which an engine "
            "lights: name one by `--slot base_color=…`"
        )

    @cached_property
    def arguments(self) -> Mapping[str, ArgumentRow]:
        """The arguments of all functions, by name."""
        return {row.name: row for row in self.document.arguments}

    @cached_property
    def textures(self) -> Mapping[str, FunctionTextureRow]:
        """The textures of all functions, by name."""
        return {row.name: row for row in self.document.textures}

    def function(self, name: str) -> Given:
        """A function by its name in the document."""
        return self._all[name]

    @cached_property
    def _all(self) -> dict[str, Given]:
        signatures = {each.name: each for each in self.emission.functions}
        return {row.name: Given(row, signatures[row.name]) for row in self.document.functions}

    def parts(self, used: Iterable[Given]) -> list[EmittedPart]:
        """The parts of the text that these functions are, in an order in which each is known."""
        found = {part.name: part for part in self.emission.helpers}
        found |= {each.part.name: each.part for each in self.emission.functions}
        wanted = {
            name for each in used for name in (*each.signature.part.needs, each.signature.part.name)
        }
        return [part for name, part in found.items() if name in wanted]


@frozen(eq=False, kw_only=True)
class Engine:
    """An engine that lights surfaces itself."""

    name: str
    title: str
    """Its name in prose."""
    extension: str
    language: Callable[[], tuple[Language, Profile]]
    """The language of its shaders, as Burnish writes functions in it."""
    write: Callable[[Surface], str]
    """The engine's file of a surface. Raises ``EngineError``."""
    unproven: str = ""
    """The reason why nobody should rely on its files yet: "never compiled by …"."""
