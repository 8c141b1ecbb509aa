"""The noises of ``std.mtlx`` against what MaterialX's own GLSL draws."""

from __future__ import annotations

import pytest

from .materialx import RESULTS, Node, Nodes, assert_alike, by_burnish
from .truth import truth

IMPORTS = "import std.mtlx.noise"
KINDS = {1: "float", 2: "vector2", 3: "vector3", 4: "vector4"}
ENDINGS = {1: "", 2: "_vec2", 3: "_vec3", 4: "_vec4"}
SIZES = {1: "r.x", 2: "r.xy", 3: "r.xyz", 4: "r"}
PLACES = {2: "p.xy", 3: "p.xyz"}
ROUNDED = 2e-5
"""Noise in float32: cells have up to 9 for the coordinates, and slopes up to 5."""
FAR = 1e-3
"""The same 193 cells farther on, where float32 has fewer digits, and with finer octaves."""


def called(name: str, dimension: int, lanes: int, glsl: str, ours: str, near: float) -> Node:
    """A noise, whose arguments are the place and others; MaterialX has the place last."""
    place = PLACES[dimension]
    theirs = glsl.format(place=place, size=SIZES[lanes])
    function = f"{name}{dimension}d"
    return Node(
        f"mx_{function}_{KINDS[lanes]}({theirs}, {RESULTS[lanes]})",
        f"{function}{ENDINGS[lanes]}({place}{ours.format(size=SIZES[lanes])})",
        lanes,
        near,
    )


def gradient_noise(dimension: int, lanes: int) -> Node:
    return called(
        "noise", dimension, lanes, "{size}, q.w, {place}", ", {size}, q.w",
        FAR if lanes == 4 else ROUNDED,
    )  # fmt: skip


def octaves(dimension: int, lanes: int) -> Node:
    """Sums of none to four octaves."""
    rest = "int(q.z * 5), r.w, q.y"
    return called(
        "fractal", dimension, lanes, f"{{size}}, {rest}, {{place}}", f", {{size}}, {rest}",
        FAR if lanes in (2, 4) else ROUNDED,
    )  # fmt: skip


def worley(dimension: int, lanes: int) -> Node:
    """In both styles."""
    style = "int(q.y * 2)"
    theirs, ours = f"{{place}}, q.x, {style}", f", q.x, ({style} as WorleyStyle)"
    return called("worleynoise", dimension, lanes, theirs, ours, 1e-6)


def flake(dimension: int, glsl: str, member: str, lanes: int = 1, coverage: str = "q.z") -> Node:
    """An output of the flakes, among vectors that are not at right angles to each other."""
    place = PLACES[dimension]
    rest = f"0.1 + q.w, q.y, {coverage}", "r.xyz, p.yzw, q.xyz"
    ours = f"flake{dimension}d({place}, {', '.join(rest)}).{member}"
    return Node(
        f"mx_flake{dimension}d({rest[0]}, {place}, {rest[1]}, {glsl})",
        f"float({ours})" if member == "id" else ours,
        lanes,
        near=1e-5 if lanes > 1 else 1e-6,
    )


DIMENSIONS = (2, 3)
GRADIENTS: Nodes = {
    f"noise{d}d of {lanes}": gradient_noise(d, lanes) for d in DIMENSIONS for lanes in KINDS
}
OCTAVES: Nodes = {f"fractal{d}d of {n}": octaves(d, n) for d in DIMENSIONS for n in KINDS}
CELLS: Nodes = {
    f"cellnoise{d}d": called("cellnoise", d, 1, "{place}", "", 1e-7) for d in DIMENSIONS
}
WORLEYS: Nodes = {f"worleynoise{d}d of {n}": worley(d, n) for d in DIMENSIONS for n in (1, 2, 3)}
FLAKES: Nodes = {
    f"flake{d}d: {member}": flake(d, results, member, lanes)
    for d in DIMENSIONS
    for member, results, lanes in (
        ("id", "whole, single, single, three); one = float(whole", 1),
        ("rand", "whole, one, single, three", 1),
        ("presence", "whole, single, one, three", 1),
        ("flakenormal", "whole, single, single, three", 3),
    )
}
FLAKES_EVERYWHERE: Nodes = {
    f"flake{d}d: all covered": flake(d, "whole, single, one, three", "presence", coverage="1.0")
    for d in DIMENSIONS
}
NODES: Nodes = {**GRADIENTS, **OCTAVES, **CELLS, **WORLEYS, **FLAKES, **FLAKES_EVERYWHERE}

HASHES = [f"std.mtlx.hashes.{name}" for name in ("hash", "last_word", "first_word", "turned_left")]
MIXING = [f"std.mtlx.hashes.{name}" for name in ("HashWords", "mixed")]


def of(names: str) -> list[str]:
    """The full names of declarations of the file."""
    return [f"std.mtlx.noise.{name}" for name in names.split()]


@truth(*of("noise2d noise2d_vec2 noise2d_vec3 noise2d_vec4"))
@truth(*of("noise3d noise3d_vec2 noise3d_vec3 noise3d_vec4"))
@truth(*of("perlin_noise perlin_noises plane_at planes_at corner2 corner3 weight_of"), *HASHES)
@pytest.mark.parametrize("name", GRADIENTS)
def test_gradient_noise(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("fractal2d fractal2d_vec2 fractal2d_vec3 fractal2d_vec4"))
@truth(*of("fractal3d fractal3d_vec2 fractal3d_vec3 fractal3d_vec4"))
@truth(*of("perlin_octaves octaves_of_three Octaves2 Octaves3 OctavesOfThree2 OctavesOfThree3"))
@pytest.mark.parametrize("name", OCTAVES)
def test_octaves(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("most_octaves perlin_octaves octaves_of_three"))
@pytest.mark.parametrize("place", PLACES.values())
@pytest.mark.parametrize("ending", ["", "_vec3"])
def test_there_are_32_octaves_at_most(place: str, ending: str) -> None:
    dimension = len(place) - 2
    all_alike = Node("", f"fractal{dimension}d{ending}({place}, 1, 40, 1, 1)", 3 if ending else 1)
    one = Node("", f"noise{dimension}d{ending}({place}, 32, 0)", 3 if ending else 1)
    assert by_burnish(all_alike, IMPORTS) == pytest.approx(by_burnish(one, IMPORTS))


@truth(*of("cellnoise2d cellnoise3d fraction_of"), *HASHES)
@pytest.mark.parametrize("name", CELLS)
def test_numbers_of_cells(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("WorleyStyle worleynoise2d worleynoise2d_vec2 worleynoise2d_vec3"))
@truth(*of("worleynoise3d worleynoise3d_vec2 worleynoise3d_vec3"))
@truth(*of("to_feature square_to_feature shorter nearest_feature with_number step2 step3"))
@truth(*of("number_of numbers_of"), *MIXING)
@pytest.mark.parametrize("name", WORLEYS)
def test_worley(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)


@truth(*of("flake2d flake3d Flake Uppermost upper uppermost turned_flake flake_share half_flake"))
@truth(*of("facet_of numbers_of"), *MIXING)
@pytest.mark.parametrize("name", [*FLAKES, *FLAKES_EVERYWHERE])
def test_flakes(name: str) -> None:
    assert_alike(NODES, name, IMPORTS)
