"""HLSL for Shader Model 6, as DXC takes it."""

from __future__ import annotations

import re
from collections.abc import Mapping
from functools import partial
from pathlib import Path

from ...compiler.ir.kernel import ScatterOperator
from ...compiler.ir.stages import COMPUTED, CONTROL, ENTRY_POINTS, EVALUATION, EXPANDED
from ...compiler.ir.tessellation import Patch, Spacing
from ...compiler.ir.types import BOOL, UINT, VEC2, VEC3, VEC4, Dimension, Matrix, Type, Vector
from ...stdlib.builtins.facts import Fact
from ...stdlib.builtins.row import Domain, everywhere
from ..description.forms import Forms
from ..description.profile import STORABLE, Limits, Profile, StreamOutput
from ..description.reserved import read_reserved
from ..description.shading_language import STAGE_STRUCTS, FieldRole, Language
from ..description.spellings import (
    Literals,
    PipelineInput,
    Read,
    Spelling,
    Spellings,
    TextureNames,
    TypeNames,
)

FOLDER = Path(__file__).parent

TYPES = TypeNames(
    scalars={"float": "float", "int": "int", "uint": "uint", "bool": "bool"},
    vectors={"float": "float{n}", "int": "int{n}", "uint": "uint{n}", "bool": "bool{n}"},
    matrix="float{n}x{n}",
    rectangular_matrix="float{rows}x{columns}",
    stored_matrix="column_major {type}",
)

# DXC treats a choice between two plain literals as a double, or an integer of 64 bits, and warns
# that it does not know how wide a shifted one is.
LITERALS = Literals(typed={"float": "{0}f", "int": "int({0})"})

# A constructor takes rows and an index yields a row; Burnish's matrices are made of columns.
FORMS = Forms(
    splat="{value:p}.{lanes}",
    splat_constant=False,
    matrix="transpose({transposed}({columns}))",
    matrix_by_rows=True,
    product_of_columns="mul({vector}, {transposed}({columns}))",
    array="{{{elements}}}",
    # DXC takes an array that is a copy of a whole block for the block itself, and then reads a
    # member of that at a computed place, which SPIR-V has not got.
    array_of_block=False,
    constant_array="static const {typed} = {value};",
    column="transpose({matrix:p})[{position}]",
    input="input.{name}",
    corner="input[{corner}].{name}",
    deliver="output.{name} = {value};",
    deliver_position="output.clip_position = {value};",
    position="output.clip_position",
    deliver_layer="output.target_layer = uint({value});",
    emit_vertex="stream.Append(output);",
    end_strip="stream.RestartStrip();",
    of_patch="patch.{name}",
    edge_level="edge_levels[{number}]",
    inner_level="inner_levels[{number}]",
    store_texel="{name}[{place}] = {value};",
    shared="groupshared {typed};",
    barrier="GroupMemoryBarrierWithGroupSync();",
    lane_words=("Red", "Green", "Blue", "Alpha"),
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
        "float": "Texture{dimension}<float4>",
        "depth": "Texture{dimension}<float>",
        "int": "Texture{dimension}<int4>",
        "uint": "Texture{dimension}<uint4>",
    },
    samplers={"filtering": "SamplerState", "comparison": "SamplerComparisonState"},
)


def in_layers(plain: str, layered: str) -> Read:
    """A read whose layer is the last lane of the coordinate, behind two lanes or a direction."""
    of_cubes = layered.replace("float3({1}, {2})", "float4({1}, {2})")
    return Read(plain, layered, dict.fromkeys(("texture_cube_array", "depth_cube_array"), of_cubes))


IMAGES: Mapping[str, str] = {
    **dict.fromkeys(STORABLE, "RWTexture2D<float4>"),
    "rgba8": "RWTexture2D<unorm float4>",
}

_CAST = "(({type}){0:p})"
"""The conversion of a vector that has just been converted: DXC drops both of `float2(int2(v))`
where it makes SPIR-V."""

