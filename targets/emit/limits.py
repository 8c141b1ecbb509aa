"""What a program may need of a profile's devices, as counts."""

from __future__ import annotations

from collections.abc import Iterator

from ...compiler.ir.program import Program
from ...frozen import frozen
from .description import Profile


@frozen
class Excess:
    """More of something than every device of the profile is guaranteed to have."""

    what: str
    count: int
    limit: int


def excesses(program: Program, profile: Profile) -> Iterator[Excess]:
    """The limits that a program does not keep."""
    textures = max(len(stage.resources) for stage in (program.vertex, program.fragment))
    # A location counts also where nothing is read at those before it.
    inputs = max((field.location + 1 for field in program.vertex.inputs), default=0)
    block = max((block.size for block in program.blocks), default=0)
    for what, count, limit in (
        ("varyings", len(program.varyings), profile.varyings),
        ("vertex inputs", inputs, profile.attributes),
        ("textures", textures, profile.textures),
        ("bytes in a uniform block", block, profile.block_bytes),
        ("render targets", len(program.fragment.outputs), profile.targets),
    ):
        if count > limit:
            yield Excess(what, count, limit)
