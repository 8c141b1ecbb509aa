"""The middle end: every pass, in order."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import replace
from itertools import count

from ...frozen import changed, frozen
from ..ir import build
from ..ir.leaves import Attribute, Parameter, Resource
from ..ir.node import Graph, Node, formals_of
from ..ir.operations import INPUT
from ..ir.program import (
    Block,
    Field,
    Function,
    Interface,
    Output,
    Program,
    Stage,
    Varying,
    native_uses,
    texture_reads,
)
from ..ir.ranges import Ranges
from ..ir.rewrite import rewrite
from ..ir.shader import Notes, Result, Shader
from ..ir.stages import VARYING, StageRow
from ..layout import STANDARD_GROUPS, layout_blocks
from .checkpoint import passed
from .expand_builtins import expand_builtins
from .fuse import fuse
from .guard import Guard, Guarding
from .hoist import Derived, hoist
from .inline import inline
from .lift_lambdas import lift_lambdas
from .lower_reads import lower_reads
from .move_to_vertices import move_to_vertices
from .naming import Naming
from .open_binders import open_binders
from .pack_varyings import pack_varyings
from .path_conditions import PathConditions
from .remarks import Remark
from .rename_variables import rename_variables
from .replace_aggregates import replace_aggregates
from .schedule import Scheduler
from .simplify import Simplifier
from .walks import called_functions, visible


@frozen
class Options:
    """Choices that change a program but not its meaning."""

    hoist: bool = True
    """Compute what depends on parameters only on the host side."""
    without: frozenset[str] = frozenset()
    """Rules of range analysis to do without (``rulebook.py``), to see what they are good for."""


@frozen
class Evidence:
    """What ``proofs.py`` explains: decisions of the passes, on the grounds of these ranges."""

    remarks: tuple[Remark, ...]
    ranges: Ranges
    notes: Notes
    """As they were when the last decision was made: later passes name values of their own."""


@frozen
class Undecided:
    """What a program was made of that has calls which each profile decides about: there it is made
    once more, without them (``targets/legalise``)."""

    shader: Shader
    """Its results are those of the program."""
    derived: tuple[Derived, ...]
    ranges: Ranges


@frozen
class Staged:
    """A program with what else is to be told about it."""

    program: Program
    derived: tuple[Derived, ...]
    guards: tuple[Guard, ...]
    evidence: Evidence
    undecided: Undecided | None = None
    """Where the program has such calls."""


def stage(shader: Shader, options: Options) -> Staged:
    """The program of a shader: optimised, guarded, laid out, split into stages and scheduled."""
    graph, notes = shader.graph, shader.notes
    roots = passed("semantics", "semantics", shader.roots)
    roots = passed("open_binders", "opened", open_binders(graph, roots, notes))
    roots = passed("replace_aggregates", "flat", replace_aggregates(graph, roots, notes))
    # Passes keep values, so what is known of a node, or of a variable, stays true throughout.
    ranges = Ranges(roots, options.without)
    simplifier = Simplifier(graph, ranges, notes)
    roots = _simplified(graph, roots, notes, simplifier)
    roots, guarding = _guarded(graph, roots, notes, ranges)
    evidence = Evidence(
        (*simplifier.remarks.values(), *guarding.remarks.values()), ranges, notes.copy()
    )
    roots = passed("move_to_vertices", "guarded", move_to_vertices(graph, roots, notes))
    derived: tuple[Derived, ...] = ()
    if options.hoist:
        declared = (info.parameter.name for info in shader.parameters)
        roots, derived = hoist(graph, roots, notes, ranges, declared)
        passed("hoist", "guarded", roots)
    roots = passed("lift_lambdas", "guarded", lift_lambdas(graph, roots, notes))
    roots = passed("lower_reads", "stored", lower_reads(graph, roots, notes.follow))
    roots = passed("rename_variables", "stored", rename_variables(graph, roots, notes.follow))
    passed_on = with_results(shader, roots)
    program = program_of(passed_on, derived)
    undecided = Undecided(passed_on, derived, ranges) if guarding.undecided else None
    return Staged(program, derived, tuple(guarding.kept.values()), evidence, undecided)


def with_results(shader: Shader, roots: Iterable[Node]) -> Shader:
    """A shader with other nodes for its results."""
    results = tuple(changed(r, value=v) for r, v in zip(shader.results, roots, strict=True))
    return replace(shader, results=results)


def _simplified(
    graph: Graph, roots: list[Node], notes: Notes, simplifier: Simplifier
) -> list[Node]:
    """Simplify, fuse sums over lights, and write out what is used once."""
    roots = passed("simplify", "flat", rewrite(graph, roots, simplifier.rule, notes.follow))
    roots = passed("fuse", "flat", fuse(graph, roots, notes, simplifier))
    return passed("inline", "flat", inline(graph, roots, notes, simplifier))


def _guarded(
    graph: Graph, roots: list[Node], notes: Notes, ranges: Ranges
) -> tuple[list[Node], Guarding]:
    roots = passed("expand_builtins", "flat", expand_builtins(graph, roots, notes, ranges))
    guarding = Guarding(graph, ranges, notes, PathConditions(roots, ranges))
    roots = passed("guard", "guarded", rewrite(graph, roots, guarding.rule, notes.follow))
    roots = passed("inline", "guarded", inline(graph, roots, notes, guarding))
    return roots, guarding


# --- the program ---------------------------------------------------------------------------------


def program_of(shader: Shader, derived: tuple[Derived, ...]) -> Program:
    """The stages that the results of a shader need, from the last one back to the first.

    ``stage`` calls it after all passes, and ``targets/legalise`` for results that it has changed.
    """
    blocks = _blocks(shader, derived)
    stages: list[Stage] = []
    interfaces: list[Interface] = []
    for row, before in reversed(list(zip(shader.chain, (None, *shader.chain), strict=False))):
        own = [result for result in shader.results if result.stage == row]
        leaving = tuple(v for f in interfaces if f.origin == row.domain for v in f.varyings)
        outputs = (*_outputs(own), *_crossing_outputs(shader.graph, leaving))
        if not outputs:
            continue
        roots = [output.value for output in outputs]
        if before is None:
            inputs = _attributes(shader, roots)
        else:
            varyings = pack_varyings(
                visible(roots, into_bodies=True), shader.notes, _taken(interfaces)
            )
            interfaces.insert(0, Interface(before.domain, row.domain, varyings))
            inputs = interfaces[0].fields
        stages.insert(0, _stage(row, shader, blocks, inputs, outputs))
    resources = tuple(
        info.resource
        for info in shader.resources
        if any(info.resource in stage.resources for stage in stages)
    )
    used = tuple(b for b in blocks if any(b in stage.blocks for stage in stages))
    return Program(shader.name, shader.doc, tuple(stages), used, resources, tuple(interfaces))


def _taken(interfaces: Iterable[Interface]) -> set[str]:
    return {field.name for interface in interfaces for field in interface.fields}


def _blocks(shader: Shader, derived: tuple[Derived, ...]) -> tuple[Block, ...]:
    parameters = [info.parameter for info in shader.parameters]
    docs = {info.parameter.name: info.doc for info in shader.parameters if info.doc}
    parameters += [value.parameter for value in derived]
    return layout_blocks(parameters, STANDARD_GROUPS, docs, shader.externs)


def _outputs(results: Iterable[Result]) -> Iterator[Output]:
    """The shader's results of one stage; those that a host names get a location each."""
    locations = count()
    for result in results:
        field = None
        if (target := result.target) is not None:
            field = Field(target.name, result.value.type, next(locations), doc=target.doc)
        yield Output(result.kind, result.value, field)


