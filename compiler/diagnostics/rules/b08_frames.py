"""B08: frames and their steps."""

from __future__ import annotations

from .row import error, warning

FRAMES_ONLY = error(
    "B0801",
    "{what} has a meaning in frames only",
    "A frame draws a pass several times: `sum lamp in rig : Lit(screen)` once for each light, "
    "`each i in 0..4 : Depth(scene)` once for each layer of its results. Loops over numbers go "
    "over a range, `sum i in 0..4 : e`.",
)
NO_STEP = error(
    "B0802",
    "this is no step of a frame",
    "A step draws a pass or runs a kernel: `name = Pass(what, size) with { input = value }`, "
    "`name = Kernel()`. Its results are read as `name.target`.",
)
NOT_LEFT = error(
    "B0803",
    "this is no {what}",
    "The results of a step have names: the targets of its pass, `depth`, or the results of its "
    "kernel. They are read as `step.name`; textures and buffers of the host are declared by `map` "
    "and `buffer`.",
)
NOT_DRAWN = error(
    "B0804",
    "a pass cannot draw this",
    "The first argument says what is drawn: models that the frame declares by `models name`, or "
    "`screen`, which is one triangle over the whole result, or `vertices(n)`, as many vertices as "
    "that which have nothing but their numbers.",
)
STEP_ARGUMENTS = error(
    "B0805",
    "`{name}` takes {expected}",
    "A pass is told what it draws and, if that is not the frame's own size, where to: "
    "`Pass(models)`, `Pass(screen, size / 2)`, `Pass(models, other_step)`. A kernel knows by its "
    "results how often it runs. All else is set by `with { name = value }`.",
)
INPUT_MISSING = error(
    "B0806",
    "`{step}` needs `{name}`",
    "A texture of a pass or a kernel that has no default, and a buffer, is set where the frame is "
    "put together: `with { name = step.target }`, or `with { name = albedo }` where the frame has "
    "a `map albedo` that its host binds.",
)
PLACES_DIFFER = error(
    "B0807",
    "`{first}` and `{second}` do not fit together: {reason}",
    "Targets of one step have one size and equally many layers. A target that a pass draws over "
    "has the format of the pass's own target.",
)
NO_OUTPUT = error(
    "B0808",
    "frame `{name}` has no output",
    "`output picture = step.target` is a result for the host. Steps that no output needs are not "
    "drawn.",
)
NOT_ADDED = error(
    "B0809",
    "`{target}` of `{step}` is not blended, so each light would replace the one before",
    "`sum lamp in rig` draws once for each light into the same targets. Declare the pass with "
    "`blend add`.",
)
NO_RANGE_OF_STEPS = error(
    "B0810",
    "steps cannot be repeated over this",
    "`each i in 0..4` and `iterate` need numbers that are known when compiling, 256 at most. "
    "`each face in cube` draws the six faces of a cube, `each level in mips(5)` so many mip "
    "levels, and `sum lamp in rig` once for each light.",
)
NOT_NEEDED = warning(
    "B0811",
    "nothing needs `{name}`, so it is not drawn",
    "A step is drawn if an output of the frame depends on it. Make it one, or remove it.",
)
NO_MATERIAL_TO_DRAW = error(
    "B0812",
    "no material of this file is among the models `{name}`",
    "Models of a scene have the materials that the file declares and that are not abstract. "
    "`models name : Base` are those whose material extends `Base`.",
)
NOT_FILTERED = error(
    "B0813",
    "`{name}` of `{step}` filters its texels, and `{format}` cannot be filtered",
    "Many devices filter no 32-bit floats. Declare the texture with `{ filter = nearest, "
    "mip = none }`, or the target with a 16-bit format.",
)
FRAME_CYCLE = error(
    "B0814",
    "`{name}` needs itself: {cycle}",
    "A frame draws its steps one after the other, so no step can need its own result. "
    "`previous(step.target)` is the result of the last frame.",
)
NOTHING_BEFORE = error(
    "B0815",
    "in the first frame, nothing has left `{name}`",
    "The kernel that writes a buffer gives its number of elements, and before the first frame "
    "none has run. `previous(moved.after, seeded.after)` reads the second buffer in the first "
    "frame.",
)
NO_VERTEX_INPUTS = error(
    "B0816",
    "`{step}` reads the vertex input `{input}`, and there are no models that have it",
    "`screen` and `vertices(n)` draw vertices that have nothing but their numbers: the pass makes "
    "all else of `vertex_index`, also `clip_position`.",
)
NOT_ON_HOST = error(
    "B0817",
    "a host cannot compute {what}",
    "The numbers of a frame are computed by the program that draws it, from parameters and the "
    "sizes of textures. It has no `iterate` and no structures, and reads no texels: a pass or a "
    "kernel does.",
)
NO_SHARED_VERTICES = error(
    "B0818",
    "`{step}` draws {primitives}, and vertices without models are points or triangles",
    "Lines, primitives with what lies next to them, and patches come of a mesh, whose triangles "
    "have vertices in common. Vertices without a mesh share none.",
)
NOT_BROUGHT = error(
    "B0819",
    "`{name}` of a {record} cannot be what a step leaves",
    "Only lights bring the steps that make their textures, such as a shadow map. For all others, "
    "a frame sets the texture by `with`.",
)
NOT_CLEARED = error(
    "B0820",
    "`{name}` is drawn over, so it is not cleared",
    "A step clears the targets that are drawn to for the first time. A target that it draws over "
    "stays as another step has left it.",
)
NO_BLEND_CONSTANT = error(
    "B0821",
    "`{target}` of `{step}` is blended by a constant, and the frame does not say which",
    "`constant` and `one_minus_constant` are a colour that is set for the whole step: "
    "`Faded(screen) with { blend_constant = vec4(0.5) }`.",
)
NOT_BLENDED = error(
    "B0822",
    "`{target}` of `{step}` is blended, and `{format}` cannot be blended everywhere",
    "WebGPU and WebGL 2 blend 32-bit floats only where a device has an extension for it. "
    "Draw to a format of 16-bit floats.",
)
NO_SUCH_SIZE = error(
    "B0823",
    "`{name}` cannot have its size: {reason}",
    "A step draws to textures of the size that stands behind what it draws, or of the frame's "
    "`size`. Sizes that are known only when the frame is drawn are checked then.",
)
AREA_OUTSIDE = error(
    "B0824",
    "the {area} of `{step}` cannot be meant: {reason}",
    "A viewport lies within the targets, and a scissor has some of their texels: left, top, width "
    "and height, counted from the upper left corner. Those that are known only when the frame is "
    "drawn are checked then.",
)
SAMPLES_DIFFER = error(
    "B0825",
    "the samples of `{name}` do not fit: {reason}",
    "A step with several samples draws to results of its own, or over the samples that another "
    "step has left, which no third one draws over then. A step with one sample can draw over "
    "colours that have been joined to one, and over no depths of several.",
)
DEPTHS_OF_SAMPLES = error(
    "B0826",
    "`{name}` has depths of {samples} samples, which nobody can read",
    "Depths have no mean that says something, and not every API can read those of the samples. "
    "Draw them once more with a pass of one sample, or write them to a target.",
)
BLEND_CONSTANT_UNUSED = error(
    "B0827",
    "no target of `{step}` is blended by a constant",
    "`blend_constant` is what the factors `constant` and `one_minus_constant` mean. A pass says "
    "them: `target color : rgba16f = e blend { source = constant, destination = "
    "one_minus_constant }`.",
)
TOO_MANY_STEPS = error(
    "B0828",
    "`{name}` has more than {most}",
    "Repetitions inside of each other multiply their steps, each of which a host draws one by one. "
    "Work that is repeated so often belongs into a loop of a shader.",
)
TWO_DEPTHS = error(
    "B0829",
    "`{step}` has depths and a target of the name `depth`",
    "`step.depth` are the depths that a pass tests or writes. Give the target another name, such "
    "as `distance`, or leave depths alone: `depth { compare = always, write = false }`.",
)
NOT_BY_ITS_PASS = warning(
    "B0830",
    "no step draws `{name}` by `{tied}`",
    "A frame names the pass of each step, also for materials that have a pass of their own. Draw "
    "models with such a material by it, or by a pass that extends it: `models leaves : Leaf`, "
    "`Cutout(leaves)`.",
)
