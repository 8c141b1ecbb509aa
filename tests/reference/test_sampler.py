"""Filtering, wrapping and levels of textures, against values computed by hand."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest

from burnish.compiler.reference.picture import Expected, RasterRules, Texels

from .kit import few_ulps, geometry, picture, shader

WIDTH = 8


def texels(*levels: Any) -> Texels:
    """Levels whose red lanes are given as rows."""
    pictures = [np.zeros((*np.shape(level), 4)) for level in levels]
    for whole, level in zip(pictures, levels, strict=True):
        whole[..., 0] = level
    return Texels(tuple(pictures))


def read(
    texture: Texels,
    state: str,
    u: tuple[float, float] = (0.5, 0.5),
    v: tuple[float, float] = (0.5, 0.5),
    corners: Any = None,
    **rules: Any,
) -> Expected:
    """A square picture of ``WIDTH`` pixels whose coordinates run from edge to edge as given.

    Or with these coordinates at the top left, twice as far to the right, and twice as far down.
    With ``rules`` for a device, it has bounds.
    """
    given = shader(f"""
        abstract material Base {{
            attribute place : vec4
            clip_position : vec4 = place
        }}
        material M : Base {{
            attribute s : vec2
            map m : texture2d with {{ {state} }}
        }}
        pass P {{ target t : rgba32f = material.m(material.s) }}
        """, "P")  # fmt: skip
    place = np.array([(-1, 1, 0, 1), (3, 1, 0, 1), (-1, -3, 0, 1)], dtype=np.float64)
    edges = [(u[0], v[0]), (2 * u[1] - u[0], v[0]), (u[0], 2 * v[1] - v[0])]
    s = np.array(corners or edges, dtype=np.float64)
    mesh = geometry([(0, 1, 2)], place=place, s=s)
    errors = few_ulps if rules else None
    return picture(given, mesh, RasterRules(WIDTH, WIDTH, **rules), {"m": texture}, errors=errors)


def row(texture: Texels, state: str, u: tuple[float, float], **rules: Any) -> list[float]:
    """The values that the picture's first row reads along u."""
    found: list[float] = read(texture, state, u, **rules).targets[0][0, :, 0].tolist()
    return found


FOUR = texels([[1.0, 2.0, 4.0, 8.0]])


@pytest.mark.parametrize(
    ("wrap", "expected"),
    [
        # Pixel centres at u = -7/16, -5/16 … 7/16 of [-1, 1] twice as wide: one texel each.
        ("repeat", [1, 2, 4, 8, 1, 2, 4, 8]),
        ("clamp", [1, 1, 1, 1, 1, 2, 4, 8]),
        ("mirror", [8, 4, 2, 1, 1, 2, 4, 8]),
        ("border", [0, 0, 0, 0, 1, 2, 4, 8]),
        ("border, border = white", [1, 1, 1, 1, 1, 2, 4, 8]),
        ("clamp, wrap_v = repeat", [1, 1, 1, 1, 1, 2, 4, 8]),
        ("clamp, wrap_u = mirror", [8, 4, 2, 1, 1, 2, 4, 8]),
    ],
)
def test_wrapping(wrap: str, expected: list[float]) -> None:
    state = f"filter = nearest, mip = none, wrap = {wrap}"
    assert row(FOUR, state, (-1, 1)) == expected
    # At texels' centres a linear filter reads the same.
    assert row(FOUR, f"mip = none, wrap = {wrap}", (-1, 1)) == pytest.approx(expected)


@pytest.mark.parametrize(
    ("wrap", "expected"),
    [
        ("repeat", [4.5, 1.5, 3, 6, 4.5, 1.5, 3, 6]),
        ("clamp", [1, 1, 1, 1, 1, 1.5, 3, 6]),
        ("mirror", [8, 6, 3, 1.5, 1, 1.5, 3, 6]),
        ("border", [0, 0, 0, 0, 0.5, 1.5, 3, 6]),
        ("border, border = white", [1, 1, 1, 1, 1, 1.5, 3, 6]),
    ],
)
def test_half_way_between_texels(wrap: str, expected: list[float]) -> None:
    # Shifted by half a texel, every read is half way between two.
    found = row(FOUR, f"mip = none, wrap = {wrap}", (-1.125, 0.875))
    assert found == pytest.approx(expected)


