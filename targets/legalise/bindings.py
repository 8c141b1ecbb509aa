"""Assigns a set and a binding to every block, buffer, texture and sampler of a program.

The numbers follow from what the material, its pass and its rig declare: what no stage reads keeps
its number, so that all programs with the same declarations agree. The sets of the frame, the view
and the rig hold nothing that differs between the materials of a project. ``BindingScheme`` has the
sets, and may have first numbers.

In most profiles a number is used once only within a set: DXC maps HLSL's ``b0``, ``t0`` and ``s0``
all to Vulkan's binding 0. Where there are no sets, blocks, textures and samplers are numbered each
on their own (``Profile.numbering``), and storage buffers after the blocks or on their own, too.
There, a device has few numbers of some kinds (``Limits.numbers``): if more is declared, only what
is read is numbered.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence

from ...compiler.ir.groups import SHARED_GROUPS, STANDARD_GROUPS, block_name
from ...compiler.ir.leaves import Buffer, Texture
from ...compiler.ir.program import Program
from ...compiler.ir.shader import BufferInfo, Shader, TextureInfo
from ...support.frozen import frozen
from ..description.binding_scheme import OF_MATERIALS, BindingKind
from ..description.profile import Profile
from .samplers import sampler_owners


@frozen
class BindingSlot:
    """A place in the binding model."""

    set: int
    binding: int


@frozen
class Bound:
    """Something that has a binding, whether it is read or not."""

    kind: BindingKind
    name: str
    """The name of a block, buffer, image or texture; of a sampler, that of its texture."""
    set: int
    is_read: bool
    first: int | None = None
    """The number that the scheme asks for."""
    place: BindingSlot | None = None
    """The place of a block that the host owns."""
    is_declared: bool = True
    """False for a block that is not there, whose number is only kept free."""
    of_rig: bool = False
    """True if a light of the rig declares it."""


@frozen
class Bindings:
    """The slots of a program; keys are the program's own names."""

    blocks: Mapping[str, BindingSlot]
    textures: Mapping[str, BindingSlot]
    samplers: Mapping[str, BindingSlot]
    """The slots of samplers, for textures that are read by one. Where the profile combines them, it
    is the texture's own slot; textures that share a sampler have one slot."""
    buffers: Mapping[str, BindingSlot]
    images: Mapping[str, BindingSlot]
    sampler_owners: Mapping[str, str]
    """The texture whose sampler reads a texture."""
    every: Sequence[tuple[Bound, BindingSlot]]
    """All that has a slot, what nobody reads included."""
    push_constants: str = ""
    """The block that is push constants, which have no slot; empty if there is none."""


@frozen
class Clash:
    """Two things that have one binding."""

    name: str
    """The block of the host, or the later one of Burnish's own."""
    other: str
    slot: BindingSlot


def assign_bindings(program: Program, profile: Profile) -> Bindings:
    """Number what is declared: blocks first, then images, buffers, textures and samplers."""
    owners = sampler_owners(program, profile)
    numbered = _numbered(_everything(program, profile, owners), profile)
    slots: dict[str, dict[str, BindingSlot]] = defaultdict(dict)
    for bound, slot in numbered:
        if bound.is_read:
            slots[bound.kind][bound.name] = slot
    own = slots["texture"] if profile.samplers.combined else slots["sampler"]
    return Bindings(
        blocks=slots["block"],
        textures=slots["texture"],
        samplers={name: own[owner] for name, owner in owners.items()},
        buffers=slots["buffer"],
        images=slots["image"],
        sampler_owners=owners,
        every=numbered,
        push_constants=pushed_block(program, profile),
    )


def clashes(program: Program, profile: Profile) -> Iterator[Clash]:
    """The bindings that two things have: a block of the host and one of Burnish's, or two of these.

    Textures and buffers take numbers that are free.
    """
    if profile.numbering == "kind" or not profile.explicit_bindings:
        return
    if not program.shader.externs and not profile.scheme.first:
        return
    found: dict[BindingSlot, str] = {}
    every = _numbered(_everything(program, profile, sampler_owners(program, profile)), profile)
    for bound, slot in every:
        if bound.is_declared and slot in found:
            yield Clash(found[slot], bound.name, slot)
        elif bound.is_declared:
            found[slot] = bound.name


def pushed_block(program: Program, profile: Profile) -> str:
    """The block that is push constants; empty if there is none."""
    group = profile.scheme.push_constants
    if not group or profile.limits.push_constant_bytes is None:
        return ""
    own = (b.name for b in program.blocks if b.host is None and not b.derived and b.group == group)
    return next(own, "")


# --- what there is -------------------------------------------------------------------------------


def _everything(program: Program, profile: Profile, owners: Mapping[str, str]) -> Iterator[Bound]:
    """All that is declared, in the order of its numbers."""
    groups = _groups(program.shader)
    yield from _host_blocks(program)
    for group in groups:
        yield from _blocks(program, profile, group)
    for image in program.images:
        set_ = profile.scheme.set_of_resource(image.group, of_rig=False)
        yield Bound("image", image.name, set_, is_read=True)
    for info in _resources(program.shader, groups):
        yield from _resource(info, program, profile, owners)


