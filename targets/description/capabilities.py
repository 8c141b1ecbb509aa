"""The table of capabilities: features of programs, the profiles that have them, and by which means.

A *capability* is something that programs may use and that not every profile has, such as a geometry
stage. Each is a row of ``CAPABILITIES``; which profiles have it follows from their own rows. So a
new profile fills its cells of the table by itself, and so does a new row.

Who reads it: ``legalise/lacks.py``, to name what a program uses and its profile has not got;
``availability.py``, for the way out that a message shows, and for ``burnish targets``; the page
``docs/targets.md``, which is made from it; and the tests, which hold each cell to what it claims.

To add a capability, add its row here, and to ``tests/targets/capability_probes.py`` a program that
needs it, with which all of its cells are tried.
"""

from __future__ import annotations

from ...compiler.ir.operations import OF_GROUPS
from ...compiler.ir.stages import (
    COMPUTE,
    CONTROL,
    EVALUATION,
    FRAGMENT,
    GEOMETRY,
    VERTEX,
    VIEW_INDEX,
    StageRow,
)
from ...compiler.ir.types import TextureType
from .capability import Capability, Need, Way, a_stage, lowering, some_builtins, words_for
from .profile import STORABLE, Profile


def buffers_of(row: StageRow) -> Need:
    """The need of storage buffers in a stage."""
    return Need(
        f"storage buffers in the {row.name} stage",
        lambda profile: profile.limits.buffers_of(row) > 0,
    )


SEPARATE_SAMPLERS = Need(
    "texture that is both compared and loaded", lambda profile: not profile.samplers.combined
)
STREAM_OUTPUT = Need("stream output", lambda profile: profile.stream_output is not None)
NUMBERED_CAPTURES = Need(
    "`vertex_index` where vertices are captured",
    lambda profile: profile.stream_output is None or profile.stream_output.indexed,
)
IMAGES = Need("images that kernels write", lambda profile: bool(profile.image_formats))
EDGES = Need("drawing of the edges of triangles", lambda profile: profile.draws_edges)
BLENDING_SWITCHED = Need(
    "blending of its own for each target", lambda profile: profile.blending != "alike"
)
BLENDING_APART = Need(
    "equation of its own for each blended target", lambda profile: profile.blending == "apart"
)
FLOATS_BLENDED = Need("blending of 32-bit floats", lambda profile: profile.blends_floats)
VERTEX_NUMBERS = Need(
    "`vertex_index`", lambda profile: "vertex_index" not in profile.without_inputs
)
INSTANCES = Need(
    "draws of instances", lambda profile: "instance_index" not in profile.without_inputs
)
MULTIVIEW = Need(
    "draws of several views", lambda profile: VIEW_INDEX.name not in profile.without_inputs
)
OF_INPUTS = {
    "vertex_index": VERTEX_NUMBERS, "instance_index": INSTANCES, VIEW_INDEX.name: MULTIVIEW,
}  # fmt: skip
"""The values of the pipeline that profiles may refuse, and the need of each."""
SEVERAL_TARGETS = Need("second render target", lambda profile: profile.limits.render_targets > 1)
OWN_DEPTHS = Need("depths of fragments", lambda profile: profile.fragment_depths)
BORDERS = Need("borders of textures", lambda profile: profile.borders)
INTEGER_ATTRIBUTES = Need("vertex inputs of integers", lambda profile: profile.integer_attributes)
FLAT_VALUES = Need("values of a single vertex at fragments", lambda profile: profile.flat_varyings)
RECTANGULAR_MATRICES = Need(
    "matrices that are not square", lambda profile: profile.rectangular_matrices
)
COMPUTED_PLACES = Need("places that are computed", lambda profile: profile.computed_indices)
WIDE_INTEGERS = Need(
    "integers of 32 bits",
    lambda profile: profile.wide_integers,
    frozenset(
        {
            "bit_and", "bit_not", "bit_or", "bit_xor", "bits_of", "count_bits", "first_leading_bit",
            "first_trailing_bit", "float_of_bits", "reverse_bits", "shift_left", "shift_right",
            "to_uint",
        }
    ),
)  # fmt: skip
SINGLE_FILE = Need("text that holds all stages", lambda profile: profile.single_file)


