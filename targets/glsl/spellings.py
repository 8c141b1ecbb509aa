"""The words of GLSL for types, textures and builtins; ``language.py`` has all else of it."""

from __future__ import annotations

from ..description.spellings import Read, Spelling, Spellings, TextureNames, TypeNames

TYPES = TypeNames(
    scalars={"float": "float", "int": "int", "uint": "uint", "bool": "bool"},
    vectors={"float": "vec{n}", "int": "ivec{n}", "uint": "uvec{n}", "bool": "bvec{n}"},
    matrix="mat{n}",
    rectangular_matrix="mat{columns}x{rows}",
)

TEXTURES = TextureNames(
    dimensions={
        "2d": "2D",
        "2d_array": "2DArray",
        "3d": "3D",
        "cube": "Cube",
        "cube_array": "CubeArray",
    },
    textures={
        "float": "texture{dimension}",
        "depth": "texture{dimension}",
        "int": "itexture{dimension}",
        "uint": "utexture{dimension}",
    },
    samplers={"filtering": "sampler", "comparison": "samplerShadow"},
    combined={
        "float": "sampler{dimension}",
        "depth": "sampler{dimension}",
        "int": "isampler{dimension}",
        "uint": "usampler{dimension}",
    },
    compared="sampler{dimension}Shadow",
)


def in_layers(plain: str, layered: str) -> Read:
    """A read whose layer is the last lane of the coordinate, behind two lanes or a direction."""
    of_cubes = layered.replace("vec3({1}, {2})", "vec4({1}, {2})")
    return Read(plain, layered, {"texture_cube_array": of_cubes})


FETCH = "texelFetch({0}, {1}, {2})"
FETCH_LAYER = "texelFetch({0}, ivec3({1}, {2}), {3})"

NATIVES: Spellings = {
    "mod": Spelling(floats="mod"),
    "saturate": "clamp({0}, 0.0, 1.0)",
    "round": "roundEven",
    "atan2": "atan",
    "to_float": "{type}({0})",
    "to_int": "{type}({0})",
    "to_uint": "{type}({0})",
    "eq": Spelling(vectors="equal"),
    "ne": Spelling(vectors="notEqual"),
    "lt": Spelling(vectors="lessThan"),
    "le": Spelling(vectors="lessThanEqual"),
    "gt": Spelling(vectors="greaterThan"),
    "ge": Spelling(vectors="greaterThanEqual"),
    "and": Spelling(vectors="{type}(uvec{lanes}({0}) & uvec{lanes}({1}))"),
    "or": Spelling(vectors="{type}(uvec{lanes}({0}) | uvec{lanes}({1}))"),
    "not": Spelling(vectors="not"),
    "bits_of": "floatBitsToUint",
    "float_of_bits": "uintBitsToFloat",
    "count_bits": "bitCount",
    "reverse_bits": "bitfieldReverse",
    "first_leading_bit": "findMSB",
    "first_trailing_bit": "findLSB",
    "sample": in_layers("texture({0}, {1})", "texture({0}, vec3({1}, {2}))"),
    "sample_bias": in_layers("texture({0}, {1}, {2})", "texture({0}, vec3({1}, {2}), {3})"),
    "sample_level": in_layers("textureLod({0}, {1}, {2})", "textureLod({0}, vec3({1}, {2}), {3})"),
    "sample_grad": in_layers(
        "textureGrad({0}, {1}, {2}, {3})", "textureGrad({0}, vec3({1}, {2}), {3}, {4})"
    ),
    "gather": in_layers("textureGather({0}, {1}, {2})", "textureGather({0}, vec3({1}, {2}), {3})"),
    # Arrays and cubes of depths have no `textureLod`; a gradient of zero means the same. Arrays of
    # cubes have neither, and their sampler stays at the first level.
    "compare": Read(
        "textureLod({0}, vec3({1}, {2}), 0.0)",
        "textureGrad({0}, vec4({1}, {2}, {3}), vec2(0.0), vec2(0.0))",
        {
            "depth_cube": "textureGrad({0}, vec4({1}, {2}), vec3(0.0), vec3(0.0))",
            "depth_cube_array": "texture({0}, vec4({1}, {2}), {3})",
        },
    ),
    "gather_compare": Read(
        "textureGather({0}, {1}, {2})", "textureGather({0}, vec3({1}, {2}), {3})"
    ),
    "load": Read(
        FETCH, FETCH_LAYER, {"depth2d": f"{FETCH}.x", "depth2d_array": f"{FETCH_LAYER}.x"}
    ),
    "texture_size": Read("textureSize({0}, {1})", "textureSize({0}, {1}).xy"),
    "texture_layers": "textureSize({0}, 0).z",
    "texture_levels": "textureQueryLevels({0})",
    "ddx": "dFdx",
    "ddy": "dFdy",
}
