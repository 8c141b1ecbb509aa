"""Reads the layout of uniform blocks from the SPIR-V of compilers, for the layout tests.

This reader and the one in ``dxil_offsets`` return bytes, by block and by member. A nested struct's
members are named ``light.colour``. ``lights[]`` is not an offset but the stride of the array
``lights``. A matrix has such an entry too; its elements are its columns (or rows, if it is stored
by rows). ``lights[].colour`` is the offset of a member of the first element. All offsets count from
the start of the block.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from .spirv import Instruction, Op, instructions, string_at

Offsets = dict[str, dict[str, int]]

UNIFORM = 2
BLOCK, ARRAY_STRIDE, MATRIX_STRIDE, OFFSET = 2, 6, 7, 35

_DXC_TYPE_PREFIX = re.compile(r"type\.(ConstantBuffer\.)?")


def block_offsets_spirv(spirv: bytes) -> Offsets:
    """The uniform blocks of a module, with the names of their types in the source.

    If the module has no names, members are numbered ``0``, ``1``. Raises ``SpirvError`` if the
    bytes are not SPIR-V.
    """
    module = _Module()
    for instruction in instructions(spirv):
        module.read(instruction)
    blocks = (module.unwrapped(block) for block in module.blocks())
    return {module.block_name(block): dict(module.members(block)) for block in blocks}


@dataclass(slots=True)
class _Module:
    """The types, names and layout in a SPIR-V module, by the ids of its types."""

    names: dict[int, str] = field(default_factory=dict)
    member_names: dict[tuple[int, int], str] = field(default_factory=dict)
    decorations: dict[tuple[int, int], int] = field(default_factory=dict)
    member_decorations: dict[tuple[int, int, int], int] = field(default_factory=dict)
    structs: dict[int, tuple[int, ...]] = field(default_factory=dict)
    elements: dict[int, int] = field(default_factory=dict)
    """The element types of array types."""
    pointees: dict[int, int] = field(default_factory=dict)
    uniforms: list[int] = field(default_factory=list)
    """The pointer types of the uniform variables."""

    def read(self, instruction: Instruction) -> None:
        """Record what one instruction says."""
        match instruction.opcode, instruction.operands:
            case Op.NAME, (target, *_):
                self.names[target] = string_at(instruction.operands, 1)
            case Op.MEMBER_NAME, (target, member, *_):
                self.member_names[target, member] = string_at(instruction.operands, 2)
            case Op.DECORATE, (target, decoration, *values):
                self.decorations[target, decoration] = values[0] if values else 1
            case Op.MEMBER_DECORATE, (target, member, decoration, value):
                self.member_decorations[target, member, decoration] = value
            case Op.TYPE_STRUCT, (target, *members):
                self.structs[target] = tuple(members)
            case Op.TYPE_ARRAY, (target, element, _):
                self.elements[target] = element
            case Op.TYPE_POINTER, (target, _, pointee):
                self.pointees[target] = pointee
            case Op.VARIABLE, (pointer, _, storage, *_) if storage == UNIFORM:
                self.uniforms.append(pointer)
            case _:
                pass

    def blocks(self) -> list[int]:
        """The struct types of the uniform blocks."""
        pointees = (self.pointees[pointer] for pointer in self.uniforms)
        return [pointee for pointee in pointees if (pointee, BLOCK) in self.decorations]

    def unwrapped(self, block: int) -> int:
        """The struct around which naga has put a block, or else the block itself."""
        match self.structs[block]:
            case (inner,) if inner in self.structs and (block, 0) not in self.member_names:
                return inner
            case _:
                return block

    def block_name(self, block: int) -> str:
        """The block's name without DXC's prefix."""
        return _DXC_TYPE_PREFIX.sub("", self.names.get(block, str(block)))

    def members(self, struct: int, prefix: str = "", base: int = 0) -> Iterator[tuple[str, int]]:
        """The members of a struct that starts at byte ``base``, and everything inside them."""
        for index, kind in enumerate(self.structs[struct]):
            name = prefix + self.member_names.get((struct, index), str(index))
            offset = base + self.member_decorations[struct, index, OFFSET]
            yield name, offset
            strides, core = self._strides(struct, index, kind)
            for depth, stride in enumerate(strides, start=1):
                yield name + "[]" * depth, stride
            if core in self.structs:
                yield from self.members(core, f"{name}{'[]' * len(strides)}.", offset)

    def _strides(self, struct: int, index: int, kind: int) -> tuple[list[int], int]:
        """The strides of a member's arrays, the outermost first, and the type of the elements."""
        strides: list[int] = []
        while kind in self.elements:
            strides.append(self.decorations[kind, ARRAY_STRIDE])
            kind = self.elements[kind]
        columns = self.member_decorations.get((struct, index, MATRIX_STRIDE))
        return ([*strides, columns] if columns is not None else strides), kind
