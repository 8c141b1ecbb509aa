"""Finds values that a program uses and a profile lacks: by their types, indices and sources.

``lacks.py`` asks, for profiles of languages that are older than most: those without integers of a
known width, without arrays that are values, or in which places of elements have to be constant.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from itertools import islice

from ...compiler.ir.node import Node
from ...compiler.ir.program import Field, NativeUse, Program
from ...compiler.ir.stages import INSTANCES as PER_INSTANCE
from ...compiler.ir.types import scalar_kind
from ..description.capabilities import (
    COMPUTED_PLACES,
    FLAT_VALUES,
    INSTANCES,
    INTEGER_ATTRIBUTES,
    OF_INPUTS,
    WIDE_INTEGERS,
)
from ..description.profile import Profile
from .places import computed_places


def features_of_values(program: Program, profile: Profile) -> Iterator[tuple[str, int]]:
    """Features of values that a program needs and the profile lacks, each with a node's id.

    Nothing is reported about stages that the profile has not got.
    """
    stages = [stage for stage in program.stages if stage.row in profile.stages]
    for stage in stages:
        for need, needing in (
            *((need, _reading(stage.nodes, "input", {name})) for name, need in OF_INPUTS.items()),
            (INSTANCES, _reading(stage.nodes, "attribute", _inputs(program, _is_of_instances))),
            (INTEGER_ATTRIBUTES, _reading(stage.nodes, "attribute", _inputs(program, _is_whole))),
            (WIDE_INTEGERS, (use.node.id for use in stage.natives if needs_wide_integers(use))),
            (COMPUTED_PLACES, computed_places(stage)),
        ):
            found = [] if need.is_met(profile) else list(islice(needing, 1))
            yield from ((need.feature, node) for node in found)
            if found and need in OF_INPUTS.values():
                break  # Values computed from it would be found, too.
    if stages and not FLAT_VALUES.is_met(profile):
        flat = (each.values[0].id for each in program.varyings if each.field.mode == "flat")
        yield from ((FLAT_VALUES.feature, node) for node in islice(flat, 1))


def needs_wide_integers(use: NativeUse) -> bool:
    """True if an operation needs integers of 32 bits, or unsigned ones.

    A bool is stored as 0 or 1, and compared with 0 to read it.
    """
    kinds = {scalar_kind(type_) for type_ in use.types}
    return use.builtin in WIDE_INTEGERS.builtins or ("uint" in kinds and use.builtin != "ne")


def _inputs(program: Program, asked: Callable[[Field], bool]) -> set[str]:
    return {field.name for field in program.vertex_inputs if asked(field)}


def _is_of_instances(field: Field) -> bool:
    return field.step == PER_INSTANCE


def _is_whole(field: Field) -> bool:
    return scalar_kind(field.type) != "float"


def _reading(nodes: Iterable[Node], op: str, names: set[str]) -> Iterator[int]:
    """The reads of inputs with some of these names."""
    return (n.id for n in nodes if n.op == op and getattr(n.data, "name", "") in names)
