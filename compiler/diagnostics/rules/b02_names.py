"""B02: the meanings of names."""

from __future__ import annotations

from .row import error, warning

UNKNOWN_NAME = error(
    "B0201",
    "unknown {kind} `{name}`",
    "A name is visible where it is declared in the same body, inherited, declared in the file, "
    "imported, or built in.",
    of_absence=True,
)
DUPLICATE_NAME = error(
    "B0202",
    "`{name}` is declared twice",
    "Equations have no order, so a second one for the same name would contradict the first.",
)
CYCLIC_DEFINITION = error(
    "B0203",
    "`{name}` is defined by itself: {cycle}",
    "An equation may use any other name, but no name may depend on itself, not even by way of "
    "other names. Break the cycle: give one of these a value that does not need the others.",
)
RECURSIVE_FUNCTION = error(
    "B0204",
    "`{name}` calls itself: {cycle}",
    "Every program has to end on every device, so functions do not call themselves. To repeat "
    "something a limited number of times, use a fold such as `sum`, or `iterate`.",
)
CYCLIC_INHERITANCE = error(
    "B0205",
    "`{name}` inherits from itself: {cycle}",
    "The chain of bases has to end.",
)
NO_MATERIAL = error(
    "B0206",
    "`{path}` has no material",
    "A shader is a material under a rig, drawn by a pass. Declare one: "
    "`material Plain { color = #ffffff }`.",
)
AMBIGUOUS_NAME = error(
    "B0207",
    "`{name}` is imported from several files",
    "Import the one that you mean by its name: `import std.lights.{Sun}` decides between two.",
)
WRONG_BASE = error(
    "B0208",
    "`{name}` is not a {kind}",
    "A material extends a material, a light a light, a pass a pass, a kernel a kernel, "
    "and a frame a frame.",
)
NOT_A_VALUE = error(
    "B0209",
    "this is not a value",
    "Functions, terms and structures are called, as in `f(x)`. Of `light`, `material` and "
    "`inherited` a slot is read, as in `light.diffuse`.",
)
UNREAD_SLOT = warning(
    "B0210",
    "nothing reads `{name}`",
    "A name that no base declares is a new one. Nothing outside of what declares it reads it, so "
    "it has an effect only if another equation there uses it.",
    of_absence=True,
)
WITHOUT_COLOR = warning(
    "B0211",
    "nothing reads `{name}`, and `{material}` sets no `color`",
    "A material shows its slot `color`. Without one it has the grey of the library's surface, "
    "whatever its other slots say.",
    of_the_whole=True,
)
UNUSUAL_GROUP = warning(
    "B0212",
    "`{name}` is a group of its own",
    "The groups of parameters are frame, view, rig, material and draw. Any other name makes a "
    "new group.",
)
MISPLACED_MEMBER = error(
    "B0213",
    "`{member}` does not belong in {record}",
    "Only a pass says what is written to which target, how it is blended and which pixels are "
    "discarded. Only materials and passes have vertex attributes.",
)
UNREADABLE_NAME = error(
    "B0214",
    "`{name}` cannot be the name of a value",
    "In a material, light or pass, `material` stands for the material that is drawn, and "
    "`inherited` for what the base defines. A slot, a constant or a function with one of these "
    "names could not be read there.",
)
CASE_OF_NAMES = warning(
    "B0215",
    "`{name}` and `{first}` differ by letter case only",
    "Each material has files of its name, and Windows and macOS take these for the same files.",
)
NOT_A_PASS = error(
    "B0216",
    "`{name}` is not a pass",
    "Behind `by` stands the pass that draws the material unless another one is asked for: "
    "`material Leaf by Cutout { … }`.",
)
OTHER_PASS = warning(
    "B0217",
    "`{name}` is drawn by `{tied}`, and here by `{pass_}`",
    "What its own pass does, such as to discard, is not done here. Leave `--pass` out, or derive "
    "the other pass from the material's.",
)
