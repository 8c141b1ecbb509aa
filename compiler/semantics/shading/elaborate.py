"""material × pass × rig = shader."""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ....support.frozen import changed
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.source import Span
from ...ir.node import Node, bare
from ...ir.render_state import RenderState
from ...ir.shader import (
    AttributeInfo,
    BufferInfo,
    PatchPattern,
    RenderTarget,
    Result,
    Shader,
    TextureInfo,
)
from ...ir.stages import (
    CAPTURE,
    CLIP_POSITION,
    DISCARD,
    FRAGMENT,
    FRAGMENT_DEPTH,
    TARGET,
    VERTEX,
    Chain,
)
from ...ir.types import BOOL, FLOAT, VEC4
from ...syntax import ast
from ..checking.slots import slot
from ..declarations.externs import read_externs
from ..declarations.fitting import fit, typed
from ..declarations.parameters import all_parameters, of_kind
from ..inheritance.records import Record
from ..lowering.outlining import lowered
from ..names.modules import Symbol
from ..state.context import Context
from ..state.scope import DerivedVertices, Failure, Instance
from .assembly import Setting, is_declared_abstract
from .host_names import check_host_names
from .instances import pass_scope
from .intents import with_intents
from .kernels.group_results import check_no_groups
from .passes.blending import blending_of
from .passes.captures import capture_of, captures, captures_of
from .passes.clears import clears_of
from .passes.formats import FORMATS, texel_value
from .passes.layers import layer_count, layer_of, view_count
from .passes.render_states import DEPTH_VALUE, render_state_of
from .slot_checks import check_rig, check_slots

UNRESOLVED = frozenset(("r32f", "rg32f", "rgba32f"))
"""The formats of which WebGPU makes no means of samples."""


def check_samples(ctx: Context, drawn: Record, state: RenderState) -> None:
    """Reports settings of a pass that need a single sample, if it asks for several."""
    if state.samples == 1:
        return
    for target, *_ in drawn.every(ast.Target):
        if target.format.text in UNRESOLVED:
            reason = f"`{target.name.text}` holds floats of 32 bits"
            _report(ctx, drawn, reason, target.format.span)
    for layers, *_ in drawn.every(ast.Layers):
        _report(ctx, drawn, "its targets have layers", layers.span)
    for views, *_ in drawn.every(ast.Views):
        _report(ctx, drawn, "its targets have a layer for each view", views.span)
    if state.fill == "lines":
        filled = [written.span for name, written in _settings(drawn) if name.text == "fill"]
        _report(ctx, drawn, "it draws lines", filled[0])


def check_coverage(ctx: Context, drawn: Record) -> None:
    """Reports that a whole pass makes coverage of alpha, but has one sample or no alpha."""
    state = render_state_of(ctx, drawn)
    first = next((target.format for target, *_ in drawn.every(ast.Target)), None)
    if not state.alpha_to_coverage or drawn.baseless:
        return
    if first is None:
        reason = "it has no target"
    elif state.samples == 1:
        reason = "it has one sample for each pixel"
    elif FORMATS.get(first.text, VEC4) != VEC4:
        reason = f"{first.text} has no alpha"
    else:
        return
    said = [written.span for name, written in _settings(drawn) if name.text == "alpha_to_coverage"]
    ctx.report.add(rules.NO_COVERAGE, said[0], name=drawn.name, reason=reason)


def check_samples_of_lines(ctx: Context, drawn: Record, step: DerivedVertices) -> None:
    """Report that a step of the material makes lines, if the pass asks for several samples."""
    lines = None
    if step.expansion is not None and step.expansion.emits == "line":
        lines = step.expansion.span
    if step.tessellation is not None and step.tessellation.kind.drawn == "line":
        lines = step.tessellation.span
    if lines is not None and render_state_of(ctx, drawn).samples > 1:
        _report(ctx, drawn, "this draws lines", lines)


def _report(ctx: Context, drawn: Record, reason: str, span: Span) -> None:
    said = [written.span for name, written in _settings(drawn) if name.text == "samples"]
    ctx.report.add(
        rules.ONE_SAMPLE, said[0], name=drawn.name, reason=reason,
        labels=[Label(span, "goes with one sample only")],
    )  # fmt: skip


def _settings(drawn: Record) -> Iterator[tuple[ast.Name, ast.Expression]]:
    """The settings of a pass, those that count first."""
    for member, *_ in reversed(list(drawn.every(ast.Raster))):
        yield from member.settings