def _crossing_outputs(graph: Graph, varyings: Iterable[Varying]) -> Iterator[Output]:
    for varying in varyings:
        yield Output(VARYING, build.vector(graph, varying.values), varying.field)


def _attributes(shader: Shader, roots: Iterable[Node]) -> tuple[Field, ...]:
    """The vertex inputs that are read, each at the location its declaration gives it."""
    read = {node.data for node in visible(roots) if isinstance(node.data, Attribute)}
    return tuple(
        Field(
            info.attribute.name, info.attribute.type, location,
            doc=info.doc, step=info.attribute.step,
        )
        for location, info in enumerate(shader.attributes)
        if info.attribute in read
    )  # fmt: skip


def _stage(
    row: StageRow,
    shader: Shader,
    blocks: tuple[Block, ...],
    inputs: tuple[Field, ...],
    outputs: tuple[Output, ...],
) -> Stage:
    roots = [output.value for output in outputs]
    naming = Naming(shader.notes)
    nodes = visible(roots, into_bodies=True)
    functions = tuple(_function(call, shader.notes, naming) for call in called_functions(nodes))
    leaves = [leaf for node in nodes if (leaf := node.data) is not None]
    parameters = {leaf for leaf in leaves if isinstance(leaf, Parameter)}
    resources = {leaf for leaf in leaves if isinstance(leaf, Resource)}
    return Stage(
        row=row,
        inputs=inputs,
        blocks=tuple(b for b in blocks if any(m.parameter in parameters for m in b.members)),
        resources=tuple(i.resource for i in shader.resources if i.resource in resources),
        functions=functions,
        region=Scheduler(roots, shader.notes, naming).schedule(),
        results=outputs,
        builtin_inputs=tuple(
            sorted({INPUT.data(n).name for n in visible(roots) if n.op == "input"})
        ),
        reads=texture_reads(nodes),
        natives=native_uses(nodes),
    )


def _function(call: Node, notes: Notes, naming: Naming) -> Function:
    body = call.operands[0]
    types = [argument.type for argument in call.operands[1:]]
    return Function(
        name=notes.functions.get(body.id, "shade"),
        doc=notes.docs.get(body.id, ""),
        parameters=tuple(zip(formals_of(call), types, strict=True)),
        body=body,
        region=Scheduler((body,), notes, naming).schedule(),
        value=body,
    )
