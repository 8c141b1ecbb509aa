"""The members of a block leave no gap, in every example: hosts copy them into structures."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

import pytest

import burnish
from burnish.api.entry_points import variants
from burnish.compiler.documents.values import BlockMember, StructMember
from burnish.tests.examples.kit import EXAMPLES

TARGETS = (
    "hlsl", "glsl", "glsl:gl330", "glsl:gl450", "glsl:es300", "glsl:es310", "wgsl", "msl",
)  # fmt: skip


def tiled(members: Iterable[BlockMember | StructMember], size: int) -> bool:
    """True if each member begins where the one before it ends, and the last one ends at the end."""
    end = 0
    for member in members:
        if member.offset != end:
            return False
        end += member.size
    return end == size and size % 16 == 0


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_members_leave_no_gap(path: Path) -> None:
    for rig, pass_ in variants(path):
        for material in burnish.compile(path, TARGETS, rig=rig, pass_=pass_, partial=True):
            reflection = material.reflection
            for block in reflection.blocks:
                names = [member.name for member in block.members]
                assert tiled(block.members, block.size), block
                assert len(set(names)) == len(names)
                for struct in block.structs:
                    assert tiled(struct.members, struct.size), struct
                held = {m.name for m in block.members if m.parameter is not None}
                for backend in reflection.backends.values():
                    if block.name in backend.blocks:
                        written = backend.blocks[block.name].members.keys()
                        assert held <= written <= set(names)
