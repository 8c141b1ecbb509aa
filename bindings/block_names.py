"""Gives the blocks of a binding their names, and makes those that are alike one.

``gathering`` calls ``named`` with the blocks of all materials. A name follows from declarations,
and not from what else is bound, so that a host's code stays right when files are added:

- what every material has, is called as in reflections: ``View``, ``Draw``;
- what belongs to a rig, begins with the rig's name: ``StudioRig``;
- all else begins with the material's name: ``PlasticMaterial``, ``ReedFrame``. Where several
  materials share such a block, it is one type that has a name for each of them.

Only where files declare different things by one name, such as two rigs ``Studio``, do all of these
get longer names.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from itertools import chain, count

from ..compiler.documents.reflection import Reflection
from ..support.frozen import changed, frozen
from .materials import Block

SHARED = ("frame", "view", "rig", "draw")
"""The groups that hosts update for several materials together."""
_EVERYWHERE = "std.prelude."
"""What the names of declarations begin with that every material has."""


@frozen(kw_only=True)
class Owner:
    """A material with its blocks, which are called as in its reflection."""

    name: str
    """Name in the binding."""
    reflection: Reflection
    blocks: tuple[Block, ...]


class _Kind:
    """Blocks of several materials that are alike."""

    def __init__(self, block: Block, sources: tuple[int, ...]) -> None:
        self.block = block
        self.sources = sources
        """The kinds of the blocks from which it is computed."""
        self.names: dict[str, None] = {}

    def has(self, block: Block, sources: tuple[int, ...]) -> bool:
        """True if hosts can use one for the other: the same bytes for the same values."""
        mine, other = ((each.structure, each.layout_id, each.steps) for each in (self.block, block))
        return mine == other and self.sources == sources


def named(owners: Sequence[Owner]) -> tuple[list[tuple[Block, ...]], tuple[Block, ...]]:
    """The blocks of each owner by their names in the binding, and all blocks, each once."""
    kinds, numbers = _kinds(owners)
    _name(owners, kinds, numbers)
    found = [_called(kind, kinds) for kind in kinds]
    return [tuple([found[number] for number in row]) for row in numbers], tuple(found)


def _kinds(owners: Sequence[Owner]) -> tuple[list[_Kind], list[list[int]]]:
    """The different blocks, and for each owner the numbers of its own among them."""
    kinds: list[_Kind] = []
    alike: dict[tuple[str, str], list[int]] = {}
    """The numbers of the kinds that may be alike, by their plain names and owners."""
    numbers = []
    for owner in owners:
        mine: dict[str, int] = {}
        for block in owner.blocks:
            sources = tuple([mine[each.plain_name] for each in block.sources])
            whose = "" if block.group in SHARED else owner.reflection.material
            known = alike.setdefault((block.plain_name, whose), [])
            number = next((each for each in known if kinds[each].has(block, sources)), len(kinds))
            if number == len(kinds):
                kinds.append(_Kind(block, sources))
                known.append(number)
            mine[block.plain_name] = number
        numbers.append(list(mine.values()))
    return kinds, numbers


def _name(
    owners: Sequence[Owner], kinds: Sequence[_Kind], numbers: Sequence[Sequence[int]]
) -> None:
    """Give each kind its names: the shortest of each owner that no other kind could have."""
    wishes = [
        (number, tuple(_wishes(owner, kinds[number].block)))
        for owner, row in zip(owners, numbers, strict=True)
        for number in row
    ]
    claims: dict[str, set[int]] = {}
    for number, names in wishes:
        for name in names:
            claims.setdefault(name, set()).add(number)
    taken: dict[str, int] = {}
    for number, names in wishes:
        name = next((each for each in names if len(claims[each]) == 1), names[-1])
        free = chain((name,), (f"{name}.{more}" for more in count(2)))
        name = next(each for each in free if taken.setdefault(each, number) == number)
        kinds[number].names[name] = None


def _wishes(owner: Owner, block: Block) -> Iterator[str]:
    """The names that a block of a material may have, those that say least first."""
    plain, material = block.plain_name, owner.reflection.material
    is_bound = bool(block.layout_id)  # Others have what this material's derived values need.
    if is_bound and block.group == "rig":
        yield f"{owner.reflection.rig}.{plain}"
    elif is_bound and block.group in SHARED and _is_everywhere(owner.reflection, block):
        yield plain
    yield f"{material}.{plain}"
    yield f"{owner.name}.{plain}"


def _is_everywhere(reflection: Reflection, block: Block) -> bool:
    """True if every material declares what is in a block, or may compute it under this name."""
    names = {block.plain_name, *(each.plain_name for each in block.sources)}
    given = (
        (row.library or "").startswith(_EVERYWHERE)
        for row in reflection.parameters
        if row.block in names
    )
    computed = (row.role is not None for row in reflection.derived if row.block in names)
    return all(given) and all(computed)


def _called(kind: _Kind, kinds: Sequence[_Kind]) -> Block:
    """The block of a kind, with its names and those of its sources."""
    name, *others = sorted(kind.names)
    block = kind.block
    block = changed(block, structure=changed(block.structure, name=name), aliases=tuple(others))
    if block.derivation is None:
        return block
    called: Mapping[str, str] = {
        kinds[number].block.plain_name: min(kinds[number].names) for number in kind.sources
    }
    sources = tuple(
        [changed(each, name=called[each.plain_name]) for each in block.derivation.sources]
    )
    return changed(block, derivation=changed(block.derivation, sources=sources))
