"""Splits the graph of a shader into the stages of a program; this is the last pass.

It walks the chain of stages backwards from the results of the shader. A stage has to compute its
results and the values that the next stage reads. The crossings among the operands of these are
values that the stage before has to deliver.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from itertools import count
from typing import TYPE_CHECKING

from ...support.frozen import frozen
from ..ir import build
from ..ir.kernel import WRITTEN_GROUP
from ..ir.node import Graph, Node, formals_of
from ..ir.operations import INPUT
from ..ir.program import (
    Block,
    Field,
    Function,
    Image,
    Interface,
    Output,
    Program,
    Stage,
    Varying,
    native_uses,
    texture_reads,
)
from ..ir.shader import Notes, Result, Shader
from ..ir.stages import (
    CAPTURE,
    EDGE_LEVEL,
    EMITTING,
    EXTENT,
    IMAGE,
    INNER_LEVEL,
    VARYING,
    StageRow,
)
from ..ir.types import UINT, scalar_kind
from ..ir.walks import called_functions, visible
from ..layout import blocks_of
from .hoist import Derived
from .interfaces import Interfaces
from .naming import Naming
from .schedule import Scheduler
from .uniformity import needing_uniform_flow

if TYPE_CHECKING:
    from .emit_strips import GroupValues


def split_stages(shader: Shader, derived: tuple[Derived, ...]) -> Program:
    """The program of a shader whose results have been through all other passes.

    It is the last pass, and also the last step of ``targets/legalise`` if that has changed some
    values.
    """
    blocks = blocks_of(shader, [value.parameter for value in derived])
    _name_levels(shader.results, shader.notes)
    works: list[Work] = []
    interfaces = Interfaces(shader.notes, shader.results)
    for row, before in reversed(list(zip(shader.chain, (None, *shader.chain), strict=False))):
        own = [result for result in shader.results if result.stage == row]
        outputs = (
            *_outputs(shader, own),
            *_crossing_outputs(shader.graph, interfaces.leaving(row)),
        )
        if not outputs and before is not None:
            continue
        delivered = tuple(output for output in outputs if output.kind != EMITTING)
        groups = _groups(shader, own, delivered)
        nodes = visible(_roots(groups, delivered), into_bodies=True)
        if before is not None:
            interfaces.enter(row, before, nodes, _placing(shader, groups, delivered))
        emitting = tuple(output.value for output in outputs if output.kind == EMITTING)
        works.insert(0, Work(row, delivered, emitting, groups, nodes))
    stages = [stage_of(work, shader, blocks, interfaces.all) for work in works]
    textures = tuple(
        info.leaf
        for info in shader.textures
        if any(info.leaf in stage.textures for stage in stages)
    )
    used = tuple(b for b in blocks if any(b in stage.blocks for stage in stages))
    buffers = tuple(
        info.leaf
        for info in (*shader.buffers, *shader.written)
        if any(info.leaf in stage.buffers for stage in stages)
    )
    return Program(shader, tuple(stages), used, textures, interfaces.all, buffers)


def _name_levels(results: Sequence[Result], notes: Notes) -> None:
    """Give the levels of patches names, where they are computed and nobody has named them."""
    for kind in (EDGE_LEVEL, INNER_LEVEL):
        for number, result in enumerate(result for result in results if result.kind == kind):
            if result.value.operands and result.value.op != "cross":
                notes.names.setdefault(result.value.id, f"{kind}_{number}")


def _groups(
    shader: Shader, own: Sequence[Result], outputs: Sequence[Output]
) -> tuple[GroupValues, ...]:
    """The groups of strips that a stage emits, if it does."""
    emitted = [result.value for result in own if result.kind == EMITTING]
    if not emitted or shader.expansion is None:
        return ()
    from .emit_strips import groups_of

    values = [output.value for output in outputs]
    return groups_of(shader.graph, shader.notes, shader.expansion, emitted, values)


def _roots(groups: Sequence[GroupValues], outputs: Sequence[Output]) -> list[Node]:
    """The values that a stage has to compute."""
    if not groups:
        return [output.value for output in outputs]
    return [
        node
        for group in groups
        for node in (group.condition, group.count, group.emitted, *group.delivered)
    ]


def _placing(
    shader: Shader, groups: Sequence[GroupValues], outputs: Sequence[Output]
) -> frozenset[Node]:
    """The nodes that a stage computes for positions that have to be invariant."""
    numbers = [
        number
        for number, output in enumerate(outputs)
        if output.kind in shader.placing or (output.field is not None and output.field.invariant)
    ]
    if not numbers:
        return frozenset()
    roots = [outputs[number].value for number in numbers]
    if groups:
        roots = [
            node
            for group in groups
            for node in (group.condition, group.count, group.emitted)
        ]  # fmt: skip
        roots += [group.delivered[number] for group in groups for number in numbers]
    return frozenset(visible(roots, into_bodies=True))


def _outputs(shader: Shader, results: Iterable[Result]) -> Iterator[Output]:
    """The shader's results of one stage; those that a host knows by name get a location each."""
    locations = count()
    for result in results:
        field = None
        image = _image(result)
        if result.name and result.store is None and image is None:
            # GLSL ES wants whole numbers that a vertex stage delivers to be `flat`.
            is_whole = result.kind == CAPTURE and scalar_kind(result.value.type) != "float"
            field = Field(
                result.name, result.value.type, next(locations),
                "flat" if is_whole else "perspective", result.doc,
            )  # fmt: skip
        value = result.value
        if result.store is not None and result.store.as_bits:
            value = _bits_of(shader, value)
        yield Output(result.kind, value, field, result.store, image)


