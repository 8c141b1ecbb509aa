"""Graphs of shaders whose patches are divided: which values cross to which stages, and what the
verifier says of those that do not fit."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from burnish.compiler.ir import build
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.shader import RenderTarget, Result, Shader
from burnish.compiler.ir.stages import (
    CLIP_POSITION,
    CONTROL,
    CONTROL_POINT,
    EDGE_LEVEL,
    EVALUATION,
    FRAGMENT,
    INNER_LEVEL,
    OF_PATCH,
    PATCH_CORNER,
    PATCH_WEIGHTS,
    SMOOTH_TESSELLATED,
    TARGET,
    TESSELLATED_CHAIN,
    Crossing,
)
from burnish.compiler.ir.tessellation import PATCH_KINDS, Tessellation
from burnish.compiler.ir.types import FLOAT, INT, VEC3, VEC4
from burnish.compiler.ir.verify import InvalidGraphError, verify, verify_levels, verify_results
from burnish.support.frozen import changed

from .toy import HERE, Toy

TRIANGLES = Tessellation("triangle", 3, (0, 1, 2), "equal", HERE)


def at(toy: Toy, value: Node, number: int, crossing: Crossing) -> Node:
    """A value of the control points at one of them."""
    corner = build.constant(toy.graph, INT, number)
    return toy.graph.node("cross", value.type, (value, corner), crossing)


def divided() -> tuple[Toy, Shader]:
    """Triangles: an edge is the finer the longer it is, the inside like the first edge."""
    toy = Toy()
    point = toy.attribute("place", VEC3)
    ends = [at(toy, point, number, PATCH_CORNER) for number in range(3)]
    edges = [
        toy.call("length", FLOAT, toy.call("sub", VEC3, ends[a], ends[b]))
        for a, b in filter(None, PATCH_KINDS["triangle"].edges)
    ]
    weights = toy.graph.node("input", VEC3, (), PATCH_WEIGHTS)
    shares = [
        toy.call(
            "mul", VEC3, at(toy, point, k, CONTROL_POINT), build.swizzle(toy.graph, weights, (k,))
        )
        for k in range(3)
    ]
    mixed = toy.call("add", VEC3, toy.call("add", VEC3, *shares[:2]), shares[2])
    fine = build.cross(toy.graph, edges[0], OF_PATCH)
    clip = build.vector(toy.graph, (mixed, fine))
    seen = build.cross(toy.graph, clip, SMOOTH_TESSELLATED)
    results = (
        *(Result(EDGE_LEVEL, CONTROL, edge) for edge in edges),
        Result(INNER_LEVEL, CONTROL, edges[0]),
        Result(CLIP_POSITION, EVALUATION, clip),
        Result(TARGET, FRAGMENT, seen, "color", state=RenderTarget("rgba8")),
    )
    return toy, toy.shader(results, *TESSELLATED_CHAIN, tessellation=TRIANGLES)


def verified(shader: Shader) -> None:
    verify(shader.roots, stage="semantics")
    verify_results(shader.results, shader.chain)
    verify_levels(shader)


def test_control_points_reach_both_stages_behind_the_vertices() -> None:
    verified(divided()[1])


def with_level(level: Callable[[Toy], Node]) -> Callable[[Toy, Shader], Shader]:
    """Makes another value of the first edge's level."""
    return lambda toy, shader: changed(
        shader, results=(Result(EDGE_LEVEL, CONTROL, level(toy)), *shader.results[1:])
    )


def first(toy: Toy, value: Node) -> Node:
    return build.swizzle(toy.graph, value, (0,))


def place(toy: Toy) -> Node:
    return toy.attribute("place", VEC3)


def of_fragments(toy: Toy, shader: Shader) -> Shader:
    """The fragments are given what only the control points have."""
    seen = build.cross(toy.graph, toy.attribute("c", VEC4), SMOOTH_TESSELLATED)
    return changed(shader, results=(*shader.results[:-1], Result(TARGET, FRAGMENT, seen, "color")))


MISFITS: dict[str, tuple[Callable[[Toy, Shader], Shader], str]] = {
    "a level of the control points": (
        with_level(lambda toy: first(toy, place(toy))),
        "no value per patch",
    ),
    "a level of the vertices made": (
        with_level(lambda toy: first(toy, toy.graph.node("input", VEC3, (), PATCH_WEIGHTS))),
        "no value per patch",
    ),
    "a level that is no float": (
        with_level(lambda toy: at(toy, place(toy), 0, PATCH_CORNER)),
        "not 3 floats as edge_level",
    ),
    "an edge without a level": (
        lambda _toy, shader: changed(shader, results=shader.results[1:]),
        "not 3 floats as edge_level",
    ),
    "no patches": (
        lambda _toy, shader: changed(shader, tessellation=None),
        "a control stage without patches",
    ),
    "a control point that is not there": (
        with_level(lambda toy: first(toy, at(toy, place(toy), 3, PATCH_CORNER))),
        "a control point that the patch does not have",
    ),
    "a control point's value among the fragments": (
        of_fragments,
        "crosses from another domain than tessellated",
    ),
}


@pytest.mark.parametrize(("spoil", "problem"), MISFITS.values(), ids=MISFITS)
def test_what_does_not_fit_is_found(spoil: Callable[[Toy, Shader], Shader], problem: str) -> None:
    toy, shader = divided()
    with pytest.raises(InvalidGraphError, match=problem):
        verified(spoil(toy, shader))
