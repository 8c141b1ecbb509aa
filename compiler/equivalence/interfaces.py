"""Compares what two programs declare: parameters, textures and render targets.

``comparing.py`` asks before it compares what they compute.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...support.frozen import changed
from ..ir.shader import Shader
from .domain import Domain, Range
from .programs import NotComparableError


def check_types(first: Shader, second: Shader) -> None:
    """Raises ``NotComparableError`` if something has one name and two types."""
    there = {info.leaf.name: info.leaf.type for info in second.leaves}
    for info in first.leaves:
        name, type_ = info.leaf.name, info.leaf.type
        if there.get(name, type_) != type_:
            raise NotComparableError(f"`{name}` is {type_} in A and {there[name]} in B")


def with_common(first: Shader, second: Shader, domain: Domain) -> Domain:
    """The domain with the part that two ranges have in common, of parameters that have two."""
    common = {
        name: part
        for name, ours, theirs in _other_ranges(first, second)
        if name not in domain.ranges and (part := _in_both(ours, theirs)) is not None
    }
    return changed(domain, ranges={**domain.ranges, **common})


def notes_of(first: Shader, second: Shader) -> Iterator[str]:
    """What a person has to know of what only one of both declares, or declares otherwise."""
    for one, other, which in ((first, second, "A"), (second, first, "B")):
        there = {info.leaf.name for info in other.leaves}
        alone = [
            info.leaf.name
            for info in (*one.parameters, *one.textures)
            if info.leaf.name not in there
        ]
        if alone:
            words = (
                "it, and it has any value" if len(alone) == 1 else "them, and they have any values"
            )
            yield f"{', '.join(alone)}: only {which} has {words} here"
    for name, ours, theirs in _other_ranges(first, second):
        if _in_both(ours, theirs) is not None:
            ends = [f"{low:g}..{high:g}" for low, high in (ours, theirs)]
            yield f"`{name}` is in {ends[0]} in A and in {ends[1]} in B: both ranges count"
    if (first.targets, first.layers) != (second.targets, second.layers):
        yield "the formats or the blending of the render targets differ, which is not compared"


def _other_ranges(first: Shader, second: Shader) -> Iterator[tuple[str, Range, Range]]:
    """The parameters that have another range in each program."""
    there = {info.leaf.name: info.leaf.fact for info in second.parameters}
    for info in first.parameters:
        ours, theirs = info.leaf.fact, there.get(info.leaf.name)
        if theirs is not None and (ours.lo, ours.hi) != (theirs.lo, theirs.hi):
            yield info.leaf.name, (ours.lo, ours.hi), (theirs.lo, theirs.hi)


def _in_both(ours: Range, theirs: Range) -> Range | None:
    """The part that two ranges have in common, if there is one and it has two ends."""
    low, high = max(ours[0], theirs[0]), min(ours[1], theirs[1])
    return (low, high) if -1e9 < low <= high < 1e9 else None
