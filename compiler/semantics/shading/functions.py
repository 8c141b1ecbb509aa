"""The slots of a material as functions that an engine calls.

``Frontend.functions`` calls ``functions_of`` for each material, after ``elaborate`` has found it
right. The values of slots become the results of a shader of their own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from typing import get_args

from ....support.frozen import changed, frozen
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label, Report
from ...diagnostics.source import Span
from ...ir.blending import NAMED, REPLACES
from ...ir.functions import (
    FunctionsAsked,
    FunctionsShader,
    OwnPass,
    PassBlend,
    SlotInfo,
    SurfaceInfo,
)
from ...ir.leaves import Buffer, Leaf, Parameter, Texture
from ...ir.node import Node, reachable
from ...ir.operations import CROSS
from ...ir.render_state import Cull
from ...ir.shader import Result, Shader, TextureInfo
from ...ir.stages import (
    FRAGMENT,
    FRAGMENTS,
    RASTERISED,
    SURFACE,
    VALUE,
    VERTEX,
)
from ...ir.types import Matrix, Scalar, Type, Vector
from ..checking.slots import slot
from ..declarations.parameters import of_kind
from ..inheritance.records import Record
from ..inheritance.ties import tie_of
from ..lowering.outlining import lowered
from ..state.scope import OUTERMOST, Failure
from .assembly import Setting
from .elaborate import hiding
from .intents import with_intents
from .wanted_slots import (
    HIDDEN,
    WantedSlot,
    constant_lanes,
    library_slot,
    moved_words,
    slots_of,
    wanted_slots,
    word_of,
)

TOGETHER = {FRAGMENT: "surface", VERTEX: "vertices"}
"""What the function is called that returns all slots of a stage."""
OF_RIG = "rig"
"""The group of parameters and textures that belong to lights."""


@frozen
class _Value:
    """The checked value of a slot."""

    slot: WantedSlot
    tree: Node
    span: Span


def functions_of(setting: Setting, shader: Shader, asked: FunctionsAsked) -> FunctionsShader | None:
    """The functions of a material; ``None`` if there are none, or after reporting errors.

    ``shader`` is what ``elaborate`` made of the same setting.
    """
    ctx, record = setting.ctx, setting.surface.record
    name = record.symbol.declaration.name
    if setting.surface.steps:
        ctx.report.add(rules.VERTICES_OF_ITS_OWN, name.span, name=record.name)
        return None
    own = _own_pass(setting, shader)
    given = list(_values(setting, wanted_slots(setting, own, asked), asked))
    values = list(_beside(given, record, asked))
    ctx.deferred.report()
    if ctx.report.failed:
        return None
    surface = list(_surface_values(setting, asked))
    roots = [*(value.tree for value in values), *(tree for _, tree in surface)]
    found, graph, notes = lowered(ctx, roots)
    made = zip(values, found[: len(values)], strict=True)
    kept = [pair for pair in made if _is_free(setting, shader, asked, *pair)]
    if not kept or ctx.report.failed:
        return None
    results = [_result(value, node, asked) for value, node in kept]
    delivered = zip((info for info, _ in surface), found[len(values) :], strict=True)
    known = {node: info for info, node in reversed(list(_crossings(delivered, record, asked)))}
    results += [Result(SURFACE, FRAGMENT, node, info.name) for node, info in known.items()]
    textures = of_kind(TextureInfo, setting.all_leaves)
    made_of = changed(
        shader,
        graph=graph,
        notes=notes,
        results=tuple(results),
        textures=with_intents(textures, ctx.meanings, [value.tree for value, _ in kept]),
        chain=RASTERISED,
    )
    slots = tuple(_slot_info(setting, value, asked) for value, _ in kept)
    return FunctionsShader(made_of, slots, tuple(known.values()), own)


def read_slots(setting: Setting, asked: FunctionsAsked) -> None:
    """Read the slots that functions return: nobody is told then that nothing reads them."""
    surface = setting.surface
    for each in wanted_slots(setting, None, asked):
        span = surface.record.definitions[each.name][0].member.name.span
        slot(setting.ctx, surface, each.name, span)


def _own_pass(setting: Setting, shader: Shader) -> OwnPass | None:
    """How the material's own pass draws it; ``None`` if it is tied to none."""
    drawn = setting.passing.record
    if tie_of(setting.parts.material, setting.ctx.records, Report()) is None:
        return None
    state = shader.render_state
    turned: dict[Cull, Cull] = {"none": "none", "back": "front", "front": "back"}
    cull = state.cull if state.front == "counter_clockwise" else turned[state.cull]
    blends = (target.blend for target in shader.targets if target.blend != REPLACES)
    first = next(blends, REPLACES)
    named: Iterator[PassBlend] = (word for word in get_args(PassBlend) if NAMED.get(word) == first)
    return OwnPass(drawn.name, cull, next(named, "other"), state.alpha_to_coverage)


# --- values ---------------------------------------------------------------------------------------


def _values(
    setting: Setting, slots: Iterable[WantedSlot], asked: FunctionsAsked
) -> Iterator[_Value]:
    """The values of slots, without those that no function returns."""
    ctx, surface = setting.ctx, setting.surface
    for each in slots:
        span = surface.record.definitions[each.name][0].member.name.span
        tree = slot(ctx, surface, each.name, span)
        if word_of(surface.record, each.name, asked) == HIDDEN:
            condition = hiding(ctx, setting.passing.record, setting.passing)
            tree = tree if condition is None else condition
        if isinstance(tree, Failure):
            continue
        if each.is_changed and _is_as_declared(setting, each.name, tree):
            continue
        if not _is_returned(tree.type):
            if each.is_needed:
                shown = ctx.meanings.of(tree) or tree.type
                ctx.report.add(rules.NO_RESULT_OF_FUNCTION, span, slot=each.name, type=shown)
            continue
        at_stage: Node | Failure = tree
        if each.stage == VERTEX:
            at_stage = ctx.crossings.checked_at_vertex(tree, span)
        if isinstance(at_stage, Node):
            yield _Value(each, at_stage, span)