NATIVES: Spellings = {
    "mul": Spelling(matrix="mul"),
    "sign": "{type}(sign({0}))",
    "fract": "frac",
    "mix": "lerp",
    "inversesqrt": "rsqrt",
    "fma": "mad",
    "and": Spelling(vectors="{type}(uint{lanes}({0}) & uint{lanes}({1}))"),
    "or": Spelling(vectors="{type}(uint{lanes}({0}) | uint{lanes}({1}))"),
    "bits_of": "asuint",
    "float_of_bits": "asfloat",
    "count_bits": "{type}(countbits({0}))",
    "reverse_bits": "{type}(reversebits({0}))",
    "first_leading_bit": "{type}(firstbithigh({0}))",
    "first_trailing_bit": "{type}(firstbitlow({0}))",
    "to_float": Spelling(usual="{type}({0})", after={"to_int": _CAST, "to_uint": _CAST}),
    # DXC takes `uint2(int2(v))` for `uint2(v)`, also where `v` is negative.
    "to_int": Spelling(usual="{type}({0})", integers="asint({0})", after={"to_float": _CAST}),
    "to_uint": Spelling(usual="{type}({0})", integers="asuint({0})", after={"to_float": _CAST}),
    "sample": in_layers("{0}.Sample({sampler}, {1})", "{0}.Sample({sampler}, float3({1}, {2}))"),
    "sample_bias": in_layers(
        "{0}.SampleBias({sampler}, {1}, {2})", "{0}.SampleBias({sampler}, float3({1}, {2}), {3})"
    ),
    "sample_level": in_layers(
        "{0}.SampleLevel({sampler}, {1}, {2})", "{0}.SampleLevel({sampler}, float3({1}, {2}), {3})"
    ),
    "sample_grad": in_layers(
        "{0}.SampleGrad({sampler}, {1}, {2}, {3})",
        "{0}.SampleGrad({sampler}, float3({1}, {2}), {3}, {4})",
    ),
    "gather": in_layers(
        "{0}.Gather{lane}({sampler}, {1})", "{0}.Gather{lane}({sampler}, float3({1}, {2}))"
    ),
    "compare": in_layers(
        "{0}.SampleCmpLevelZero({sampler}, {1}, {2})",
        "{0}.SampleCmpLevelZero({sampler}, float3({1}, {2}), {3})",
    ),
    # Without an offset behind it, glslang takes the reference for a bias.
    "gather_compare": Read(
        "{0}.GatherCmp({sampler}, {1}, {2}, int2(0, 0))",
        "{0}.GatherCmp({sampler}, float3({1}, {2}), {3}, int2(0, 0))",
    ),
    "load": Read(
        "{0}.Load(int3({1}, {2}))",
        "{0}.Load(int4({1}, {2}, {3}))",
        dict.fromkeys(("texture3d", "itexture3d", "utexture3d"), "{0}.Load(int4({1}, {2}))"),
    ),
    "texture_size": "texture_size({0}, {1})",
    "texture_layers": "texture_layers({0})",
    "texture_levels": "texture_levels({0})",
}

COUNTS: Mapping[Dimension, tuple[str, str]] = {
    "2d": ("width, height", "int2(width, height)"),
    "2d_array": ("width, height, layers", "int2(width, height)"),
    "3d": ("width, height, depth", "int3(width, height, depth)"),
    "cube": ("width, height", "int2(width, height)"),
    "cube_array": ("width, height, layers", "int2(width, height)"),
}
"""The results of `GetDimensions` before the levels, and the size that is made of them."""


def asking(head: str, level: str, answer: str) -> Mapping[Dimension, str]:
    """A function that calls `GetDimensions`, which is no expression, for each dimension."""
    return {
        dimension: f"{head} {{{{\n"
        f"    uint {counts}, levels;\n"
        f"    texels.GetDimensions({level}, {counts}, levels);\n"
        f"    return {answer or size};\n"
        "}}"
        for dimension, (counts, size) in COUNTS.items()
    }


HELPERS = {
    "texture_size": {
        **asking("int2 texture_size({texture} texels, int level)", "level", ""),
        "3d": asking("int3 texture_size({texture} texels, int level)", "level", "")["3d"],
    },
    "texture_layers": asking("int texture_layers({texture} texels)", "0", "int(layers)"),
    "texture_levels": asking("int texture_levels({texture} texels)", "0", "int(levels)"),
}

INPUTS = {
    # Direct3D's w is the reciprocal of the other APIs'.
    "frag_coord": PipelineInput(
        VEC4, "float4(input.{name}.xyz, 1.0 / input.{name}.w)", "SV_Position"
    ),
    "front_facing": PipelineInput(BOOL, "input.{name}", "SV_IsFrontFace"),
    "vertex_index": PipelineInput(UINT, "input.{name}", "SV_VertexID"),
    "instance_index": PipelineInput(UINT, "input.{name}", "SV_InstanceID"),
    # Shader Model 6.1 has it, and glslang from version 14 on.
    "view_index": PipelineInput(
        UINT, "input.{name}", "SV_ViewID", unknown_to=frozenset({"glslang-hlsl"})
    ),
    "index": PipelineInput(UINT, "input.{name}", "SV_DispatchThreadID"),
    "texel": PipelineInput(Vector("uint", 2), "input.{name}", "SV_DispatchThreadID"),
    "primitive_index": PipelineInput(UINT, "{name}", "SV_PrimitiveID"),
    "patch_weights": PipelineInput(VEC3, "{name}", "SV_DomainLocation"),
    "patch_coordinate": PipelineInput(VEC2, "{name}", "SV_DomainLocation"),
    "patch_index": PipelineInput(UINT, "{name}", "SV_PrimitiveID"),
}

EMITTED = {"point": "PointStream", "line": "LineStream", "triangle": "TriangleStream"}

