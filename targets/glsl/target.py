"""GLSL: for Vulkan, for OpenGL 3.3, and for OpenGL ES 3.0 and WebGL 2."""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path

from ...compiler.ir.types import BOOL, INT, VEC4
from ..emit.description import PipelineInput, Profile, Spelling, Target, TypeNames
from ..emit.reserved import read_reserved

FOLDER = Path(__file__).parent

TYPES = TypeNames(
    scalars={"float": "float", "int": "int", "uint": "uint", "bool": "bool"},
    vectors={"float": "vec{n}", "int": "ivec{n}", "uint": "uvec{n}", "bool": "bvec{n}"},
    matrix="mat{n}",
    tall_matrix="mat{n}x4",
)

NATIVES: Mapping[str, str | Spelling] = {
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
    "sample": "texture",
    "ddx": "dFdx",
    "ddy": "dFdy",
}

INPUTS = {
    "frag_coord": PipelineInput(VEC4, "gl_FragCoord"),
    "front_facing": PipelineInput(BOOL, "gl_FrontFacing"),
    "vertex_index": PipelineInput(INT, "gl_VertexID"),
    "instance_index": PipelineInput(INT, "gl_InstanceID"),
}

FRAG_COORD_FROM_TOP = PipelineInput(
    VEC4,
    "vec4(gl_FragCoord.x, viewport_height - gl_FragCoord.y, gl_FragCoord.zw)",
    host_uniform="viewport_height",
)

LACKS = frozenset({"count_bits", "reverse_bits", "first_leading_bit", "first_trailing_bit"})
"""What came with GLSL 4.00 and ES 3.10."""

WITHOUT_FMA = {"fma": "({0:p} * {1:p} + {2:p})"}

DOWNWARDS = {"ddy": "(-dFdy({0}))"}
"""Where rows count upwards, so does ``dFdy``."""

VULKAN = Profile(
    name="vulkan",
    doc="GLSL 4.50 for Vulkan: separate textures and samplers, everything placed explicitly.",
    clip_y_down=True,
    preamble=("#version 450",),
    texture="sampler2D({texture}, {sampler})",
    inputs={
        "vertex_index": PipelineInput(INT, "gl_VertexIndex"),
        "instance_index": PipelineInput(INT, "gl_InstanceIndex"),
    },
    checkers=("glslang-vulkan",),
)

OPENGL = Profile(
    name="gl330",
    doc="GLSL 3.30 core: combined samplers, blocks and samplers bound by name.",
    preamble=("#version 330 core",),
    combined_samplers=True,
    explicit_bindings=False,
    varyings_by_name=True,
    clip_depth="-1..1",
    natives=WITHOUT_FMA,
    lacks=LACKS,
    rows_up=True,
    varyings=15,
    inputs_rows_up={"frag_coord": FRAG_COORD_FROM_TOP},
    natives_rows_up=DOWNWARDS,
    checkers=("glslang-gl330",),
)

ES = Profile(
    name="es300",
    doc="GLSL ES 3.00 for OpenGL ES 3.0 and WebGL 2: like gl330, with precisions.",
    preamble=(
        "#version 300 es",
        "precision highp float;",
        "precision highp int;",
        "precision highp sampler2D;",
    ),
    combined_samplers=True,
    explicit_bindings=False,
    varyings_by_name=True,
    clip_depth="-1..1",
    natives=WITHOUT_FMA,
    lacks=LACKS,
    rows_up=True,
    varyings=15,
    inputs_rows_up={"frag_coord": FRAG_COORD_FROM_TOP},
    natives_rows_up=DOWNWARDS,
    checkers=("glslang-es300",),
)

TARGET = Target(
    name="glsl",
    title="GLSL",
    folder=FOLDER,
    template="shader.glsl.j2",
    extension="glsl",
    types=TYPES,
    natives=NATIVES,
    splats=frozenset({"mod", "pow"}),
    inputs=INPUTS,
    profiles=(VULKAN, OPENGL, ES),
    reserved=partial(read_reserved, FOLDER / "reserved.txt", "gl_", ".*__"),
    global_fields=True,
    varying_prefix="v_",
    output_prefix="out_",
    fixed_names=("main", "viewport_height"),
    line_directive="#line {line} {number}",
)