@pytest.mark.parametrize(
    ("border", "lanes"), [("transparent", [0, 0]), ("black", [0, 1]), ("white", [1, 1])]
)
def test_a_border_has_four_lanes(border: str, lanes: list[float]) -> None:
    """A texture of one texel is read a whole texel beside it, in the smallest level as well."""
    single = texels([[0.5]])
    found = read(single, f"wrap = border, border = {border}", (2, 3)).targets[0][0, 0]
    assert found.tolist() == [lanes[0]] * 3 + [lanes[1]]


def test_axes_wrap_each_in_its_own_way() -> None:
    texture = texels([[1.0, 2.0], [3.0, 4.0]])
    state = "filter = nearest, mip = none, wrap = clamp, wrap_v = mirror"
    found = read(texture, state, (-1, 3), (-1, 3)).targets[0][..., 0]
    assert found[0].tolist() == [3, 3, 3, 4, 4, 4, 4, 4]
    assert found[:, 0].tolist() == [3, 1, 1, 3, 3, 1, 1, 3]


def test_the_first_texel_is_at_the_top_left() -> None:
    texture = texels([[1.0, 2.0], [3.0, 4.0]])
    found = read(texture, "filter = nearest", (0, 1), (0, 1)).targets[0][..., 0]
    assert found[[0, 0, 7, 7], [0, 7, 0, 7]].tolist() == [1, 2, 3, 4]


def test_weights_in_both_directions() -> None:
    texture = texels([[0.0, 1.0], [10.0, 11.0]])
    found = read(texture, "wrap = clamp", (0.25, 0.75), (0.25, 0.75)).targets[0][..., 0]
    share = (np.arange(WIDTH) + 0.5) / WIDTH
    assert np.allclose(found, share[None, :] + 10 * share[:, None])


LEVELS = texels(np.full((8, 8), 0.0), np.full((4, 4), 1.0), np.full((2, 2), 2.0), [[3.0]])
"""Every level tells its own number."""


@pytest.mark.parametrize(
    ("scale", "level"), [(0.5, 0.0), (1, 0.0), (2, 1.0), (4, 2.0), (8, 3.0), (64, 3.0), (3, None)]
)
def test_the_level_is_that_of_the_pixel_size(scale: float, level: float | None) -> None:
    wanted = np.log2(3) if level is None else level
    assert row(LEVELS, "", (0, scale)) == pytest.approx([wanted] * WIDTH)
    assert row(LEVELS, "mip = nearest", (0, scale)) == pytest.approx([np.rint(wanted)] * WIDTH)
    assert row(LEVELS, "mip = none", (0, scale)) == [0] * WIDTH


def test_the_larger_of_both_directions_counts() -> None:
    assert np.allclose(read(LEVELS, "", (0, 1), (0, 4)).targets[0][..., 0], 2)


def test_levels_of_a_plane_that_leans_away() -> None:
    """Under perspective the level grows as the square of the distance."""
    given = shader("""
        abstract material Base {
            attribute place : vec4
            attribute s : vec2
            clip_position : vec4 = place
            map m : texture2d
        }
        material M : Base {}
        pass P { target t : rgba32f = material.m(material.s) }
        """, "P")  # fmt: skip
    size = 32
    # A floor at y = -1 with the far end at z = 20: v is the distance, and u is across.
    world = [(-60.0, 0.5), (60.0, 0.5), (0.0, 20.0)]
    place = np.array([(x, -1, z / 2, z) for x, z in world])
    mesh = geometry([(0, 1, 2)], place=place, s=np.array([(x / 64, z / 64) for x, z in world]))
    numbers = [np.full((64 >> i, 64 >> i), float(i)) for i in range(7)]
    found = picture(given, mesh, RasterRules(size, size), {"m": texels(*numbers)})
    y, x = np.nonzero(found.covered)
    # Derivatives are those of the quad's upper left pixel.
    top = y // 2 * 2
    z = -1 / (1 - (np.stack([top, top + 1]) + 0.5) * 2 / size)
    left = x // 2 * 2
    slope = (np.stack([left, left + 1]) + 0.5) * 2 / size - 1
    along_x = np.abs(np.diff(slope, axis=0)[0] * z[0])
    along_y = np.hypot(np.diff(z, axis=0)[0], slope[0] * np.diff(z, axis=0)[0])
    level = np.clip(np.log2(np.maximum(along_x, along_y)), 0, 6)
    inside = (z > 0).all(axis=0)
    assert len(set(np.floor(level[inside]))) >= 3
    assert np.allclose(found.targets[0][y, x, 0][inside], level[inside])


