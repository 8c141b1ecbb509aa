"""GLSL: for Vulkan, for OpenGL 3.3 and 4.5, and for OpenGL ES 3.0 (and WebGL 2) and 3.1.

``spellings.py`` has its words for types and builtins, and ``es100.py`` the profile for OpenGL ES
2.0 and WebGL 1, which is written otherwise.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import partial
from pathlib import Path

from ...compiler.ir.kernel import ScatterOperator
from ...compiler.ir.stages import COMPUTED, CONTROL, EVALUATION, EXPANDED, RASTERISED
from ...compiler.ir.tessellation import Patch, Spacing
from ...compiler.ir.types import BOOL, INT, VEC3, VEC4, Vector
from ...compiler.ir.types import TEXTURES as TEXTURE_TYPES
from ...stdlib.builtins.facts import Fact
from ...stdlib.builtins.row import Domain
from ..description.forms import Forms
from ..description.profile import (
    STORABLE,
    Framebuffer,
    Limits,
    Profile,
    Samplers,
    StreamOutput,
)
from ..description.reserved import read_reserved
from ..description.shading_language import Language
from ..description.spellings import PipelineInput
from .es100 import es100
from .spellings import NATIVES, TEXTURES, TYPES

FOLDER = Path(__file__).parent

INPUTS = {
    "frag_coord": PipelineInput(VEC4, "gl_FragCoord"),
    "front_facing": PipelineInput(BOOL, "gl_FrontFacing"),
    "vertex_index": PipelineInput(INT, "gl_VertexID"),
    "instance_index": PipelineInput(INT, "gl_InstanceID"),
    "view_index": PipelineInput(
        INT, "gl_ViewIndex", requires="#extension GL_EXT_multiview : require"
    ),
    "index": PipelineInput(Vector("uint", 3), "gl_GlobalInvocationID"),
    "texel": PipelineInput(Vector("uint", 3), "gl_GlobalInvocationID"),
    "primitive_index": PipelineInput(INT, "gl_PrimitiveIDIn"),
    "patch_weights": PipelineInput(VEC3, "gl_TessCoord"),
    "patch_coordinate": PipelineInput(VEC3, "gl_TessCoord"),
    "patch_index": PipelineInput(INT, "gl_PrimitiveID"),
}

FORMS = Forms(
    deliver_position="gl_Position = {value};",
    position="gl_Position",
    deliver_layer="gl_Layer = {value};",
    store_texel="imageStore({name}, {place}, {value});",
    shared="shared {typed};",
    # In GLSL, a barrier also orders shared memory; but Mesa's OpenGL moves reads across it.
    barrier="memoryBarrierShared(); barrier();",
    emit_vertex="EmitVertex();",
    end_strip="EndPrimitive();",
    edge_level="gl_TessLevelOuter[{number}]",
    inner_level="gl_TessLevelInner[{number}]",
)

EMITTED = {"point": "points", "line": "line_strip", "triangle": "triangle_strip"}

ATOMICS: Mapping[ScatterOperator, str] = {
    "add": "atomicAdd",
    "min": "atomicMin",
    "max": "atomicMax",
    "and": "atomicAnd",
    "or": "atomicOr",
}

PRIMITIVES = {
    "point": "points",
    "line": "lines",
    "triangle": "triangles",
    "line_adjacency": "lines_adjacency",
    "triangle_adjacency": "triangles_adjacency",
}

PATCHES: Mapping[Patch, str] = {"triangle": "triangles", "quad": "quads", "isoline": "isolines"}
SPACINGS: Mapping[Spacing, str] = {
    "equal": "equal_spacing",
    "fractional_even": "fractional_even_spacing",
    "fractional_odd": "fractional_odd_spacing",
}

FRAG_COORD_FROM_TOP = PipelineInput(
    VEC4,
    "vec4(gl_FragCoord.x, viewport_height - gl_FragCoord.y, gl_FragCoord.zw)",
    host_uniform="viewport_height",
)


def is_float(facts: tuple[Fact, ...]) -> bool:
    """True if the operands are floats."""
    return facts[0].kind == "float"


AGREES: Mapping[str, Domain] = {"dot": is_float}
"""GLSL has no inner product of integers."""

COUNTS = frozenset({"count_bits", "first_leading_bit", "first_trailing_bit"})
"""Builtins that came with GLSL 4.00 and ES 3.10. In ES the results are ``lowp``: a device may
compute ``1000 * bitCount(x)`` in nine bits."""

LACKS = COUNTS | {"reverse_bits"}
"""All builtins that came with GLSL 4.00 and ES 3.10; ``reverse_bits`` is ``highp`` in ES."""

WITHOUT_FMA = {"fma": "({0:p} * {1:p} + {2:p})"}

DOWNWARDS = {"ddy": "(-dFdy({0}))"}
"""The spelling of ``ddy`` where rows count upwards, as then ``dFdy`` does, too."""

VULKAN = Profile(
    name="vulkan",
    can_combine_samplers=True,
    stages=(*EXPANDED, CONTROL, EVALUATION, *COMPUTED),
    image_formats=STORABLE,
    stream_output=StreamOutput("text"),
    doc="GLSL 4.50 for Vulkan: separate textures and samplers, everything placed explicitly.",
    framebuffer=Framebuffer(clip_y_down=True),
    patch_winding="cw",
    preamble=("#version 450",),
    # Every device has 16 textures and samplers in a stage (Vulkan, "Required Limits"). Those of the
    # milestone Roadmap 2022 have 200 textures, and 200 resources of all kinds.
    limits=Limits(
        groups=4,
        vertex_buffers=4,
        fragment_buffers=4,
        kernel_buffers=4,
        asked_textures=128,
        push_constant_bytes=128,
    ),
    limit_names={
        "textures": "maxPerStageDescriptorSampledImages",
        "samplers": "maxPerStageDescriptorSamplers",
    },
    agrees=AGREES,
    samplers=Samplers(joined="{type}({texture}, {sampler})"),
    requires=dict.fromkeys(
        ("load", "texture_size", "texture_layers", "texture_levels"),
        "#extension GL_EXT_samplerless_texture_functions : require",
    ),
    inputs={
        "vertex_index": PipelineInput(INT, "gl_VertexIndex"),
        "instance_index": PipelineInput(INT, "gl_InstanceIndex"),
    },
    blends_floats=False,
    checkers=("glslang-vulkan",),
)

ONE_VIEW = frozenset({"view_index"})
"""The input of several views at once, of which only Vulkan's GLSL is certain to know."""

