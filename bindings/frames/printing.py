"""What the printers of frames have in common: how a frame's values are named in any language."""

from __future__ import annotations

from ..fields import Field
from ..printer import Printer
from ..spelling import Spelling
from ..statements import Place
from .model import Lights
from .values import NUMBERS, PARAMETERS


class FramePrinter:
    """Names what a frame's function reads and sets. A language has a subclass."""

    def __init__(self, spelling: Spelling, printer: Printer) -> None:
        self._spelling, self._printer = spelling, printer
        self._blocks, self._light, self._layer, self._is_first = (
            spelling.local(name) for name in ("blocks", "light", "layer", "is_first")
        )

    def _number(self, field: Field) -> str:
        """One of the frame's numbers."""
        return f"{self._spelling.local(NUMBERS)}.{self._spelling.member(field.word)}"

    def _count(self, lights: Lights) -> str:
        """How many lights there are: as many as are in use, or all."""
        if lights.count is None:
            return str(lights.capacity)
        return f"{self._spelling.local(PARAMETERS)}.{self._spelling.member(lights.count.word)}"

    def _field(self, block: str, field: Field) -> str:
        """A field of one of a shader's blocks, which a function is given."""
        member = self._spelling.member
        return f"{self._blocks}.{member(block)}.{member(field.word)}"

    def _source(self, place: Place) -> str:
        """A field of the frame's parameters or numbers."""
        way = [self._light if each is None else each for each in place.way]
        return self._printer.place(place, way)
