"""The positions that several passes over one material compute, to be compared.

``test_invariant_results.py`` asks about all examples, and ``tests/fuzz`` about random programs.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Binder, Formal, Node, formals_of
from burnish.compiler.ir.stages import CLIP_POSITION
from burnish.support.frozen import changed

PASSES = """
pass Early {
    raster { invariant = true }
    clip_position = position in clip
    target nothing : r8 = 0
}
pass Late : Forward { raster { invariant = true } }
pass Surfaces {
    raster { invariant = true }
    clip_position = position in clip
    target a : rgba16f = vec4(normal, distance(position, eye))
    target b : rgba16f = vec4(position, 1) * 0.5
}
"""
Operations = tuple[object, ...]


class Known:
    """Numbers for computations, which are equal where these are the same, whatever they are
    called."""

    def __init__(self) -> None:
        self._numbers: dict[Operations, int] = {}

    def differ(self, one: CompiledMaterial, other: CompiledMaterial, profile: str) -> bool:
        """True if two passes compute a position by different operations."""
        if profile in one.lacking or profile in other.lacking:
            return False
        if {each.staged.program.shader.corner_buffer is None for each in (one, other)} == {
            True,
            False,
        }:
            return False
        return self.position(one, profile) != self.position(other, profile)

    def position(self, material: CompiledMaterial, profile: str) -> list[int]:
        """The numbers of the computations by which a text computes a position."""
        shader = material.emitted(profile)
        derived = {value.parameter: value.expression for value in material.staged.derived}
        return [self._number(r.value, derived) for r in shader.results_of(CLIP_POSITION)]

    def _number(self, root: Node, derived: dict[Parameter, Node]) -> int:
        found: dict[Node, int] = {}
        formals: dict[Formal, int] = {}
        for node in in_order_of_need(root):
            data: object = node.data
            bound = tuple(formals.setdefault(each, len(formals)) for each in formals_of(node))
            if isinstance(data, Parameter) and data in derived:
                data = self._number(derived[data], derived)  # The host computes it.
            elif isinstance(data, Formal):
                data = formals.setdefault(data, len(formals))
            elif isinstance(data, Binder):
                data = changed(data, formals=None)
            operands = tuple(found[operand] for operand in node.operands)
            key = node.op, str(node.type), repr(data), bound, operands
            found[node] = self._numbers.setdefault(key, len(self._numbers))
        return found[root]


def in_order_of_need(root: Node) -> Iterator[Node]:
    """Operands before users, in an order that hangs on nothing but them."""
    seen: set[Node] = set()
    pending = [root]
    while pending:
        node = pending.pop()
        missing = [operand for operand in node.operands if operand not in seen]
        if missing:
            pending += [node, *missing[::-1]]
        elif node not in seen:
            seen.add(node)
            yield node


def differing(
    text: str,
    profiles: Sequence[str],
    rig: str | None = None,
    search_path: Sequence[Path] = (),
    passes: Sequence[str] = ("Early", "Late", "Surfaces"),
) -> list[str]:
    """The materials of a text of which two of the ``PASSES`` compute a position otherwise, with
    the profiles. Left out is what has more vertex inputs in one of them than there are."""
    known = Known()
    early, *others = (
        burnish.compile(
            text + PASSES, profiles, rig=rig, pass_=pass_, search_path=search_path, partial=True
        )
        for pass_ in passes
    )
    return [
        f"{one.name}, {profile}"
        for one in early
        for made in others
        for profile in profiles
        if known.differ(one, made[one.name], profile)
    ]