NO_LEVELS = frozenset({"texture_levels"})
"""The builtin that came with GLSL 4.30; no version of ES has it."""

CANNOT = NO_LEVELS | {"gather", "gather_compare"}
"""``textureGather`` came with GLSL 4.00 and ES 3.10."""

TEXTURE_UNITS = {"textures": "GL_MAX_TEXTURE_IMAGE_UNITS"}
"""OpenGL's name of the limit. It is at least 16, in ES since 3.0; a host cannot ask for more."""

BOTTOM_FIRST = Framebuffer(
    clip_depth="-1..1",
    rows_up=True,
    inputs={"frag_coord": FRAG_COORD_FROM_TOP},
    natives=DOWNWARDS,
)

NO_CUBE_ARRAYS = frozenset(each for each in TEXTURE_TYPES if each.dimension != "cube_array")
"""The types of textures before GLSL 4.00 and ES 3.20, which brought arrays of cubes."""

OPENGL = Profile(
    name="gl330",
    doc="GLSL 3.30 core: combined samplers, blocks and samplers bound by name.",
    preamble=("#version 330 core",),
    stages=EXPANDED,
    stream_output=StreamOutput("names"),
    # Blend equations for each target came with OpenGL 4.0.
    blending="switched",
    explicit_bindings=False,
    samplers=Samplers(combined=True),
    framebuffer=BOTTOM_FIRST,
    limits=Limits(varyings=15, vertex_buffers=0, fragment_buffers=0, kernel_buffers=0),
    varyings_by_name=True,
    invariant_inputs=True,
    natives=WITHOUT_FMA,
    lacks=LACKS,
    agrees=AGREES,
    cannot=CANNOT,
    textures=NO_CUBE_ARRAYS,
    limit_names=TEXTURE_UNITS,
    without_inputs=ONE_VIEW,
    checkers=("glslang-gl330",),
)

OPENGL_4 = Profile(
    name="gl450",
    stages=(*EXPANDED, CONTROL, EVALUATION, *COMPUTED),
    image_formats=STORABLE,
    doc="GLSL 4.50 core for OpenGL 4.5: combined samplers, everything placed explicitly, and the "
    "clip space of `glClipControl`.",
    stream_output=StreamOutput("text"),
    preamble=("#version 450 core",),
    numbering="kind",
    numbers_storage_apart=True,
    samplers=Samplers(combined=True),
    framebuffer=Framebuffer(clip_control=("GL_UPPER_LEFT", "GL_ZERO_TO_ONE")),
    # Only fragments and kernels are guaranteed to have storage buffers.
    limits=Limits(
        varyings=15,
        vertex_buffers=0,
        work_group=1024,
        shared_bytes=32768,
        numbers={"block": 84, "buffer": 8, "texture": 96},
    ),
    agrees=AGREES,
    limit_names=TEXTURE_UNITS,
    without_inputs=ONE_VIEW,
    checkers=("glslang-gl450",),
)

