"""Finds the limits of a profile that a program exceeds.

``compiling.py`` asks before anything is printed, and makes errors of the answers.
``availability.py`` adds the way out where it follows from other profiles. ``lacks.py`` finds
features that a profile lacks altogether.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence

from ...compiler.ir.kernel import invocations
from ...compiler.ir.leaves import Buffer, Texture
from ...compiler.ir.node import Node
from ...compiler.ir.operations import OF_GROUPS
from ...compiler.ir.program import Program, Stage
from ...compiler.ir.stages import CAPTURE, COMPUTE, FRAGMENT, TARGET, VERTEX
from ...compiler.ir.statements import Region
from ...compiler.ir.types import Struct, width
from ...compiler.ir.walks import visible
from ...support.frozen import frozen
from ..description.capabilities import (
    INSTANCES,
    SEVERAL_TARGETS,
    buffers_of,
    lacking,
    without_native_stages,
)
from ..description.capability import feature_of_stage
from ..description.profile import LIMITED, Profile, buffer_limit
from .bindings import pushed_block
from .lacks import capturing, emitting, is_lowered
from .samplers import sampler_count, sampler_owners


@frozen
class Excess:
    """A limit that is exceeded: more of something than every device of the profile supports."""

    limit_name: str
    """A field of ``Limits``."""
    count: int
    limit: int
    declared: str = ""
    """The first texture, buffer or block of the host that is beyond the limit."""
    of_expansion: bool = False
    """True if the reason is the material's expansion or tessellation."""
    instead: str = ""
    """A hint, if there is one besides compiling for another profile."""

    @property
    def what(self) -> str:
        """The noun for the limited things, which follows their number."""
        return LIMITED[self.limit_name].what


def excesses(program: Program, profile: Profile) -> Iterator[Excess]:
    """The limits of a profile that a program exceeds."""
    by_corner = program.shader.expansion is not None and not emitting(program)
    by_corner = by_corner or program.shader.corner_buffer is not None
    told = {"attributes"} if is_lowered(program) and not INSTANCES.is_met(profile) else set[str]()
    for name, count in _counts(program, profile).items():
        if name in told:  # By ``lacks``: nothing is drawn as instances.
            continue
        limit = profile.limits.most(name)
        if limit is not None and count > limit:
            of_corners = by_corner and name == "attributes"
            instead = BY_CORNER if of_corners else INSTEAD.get(name, "")
            first = _first_beyond(program, name, limit)
            yield Excess(name, count, limit, first, of_expansion=of_corners, instead=instead)
    if not {stage.row for stage in emitting(program)} - {*profile.stages}:
        yield from _too_much_emitted(program, profile)
    yield from _excessive_places(program, profile)


def _first_beyond(program: Program, name: str, limit: int) -> str:
    """The first texture or buffer that a stage has beyond a limit of those; empty for others."""
    for stage in program.stages:
        limited: Mapping[str, Sequence[Texture | Buffer]] = {
            "textures": stage.textures, buffer_limit(stage.row): stage.buffers
        }  # fmt: skip
        if beyond := limited.get(name, ())[limit:]:
            return beyond[0].name
    return ""


def demands(program: Program, profile: Profile) -> Iterator[Excess]:
    """The limits by which a program needs more than every device of the profile has.

    A host has to ask the device for it.
    """
    name, limits = "textures", profile.limits
    count = max(len(stage.textures) for stage in program.stages)
    if limits.asked_textures is not None and limits.textures < count <= limits.asked_textures:
        yield Excess(name, count, limits.textures)


def _counts(program: Program, profile: Profile) -> dict[str, int]:
    """The program's number of everything that is limited, by the field of the limit."""
    depths = (_nested_blocks(region) for stage in program.stages for region in stage.regions)
    crossing = (len(face.varyings) for face in program.interfaces)
    owners = sampler_owners(program, profile)
    return {
        # Captured values leave a stage as varyings do.
        "varyings": max(*crossing, len(program.results_of(CAPTURE)), 0),
        "attributes": program.input_locations + _missing_inputs(program, profile),
        "textures": max(len(stage.textures) for stage in program.stages),
        "samplers": 0
        if profile.samplers.combined
        else max(sampler_count(stage, owners) for stage in program.stages),
        "vertex_textures": max((len(stage.textures) for stage in _of_vertices(program)), default=0),
        **_uniform_counts(program, profile),
        "nested_blocks": max(depths),
        "inlined_operations": max(map(_inlined_operations, program.stages)),
        # If the profile has only one target, ``lacks`` reports that.
        "render_targets": len(program.results_of(TARGET)) if SEVERAL_TARGETS.is_met(profile) else 0,
        "work_group": 0
        if program.shader.work_group is None
        else invocations(program.shader.work_group),
        "shared_bytes": _shared_bytes(program),
        "push_constant_bytes": _push_constant_bytes(program, profile),
        **_buffer_counts(program, profile),
    }


def _of_vertices(program: Program) -> list[Stage]:
    """The stages that compute vertices."""
    return [stage for stage in program.stages if stage.row not in (FRAGMENT, COMPUTE)]


