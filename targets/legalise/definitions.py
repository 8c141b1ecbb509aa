"""Adds functions to a program for the builtins that a profile does not have as Burnish means them.

``legalise`` asks for them first. A profile has no word for a builtin (``Profile.lacks``), its own
operation has another meaning, or none, for operands of some types (``Profile.agrees``), or a driver
gets it wrong (``Profile.mistakes``). Then the builtin's ``definition``, which says the same in
simpler operations, becomes a function, and every use of the builtin on operands of these types is
printed as a call of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from ...compiler.expansion_templates import definition
from ...compiler.ir.node import Formal, Graph, Node, Roots, reachable
from ...compiler.ir.program import Function, NativeUse, Program, Stage, native_uses
from ...compiler.ir.ranges import Ranges
from ...compiler.ir.shader import Notes
from ...compiler.ir.types import Type, scalar_kind
from ...compiler.passes.guard import Guarding
from ...compiler.passes.naming import Naming
from ...compiler.passes.path_conditions import PathConditions
from ...compiler.passes.schedule import Scheduler
from ...compiler.passes.uniformity import needing_uniform_flow
from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.facts import UNKNOWN
from ...support.frozen import changed
from ..description.profile import Profile

Use = tuple[str, tuple[Type, ...]]
"""A builtin, and the types of its operands."""

Definitions = Mapping[Use, Function]


def with_definitions(program: Program, profile: Profile) -> tuple[Program, Definitions]:
    """The program with the functions that the profile needs in each stage, and their uses.

    Each function follows those that it calls.
    """
    made: dict[Use, Function] = {}
    stages = tuple(_defined(stage, profile, made) for stage in program.stages)
    return (changed(program, stages=stages), made) if made else (program, {})


def _defined(stage: Stage, profile: Profile, made: dict[Use, Function]) -> Stage:
    """The stage with the functions that the profile needs, followed by its own."""
    own = {_use(native): native.node for native in _lacking(stage.natives, profile)}
    pending = list(own.items())
    if not pending:
        return stage
    needed: dict[Use, Node] = {}
    while pending:
        use, stands_for = pending.pop()
        needed.pop(use, None)
        needed[use] = own.get(use, stands_for)
        if use not in made:
            made[use] = _function(use, profile)
        inner = native_uses(made[use].nodes)
        pending += [(_use(each), stands_for) for each in _lacking(inner, profile)]
    functions = tuple(
        changed(made[use], stands_for=stands_for) for use, stands_for in reversed(needed.items())
    )
    return changed(stage, functions=functions + stage.functions)


def _use(native: NativeUse) -> Use:
    return native.builtin, native.types


def _lacking(natives: Iterable[NativeUse], profile: Profile) -> Iterator[NativeUse]:
    """The uses of builtins whose meaning the profile lacks."""
    for native in natives:
        name = native.builtin
        known = name in profile.lacks or name in profile.agrees or name in profile.mistakes
        if known and not has_meaning(profile, _use(native)):
            yield native


def has_meaning(profile: Profile, use: Use) -> bool:
    """True if the profile's own operation means what the builtin does, for operands of these types.

    Types decide about builtins that have a definition. Those whose meaning depends on values have
    been proven, or have a guard, where they are used.
    """
    name, types = use
    domain = profile.agrees.get(name) if BUILTINS[name].definition else None
    known = (UNKNOWN.as_kind(scalar_kind(type_) or "matrix") for type_ in types)
    mistaken = profile.mistakes.get(name)
    if name in profile.lacks or (mistaken is not None and mistaken(types)):
        return False
    return domain is None or domain(tuple(known))


def _function(use: Use, profile: Profile) -> Function:
    """A builtin's definition, with the guards that it needs in the profile itself."""
    name, types = use
    found = definition(name, types)
    graph, notes, ranges = Graph(), Notes(), Ranges(())
    guarding = Guarding(graph, ranges, notes, PathConditions(Roots(), ranges), profile.agrees)
    formals = tuple(Formal(parameter) for parameter in found.parameters)
    leaves = tuple(
        graph.node("formal", type_, (), formal)
        for type_, formal in zip(types, formals, strict=True)
    )
    body = guarding.written_out(found, leaves)
    together = needing_uniform_flow(reachable((body,)))
    region = Scheduler((body,), notes, Naming(notes), together).schedule()
    parameters = tuple(zip(formals, types, strict=True))
    return Function(found.name, found.doc, parameters, body, region, body)