def results_of(setting: Setting) -> tuple[Result, ...]:
    """Checks the results of the pass, and everything else that the parts declare.

    Errors have been reported, and their results are left out.
    """
    ctx, surface, passing = setting.ctx, setting.surface, setting.passing
    check_coverage(ctx, passing.record)
    parts, externs = setting.parts, ctx.externs
    found = (
        *_clip_position(ctx, passing, surface),
        *_made(ctx, passing, surface),
        *written_results(ctx, passing),
    )
    name = surface.record.symbol.declaration.name
    check_no_groups(ctx, found, "a material", name.span)
    check_slots(ctx, surface, passing)
    read_externs(ctx, parts.module)
    check_host_names(
        ctx.report, parts.rig, parts.module, setting.leaves, setting.entries, externs.infos
    )
    return found


def written_results(ctx: Context, passing: Instance) -> tuple[Result, ...]:
    """The results of the members of a pass; or of a mixin for passes, which is checked so."""
    check_samples(ctx, passing.record, render_state_of(ctx, passing.record))
    view_count(ctx, passing.record)  # Here it is checked, for mixins, too.
    return (
        *layer_of(ctx, passing, layer_count(ctx, passing.record)),
        *_targets(ctx, passing.record, passing),
        *_discard(ctx, passing.record, passing),
        *_own_depth(ctx, passing.record, passing),
        *captures_of(ctx, passing),
    )


def elaborate(setting: Setting, reached: set[Symbol]) -> Shader | None:
    """The shader of a material under a pass and a rig, or ``None`` after reporting why not.

    ``reached`` gets every declaration that was checked on the way. The setting can be used on:
    nodes that are checked in it later are no part of the shader's graph.
    """
    ctx, parts = setting.ctx, setting.parts
    results = results_of(setting)
    check_rig(ctx, setting.surface)
    ctx.deferred.report()
    reached.update((parts.material, parts.rig, parts.pass_, *ctx.reached()))
    drawn = setting.passing.record
    if ctx.report.failed or not (delivers_vertices(results) and _writes(ctx, drawn, results)):
        return None
    declaration = parts.material.declaration
    assert isinstance(declaration, ast.Record)
    steps = setting.surface.steps
    leaves = setting.all_leaves
    told = _of_pattern(steps)
    written = [result.value for result in results]
    values, graph, notes = lowered(ctx, [*written, *told])
    values, told = values[: len(results)], values[len(results) :]
    return Shader(
        name=setting.surface.record.name,
        doc=declaration.doc,
        pass_name=drawn.name,
        rig_name=parts.rig.name,
        graph=graph,
        notes=notes,
        parameters=all_parameters(leaves, ctx.externs.infos),
        textures=with_intents(of_kind(TextureInfo, leaves), ctx.meanings, written),
        attributes=tuple({a.leaf: a for a in of_kind(AttributeInfo, leaves)}.values()),
        results=tuple(changed(r, value=v) for r, v in zip(results, values, strict=True)),
        externs=ctx.externs.infos,
        chain=_chain(setting),
        expansion=next((step.expansion for step in steps if step.expansion is not None), None),
        tessellation=next((s.tessellation for s in steps if s.tessellation is not None), None),
        pattern=PatchPattern(*told) if told else None,
        capture=capture_of(drawn, results),
        buffers=of_kind(BufferInfo, leaves),
        render_state=render_state_of(ctx, drawn),
        layers=layer_count(ctx, drawn) or view_count(ctx, drawn),
        views=view_count(ctx, drawn) or int(ctx.progress.reads_view),
    )


def _of_pattern(steps: Iterable[DerivedVertices]) -> list[Node]:
    """The values that tell the vertices of patches apart where no stage divides them."""
    patterns = (step.pattern for step in steps if step.pattern is not None)
    return [node for pattern in patterns for node in (pattern.place, pattern.is_there)]


def delivers_vertices(results: Iterable[Result]) -> bool:
    """True if there is a clip position, without which a pass draws nothing, or it captures."""
    return any(result.kind in (CLIP_POSITION, CAPTURE) for result in results)


def _writes(ctx: Context, drawn: Record, results: Iterable[Result]) -> bool:
    """True if a pass has a target, captures, or writes depths or stencil values.

    One that does none of it lost its targets to a mistake elsewhere, such as a base that does not
    exist; this has been reported there.
    """
    if any(result.kind in (TARGET, CAPTURE) for result in results):
        return True
    return _writes_depths(ctx, drawn)


def _writes_depths(ctx: Context, drawn: Record) -> bool:
    """True if a pass is one without targets if it has none: it writes depths or stencil values.

    Of a pass whose base does not exist nobody knows what it writes.
    """
    state = render_state_of(ctx, drawn)
    return not drawn.baseless and (state.depth.write or state.stencil.writes)


def _chain(setting: Setting) -> Chain:
    """The stages up to the vertices, and that of the fragments where any are drawn."""
    made = (row for step in setting.surface.steps for row in step.stages)
    before = (VERTEX, *made)
    return before if captures(setting.passing.record) else (*before, FRAGMENT)


