"""Computes how many bytes of each uniform block a SPIR-V module may read.

``limits.py`` compares this with the buffers, because the validation layer does not, and a driver
may read past their end.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from ....toolchain.offsets import ARRAY_STRIDE, BLOCK, MATRIX_STRIDE, OFFSET, UNIFORM
from ....toolchain.spirv import Op, SpirvError, instructions

ROW_MAJOR, BINDING, DESCRIPTOR_SET = 4, 33, 34

TYPES = frozenset(
    {Op.TYPE_INT, Op.TYPE_FLOAT, Op.TYPE_VECTOR, Op.TYPE_MATRIX, Op.TYPE_ARRAY, Op.TYPE_STRUCT}
)
"""The opcodes of types that a block may contain."""


def block_sizes(spirv: bytes) -> dict[tuple[int, int], int]:
    """The size of each block up to the end of its last member, by descriptor set and binding.

    Raises ``SpirvError`` for bytes that are not SPIR-V, or if a block is not completely declared.
    """
    module = _Module()
    for instruction in instructions(spirv):
        if instruction.opcode == Op.FUNCTION:
            break
        module.read(instruction.opcode, instruction.operands)
    try:
        return dict(module.blocks())
    except (LookupError, RecursionError) as error:
        raise SpirvError("its uniform blocks are not wholly declared") from error


@dataclass(slots=True)
class _Module:
    """The declarations of a module, by their ids."""

    decorations: dict[tuple[int, int], int] = field(default_factory=dict)
    member_decorations: dict[tuple[int, int, int], int] = field(default_factory=dict)
    types: dict[int, tuple[int, Sequence[int]]] = field(default_factory=dict)
    """The opcode and the operands of each type."""
    constants: dict[int, int] = field(default_factory=dict)
    pointees: dict[int, int] = field(default_factory=dict)
    uniforms: list[tuple[int, int]] = field(default_factory=list)
    """The uniform variables with their pointer types."""

    def read(self, opcode: int, operands: tuple[int, ...]) -> None:
        """Record what one instruction declares."""
        match opcode, operands:
            case Op.DECORATE, (target, decoration, *values):
                self.decorations[target, decoration] = values[0] if values else 1
            case Op.MEMBER_DECORATE, (target, member, decoration, *values):
                self.member_decorations[target, member, decoration] = values[0] if values else 1
            case Op.TYPE_POINTER, (target, _, pointee):
                self.pointees[target] = pointee
            case Op.CONSTANT, (_, target, value, *_):
                self.constants[target] = value
            case Op.VARIABLE, (pointer, target, storage, *_) if storage == UNIFORM:
                self.uniforms.append((target, pointer))
            case _, (target, *rest) if opcode in TYPES:
                self.types[target] = opcode, rest
            case _:
                pass

    def blocks(self) -> Iterator[tuple[tuple[int, int], int]]:
        """The descriptor set and binding of each uniform block, and its size."""
        for variable, pointer in self.uniforms:
            kind = self.pointees[pointer]
            if (kind, BLOCK) in self.decorations:
                group = self.decorations[variable, DESCRIPTOR_SET]
                yield (group, self.decorations[variable, BINDING]), self._size(kind)

    def _size(self, kind: int, columns: tuple[int, bool] = (0, False)) -> int:
        """The size of a type in bytes.

        ``columns`` is a matrix's stride, and True if the matrix is stored by rows. The function
        recurses into the parts of a type; blocks are only nested a few levels deep.
        """
        match self.types[kind]:
            case (Op.TYPE_INT | Op.TYPE_FLOAT, (width, *_)):
                return width // 8
            case Op.TYPE_VECTOR, (lane, count):
                return self._size(lane) * count
            case Op.TYPE_MATRIX, (column, count):
                return self._matrix_size(column, count, *columns)
            case Op.TYPE_ARRAY, (element, length):
                stride = self.decorations[kind, ARRAY_STRIDE]
                return stride * (self.constants[length] - 1) + self._size(element, columns)
            case Op.TYPE_STRUCT, members:
                return max(self._member_end(kind, *member) for member in enumerate(members))
            case other, _:
                raise SpirvError(f"a uniform block holds a type of opcode {other}")

    def _member_end(self, struct: int, index: int, kind: int) -> int:
        stride = self.member_decorations.get((struct, index, MATRIX_STRIDE), 0)
        by_rows = (struct, index, ROW_MAJOR) in self.member_decorations
        return self.member_decorations[struct, index, OFFSET] + self._size(kind, (stride, by_rows))

    def _matrix_size(self, column: int, columns: int, stride: int, by_rows: bool) -> int:
        _, (lane, rows) = self.types[column]
        outer, inner = (rows, columns) if by_rows else (columns, rows)
        return stride * (outer - 1) + self._size(lane) * inner