def _bits_of(shader: Shader, value: Node) -> Node:
    """A number as it is written where it shares memory with numbers of other types."""
    kind = scalar_kind(value.type)
    if kind == "uint":
        return value
    name = "bits_of" if kind == "float" else "to_uint"
    bits = shader.graph.node("native", UINT, (value,), name)
    shader.notes.follow(value, bits)
    return bits


def _image(result: Result) -> Image | None:
    if result.kind != IMAGE or result.state is None:
        return None
    return Image(result.name, result.state.format, WRITTEN_GROUP)


def _crossing_outputs(graph: Graph, varyings: Iterable[Varying]) -> Iterator[Output]:
    for varying in varyings:
        yield Output(VARYING, build.vector(graph, varying.values), varying.field)


def _attributes(shader: Shader, nodes: Iterable[Node]) -> tuple[Field, ...]:
    """The vertex inputs that are read, each at the location its declaration gives it."""
    read = {node.data for node in nodes if node.op == "attribute"}
    return tuple(
        Field(
            info.leaf.name, info.leaf.type, location,
            doc=info.doc, step=info.leaf.step,
        )
        for location, info in enumerate(shader.attributes)
        if info.leaf in read
    )  # fmt: skip


@frozen
class Work:
    """The work of a stage."""

    row: StageRow
    outputs: tuple[Output, ...]
    emitting: tuple[Node, ...]
    groups: tuple[GroupValues, ...]
    nodes: list[Node]
    """The nodes that it computes for its outputs, including those in bodies."""
    function: str = ""
    """The function that an engine calls, which it is the work of."""


def stage_of(
    work: Work, shader: Shader, blocks: tuple[Block, ...], interfaces: Sequence[Interface]
) -> Stage:
    """The stage that does this."""
    row, outputs, groups, nodes = work.row, work.outputs, work.groups, work.nodes
    is_first = row == shader.chain[0]
    entering = [face for face in interfaces if face.destination == row.domain]
    handing = [face for face in interfaces if face.through == row.domain]
    # A condition for there being anything to do comes before all statements.
    roots = [] if groups else [output.value for output in outputs if output.kind != EXTENT]
    naming = Naming(shader.notes)
    together = needing_uniform_flow(nodes)
    functions = tuple(
        _function(call, shader.notes, naming, together) for call in called_functions(nodes)
    )
    parameters = {node.data for node in nodes if node.op == "parameter"}
    textures = {node.data for node in nodes if node.op == "texture"}
    arguments = {node.data for node in nodes if node.op == "argument"}
    buffers = {node.data for node in nodes if node.op == "buffer"}
    buffers |= {output.store.buffer for output in outputs if output.store}
    scheduler = Scheduler(roots, shader.notes, naming, together, groups)
    return Stage(
        row=row,
        inputs=_attributes(shader, nodes) if is_first else _fields(entering),
        blocks=tuple(b for b in blocks if any(m.parameter in parameters for m in b.members)),
        textures=tuple(i.leaf for i in shader.textures if i.leaf in textures),
        functions=functions,
        region=scheduler.schedule(),
        results=outputs,
        buffers=tuple(
            info.leaf for info in (*shader.buffers, *shader.written) if info.leaf in buffers
        ),
        builtin_inputs=tuple(
            sorted({INPUT.data(node).name for node in nodes if node.op == "input"})
        ),
        reads=texture_reads(nodes),
        natives=native_uses(nodes),
        handed_on=_fields(handing),
        function=work.function,
        arguments=tuple(info for info in shader.arguments if info.leaf in arguments),
        emitting=work.emitting,
        emitted=scheduler.emitted,
    )


def _fields(interfaces: Iterable[Interface]) -> tuple[Field, ...]:
    return tuple(field for face in interfaces for field in face.fields)


def _function(call: Node, notes: Notes, naming: Naming, together: frozenset[int]) -> Function:
    body = call.operands[0]
    types = [argument.type for argument in call.operands[1:]]
    return Function(
        name=notes.functions.get(body.id, "shade"),
        doc=notes.docs.get(body.id, ""),
        parameters=tuple(zip(formals_of(call), types, strict=True)),
        body=body,
        region=Scheduler((body,), notes, naming, together).schedule(),
        value=body,
    )
