"""Finds what a program uses and a profile lacks, or does not have enough of.

``api.py`` asks before anything is printed, and makes errors of the answers. Their way out is told
by ``availability.py`` where it follows from the table of capabilities or from other profiles.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ...compiler.ir.blending import REPLACES
from ...compiler.ir.kernel import invocations
from ...compiler.ir.node import Node
from ...compiler.ir.operations import OF_GROUPS
from ...compiler.ir.program import NativeUse, Program, Stage, TextureRead
from ...compiler.ir.shader import RenderTarget
from ...compiler.ir.stages import CAPTURE, CONTROL, TARGET, VERTEX
from ...compiler.ir.statements import Region
from ...compiler.ir.types import Struct, Texture, width
from ...compiler.passes.walks import visible
from ...frozen import frozen
from ..description.capabilities import (
    BLENDED_APART,
    BLENDED_FLOATS,
    CAPTURES,
    DIVIDED_CAPTURES,
    EDGES,
    EMITTED_CAPTURES,
    NUMBERED_CAPTURES,
    SEPARATE_SAMPLERS,
    SOME_BLENDED,
    buffers_of,
    feature_of_builtin,
    lacking,
    without_native_stages,
)
from ..description.capability import Capability, feature_of_stage, standing
from ..description.profile import LIMITED, Limits, Profile, buffer_limit
from .samplers import sampler_use


@frozen
class Excess:
    """More of something than every device of the profile is guaranteed to have."""

    limit_name: str
    """A field of ``Limits``."""
    count: int
    limit: int
    block: str = ""
    """The host's own block that is the reason."""
    of_expansion: bool = False
    """Whether the reason is what the material turns its primitives into."""
    instead: str = ""
    """What a user can do, if it is no matter of other profiles alone."""

    @property
    def what(self) -> str:
        """What there is too much of, behind its number."""
        return LIMITED[self.limit_name].what


@frozen
class Lack:
    """Something that a profile has not got, and a program uses."""

    feature: str
    """That of a ``Need`` in the table of capabilities, behind "… has no"."""
    node: int
    """The id of a node that needs it."""
    of_expansion: bool = False
    """Whether it is what the material turns its primitives or patches into that needs it."""
    instead: str = ""
    """What a user can do, if it is no matter of other profiles alone."""
    needed_for: Capability | None = None
    """The capability for which it is needed, if the feature alone does not say."""
    target: int | None = None
    """The number of the render target that needs it, if it is not its value that does."""


def excesses(program: Program, profile: Profile) -> Iterator[Excess]:
    """The limits of a profile that a program exceeds."""
    by_corner = program.expansion is not None and not _emitting(program)
    by_corner = by_corner or program.corner_buffer is not None
    for name, count in _counts(program, profile).items():
        limit = getattr(profile.limits, name)
        if count > limit:
            of_corners = by_corner and name == "attributes"
            instead = BY_CORNER if of_corners else INSTEAD.get(name, "")
            yield Excess(name, count, limit, of_expansion=of_corners, instead=instead)
    if not {stage.row for stage in _emitting(program)} - {*profile.stages}:
        yield from _too_much_emitted(program, profile)
    yield from _excessive_places(program, profile.limits)


def _counts(program: Program, profile: Profile) -> dict[str, int]:
    """How much a program has of what is limited, by the field of the limit."""
    depths = (_nested_blocks(region) for stage in program.stages for region in stage.regions)
    crossing = (len(face.varyings) for face in program.interfaces)
    return {
        # What is captured leaves a stage as what crosses does.
        "varyings": max(*crossing, len(program.results_of(CAPTURE)), 0),
        "attributes": program.input_locations + _missing_inputs(program, profile),
        "textures": max(len(stage.resources) for stage in program.stages),
        "block_bytes": max((block.size for block in program.blocks), default=0),
        "nested_blocks": max(depths),
        "inlined_operations": max(map(_inlined_operations, program.stages)),
        "render_targets": len(program.results_of(TARGET)),
        "work_group": 0 if program.work_group is None else invocations(program.work_group),
        "shared_bytes": _shared_bytes(program),
        **_buffer_counts(program, profile),
    }


def _missing_inputs(program: Program, profile: Profile) -> int:
    """How many vertex inputs a program lacks a buffer for, which has corners where there can be
    one."""
    corners = program.corner_buffer
    if corners is None or not isinstance(corners.type.element, Struct):
        return 0
    return 0 if buffers_of(VERTEX).is_met(profile) else len(corners.type.element.members)


