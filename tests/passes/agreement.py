"""Compares two graphs by value, up to the rounding that the value can bear.

Passes reassociate sums, so values may differ by rounding; if such a difference decides a comparison
or a ``floor``, they may differ by more. Tests measure this: they evaluate the original graph again
with a small error in every operation, and widen the tolerance by the spread of the results.
"""

from __future__ import annotations

import math

from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Graph, Node
from burnish.compiler.ir.operations import CALL
from burnish.compiler.ir.rewrite import rewrite
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.types import FLOAT, Matrix, Scalar, Vector, scalar_kind
from burnish.compiler.passes.pipeline import Options
from burnish.compiler.reference.evaluate import Evaluator
from burnish.stdlib.builtins import BUILTINS

from .hardware import flat, hardware
from .kit import World, evaluator_of, history

TOLERANCE = 1e-9
NOISE = 1e-13
AMPLIFIED = 1e3
"""The largest difference of a value, as a multiple of the spread of the results."""

EXACT = frozenset(
    {"neg", "abs", "min", "max", "clamp", "saturate", "sign", "floor", "ceil", "trunc", "round",
     "step", "to_float", "transpose"}
)  # fmt: skip
"""Operations that do not round."""

NOISES = tuple(NOISE * factor for factor in (1, -2, 3))
"""The noise of each repeat: a jump may be on either side of a value."""


def noisy(graph: Graph, roots: list[Node]) -> list[Node]:
    """The roots with an error in every operation that rounds, set by a parameter close to one."""

    def rule(graph: Graph, node: Node, operands: tuple[Node, ...]) -> Node | None:
        if node.op != "call" or scalar_kind(node.type) != "float" or node.data in EXACT:
            return None
        assert isinstance(node.type, Scalar | Vector | Matrix)
        leaf = Parameter(f"noise.{node.id}", FLOAT, "material")
        factor = graph.node("parameter", FLOAT, (), leaf)
        if node.data == "mod":  # It jumps where the quotient is whole, which its expansion rounds.
            first, second = operands
            operands = graph.node("call", first.type, (first, factor), "mul"), second
        result = graph.node(node.op, node.type, operands, node.data)
        noisy = graph.node("call", node.type, (result, factor), "mul")
        if not BUILTINS[CALL.data(node)].expansion or isinstance(node.type, Matrix):
            return noisy
        # An expansion may lose what is much smaller than the terms of its sums.
        lost = graph.node("call", FLOAT, (factor, build.floating(graph, 1.0)), "sub")
        if isinstance(node.type, Vector):
            lost = build.splat(graph, lost, node.type.size)
        return graph.node("call", node.type, (noisy, lost), "add")

    return list(rewrite(graph, roots, rule))


def lanes(roots: list[Node], world: World) -> list[float]:
    """The lanes of all roots."""
    return _lanes(evaluator_of(roots, world), roots)


def _lanes(evaluator: Evaluator, roots: list[Node]) -> list[float]:
    return [lane for root in roots for lane in flat(evaluator.value(root))]


def tolerances(shaken: list[Node], expected: list[float], world: World) -> list[float]:
    """The tolerance of each lane."""
    repeats = [lanes(shaken, World(world.seed, world.traps, noise=noise)) for noise in NOISES]
    found = []
    for value, *others in zip(expected, *repeats, strict=True):
        spread = max(abs(other - value) for other in others)
        found.append(TOLERANCE * abs(value) + AMPLIFIED * spread + 1e-30)
    return found


def disagreements(given: Shader, worlds: list[World], options: Options | None = None) -> list[str]:
    """The changes of a shader's values by passes, as texts; empty if no pass changes a value."""
    past = history(given, options)
    original = past.roots["semantics"]
    shaken = noisy(given.graph, original)
    found = []
    for world in worlds:
        expected = lanes(original, world)
        allowed = tolerances(shaken, expected, world)
        informed = World(world.seed, world.traps, past.staged.derived)
        # Passes keep most nodes of the one graph, so these are evaluated once for all passes.
        evaluator = evaluator_of(
            [root for roots in past.roots.values() for root in roots], informed
        )
        before: list[Node] = []
        for name, roots in past.roots.items():
            if roots == before:  # The pass had nothing to do.
                continue
            before = roots
            with hardware():
                values = _lanes(evaluator, roots)
            for i, value in enumerate(values):
                if math.isfinite(expected[i]) and not abs(value - expected[i]) <= allowed[i]:
                    found.append(
                        f"{name}, lane {i}, seed {world.seed}: {value} instead of {expected[i]}"
                    )
            if found:
                break
    return found
