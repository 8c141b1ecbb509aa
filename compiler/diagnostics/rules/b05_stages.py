"""B05: stages and rates, kernels, expansions, captures and tessellations."""

from __future__ import annotations

from .row import error, warning

UNKNOWN_RATE = error(
    "B0501",
    "unknown stage `{name}`",
    "`@vertex e` computes `e` at the vertices and interpolates it.",
)
NOT_AT_VERTEX = error(
    "B0502",
    "{what} is not available at the vertex",
    "Texture reads and derivatives compare neighbouring pixels, and `frag_coord` and "
    "`front_facing` belong to a pixel. Move them out of `@vertex`, and out of what "
    "`clip_position` and captures are computed from.",
)
CANNOT_CROSS = error(
    "B0503",
    "a {type} cannot be interpolated from the vertex to the fragment stage",
    "Numbers and vectors of numbers can be interpolated, and so can the columns of a matrix, one "
    "by one. A mesh gives a bool as a `uint`.",
)
NO_CLIP_POSITION = error(
    "B0504",
    "`{name}` does not say where vertices go",
    "A pass, or the material it draws, defines `clip_position`, a vec4 in clip space.",
)
NO_TARGET = error(
    "B0505",
    "`{name}` writes nothing",
    "A pass has a target, `target color : rgba8 = vec4(color, alpha)`, or it writes depths or "
    "stencil values, as it does unless `depth { write = false }` stands there.",
)

NO_ALPHA = error(
    "B0506",
    "blending `{blend}` needs an alpha, and `{format}` has none",
    "`alpha` and `premultiplied` mix by the fourth lane of what is written. A target of fewer "
    "lanes can be added or multiplied.",
)
FACTOR_IGNORED = error(
    "B0507",
    "`{operation}` has no factors",
    "The smaller or the larger of two numbers is kept as it is, in all APIs: `source` and "
    "`destination` mean nothing for it. Multiply what the target is given instead.",
)
NO_DEPTH = error(
    "B0508",
    "a depth lies between 0 and 1, and this is {depth}",
    "0 is nearest, and 1 as far away as can be: `clear { depth = 1 }`.",
)
UNSEEN = warning(
    "B0509",
    "nothing reads `{name}`, as `{pass_}` has no target",
    "A pass without targets writes depths and stencil values only. One that shows something has a "
    "target, `target color : rgba8 = vec4(color, alpha)`, or extends a pass that has one.",
)

# Kernels

NO_RESULT = error(
    "B0510",
    "`{name}` computes nothing",
    "A kernel has at least one result, whose elements it computes, or it scatters: "
    "`result after : Particle[before.count] = moved(before[index])`, "
    "`scatter bins : uint[256] add 1u at bin`.",
)
NO_EXTENT = error(
    "B0511",
    "`{name}` does not tell its {what}",
    "Write it in brackets in the type of a result: `float[before.count]`, `uint[256]`, "
    "`image2d<rgba8>[source.size()]`.",
)
EXTENT_VARIES = error(
    "B0512",
    "the {what} of `{name}` is not known to the host",
    "The host computes it from constants, parameters, the counts of buffers and the sizes of "
    "textures, without loops.",
)
EXTENTS_DIFFER = error(
    "B0513",
    "`{name}` has another {what} than {first}",
    "Every invocation of a kernel computes one element, or one texel, of each result. Write a "
    "second kernel for what is longer or larger.",
)
NOT_WRITABLE = error(
    "B0514",
    "a kernel cannot write elements of the type {type}",
    "Numbers, vectors, matrices and structures of these can be written; a matrix or an array of "
    "structures inside of a structure cannot.",
)
NOT_IN_KERNEL = error(
    "B0515",
    "{what} is not available in a kernel",
    "Derivatives, and reads of textures without a level, compare neighbouring pixels. A kernel "
    "reads `name.level(coordinate, 0)` or `name.load(texel)`. It has no vertices either, at which "
    "`@vertex e` could be computed.",
)
WORK_GROUP_SIDES = error(
    "B0516",
    "this work group has {sides} sides, and the results have {dimensions} dimension",
    "A kernel over buffers counts its elements by one number, so its work groups have one side: "
    "`work_group of 128`.",
)
WORK_GROUP_SIZE = error(
    "B0517",
    "a work group has 1 to {most} invocations, and not {size}",
    "Each side is at least 1, and the product of all sides is the number of invocations. Some "
    "profiles take fewer, and say so when they are compiled for.",
)

NOT_SCATTERED = error(
    "B0518",
    "`{name}` cannot be scattered: its elements are of the type {type}",
    "Only `int` and `uint` come out the same in whatever order invocations add them: count in "
    "fixed-point steps, or sum by a fold.",
)

# Expansions

