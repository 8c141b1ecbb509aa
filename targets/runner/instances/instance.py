"""Material instances: named values for one compiled material, as the bytes that a GPU reads.

This is the runtime that users call as ``burnish.Instance``. Everything that it knows about the
material comes from its reflection, so a host can read that from its file and needs nothing else of
the compiler. Nothing here imports NumPy.
"""

from __future__ import annotations

from collections.abc import Mapping
from itertools import chain
from typing import TYPE_CHECKING, Any

from ....compiler.budget import check
from ....compiler.documents.reflection import Reflection
from ....compiler.documents.values import DerivedRow, ParameterRow
from ....support.arguments import expect
from . import derived
from .blocks import write
from .host_values import HostValues
from .shapes import Shape
from .values import rounded

if TYPE_CHECKING:
    from ....compiler.budget import Tally

_COPIES = 25
"""The factor of a buffer's size that is needed until a kernel's results are in it: as numbers with
their bounds, as bytes, and as the text by which processes send them."""


class Instance(HostValues):
    """Named values for one compiled material."""

    def __init__(
        self, reflection: Reflection | Mapping[str, Any], meter: Tally | None = None
    ) -> None:
        """``reflection`` may also be the JSON of one.

        ``meter`` counts the steps of all computed values, if they are limited together. Raises
        ``ShapeError``, a ``ValueError``, for JSON that is no reflection of this format.
        """
        expect("reflection", reflection, (Reflection, Mapping), "a reflection")
        if not isinstance(reflection, Reflection):
            from ....compiler.documents.reading import read

            reflection = read(Reflection, reflection)
        super().__init__(reflection, meter)
        self._reflection = reflection

    @property
    def reflection(self) -> Reflection:
        """The reflection from which the instance was made."""
        return self._reflection

    def blocks(self) -> dict[str, bytes]:
        """The bytes of every block by name, including blocks of derived values.

        Raises ``MissingValuesError``.
        """
        shapes, values = self._names.shapes, self.values()
        blocks = {row.name: bytearray(row.size) for row in self._reflection.blocks}
        for row in self._reflection.parameters:
            _write(blocks, row, shapes[row.name], values[row.name])
        inputs = derived.Inputs(shapes, values, meter=self._meter)
        for each, shape, value in derived.computed(self._reflection.derived, inputs):
            _write(blocks, each, shape, rounded(value))
        return {name: bytes(block) for name, block in blocks.items()}

    def extent(self) -> int:
        """The number of elements of a kernel's results. Raises ``MissingValuesError``."""
        steps = self._reflection.extent or ()
        (count,) = derived.compute(steps, self._read_by(steps))
        return max(int(count), 0)

    def result_counts(self) -> dict[str, int]:
        """The number of elements of each buffer that a kernel writes.

        Raises ``MissingValuesError``, and ``BudgetError`` if there is not enough memory for them.
        """
        counts = {row.name: row.count for row in self._reflection.results}
        inputs = self._read_by(chain.from_iterable(counts.values()))
        found = {name: derived.compute(steps, inputs) for name, steps in counts.items()}
        numbers = {name: max(int(count), 0) for name, (count,) in found.items()}
        size = sum(numbers[row.name] * row.stride for row in self._reflection.results)
        check("memory", size * _COPIES, f"what `{self._reflection.material}` writes needs")
        return numbers

    def image_size(self) -> tuple[int, int]:
        """The width and height of a kernel's images. Raises ``MissingValuesError``."""
        steps = self._reflection.extent or ()
        width, height = derived.compute(steps, self._read_by(steps, self._sizes(steps)))
        return max(int(width), 0), max(int(height), 0)

    def patch_levels(self) -> tuple[tuple[float, ...], tuple[float, ...]]:
        """The tessellation levels of all patches of a draw, as float32: outer and inner ones.

        They exist only if the host makes the pattern. Raises ``MissingValuesError``.
        """
        levels = self._reflection.levels
        assert levels is not None
        rows = [levels.edges, levels.inside]
        inputs = self._read_by(chain.from_iterable(chain.from_iterable(rows)))
        edges, inside = (
            tuple(rounded(derived.compute(steps, inputs))[0] for steps in row) for row in rows
        )
        return edges, inside


def _write(
    blocks: Mapping[str, bytearray], row: ParameterRow | DerivedRow, shape: Shape, value: Any
) -> None:
    """Write a value into its block, if the program has that block."""
    if row.block is not None:
        assert row.offset is not None
        write(blocks[row.block], row.offset, shape, value)