def _uniform_counts(program: Program, profile: Profile) -> dict[str, int]:
    """The size of the largest block or, with loose uniforms, the vectors that each stage reads."""
    if not profile.loose_uniforms:
        return {"block_bytes": max((block.size for block in program.blocks), default=0)}

    def most(stages: Iterable[Stage]) -> int:
        sizes = (sum(block.size for block in stage.blocks) for stage in stages)
        return max(sizes, default=0) // VECTOR_BYTES

    fragments = (stage for stage in program.stages if stage.row == FRAGMENT)
    return {"vertex_uniforms": most(_of_vertices(program)), "fragment_uniforms": most(fragments)}


def _missing_inputs(program: Program, profile: Profile) -> int:
    """The vertex inputs that replace a buffer of corners, if the profile can have none."""
    corners = program.shader.corner_buffer
    if corners is None or not isinstance(corners.type.element, Struct):
        return 0
    return 0 if buffers_of(VERTEX).is_met(profile) else len(corners.type.element.members)


def _shared_bytes(program: Program) -> int:
    """The bytes that a work group shares to join values: an array of each type that it joins."""
    natives = (native for stage in program.stages for native in stage.natives)
    joined = {native.types[0] for native in natives if native.builtin in OF_GROUPS}
    if not joined or program.shader.work_group is None:
        return 0
    # A vector of three lanes takes the room of four in some languages.
    lanes = sum({3: 4}.get(width(type_), width(type_)) for type_ in joined)
    return lanes * LANE_BYTES * invocations(program.shader.work_group)


def _push_constant_bytes(program: Program, profile: Profile) -> int:
    """The size of the block that is push constants, if one is."""
    name = pushed_block(program, profile)
    return next((block.size for block in program.blocks if block.name == name), 0)


def _buffer_counts(program: Program, profile: Profile) -> dict[str, int]:
    """The storage buffers of the stages. ``lacks`` reports stages that can have none."""
    counts: dict[str, int] = {}
    for stage in program.stages:
        if profile.limits.buffers_of(stage.row):
            name = buffer_limit(stage.row)
            counts[name] = max(counts.get(name, 0), len(stage.buffers))
    return counts


def _too_much_emitted(program: Program, profile: Profile) -> Iterator[Excess]:
    """More vertices, or numbers, than a stage can emit for one primitive."""
    for stage in emitting(program) if program.shader.expansion else ():
        assert program.shader.expansion is not None
        vertices = program.shader.expansion.vertices
        components = vertices * sum(width(root.type) for root in stage.roots)
        for name, count, limit in (
            ("emitted_vertices", vertices, profile.limits.emitted_vertices),
            ("emitted_components", components, profile.limits.emitted_components),
        ):
            if count > limit:
                capability = capturing(program) or lacking(feature_of_stage(stage.row))
                instead = without_native_stages(capability, profile)
                yield Excess(name, count, limit, of_expansion=True, instead=instead)


def _inlined_operations(stage: Stage) -> int:
    """The operations of a stage if each call is replaced by the function's body.

    The result is at most ``UNCOUNTED``. Functions follow those that they call.
    """
    if not stage.functions:
        return 0
    whole: dict[Node, int] = {}

    def of_calls(nodes: Iterable[Node]) -> int:
        return sum(whole[node.operands[0]] for node in nodes if node.op == "apply")

    for function in stage.functions:
        whole[function.body] = min(len(function.nodes) + of_calls(function.nodes), UNCOUNTED)
    return min(of_calls(visible(stage.roots)), UNCOUNTED)


def _nested_blocks(region: Region) -> int:
    """The depth of nesting of loops and branches."""
    deepest = 0
    pending = [(region, 0)]
    while pending:
        block, depth = pending.pop()
        deepest = max(deepest, depth)
        pending += [(inner, depth + 1) for s in block.statements for inner in s.regions]
    return deepest


def _excessive_places(program: Program, profile: Profile) -> Iterator[Excess]:
    """Bindings of the host's own blocks, and of the scheme, that the profile does not have.

    They count from 0.
    """
    scheme, limits = profile.scheme, profile.limits
    of_host = [(block.host, block.name) for block in program.blocks]
    groups = [(place.group, name) for place, name in of_host if place is not None]
    groups += [(number, "") for number in (*scheme.sets.values(), *scheme.resources.values())]
    bindings = [(place.binding, name) for place, name in of_host if place is not None]
    bindings += [(number, "") for number in scheme.first.values()]
    for limit_name, numbers, limit in (
        ("groups", groups, limits.groups),
        ("bindings", bindings, limits.bindings),
    ):
        for number, name in numbers:
            if limit is not None and number >= limit:
                yield Excess(limit_name, number + 1, limit, name)


LANE_BYTES = 4
VECTOR_BYTES = 4 * LANE_BYTES
UNCOUNTED = 10**9
"""The number at which counting stops: inlined operations double with each function that calls the
one before it twice."""
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
"""Advice about a limit that is the same in all profiles."""
