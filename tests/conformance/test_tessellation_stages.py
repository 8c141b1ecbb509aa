"""Patches that the stages of tessellation divide are drawn as the reference divides them.

The shaders are made by hand. Where all numbers on the way are small multiples of a power of two,
nothing is rounded, and a picture of patches is the same to the last bit as one of the triangles
into which the reference divides them: so both have the same vertices and triangles, these turn the
same way, and begin with the same vertex.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from functools import cache
from itertools import pairwise, product

import numpy as np
import pytest

from burnish.api.compiled import CompiledMaterial
from burnish.compiler.ir import build
from burnish.compiler.ir.node import Node
from burnish.compiler.ir.shader import RenderTarget, Result, Shader
from burnish.compiler.ir.stages import (
    CLIP_POSITION,
    CONTROL,
    CONTROL_POINT,
    EDGE_LEVEL,
    EVALUATION,
    FLAT,
    FLAT_TESSELLATED,
    FRAGMENT,
    INNER_LEVEL,
    OF_PATCH,
    PATCH_CORNER,
    PATCH_INDEX,
    SMOOTH,
    SMOOTH_TESSELLATED,
    TARGET,
    TESSELLATED_CHAIN,
    VERTEX,
    Crossing,
    inputs_of,
)
from burnish.compiler.ir.tessellation import PATCH_KINDS, Patch, Spacing, Tessellation
from burnish.compiler.ir.types import BOOL, FLOAT, INT, VEC3, VEC4
from burnish.compiler.reference import tessellation as reference
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.drivers.pipeline import Pipeline, Primitive
from burnish.targets.runner.exact import Exact
from burnish.targets.runner.frames.states import draw_states
from burnish.targets.runner.meshes import Indices
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.scene_state import SceneState

from ..passes.toy import HERE, Toy
from ..targets.hand_made import compiled_shader
from .kit import Floats, Studio

ON = ("lavapipe:glsl", "lavapipe:hlsl-glslang", "lavapipe:hlsl-dxc", "llvmpipe:gl450")
"""The routes with stages for tessellation."""
PROFILES = tuple(sorted({ROUTES[name].profile for name in ON}))
SPACINGS: tuple[Spacing, ...] = ("equal", "fractional_even", "fractional_odd")
SIZE = (96, 80)
CLEAR = (9.0, 9.0, 9.0, 9.0)

LEVELS: Mapping[Patch, tuple[tuple[tuple[float, ...], tuple[float, ...]], ...]] = {
    "triangle": (((1, 1, 1), (1,)), ((4, 2, 3), (5,)), ((2.5, 7, 1), (3.25,))),
    "quad": (((1, 1, 1, 1), (1, 1)), ((4, 2, 3, 5), (6, 3)), ((2.5, 1, 7, 4), (1, 4.75))),
    "isoline": (((3, 1), ()), ((5, 4.5), ())),
}
"""Levels of the edges and of the inside, for each kind of patch."""

CORNERS: Mapping[Patch, list[list[float]]] = {
    "triangle": [[-0.875, -0.75, 0.25], [0.75, -0.5, 0.75], [-0.25, 0.875, 0.5]],
    "quad": [[-0.75, -0.5, 0.25], [0.5, -0.75, 0.5], [0.75, 0.5, 0.75], [-0.5, 0.75, 0.5]],
    "isoline": [[-0.75, -0.75, 0.25], [0.75, -0.5, 0.75]],
}
"""The second patch is the same at half the size, and nearer, turned over."""
ACROSS = (0.125, 1.25, -0.25)
"""From a line to the next one, all lines together."""


def divided(patches: Tessellation) -> Shader:
    """Patches whose levels are parameters, times 1 by a number of the first control point."""
    toy, kind = Toy(), patches.kind
    graph = toy.graph
    place, once = toy.attribute("place", VEC3), toy.attribute("once", FLOAT)

    def at(value: Node, number: int, crossing: Crossing) -> Node:
        corner = build.constant(graph, INT, number)
        return graph.node("cross", value.type, (value, corner), crossing)

    def level(name: str) -> Node:
        own = at(once, 0, PATCH_CORNER)
        return toy.call("mul", FLOAT, toy.parameter(name, FLOAT), own)

    edges = [level(f"edge_{number}") for number in range(len(kind.edges))]
    inner = [level(f"inner_{number}") for number in range(len(kind.inner))]
    where = toy.named("where", graph.node("input", kind.coordinate.type, (), kind.coordinate))
    ends = [at(place, number, CONTROL_POINT) for number in patches.ends]
    x, y = (build.swizzle(graph, where, (lane,)) for lane in (0, 1))
    parts = [ends[0]]
    if patches.patch == "triangle":
        z = build.swizzle(graph, where, (2,))
        parts = [
            toy.call("mul", VEC3, end, weight) for end, weight in zip(ends, (x, y, z), strict=True)
        ]
    else:
        across = build.constant(graph, VEC3, ACROSS)
        if patches.patch == "quad":
            across = toy.call("sub", VEC3, ends[3], ends[0])
        along = toy.call("sub", VEC3, ends[1], ends[0])
        parts += [toy.call("mul", VEC3, along, x), toy.call("mul", VEC3, across, y)]
    placed = parts[0]
    for part in parts[1:]:
        placed = toy.call("add", VEC3, placed, part)
    clip = build.vector(graph, (toy.named("placed", placed), build.floating(graph, 1.0)))
    index = build.cross(graph, graph.node("input", PATCH_INDEX.type, (), PATCH_INDEX), OF_PATCH)
    number = toy.call("to_float", FLOAT, index)
    of_patch = build.cross(graph, toy.named("first_level", edges[0]), OF_PATCH)
    first = toy.named("first", build.vector(graph, (x, y, number, of_patch)))
    results = [
        *(Result(EDGE_LEVEL, CONTROL, edge) for edge in edges),
        *(Result(INNER_LEVEL, CONTROL, each) for each in inner),
        Result(CLIP_POSITION, EVALUATION, clip),
        *seen(toy, build.cross(graph, toy.named("place", placed), SMOOTH_TESSELLATED),
              build.cross(graph, first, FLAT_TESSELLATED)),
    ]  # fmt: skip
    return toy.shader(results, *TESSELLATED_CHAIN, tessellation=patches)


def seen(toy: Toy, smooth: Node, flat: Node) -> list[Result]:
    """The values that the fragments show, with the side of the triangle that is seen."""
    graph, row = toy.graph, inputs_of((FRAGMENT,))["front_facing"]
    front = graph.node("input", BOOL, (), row)
    one, other = (build.floating(graph, each) for each in (1.0, -1.0))
    sign = graph.node("select", FLOAT, (front, one, other))
    shown = build.vector(graph, (smooth, sign))
    state = RenderTarget("rgba32f")
    return [
        Result(TARGET, FRAGMENT, shown, "shown", state=state),
        Result(TARGET, FRAGMENT, flat, "flat_values", state=state),
    ]


def plain() -> Shader:
    """Vertices that are where an attribute says."""
    toy = Toy()
    place, first = toy.attribute("place", VEC3), toy.attribute("first", VEC4)
    clip = build.vector(toy.graph, (place, build.floating(toy.graph, 1.0)))
    return toy.shader(
        [
            Result(CLIP_POSITION, VERTEX, clip),
            *seen(toy, build.cross(toy.graph, place, SMOOTH), build.cross(toy.graph, first, FLAT)),
        ],
        VERTEX, FRAGMENT,
    )  # fmt: skip


@cache
def compiled(patch: Patch | None, spacing: Spacing = "equal") -> CompiledMaterial:
    """The texts of a shader that divides patches; without a kind of patch, of the plain one."""
    if patch is None:
        shader = plain()
    else:
        points = len(CORNERS[patch])
        shader = divided(Tessellation(patch, points, tuple(range(points)), spacing, HERE))
    return compiled_shader(shader, PROFILES)


def patches_of(patch: Patch) -> Floats:
    """The control points of two patches, (patches, points, lanes)."""
    points = np.array(CORNERS[patch])
    nearer = points * [0.5, -0.5, 0.25]
    return np.stack([points, nearer])


def state(
    material: CompiledMaterial, attributes: Mapping[str, Floats], cells: Indices, **values: float
) -> SceneState:
    """The state of a scene with these vertices, primitives, and values of the parameters."""
    instance = material.instance()
    for name, value in values.items():
        instance.set(name, value)
    cleared = (CLEAR,) * 2
    return SceneState(*SIZE, attributes, cells, instance, cleared)


def natively(patch: Patch, spacing: Spacing) -> list[SceneState]:
    """The patches with each of the levels."""
    points = patches_of(patch)
    count = points.shape[0] * points.shape[1]
    attributes = {"place": points.reshape(count, 3), "once": np.ones((count, 1))}
    cells = np.arange(count).reshape(points.shape[:2])
    return [
        state(
            compiled(patch, spacing), attributes, cells,
            **{f"edge_{k}": level for k, level in enumerate(edges)},
            **{f"inner_{k}": level for k, level in enumerate(inside)},
        )
        for edges, inside in LEVELS[patch]
    ]  # fmt: skip


def expected(patch: Patch, spacing: Spacing) -> list[SceneState]:
    """The triangles or lines into which the reference divides the patches, drawn by themselves."""
    return [state(compiled(None), *_cells(patch, spacing, *levels)) for levels in LEVELS[patch]]


def _cells(
    patch: Patch, spacing: Spacing, edges: tuple[float, ...], inside: tuple[float, ...]
) -> tuple[Mapping[str, Floats], Indices]:
    """The vertices of both patches, and the triangles or lines between them."""
    match patch:
        case "triangle":
            pattern = reference.triangle(edges, inside[0], spacing)
        case "quad":
            pattern = reference.quad(edges, inside, spacing)
        case "isoline":
            pattern = reference.isolines(edges[0], edges[1], spacing)
    where = np.array(pattern.places) / reference.ONE
    cells = np.array(pattern.cells)
    places, firsts = [], []
    for number, points in enumerate(patches_of(patch)):
        places.append(_placed(patch, where, points))
        own = np.full((len(where), 2), [number, edges[0]])
        firsts.append(np.concatenate([where[:, :2], own], axis=1))
    every = np.concatenate([cells + number * len(where) for number in range(len(places))])
    return {"place": np.concatenate(places), "first": np.concatenate(firsts)}, every


def _placed(patch: Patch, where: Floats, points: Floats) -> Floats:
    """The places of a patch's vertices, which float32 can compute without rounding."""
    if patch == "triangle":
        weighted: Floats = where @ points
        return weighted
    across = points[3] - points[0] if patch == "quad" else np.array(ACROSS)
    moved: Floats = where[:, :1] * (points[1] - points[0]) + where[:, 1:2] * across
    placed: Floats = points[0] + moved
    return placed