def _shared_bytes(program: Program) -> int:
    """How many bytes a work group shares that joins values: an array of each type that it joins."""
    natives = (native for stage in program.stages for native in stage.natives)
    joined = {native.types[0] for native in natives if native.builtin in OF_GROUPS}
    if not joined or program.work_group is None:
        return 0
    # A vector of three lanes takes the room of four in some languages.
    lanes = sum({3: 4}.get(width(type_), width(type_)) for type_ in joined)
    return lanes * LANE_BYTES * invocations(program.work_group)


def _buffer_counts(program: Program, profile: Profile) -> dict[str, int]:
    """Likewise of storage buffers. Where a stage can have none, that is what ``lacks`` tells."""
    counts: dict[str, int] = {}
    for stage in program.stages:
        if profile.limits.buffers_of(stage.row):
            name = buffer_limit(stage.row)
            counts[name] = max(counts.get(name, 0), len(stage.buffers))
    return counts


def _emitting(program: Program) -> list[Stage]:
    """The stages that emit vertices."""
    return [stage for stage in program.stages if stage.emitted]


def _too_much_emitted(program: Program, profile: Profile) -> Iterator[Excess]:
    """More vertices, or numbers, than a stage can emit for one primitive."""
    for stage in _emitting(program) if program.expansion else ():
        assert program.expansion is not None
        vertices = program.expansion.vertices
        components = vertices * sum(width(root.type) for root in stage.roots)
        for name, count, limit in (
            ("emitted_vertices", vertices, profile.limits.emitted_vertices),
            ("emitted_components", components, profile.limits.emitted_components),
        ):
            if count > limit:
                capability = _capturing(program) or lacking(feature_of_stage(stage.row))
                instead = without_native_stages(capability, profile)
                yield Excess(name, count, limit, of_expansion=True, instead=instead)


def _inlined_operations(stage: Stage) -> int:
    """The operations that the calls of a stage come to, if each is the function's body instead; at
    most ``UNCOUNTED``. Functions stand behind those that they call."""
    whole: dict[Node, int] = {}

    def of_calls(nodes: Iterable[Node]) -> int:
        return sum(whole[node.operands[0]] for node in nodes if node.op == "apply")

    for function in stage.functions:
        nodes = visible((function.value,))
        whole[function.body] = min(len(nodes) + of_calls(nodes), UNCOUNTED)
    return min(of_calls(visible(stage.roots)), UNCOUNTED)


def _nested_blocks(region: Region) -> int:
    """How many loops and branches stand inside of each other."""
    deepest = 0
    pending = [(region, 0)]
    while pending:
        block, depth = pending.pop()
        deepest = max(deepest, depth)
        pending += [(inner, depth + 1) for s in block.statements for inner in s.regions]
    return deepest


def _excessive_places(program: Program, limits: Limits) -> Iterator[Excess]:
    """Places of the host's own blocks that the profile does not have. They count from 0."""
    for block in program.blocks:
        if block.host is not None:
            for name, number, limit in (
                ("groups", block.host.group, limits.groups),
                ("bindings", block.host.binding, limits.bindings),
            ):
                if limit is not None and number >= limit:
                    yield Excess(name, number + 1, limit, block.name)


LANE_BYTES = 4
UNCOUNTED = 10**9
"""So many operations in place of calls, or more: they double with each function that calls the one
before it twice."""
FLOATS = frozenset(("r32f", "rg32f", "rgba32f"))
"""The formats of targets that have 32-bit floats."""

INLINED = (
    "compilers and drivers put the whole body of a function wherever it is called, with those of "
    "all that it calls: have an equation compute once what several calls share, or a loop what "
    "they repeat"
)
BY_CORNER = (
    "each corner that is read has inputs of its own, unless the vertex stage reads storage "
    "buffers: read fewer slots by corner, or compile for a profile that has these, or with "
    "`--native-stages` for one that has the stage"
)
INSTEAD = {"inlined_operations": INLINED}
"""What a user can do about a limit that no profile has more of."""

WITH_STREAM_OUTPUT = "compile with `--native-stages`: then a stream output captures the vertices"


