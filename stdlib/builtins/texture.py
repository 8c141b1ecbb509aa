"""Rows for texture reads.

The texture is the first operand. For arrays of textures, the layer follows the coordinate, and is
clamped to the existing layers.
"""

from __future__ import annotations

from .accuracy import EXACT, Inherited, promised
from .facts import Fact
from .row import Builtin

FILTERED = promised(Inherited("the device's bits for positions within a texel and for levels"))


def _all_zero(facts: tuple[Fact, ...]) -> bool:
    """True if coordinate, layer and level are 0, which every texture has."""
    return all(fact.lo == fact.hi == 0.0 for fact in facts[1:])


def _reference_is_depth(facts: tuple[Fact, ...]) -> bool:
    """True if a reference is in 0..1; formats treat other references differently."""
    return facts[-1].within(0.0, 1.0)


MOST_BIAS = 15.0
"""The largest bias of a level that is added; devices clamp larger ones, each to its own limit.

Direct3D and WebGPU add it, and so do most devices of Vulkan, which promises 2 only
(``maxSamplerLodBias``).
"""


def _bias_is_small(facts: tuple[Fact, ...]) -> bool:
    """True if no device clamps a bias."""
    return facts[-1].within(-MOST_BIAS, MOST_BIAS)


FILTER_SLACK = 2.0**-20
"""The part by which a blend of zeros and ones may exceed 1.

A device rounds its weights and sums. ``compiler/reference/picture/blending.py`` allows 5 * 2^-24
for each of two axes. It is not below 0: no more is taken away than there is, as weights have far
fewer places than floats.
"""


def _share(_facts: tuple[Fact, ...], _same: bool) -> Fact:
    """A mean of the results of several comparisons."""
    return Fact(0.0, 1.0 + FILTER_SLACK)


def _results(_facts: tuple[Fact, ...], _same: bool) -> Fact:
    """The results of four comparisons."""
    return Fact(0.0, 1.0)


def _counted(_facts: tuple[Fact, ...], _same: bool) -> Fact:
    """The range of a count: at least one, and no more than any device allows."""
    return Fact(1.0, 65536.0, nonzero=True)