def drawn(
    studio: Studio, route: str, material: CompiledMaterial, states: list[SceneState],
    primitive: Primitive | None = None,
) -> list[tuple[Floats, ...]]:  # fmt: skip
    """The targets of each picture; ``primitive`` says what the vertices are, if no patches."""
    where = ROUTES[route]
    assert studio.runner.problem(where) is None
    codes = compile_one(where, material.files, studio.toolchain)
    exact = Exact.of(material)
    made: Pipeline = pipeline(exact.reflection, where, codes)
    if primitive is not None:
        made = replace(made, primitive=primitive)
    return [each.pictures for each in draw_states(exact, states, where, made, studio.runner)]


@pytest.mark.parametrize("route", ON)
@pytest.mark.parametrize(("patch", "spacing"), list(product(PATCH_KINDS, SPACINGS)))
def test_drivers_divide_as_the_reference_does(
    studio: Studio, patch: Patch, spacing: Spacing, route: str
) -> None:
    found = drawn(studio, route, compiled(patch, spacing), natively(patch, spacing))
    shape: Primitive = "line" if patch == "isoline" else "triangle"
    wanted = drawn(studio, route, compiled(None), expected(patch, spacing), shape)
    for picture, like in zip(found, wanted, strict=True):
        for target, other in zip(picture, like, strict=True):
            assert (target == other).all()
        assert (like[0] != np.array(CLEAR)).any(axis=-1).sum() > 200
    assert all((one[1] != other[1]).any() for one, other in pairwise(wanted))
