"""A material as functions, for an engine that lights it: what a folder of an engine writes from."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping

from ..compiler.diagnostics import rules
from ..compiler.diagnostics.diagnostic import Report
from ..compiler.documents.functions import (
    ArgumentRow,
    FunctionRow,
    Functions,
    FunctionTextureRow,
)
from ..support.frozen import cached_property, frozen
from ..targets.emit.functions import EmittedPart, EmittedSignature, FunctionEmission
from . import slot_table


class UnfitError(Exception):
    """An engine cannot draw a slot of a material, or the material itself, for a reason."""

    def __init__(self, name: str, reason: str) -> None:
        super().__init__(f"`{name}`: {reason}")
        self.name, self.reason = name, reason


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
    def type(self) -> str:
        """Its type on the machine: ``vec3``."""
        return self.row.slots[0].representation


@frozen
class Surface:
    """A material as functions, for an engine that lights it."""

    document: Functions
    emission: FunctionEmission

    @property
    def name(self) -> str:
        """The name of the material."""
        return self.document.material

    @cached_property
    def inputs(self) -> Mapping[str, Given]:
        """The function for each value that the material gives."""
        return {word: self._all[row.name] for word, row in slot_table.found(self.document).items()}

    @property
    def is_lit(self) -> bool:
        """True if the engine lights it; else it sends out light of its own."""
        return slot_table.is_lit(self.inputs)

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

    def is_parameter(self, given: Given) -> bool:
        """True if a slot is a parameter, so that its function only hands on what it gets."""
        handed = given.signature.handed_on
        return handed is not None and self.arguments[handed].source == "parameter"

    @property
    def computed(self) -> tuple[Given, ...]:
        """All functions but those that only hand on a parameter."""
        return tuple(each for each in self.all if not self.is_parameter(each))

    @property
    def all(self) -> tuple[Given, ...]:
        """All functions."""
        return tuple(self._all.values())

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


def writing(
    title: str, extension: str, write: Callable[[Surface], str]
) -> Callable[[Functions, Mapping[str, FunctionEmission], Report], Mapping[str, str]]:
    """What ``Engine.write`` is for an engine with one file of each material.

    ``write`` makes the text, and raises ``UnfitError``.
    """

    def files(
        document: Functions, emissions: Mapping[str, FunctionEmission], report: Report
    ) -> Mapping[str, str]:
        (emission,) = emissions.values()
        try:
            text = write(Surface(document, emission))
        except UnfitError as error:
            report.add(
                rules.UNFIT_FOR_ENGINE, None, engine=title, slot=error.name, reason=error.reason
            )
            return {}
        return {f"{document.material}.{extension}": text}

    return files
