"""Finds overridden definitions that are still live because ``inherited.name`` reads them.

That is seen from the declarations alone, so the layout of blocks does not depend on what a shader
happens to read.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...syntax import ast
from .records import Definition, Record

LEAVES = tuple(kind.node for kind in ast.KINDS if kind.contribution == "leaf")
"""Members whose values come from outside: from the host, or from the mesh."""

_InForce = set[tuple[str, int]]
"""Names with the levels of their definitions that count."""


def inherited_names(written: ast.Expression | ast.Member | ast.ReadMember) -> Iterator[str]:
    """Each ``name`` of which ``inherited.name`` stands somewhere in an expression or a member."""
    waiting: list[object] = [written]
    while waiting:
        part = waiting.pop()
        if isinstance(part, ast.Field) and _is_inherited(part.operand):
            yield part.name.text
        else:
            waiting.extend(ast.parts(part))


def _is_inherited(expression: ast.Expression) -> bool:
    return isinstance(expression, ast.Reference) and expression.name == "inherited"


def leaf_definitions(
    record: Record, given: Mapping[str, Definition]
) -> Iterator[tuple[str, Definition]]:
    """The parameters, textures and vertex inputs that instances of a record read, in order.

    ``given`` are definitions from outside, in front of the record's own. A name is one parameter
    however often the chain declares it, and the most derived declaration describes it.
    """
    in_force = _in_force(record, given)
    for name, definitions in record.definitions.items():
        for kind in LEAVES:
            declared = [each for each in definitions if isinstance(each.member, kind)]
            if any((name, each.level) in in_force for each in declared):
                yield name, declared[0]


def _in_force(record: Record, given: Mapping[str, Definition]) -> _InForce:
    """The nearest definition of each name, and those that these reach by ``inherited.name``."""
    nearest = {name: given.get(name, own[0]) for name, own in record.definitions.items()}
    found = {(name, definition.level) for name, definition in nearest.items()}
    if not _hides_leaves(record, nearest):
        return found
    waiting: list[tuple[ast.Member | ast.ReadMember, int]] = [
        (definition.member, definition.level) for definition in nearest.values()
    ]
    waiting += [(statement.member, statement.level) for statement in record.statements]
    while waiting:
        member, level = waiting.pop()
        for name in inherited_names(member):
            above = record.above(name, level)
            if above is not None and (name, above.level) not in found:
                found.add((name, above.level))
                waiting.append((above.member, above.level))
    return found


def _hides_leaves(record: Record, nearest: Mapping[str, Definition]) -> bool:
    """True if a leaf, which comes from outside, is overridden; in most records none is."""
    return any(
        isinstance(each.member, LEAVES) and each.level > nearest[name].level
        for name, definitions in record.definitions.items()
        for each in definitions
    )
