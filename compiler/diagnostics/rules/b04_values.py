"""B04: values, mixins, structures, blocks and the names that hosts set."""

from __future__ import annotations

from .row import error, warning

ZERO_DIVISOR = error(
    "B0401",
    "this divisor is always zero",
    "The quotient would be undefined on some backends and infinite on others.",
)
NUMBER_TOO_LARGE = error(
    "B0402",
    "`{text}` does not fit into {type}",
    "`float` reaches to about 3.4e38, `int` to 2147483647, `uint` to 4294967295. A constant that "
    "is computed has to fit as well.",
)
OUT_OF_RANGE = error(
    "B0403",
    "{value} is outside of {range}",
    "The declared range is a promise. The compiler relies on it when it leaves out guards, so a "
    "default or an override has to keep it.",
)
EMPTY_RANGE = error(
    "B0404",
    "the range {range} is empty",
    "The lower bound comes first: `0..1`.",
)
OUT_OF_BOUNDS = error(
    "B0405",
    "index {index} is outside of {type}",
    "Lanes, columns and elements are counted from 0.",
)
NOT_CONSTANT = error(
    "B0406",
    "this has to be known at compile time",
    "Array lengths, numbers of lights and ranges are part of the shader's text, so they are "
    "built from literals and constants only.",
)
ABSTRACT_SLOT = error(
    "B0407",
    "`{record}` does not set the abstract slot `{name}`",
    "A slot declared without a value has to be set before its material, light or pass is used.",
    of_absence=True,
)
ABSTRACT_USE = error(
    "B0408",
    "`{name}` is abstract and cannot be used itself",
    "Declare a material, light or pass that extends it and sets what is missing: `material Mine "
    ": Base { … }`.",
)
BAD_COUNT = error(
    "B0409",
    "{count} is not a possible number of elements",
    "Arrays and rig entries hold at least 1 element and at most 4096.",
)
FOLD_TOO_LONG = error(
    "B0410",
    "a fold of {count} terms is too long",
    "Folds become loops or are unrolled; at most 4096 terms are allowed.",
)
ZERO_DIRECTION = error(
    "B0411",
    "a direction cannot be zero",
    "A `direction` has length one. Defaults are normalised, and that is not possible for zero.",
)
UNGUARDED = error(
    "B0412",
    "`unguarded` takes one operation",
    "`unguarded(x / y)` or `unguarded(sqrt(x))` means what the hardware does there.",
)

TOO_MUCH_WORK = error(
    "B0413",
    "this has to be known at compile time, and takes more than {most}",
    "Array lengths, ranges and defaults are computed by the compiler, loops in them iteration by "
    "iteration. Use fewer iterations, or let the shader compute the value: an equation is not "
    "computed when compiling.",
)
TOO_MANY_BASES = error(
    "B0414",
    "`{name}` has more than {most} bases, one above the other",
    "Bases of bases count, too. Declare what they share in a mixin, or in fewer bases.",
)
ZERO_DIVISOR_GIVEN = warning(
    "B0415",
    "this divisor is zero, by a value that is given from elsewhere",
    "An argument, or a slot that another record sets, makes it zero. The quotient is 0 then, as "
    "for every divisor that turns out to be zero when a shader runs. Where that is meant, write "
    "it: `if b == 0 then 0 else a / b`.",
)
OUT_OF_BOUNDS_GIVEN = warning(
    "B0416",
    "index {index} is outside of {type}, by a value that is given from elsewhere",
    "An argument, or a slot that another record sets, is the index. The nearest lane, column or "
    "element is read, as for every index that turns out to be out of bounds when a shader runs.",
)

# Mixins

