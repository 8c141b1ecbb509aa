"""The Metal Shading Language, version 2.

Apple's compiler, which runs on Apple's systems only, has never compiled one of these texts. What is
checked is that clang accepts every text against declarations of Metal's types and functions
(``metal_stdlib.h``), which were written from Apple's specification. Nobody would notice a mistake
in reading that specification. So this language is not among those that are written by default, and
Burnish says so to whoever chooses it.

What a host has to know: blocks, textures and samplers are numbered each on their own, and a buffer
of vertices must not take a number that the reflection gives to a block. Fast maths, which Apple's
compiler has on by default, must be off, so that comparisons with infinity mean what they say; the
texts and the documents tell users so.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path

from ...compiler.ir.kernel import ScatterOperator
from ...compiler.ir.stages import COMPUTED, ENTRY_POINTS, RASTERISED
from ...compiler.ir.types import BOOL, UINT, VEC4, Dimension, Vector
from ...stdlib.builtins.facts import Fact
from ..description.forms import Forms
from ..description.profile import STORABLE, Limits, Profile
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

# A vector of three lanes takes 16 bytes, but for a packed one, which would start anywhere.
TYPES = TypeNames(
    scalars={"float": "float", "int": "int", "uint": "uint", "bool": "bool"},
    vectors={"float": "float{n}", "int": "int{n}", "uint": "uint{n}", "bool": "bool{n}"},
    matrix="float{n}x{n}",
    rectangular_matrix="float{columns}x{rows}",
    array="array<{element}, {count}>",
    stored={
        "vec3": "alignas(16) packed_float3",
        "ivec3": "alignas(16) packed_int3",
        "uvec3": "alignas(16) packed_uint3",
    },
)

FORMS = Forms(
    let="const {typed} = {value};",
    array="{type}{{{elements}}}",
    member="{block}.{name}",
    stored="{type}({value})",
    input="input.{name}",
    discard="discard_fragment();",
    lane_words=("component::x", "component::y", "component::z", "component::w"),
    block_argument="constant {type}& {name}",
    buffer_argument="device const {type}* {name}",
    written_argument="device {type}* {name}",
    store_texel="{name}.write({value}, uint2({place}));",
    atomic="atomic_{type}",
    scatter="{function}(&{place}, {value}, memory_order_relaxed);",
    shared="threadgroup {typed};",
    shared_argument="threadgroup {type}& {name}",
    barrier="threadgroup_barrier(mem_flags::mem_threadgroup);",
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
        "float": "texture{dimension}<float>",
        "depth": "depth{dimension}<float>",
        "int": "texture{dimension}<int>",
        "uint": "texture{dimension}<uint>",
    },
    samplers={"filtering": "sampler", "comparison": "sampler"},
)

LAYER = "uint(max({2}, 0))"
"""A layer is a ``uint``; one below 0 means the first."""

GRADIENTS = {"texture3d": "gradient3d", "texture_cube": "gradientcube"}

PLACE, LEVEL = "uint2({1})", "uint({2})"


def precisely(*names: str) -> Mapping[str, str]:
    """Functions for which the compiler's options would else choose a faster, less precise one."""
    return {name: f"precise::{name}" for name in names}


NATIVES: Spellings = {
    **precisely(
        "sin",
        "cos",
        "tan",
        "asin",
        "acos",
        "atan",
        "atan2",
        "sinh",
        "cosh",
        "tanh",
        "exp",
        "exp2",
        "log",
        "log2",
        "pow",
        "sqrt",
    ),
    "inversesqrt": "precise::rsqrt",
    "neg": Spelling(matrix="(-1.0f * {0:p})"),
    "sign": Spelling(integers="clamp({0}, {type}(-1), {type}(1))"),
    "round": "rint",
    "radians": "({0:p} * 0.017453292f)",
    "degrees": "({0:p} * 57.29578f)",
    "shift_left": Spelling(vectors="({0:p} << {type}({1}))"),
    "shift_right": Spelling(vectors="({0:p} >> {type}({1}))"),
    "bits_of": "as_type<{type}>({0})",
    "float_of_bits": "as_type<{type}>({0})",
    "count_bits": "{type}(popcount({0}))",
    "to_float": "{type}({0})",
    "to_int": "{type}({0})",
    "to_uint": "{type}({0})",
    "sample": Read("{0}.sample({sampler}, {1})", f"{{0}}.sample({{sampler}}, {{1}}, {LAYER})"),
    "sample_bias": Read(
        "{0}.sample({sampler}, {1}, bias({2}))",
        f"{{0}}.sample({{sampler}}, {{1}}, {LAYER}, bias({{3}}))",
    ),
    "sample_level": Read(
        "{0}.sample({sampler}, {1}, level({2}))",
        f"{{0}}.sample({{sampler}}, {{1}}, {LAYER}, level({{3}}))",
    ),
    "sample_grad": Read(
        "{0}.sample({sampler}, {1}, gradient2d({2}, {3}))",
        f"{{0}}.sample({{sampler}}, {{1}}, {LAYER}, gradient2d({{3}}, {{4}}))",
        {
            texture: f"{{0}}.sample({{sampler}}, {{1}}, {gradient}({{2}}, {{3}}))"
            for texture, gradient in GRADIENTS.items()
        }
        | {
            "texture_cube_array": f"{{0}}.sample({{sampler}}, {{1}}, {LAYER}, "
            "gradientcube({3}, {4}))"
        },
    ),
    "gather": Read(
        "{0}.gather({sampler}, {1}, int2(0), {lane})",
        f"{{0}}.gather({{sampler}}, {{1}}, {LAYER}, int2(0), {{lane}})",
        {
            "texture_cube": "{0}.gather({sampler}, {1}, {lane})",
            "texture_cube_array": f"{{0}}.gather({{sampler}}, {{1}}, {LAYER}, {{lane}})",
        },
    ),
    "compare": Read(
        "{0}.sample_compare({sampler}, {1}, {2}, level(0.0f))",
        f"{{0}}.sample_compare({{sampler}}, {{1}}, {LAYER}, {{3}}, level(0.0f))",
    ),
    "gather_compare": Read(
        "{0}.gather_compare({sampler}, {1}, {2})",
        f"{{0}}.gather_compare({{sampler}}, {{1}}, {LAYER}, {{3}})",
    ),
    "load": Read(
        f"{{0}}.read({PLACE}, {LEVEL})",
        f"{{0}}.read({PLACE}, {LEVEL}, uint({{3}}))",
        dict.fromkeys(
            ("texture3d", "itexture3d", "utexture3d"), f"{{0}}.read(uint3({{1}}), {LEVEL})"
        ),
    ),
    "texture_size": "texture_size({0}, {1})",
    "texture_layers": "int({0}.get_array_size())",
    "texture_levels": "int({0}.get_num_mip_levels())",
    "ddx": "dfdx",
    "ddy": "dfdy",
}