ROWS = (
    Builtin(
        name="sample",
        meaning="texel",
        method="",
        parameters=("coordinate",),
        signatures=(
            "F, K -> vec4",
            "texture2d_array, vec2, int -> vec4",
            "texture_cube_array, vec3, int -> vec4",
        ),
        doc="The texture's colour at a coordinate, filtered; the level of detail is implicit.",
        accuracy=FILTERED,
        cost=16,
        uniform_control_flow=True,
        sampler="filtering",
    ),
    Builtin(
        name="sample_bias",
        meaning="texel",
        method="bias",
        parameters=("coordinate", "bias"),
        signatures=(
            "F, K, float -> vec4",
            "texture2d_array, vec2, int, float -> vec4",
            "texture_cube_array, vec3, int, float -> vec4",
        ),
        doc="The filtered colour at a coordinate; the last operand is added to the implicit level.",
        domain=_bias_is_small,
        needs=f"the bias lies in {-MOST_BIAS:g}..{MOST_BIAS:g}",
        outside="Biases are clamped to -15..15, which Direct3D, WebGPU and most devices add.",
        expansion="sample_bias",
        accuracy=FILTERED,
        cost=16,
        uniform_control_flow=True,
        sampler="filtering",
    ),
    Builtin(
        name="sample_level",
        meaning="texel",
        method="level",
        parameters=("coordinate", "level"),
        signatures=(
            "F, K, float -> vec4",
            "texture2d_array, vec2, int, float -> vec4",
            "texture_cube_array, vec3, int, float -> vec4",
        ),
        doc="The filtered colour at a coordinate in a level of detail; fractions blend two levels.",
        accuracy=FILTERED,
        cost=16,
        sampler="filtering",
    ),
    Builtin(
        name="sample_grad",
        meaning="texel",
        method="grad",
        parameters=("coordinate", "dx", "dy"),
        signatures=(
            "F, K, K, K -> vec4",
            "texture2d_array, vec2, int, vec2, vec2 -> vec4",
            "texture_cube_array, vec3, int, vec3, vec3 -> vec4",
        ),
        doc="The filtered colour at a coordinate, in the level that fits if the coordinate changes "
        "by the last two operands from one pixel to the next, to the right and downwards.",
        accuracy=FILTERED,
        cost=16,
        sampler="filtering",
    ),
    Builtin(
        name="gather",
        meaning="of_texture",
        method="gather",
        parameters=("coordinate", "lane"),
        signatures=(
            "texture2d, vec2, int -> vec4",
            "texture2d_array, vec2, int, int -> vec4",
            "texture_cube, vec3, int -> vec4",
            "texture_cube_array, vec3, int, int -> vec4",
        ),
        doc="One lane of the four texels that a filtered read would blend, at level 0: "
        "lower left, lower right, upper right, upper left. The lane is a constant in 0..3.",
        accuracy=EXACT,
        cost=16,
        sampler="filtering",
        constants=(-1,),
    ),
    Builtin(
        name="compare",
        meaning="of_texture",
        method="",
        parameters=("coordinate", "reference"),
        signatures=(
            "D, K, float -> float",
            "depth2d_array, vec2, int, float -> float",
            "depth_cube_array, vec3, int, float -> float",
        ),
        doc="The share of depths at a coordinate, filtered, for which the map's comparison holds, "
        "with the last operand, the reference, on its left. With `less_equal` it is 1 where the "
        "reference is not behind the stored depth. Reads level 0.",
        domain=_reference_is_depth,
        needs="the reference lies in 0..1",
        outside="References are clamped to 0..1, the range of depths.",
        expansion="compare",
        range=_share,
        accuracy=FILTERED,
        cost=16,
        sampler="comparison",
    ),
    Builtin(
        name="gather_compare",
        meaning="of_texture",
        method="gather",
        parameters=("coordinate", "reference"),
        signatures=("depth2d, vec2, float -> vec4", "depth2d_array, vec2, int, float -> vec4"),
        doc="The four comparisons that a filtered one would blend, each 0 or 1, as in `gather`.",
        domain=_reference_is_depth,
        needs="the reference lies in 0..1",
        outside="References are clamped to 0..1, the range of depths.",
        expansion="gather_compare",
        range=_results,
        accuracy=EXACT,
        cost=16,
        sampler="comparison",
    ),
    Builtin(
        name="load",
        meaning="texel",
        method="load",
        parameters=("place", "level"),
        optional=(0,),
        signatures=("G, W, int -> E", "H, ivec2, int, int -> E"),
        doc="One unfiltered texel by its integer coordinate and level; (0, 0) is at the top left.",
        domain=_all_zero,
        needs="place, layer and level are 0, which every texture has",
        outside="Coordinates, layers and levels out of bounds are clamped to the edge.",
        expansion="load",
        accuracy=EXACT,
        cost=8,
    ),
    Builtin(
        name="texture_size",
        meaning="of_texture",
        method="size",
        parameters=("level",),
        optional=(0,),
        signatures=("X, int -> W",),
        doc="The size of a level in texels; for arrays and cubes, that of one layer or face.",
        domain=_all_zero,
        needs="the level is 0, which every texture has",
        outside="Levels beyond the last one have the size of the last one.",
        expansion="texture_size",
        range=_counted,
        accuracy=EXACT,
        cost=2,
    ),
    Builtin(
        name="texture_layers",
        meaning="of_texture",
        method="layers",
        signatures=("H -> int", "texture_cube_array -> int", "depth_cube_array -> int"),
        doc="The number of layers; a layer of an array of cubes is a whole cube.",
        range=_counted,
        accuracy=EXACT,
        cost=2,
    ),
    Builtin(
        name="texture_levels",
        meaning="of_texture",
        method="levels",
        signatures=("X -> int",),
        doc="The number of levels of detail.",
        range=_counted,
        accuracy=EXACT,
        cost=2,
    ),
)