def lacks(program: Program, profile: Profile) -> Iterator[Lack]:
    """What a program uses and the profile has not got."""
    capturing = _capturing(program)
    missing = [stage for stage in program.stages if stage.row not in profile.stages]
    if capturing is not None:
        yield from _cannot_capture(program, profile, capturing)
    elif missing:
        # What misses the first one of several that belong together misses all of them.
        stage = missing[0]
        of_primitives = bool(stage.emitted) or stage.row == CONTROL
        yield Lack(feature_of_stage(stage.row), stage.roots[0].id, of_primitives)
    if program.fill == "lines" and not EDGES.is_met(profile):
        yield Lack(EDGES.feature, program.stages[-1].roots[0].id)
    yield from _blended(program, profile)
    for stage in program.stages:
        need = buffers_of(stage.row)
        buffers = [buffer for buffer in stage.buffers if buffer != program.corner_buffer]
        if buffers and stage.row in profile.stages and not need.is_met(profile):
            yield Lack(need.feature, _first_use(stage))
    for native in [native for stage in program.stages for native in stage.natives]:
        if native.builtin in profile.cannot and not _is_read(native):
            yield Lack(feature_of_builtin(native.builtin), native.node)
    for read in program.reads:
        if read.builtin in profile.cannot:
            yield Lack(feature_of_builtin(read.builtin), read.node)
        compared = _is_depth(read) and read.resource in program.sampled
        if compared and read.builtin == "load" and not SEPARATE_SAMPLERS.is_met(profile):
            yield Lack(SEPARATE_SAMPLERS.feature, read.node)


def _blended(program: Program, profile: Profile) -> Iterator[Lack]:
    """What the profile has not got of the ways in which the targets are blended."""
    for capability, number in _ways_of_blending(program.targets):
        for feature in standing(capability, profile).missing[:1]:
            root = program.results_of(TARGET)[number].value.id
            yield Lack(feature, root, needed_for=capability, target=number)


def _ways_of_blending(targets: Sequence[RenderTarget]) -> Iterator[tuple[Capability, int]]:
    """What targets need of a profile, each with the number of the first target that needs it."""
    blended = [number for number, target in enumerate(targets) if target.blend != REPLACES]
    apart = [number for number in blended if targets[number].blend != targets[blended[0]].blend]
    if apart:
        yield BLENDED_APART, apart[0]
    else:
        states = [(target.blend, target.mask) for target in targets]
        unlike = [number for number, state in enumerate(states) if state != states[0]]
        yield from ((SOME_BLENDED, number) for number in unlike[:1])
    floats = [number for number in blended if targets[number].format in FLOATS]
    yield from ((BLENDED_FLOATS, number) for number in floats[:1])


def _capturing(program: Program) -> Capability | None:
    """What a program needs that captures; ``None`` if it draws."""
    if program.capture is None:
        return None
    if program.tessellation is not None:
        return DIVIDED_CAPTURES
    return CAPTURES if program.expansion is None else EMITTED_CAPTURES


def _cannot_capture(program: Program, profile: Profile, capturing: Capability) -> Iterator[Lack]:
    """What the profile has not got of a stream output or, where this is lowered, of kernels."""
    cell, captured = standing(capturing, profile), program.results_of(CAPTURE)
    if not captured:
        (kernel,) = program.stages
        if kernel.row not in profile.stages:
            instead = WITH_STREAM_OUTPUT if cell.kind == "native" else ""
            root = kernel.roots[0].id
            yield Lack(feature_of_stage(kernel.row), root, instead=instead, needed_for=capturing)
    elif cell.kind != "native":
        made = program.expansion or program.tessellation
        feature = cell.missing[0]
        yield Lack(feature, captured[0].value.id, made is not None, needed_for=capturing)
    elif not NUMBERED_CAPTURES.is_met(profile):
        reading = _reading_numbers(program)
        yield from (Lack(NUMBERED_CAPTURES.feature, root.id) for root in reading[:1])


def _reading_numbers(program: Program) -> list[Node]:
    """What the first stage delivers that depends on the number of a vertex."""
    stage = program.stages[0]
    (number, *_) = stage.row.inputs
    return [
        root
        for root in stage.roots
        if any(n.op == "input" and n.data == number for n in visible((root,), into_bodies=True))
    ]


def _first_use(stage: Stage) -> int:
    """The id of a node that reads a storage buffer, or else of one that is written to it."""
    nodes = visible(stage.roots, into_bodies=True)
    reads = (n.id for n in nodes if n.op == "index" and n.operands[0].op == "buffer")
    return next(reads, stage.roots[0].id)


def _is_read(native: NativeUse) -> bool:
    """Whether it reads a texture: then it stands among the reads, once for each texture."""
    return bool(native.types) and isinstance(native.types[0], Texture)


def _is_depth(read: TextureRead) -> bool:
    return sampler_use(read.resource) == "comparison"
