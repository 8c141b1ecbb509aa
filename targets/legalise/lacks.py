"""Finds the features that a program uses and a profile lacks altogether.

``compiling.py`` asks before anything is printed, and makes errors of the answers.
``availability.py`` adds the way out, which follows from the table of capabilities. ``limits.py``
finds features that a profile has, but not as often as a program needs them.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence, Set

from ...compiler.ir.blending import REPLACES
from ...compiler.ir.leaves import Texture
from ...compiler.ir.node import Node
from ...compiler.ir.operations import INPUT
from ...compiler.ir.program import NativeUse, Program, Stage, TextureRead
from ...compiler.ir.shader import RenderTarget
from ...compiler.ir.stages import (
    CAPTURE,
    CONTROL,
    FRAGMENT_DEPTH,
    GEOMETRY,
    RASTERISED,
    TARGET,
    VIEW_INDEX,
)
from ...compiler.ir.types import TextureType
from ...compiler.ir.walks import visible
from ...support.frozen import frozen
from ..description.capabilities import (
    BLENDED_APART,
    BLENDED_FLOATS,
    BORDERS,
    CAPTURED_NUMBERS,
    CAPTURES,
    COMPARED_AND_LOADED,
    DIVIDED_CAPTURES,
    EDGES,
    EMITTED_CAPTURES,
    GATHERED_COMPARISONS,
    INSTANCES,
    MULTIVIEW,
    NUMBERED_CAPTURES,
    OWN_DEPTHS,
    SEPARATE_SAMPLERS,
    SEVERAL_TARGETS,
    SOME_BLENDED,
    STREAM_OUTPUT,
    VIEWS_AT_ONCE,
    buffers_of,
    feature_of_builtin,
    feature_of_texture,
)
from ..description.capability import Capability, feature_of_stage, standing
from ..description.profile import Profile
from .samplers import sampler_use, texture_type
from .values import features_of_values


@frozen
class Lack:
    """A feature that a program uses and a profile lacks."""

    feature: str
    """The feature of a ``Need`` in the table of capabilities, behind "… has no"."""
    node: int
    """The id of a node that needs it."""
    of_expansion: bool = False
    """True if the need comes from the material's expansion or tessellation."""
    instead: str = ""
    """A hint, if there is one besides compiling for another profile."""
    needed_for: Capability | None = None
    """The capability for which it is needed, if the feature alone does not say."""
    target: int | None = None
    """The number of the render target that needs the feature, if its value does not."""


FLOATS = frozenset(("r32f", "rg32f", "rgba32f"))
"""The formats of targets that have 32-bit floats."""


WITH_STREAM_OUTPUT = "compile with `--native-stages`: then a stream output captures the vertices"


def lacks(program: Program, profile: Profile) -> Iterator[Lack]:
    """The features that a program uses and the profile lacks."""
    captured = capturing(program)
    missing = [stage for stage in program.stages if stage.row not in profile.stages]
    if captured is not None:
        yield from _cannot_capture(program, profile, captured)
    elif missing:
        # A profile that lacks the first of several stages that belong together lacks all of them.
        stage = missing[0]
        of_primitives = bool(stage.emitted) or stage.row == CONTROL
        yield Lack(feature_of_stage(stage.row), stage.roots[0].id, of_primitives)
    elif is_lowered(program) and not INSTANCES.is_met(profile):
        # Further needs of its stages do not come from the user's text.
        row = GEOMETRY if program.shader.tessellation is None else CONTROL
        yield Lack(feature_of_stage(row), program.stages[0].roots[0].id, of_expansion=True)
        return
    if program.shader.render_state.fill == "lines" and not EDGES.is_met(profile):
        yield Lack(EDGES.feature, program.stages[-1].roots[0].id)
    if (own := program.results_of(FRAGMENT_DEPTH)) and not OWN_DEPTHS.is_met(profile):
        yield Lack(OWN_DEPTHS.feature, own[0].value.id)
    yield from _views(program, profile)
    yield from _of_targets(program, profile)
    if captured is None or STREAM_OUTPUT.is_met(profile):
        values = features_of_values(program, profile)
        yield from (Lack(feature, node) for feature, node in values)
    yield from _buffers(program, profile)
    for native in [native for stage in program.stages for native in stage.natives]:
        if native.builtin in profile.cannot and not _is_read(native):
            yield Lack(feature_of_builtin(native.builtin), native.node.id)
    yield from _textures(program, profile)


def _views(program: Program, profile: Profile) -> Iterator[Lack]:
    """The lack of draws of several views, where the pass asks for one.

    No profile has them in other stages than those of vertices and fragments, as few devices do.
    """
    if not program.shader.views:
        return
    nodes = (node for stage in program.stages for node in stage.nodes)
    reading = (n for n in nodes if n.op == "input" and INPUT.data(n).name == VIEW_INDEX.name)
    place = next(reading, program.stages[-1].roots[0]).id
    others = [stage for stage in program.stages if stage.row not in RASTERISED]
    if not MULTIVIEW.is_met(profile):
        yield Lack(MULTIVIEW.feature, place)
    elif others:
        feature = f"{MULTIVIEW.feature} with a {feature_of_stage(others[0].row)}"
        yield Lack(feature, place, needed_for=VIEWS_AT_ONCE)


def _of_targets(program: Program, profile: Profile) -> Iterator[Lack]:
    """Lacks that follow from the number of the render targets, and from how they are blended."""
    if len(program.shader.targets) > 1 and not SEVERAL_TARGETS.is_met(profile):
        second = program.results_of(TARGET)[1].value.id
        ways = (
            way for way, _ in _ways_of_blending(program.shader.targets) if way != BLENDED_FLOATS
        )
        yield Lack(SEVERAL_TARGETS.feature, second, needed_for=next(ways, None), target=1)
    else:
        yield from _blended(program, profile)


