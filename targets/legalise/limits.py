"""Finds what a program needs and a profile lacks, or does not have enough of.

``api.py`` asks before anything is printed, and makes errors of the answers.
"""

from __future__ import annotations

from collections.abc import Iterator

from ...compiler.ir.program import NativeUse, Program, Region, Stage, TextureRead
from ...compiler.ir.stages import CAPTURE, TARGET
from ...compiler.ir.types import Texture, width
from ...compiler.passes.walks import visible
from ...frozen import frozen
from ..description.profile import Lack, Limits, Profile
from .samplers import sampler_use


@frozen
class Excess:
    """More of something than every device of the profile is guaranteed to have."""

    what: str
    count: int
    limit: int
    block: str = ""
    """The host's own block that is the reason."""
    instead: str = ""
    """What a user can do, if it is what the material turns its primitives into."""


def excesses(program: Program, profile: Profile) -> Iterator[Excess]:
    """The limits of a profile that a program exceeds."""
    textures = max(len(stage.resources) for stage in program.stages)
    buffers = max(len(stage.buffers) for stage in program.stages)
    # A location counts also where nothing is read at those before it.
    inputs = max((field.location + 1 for field in program.vertex_inputs), default=0)
    varyings = max((len(face.varyings) for face in program.interfaces), default=0)
    block = max((block.size for block in program.blocks), default=0)
    depth = max(_nested_blocks(region) for stage in program.stages for region in stage.regions)
    by_corner = BY_CORNER if program.expansion and not _emitting(program) else ""
    for what, count, limit in (
        ("varyings", varyings, profile.limits.varyings),
        ("captured values", len(program.results_of(CAPTURE)), profile.limits.varyings),
        (INPUTS, inputs, profile.limits.attributes),
        ("storage buffers", buffers, profile.limits.buffers or buffers),
        ("textures", textures, profile.limits.textures),
        ("bytes in a uniform block", block, profile.limits.block_bytes),
        ("nested blocks", depth, profile.limits.nested_blocks),
        ("render targets", len(program.results_of(TARGET)), profile.limits.render_targets),
    ):
        if count > limit:
            yield Excess(what, count, limit, instead=by_corner if what == INPUTS else "")
    if not {stage.row for stage in _emitting(program)} - {*profile.stages}:
        yield from _too_much_emitted(program, profile.limits)
    yield from _excessive_places(program, profile.limits)


def _emitting(program: Program) -> list[Stage]:
    """The stages that emit vertices."""
    return [stage for stage in program.stages if stage.emitted]


def _too_much_emitted(program: Program, limits: Limits) -> Iterator[Excess]:
    """More vertices, or numbers, than a stage can emit for one primitive."""
    for stage in _emitting(program) if program.expansion else ():
        assert program.expansion is not None
        vertices = program.expansion.vertices
        components = vertices * sum(width(root.type) for root in stage.roots)
        for what, count, limit in (
            ("vertices of one primitive", vertices, limits.emitted_vertices),
            ("numbers at the vertices of one primitive", components, limits.emitted_components),
        ):
            if count > limit:
                yield Excess(what, count, limit, instead=WITHOUT_STAGE)


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
            for what, number, limit in (
                ("bind groups", block.host.group, limits.groups),
                ("bindings in a group", block.host.binding, limits.bindings),
            ):
                if limit is not None and number >= limit:
                    yield Excess(what, number + 1, limit, block.name)


INPUTS = "vertex inputs"
BY_CORNER = (
    "each corner that is read has inputs of its own: read fewer slots by corner, or compile with "
    "`--geometry-stage` for a profile that has it"
)
WITHOUT_STAGE = "without `--geometry-stage`, each primitive is drawn as an instance"
OTHER_PROFILE = "compile for a profile that has this stage"

NO_STREAM_OUTPUT = Lack(
    "stream output", "without `--geometry-stage`, a kernel writes what is captured"
)

NO_BUFFERS = Lack(
    "storage buffers",
    "keep the elements in an array of a known length, `param name : T[16]`, or load them from a "
    "texture",
)

NO_NUMBERS = Lack(
    "`vertex_index` where vertices are captured",
    "give the number as a vertex input: `attribute number : uint`",
)

COMPARED_AND_LOADED = Lack(
    "texture that is both compared and loaded", "declare a second `map` for one of the two"
)


def lacks(program: Program, profile: Profile) -> Iterator[tuple[Lack, int]]:
    """What the profile cannot do, each with the id of a node that needs it."""
    for stage in program.stages:
        if stage.row not in profile.stages:
            emits = bool(stage.emitted)
            instead = WITHOUT_STAGE if emits else OTHER_PROFILE
            yield Lack(f"{stage.name} stage", instead, emits), stage.roots[0].id
    captured = program.results_of(CAPTURE)
    if captured and profile.stream_output is None:
        yield NO_STREAM_OUTPUT, captured[0].value.id
    elif captured and not profile.stream_output.indexed:
        yield from ((NO_NUMBERS, number) for number in _numbers_of_vertices(program))
    reading = [s for s in program.stages if s.buffers and s.row in profile.stages]
    if reading and not profile.limits.buffers:
        yield NO_BUFFERS, _first_read(reading[0])
    for native in [native for stage in program.stages for native in stage.natives]:
        if native.builtin in profile.cannot and not _is_read(native):
            yield profile.cannot[native.builtin], native.node
    for read in program.reads:
        if read.builtin in profile.cannot:
            yield profile.cannot[read.builtin], read.node
        compared = _is_depth(read) and read.resource in program.sampled
        if profile.samplers.combined and compared and read.builtin == "load":
            yield COMPARED_AND_LOADED, read.node


def _numbers_of_vertices(program: Program) -> list[int]:
    """The ids of the nodes that read the number of a vertex."""
    stage = program.stages[0]
    (number, *_) = stage.row.inputs
    nodes = visible(stage.roots, into_bodies=True)
    return [node.id for node in nodes if node.op == "input" and node.data == number]


def _first_read(stage: Stage) -> int:
    """The id of a node that reads a storage buffer."""
    nodes = visible(stage.roots, into_bodies=True)
    return next(n.id for n in nodes if n.op == "index" and n.operands[0].op == "buffer")


def _is_read(native: NativeUse) -> bool:
    """Whether it reads a texture: then it stands among the reads, once for each texture."""
    return bool(native.types) and isinstance(native.types[0], Texture)


def _is_depth(read: TextureRead) -> bool:
    return sampler_use(read.resource) == "comparison"