def a_texture(feature: str, type_: TextureType) -> Need:
    """The need of a type of textures."""
    return Need(feature, lambda profile: type_ in profile.textures)


DEPTH_TEXTURES = a_texture("textures of depths", TextureType("2d", "depth"))
INTEGER_TEXTURES = a_texture("textures of integers", TextureType("2d", "int"))
LAYERED_TEXTURES = a_texture("textures with layers", TextureType("2d_array"))
CUBE_ARRAYS = a_texture("arrays of cubes", TextureType("cube_array"))
VOLUMES = a_texture("textures of three dimensions", TextureType("3d"))


def feature_of_texture(type_: TextureType, profile: Profile) -> str:
    """The name of the missing feature, for a message, where a profile lacks a type of textures."""
    needs = {
        DEPTH_TEXTURES: type_.sample == "depth",
        INTEGER_TEXTURES: type_.sample in ("int", "uint"),
        CUBE_ARRAYS: type_.dimension == "cube_array",
        LAYERED_TEXTURES: type_.layered,
        VOLUMES: type_.dimension == "3d",
    }
    missing = (need for need, is_needed in needs.items() if is_needed and not need.is_met(profile))
    return next((need.feature for need in missing), f"`{type_}`")


BIT_COUNTS = ("count_bits", "reverse_bits", "first_leading_bit", "first_trailing_bit")

ELEMENTS_ELSEWHERE = (
    "keep the elements in an array of a known length, `param name : T[16]`, or load them from a "
    "texture"
)
DRAWN_APART = "draw the targets by several passes, each with one blending"
AS_PATTERNS = "each patch is drawn as an instance of a pattern"
AS_INSTANCES = "each primitive is drawn as an instance"
AS_DRAWS = "each view is a draw of its own"

BY_KERNEL = Way((a_stage(COMPUTE),), "a kernel captures the vertices")

VIEWS_AT_ONCE = Capability(
    "views",
    "A pass draws several views of a scene, each to a layer of its render targets: "
    "`views of 2`, with `view_index` in all stages. Where this is lowered, each view is a draw "
    "of its own.",
    (Way((MULTIVIEW,)), Way((a_stage(VERTEX), a_stage(FRAGMENT)), AS_DRAWS)),
    on_request=True,
)
CAPTURES = Capability(
    "captures",
    "Vertices are written to a buffer instead of being drawn: a pass with `capture name : T = …`.",
    (Way((STREAM_OUTPUT,)), BY_KERNEL),
    on_request=True,
)
CAPTURED_NUMBERS = Capability(
    "numbers of captured vertices",
    "Captured values depend on `vertex_index`.",
    (Way((STREAM_OUTPUT, NUMBERED_CAPTURES)), BY_KERNEL),
    "give the number as a vertex input: `attribute number : uint`",
    on_request=True,
)
EMITTED_CAPTURES = Capability(
    "captures of expansions",
    "Vertices of expanded primitives are captured: `capture` of a material with `expand`.",
    (Way((STREAM_OUTPUT, a_stage(GEOMETRY))), BY_KERNEL),
    "capture the vertices of the mesh as they are, and expand its primitives where they are drawn",
    on_request=True,
)
DIVIDED_CAPTURES = Capability(
    "captures of tessellations",
    "Vertices of divided patches are captured: `capture` of a material with `tessellate`.",
    (Way((STREAM_OUTPUT, a_stage(CONTROL), a_stage(EVALUATION))), BY_KERNEL),
    "capture the control points as they are, and divide the patches where they are drawn",
    on_request=True,
)