PRIMITIVES = {
    "point": "point",
    "line": "line",
    "triangle": "triangle",
    "line_adjacency": "lineadj",
    "triangle_adjacency": "triangleadj",
}
PATCHES: Mapping[Patch, str] = {"triangle": "tri", "quad": "quad", "isoline": "isoline"}
SPACINGS: Mapping[Spacing, str] = {
    "equal": "integer",
    "fractional_even": "fractional_even",
    "fractional_odd": "fractional_odd",
}


LONGEST_SEMANTIC = 54
"""The length at which semantics are cut: Direct3D takes 64 characters. Cut names are told apart by
their location."""


NEVER_NAMES = (
    # The scalar types with a number of lanes, or of rows and columns: `dword4`, `min10float1`.
    "(bool|dword|half|float|double|u?int|min1[026](float|int|uint)|u?int(16|32|64)_t|float(16|32|64)_t)"
    "[1-4](x[1-4])?$",
    # The macros of glslang, which reads HLSL as well.
    "GL_",
)
"""Patterns of words that the compilers take for something else."""


MACRO = re.compile("__|GL_|VULKAN$")
"""Semantics that a compiler would replace."""


def semantic(role: FieldRole, name: str, location: int) -> str:
    """The semantic by which a host or the next stage finds a field.

    An attribute has its own name in capitals, with trailing digits as the index: ``texcoord1`` is
    ``TEXCOORD1``, and a matrix's column ``bend.1`` is ``BEND_COLUMN1``. System values cannot be
    attributes, so that prefix is kept apart. Where the capitals could be a macro of a compiler,
    ``__LINE__`` or ``GL_ES``, something is added.
    """
    if role in ("varying", "control point", "of patch"):
        return f"TEXCOORD{location}"
    if role == "render target":
        return f"SV_Target{location}"
    word = name.upper().replace(".", "_COLUMN")
    if len(word) > LONGEST_SEMANTIC or MACRO.match(word):
        word = f"{word[:40]}_AT{location}_"
    return f"ATTRIBUTE_{word}" if re.match("SV_", word) else word


def is_unsigned(facts: tuple[Fact, ...]) -> bool:
    """True if the first operand is a `uint`."""
    return facts[0].kind == "uint"


AGREES: Mapping[str, Domain] = {
    # DXC takes the `int` for a `uint`.
    "first_leading_bit": is_unsigned,
    # The lowest five bits of the amount count, be it an `int` or a `uint`.
    "shift_left": everywhere,
    "shift_right": everywhere,
}


def gives_rectangle(types: tuple[Type, ...]) -> bool:
    """True for a product of matrices that is not square.

    DXC writes a matrix of columns as the transpose of one of rows. Where both factors are such,
    Mesa's Vulkan drivers take the product for one of another shape, and refuse the shader.
    """
    match types:
        case Matrix(rows=rows), Matrix(columns=columns):
            return rows != columns
        case _:
            return False


SM6 = Profile(
    name="sm6",
    stages=(*EXPANDED, CONTROL, EVALUATION, *COMPUTED),
    patch_winding="cw",
    image_formats=STORABLE,
    stream_output=StreamOutput("semantics"),
    doc="Shader Model 6.0 for Direct3D 12, or for Vulkan through DXC; 6.1 for several views in one "
    "draw.",
    single_file=True,
    agrees=AGREES,
    mistakes={"mul": gives_rectangle},
    # A stage has 128 shader resource views and 16 samplers with resource binding tier 1 of Direct3D
    # 12, the lowest one (Microsoft, "Hardware tiers"). Storage buffers are such views, too.
    limits=Limits(
        varyings=31, block_bytes=65536, work_group=1024, shared_bytes=32768, textures=120
    ),
    checkers=("dxc-dxil", "dxc-spirv", "glslang-hlsl"),
)

ATOMICS: Mapping[ScatterOperator, str] = {
    "add": "InterlockedAdd",
    "min": "InterlockedMin",
    "max": "InterlockedMax",
    "and": "InterlockedAnd",
    "or": "InterlockedOr",
}

LANGUAGE = Language(
    name="hlsl",
    registers={
        "block": "b{binding}",
        "buffer": "t{binding}",
        "written": "u{binding}",
        "image": "u{binding}",
        "texture": "t{binding}",
        "sampler": "s{binding}",
    },
    line_directive='#line {line} "{name}"',
    title="HLSL",
    skeleton=FOLDER / "shader.hlsl.j2",
    extension="hlsl",
    types=TYPES,
    textures=TEXTURES,
    images=IMAGES,
    helpers=HELPERS,
    literals=LITERALS,
    forms=FORMS,
    atomics=ATOMICS,
    natives=NATIVES,
    inputs=INPUTS,
    primitives=PRIMITIVES,
    patches=PATCHES,
    spacings=SPACINGS,
    emitted=EMITTED,
    semantic=semantic,
    profiles=(SM6,),
    reserved=partial(read_reserved, FOLDER / "reserved.txt", *NEVER_NAMES),
    fixed_names=(*HELPERS, "main", *ENTRY_POINTS, *STAGE_STRUCTS),
)
