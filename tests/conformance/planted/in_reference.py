"""Planted errors in the reference, so that every route must differ from it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from burnish.compiler.reference import (
    derivatives,
    floats,
    functions,
    logic,
    matrices,
    operations,
    vectors,
)
from burnish.compiler.reference.bounds import Bounded
from burnish.compiler.reference.bounds.errors import Errors
from burnish.compiler.reference.picture import (
    Expected,
    RasterRules,
    assembly,
    bias,
    canvas,
    clip,
    compositing,
    coverage,
    cube,
    drawing,
    faces,
    filtering,
    levels,
    quads,
    resolve,
    samples,
    stencil,
    texels,
)
from burnish.compiler.reference.picture.intervals import increasing, quotient
from burnish.compiler.reference.picture.quads import Barycentric
from burnish.targets.conformance import contents
from burnish.targets.runner.reference import Program, expected
from burnish.targets.runner.scene_state import SceneState
from burnish.targets.runner.store import Store

from .planting import QUICKEST, Plant, Planted, replaced

GLSL, HLSL, WGSL = QUICKEST["glsl"], QUICKEST["hlsl"], QUICKEST["wgsl"]
SNAPPING = "swiftshader:glsl"
"""The grid of this route's driver is coarse, so that vertices and edges are often on pixel
centres."""


def in_table(table: str, name: str, wrong: Callable[..., Any]) -> Plant:
    """Put another function into one of the tables of functions."""
    return edited(functions, table, name, wrong)


def edited(owner: Any, table: str, name: Any, wrong: Any) -> Plant:
    """Put another row into a table."""

    def plant(patch: pytest.MonkeyPatch, _folder: Path) -> None:
        patch.setattr(owner, table, {**getattr(owner, table), name: wrong})

    return plant


def float_(name: str, wrong: Callable[..., Any]) -> Plant:
    return in_table("_FLOATS", name, wrong)


def whole(name: str, wrong: Callable[..., Any]) -> Plant:
    return in_table("WHOLE", name, wrong)


def _truncated(xp: Any, x: Any, y: Any) -> Any:
    tiny = abs(y) < 1e-30
    divisor = xp.where(tiny, 1.0, y)
    return xp.where(tiny, 0.0, x - divisor * xp.trunc(xp.divide(x, divisor)))


def _half_away(xp: Any, x: Any) -> Any:
    return xp.where(x < 0, -1.0, 1.0) * xp.floor(abs(x) + 0.5)


def _straight(xp: Any, low: Any, high: Any, x: Any) -> Any:
    straight = floats.saturate(xp, floats.div(xp, x - low, high - low))
    return xp.where(abs(high - low) < 1e-30, floats.step(xp, low, x), straight)


def _quintic(xp: Any, low: Any, high: Any, x: Any) -> Any:
    t = floats.saturate(xp, floats.div(xp, x - low, high - low))
    curve = t * t * t * (t * (6.0 * t - 15.0) + 10.0)
    return xp.where(abs(high - low) < 1e-30, floats.step(xp, low, x), curve)


def _reflected(_xp: Any, incident: Any, normal: Any) -> Any:
    twice = 2.0 * vectors.inner(normal, incident)
    return tuple(twice * n - i for i, n in zip(incident, normal, strict=True))


def _refracted(xp: Any, incident: Any, normal: Any, ratio: Any) -> Any:
    (eta,) = ratio
    return vectors.refract(xp, incident, normal, (xp.divide(1.0, eta),))


def _lit_behind(xp: Any, diffuse: Any, specular: Any, power: Any) -> Any:
    """Highlights where the light is behind the surface."""
    return vectors.lit(xp, (abs(diffuse[0]),), specular, power)


def _lit_unseen(xp: Any, diffuse: Any, specular: Any, power: Any) -> Any:
    """Highlights where the half vector is behind the surface."""
    return vectors.lit(xp, diffuse, (abs(specular[0]),), power)


def _floored(xp: Any, x: Any, y: Any) -> Any:
    return xp.where(y == 0, x, x // xp.where(y == 0, 1, y))


_FLOATS: list[tuple[str, str, str, Callable[..., Any]]] = [
    ("div", "x / 0 is x", "Arithmetic", lambda xp, x, y: xp.where(y == 0, x, floats.div(xp, x, y))),
    ("mod", "cut towards zero", "Arithmetic", _truncated),
    ("mix", "swapped", "Arithmetic", lambda xp, x, y, a: floats.mix(xp, y, x, a)),
    ("sign", "of zero is 1", "Arithmetic", lambda xp, x: xp.where(x < 0, -1.0, 1.0)),
    ("clamp", "upper limit first", "Limits",
     lambda xp, x, low, high: xp.maximum(xp.minimum(x, high), low)),
    ("step", "not at the edge", "Limits", lambda xp, edge, x: xp.where(x > edge, 1.0, 0.0)),
    ("smoothstep", "straight", "Limits", _straight),
    ("smoothstep", "of the fifth degree", "Limits", _quintic),
    ("saturate", "without an upper limit", "Limits", lambda xp, x: xp.maximum(x, 0.0)),
    ("fract", "of negatives negative", "Rounding", lambda xp, x: x - xp.trunc(x)),
    ("round", "halves away from zero", "Rounding", _half_away),
    ("trunc", "downwards", "Rounding", lambda xp, x: xp.floor(x)),
    ("pow", "0 to the 0 is 0", "Powers",
     lambda xp, x, y: xp.where(x <= 0, 0.0, floats.pow_(xp, x, y))),
    ("pow", "even in its base", "Powers", lambda xp, x, y: floats.pow_(xp, abs(x), y)),
    ("log2", "natural", "Powers", floats.log),
    ("sqrt", "of the magnitude", "Powers", lambda xp, x: xp.sqrt(abs(x))),
    ("atan2", "swapped", "Angles", lambda xp, y, x: floats.atan2(xp, x, y)),
    ("acos", "of half", "Angles", lambda xp, x: floats.acos(xp, 0.999 * x)),
]  # fmt: skip
"""The builtin, what is wrong, the pass of ``operations`` that shows it, and the wrong function."""

_WHOLE: list[tuple[str, str, str, Callable[..., Any]]] = [
    ("cross", "by the left hand", "operations: Geometry",
     lambda xp, x, y: vectors.cross(xp, y, x)),
    ("normalize", "to length two", "operations: Geometry",
     lambda xp, v: vectors.scaled(vectors.normalize(xp, v), 2.0)),
    ("reflect", "with the other sign", "operations: Geometry", _reflected),
    ("lit", "behind", "operations: Geometry", _lit_behind),
    ("lit", "unseen", "operations: Geometry", _lit_unseen),
    ("refract", "the other way", "operations: Bending", _refracted),
    ("faceforward", "turned", "operations: Bending",
     lambda xp, n, i, r: vectors.scaled(vectors.faceforward(xp, n, i, r), -1.0)),
    ("transpose", "not at all", "pipeline: Products", lambda _xp, m: m),
    ("determinant", "with the other sign", "pipeline: Products",
     lambda xp, m: (-matrices.determinant(xp, m)[0],)),
    ("inverse", "transposed", "pipeline: Inverses",
     lambda xp, m: tuple(zip(*matrices.inverse(xp, m), strict=True))),
    ("any", "as all", "integers: Compared", logic.all_),
    ("ddy", "upwards", "pipeline: Slopes",
     lambda xp, v: tuple(-1.0 * lane for lane in derivatives.ddy(xp, v))),
    ("ddx", "of two pixels", "pipeline: Slopes",
     lambda xp, v: tuple(2.0 * lane for lane in derivatives.ddx(xp, v))),
]  # fmt: skip

edges = coverage._edges
distances = clip._distances
window = faces.window
perspective = Barycentric.perspective
snapped = faces.snapped
level = levels.of_steps
wrapped = texels._wrapped
locations = samples.locations
load = texels.Image.load


def _bottom_right(*given: Any) -> Any:
    return replace(edges(*given), owns=~edges(*given).owns)


def _no_near_plane(corners: Any, sides: bool) -> Any:
    found = distances(corners, sides)
    found[..., 0] = 1.0
    return found


def _upside_down(positions: Any, rules: Any) -> Any:
    x, y = window(positions, rules)
    return x, rules.height - y


def _linear(place: Any, *about: Any, **named: Any) -> Any:
    place._perspective = place._linear
    return perspective(place, *about, **named)


def _from_below(rules: Any) -> Any:
    return locations(replace(rules, bottom_up=not rules.bottom_up))


def _turned_over(positions: Any, triangles: Any, rules: Any, off: Any, _front: Any) -> Any:
    return faces.triangles_of(positions, triangles, rules, off, "clockwise")


def _of_fronts(test: stencil.StencilTest) -> Any:
    return ((test.state.front, test.front | True),)


def _last(place: Any, values: Any) -> Any:
    """Take flat values from the last vertex."""
    corner = place._faces.corners[place._face, 2]
    return tuple(
        lane.mapped(lambda array: array[corner][:, None, None])
        if isinstance(lane, Bounded)
        else lane[corner][:, None, None]
        for lane in values
    )


def _farthest(fragments: Any, depth: Any, off: Any, place: Any) -> Any:
    return canvas.nearest(fragments, -depth, off, place)


def _coarser(by: float) -> Callable[..., Any]:
    """Compute a level that is wrong."""

    def wrong(image: Any, steps: Any) -> Any:
        return increasing(lambda x: np.clip(x + by, 0, image.levels - 1), level(image, steps))

    return wrong


def _repeated(index: Any, size: Any, wrap: str) -> Any:
    """Repeat where it should mirror."""
    return wrapped(index, size, "repeat" if wrap == "mirror" else wrap)


def _within_faces(place: Any, face: Any, size: Any) -> Any:
    """Treat faces as if they had no neighbours."""
    return [np.clip(i, 0, size - 1) for i in place], face


def _unprojected(where: Any, lanes: Any) -> Any:
    """Use gradients without projecting them onto the face."""
    along = cube._turned_lanes(where.face, lanes)
    return [increasing(lambda x: x / 2, quotient(step, where.out)) for step in along[:2]]


def _round_about(image: Any, place: Any, layer: Any, level: Any) -> Any:
    """Take texels beyond an edge from the opposite edge."""
    sizes = image.sizes(np.clip(level, 0, image.levels - 1))
    return load(image, [i % size for i, size in zip(place, sizes, strict=True)], layer, level)


def _reversed(node: Any, operands: Any, _xp: Any) -> Any:
    return tuple(operands[0][lane] for lane in reversed(node.data))


def _otherwise(_node: Any, operands: Any, xp: Any) -> Any:
    (condition,), then, otherwise = operands
    return operations.chosen(xp, condition, otherwise, then)


_PICTURE = [
    Planted("bottom-right rule", "pipeline: Crossing", SNAPPING,
            replaced(coverage, "_edges", _bottom_right)),
    Planted("no near plane", "operations: Limits", GLSL,
            replaced(clip, "_distances", _no_near_plane)),
    Planted("upside down", "operations: Limits", GLSL, replaced(faces, "window", _upside_down)),
    Planted("no snapping", "operations: Limits", SNAPPING,
            replaced(faces, "snapped", lambda places, _rules: places)),
    Planted("no perspective", "operations: Limits", GLSL,
            replaced(Barycentric, "perspective", _linear)),
    Planted("flat from the last vertex", "pipeline: Crossing", HLSL,
            replaced(Barycentric, "flat", _last)),
    Planted("the farthest wins", "operations: Limits", GLSL,
            replaced(drawing, "nearest", _farthest)),
    Planted("back faces in front", "pipeline: Crossing", WGSL,
            replaced(assembly, "triangles_of", _turned_over)),
    Planted("values that stay", "pipeline: Counted", GLSL,
            replaced(stencil, "operated", lambda _operation, there, _reference: there)),
    Planted("nothing but fronts", "pipeline: Counted", GLSL,
            replaced(stencil.StencilTest, "sides", _of_fronts)),
    Planted("nearer instead of farther", "pipeline: Biased", WGSL,
            replaced(bias, "_clamped", lambda moved, _most: -moved)),
    Planted("alpha covers nothing", "pipeline: Veil", GLSL,
            edited(compositing, "FACTORS", "src_alpha", compositing.FACTORS["dst_alpha"])),
    Planted("alpha hides as much as it covers", "pipeline: Veil", HLSL,
            edited(compositing, "FACTORS", "one_minus_src_alpha",
                   compositing.FACTORS["src_alpha"])),
    Planted("a constant of one", "pipeline: Stained", WGSL,
            edited(compositing, "FACTORS", "constant", compositing.FACTORS["one_minus_constant"])),
    Planted("saturated by nothing", "pipeline: Stained", GLSL,
            edited(compositing, "FACTORS", "src_alpha_saturated",
                   compositing.FACTORS["src_alpha"])),
    Planted("the smaller alpha", "pipeline: Stained", HLSL,
            edited(compositing, "CHOICES", "max", np.minimum)),
    Planted("samples in one half", "pipeline: Sampled", GLSL,
            edited(samples, "_STANDARD", 4, [*samples._STANDARD[4][::2]] * 2)),
    Planted("samples turned over", "pipeline: Sampled", GLSL,
            replaced(coverage, "locations", _from_below)),
    Planted("depths of samples at the centre", "pipeline: Sampled", GLSL,
            replaced(quads, "location_of_depth", lambda _sample, _rules: samples.CENTRE)),
    Planted("one sample for all", "pipeline: Sampled", WGSL,
            replaced(resolve, "_mean", lambda of_pixel, *_, **_how: of_pixel[..., 0, :])),
    Planted("mirrors that repeat", "textures: Wraps", GLSL,
            replaced(texels, "_wrapped", _repeated)),
    Planted("a level too small", "textures: Levels", HLSL,
            replaced(levels, "of_steps", _coarser(1.0))),
    Planted("half a level too small", "textures: Levels", WGSL,
            replaced(levels, "of_steps", _coarser(0.5))),
    Planted("a seam at every edge of a cube", "kinds: Explicit", WGSL,
            replaced(texels, "across_edges", _within_faces)),
    Planted("gradients past a cube's surface", "kinds: Slopes", GLSL,
            replaced(cube.Met, "change", _unprojected)),
    Planted("layers counted round", "kinds: Explicit", HLSL,
            replaced(texels.Image, "layer", lambda self, number: number % self.layers)),
    Planted("depths on the left", "kinds: Compared", GLSL,
            edited(filtering, "_COMPARISONS", "less", lambda reference, depth: reference > depth)),
    Planted("gathered the other way round", "gathered: Colors", WGSL,
            replaced(filtering, "_ROUND", filtering._ROUND[::-1])),
    Planted("loaded round the edges", "kinds: Loaded", HLSL,
            replaced(texels.Image, "load", _round_about)),
    Planted("swizzles backwards", "storage: Plain", GLSL,
            edited(operations, "_STEPS", "swizzle", _reversed)),
    Planted("choices the wrong way round", "integers: Compared", WGSL,
            edited(operations, "_STEPS", "select", _otherwise)),
    Planted("integers divided downwards", "integers: Signed", HLSL,
            in_table("_INTEGERS", "div", _floored)),
    Planted("sums subtracted", "storage: Elements", GLSL,
            float_("add", lambda _xp, x, y: x - y)),
]  # fmt: skip


def _drawn_anew(plant: Plant) -> Plant:
    """Draw the reference's pictures again: the cache's keys do not depend on what is planted."""

    def drawn(
        program: Program,
        state: SceneState,
        rules: RasterRules,
        _store: Store,
        errors: Errors | None,
    ) -> Expected:
        return expected(program.shader, state, rules, errors)

    def whole_plant(patch: pytest.MonkeyPatch, folder: Path) -> None:
        patch.setattr(contents, "remembered", drawn)
        plant(patch, folder)

    return whole_plant


_ALL = [
    *(
        Planted(f"reference: {name} {what}", f"operations: {pass_}", GLSL, float_(name, wrong))
        for name, what, pass_, wrong in _FLOATS
    ),
    *(
        Planted(f"reference: {name} {what}", material, HLSL, whole(name, wrong))
        for name, what, material, wrong in _WHOLE
    ),
    *(replace(each, name=f"reference: {each.name}") for each in _PICTURE),
]
PLANTED = [replace(each, plant=_drawn_anew(each.plant)) for each in _ALL]