SOME_BLENDED = Capability(
    "blending by target",
    "Of the targets of a pass only some are blended, or each has other lanes that are written: "
    "`target a : rgba16f = x blend add`, `target b : r8 = y`.",
    (Way((SEVERAL_TARGETS, BLENDING_SWITCHED)),),
    DRAWN_APART,
)
BLENDED_APART = Capability(
    "equations by target",
    "The targets of a pass are blended by different equations: "
    "`target a : rgba16f = x blend add`, `target b : r8 = y blend multiply`.",
    (Way((SEVERAL_TARGETS, BLENDING_SWITCHED, BLENDING_APART)),),
    DRAWN_APART,
)
BLENDED_FLOATS = Capability(
    "blending of floats",
    "A target of 32-bit floats is blended: `target a : rgba32f = x blend add`. Frames, which "
    "hosts of all kinds draw, do not do that (`B0822`).",
    (Way((FLOATS_BLENDED,)),),
    "draw to a format of 16-bit floats",
)
GATHERED_COMPARISONS = Capability(
    "gathering comparisons",
    "The comparisons with the four texels around a place: `d.gather(uv, depth)`.",
    (Way((DEPTH_TEXTURES, some_builtins("gathering of comparisons", "gather_compare"))),),
    "compare at each of the four texels",
)
COMPARED_AND_LOADED = Capability(
    "comparing and loading",
    "A texture of depths is both compared with and read by `load`.",
    (Way((DEPTH_TEXTURES, SEPARATE_SAMPLERS)),),
    "declare a second `map` for one of the two",
)

