"""Counts the memory of a frame's textures for routes, before anything is drawn.

The reference counts its own, which are larger, in ``by_reference.py``.
"""

from __future__ import annotations

from ....compiler.budget import check
from ..job_sizes import COPIES, TEXEL
from .host import FrameHost
from .memory import bytes_of, taking_turns, total


def check_textures(host: FrameHost, frames: int) -> None:
    """Raise ``BudgetError`` if a frame, or the outputs of all frames, need too much memory.

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
    whole = total(groups, needed) + back * COPIES * frames
    pictures = "" if frames == 1 else f"{frames} pictures of "
    verb = "needs" if frames == 1 else "need"
    check("memory", whole, f"{pictures}the frame `{host.plan.frame}` {verb}")