def _clip_position(ctx: Context, passing: Instance, surface: Instance) -> Iterator[Result]:
    """The slot that every pass that draws (or its material) has to define."""
    if captures(passing.record):
        return
    holder = passing if passing.has(CLIP_POSITION) else surface
    declared = passing.record.symbol.declaration.name.span
    if not holder.has(CLIP_POSITION):
        if not is_declared_abstract(passing.record):
            ctx.report.add(rules.NO_CLIP_POSITION, declared, name=passing.record.name)
        return
    span = holder.record.definitions[CLIP_POSITION][0].member.name.span
    node = fit(ctx, slot(ctx, holder, CLIP_POSITION, declared), VEC4, "vec4", span)
    placed = node if isinstance(node, Failure) else ctx.crossings.checked_at_vertex(node, span)
    if isinstance(placed, Node):
        yield Result(CLIP_POSITION, surface.vertex_stage, placed)


def _made(ctx: Context, passing: Instance, surface: Instance) -> Iterator[Result]:
    """The results of the stages that make vertices, besides these."""
    captured, name = captures(passing.record), passing.record.name
    for step in surface.steps:
        yield from step.results
        check_samples_of_lines(ctx, passing.record, step)
        expansion = step.expansion
        if expansion is None:
            continue
        if expansion.emits == "point" and not captured:
            ctx.report.add(rules.POINTS_NOT_CAPTURED, expansion.span, name=name)


def _targets(ctx: Context, drawn: Record, passing: Instance) -> Iterator[Result]:
    written = list(drawn.every(ast.Target))
    is_whole = isinstance(drawn.symbol.declaration, ast.Record) and not is_declared_abstract(drawn)
    is_empty = not written and not drawn.baseless and is_whole and not captures(drawn)
    if (
        is_empty and not _writes_depths(ctx, drawn) and not ctx.report.unread_names
    ):  # Unreadable text may have been a target.
        ctx.report.add(rules.NO_TARGET, drawn.symbol.declaration.name.span, name=drawn.name)
    cleared = clears_of(ctx, drawn).targets
    for row in written:
        found = _target(ctx, drawn, passing, *row)
        if found is not None and found.state is not None:
            yield changed(found, state=changed(found.state, clear=cleared.get(found.name)))


def _target(
    ctx: Context,
    drawn: Record,
    passing: Instance,
    target: ast.Target,
    owner: Symbol,
    level: int,
) -> Result | None:
    blend, mask = blending_of(ctx, drawn, target)
    value = texel_value(ctx, target.format, target.value, pass_scope(owner, passing, level))
    if isinstance(value, Failure):
        return None
    name, state = target.name.text, RenderTarget(target.format.text, blend, mask)
    ctx.notes.names.setdefault(value.id, name)
    return Result(TARGET, FRAGMENT, value, name, target.doc, state, span=target.name.span)


def _is_never(condition: Node) -> bool:
    """True for the word `false`, as for a slot that nobody has set."""
    written = bare(condition)
    return written.op == "constant" and not written.data


def hiding(ctx: Context, drawn: Record, passing: Instance) -> Node | None:
    """The condition under which a pass draws nothing at a pixel; ``None`` if it always draws.

    ``functions.py`` takes it for functions, which have no pass.
    """
    combined: Node | None = None
    for discard, owner, level in drawn.every(ast.Discard):
        scope = pass_scope(owner, passing, level)
        condition = typed(ctx, discard.condition, scope, BOOL, "bool")
        if isinstance(condition, Failure) or _is_never(condition):
            continue
        combined = condition if combined is None else ctx.tree.node(
            "call", BOOL, (combined, condition), "or"
        )  # fmt: skip
    return combined


def _discard(ctx: Context, drawn: Record, passing: Instance) -> Iterator[Result]:
    condition = hiding(ctx, drawn, passing)
    if condition is not None:
        yield Result(DISCARD, FRAGMENT, condition)


def _own_depth(ctx: Context, drawn: Record, passing: Instance) -> Iterator[Result]:
    """The depth that a pass gives its fragments, limited to what depths can be.

    There is none if the pass neither compares nor keeps depths: WebGPU refuses a shader that gives
    one where there is no attachment for depths.
    """
    nearest: Result | None = None
    for member, owner, level in drawn.every(ast.Depth):
        for name, value in member.settings:
            if name.text == DEPTH_VALUE:
                depth = typed(ctx, value, pass_scope(owner, passing, level), FLOAT, "float")
                nearest = None if isinstance(depth, Failure) else _limited_depth(ctx, depth, value)
    if nearest is not None and render_state_of(ctx, drawn).depth.is_used:
        yield nearest


def _limited_depth(ctx: Context, depth: Node, written: ast.Expression) -> Result:
    ctx.notes.names.setdefault(depth.id, "depth")
    limited = ctx.tree.node("call", FLOAT, (depth,), "saturate")
    ctx.places.note(limited, written.span)
    return Result(FRAGMENT_DEPTH, FRAGMENT, limited)