CAPABILITIES: tuple[Capability, ...] = (
    Capability(
        "drawing",
        "Materials: the vertices of a mesh are computed, and the fragments of its triangles.",
        (Way((a_stage(VERTEX), a_stage(FRAGMENT))),),
    ),
    Capability(
        "derivatives",
        "Differences to the next pixel: `ddx`, `ddy`, and reads of textures that choose their "
        "level by them.",
        (Way((some_builtins("derivatives", "ddx", "ddy"),)),),
        "compute the difference yourself, and read textures with `.level(…)`",
    ),
    Capability(
        "depths of fragments",
        "A pass gives each fragment a depth of its own, in place of that of the face: "
        "`depth { value = 0.5 }`.",
        (Way((OWN_DEPTHS,)),),
        "move the vertices to the depth: `position = …`",
    ),
    Capability(
        "alpha to coverage",
        "The alpha of a fragment says how many samples it covers: "
        "`raster { samples = 4, alpha_to_coverage = true }`.",
        (Way((a_stage(FRAGMENT),)),),
    ),
    Capability(
        "expansions",
        "A primitive of the mesh becomes triangles or lines: `expand triangle { … }`.",
        (Way((a_stage(GEOMETRY),)), Way((INSTANCES,), AS_INSTANCES)),
        on_request=True,
    ),
    Capability(
        "tessellation",
        "A patch of the mesh is divided into triangles or lines: `tessellate triangle by 8 { … }`, "
        "`tessellate isoline by 8 lines 4 { … }`.",
        (Way((a_stage(CONTROL), a_stage(EVALUATION))), Way((INSTANCES,), AS_PATTERNS)),
        on_request=True,
    ),
    Capability(
        "expansions with adjacency",
        "A primitive of the mesh becomes others that depend on its neighbours: "
        "`expand triangle_adjacency { … }`.",
        (Way((a_stage(GEOMETRY),)), Way((INSTANCES,), AS_INSTANCES)),
        on_request=True,
    ),
    Capability(
        "layers",
        "A pass draws to several layers of its render targets: `layers of 6`. Where this is "
        "lowered, each layer is a draw of its own.",
        (Way((a_stage(GEOMETRY),)), Way((INSTANCES,), AS_INSTANCES)),
        on_request=True,
    ),
    VIEWS_AT_ONCE,
    CAPTURES,
    EMITTED_CAPTURES,
    DIVIDED_CAPTURES,
    CAPTURED_NUMBERS,
    Capability(
        "kernels over buffers",
        "The elements of storage buffers are computed: `kernel` with `result name : T[count] = …`.",
        (Way((a_stage(COMPUTE), buffers_of(COMPUTE))),),
    ),
    Capability(
        "scatter",
        "The invocations of a kernel join integers with elements that they choose, by atomics: "
        "`scatter name : uint[count] add value at place`.",
        (Way((a_stage(COMPUTE), buffers_of(COMPUTE))),),
    ),
    Capability(
        "joined work groups",
        "The invocations of a kernel join their values, one work group at a time: `group_sum(x)` "
        "and its like.",
        (
            Way(
                (
                    a_stage(COMPUTE),
                    buffers_of(COMPUTE),
                    some_builtins("work-group memory", *sorted(OF_GROUPS)),
                )
            ),
        ),
    ),
    Capability(
        "kernels over images",
        "Texels of images are computed: `kernel` with `result name : image2d<format>[size] = …`. "
        "By their own means profiles write at most four images, of the formats "
        f"{', '.join(f'`{name}`' for name in sorted(STORABLE))}.",
        (
            Way((a_stage(COMPUTE), IMAGES)),
            Way((VERTEX_NUMBERS,), "the kernel is drawn as a full-screen pass"),
        ),
    ),
    Capability(
        "edges",
        "A pass draws the edges of triangles instead of them: `raster { fill = lines }`.",
        (Way((EDGES,)),),
        "have the material turn its triangles into lines: "
        "`expand triangle { line of 4 as i like corner[i mod 3] {} }`",
    ),
    Capability(
        "several targets",
        "A pass writes more than one render target: `target a : rgba8 = x`, `target b : r8 = y`.",
        (Way((SEVERAL_TARGETS,)),),
        "draw them by several passes",
    ),
    SOME_BLENDED,
    BLENDED_APART,
    BLENDED_FLOATS,
    Capability(
        "storage buffers at fragments",
        "A parameter has as many elements as the host binds, `buffer name : T[]`, and fragments "
        "read them.",
        (Way((buffers_of(FRAGMENT),)),),
        ELEMENTS_ELSEWHERE,
    ),
    Capability(
        "storage buffers at vertices",
        "Likewise, and what is computed for each vertex reads them, such as its position.",
        (Way((buffers_of(VERTEX),)),),
        ELEMENTS_ELSEWHERE,
    ),
    Capability(
        "gathering texels",
        "One channel of the four texels around a place: `t.gather(uv, 0)`.",
        (Way((some_builtins("gathering of texels", "gather"),)),),
        "`load` each of the four",
    ),
    Capability(
        "textures of depths",
        "A texture of depths is compared with: `map d : depth2d`, `d(uv, depth)`.",
        (Way((DEPTH_TEXTURES,)),),
        "have depths in a `texture2d`, and compare with what is read",
    ),
    GATHERED_COMPARISONS,
    Capability(
        "number of levels",
        "The number of levels of a texture: `t.levels()`, and `t.load(texel, level)`, which asks "
        "for it unless the level is 0.",
        (Way((some_builtins("way to tell how many levels a texture has", "texture_levels"),)),),
        "read level 0, which all have, or filter with `.level(…)`",
    ),
    Capability(
        "levels of textures",
        "A read says at which level, or by which gradients: `t.level(uv, 2)`, `t.grad(uv, a, b)`.",
        (Way((some_builtins("reads of levels that are said", "sample_level", "sample_grad"),)),),
        "read `t(uv)`, where all pixels do so",
    ),
    Capability(
        "biased levels",
        "A read adds a number to the level that follows from the pixels around: `t.bias(uv, 1)`.",
        (Way((some_builtins("reads of biased levels", "sample_bias"),)),),
        "scale the coordinate's gradients: `t.grad(uv, a, b)`",
    ),
    Capability(
        "loading texels",
        "A texel is read by its numbers: `t.load(texel)`.",
        (Way((some_builtins("loading of texels", "load"),)),),
        "read the middle of the texel, `t(uv)`",
    ),
    Capability(
        "sizes of textures",
        "The width and height of a texture: `t.size()`.",
        (Way((some_builtins("way to tell the size of a texture", "texture_size"),)),),
        "declare a parameter that tells it, `param size : vec2`",
    ),
    Capability(
        "textures with layers",
        "A texture has layers: `map t : texture2d_array`.",
        (Way((LAYERED_TEXTURES,)),),
        "put the layers beside each other in one `texture2d`",
    ),
    Capability(
        "arrays of cubes",
        "A texture has several cubes: `map t : texture_cube_array`. Vulkan has them where the "
        "device's feature `imageCubeArray` is, and WebGPU but for its compatibility mode.",
        (Way((CUBE_ARRAYS,)),),
        "declare a `texture_cube` for each of them, and choose between what is read: "
        "`if place == 0 then a(d) else b(d)`",
    ),
    Capability(
        "textures of three dimensions",
        "A texture has three dimensions: `map t : texture3d`.",
        (Way((VOLUMES,)),),
        "put its slices beside each other in one `texture2d`",
    ),
    Capability(
        "textures of integers",
        "A texture has whole numbers: `map t : itexture2d`, `map t : utexture2d`.",
        (Way((INTEGER_TEXTURES,)),),
        "have the numbers in a `texture2d`",
    ),
    COMPARED_AND_LOADED,
    Capability(
        "borders",
        "Beyond the edges of a texture there is one colour: "
        "`map t : texture2d with { wrap = border, border = black }`.",
        (Way((BORDERS,)),),
        "have the colour in the outermost texels of the picture, and `wrap = clamp`",
    ),
    Capability(
        "integers of 32 bits",
        "Integers without a sign, and what depends on bits: `uint`, `a & b`, `a << 2`, "
        "`bits_of(x)`. A profile without them has integers up to 65 535 that may be floats.",
        (Way((WIDE_INTEGERS,)),),
        "compute with `int` or `float`",
    ),
    Capability(
        "vertex inputs of integers",
        "A mesh supplies integers: `attribute bone : int`.",
        (Way((INTEGER_ATTRIBUTES,)),),
        "declare it as `float`",
    ),
    Capability(
        "values of a single vertex",
        "Fragments read what one vertex of their triangle has, and not a mean of all: this is how "
        "integers and bools get to them.",
        (Way((FLAT_VALUES,)),),
        "let floats cross, which are interpolated",
    ),
    Capability(
        "matrices that are not square",
        "A matrix has more columns than rows, or fewer: `mat3x2`. A profile without these still "
        "multiplies those of its uniforms by vectors, and reads their columns.",
        (Way((RECTANGULAR_MATRICES,)),),
        "keep the columns as vectors",
    ),
    Capability(
        "computed places",
        "The place of an element or a lane is any integer: `weights[int(9 * uv.x)]`. A profile "
        "without this takes constants, and the numbers of turns of loops.",
        (Way((COMPUTED_PLACES,)),),
        "look for the place in a loop: `sum(w[i] for i in 0..9 where i == place)`",
    ),
    Capability(
        "numbers of vertices",
        "The numbers that the pipeline counts: `vertex_index`.",
        (Way((VERTEX_NUMBERS,)),),
        "give the number as a vertex input: `attribute number : float`",
    ),
    Capability(
        "instances",
        "A mesh is drawn several times by one draw: `instance_index`, "
        "`attribute place : vec3 per instance`.",
        (Way((INSTANCES,)),),
        "draw each by a draw of its own, with what differs as a parameter `per draw`",
    ),
    Capability(
        "counting bits",
        f"Questions about the bits of a number: {', '.join(f'`{name}`' for name in BIT_COUNTS)}.",
        (
            Way((WIDE_INTEGERS, words_for("word for each of these", *BIT_COUNTS))),
            Way(
                (WIDE_INTEGERS,),
                "a function in the text computes what the language has no word for",
            ),
        ),
        "compute with `int` or `float`",
    ),
    Capability(
        "single file",
        "All stages stand in one text: the option `--single-file`.",
        (Way((SINGLE_FILE,)),),
        "leave `--single-file` out, so that each stage has a text of its own",
    ),
)
"""The rows, in the order in which people see them."""


def lacking(feature: str) -> Capability | None:
    """The capability that a profile has not got by its own means if it lacks a feature."""
    found = (row for row in CAPABILITIES for need in row.ways[0].needs if need.feature == feature)
    return next(found, None)


def feature_of_builtin(name: str) -> str:
    """The name of the missing feature where a profile has neither a builtin nor a replacement."""
    needs = (need for row in CAPABILITIES for way in row.ways for need in way.needs)
    return next((need.feature for need in needs if name in need.builtins), f"`{name}`")


def without_native_stages(capability: Capability | None, profile: Profile) -> str:
    """The advice not to ask for a profile's own stages; empty if nothing else could be done."""
    instead = capability and lowering(capability, profile)
    return f"without `--native-stages`, {instead.how}" if instead else ""
