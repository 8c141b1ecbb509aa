"""WGSL, for WebGPU."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path

from ...compiler.ir.kernel import ScatterOperator
from ...compiler.ir.stages import COMPUTED, ENTRY_POINTS, RASTERISED
from ...compiler.ir.types import BOOL, UINT, VEC4, Vector
from ...stdlib.builtins.facts import Fact
from ...stdlib.builtins.row import Domain
from ..description.forms import Forms
from ..description.profile import STORABLE, Limits, Profile
from ..description.reserved import read_reserved
from ..description.shading_language import STAGE_STRUCTS, Language
from ..description.spellings import (
    PipelineInput,
    Read,
    Spelling,
    Spellings,
    TextureNames,
    TypeNames,
)

FOLDER = Path(__file__).parent

TYPES = TypeNames(
    scalars={"float": "f32", "int": "i32", "uint": "u32", "bool": "bool"},
    vectors={"float": "vec{n}f", "int": "vec{n}i", "uint": "vec{n}u", "bool": "vec{n}<bool>"},
    matrix="mat{n}x{n}f",
    rectangular_matrix="mat{columns}x{rows}f",
    array="array<{element}, {count}>",
    declaration="{name}: {type}",
)

FORMS = Forms(
    let="let {name} = {value};",
    function="fn {name}({parameters}) -> {type} {{",
    member_end=",",
    struct_end="}",
    variable="var {typed};",
    variable_set="var {typed} = {value};",
    loop="for (var {index_typed} = {zero}; {index} < {count}; {index}++) {{",
    loop_while="for (var {index_typed} = {zero}; {index} < {count} && {going:and}; {index}++) {{",
    select="select({otherwise}, {then}, {condition})",
    member="{block}.{name}",
    input="input.{name}",
    store_texel="textureStore({name}, {place}, {value});",
    atomic="atomic<{type}>",
    scatter="{function}(&{place}, {value});",
    shared="var<workgroup> {typed};",
    barrier="workgroupBarrier();",
)

TEXTURES = TextureNames(
    dimensions={
        "2d": "2d",
        "2d_array": "2d_array",
        "3d": "3d",
        "cube": "cube",
        "cube_array": "cube_array",
    },
    textures={
        "float": "texture_{dimension}<f32>",
        "depth": "texture_depth_{dimension}",
        "int": "texture_{dimension}<i32>",
        "uint": "texture_{dimension}<u32>",
    },
    samplers={"filtering": "sampler", "comparison": "sampler_comparison"},
)

IMAGES: Mapping[str, str] = {
    "r32f": "texture_storage_2d<r32float, write>",
    "rgba8": "texture_storage_2d<rgba8unorm, write>",
    "rgba16f": "texture_storage_2d<rgba16float, write>",
    "rgba32f": "texture_storage_2d<rgba32float, write>",
}

NATIVES: Spellings = {
    "neg": Spelling(matrix="(-1.0 * {0:p})"),
    "inversesqrt": "inverseSqrt",
    "faceforward": "faceForward",
    "and": Spelling(vectors="&"),
    "or": Spelling(vectors="|"),
    "bits_of": "bitcast<{type}>({0})",
    "float_of_bits": "bitcast<{type}>({0})",
    "count_bits": "{type}(countOneBits({0}))",
    "reverse_bits": "reverseBits",
    "first_leading_bit": "{type}(firstLeadingBit({0}))",
    "first_trailing_bit": "{type}(firstTrailingBit({0}))",
    "to_float": "{type}({0})",
    "to_int": "{type}({0})",
    "to_uint": "{type}({0})",
    "sample": Read("textureSample({0}, {sampler}, {1})", "textureSample({0}, {sampler}, {1}, {2})"),
    "sample_bias": Read(
        "textureSampleBias({0}, {sampler}, {1}, {2})",
        "textureSampleBias({0}, {sampler}, {1}, {2}, {3})",
    ),
    "sample_level": Read(
        "textureSampleLevel({0}, {sampler}, {1}, {2})",
        "textureSampleLevel({0}, {sampler}, {1}, {2}, {3})",
    ),
    "sample_grad": Read(
        "textureSampleGrad({0}, {sampler}, {1}, {2}, {3})",
        "textureSampleGrad({0}, {sampler}, {1}, {2}, {3}, {4})",
    ),
    "gather": Read(
        "textureGather({2}, {0}, {sampler}, {1})", "textureGather({3}, {0}, {sampler}, {1}, {2})"
    ),
    "compare": Read(
        "textureSampleCompareLevel({0}, {sampler}, {1}, {2})",
        "textureSampleCompareLevel({0}, {sampler}, {1}, {2}, {3})",
    ),
    "gather_compare": Read(
        "textureGatherCompare({0}, {sampler}, {1}, {2})",
        "textureGatherCompare({0}, {sampler}, {1}, {2}, {3})",
    ),
    "load": "textureLoad",
    "texture_size": "{type}(textureDimensions({0}, {1}))",
    "texture_layers": "i32(textureNumLayers({0}))",
    "texture_levels": "i32(textureNumLevels({0}))",
    "ddx": "dpdx",
    "ddy": "dpdy",
}

INPUTS = {
    "frag_coord": PipelineInput(VEC4, "input.{name}", "@builtin(position)"),
    "front_facing": PipelineInput(BOOL, "input.{name}", "@builtin(front_facing)"),
    "vertex_index": PipelineInput(UINT, "input.{name}", "@builtin(vertex_index)"),
    "instance_index": PipelineInput(UINT, "input.{name}", "@builtin(instance_index)"),
    "index": PipelineInput(Vector("uint", 3), "input.{name}", "@builtin(global_invocation_id)"),
    "texel": PipelineInput(Vector("uint", 3), "input.{name}", "@builtin(global_invocation_id)"),
}


def divides(facts: tuple[Fact, ...]) -> bool:
    """True for integers, whatever the divisor.

    A constant 0 is an error; but constants need no profile.
    """
    dividend, divisor = facts
    return dividend.kind != "float" or divisor.excludes_zero


def leaves_remainder(facts: tuple[Fact, ...]) -> bool:
    """True for a `uint`; the remainder of an `int` has the sign of the dividend."""
    dividend, divisor = facts
    if dividend.kind == "uint":
        return True
    return dividend.kind == "int" and dividend.lo >= 0 and divisor.lo >= 1


AGREES: Mapping[str, Domain] = {
    "div": divides,
    "mod": leaves_remainder,
}
"""WGSL defines what other languages leave open of integers. (It does so of shifts by 32 and more,
too; but the SPIR-V that naga makes of them leaves it open again.)"""

WEBGPU = Profile(
    name="webgpu",
    stages=(*RASTERISED, *COMPUTED),
    image_formats=STORABLE,
    doc="WGSL as browsers and wgpu take it.",
    agrees=AGREES,
    draws_edges=False,
    blends_floats=False,
    borders=False,
    # naga knows `@builtin(view_index)`, but the standard does not, and neither do browsers.
    without_inputs=frozenset({"view_index"}),
    single_file=True,
    # Tint accepts 127 nested statements; each loop and each branch counts as two.
    # Every device has 16 textures and samplers in a stage (WebGPU, 3.6.2 "Limits"). Of browsers,
    # 48 textures at most are reported, and no more samplers; Chromium on SwiftShader offers 16.
    limits=Limits(
        nested_blocks=62,
        groups=4,
        bindings=1000,
        block_bytes=65536,
        work_group=256,
        asked_textures=48,
    ),
    limit_names={
        "textures": "maxSampledTexturesPerShaderStage",
        "samplers": "maxSamplersPerShaderStage",
    },
    checkers=("naga", "tint"),
)

ATOMICS: Mapping[ScatterOperator, str] = {
    "add": "atomicAdd",
    "min": "atomicMin",
    "max": "atomicMax",
    "and": "atomicAnd",
    "or": "atomicOr",
}

LANGUAGE = Language(
    name="wgsl",
    title="WGSL",
    skeleton=FOLDER / "shader.wgsl.j2",
    extension="wgsl",
    types=TYPES,
    textures=TEXTURES,
    images=IMAGES,
    forms=FORMS,
    atomics=ATOMICS,
    natives=NATIVES,
    splats=frozenset(
        {"clamp", "max", "min", "pow", "shift_left", "shift_right", "smoothstep", "step"}
    ),
    inputs=INPUTS,
    profiles=(WEBGPU,),
    reserved=partial(read_reserved, FOLDER / "reserved.txt", "__", "_$"),
    global_members=False,
    fixed_names=("main", *ENTRY_POINTS, *STAGE_STRUCTS),
)
