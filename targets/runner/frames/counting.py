"""Counts the memory of a frame's textures and blocks for routes, before anything is drawn.

The reference counts its own, which are larger, in ``by_reference.py``.
"""

from __future__ import annotations

from collections.abc import Sequence

from ....compiler.budget import check
from ....compiler.documents.plan import DrawnRow, DrawStep
from ..job_sizes import COPIES, TEXEL
from .host import FrameHost
from .memory import bytes_of, taking_turns, total


def check_memory(host: FrameHost, frames: int) -> None:
    """Raise ``BudgetError`` if a frame, or the blocks and outputs of all frames, need too much
    memory.

    Textures whose size a kernel determines are not counted: their size is known too late.
    """
    rows = host.plan.textures
    sizes = {
        number: host.size_of(number)
        for number, row in enumerate(rows)
        if row.size.value is not None
    }
    needed = {number: bytes_of(rows[number], size) for number, size in sizes.items()}
    groups = [group for group in taking_turns(host.plan, needed) if needed.keys() >= set(group)]
    back = 0
    for row in host.plan.outputs:
        if row.texture is not None and row.texture in sizes:
            width, height = sizes[row.texture]
            back += width * height * rows[row.texture].layers * TEXEL
    whole = total(groups, needed) + (bytes_of_blocks(host) + back) * COPIES * frames
    pictures = "" if frames == 1 else f"{frames} pictures of "
    verb = "needs" if frames == 1 else "need"
    check("memory", whole, f"{pictures}the frame `{host.plan.frame}` {verb}")


def bytes_of_blocks(host: FrameHost) -> int:
    """The most bytes of blocks that are sent for one frame: each draw has its own ones."""
    sizes = [sum(row.size for row in each.reflection.blocks) for each in host.shaders]
    whole = 0
    for step in host.plan.steps:
        if isinstance(step, DrawStep):
            first = step.attachments[0]
            layers = host.plan.textures[first.texture].layers if first.layer is None else 1
            for drawn in step.draws:
                whole += layers * _lights(host, drawn) * _of_models(host, drawn, sizes)
        else:
            whole += sum(sizes[use.shader] for use in step.uses)
    return whole


def _of_models(host: FrameHost, drawn: DrawnRow, sizes: Sequence[int]) -> int:
    """The bytes of blocks if each model of a row is drawn once."""
    if drawn.models is None:
        return sum(sizes[use.shader] for use in drawn.uses)
    of_material = {use.material: sizes[use.shader] for use in drawn.uses}
    return sum(of_material.get(each.material, 0) for each in host.scenery.tagged(drawn.models))


def _lights(host: FrameHost, drawn: DrawnRow) -> int:
    """The most lights for which a row is drawn; 1 where it is for none of them."""
    capacities = [row.capacity for row in host.plan.lights if row.entry == drawn.light]
    return next(iter(capacities), None) or 1
