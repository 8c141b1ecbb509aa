"""Runs every pass in order, from the shader that semantics made to a program.

``compiling.py`` calls ``stage`` once for each shader. The architecture page has a table of the
passes.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial

from ...support.frozen import changed, frozen
from ..ir.full_screen import full_screen, whole_texels, writes_images
from ..ir.leaves import Number, Parameter
from ..ir.node import Graph, Roots
from ..ir.operations import LOOPS
from ..ir.program import Program
from ..ir.ranges import Ranges
from ..ir.shader import Notes, Shader
from ..ir.stages import EXTENT, LENGTH
from .checkpoint import announce, verified, verified_results
from .expand_builtins import expand_builtins
from .fuse import fuse
from .guard import Decisions, Guard, Guarding
from .hoist import Derived, hoist
from .inline import inline
from .invariant_results import InvariantResults
from .lift_lambdas import lift_lambdas
from .lower_reads import lower_reads
from .move_to_corners import move_to_corners
from .move_to_vertices import move_to_vertices
from .open_binders import open_binders
from .path_conditions import PathConditions
from .remarks import Remark
from .rename_variables import rename_variables
from .replace_aggregates import replace_aggregates
from .simplify import Simplifier
from .split_stages import split_stages

MOST_INPUTS = 16
"""The number of vertex inputs that every profile has."""


@frozen
class Options:
    """Choices that change a program but not its meaning."""

    hoist: bool = True
    """True if the host computes the values that depend on parameters only."""
    without: frozenset[str] = frozenset()
    """Names of rules to do without, to see what they are good for.

    They are rules of range analysis (``rulebook.py``) and of simplification (``rules``).
    """


@frozen
class Evidence:
    """The evidence that ``proofs.py`` explains: decisions of passes, and the ranges behind them."""

    remarks: tuple[Remark, ...]
    ranges: Ranges
    notes: Notes
    """The notes when the last decision was made: later passes name values of their own."""
    before: Roots
    """The values of the shader before all simplification."""
    first_notes: Notes
    """The notes about those: later ones call values after what they have replaced."""


@frozen
class Undecided:
    """The facts by which each profile decides about calls that a program still has.

    ``legalise`` then splits the program's shader again, as ``split_stages`` did.
    """

    derived: tuple[Derived, ...]
    ranges: Ranges


@frozen
class Form:
    """The program of a shader in the form in which some profiles have it."""

    program: Program
    undecided: Undecided | None = None
    """The calls in the program that each profile decides about."""


@frozen
class Staged:
    """A program with further results of the passes."""

    program: Program
    derived: tuple[Derived, ...]
    guards: tuple[Guard, ...]
    evidence: Evidence
    undecided: Undecided | None = None
    """The calls in the program that each profile decides about."""
    full_screen: Form | None = None
    """For a kernel over images, the pass that draws these."""

    @property
    def own(self) -> Form:
        """The form with the stages that the shader was made for."""
        return Form(self.program, self.undecided)


@frozen
class Guarded:
    """The values of a shader once they are simplified and guarded, for whatever is made of it."""

    roots: Roots
    apart: InvariantResults
    ranges: Ranges
    decisions: Decisions
    evidence: Evidence


def guarded(shader: Shader, options: Options) -> Guarded:
    """The values of a shader's results, simplified and guarded: the passes that know no stages."""
    announce(shader)
    graph, notes = shader.graph, shader.notes
    results = verified_results(shader)
    roots = verified("semantics", "semantics", Roots([result.value for result in results]))
    roots = verified("open_binders", "opened", open_binders(graph, roots, notes))
    roots = verified("replace_aggregates", "flat", replace_aggregates(graph, roots, notes))
    before, first_notes = roots, notes.copy()
    # Passes keep values, so facts of a node, or of a variable, stay true throughout.
    ranges = Ranges(roots, options.without)
    simplifier = Simplifier(graph, ranges, notes)
    apart = InvariantResults.of(results, shader.placing)
    defaults = {p.leaf: p.default for p in shader.parameters if isinstance(p.default, int | float)}
    roots = _simplified(graph, roots, notes, simplifier, apart, defaults)
    roots, decisions = _guarded(graph, roots, notes, ranges, apart)
    evidence = Evidence(
        (*simplifier.remarks.values(), *decisions.remarks.values()),
        ranges,
        notes.copy(),
        before,
        first_notes,
    )
    return Guarded(roots, apart, ranges, decisions, evidence)