WITHIN_STRIP = error(
    "B0519",
    "this differs between the vertices of a strip, which is there as a whole or not at all",
    "The condition of a group may depend on the number of the strip, on `primitive_index` and on "
    "values at corners with a number that is the same for all of the strip's vertices.",
)
NO_SUCH_CORNER = error(
    "B0520",
    "there is no {what} {index}: the last one is {last}",
    "Corners are numbered from 0: a point has one, a line two and a triangle three. With adjacency "
    "a line has four and a triangle six. A patch has as many as it has control points, and each of "
    "its edges has two ends.",
)
WHICH_CORNER = error(
    "B0521",
    "`{name}` of which {what}?",
    "`corner[0].position` is the position of the first corner of the primitive that is expanded.",
)
OF_WHICH_CORNER = error(
    "B0522",
    "this differs between the corners of a primitive",
    "The number of strips, the condition to emit them, and the corner that they are like are "
    "computed once for each primitive. Say which corner is meant: `corner[0].position`.",
)
LIKE_WHICH_CORNER = error(
    "B0523",
    "which corner are {count} vertices like? a {primitive} has {corners}",
    "Values that an emitted vertex does not define are those of a corner of the primitive. If "
    "there are no more vertices than corners, it is the corner with the vertex's number. "
    "Otherwise name it: `strip of 4 as i like corner[i mod 3] { … }`.",
)
NO_TRIANGLES = error(
    "B0524",
    "a {shape} of {count} vertices is no whole number of triangles",
    "A strip has three vertices or more, and a list a multiple of three.",
)
NO_STRIPS = error(
    "B0525",
    "this expansion emits nothing",
    "Say what a primitive turns into: `expand point { strip of 4 as i { position = … } }`.",
)
EXPANDS_TOO_FAR = error(
    "B0526",
    "a primitive would turn into {count} vertices, and {most} is the most",
    "Let ranges say more closely how many strips there are, or expand a finer mesh by less.",
)
TWO_EXPANSIONS = error(
    "B0527",
    "`{name}` expands its primitives twice",
    "A record has one expansion, with as many groups of strips as it needs. Two mixins that each "
    "have one cannot be combined.",
)
NOT_SO_MANY_LAYERS = error(
    "B0528",
    "render targets have 1 to {most} layers, and not {count}",
    "`layers of 6` says how many layers each render target of a pass has. More than 256 are not "
    "guaranteed to exist.",
)
NO_LAYER = error(
    "B0529",
    "`{name}` draws into layers, but nothing says into which",
    "An expansion of the pass or of its material says to which layer a strip is drawn: it sets "
    "their slot `layer : int`. The nearest layer counts.",
)
LAYER_WITHIN_STRIP = error(
    "B0530",
    "vertices of one strip have different layers",
    "A strip is drawn to one layer, so `layer` may depend on the strip's number, on "
    "`primitive_index` and on values at corners with a number that is the same for all of the "
    "strip's vertices.",
)

# Work groups

NO_WORK_GROUP = error(
    "B0531",
    "{what} has no work groups, so there is no `{name}`",
    "The invocations of a kernel over buffers run together in work groups: only there values can "
    "be joined.",
)
COUNT_PER_GROUP = error(
    "B0532",
    "`{name}` has as many elements as there are work groups, and not a number of its own",
    "Write `T[] per group`: the host computes the number from that of the invocations, and from "
    "how large the work groups are.",
)
IMAGE_PER_GROUP = error(
    "B0533",
    "`{name}` is an image, which has a texel for each invocation",
    "A result for each work group is an element of a buffer: `result name : vec4[] per group = …`.",
)

# Views

NOT_SO_MANY_VIEWS = error(
    "B0534",
    "a pass draws 1 to {most} views, and not {count}",
    "`views of 2` says how many views of a scene a pass draws at once. Direct3D has no more than 4 "
    "of them.",
)
ONE_VIEW = error(
    "B0535",
    "`{name}` draws one view, so there is no `view_index`",
    "A pass that draws several views says how many: `views of 2`. Then each of its targets has a "
    "layer for each view, and `view_index` is the number of the view that is drawn. What belongs "
    "to materials may read it under any pass: it is 0 where there is one view.",
)

# Scattering

IMPOSSIBLE_SETTING = error(
    "B0536",
    "`{name}` is {value}, and only {possible} are possible",
    "Stencil values and their masks have eight bits. A bias is counted in the smallest steps of "
    "depths, of which floats have 2^24 between two powers of two. Every API draws with 1 or 4 "
    "samples for each pixel, and not every one with another number.",
)
ONE_SAMPLE = error(
    "B0537",
    "`{name}` has one sample for each pixel: {reason}",
    "Samples are joined to their mean at the end. Not every API can do that with floats of 32 "
    "bits or with layers that are drawn at once, and with several samples each API draws lines by "
    "rules of its own.",
)
NO_COVERAGE = error(
    "B0538",
    "`{name}` has no coverage that alpha could say: {reason}",
    "With `alpha_to_coverage`, the alpha of the first target says how many of a pixel's samples a "
    "fragment covers. So there are several samples, and that target has an alpha.",
)
VIEWS_AND_LAYERS = error(
    "B0539",
    "`{name}` has layers, and views have layers of their own",
    "The layers of a target are those that strips choose, `layers of 6`, or one for each view, "
    "`views of 2`. Draw the views by several passes if each of them has layers.",
)
NO_KERNEL_EXTENT = error(
    "B0540",
    "`{name}` does not say for how many elements it runs",
    "A result with an element for each invocation would say it. Other kernels say it by a member "
    "of their own: `runs over pixels.count`.",
)
WRITTEN_TWICE = error(
    "B0541",
    "`{name}` is both a result and scattered",
    "Each buffer is written in one way. Scatter to a buffer of its own.",
)
NO_SUCH_ELEMENT = error(
    "B0542",
    "there is no element {index} of `{name}`",
    "Elements are numbered from 0, and the number in brackets behind the type says how many there "
    "are.",
)
NEVER_POSITIVE = error(
    "B0543",
    "the {what} of `{name}` is {found}",
    "A kernel computes at least one element. The size has to be above 0, at least for some values "
    "of the parameters.",
)

