"""Finds values that a program uses and a profile lacks: by their types, indices and sources.

``lacks.py`` asks, for profiles of languages that are older than most: those without integers of a
known width, without arrays that are values, or in which places of elements have to be constant.
"""

from __future__ import annotations

from collections.abc import Callable, Container, Iterator
from itertools import islice

from ...compiler.ir.program import Field, NativeUse, Program, Stage
from ...compiler.ir.stages import INSTANCES as PER_INSTANCE
from ...compiler.ir.types import Matrix, scalar_kind
from ..description.capabilities import (
    COMPUTED_PLACES,
    FLAT_VALUES,
    INSTANCES,
    INTEGER_ATTRIBUTES,
    MULTIVIEW,
    OF_INPUTS,
    RECTANGULAR_MATRICES,
    WIDE_INTEGERS,
)
from ..description.capability import Need
from ..description.profile import Profile
from .places import computed_places

Finder = Callable[[Program, Stage], Iterator[int]]
"""Finds the ids of nodes of a stage that need something."""


def features_of_values(program: Program, profile: Profile) -> Iterator[tuple[str, int]]:
    """Features of values that a program needs and the profile lacks, each with a node's id.

    Nothing is reported about stages that the profile has not got.
    """
    stages = [stage for stage in program.stages if stage.row in profile.stages]
    unmet = [(need, found) for need, found in _NEEDING if not need.is_met(profile)]
    for stage in stages if unmet else ():
        for need, needing in unmet:
            found = list(islice(needing(program, stage), 1))
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


def _reading(op: str, names: Callable[[Program], Container[str]]) -> Finder:
    """Finds the reads of inputs with some names."""

    def found(program: Program, stage: Stage) -> Iterator[int]:
        wanted = names(program)
        for node in stage.nodes:
            if node.op == op and getattr(node.data, "name", "") in wanted:
                yield node.id

    return found


def _named(name: str) -> Callable[[Program], Container[str]]:
    return lambda _program: {name}


def _inputs(asked: Callable[[Field], bool]) -> Callable[[Program], Container[str]]:
    return lambda program: {field.name for field in program.vertex_inputs if asked(field)}


def _of_wide_integers(_program: Program, stage: Stage) -> Iterator[int]:
    return (use.node.id for use in stage.natives if needs_wide_integers(use))


_STORED = frozenset({"parameter", "member", "index"})
"""Operations that read a matrix as it is stored, which all profiles can multiply by a vector."""


def _of_rectangular_matrices(_program: Program, stage: Stage) -> Iterator[int]:
    for node in stage.nodes:
        is_matrix = isinstance(node.type, Matrix) and not node.type.is_square
        if is_matrix and node.op not in _STORED:
            yield node.id


_NEEDING: tuple[tuple[Need, Finder], ...] = (
    *(
        (need, _reading("input", _named(name)))
        for name, need in OF_INPUTS.items()
        if need != MULTIVIEW  # The pass as a whole needs it.
    ),
    (INSTANCES, _reading("attribute", _inputs(lambda field: field.step == PER_INSTANCE))),
    (INTEGER_ATTRIBUTES, _reading("attribute", _inputs(lambda f: scalar_kind(f.type) != "float"))),
    (WIDE_INTEGERS, _of_wide_integers),
    (RECTANGULAR_MATRICES, _of_rectangular_matrices),
    (COMPUTED_PLACES, lambda _, stage: computed_places(stage)),
)
"""Needs that values may have, each with a function that finds those that do in a stage."""