def _beside(values: Sequence[_Value], record: Record, asked: FunctionsAsked) -> Iterator[_Value]:
    """The values without those that have no effect without others, if the material has these."""
    given = {word_of(record, value.slot.name, asked) for value in values}
    missing = {word_of(record, name, asked) for name in slots_of(record)} - given
    for value in values:
        if missing.isdisjoint(value.slot.beside):
            yield value


def _is_as_declared(setting: Setting, name: str, tree: Node) -> bool:
    """True if a slot is a constant, and the one of its declaration: the engine has it itself."""
    declared = setting.surface.record.declaration(name)
    written = constant_lanes(tree)
    usual = slot(setting.ctx, setting.surface, name, declared.member.name.span, declared.level)
    return written is not None and isinstance(usual, Node) and constant_lanes(usual) == written


def _is_returned(type_: Type) -> bool:
    return isinstance(type_, Scalar | Vector | Matrix)


def _is_free(
    setting: Setting, shader: Shader, asked: FunctionsAsked, value: _Value, node: Node
) -> bool:
    """True if a function can return a value; otherwise this is reported of a slot that is named."""
    report = setting.ctx.report
    leaves = [each.data for each in reachable((node,)) if isinstance(each.data, Leaf)]
    buffers = [leaf for leaf in leaves if isinstance(leaf, Buffer)]
    lights = [] if asked.lit else [leaf for leaf in leaves if _is_of_lights(leaf)]
    if buffers and value.slot.is_needed:
        report.add(rules.NOT_AN_ARGUMENT, value.span, slot=value.slot.name, buffer=buffers[0].name)
    elif lights and value.slot.is_needed:
        infos = {info.leaf: info for info in (*shader.parameters, *shader.textures)}
        read = infos.get(lights[0])
        labels = [] if read is None else [Label(read.span, f"reads `{lights[0].name}`")]
        report.add(
            rules.SLOT_NEEDS_LIGHTS, value.span, slot=value.slot.name, labels=labels,
            hint=_way_out(setting),
        )  # fmt: skip
    return not buffers and not lights


def _is_of_lights(leaf: Leaf) -> bool:
    return isinstance(leaf, Parameter | Texture) and leaf.group == OF_RIG


def _way_out(setting: Setting) -> str:
    return (
        "leave the slot to the engine, or name a rig to make its lights arguments: "
        f"`--rig {setting.parts.rig.name}`"
    )


# --- results -------------------------------------------------------------------------------------


def _result(value: _Value, node: Node, asked: FunctionsAsked) -> Result:
    return Result(
        VALUE, value.slot.stage, node, value.slot.name, function=_function_of(value, asked)
    )


def _function_of(value: _Value, asked: FunctionsAsked) -> str:
    return TOGETHER[value.slot.stage] if asked.together else value.slot.name


def _slot_info(setting: Setting, value: _Value, asked: FunctionsAsked) -> SlotInfo:
    record, name = setting.surface.record, value.slot.name
    definitions = record.definitions[name]
    doc = next((d.member.doc for d in definitions if d.member.doc), "")
    typing = record.typing(name)
    shown = str(setting.ctx.meanings.of(value.tree) or value.tree.type)
    if typing is not None and typing.member.type is not None:
        shown = " ".join(typing.member.type.span.text.split())
    word = word_of(record, name, asked)
    return SlotInfo(name, _function_of(value, asked), shown, doc, word)


def _surface_values(setting: Setting, asked: FunctionsAsked) -> Iterator[tuple[SurfaceInfo, Node]]:
    """The values of slots that engines know.

    A slot that engines ask for at each vertex they have as the material makes it, as they draw it
    there. Others they have as the library declares them, unless the material moves these.
    """
    ctx, surface = setting.ctx, setting.surface
    moved = moved_words(surface.record, asked)
    for name in slots_of(surface.record):
        full, first = library_slot(surface.record, name), surface.record.declaration(name)
        word, is_asked = asked.of_surface.get(full), full in asked.at_vertices
        if word is not None and (is_asked or word not in moved):
            member = first.member
            level = OUTERMOST if is_asked else first.level
            tree = slot(ctx, surface, name, member.name.span, level)
            if isinstance(tree, Node):
                type_ = "" if member.type is None else member.type.span.text
                yield SurfaceInfo(name, word, type_, member.doc), tree


def _crossings(
    surface: Iterable[tuple[SurfaceInfo, Node]], record: Record, asked: FunctionsAsked
) -> Iterator[tuple[SurfaceInfo, Node]]:
    """The varying in each of these values, if it is of the same type and the only one.

    Where engines draw a vertex, nothing is made of the varying at the pixels.
    """
    for info, value in surface:
        crossing = [node for node in reachable((value,)) if _enters_fragments(node)]
        is_whole = value in crossing or library_slot(record, info.name) not in asked.at_vertices
        if len(crossing) == 1 and crossing[0].type == value.type and is_whole:
            yield info, crossing[0]


def _enters_fragments(node: Node) -> bool:
    return node.op == "cross" and CROSS.data(node).destination == FRAGMENTS
