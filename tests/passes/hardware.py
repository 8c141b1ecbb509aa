"""Simulates the worst hardware: a native operation outside of its domain gives garbage.

The evaluator gives native operations the builtins' meaning everywhere. This would hide that a guard
was removed that is needed.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import AbstractContextManager
from functools import partial
from typing import Any
from unittest.mock import patch

from burnish.compiler.ir.node import Node
from burnish.compiler.ir.operations import NATIVE
from burnish.compiler.ir.types import Matrix, Scalar, Type, Vector, scalar_kind
from burnish.compiler.reference import operations
from burnish.compiler.reference.namespace import Lanes, Namespace
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import SMALLEST_NORMAL, UNIT_SLACK, Fact
from burnish.stdlib.builtins.row import Domain
from burnish.support.frozen import EMPTY

GARBAGE = 0x5EED
"""The result of an integer operation outside of its domain; that of a float operation is NaN."""


def hardware(domains: Mapping[str, Domain] = EMPTY) -> AbstractContextManager[Any]:
    """A context in which graphs are evaluated as such hardware would.

    ``domains`` are those of natives for which the hardware promises something else than the row.
    """
    return patch.dict(operations._STEPS, {"native": partial(_native, domains)})


def flat(value: Any) -> Iterator[float]:
    """All lanes of a value."""
    if isinstance(value, tuple):
        for part in value:
            yield from flat(part)
    else:
        yield float(value)


def _native(
    domains: Mapping[str, Domain], node: Node, operands: list[Lanes], xp: Namespace
) -> Lanes:
    known = [fact(o.type, value) for o, value in zip(node.operands, operands, strict=True)]
    facts = tuple(fact for fact in known if fact is not None)
    name = NATIVE.data(node)
    domain = domains.get(name, BUILTINS[name].domain)
    if len(facts) < len(known) or domain(facts):
        return operations._call(node, operands, xp)
    lanes = node.type.size if isinstance(node.type, Vector) else 1
    return (math.nan if scalar_kind(node.type) == "float" else GARBAGE,) * lanes


def fact(type_: Type, value: Lanes) -> Fact | None:
    """The most precise fact about a value; ``None`` for types that rows ignore, and for garbage."""
    if not isinstance(type_, Scalar | Vector | Matrix):
        return None
    lanes = list(flat(value))
    if not all(map(math.isfinite, lanes)):
        return None
    kind = "matrix" if isinstance(type_, Matrix) else scalar_kind(type_) or "float"
    nonzero = all(abs(lane) >= SMALLEST_NORMAL for lane in lanes)
    unit = isinstance(type_, Vector) and abs(math.hypot(*lanes) - 1.0) <= UNIT_SLACK
    length = math.hypot(*lanes) if isinstance(type_, Vector) else 0.0
    return Fact(min(lanes), max(lanes), nonzero, unit, length, kind)