# Kernels over images

MIXED_RESULTS = error(
    "B0550",
    "`{name}` is {kind}, and the first result is {first}",
    "An invocation computes an element by its number, or a texel by its place. Write a second "
    "kernel.",
)
NO_FORMAT = error(
    "B0551",
    "`{name}` does not say of which format its texels are",
    "An image has one format, as a render target has: `image2d<rgba16f>[size]`.",
)

# Captures

CAPTURES_AND_DRAWS = error(
    "B0560",
    "`{name}` captures vertices, so it draws nothing",
    "A pass that captures has no render targets, no layers of them, no views, no `raster` and no "
    "`depth`, and discards nothing. Draw in another pass.",
)
CANNOT_CAPTURE = error(
    "B0561",
    "a {type} cannot be captured",
    "Floats, ints, uints and vectors of these can be captured. Capture a bool as `if b then 1u "
    "else 0u`, and a matrix column by column.",
)
CAPTURES_TOO_MUCH = error(
    "B0562",
    "{count} numbers of each vertex are captured, and {most} is the most",
    "Every device captures so many numbers of a vertex: a vec3 has three.",
)
POINTS_NOT_CAPTURED = error(
    "B0563",
    "points are captured, and `{name}` draws",
    "A pass with members such as `capture place : vec3 = position` captures points. Drawing needs "
    "triangles or lines: `strip of 4 as i { … }` makes a square of a point.",
)
DIFFERENT_PRIMITIVES = error(
    "B0564",
    "an expansion emits points, lines or triangles, and only one of these",
    "All groups of an expansion are `points`, or all are `line`s, or all are strips and lists of "
    "triangles.",
)
NO_POINTS = error(
    "B0565",
    "a group of {count} points emits nothing",
    "`points of n` emits one point or more.",
)

# Tessellations

TWO_TESSELLATIONS = error(
    "B0571",
    "`{name}` divides its patches twice",
    "A material has one tessellation. Two mixins that each have one cannot be combined.",
)
WRONG_POINTS = error(
    "B0573",
    "`{patch}` patches have from {least} to {most} control points, and not {count}",
    "Each end of a patch is a control point, and 32 is the most that all targets have: "
    "`tessellate quad of 16 …`.",
)
WRONG_ENDS = error(
    "B0574",
    "`{patch}` patches have {wanted} ends, and here are {count}",
    "The ends are the numbers of the control points at the corners of a patch, in order. Those of "
    "a quad go round it: `tessellate quad of 16 ends [0, 3, 15, 12] …`.",
)
NO_SUCH_END = error(
    "B0575",
    "there is no control point {index} for an end: the last one is {last}",
    "Control points are numbered from 0.",
)
END_TWICE = error(
    "B0576",
    "the control point {index} is two ends of the patch",
    "Between two ends there has to be an edge.",
)
LEVEL_DIFFERS = error(
    "B0577",
    "this differs along an edge",
    "The level of an edge is asked once, and has to be the same for both patches beside it. So it "
    "depends on the two ends of the edge, `end[0].position` and `end[1].position`, and on what is "
    "the same all over a draw.",
)
INNER_LEVEL_DIFFERS = error(
    "B0578",
    "this differs between the vertices of a patch",
    "A level is asked once for each patch. Say which control point is meant: `corner[0].position`.",
)
LEVEL_OUT_OF_RANGE = error(
    "B0579",
    "this is {level}, and patches are divided by levels above 0 and up to {most}",
    "A level is the number of steps into which an edge or the inside of a patch is divided. It may "
    "leave this range for some values of what it reads: larger levels count as the largest one, "
    "and a patch with an edge whose level is not above 0 is not drawn.",
)
NOT_OF_THIS_PATCH = error(
    "B0580",
    "`{patch}` patches have no `{word}`",
    "`lines` says how many lines an isoline patch has, and `inside` how finely triangles and quads "
    "are divided away from their edges.",
)
NO_SEGMENTS = error(
    "B0582",
    "a line of {count} vertices goes nowhere",
    "`line of n` has two vertices or more, and a segment from each to the next one.",
)
NOT_OF_PATCHES = error(
    "B0590",
    "the parts of a divided `{patch}` patch are `{made}` primitives, and not `{primitive}`",
    "If a material divides its patches, `expand` gets each part of a patch as a primitive. The "
    "parts of triangle and quad patches are triangles, and those of isoline patches are lines. "
    "They know nothing of the vertices next to them.",
)