def reds(found: Expected) -> tuple[Any, Any]:
    """The bounds of all pixels' red."""
    return found.low[0][..., 0], found.high[0][..., 0]


def test_at_its_border_a_nearest_texel_may_be_either() -> None:
    state = "filter = nearest, wrap = repeat"
    # Shifted by half a texel, pixel centres lie on the borders of texels.
    low, high = reds(read(FOUR, state, (-1.125, 0.875), subtexel_bits=8))
    assert low[0].tolist() == [1, 1, 2, 4, 1, 1, 2, 4]
    assert high[0].tolist() == [8, 2, 4, 8, 8, 2, 4, 8]
    low, high = reds(read(FOUR, state, (-1, 1), subtexel_bits=8))
    assert low[0].tolist() == high[0].tolist() == [1, 2, 4, 8, 1, 2, 4, 8]


def test_half_way_between_two_the_nearest_level_may_be_either() -> None:
    low, high = reds(read(LEVELS, "mip = nearest", (0, 2**1.5), subtexel_bits=8, mip_bits=8))
    assert np.allclose((low, high), [np.full_like(low, 1), np.full_like(low, 2)])
    # Vulkan lets a device take half a level more even for a step with a single lane.
    low, high = reds(read(LEVELS, "mip = nearest", (0, 2), subtexel_bits=8, mip_bits=8))
    assert np.allclose((low, high), [np.full_like(low, 1), np.full_like(low, 2)])
    known: dict[str, Any] = {"subtexel_bits": 8, "mip_bits": 8, "footprint": "euclidean"}
    low, high = reds(read(LEVELS, "mip = nearest", (0, 2), **known))
    assert np.allclose((low, high), 1)


def test_the_bounds_are_those_of_the_filters_bits() -> None:
    exact = read(FOUR, "mip = none", (0, 1))
    assert (exact.low[0] == exact.high[0]).all()
    # Between the texels 1 and 2 apart by one, a sixteenth of a texel's width.
    u = 0.3 + 0.02 * (np.arange(WIDTH) + 0.5) / WIDTH
    assert ((u * 4 - 0.5 > 0.6) & (u * 4 - 0.5 < 0.9)).all()
    upright = texels([[1.0], [2.0], [4.0], [8.0]])
    state = "mip = none, wrap = clamp"
    for found in (
        read(FOUR, state, (0.3, 0.32), subtexel_bits=4),
        read(upright, state, (0.5, 0.5), (0.3, 0.32), subtexel_bits=4),
    ):
        low, high = reds(found)
        assert np.allclose(high - found.targets[0][..., 0], 1 / 16, atol=1e-5)
        assert np.allclose(found.targets[0][..., 0] - low, 1 / 16, atol=1e-5)
        assert (found.low[0][..., 1:] == found.high[0][..., 1:]).all()


