"""Finds textures of a frame that may share memory although they differ in format and size.

Results that are alike share a texture, as the plan says. Beyond this, two textures can take turns
if no step needs both: the plan says from which step to which it needs each result. How large
textures are is known only when the values of a frame are set, so hosts decide, here for Vulkan.
"""

from __future__ import annotations

from bisect import bisect, insort
from collections.abc import Mapping, Sequence

from ....compiler.documents.plan import DrawStep, FramePlan, FrameTextureRow
from ....compiler.ir.image_sizes import halved
from ..binding import FORMATS
from ..drivers.readback import TEXEL_LANES
from .checks.rows import drawn_to, written
from .sizes import Size

MOST_TRIED = 64
"""The most groups that are tried for a texture, so that many textures do not take long."""

DEPTH_BYTES: Mapping[str, int] = {"depth32f": 4, "depth32f_stencil8": 8}
"""The bytes of a texel of depths."""


def bytes_of(texture: FrameTextureRow, size: Size) -> int:
    """The least memory that a texture needs, in bytes."""
    width, height = size
    texels = sum(halved(width, level) * halved(height, level) for level in range(texture.levels))
    samples = texels * texture.layers * texture.samples
    return samples * _texel_bytes(texture.format)


def _texel_bytes(format_: str) -> int:
    if format_ in DEPTH_BYTES:
        return DEPTH_BYTES[format_]
    lanes, kind = TEXEL_LANES[FORMATS[format_]]
    return lanes * int(kind.itemsize)


def taking_turns(plan: FramePlan, needed: Mapping[int, int]) -> list[list[int]]:
    """The textures of a plan in groups; each group needs the memory of its largest texture.

    ``needed`` has the bytes of each texture; textures that it leaves out are alone, as those are
    that later frames read.
    """
    spans, lasting = _spans(plan), _lasting(plan)
    groups: list[list[int]] = []
    taken: list[list[tuple[int, int]]] = []
    """For each group the spans of its textures, in order; none of them overlap."""
    for texture in sorted(needed, key=lambda each: -needed[each]):
        if texture in lasting:
            continue
        for group, others in zip(groups[-MOST_TRIED:], taken[-MOST_TRIED:], strict=True):
            if _fits(spans[texture], others):
                group.append(texture)
                insort(others, spans[texture])
                break
        else:
            groups.append([texture])
            taken.append([spans[texture]])
    placed = {texture for group in groups for texture in group}
    alone = [[number] for number in range(len(plan.textures)) if number not in placed]
    return [*groups, *alone]


def total(groups: Sequence[Sequence[int]], needed: Mapping[int, int]) -> int:
    """The bytes of all groups together."""
    return sum(max(needed[texture] for texture in group) for group in groups)


def _spans(plan: FramePlan) -> dict[int, tuple[int, int]]:
    """The first and the last step that need something of each texture."""
    found: dict[int, tuple[int, int]] = {}

    def add(texture: int, first: int, last: int) -> None:
        known = found.get(texture, (first, last))
        found[texture] = min(known[0], first), max(known[1], last)

    for row in plan.results:
        if row.texture is not None:
            add(row.texture, row.first, row.last)
    begin = 0
    for number, step in enumerate(plan.steps):
        # Resolve targets have their memory when the render pass begins.
        begin = begin if isinstance(step, DrawStep) and step.continues else number
        for texture in drawn_to(step):
            add(texture, begin, number)
    return found


def _lasting(plan: FramePlan) -> set[int | None]:
    """The textures that have contents from frame to frame: those that are exchanged, and those that
    only the first frame draws to."""
    drawn_once = {texture for step in plan.steps if step.only_first for _, texture in written(step)}
    return drawn_once | {number for number, row in enumerate(plan.textures) if row.kept}


def _fits(span: tuple[int, int], others: Sequence[tuple[int, int]]) -> bool:
    """True if a span overlaps none of the ``others``, which are sorted and do not overlap."""
    at = bisect(others, span)
    begins_later = at == 0 or others[at - 1][1] < span[0]
    return begins_later and (at == len(others) or span[1] < others[at][0])
