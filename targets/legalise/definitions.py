"""Functions of the text for the builtins that a profile does not have as Burnish means them.

``legalise`` asks for them first. A profile has no word for a builtin (``Profile.lacks``), or its
own operation has another meaning, or none, for operands of some types (``Profile.agrees``). Then
the builtin's ``definition``, which says the same in simpler operations, becomes a function, and
every use of the builtin on operands of these types is printed as a call of it.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping

from ...compiler.ir.node import Formal, Graph, Node
from ...compiler.ir.program import Function, Program, Stage
from ...compiler.ir.ranges import Ranges
from ...compiler.ir.shader import Notes
from ...compiler.ir.types import Type, scalar_kind
from ...compiler.passes.expansion_templates import definition
from ...compiler.passes.guard import Guarding
from ...compiler.passes.naming import Naming
from ...compiler.passes.path_conditions import PathConditions
from ...compiler.passes.schedule import Scheduler
from ...compiler.passes.walks import visible
from ...frozen import changed
from ...stdlib.builtins.facts import UNKNOWN
from ..emit.description import Profile

Use = tuple[str, tuple[Type, ...]]
"""A builtin, and the types of its operands."""

Definitions = Mapping[Use, Function]


def with_definitions(program: Program, profile: Profile) -> tuple[Program, Definitions]:
    """The program with the functions that the profile needs in each stage, and what each is for.

    A function stands behind those that it calls itself.
    """
    if not (profile.lacks or profile.agrees):
        return program, {}
    made: dict[Use, Function] = {}
    stages = tuple(_defined(stage, profile, made) for stage in program.stages)
    return changed(program, stages=stages), made


def _defined(stage: Stage, profile: Profile, made: dict[Use, Function]) -> Stage:
    roots = [statement.node for statement in stage.region.statements]
    roots += [*stage.roots, *(function.value for function in stage.functions)]
    needed: dict[Use, None] = {}
    pending = list(_lacking(roots, profile))
    while pending:
        use = pending.pop()
        needed.pop(use, None)
        needed[use] = None
        if use not in made:
            made[use] = _function(*use)
        pending += _lacking((made[use].value,), profile)
    functions = tuple(made[use] for use in reversed(needed))
    return changed(stage, functions=functions + stage.functions)


def _lacking(roots: Iterable[Node], profile: Profile) -> Iterable[Use]:
    """The uses under ``roots`` of builtins that the profile does not have as they are meant."""
    concerned = profile.lacks | profile.agrees.keys()
    for node in visible(roots):
        if node.op == "native" and node.data in concerned:
            use = str(node.data), tuple(operand.type for operand in node.operands)
            if not has(profile, use):
                yield use


def has(profile: Profile, use: Use) -> bool:
    """Whether the profile's own operation means what the builtin does, for operands of some types.

    Nothing is known of their values.
    """
    name, types = use
    domain = profile.agrees.get(name)
    known = (UNKNOWN.as_kind(scalar_kind(type_) or "matrix") for type_ in types)
    return name not in profile.lacks and (domain is None or domain(tuple(known)))


def _function(name: str, types: tuple[Type, ...]) -> Function:
    """A builtin's definition for operands of these types."""
    found = definition(name, types)
    graph, notes, ranges = Graph(), Notes(), Ranges(())
    formals = tuple(Formal(parameter) for parameter in found.parameters)
    leaves = tuple(
        graph.node("formal", type_, (), formal)
        for type_, formal in zip(types, formals, strict=True)
    )
    body = Guarding(graph, ranges, notes, PathConditions((), ranges)).written_out(found, leaves)
    region = Scheduler((body,), notes, Naming(notes)).schedule()
    parameters = tuple(zip(formals, types, strict=True))
    return Function(found.name, found.doc, parameters, body, region, body)