def test_the_bounds_are_those_of_the_levels_bits() -> None:
    known: dict[str, Any] = {"subtexel_bits": 8, "mip_bits": 6, "footprint": "euclidean"}
    low, high = reds(read(LEVELS, "", (0, 3), **known))
    assert np.allclose(high - low, 2.0**-5, atol=1e-4)
    # A step along x moves as far in u as in v; its length may be taken for the larger of the two,
    # half a level less, or for the square root of two times their sum, a whole level more.
    turned = [(0, 0), (3, 3), (-3, 3)]
    found = read(LEVELS, "", corners=turned, subtexel_bits=8, mip_bits=6)
    middle = np.log2(1.5 * np.sqrt(2))
    low, high = reds(found)
    assert np.allclose(found.targets[0][..., 0], middle)
    assert np.allclose(high, middle + 1 + 2.0**-6, atol=1e-4)
    assert np.allclose(low, middle - 0.5 - 2.0**-6, atol=1e-4)


def test_a_decision_that_filtering_may_tip_is_either() -> None:
    given = shader("""
        material M {
            map m : texture2d with { mip = none, wrap = clamp }
            clip_position : vec4 = vec4(vertex_position, 1)
            color = if m(uv).r < 1.5 then vec3(0) else vec3(1)
        }""")
    place = np.array([(-1, 1, 0), (3, 1, 0), (-1, -3, 0)], float)
    uv = np.array([(0.125, 0.5), (1.125, 0.5), (0.125, 0.5)])
    mesh = geometry([(0, 1, 2)], vertex_position=place, vertex_uv=uv)

    def either(bits: int) -> list[int]:
        rules = RasterRules(64, 1, subtexel_bits=bits)
        low, high = reds(picture(given, mesh, rules, {"m": FOUR}, errors=few_ulps))
        return list(map(int, (high - low > 0.1)[0].nonzero()[0]))

    # u grows by 1/128 a pixel, which is 1/32 texel; 1.5 is half way between two pixels.
    assert either(8) == []
    assert either(5) == [15, 16]


def test_a_choice_in_doubt_is_so_for_all_who_take_differences_with_it() -> None:
    """The first of four pixels depends on a comparison, and so do the levels of its quad."""

    def doubtful(read: str) -> list[list[int]]:
        given = shader(f"""
            material M {{
                map m : texture2d
                clip_position : vec4 = vec4(vertex_position, 1)
                color = {read}.rgb
            }}""")
        place = np.array([(-1, 1, 0), (3, 1, 0), (-1, -3, 0)], float)
        mesh = geometry(
            [(0, 1, 2)], vertex_position=place, vertex_uv=np.array([(0, 0), (2, 0), (0, 2)], float)
        )
        rules = RasterRules(4, 2, subtexel_bits=8, mip_bits=8)
        low, high = reds(picture(given, mesh, rules, {"m": LEVELS}, errors=few_ulps))
        return np.argwhere(high - low > 0.1).tolist()

    chosen = "if uv.x + uv.y <= 0.375 then uv + 2 else 2 * uv"
    assert doubtful(f"m.level({chosen}, uv.x + uv.y + ({chosen}).x)") == [[0, 0]]
    assert doubtful(f"m({chosen})") == [[0, 0], [0, 1], [1, 0], [1, 1]]


@pytest.mark.parametrize("bottom_up", [False, True])
def test_a_level_is_that_of_a_quads_first_row(bottom_up: bool) -> None:
    """In each quad u grows twice as fast along the lower row."""
    given = shader("""
        material M {
            map m : texture2d
            clip_position : vec4 = vec4(vertex_position, 1)
            color = m(vec2(uv.x * (1 + floor(uv.y / 3)), 0.5)).rgb
        }""")
    place = np.array([(-1, 1, 0), (3, 1, 0), (-1, -3, 0)], float)
    # u grows by 1/4 of the texture a pixel, which is 2 texels; v is 1.5 and 4.5.
    mesh = geometry(
        [(0, 1, 2)], vertex_position=place, vertex_uv=np.array([(0, 0), (1, 0), (0, 12)], float)
    )
    rules = RasterRules(2, 2, bottom_up=bottom_up)
    found = picture(given, mesh, rules, {"m": LEVELS}).targets[0][..., 0]
    assert found == pytest.approx(np.full((2, 2), 2.0 if bottom_up else 1.0))
