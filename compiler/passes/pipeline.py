"""The middle end: every pass, in order."""

from __future__ import annotations

from collections.abc import Iterable

from ...frozen import frozen
from ..ir import build
from ..ir.leaves import Attribute, Parameter, Resource
from ..ir.node import Graph, Node
from ..ir.program import Block, Field, Function, Program, Stage, StageName, Varying, texture_reads
from ..ir.ranges import Ranges
from ..ir.rewrite import rewrite
from ..ir.shader import Notes, Shader
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
class Staged:
    """A program with what else is to be told about it."""

    program: Program
    derived: tuple[Derived, ...]
    guards: tuple[Guard, ...]
    evidence: Evidence


@frozen
class _Results:
    """The values a shader has to deliver, in the form of the moment."""

    position: Node
    targets: tuple[Node, ...]
    discard: Node | None

    def flat(self) -> list[Node]:
        """All of them, as roots for a pass."""
        discard = () if self.discard is None else (self.discard,)
        return [self.position, *self.targets, *discard]

    def of(self, roots: list[Node]) -> _Results:
        """The same values after a pass."""
        count = len(self.targets)
        discard = roots[1 + count] if self.discard is not None else None
        return _Results(roots[0], tuple(roots[1 : 1 + count]), discard)


def stage(shader: Shader, options: Options) -> Staged:
    """The program of a shader: optimised, guarded, laid out, split into stages and scheduled."""
    graph, notes = shader.graph, shader.notes
    results = _Results(
        shader.clip_position, tuple(target.value for target in shader.targets), shader.discard
    )
    roots = passed("semantics", "semantics", results.flat())
    roots = passed("open_binders", "opened", open_binders(graph, roots, notes))
    roots = passed("replace_aggregates", "opened", replace_aggregates(graph, roots, notes))
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
    program = _program(shader, results.of(roots), derived)
    guards = tuple(guarding.kept.values())
    return Staged(program, derived, guards, evidence)


def _simplified(
    graph: Graph, roots: list[Node], notes: Notes, simplifier: Simplifier
) -> list[Node]:
    """Simplify, fuse sums over lights, and write out what is used once."""
    roots = passed("simplify", "opened", rewrite(graph, roots, simplifier.rule, notes.follow))
    roots = passed("fuse", "opened", fuse(graph, roots, notes, simplifier))
    return passed("inline", "opened", inline(graph, roots, notes, simplifier))


def _guarded(
    graph: Graph, roots: list[Node], notes: Notes, ranges: Ranges
) -> tuple[list[Node], Guarding]:
    roots = passed("expand_builtins", "opened", expand_builtins(graph, roots, notes, ranges))
    guarding = Guarding(graph, ranges, notes, PathConditions(roots, ranges))
    roots = passed("guard", "guarded", rewrite(graph, roots, guarding.rule, notes.follow))
    roots = passed("inline", "guarded", inline(graph, roots, notes, guarding))
    return roots, guarding


# --- the program ---------------------------------------------------------------------------------


def _program(shader: Shader, results: _Results, derived: tuple[Derived, ...]) -> Program:
    fragment_roots = results.flat()[1:]
    varyings = pack_varyings(visible(fragment_roots, into_bodies=True), shader.notes)
    outputs = tuple(varying.field for varying in varyings)
    blocks = _blocks(shader, derived)
    vertex = _stage(
        "vertex", shader, blocks, _attributes(shader, results, varyings), outputs,
        [results.position, *_joined(shader.graph, varyings)], None,
    )  # fmt: skip
    targets = tuple(
        Field(target.name, value.type, i, doc=target.doc)
        for i, (target, value) in enumerate(zip(shader.targets, results.targets, strict=True))
    )
    fragment = _stage(
        "fragment", shader, blocks, outputs, targets, list(results.targets), results.discard
    )
    resources = tuple(
        info.resource
        for info in shader.resources
        if info.resource in vertex.resources or info.resource in fragment.resources
    )
    used = tuple(b for b in blocks if b in vertex.blocks or b in fragment.blocks)
    return Program(shader.name, shader.doc, vertex, fragment, used, resources, varyings)


def _blocks(shader: Shader, derived: tuple[Derived, ...]) -> tuple[Block, ...]:
    parameters = [info.parameter for info in shader.parameters]
    docs = {info.parameter.name: info.doc for info in shader.parameters if info.doc}
    parameters += [value.parameter for value in derived]
    return layout_blocks(parameters, STANDARD_GROUPS, docs, shader.externs)


def _joined(graph: Graph, varyings: Iterable[Varying]) -> list[Node]:
    return [build.vector(graph, varying.values) for varying in varyings]


def _attributes(
    shader: Shader, results: _Results, varyings: tuple[Varying, ...]
) -> tuple[Field, ...]:
    """The vertex inputs that are read, each at the location its declaration gives it."""
    roots = [results.position, *(value for varying in varyings for value in varying.values)]
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
    name: StageName,
    shader: Shader,
    blocks: tuple[Block, ...],
    inputs: tuple[Field, ...],
    outputs: tuple[Field, ...],
    values: list[Node],
    discard: Node | None,
) -> Stage:
    roots = values if discard is None else [*values, discard]
    naming = Naming(shader.notes)
    nodes = visible(roots, into_bodies=True)
    functions = tuple(_function(call, shader.notes, naming) for call in called_functions(nodes))
    leaves = [leaf for node in nodes if (leaf := node.data) is not None]
    parameters = {leaf for leaf in leaves if isinstance(leaf, Parameter)}
    resources = {leaf for leaf in leaves if isinstance(leaf, Resource)}
    return Stage(
        name=name,
        inputs=inputs,
        outputs=outputs,
        blocks=tuple(b for b in blocks if any(m.parameter in parameters for m in b.members)),
        resources=tuple(i.resource for i in shader.resources if i.resource in resources),
        functions=functions,
        region=Scheduler(roots, shader.notes, naming).schedule(),
        position=values[0] if name == "vertex" else None,
        results=tuple(values[1:] if name == "vertex" else values),
        discard=discard,
        builtin_inputs=tuple(sorted({str(n.data) for n in visible(roots) if n.op == "input"})),
        reads=texture_reads(nodes),
    )


def _function(call: Node, notes: Notes, naming: Naming) -> Function:
    body = call.operands[0]
    assert isinstance(call.data, tuple)
    types = [argument.type for argument in call.operands[1:]]
    return Function(
        name=notes.functions.get(body.id, "shade"),
        doc=notes.docs.get(body.id, ""),
        parameters=tuple(zip(call.data, types, strict=True)),
        body=body,
        region=Scheduler((body,), notes, naming).schedule(),
        value=body,
    )
