"""Checks the bytes of a reflection's blocks: each of them belongs to a member, and to one only.

A host makes room for whole blocks before it sets any value. So the size of a block is not believed,
but has to be that of the members that are there.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NoReturn

from .....compiler.budget import check
from .....compiler.documents.reflection import Reflection
from .....compiler.documents.values import (
    BlockMember,
    BlockRow,
    DerivedRow,
    ParameterRow,
    StructMember,
)
from .rows import PlanError

UNIT = 16
"""The bytes of a ``vec4``: a value is padded to the next multiple of them, and not beyond it."""
MOST_PADDING = 1 << 16
"""The most bytes between two members of a block that a host owns: 64 KiB, the size of the largest
block that such hosts declare."""

Stored = ParameterRow | DerivedRow
"""A value that may be in a block."""


def check_blocks(where: str, reflection: Reflection) -> None:
    """Raise ``PlanError`` if the members of a block are not what it consists of. Raises
    ``BudgetError`` if all blocks take too much memory."""
    _Blocks(where, reflection).check()


class _Blocks:
    def __init__(self, where: str, reflection: Reflection) -> None:
        self._where = where
        self._blocks = {row.name: row for row in reflection.blocks}
        self._rows: tuple[Stored, ...] = (*reflection.parameters, *reflection.derived)
        self._by_name = {row.name: row for row in self._rows}

    def check(self) -> None:
        sizes = [row.size for row in self._blocks.values()]
        check("memory", sum(sizes), f"{self._where}: its blocks take")
        for row in self._rows:
            self._check_place(row)
        for block in self._blocks.values():
            self._check_members(block.name, block.members, block.size)
            for struct in block.structs:
                self._check_members(struct.name, struct.members, struct.size)
            for member in block.members:
                if member.parameter is None:
                    self._check_padding(block, member)
                else:
                    self._check_content(block, member, member.parameter)

    def _check_place(self, row: Stored) -> None:
        """Check that a value lies within its block."""
        name, block = row.name, row.block
        if block is None:
            return
        if block not in self._blocks or row.offset is None:
            self._fail(name, f"there is no place in the block `{block}`")
        size = self._blocks[block].size
        if row.offset + row.size > size:
            self._fail(name, f"it is not within the {size} bytes of `{block}`")

    def _check_members(
        self, name: str, members: Sequence[BlockMember | StructMember], size: int
    ) -> None:
        """Check that members lie one behind the other, from the first byte to the last."""
        end = 0
        for each in members:
            if each.offset != end:
                self._fail(f"{name}.{each.name}", f"it is at byte {each.offset}, and not at {end}")
            end += each.size
        if end != size:
            self._fail(name, f"its members have {end} bytes, and it has {size}")

    def _check_padding(self, block: BlockRow, member: BlockMember) -> None:
        if member.size > MOST_PADDING:
            self._fail(
                f"{block.name}.{member.name}",
                f"no padding has {member.size} bytes: the most are {MOST_PADDING}",
            )

    def _check_content(self, block: BlockRow, member: BlockMember, named: str) -> None:
        """Check that a member is as large as its value, or as the values of its table."""
        alone = self._by_name.get(named)
        rows = [alone] if alone else [
            row for row in self._rows if row.name.startswith(f"{named}.")
        ]  # fmt: skip
        ends = [row.offset + row.size for row in rows if row.offset is not None]
        end, place = member.offset + member.size, f"{block.name}.{member.name}"
        if not ends or any(row.block != block.name for row in rows):
            self._fail(place, f"no value `{named}` is in this block")
        is_there = min(row.offset or 0 for row in rows) == member.offset
        if not is_there or not 0 <= end - max(ends) < UNIT:
            self._fail(place, f"`{named}` lies at other bytes of the block")

    def _fail(self, name: str, text: str) -> NoReturn:
        raise PlanError(f"{self._where}, {name}: {text}")
