"""The transforms that are in scope, as ways from space to space.

Every slot declared as a ``transform`` or ``basis`` leads from its first space to its second.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...ir.meaning import GEOMETRY, MAPS, Meaning
from ..state.context import Context
from ..state.scope import Instance, Scope, Way
from ..types.typenames import HOMOGENEOUS, NAMED
from .written_types import declared_type


def transforms(ctx: Context, scope: Scope) -> tuple[Way, ...]:
    """The transforms that an expression could name, the nearest first."""
    passing = ctx.passing if scope.surface is not None else None
    around = scope.instance, scope.surface, passing
    if around not in ctx.types.ways:
        ctx.types.ways[around] = tuple(_transforms(ctx, around))
    return ctx.types.ways[around]


def _transforms(ctx: Context, around: tuple[Instance | None, ...]) -> Iterator[Way]:
    for instance in filter(None, dict.fromkeys(around)):
        for name in instance.record.definitions:
            typing = instance.record.typing(name)
            if typing is None or typing.member.type is None:
                continue
            named = NAMED.get(typing.member.type.name.text)
            if named is None or named.meaning not in MAPS:
                continue
            declared = declared_type(ctx, typing.member.type, typing.owner.module)
            if declared is not None and declared.meaning is not None:
                yield Way(instance, name, declared.meaning)


def _leads(way: Way, kind: str) -> bool:
    """True if a way is one for points, or for vectors and normals."""
    if kind == "point":
        return way.meaning.kind == "transform" and way.ends[0] != HOMOGENEOUS
    return HOMOGENEOUS not in way.ends


def path(ctx: Context, meaning: Meaning, space: str, scope: Scope) -> list[Way] | None:
    """The shortest way into a space, backwards along a transform only where there is no other."""
    forth = transforms(ctx, scope)
    back = tuple(Way(way.instance, way.name, way.meaning, back=True) for way in forth)
    for ways in (forth, forth + back):
        usable = [way for way in ways if _leads(way, meaning.kind)]
        found = _shortest(usable, meaning.spaces[0], space)
        if found is not None:
            return found
    return None


def _shortest(ways: list[Way], start: str, end: str) -> list[Way] | None:
    reached: dict[str, list[Way]] = {start: []}
    front = [start]
    while front and end not in reached:
        ahead: list[str] = []
        for way in ways:
            source, target = way.ends
            if source in front and target not in reached:
                reached[target] = [*reached[source], way]
                ahead.append(target)
        front = ahead
    return reached.get(end)


def is_offered(ctx: Context, meaning: Meaning, space: str, scope: Scope) -> bool:
    """True if `value in space` brings a value with this meaning into a space."""
    return meaning.kind in GEOMETRY and path(ctx, meaning, space, scope) is not None
