"""Decides which guards a profile needs: some languages define operations that others leave open.

The passes leave a call where an operation is defined in some languages and left open in others: an
integer over zero, a shift by more than there are bits. ``legalise`` asks here what the profile
promises (``Profile.agrees``). The call becomes the language's own operation, or the builtin's
expansion. The program is then made anew, since an expansion consists of values that have to be
placed and named like all others.
"""

from __future__ import annotations

from collections.abc import Mapping

from ...compiler.ir.node import Graph, Node, Roots
from ...compiler.ir.program import Program
from ...compiler.ir.ranges import Ranges
from ...compiler.ir.rewrite import rewrite
from ...compiler.ir.shader import Notes
from ...compiler.passes.checkpoint import verified
from ...compiler.passes.guard import Guard, Guarding
from ...compiler.passes.inline import inline
from ...compiler.passes.invariant_results import InvariantResults
from ...compiler.passes.path_conditions import PathConditions
from ...compiler.passes.pipeline import Undecided
from ...compiler.passes.rename_variables import rename_variables
from ...compiler.passes.split_functions import split_functions
from ...compiler.passes.split_stages import split_stages
from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.row import Domain
from ...support.frozen import changed
from ..description.profile import Profile


def with_guards(program: Program, undecided: Undecided, profile: Profile) -> Program:
    """The program with the guards that the profile needs."""
    shader = program.shader
    # Each profile adds nodes of its own, whose ids do not depend on other profiles.
    graph, notes = shader.graph.copy(), shader.notes.copy()
    deciding = _Deciding(graph, notes, undecided.ranges, profile.agrees)
    roots = rewrite(graph, shader.roots, deciding.decided, notes.follow, ("call",))
    apart = InvariantResults.of(shader.results, shader.placing)
    roots = apart.each(roots, lambda some, _: inline(graph, some, notes, deciding))
    # Calls that only these guards make expensive are inlined here, with the loops in them.
    roots = rename_variables(graph, roots, notes.follow)
    roots = verified("legalise", "stored", roots)
    made = zip(shader.results, roots, strict=True)
    results = tuple(changed(result, value=value) for result, value in made)
    guarded = changed(shader, graph=graph, notes=notes, results=results)
    return (
        split_functions(guarded)
        if guarded.has_functions
        else split_stages(guarded, undecided.derived)
    )


def keeps(profile: Profile, guard: Guard) -> bool:
    """True if a guard stays in the texts for a profile."""
    domain = profile.agrees.get(guard.builtin, BUILTINS[guard.builtin].domain)
    return not (guard.by_profile and domain(guard.facts))


class _Deciding(Guarding):
    """Replaces calls, by the facts about their operands when the guards were examined."""

    def __init__(
        self, graph: Graph, notes: Notes, known: Ranges, domains: Mapping[str, Domain]
    ) -> None:
        ranges = Ranges(())
        super().__init__(graph, ranges, notes, PathConditions(Roots(), ranges), domains)
        self._known = known

    def decided(self, _graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node:
        """Decide about one call; ``rewrite`` calls this for each call of the program."""
        self.at = self.notes.spans.get(node.id, self.at)
        for operand, given in zip(operands, node.operands, strict=True):
            self.ranges.assume(operand, self._known.of(given))
        return self.make("call", node.type, operands, node.data)