EXTENTS: Mapping[Dimension, tuple[str, ...]] = {
    "2d": ("width", "height"),
    "2d_array": ("width", "height"),
    "3d": ("width", "height", "depth"),
    "cube": ("width", "height"),
    "cube_array": ("width", "height"),
}


def size_of(dimension: Dimension) -> str:
    """A function that asks a texture for each of its extents."""
    extents = EXTENTS[dimension]
    size = f"int{len(extents)}"
    asked = ", ".join(f"int(texels.get_{extent}(uint(level)))" for extent in extents)
    head = f"{size} texture_size({{texture}} texels, int level)"
    return f"{head} {{{{\n    return {size}({asked});\n}}}}"


HELPERS = {"texture_size": {dimension: size_of(dimension) for dimension in EXTENTS}}

INPUTS = {
    "frag_coord": PipelineInput(VEC4, "{name}", "position"),
    "front_facing": PipelineInput(BOOL, "{name}", "front_facing"),
    "vertex_index": PipelineInput(UINT, "{name}", "vertex_id"),
    "instance_index": PipelineInput(UINT, "{name}", "instance_id"),
    "index": PipelineInput(UINT, "{name}", "thread_position_in_grid"),
    "texel": PipelineInput(Vector("uint", 2), "{name}", "thread_position_in_grid"),
}


def semantic(role: FieldRole, _name: str, location: int) -> str:
    """The attribute by which a host or the next stage finds a field."""
    words = {
        "attribute": "attribute({})",
        "varying": "user(location{})",
        "render target": "color({})",
    }
    return words[role].format(location)


def is_float(facts: tuple[Fact, ...]) -> bool:
    """True if the first operand has floats."""
    return facts[0].kind == "float"


METAL2 = Profile(
    blends_floats=False,
    name="metal2",
    stages=(*RASTERISED, *COMPUTED),
    image_formats=STORABLE,
    doc="Metal 2, to be compiled without fast maths; never compiled by Apple's compiler.",
    preamble=(
        "// Never compiled by Apple's compiler: only type-checked by clang.",
        "// Compile it without fast maths (-fno-fast-math), which would do away with infinities.",
        "#include <metal_stdlib>",
        "using namespace metal;",
    ),
    # Metal amplifies vertices instead: a stage says how often, and sends each to a layer.
    without_inputs=frozenset({"view_index"}),
    single_file=True,
    numbering="kind",
    lacks=frozenset({"first_leading_bit", "first_trailing_bit"}),
    agrees={"dot": is_float},
    # The argument tables of every device have 31 textures and 16 samplers (Apple, "Metal Feature
    # Set Tables").
    limits=Limits(
        varyings=15,
        attributes=31,
        block_bytes=65536,
        work_group=512,
        textures=31,
        numbers={"block": 31, "texture": 31, "sampler": 16},
    ),
    checkers=("clang-msl",),
)

ATOMICS: Mapping[ScatterOperator, str] = {
    "add": "atomic_fetch_add_explicit",
    "min": "atomic_fetch_min_explicit",
    "max": "atomic_fetch_max_explicit",
    "and": "atomic_fetch_and_explicit",
    "or": "atomic_fetch_or_explicit",
}

LANGUAGE = Language(
    name="msl",
    title="Metal Shading Language",
    skeleton=FOLDER / "shader.metal.j2",
    extension="metal",
    unproven="never compiled by Apple's compiler, only type-checked by clang",
    entry_point="{entry}",
    types=TYPES,
    textures=TEXTURES,
    images=dict.fromkeys(STORABLE, "texture2d<float, access::write>"),
    literals=Literals(float_suffix="f"),
    helpers=HELPERS,
    forms=FORMS,
    atomics=ATOMICS,
    natives=NATIVES,
    splats=frozenset(
        {"clamp", "max", "min", "mix", "pow", "step", "smoothstep", "shift_left", "shift_right"}
    ),
    inputs=INPUTS,
    semantic=semantic,
    registers={
        "block": "buffer({binding})",
        "buffer": "buffer({binding})",
        "written": "buffer({binding})",
        "image": "texture({binding})",
        "texture": "texture({binding})",
        "sampler": "sampler({binding})",
    },
    profiles=(METAL2,),
    reserved=partial(read_reserved, FOLDER / "reserved.txt", "__", "_[A-Z]"),
    global_members=False,
    resource_arguments=True,
    line_directive='#line {line} "{name}"',
    fixed_names=(*HELPERS, *ENTRY_POINTS, *STAGE_STRUCTS),
)