def _buffers(program: Program, profile: Profile) -> Iterator[Lack]:
    """Storage buffers in stages that can have none."""
    for stage in program.stages:
        need = buffers_of(stage.row)
        buffers = [buffer for buffer in stage.buffers if buffer != program.shader.corner_buffer]
        if buffers and stage.row in profile.stages and not need.is_met(profile):
            yield Lack(need.feature, _first_use(stage))


def _textures(program: Program, profile: Profile) -> Iterator[Lack]:
    """Types of textures that the profile lacks, and ways to read other textures."""
    absent = {
        read.texture: read.node
        for read in reversed(program.reads)
        if texture_type(read.texture) not in profile.textures
    }
    for texture, node in absent.items():
        builtins = {read.builtin for read in program.reads if read.texture == texture}
        feature = feature_of_texture(texture_type(texture), profile)
        yield Lack(feature, node, needed_for=_way_of_comparing(builtins))
    bordered = set() if BORDERS.is_met(profile) else _bordered(program)
    for read in program.reads:
        if read.texture in absent:
            continue
        if read.builtin in profile.cannot:
            yield Lack(feature_of_builtin(read.builtin), read.node)
        if read.texture in bordered:
            bordered.remove(read.texture)
            yield Lack(BORDERS.feature, read.node)
        compared = _is_depth(read) and read.texture in program.sampled
        if compared and read.builtin == "load" and not SEPARATE_SAMPLERS.is_met(profile):
            yield Lack(SEPARATE_SAMPLERS.feature, read.node)


def _bordered(program: Program) -> set[Texture]:
    """The textures that samplers read which give them a border."""
    return {texture for texture in program.sampled if "border" in dict(texture.state)}


def _way_of_comparing(builtins: Set[str]) -> Capability | None:
    """The capability that reading a depth texture in these ways needs, besides depth textures."""
    if {"compare", "load"} <= builtins:
        return COMPARED_AND_LOADED
    return GATHERED_COMPARISONS if "gather_compare" in builtins else None


def _blended(program: Program, profile: Profile) -> Iterator[Lack]:
    """The features of blending that the render targets use and the profile lacks."""
    for capability, number in _ways_of_blending(program.shader.targets):
        for feature in standing(capability, profile).missing[:1]:
            root = program.results_of(TARGET)[number].value.id
            yield Lack(feature, root, needed_for=capability, target=number)


def _ways_of_blending(targets: Sequence[RenderTarget]) -> Iterator[tuple[Capability, int]]:
    """The capabilities of blending that targets need, each with the first target that needs it."""
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


def is_lowered(program: Program) -> bool:
    """True if primitives or patches are drawn as instances instead of by stages of their own."""
    made_of = program.shader.expansion or program.shader.tessellation
    rows = {stage.row for stage in program.stages}
    return made_of is not None and program.shader.capture is None and not rows & {CONTROL, GEOMETRY}


def emitting(program: Program) -> list[Stage]:
    """The stages that emit vertices."""
    return [stage for stage in program.stages if stage.emitted]


def capturing(program: Program) -> Capability | None:
    """The capability that a program needs to capture vertices; ``None`` if it draws."""
    if program.shader.capture is None:
        return None
    if program.shader.tessellation is not None:
        return DIVIDED_CAPTURES
    return CAPTURES if program.shader.expansion is None else EMITTED_CAPTURES


def _cannot_capture(program: Program, profile: Profile, capturing: Capability) -> Iterator[Lack]:
    """The lacking features of stream output or, if capturing is lowered, of kernels."""
    cell, captured = standing(capturing, profile), program.results_of(CAPTURE)
    if not captured:
        (kernel,) = program.stages
        if kernel.row not in profile.stages:
            instead = WITH_STREAM_OUTPUT if cell.kind == "native" else ""
            root = kernel.roots[0].id
            yield Lack(feature_of_stage(kernel.row), root, instead=instead, needed_for=capturing)
    elif cell.kind != "native":
        made = program.shader.expansion or program.shader.tessellation
        feature = cell.missing[0]
        if capturing == CAPTURES and _reading_numbers(program):
            capturing = CAPTURED_NUMBERS
        yield Lack(feature, captured[0].value.id, made is not None, needed_for=capturing)
    elif not NUMBERED_CAPTURES.is_met(profile):
        reading = _reading_numbers(program)
        yield from (Lack(NUMBERED_CAPTURES.feature, root.id) for root in reading[:1])


def _reading_numbers(program: Program) -> list[Node]:
    """The outputs of the first stage that depend on the vertex index."""
    stage = program.stages[0]
    (number, *_) = stage.row.inputs
    return [
        root
        for root in stage.roots
        if any(n.op == "input" and n.data == number for n in visible((root,), into_bodies=True))
    ]


def _first_use(stage: Stage) -> int:
    """The id of a node that reads a storage buffer, or else of one that is written to it."""
    reads = (n.id for n in stage.nodes if n.op == "index" and n.operands[0].op == "buffer")
    return next(reads, stage.roots[0].id)


def _is_read(native: NativeUse) -> bool:
    """True if the use reads a texture, and so is among the program's texture reads, too."""
    return bool(native.types) and isinstance(native.types[0], TextureType)


def _is_depth(read: TextureRead) -> bool:
    return sampler_use(read.texture) == "comparison"