MIXIN_AS_BASE = error(
    "B0430",
    "`{name}` is a mixin and cannot be the base",
    "A header names one base and then any number of mixins: `material Robot : Plastic + Skinned`.",
)
NOT_A_MIXIN = error(
    "B0431",
    "`{name}` is not a mixin for a {kind}",
    "Only mixins may follow the `+` of a header, and each has to be for records of this kind: "
    "`mixin Flicker for light { … }`, and `mixin Skinned { … }` for materials.",
)
MIXIN_TWICE = error(
    "B0432",
    "the mixin `{name}` is already included",
    "A record and its bases include a mixin only once.",
)
MIXINS_CLASH = error(
    "B0433",
    "the mixins `{first}` and `{later}` of `{record}` both declare `{name}`",
    "Two mixins that do not know of each other would share a name by chance. A mixin that "
    "continues the definition of another one uses `inherited.name`. A mixin that only needs the "
    "value declares the name with its type and without a value.",
)
LEFT_BEHIND = warning(
    "B0434",
    "`{record}` overrides `{name}`, and leaves `{companion}` as it was",
    "What moves a mesh has to move all that belongs to its points. The material has given the slot "
    "that was left behind a value, for example for a normal map, and it would point elsewhere.",
)

# Blocks that the host owns

EXTERN_ALIGNMENT = error(
    "B0440",
    "`{name}` cannot lie at byte {offset}: a {type} begins at a multiple of {alignment}",
    "Scalars begin at multiples of 4 bytes, a vec2 at one of 8, everything else at one of 16: "
    "elsewhere std140, Direct3D or WGSL would read it from another place. Declare what lies there "
    "as scalars, and put them together with `vec3(x, y, z)`.",
)
EXTERN_OVERLAP = error(
    "B0441",
    "`{name}` at byte {offset} overlaps `{other}`, which ends at byte {end}",
    "Members of a block do not share bytes. A mat2 takes 32 of them, a mat3 48, and a structure "
    "whole multiples of 16.",
)
EXTERN_ARRAY = error(
    "B0442",
    "no host lays out a {element}[{count}] as every backend can read it",
    "Elements of an array begin 16 bytes apart in std140 and Direct3D; WGSL takes no scalars or "
    "vec2s that do. Declare it as `vec4[n]`, and read the first lanes of each element.",
)
EXTERN_NUMBER = error(
    "B0443",
    "expected a whole number from 0 to {largest}",
    "A group and a binding are numbers of 16 bits, and no block is larger than 64 KiB. How many "
    "groups, and how large a block, a target has is checked where a material is compiled for it.",
)
EXTERN_PLACE_TAKEN = error(
    "B0444",
    "`{name}` is bound where `{other}` is",
    "Each block that the host owns needs a group and a binding of its own.",
)

# Tools

NO_LINE_DIRECTIVES = warning(
    "B0450",
    "{target} has no line directives, so its text is written without",
    "The source map in the reflection says of every target's text which line of the material each "
    "statement is for.",
)
TOO_LARGE_TO_DRAW = error(
    "B0451",
    "{name} has {count} boxes to draw, and a picture holds {limit}",
    "Nobody reads a larger picture. `--format dot` and `--format text` have no limit; "
    "`--program`, without `--all`, shows only values that have names.",
)

NOT_SPECIALISED = error(
    "B0452",
    "{problem}",
    "`compile --set NAME=VALUE` and `NAME=LOW..HIGH` narrow what the host may set, so they name "
    "parameters and keep to their declared ranges. Slots are set in the text, by a material that "
    "extends another.",
)

# Structures

STRUCT_TOO_LARGE = error(
    "B0480",
    "`{name}` has more than {parts} parts, or more than {levels} levels of structures",
    "The parts of a structure are the numbers, vectors and matrices in it, including those of "
    "the structures in it.",
)
EMPTY_STRUCT = error(
    "B0481",
    "the structure `{name}` has no members",
    "Give it what its values are made of: `width : float`.",
)
VALUE_TOO_LARGE = error(
    "B0482",
    "a value of type `{type}` has {count} numbers, and {most} are possible",
    "A host that sets a value has all its numbers in memory, and so has a shader that chooses "
    "between two. Elements of a `buffer` may be many: `buffer name : T[]`.",
)
EMPTY_ENUM = error(
    "B0483",
    "the enumeration `{name}` has no members",
    "Give it the values that there are: `enum Mode { add, mix }`.",
)

HOST_NAME_TAKEN = error(
    "B0490",
    "{what} and {other} would both be called `{name}` by a host",
    "Every name that a host sets has to be unique within a shader: those of parameters, textures, "
    "lights and blocks. Those of a pass and of a rig begin with its name where the material has "
    "the same, so then that name has to be unique. Rename one of the two.",
)