ES_PRECISIONS = (
    "precision highp float;",
    "precision highp int;",
    "precision highp sampler2D;",
)
ES_SAMPLERS = Samplers(combined=True, precision="precision highp {type};")

ES = Profile(
    name="es300",
    doc="GLSL ES 3.00 for OpenGL ES 3.0 and WebGL 2: like gl330, with precisions.",
    stream_output=StreamOutput("names", indexed=False),
    preamble=("#version 300 es", *ES_PRECISIONS),
    explicit_bindings=False,
    draws_edges=False,
    links_without_fragments=False,
    blending="alike",
    blends_floats=False,
    borders=False,
    samplers=ES_SAMPLERS,
    framebuffer=BOTTOM_FIRST,
    limits=Limits(varyings=15, vertex_buffers=0, fragment_buffers=0, kernel_buffers=0),
    varyings_by_name=True,
    natives=WITHOUT_FMA,
    lacks=LACKS,
    agrees=AGREES,
    cannot=CANNOT,
    textures=NO_CUBE_ARRAYS,
    limit_names=TEXTURE_UNITS,
    without_inputs=ONE_VIEW,
    checkers=("glslang-es300",),
)

ES_31 = Profile(
    name="es310",
    stages=(*RASTERISED, *COMPUTED),
    image_formats=STORABLE,
    doc="GLSL ES 3.10 for OpenGL ES 3.1: like es300, but everything placed explicitly.",
    stream_output=StreamOutput("names", indexed=False),
    preamble=("#version 310 es", *ES_PRECISIONS),
    numbering="kind",
    numbers_storage_apart=True,
    draws_edges=False,
    links_without_fragments=False,
    blending="alike",
    blends_floats=False,
    borders=False,
    samplers=ES_SAMPLERS,
    framebuffer=BOTTOM_FIRST,
    # Only kernels are guaranteed to have storage buffers.
    limits=Limits(
        varyings=15,
        vertex_buffers=0,
        fragment_buffers=0,
        kernel_buffers=4,
        numbers={"block": 36, "buffer": 4, "texture": 96},
    ),
    natives=WITHOUT_FMA,
    lacks=COUNTS,
    agrees=AGREES,
    cannot=NO_LEVELS,
    textures=NO_CUBE_ARRAYS,
    limit_names=TEXTURE_UNITS,
    without_inputs=ONE_VIEW,
    checkers=("glslang-es310",),
)

ES_2 = es100(BOTTOM_FIRST)

OF_EXTENSIONS = (
    # The types of numbers, vectors and matrices that say how many bits they have.
    "(float(16|32|64)|u?int(8|16|32|64))_t$",
    "(f(16|32|64)|[iu](8|16|32|64))vec[2-4]$",
    "f(16|32|64)mat[2-4](x[2-4])?$",
    "f16(sampler|image|texture|subpassInput)",
    # Words of vendors' extensions, and those without a vendor's suffix.
    r"\w+(AMD|ARB|EXT|KHR|NV|QCOM)$",
    "coopmat$|nonprivate$|(device|queuefamily|workgroup|subgroup|shadercall)coherent$|spirv_",
)
"""Patterns of words that glslang knows whatever the version of a text: it takes each for the type
or the qualifier where a structure of that name is meant."""

LANGUAGE = Language(
    name="glsl",
    title="GLSL",
    skeleton=FOLDER / "shader.glsl.j2",
    extension="glsl",
    types=TYPES,
    textures=TEXTURES,
    images=dict.fromkeys(STORABLE, "image2D"),
    forms=FORMS,
    natives=NATIVES,
    primitives=PRIMITIVES,
    patches=PATCHES,
    spacings=SPACINGS,
    emitted=EMITTED,
    atomics=ATOMICS,
    splats=frozenset({"mod", "pow"}),
    inputs=INPUTS,
    profiles=(VULKAN, OPENGL, OPENGL_4, ES, ES_31, ES_2),
    reserved=partial(read_reserved, FOLDER / "reserved.txt", "gl_", "GL_", ".*__", *OF_EXTENSIONS),
    buffer_blocks=True,
    global_fields=True,
    varying_prefix="v_",
    point_prefix="p_",
    output_prefix="out_",
    fixed_names=("main",),
    line_directive="#line {line} {number}",
)