def stage(shader: Shader, options: Options) -> Staged:
    """The program of a shader: optimised, guarded, laid out, split into stages and scheduled."""
    shader = _without_lengths(shader)
    found = guarded(shader, options)
    graph, notes = shader.graph, shader.notes
    roots, apart, ranges, decisions = found.roots, found.apart, found.ranges, found.decisions
    roots = verified("move_to_vertices", "guarded", move_to_vertices(graph, roots, notes))
    derived: tuple[Derived, ...] = ()
    if options.hoist:
        declared = (info.leaf.name for info in shader.parameters)
        roots, derived = hoist(graph, roots, notes, ranges, declared, apart)
        verified("hoist", "guarded", roots)
    roots = apart.each(roots, lambda some, _: move_to_corners(graph, some, notes))
    verified("move_to_corners", "guarded", roots)
    roots = verified("lift_lambdas", "guarded", lift_lambdas(graph, roots, notes))
    roots = verified("lower_reads", "stored", lower_reads(graph, roots, notes.follow))
    roots = verified("rename_variables", "stored", rename_variables(graph, roots, notes.follow))
    results = tuple(changed(r, value=v) for r, v in zip(shader.results, roots, strict=True))
    made = partial(_form, derived=derived, ranges=ranges if decisions.undecided else None)
    shader = changed(shader, results=results)
    form = made(whole_texels(shader))
    if form.program.input_locations > MOST_INPUTS:
        from .corners_in_buffer import corners_in_buffer

        form = made(corners_in_buffer(shader))
    drawn = made(full_screen(shader)) if writes_images(shader) else None
    guards = tuple(decisions.kept.values())
    return Staged(form.program, derived, guards, found.evidence, form.undecided, drawn)


def _without_lengths(shader: Shader) -> Shader:
    """A kernel without the values that only the host has to know.

    They are the lengths of buffers of which invocations do not write an element each, and the sizes
    of images, since writes beyond the end of an image are dropped in all APIs.
    """
    dropped = {LENGTH, EXTENT} if writes_images(shader) else {LENGTH}
    results = tuple(result for result in shader.results if result.kind not in dropped)
    return changed(shader, results=results)


def _form(shader: Shader, derived: tuple[Derived, ...], ranges: Ranges | None) -> Form:
    """The form of a shader whose results have been through all other passes.

    ``ranges`` are given where it has calls that each profile decides about.
    """
    undecided = None if ranges is None else Undecided(derived, ranges)
    return Form(split_stages(shader, derived), undecided)


def _simplified(
    graph: Graph,
    roots: Roots,
    notes: Notes,
    simplifier: Simplifier,
    apart: InvariantResults,
    defaults: Mapping[Parameter, Number],
) -> Roots:
    """Simplifies, fuses sums over lights, inlines bodies, and lets weights skip loops."""
    roots = verified("simplify", "flat", simplifier.simplified(roots))
    fused = apart.each(roots, lambda some, _: fuse(graph, some, notes, simplifier))
    roots = verified("fuse", "flat", fused)
    inlined = apart.each(roots, lambda some, _: inline(graph, some, notes, simplifier))
    roots = verified("inline", "flat", inlined)
    if LOOPS.isdisjoint(roots.ops):
        return roots
    from .skip_loops import skip_loops

    def skipping(some: Roots, _: Roots) -> Roots:
        return skip_loops(graph, some, notes, simplifier.ranges, defaults)

    return verified("skip_loops", "flat", apart.each(roots, skipping))


def _guarded(
    graph: Graph, roots: Roots, notes: Notes, ranges: Ranges, apart: InvariantResults
) -> tuple[Roots, Decisions]:
    roots = verified("expand_builtins", "flat", expand_builtins(graph, roots, notes, ranges))
    decisions = Decisions()
    guardings: list[Guarding] = []

    def examined(some: Roots, using: Roots) -> Roots:
        guardings.append(Guarding(graph, ranges, notes, PathConditions(using, ranges)))
        return guardings[-1].simplified(some)

    roots = verified("guard", "guarded", apart.each(roots, examined))
    again = iter(guardings)

    def inlined(some: Roots, _: Roots) -> Roots:
        guarding = next(again)
        made = inline(graph, some, notes, guarding)
        decisions.add(guarding)
        return made

    return verified("inline", "guarded", apart.each(roots, inlined)), decisions