def _groups(shader: Shader) -> list[str]:
    """All groups: the standard ones, and then those of the user."""
    leaves = (*shader.parameters, *shader.textures, *shader.buffers, *shader.written)
    return list(dict.fromkeys((*STANDARD_GROUPS, *(info.leaf.group for info in leaves))))


def _host_blocks(program: Program) -> Iterator[Bound]:
    read = {block.name: block.host for block in program.blocks if block.host is not None}
    every = {extern.place.name: extern.place for extern in program.shader.externs} | read
    for name, host in every.items():
        place = BindingSlot(host.group, host.binding)
        yield Bound("block", name, place.set, name in read, place=place)


def _blocks(program: Program, profile: Profile, group: str) -> Iterator[Bound]:
    """The block of a group, and those that lie behind it: there or not, they have numbers."""
    scheme = profile.scheme
    first = scheme.first.get(group)
    yield _block(program, group, scheme.set_of(group), derived=False, first=first)
    if group == OF_MATERIALS or group not in SHARED_GROUPS:
        yield _block(program, group, scheme.set_of_derived(group), derived=True)
    if group == OF_MATERIALS:
        for shared in SHARED_GROUPS:
            yield _block(program, shared, scheme.set_of_derived(shared), derived=True)


def _block(
    program: Program, group: str, set_: int, *, derived: bool, first: int | None = None
) -> Bound:
    own = [b for b in program.blocks if b.host is None and (b.group, b.derived) == (group, derived)]
    hosts = frozenset(extern.place.name for extern in program.shader.externs)
    name = own[0].name if own else block_name(group, derived, hosts)
    parameters = [info.leaf for info in program.shader.parameters]
    has_own = any(leaf.group == group and leaf.host is None for leaf in parameters)
    is_declared = bool(own) or (has_own and not derived)
    return Bound("block", name, set_, bool(own), first=first, is_declared=is_declared)


def _resources(shader: Shader, groups: Sequence[str]) -> list[BufferInfo | TextureInfo]:
    """The buffers and textures of each group, in the order of their declarations.

    Those of the rig's lights come before others, whose numbers so have no influence on theirs.
    """
    infos: list[BufferInfo | TextureInfo] = [*shader.buffers, *shader.written, *shader.textures]
    return sorted(infos, key=lambda info: (info.light is None, groups.index(info.leaf.group)))


def _resource(
    info: BufferInfo | TextureInfo,
    program: Program,
    profile: Profile,
    owners: Mapping[str, str],
) -> Iterator[Bound]:
    """A buffer, or a texture and its sampler."""
    leaf, of_rig = info.leaf, info.light is not None
    set_ = profile.scheme.set_of_resource(leaf.group, of_rig=of_rig)
    if isinstance(leaf, Buffer):
        yield Bound("buffer", leaf.name, set_, leaf in program.buffers, of_rig=of_rig)
        return
    assert isinstance(leaf, Texture)
    yield Bound("texture", leaf.name, set_, leaf in program.textures, of_rig=of_rig)
    if (leaf.state or leaf.name in owners) and not profile.samplers.combined:
        is_own = owners.get(leaf.name) == leaf.name
        yield Bound("sampler", leaf.name, set_, is_own, of_rig=of_rig)


# --- their numbers -------------------------------------------------------------------------------


def _numbered(every: Iterable[Bound], profile: Profile) -> list[tuple[Bound, BindingSlot]]:
    things = list(every)
    return _by_kind(things, profile) if profile.numbering == "kind" else _by_set(things)


def _by_set(every: Sequence[Bound]) -> list[tuple[Bound, BindingSlot]]:
    """Uses a number once in a set. Blocks have fixed numbers, and resources those that are free."""
    found: list[tuple[Bound, BindingSlot]] = []
    taken: set[BindingSlot] = set()
    following: defaultdict[int, int] = defaultdict(int)
    for bound in every:
        slot = bound.place
        if slot is None:
            number = following[bound.set] if bound.first is None else bound.first
            slot = BindingSlot(bound.set, number)
            while bound.kind != "block" and slot in taken:
                slot = BindingSlot(bound.set, slot.binding + 1)
            following[bound.set] = max(following[bound.set], slot.binding + 1)
        taken.add(slot)
        found.append((bound, slot))
    return found


def _by_kind(every: Sequence[Bound], profile: Profile) -> list[tuple[Bound, BindingSlot]]:
    """Uses a number once for each kind.

    The host's own blocks are numbered like others, and before them, since their places may differ
    in the set only.
    """
    counts: defaultdict[BindingKind, int] = defaultdict(int)
    for bound in every:
        counts[_counted(bound, profile)] += 1
    following = dict(profile.scheme.kinds)
    found: list[tuple[Bound, BindingSlot]] = []
    for bound in every:
        kind = _counted(bound, profile)
        most = profile.limits.numbers.get(kind)
        if bound.is_read or most is None or counts[kind] <= most:
            number = following.get(kind, 0)
            following[kind] = number + 1
            found.append((bound, BindingSlot(0, number)))
    return found


def _counted(bound: Bound, profile: Profile) -> BindingKind:
    """The kind with which something is counted: images count as textures."""
    if bound.kind == "image":
        return "texture"
    if bound.kind == "buffer" and not profile.numbers_storage_apart:
        return "block"
    return bound.kind
