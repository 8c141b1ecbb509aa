"""B09: materials as functions that an engine calls."""

from __future__ import annotations

from .row import error, warning

NO_SUCH_SLOT = error(
    "B0901",
    "`{name}` has no slot `{slot}`",
    "Functions return slots: names that a material, its bases or mixins give a value by an "
    "equation. Parameters, textures and vertex inputs are arguments of functions.",
)
SLOT_NEEDS_LIGHTS = error(
    "B0902",
    "`{slot}` needs lights, and a function has none",
    "An engine lights a surface itself, so functions say what the surface is like: its colour "
    "without light, its roughness, its normal. Where a rig is named, its lights are arguments.",
)
NO_RESULT_OF_FUNCTION = error(
    "B0903",
    "`{slot}` is a {type}, which no function returns",
    "A function returns numbers, bools, vectors and matrices.",
)
NOT_AN_ARGUMENT = error(
    "B0904",
    "`{slot}` reads the storage buffer `{buffer}`, which is no argument of a function",
    "No language has functions to which any storage buffer can be given.",
)
VERTICES_OF_ITS_OWN = error(
    "B0905",
    "`{name}` makes vertices of its own, and a function makes none",
    "An engine draws the vertices of its meshes. A material that expands primitives or divides "
    "patches is drawn by whole shaders.",
)
NO_FUNCTIONS = error(
    "B0906",
    "`{name}` gives no value to a slot that a function returns without lights",
    "Without a list of slots, functions are made of those to which the material itself gives a "
    "value, or a model that it extends, and which need no lights.",
)
UNKNOWN_STAGE_OF_SLOT = error(
    "B0907",
    "`{text}` names no stage for a slot",
    "A slot is computed for pixels, or for vertices where its name is followed by `@vertex`.",
)
LEFT_OUT = warning(
    "B0908",
    "`{name}` is left out: it gives no value to a slot that a function returns without lights",
    "Other materials of the file have such slots. Without a list of slots, functions are made of "
    "those to which a material itself gives a value, or a model that it extends.",
)
UNFIT_FOR_ENGINE = error(
    "B0909",
    "{engine} cannot draw `{slot}`: {reason}",
    "An engine takes what its own shaders can have. Leave the slot out by `--slots`, give the "
    "engine a material without it, or call the functions without the engine's profile.",
)
NO_SUCH_ENGINE = error(
    "B0910",
    "no engine is called `{name}`",
    "`burnish compile --help` lists the engines.",
)
NO_SUCH_VALUE = error(
    "B0911",
    "engines take no value called `{name}`",
    "`--slots base_color=stain` says which slot is a value that an engine takes; the page about "
    "engines lists these values.",
)
LEFT_TO_ENGINE = warning(
    "B0912",
    "Burnish writes no `{value}` for {engine}: the slot `{slot}` of `{name}` is left out",
    "The engine lights the surface without it, so it looks different from the whole shader. A slot "
    "that is the library's own, as `clearcoat = 0`, is not told.",
)
WHITE_IN_ENGINE = warning(
    "B0913",
    "{engine} draws `{name}` white: no slot of it is known as its base colour",
    "An engine finds the base colour in slots called `base_color`, `albedo`, `tint` and the like. "
    "Of a slot with another name, `--slots base_color=stain` says so.",
)
