"""Every kind of diagnostic, declared once: code, severity, message and what the rule teaches.

Codes are stable: they are written in build logs and looked up with ``burnish explain``. The first
two digits name the section; a retired code is never used again.
"""

from __future__ import annotations

from .diagnostic import Rule


def _error(code: str, message: str, help: str, *, of_absence: bool = False) -> Rule:
    return Rule(code, "error", message, help, of_absence)


def _warning(code: str, message: str, help: str) -> Rule:
    return Rule(code, "warning", message, help)


# --- B00: files and the command line -------------------------------------------------------------

MISSING_FILE = _error(
    "B0001",
    "there is no file `{path}`",
    "Check the path: it is taken relative to the folder the command is run in.",
)
NOT_A_FILE = _error(
    "B0002",
    "`{path}` is a folder, not a file",
    "Name the `.burnish` files to compile; folders are not searched.",
)
UNREADABLE_FILE = _error(
    "B0003",
    "`{path}` cannot be read: {reason}",
    "The system does not allow this file to be read. Check its name, its permissions, and those of "
    "the folders that it lies in.",
)
NOT_TEXT = _error(
    "B0004",
    "`{path}` is not UTF-8 text: {reason}",
    "Burnish files are UTF-8 text. Save the file as UTF-8, or check that it is the file you meant.",
)
TOO_LARGE = _error(
    "B0005",
    "`{path}` is larger than {limit}",
    "A material of this size is almost certainly not the file you meant. Generated text should be "
    "split into several files that import each other.",
)
MISSING_IMPORT = _error(
    "B0006",
    "cannot find `{path}`",
    "`import std.lights` looks for `std/lights.burnish` along the search path; a quoted import is "
    "taken relative to the importing file.",
)
IMPORT_ESCAPES = _error(
    "B0007",
    "`{path}` leads out of the search path",
    "Imports may not leave the folders of the search path: a material has to compile the same way "
    "wherever it is checked out. Move the file inside, or add its folder to the search path.",
)
IMPORT_CYCLE = _error(
    "B0008",
    "these files import each other: {cycle}",
    "Imports must not form a cycle. Move what both files need into a third one.",
)
UNWRITABLE_OUTPUT = _error(
    "B0009",
    "cannot write to `{path}`: {reason}",
    "Output folders are made where needed; check that the place may be written to.",
)
UNKNOWN_TARGET = _error(
    "B0010",
    "unknown target `{name}`",
    "`burnish targets` lists the known targets. Separate several targets by commas.",
)
UNKNOWN_PROFILE = _error(
    "B0011",
    "target `{target}` has no profile `{name}`",
    "A profile is a version of a target's language, such as `glsl:es300`.",
)
UNKNOWN_EXPORT = _error(
    "B0012",
    "`{path}` does not declare `{name}`",
    "Only what a file declares itself can be imported from it, not what it imports in turn.",
    of_absence=True,
)
MISSING_FOLDER = _error(
    "B0013",
    "there is no folder `{path}` to look for imports in",
    "The search path consists of the folders that `--include` or `search_path=` names. Check "
    "their names.",
)

# --- B01: syntax ---------------------------------------------------------------------------------

UNEXPECTED = _error(
    "B0101",
    "expected {expected}, found {found}",
    "The text does not follow the grammar here. A file is a set of declarations, and the body of a "
    "declaration a set of equations `name = expression`.",
)
UNKNOWN_CHARACTER = _error(
    "B0102",
    "unexpected character {character}",
    "Names are made of the letters a to z, digits and `_`. Other characters belong in comments.",
)
FOREIGN_OPERATOR = _error(
    "B0103",
    "Burnish has no operator `{operator}`",
    "Logic is spelt `and`, `or`, `not`; the remainder `mod`; a choice `if c then a else b`. There "
    "is no assignment: a name is given its value once, by an equation.",
)
BAD_NUMBER = _error(
    "B0104",
    "`{text}` is not a number",
    "Numbers are written `2`, `7u`, `0xFF`, `0.5`, `1e-3`, angles `30deg` or `0.5rad`. A float "
    "needs no suffix, and there are digits after its point.",
)
BAD_COLOR = _error(
    "B0105",
    "`{text}` is not a colour",
    "Colours have 3, 6 or 8 hexadecimal digits: `#rgb`, `#rrggbb`, `#rrggbbaa`.",
)
UNFINISHED_TEXT = _error(
    "B0106",
    'this text has no closing `"`',
    "Quoted texts are names of files. They end on the line on which they begin.",
)
UNFINISHED_COMMENT = _error(
    "B0107",
    "this comment has no closing `*/`",
    "A comment from `/*` runs to the next `*/`; comments do not nest.",
)
UNCLOSED = _error(
    "B0108",
    "this `{opening}` is never closed",
    "Every opening bracket needs its closing one.",
)
CHAINED_COMPARISON = _error(
    "B0109",
    "comparisons do not chain",
    "`a < b < c` would compare a bool with `c`. Write `a < b and b < c`.",
)
RESERVED_WORD = _error(
    "B0110",
    "`{word}` is a reserved word and cannot be a name",
    "Only these words are reserved: and, else, false, if, mod, not, or, then, true.",
)
TOO_NESTED = _error(
    "B0111",
    "brackets are nested too deeply: more than {limit}",
    "Give the inner parts names of their own: an equation for each costs nothing.",
)
UNKNOWN_EDITION = _error(
    "B0112",
    "unknown edition `{edition}`",
    "The first line may name the edition of the language that the file is written in. This "
    "compiler knows edition 1.",
)
STRAY_DOC = _warning(
    "B0113",
    "this doc comment describes nothing",
    "A `///` comment stands above a declaration or member, or on the line it ends on. Use `//!` "
    "for the file as a whole, and `//` for a remark of any other kind.",
)
UNPARENTHESISED = _error(
    "B0114",
    "`{word}` needs parentheses here",
    "An `if`, a fold such as `sum`, or an `iterate` extends as far to the right as possible. As "
    "a part of a larger expression it needs parentheses.",
)
BAD_NAME = _error(
    "B0115",
    "`{text}` is not a name",
    "Names are made of the letters a to z and A to Z, digits and `_`, which every shading "
    "language can spell.",
)
MERGE_CONFLICT = _error(
    "B0116",
    "a merge conflict is left in this file",
    "A version control system left both sides here, between lines of `<<<<<<<`, `=======` and "
    "`>>>>>>>`. Keep the side that is meant and remove these lines; only the first side is read.",
)

# --- B02: names ----------------------------------------------------------------------------------

UNKNOWN_NAME = _error(
    "B0201",
    "unknown {kind} `{name}`",
    "A name is visible where it is declared in the same body, inherited, declared in the file, "
    "imported, or built in.",
    of_absence=True,
)
DUPLICATE_NAME = _error(
    "B0202",
    "`{name}` is declared twice",
    "Equations have no order, so a second one for the same name would contradict the first.",
)
CYCLIC_DEFINITION = _error(
    "B0203",
    "`{name}` is defined by itself: {cycle}",
    "An equation may use any other name, but no name may depend on itself, not even by way of "
    "other names. Break the cycle: give one of these a value that does not need the others.",
)
RECURSIVE_FUNCTION = _error(
    "B0204",
    "`{name}` calls itself: {cycle}",
    "Every program has to end on every device, so functions do not call themselves. To repeat "
    "something a limited number of times, use a fold such as `sum`, or `iterate`.",
)
CYCLIC_INHERITANCE = _error(
    "B0205",
    "`{name}` inherits from itself: {cycle}",
    "The chain of bases has to end.",
)
NO_MATERIAL = _error(
    "B0206",
    "`{path}` has no material",
    "A shader is a material under a rig, drawn by a pass. Declare one: "
    "`material Plain { color = #ffffff }`.",
)
AMBIGUOUS_NAME = _error(
    "B0207",
    "`{name}` is imported from several files",
    "Import the one that you mean by its name: `import std.lights.{Sun}` decides between two.",
)
WRONG_BASE = _error(
    "B0208",
    "`{name}` is not a {kind}",
    "A material extends a material, a light a light, a pass a pass, a kernel a kernel, "
    "and a frame a frame.",
)
NOT_A_VALUE = _error(
    "B0209",
    "this is not a value",
    "Functions, terms and structures are called, as in `f(x)`. Of `light`, `material` and "
    "`inherited` a slot is read, as in `light.diffuse`.",
)
MISSPELT_SLOT = _warning(
    "B0210",
    "nothing reads `{name}`",
    "A name that no base declares is a new slot of the material. Nothing outside of the material "
    "reads it, so it has an effect only if another equation of the material uses it.",
)
UNUSUAL_GROUP = _warning(
    "B0212",
    "`{name}` is a group of its own",
    "The groups of parameters are frame, view, rig, material and draw. Any other name makes a "
    "new group.",
)
MISPLACED_MEMBER = _error(
    "B0213",
    "`{member}` does not belong in {record}",
    "Only a pass says what is written to which target, how it is blended and which pixels are "
    "discarded. Only materials and passes have vertex attributes.",
)
UNREADABLE_NAME = _error(
    "B0214",
    "`{name}` cannot be the name of a value",
    "In a material, light or pass, `material` stands for the material that is drawn, and "
    "`inherited` for what the base defines. A slot, a constant or a function with one of these "
    "names could not be read there.",
)

# --- B03: types ----------------------------------------------------------------------------------

WRONG_TYPE = _error(
    "B0301",
    "expected {expected}, found {found}",
    "Types are never converted silently, except whole-number literals to `float`. Write the "
    "constructor: `float(n)`, `vec3(x)`.",
)
NO_OVERLOAD = _error(
    "B0302",
    "`{name}` cannot be called with ({arguments})",
    "The number and the types of the arguments have to match one of the candidates. Arguments "
    "that share a type parameter need the same type.",
)
WRONG_COUNT = _error(
    "B0303",
    "`{name}` takes {expected}, found {found}",
    "Arguments are given by position; none has a default.",
)
NO_MEMBER = _error(
    "B0304",
    "{type} has no member `{name}`",
    "Vectors have lanes (`v.xyz`, `c.rgb`), structures members, `light` and `material` slots.",
)
NO_OPERATOR = _error(
    "B0305",
    "no `{operator}` between {left} and {right}",
    "Arithmetic needs two operands of the same shape, or one of them a single number, and lanes "
    "of the same kind. `and` and `or` take bools.",
)
OVERRIDE_CHANGES_TYPE = _error(
    "B0306",
    "`{name}` is {expected} in `{base}`, and {found} here",
    "An override keeps the type, because everything the base computes from the slot relies on it.",
)
NOT_CALLABLE = _error(
    "B0307",
    "{found} cannot be called",
    "Functions, terms and type constructors are called with arguments, textures with a coordinate.",
)
NO_PREFIX_OPERATOR = _error(
    "B0308",
    "no `{operator}` of {left}",
    "`-` takes numbers, `not` takes a `bool`.",
)
BRANCH_TYPES = _error(
    "B0309",
    "the branches differ: {then} and {otherwise}",
    "An `if` is one value, so both of its branches have one type.",
)
NOT_INDEXABLE = _error(
    "B0310",
    "{type} has no elements to index",
    "Vectors, matrices and arrays have elements. The lanes of a vector can also be read by name, "
    "as in `v.x`.",
)
SPACE_COUNT = _error(
    "B0311",
    "`{type}` names {expected}, found {found}",
    "`point<world>` names one space, `transform<object, world>` two, plain types none.",
)
NO_RANGE = _error(
    "B0312",
    "{type} cannot have a range",
    "Numbers are bounded by `in a..b`, vectors of them lane by lane, and arrays of both.",
)
WRONG_MEANING = _error(
    "B0320",
    "expected {expected}, found {found}",
    "What a value means is part of its type: a point is not a vector, a colour is not a "
    "direction, and a value in one space is not a value in another. `x in space` converts "
    "between spaces, `(x as type)` gives another meaning to the same numbers, and `vec3(x)` "
    "takes them as bare numbers, which fit everywhere.",
)
MIXED_SPACES = _error(
    "B0321",
    "`{operator}` of values in two spaces: {left} and {right}",
    "Coordinates of two spaces are measured from different origins along different axes. Bring "
    "both into one space first: `x in space`.",
)
MIXED_MEANINGS = _error(
    "B0322",
    "`{operator}` means nothing between {left} and {right}",
    "The difference of two points is a vector, and a vector moves a point. The sum of two points "
    "would depend on where the origin lies. Colours, angles and geometry do not mix. Calls such "
    "as `vec3(x)` or `float(x)` take a value as bare numbers.",
)
NOT_OF_A_POINT = _error(
    "B0323",
    "`{operator}` cannot be taken of a {left}",
    "A point is a place. It has a distance from another point, but no length of its own, and "
    "there is a direction from one point to another, but no direction of a point.",
)
NOT_UNIT = _error(
    "B0324",
    "expected {expected}, found {found}, which may not have length one",
    "A `direction` or `normal` that is declared has length one, and formulas rely on that. The "
    "compiler has to be able to prove it: the value is the result of `normalize`, another "
    "direction, or made of numbers that show it. Interpolation does not keep the length, since "
    "the mean of two directions is shorter.",
)
BARE_ANGLE = _error(
    "B0325",
    "`{text}` is not an angle: it has no unit",
    "Angles are written with their unit, `20deg` or `0.35rad`. Only zero needs no unit.",
)
IN_NO_SPACE = _error(
    "B0326",
    "{found} is in no space, so there is nothing to convert",
    "`x in space` takes points, vectors, directions and normals, because their types name the "
    "space that they are in.",
)
NO_CONVERSION = _error(
    "B0327",
    "there is no transform from {found} into `{space}`",
    "Values are converted by slots that are declared as `transform<A, B>` or `basis<A, B>` in "
    "the record, its surface or the pass. Points need transforms. Only points can be converted "
    "into clip space, and nothing can be converted out of it.",
)
UNINFERABLE_PARAMETER = _error(
    "B0328",
    "no argument of `{function}` determines `{name}`",
    "The compiler finds out from the arguments what a type parameter stands for, so the type of "
    "at least one argument has to name it.",
)
AMBIGUOUS_CALL = _error(
    "B0329",
    "several functions `{name}` take ({arguments}) equally well",
    "None of them takes the arguments better than the others. Say what is meant: of which type a "
    "number is, as in `float(1)` or `vec3(1)`, or what numbers mean, as in `(v as rgb)`.",
)
TEXTURE_LACKS_READ = _error(
    "B0350",
    "`{type}` has no {read}",
    "Colours are filtered, depths are compared with a reference, and whole numbers are loaded. "
    "Single texels can be loaded from all textures but cubes.",
)
NOT_A_LANE = _error(
    "B0351",
    "this operand has to be a constant in 0..3",
    "Which lane of the texels is gathered is part of the instruction on most devices.",
)
SETTING_WITHOUT_USE = _error(
    "B0352",
    "`{name}` does not apply to `{type}`",
    "Cubes do not wrap, only depths are compared, depths are read at level 0, and whole numbers "
    "are not filtered.",
)
MEMBER_COUNT = _error(
    "B0380",
    "`{name}` has the members ({members}), found {found}",
    "A structure is made by a call with a value for each member, in the order of the declaration.",
)
ELEMENTS_DIFFER = _error(
    "B0381",
    "the first element is {first}, this one {found}",
    "All elements of an array have one type. Only literals adapt: `[1, x]` is an array of floats "
    "if `x` is one.",
)
UNBOUNDED_LOOP = _error(
    "B0382",
    "the maximum number of iterations of this loop is not known",
    "Every loop has to end, and the compiler has to know after how many iterations at most. It "
    "knows that from constants, from the ranges of parameters, and from `clamp` and `mod`.",
)
NO_INITIAL = _error(
    "B0383",
    "`{word}` of no terms has no value",
    "The fold may have no terms at all. Say what its result is then: `min i in a..b from x : e`.",
)
STATE_CHANGES = _error(
    "B0384",
    "`{name}` is {before} at the start, and {after} after an iteration",
    "A state keeps its type. `iterate x from 1` begins with an `int`, `from 1.0` with a `float`.",
)
STATE_TOO_LARGE = _error(
    "B0385",
    "the state has {count} parts, and {most} are the most that a loop can have",
    "Every part of a state is a variable of the loop. Compute what does not change outside of "
    "the loop.",
)
READ_IN_LOOP = _error(
    "B0386",
    "{what} {does}, which may have left the loop already",
    "Its result is undefined where others have left the loop. Read the texture with an explicit "
    "level, or before the loop.",
)
CROSSING_IN_LOOP = _error(
    "B0387",
    "a value that changes in a loop cannot be computed at the vertices",
    "Each iteration would need a varying of its own. That is done for folds of at most 16 "
    "iterations whose bounds are constants, if they come to at most 4096 operations. Otherwise put "
    "`@vertex` in front of the whole loop.",
)
CROSSING_PER_LIGHT = _error(
    "B0388",
    "a value that differs between lights cannot be computed at the vertices for each of them",
    "Put `@vertex` in front of the call of the term, so that the sum over the lights is "
    "interpolated: `@vertex shaded(…)`.",
)
LOOPS_TOO_NESTED = _error(
    "B0389",
    "loops are nested too deeply: more than {most}",
    "Compilers of shading languages do not take many more. Loops in functions that are called in a "
    "loop count as well. Join several of these loops into one.",
)

# --- B04: values and meaning ---------------------------------------------------------------------

ZERO_DIVISOR = _error(
    "B0401",
    "this divisor is always zero",
    "The quotient would be undefined on some backends and infinite on others.",
)
NUMBER_TOO_LARGE = _error(
    "B0402",
    "`{text}` does not fit into {type}",
    "`float` reaches to about 3.4e38, `int` to 2147483647, `uint` to 4294967295. A constant that "
    "is computed has to fit as well.",
)
OUT_OF_RANGE = _error(
    "B0403",
    "{value} is outside of {range}",
    "The declared range is a promise. The compiler relies on it when it leaves out guards, so a "
    "default or an override has to keep it.",
)
EMPTY_RANGE = _error(
    "B0404",
    "the range {range} is empty",
    "The lower bound comes first: `0..1`.",
)
OUT_OF_BOUNDS = _error(
    "B0405",
    "index {index} is outside of {type}",
    "Lanes, columns and elements are counted from 0.",
)
NOT_CONSTANT = _error(
    "B0406",
    "this has to be known at compile time",
    "Array lengths, numbers of lights and ranges are part of the shader's text, so they are "
    "built from literals and constants only.",
)
ABSTRACT_SLOT = _error(
    "B0407",
    "`{record}` does not set the abstract slot `{name}`",
    "A slot declared without a value has to be set before its material, light or pass is used.",
    of_absence=True,
)
ABSTRACT_USE = _error(
    "B0408",
    "`{name}` is abstract and cannot be used itself",
    "Declare a material, light or pass that extends it and sets what is missing: `material Mine "
    ": Base { … }`.",
)
BAD_COUNT = _error(
    "B0409",
    "{count} is not a possible number of elements",
    "Arrays and rig entries hold at least 1 element and at most 4096.",
)
FOLD_TOO_LONG = _error(
    "B0410",
    "a fold of {count} terms is too long",
    "Folds become loops or are unrolled; at most 4096 terms are allowed.",
)
ZERO_DIRECTION = _error(
    "B0411",
    "a direction cannot be zero",
    "A `direction` has length one. Defaults are normalised, and that is not possible for zero.",
)
UNGUARDED = _error(
    "B0412",
    "`unguarded` takes one operation",
    "`unguarded(x / y)` or `unguarded(sqrt(x))` means what the hardware does there.",
)

TOO_MUCH_WORK = _error(
    "B0413",
    "this has to be known at compile time, and takes more than {most} operations",
    "Array lengths, ranges and defaults are computed by the compiler, loops in them iteration by "
    "iteration. Use fewer iterations, or let the shader compute the value: an equation is not "
    "computed when compiling.",
)
TOO_MANY_BASES = _error(
    "B0414",
    "`{name}` has more than {most} bases, one above the other",
    "Bases of bases count, too. Declare what they share in a mixin, or in fewer bases.",
)

# Mixins

MIXIN_AS_BASE = _error(
    "B0430",
    "`{name}` is a mixin and cannot be the base",
    "A header names one base and then any number of mixins: `material Robot : Plastic + Skinned`.",
)
NOT_A_MIXIN = _error(
    "B0431",
    "`{name}` is not a mixin for a {kind}",
    "Only mixins may follow the `+` of a header, and each has to be for records of this kind: "
    "`mixin Flicker for light { … }`, and `mixin Skinned { … }` for materials.",
)
MIXIN_TWICE = _error(
    "B0432",
    "the mixin `{name}` is already included",
    "A record and its bases include a mixin only once.",
)
MIXINS_CLASH = _error(
    "B0433",
    "the mixins `{first}` and `{later}` of `{record}` both declare `{name}`",
    "Two mixins that do not know of each other would share a name by chance. A mixin that "
    "continues the definition of another one uses `inherited.name`. A mixin that only needs the "
    "value declares the name with its type and without a value.",
)

# Blocks that the host owns

EXTERN_ALIGNMENT = _error(
    "B0440",
    "`{name}` cannot lie at byte {offset}: a {type} begins at a multiple of {alignment}",
    "Scalars begin at multiples of 4 bytes, a vec2 at one of 8, everything else at one of 16: "
    "elsewhere std140, Direct3D or WGSL would read it from another place. Declare what lies there "
    "as scalars, and put them together with `vec3(x, y, z)`.",
)
EXTERN_OVERLAP = _error(
    "B0441",
    "`{name}` at byte {offset} overlaps `{other}`, which ends at byte {end}",
    "Members of a block do not share bytes. A mat2 takes 32 of them, a mat3 48, and a structure "
    "whole multiples of 16.",
)
EXTERN_ARRAY = _error(
    "B0442",
    "no host lays out a {element}[{count}] as every backend can read it",
    "Elements of an array begin 16 bytes apart in std140 and Direct3D; WGSL takes no scalars or "
    "vec2s that do. Declare it as `vec4[n]`, and read the first lanes of each element.",
)
EXTERN_NUMBER = _error(
    "B0443",
    "expected a whole number from 0 to {largest}",
    "A group and a binding are numbers of 16 bits, and no block is larger than 64 KiB. How many "
    "groups, and how large a block, a target has is checked where a material is compiled for it.",
)
EXTERN_PLACE_TAKEN = _error(
    "B0444",
    "`{name}` is bound where `{other}` is",
    "Each block that the host owns needs a group and a binding of its own.",
)

# Tools

NO_LINE_DIRECTIVES = _warning(
    "B0450",
    "{target} has no line directives, so its text is written without",
    "The source map in the reflection says of every target's text which line of the material each "
    "statement is for.",
)
TOO_LARGE_TO_DRAW = _error(
    "B0451",
    "{name} has {count} values to draw, and a picture holds {limit}",
    "Nobody reads a larger picture. `--format dot` and `--format text` have no limit; without "
    "`--all` only values that have names are shown.",
)

# Structures

STRUCT_TOO_LARGE = _error(
    "B0480",
    "`{name}` has more than {parts} parts, or more than {levels} levels of structures",
    "The parts of a structure are the numbers, vectors and matrices in it, including those of "
    "the structures in it.",
)
EMPTY_STRUCT = _error(
    "B0481",
    "the structure `{name}` has no members",
    "Give it what its values are made of: `width : float`.",
)

HOST_NAME_TAKEN = _error(
    "B0490",
    "{what} and {other} would both be called `{name}` by a host",
    "Every name that a host sets has to be unique within a shader: those of parameters, textures, "
    "lights and blocks. Those of a pass and of a rig begin with its name where the material has "
    "the same, so then that name has to be unique. Rename one of the two.",
)

# --- B05: stages and rates -----------------------------------------------------------------------

UNKNOWN_RATE = _error(
    "B0501",
    "unknown stage `{name}`",
    "`@vertex e` computes `e` at the vertices and interpolates it.",
)
NOT_AT_VERTEX = _error(
    "B0502",
    "{what} is not available at the vertex",
    "Texture reads and derivatives compare neighbouring pixels, and `frag_coord` and "
    "`front_facing` belong to a pixel. Move them out of `@vertex`, and out of what "
    "`clip_position` and captures are computed from.",
)
CANNOT_CROSS = _error(
    "B0503",
    "a {type} cannot be interpolated from the vertex to the fragment stage",
    "Numbers and vectors of numbers can be interpolated, and so can the columns of a matrix, one "
    "by one. A mesh gives a bool as a `uint`.",
)
NO_CLIP_POSITION = _error(
    "B0504",
    "`{name}` does not say where vertices go",
    "A pass, or the material it draws, defines `clip_position`, a vec4 in clip space.",
)
NO_TARGET = _error(
    "B0505",
    "`{name}` writes nothing",
    "A pass has at least one target: `target color : rgba8 = vec4(color, alpha)`.",
)

NO_ALPHA = _error(
    "B0506",
    "blending `{blend}` needs an alpha, and `{format}` has none",
    "`alpha` and `premultiplied` mix by the fourth lane of what is written. A target of fewer "
    "lanes can be added or multiplied.",
)
FACTOR_IGNORED = _error(
    "B0507",
    "`{operation}` has no factors",
    "The smaller or the larger of two numbers is kept as it is, in all APIs: `source` and "
    "`destination` mean nothing for it. Multiply what the target is given instead.",
)
NO_DEPTH = _error(
    "B0508",
    "a depth lies between 0 and 1, and this is {depth}",
    "0 is nearest, and 1 as far away as can be: `clear { depth = 1 }`.",
)

# Kernels

NO_RESULT = _error(
    "B0510",
    "`{name}` computes nothing",
    "A kernel has at least one result, whose elements it computes, or it scatters: "
    "`result after : Particle[before.count] = moved(before[index])`, "
    "`scatter bins : uint[256] add 1u at bin`.",
)
NO_EXTENT = _error(
    "B0511",
    "`{name}` does not tell its {what}",
    "It stands in brackets in the type of a result: `float[before.count]`, `uint[256]`, "
    "`image2d<rgba8>[source.size()]`.",
)
EXTENT_VARIES = _error(
    "B0512",
    "the {what} of `{name}` is not known to the host",
    "It is computed of constants, parameters, the counts of buffers and the sizes of textures, "
    "without loops.",
)
EXTENTS_DIFFER = _error(
    "B0513",
    "`{name}` has another {what} than {first}",
    "Every invocation of a kernel computes one element, or one texel, of each result. Write a "
    "second kernel for what is longer or larger.",
)
NOT_WRITABLE = _error(
    "B0514",
    "a kernel cannot write elements of the type {type}",
    "Numbers, vectors, matrices and structures of these can be written; a matrix or an array of "
    "structures inside of a structure cannot.",
)
NOT_IN_KERNEL = _error(
    "B0515",
    "{what} is not available in a kernel",
    "Derivatives, and reads of textures without a level, compare neighbouring pixels. A kernel "
    "reads `name.level(coordinate, 0)` or `name.load(texel)`.",
)
WORK_GROUP_SIDES = _error(
    "B0516",
    "this work group has {sides} sides, and the results have {dimensions} dimension",
    "A kernel over buffers counts its elements by one number, so its work groups have one side: "
    "`work_group of 128`.",
)
WORK_GROUP_SIZE = _error(
    "B0517",
    "a work group has 1 to {most} invocations, and not {size}",
    "Each side is at least 1, and the product of all sides is the number of invocations. Some "
    "profiles take fewer, and say so when they are compiled for.",
)

NOT_SCATTERED = _error(
    "B0518",
    "`{name}` cannot be scattered: its elements are of the type {type}",
    "Only `int` and `uint` come out the same in whatever order invocations add them: count in "
    "fixed-point steps, or sum by a fold.",
)

# Expansions

NO_SUCH_CORNER = _error(
    "B0520",
    "there is no {what} {index}: the last one is {last}",
    "Corners are numbered from 0: a point has one, a line two and a triangle three. With adjacency "
    "a line has four and a triangle six. A patch has as many as it has control points, and each of "
    "its edges has two ends.",
)
WHICH_CORNER = _error(
    "B0521",
    "`{name}` of which {what}?",
    "`corner[0].position` is the position of the first corner of the primitive that is expanded.",
)
OF_WHICH_CORNER = _error(
    "B0522",
    "this differs between the corners of a primitive",
    "How many strips there are, which of them are emitted, and which corner they are like is asked "
    "once for each primitive. Say which corner is meant: `corner[0].position`.",
)
LIKE_WHICH_CORNER = _error(
    "B0523",
    "which corner are {count} vertices like? a {primitive} has {corners}",
    "What is not said of an emitted vertex is as at a corner of the primitive. If there are no "
    "more vertices than corners, that is the one with the vertex's number. Otherwise say it: "
    "`strip of 4 as i like corner[i mod 3] { … }`.",
)
NO_TRIANGLES = _error(
    "B0524",
    "a {shape} of {count} vertices is no whole number of triangles",
    "A strip has three vertices or more, and a list a multiple of three.",
)
NO_STRIPS = _error(
    "B0525",
    "this expansion emits nothing",
    "Say what a primitive turns into: `expand point { strip of 4 as i { position = … } }`.",
)
EXPANDS_TOO_FAR = _error(
    "B0526",
    "a primitive would turn into {count} vertices, and {most} is the most",
    "Let ranges say more closely how many strips there are, or expand a finer mesh by less.",
)
TWO_EXPANSIONS = _error(
    "B0527",
    "`{name}` expands its primitives twice",
    "A record has one expansion, with as many groups of strips as it needs. Two mixins that each "
    "have one cannot be combined.",
)
NOT_SO_MANY_LAYERS = _error(
    "B0528",
    "render targets have 1 to {most} layers, and not {count}",
    "`layers of 6` says how many layers each render target of a pass has. More than 256 are not "
    "guaranteed to exist.",
)
NO_LAYER = _error(
    "B0529",
    "`{name}` draws into layers, but nothing says into which",
    "An expansion of the pass or of its material says to which layer a strip is drawn: it sets "
    "their slot `layer : int`. The nearest layer counts.",
)
LAYER_WITHIN_STRIP = _error(
    "B0530",
    "vertices of one strip have different layers",
    "A strip is drawn to one layer, so `layer` may depend on the strip's number, on "
    "`primitive_index` and on values at corners with a number that is the same for all of the "
    "strip's vertices.",
)

# Work groups

NO_WORK_GROUP = _error(
    "B0531",
    "{what} has no work groups, so there is no `{name}`",
    "A work group is what runs together of a kernel over buffers: only there its values can be "
    "joined.",
)
COUNT_PER_GROUP = _error(
    "B0532",
    "`{name}` has as many elements as there are work groups, and not a number of its own",
    "Write `T[] per group`: the host computes the number from that of the invocations, and from "
    "how large the work groups are.",
)
IMAGE_PER_GROUP = _error(
    "B0533",
    "`{name}` is an image, which has a texel for each invocation",
    "What is written once for each work group is an element of a buffer: "
    "`result name : vec4[] per group = …`.",
)

# Scattering

IMPOSSIBLE_SETTING = _error(
    "B0536",
    "`{name}` is {value}, and {possible} are possible",
    "Stencil values and their masks have eight bits. A bias is counted in the smallest steps of "
    "depths, of which floats have 2^24 between two powers of two. Every API draws with 1 or 4 "
    "samples for each pixel, and not every one with another number.",
)
ONE_SAMPLE = _error(
    "B0537",
    "`{name}` has one sample for each pixel: {reason}",
    "Samples are joined to their mean at the end. Not every API can do that with floats of 32 "
    "bits or with layers that are drawn at once, and with several samples each API draws lines by "
    "rules of its own.",
)
NO_KERNEL_EXTENT = _error(
    "B0540",
    "`{name}` does not say for how many elements it runs",
    "A result with an element for each invocation would say it. Other kernels say it by a member "
    "of their own: `runs over pixels.count`.",
)
WRITTEN_TWICE = _error(
    "B0541",
    "`{name}` is both a result and scattered",
    "Each buffer is written in one way. Scatter to a buffer of its own.",
)
NO_SUCH_ELEMENT = _error(
    "B0542",
    "there is no element {index} of `{name}`",
    "Elements are numbered from 0, and the number in brackets behind the type says how many there "
    "are.",
)
NEVER_POSITIVE = _error(
    "B0543",
    "the {what} of `{name}` is {found}",
    "A kernel computes at least one element. What stands here has to be above 0, at least for some "
    "values of the parameters.",
)

# Kernels over images

MIXED_RESULTS = _error(
    "B0550",
    "`{name}` is {kind}, and the first result is {first}",
    "An invocation computes an element by its number, or a texel by its place. Write a second "
    "kernel.",
)
NO_FORMAT = _error(
    "B0551",
    "`{name}` does not say of which format its texels are",
    "An image has one format, as a render target has: `image2d<rgba16f>[size]`.",
)

# Captures

CAPTURES_AND_DRAWS = _error(
    "B0560",
    "`{name}` captures vertices, so it draws nothing",
    "A pass that captures has no render targets, no layers of them, no `raster` and no `depth`, "
    "and discards nothing. Draw in another pass.",
)
CANNOT_CAPTURE = _error(
    "B0561",
    "a {type} cannot be captured",
    "Floats, ints, uints and vectors of these can be captured. Capture a bool as `if b then 1u "
    "else 0u`, and a matrix column by column.",
)
CAPTURES_TOO_MUCH = _error(
    "B0562",
    "{count} numbers of each vertex are captured, and {most} is the most",
    "Every device captures so many numbers of a vertex: a vec3 has three.",
)
POINTS_NOT_CAPTURED = _error(
    "B0563",
    "points are captured, and `{name}` draws",
    "A pass with members such as `capture place : vec3 = position` captures points. What is drawn "
    "are triangles or lines: `strip of 4 as i { … }` makes a square of a point.",
)
DIFFERENT_PRIMITIVES = _error(
    "B0564",
    "an expansion emits points, lines or triangles, and only one of these",
    "All groups of an expansion are `points`, or all are `line`s, or all are strips and lists of "
    "triangles.",
)
NO_POINTS = _error(
    "B0565",
    "a group of {count} points emits nothing",
    "`points of n` emits one point or more.",
)

# Tessellations

TWO_TESSELLATIONS = _error(
    "B0571",
    "`{name}` divides its patches twice",
    "A material has one tessellation. Two mixins that each have one cannot be combined.",
)
WRONG_POINTS = _error(
    "B0573",
    "`{patch}` patches have from {least} to {most} control points, and not {count}",
    "Each end of a patch is a control point, and 32 is the most that all targets have: "
    "`tessellate quad of 16 …`.",
)
WRONG_ENDS = _error(
    "B0574",
    "`{patch}` patches have {wanted} ends, and here are {count}",
    "The ends are the numbers of the control points at the corners of a patch, in order. Those of "
    "a quad go round it: `tessellate quad of 16 ends [0, 3, 15, 12] …`.",
)
NO_SUCH_END = _error(
    "B0575",
    "there is no control point {index} for an end: the last one is {last}",
    "Control points are numbered from 0.",
)
END_TWICE = _error(
    "B0576",
    "the control point {index} is two ends of the patch",
    "Between two ends there has to be an edge.",
)
LEVEL_DIFFERS = _error(
    "B0577",
    "this differs along an edge",
    "The level of an edge is asked once, and has to be the same for both patches beside it. So it "
    "depends on the two ends of the edge, `end[0].position` and `end[1].position`, and on what is "
    "the same all over a draw.",
)
INNER_LEVEL_DIFFERS = _error(
    "B0578",
    "this differs between the vertices of a patch",
    "A level is asked once for each patch. Say which control point is meant: `corner[0].position`.",
)
LEVEL_OUT_OF_RANGE = _error(
    "B0579",
    "this is {level}, and patches are divided by levels above 0 and up to {most}",
    "A level is the number of steps into which an edge or the inside of a patch is divided. It may "
    "leave this range for some values of what it reads: larger levels count as the largest one, "
    "and a patch with an edge whose level is not above 0 is not drawn.",
)
NOT_OF_THIS_PATCH = _error(
    "B0580",
    "`{patch}` patches have no `{word}`",
    "`lines` says how many lines an isoline patch has, and `inside` how finely triangles and quads "
    "are divided away from their edges.",
)
NO_SEGMENTS = _error(
    "B0582",
    "a line of {count} vertices goes nowhere",
    "`line of n` has two vertices or more, and a segment from each to the next one.",
)
NOT_OF_PATCHES = _error(
    "B0590",
    "the parts of a divided `{patch}` patch are `{made}` primitives, and not `{primitive}`",
    "Where a material divides its patches, `expand` says what each part of a patch turns into. The "
    "parts of triangle and quad patches are triangles, and those of isoline patches are lines. "
    "They know nothing of the vertices next to them.",
)

# --- B06: rigs and lights ------------------------------------------------------------------------

OUTSIDE_LIGHT = _error(
    "B0601",
    "`{name}` is known only in a `term … per light`",
    "`light` is the light that is summed over, inside of a `term … per light`. A light reads its "
    "own slots by their names alone.",
    of_absence=True,
)
UNKNOWN_LIGHT = _error(
    "B0602",
    "`{name}` is not a light",
    "A rig entry names a light type: `sun : MyLight`.",
)
NO_SUCH_RIG = _error(
    "B0604",
    "which rig is meant? {known}",
    "If a file has one rig, that is used. If it has several, name one: `--rig Studio`.",
)
TERM_WITHOUT_SURFACE = _error(
    "B0605",
    "`{name}` needs a surface to shade",
    "Terms read the slots of the material that uses them, so they are called in materials, lights "
    "and passes, not in functions or constants.",
)
EMPTY_RIG = _error(
    "B0606",
    "`{name}` is summed over the lights of a rig that has none",
    "Add a light to the rig, or use a term that is not `per light`.",
)
LIGHT_LACKS_SLOT = _error(
    "B0607",
    "light `{light}` has no `{slot}`",
    "A `per light` term is applied to every light of the rig, so it can read only slots that all "
    "of them have.",
)
WITH_NEEDS_TERM = _error(
    "B0608",
    "`with` replaces the slots that a term reads",
    "Write it after the call of a term: `name(k) with { normal = coat }`.",
)
NO_ARRAY_OF = _error(
    "B0609",
    "there can be no array of `{light}`",
    "The parameters of an array of lights are kept in one uniform array. So the light needs at "
    "least one parameter, and it cannot have textures.",
)

# --- B07: targets --------------------------------------------------------------------------------

UNSUPPORTED = _error(
    "B0701",
    "{target} has no {feature}",
    "The target's language cannot express this, and no exact replacement is known.",
)
TOO_MANY = _error(
    "B0702",
    "{count} {what}, but {target} has only {limit}",
    "The limit is what every device of the target is guaranteed to have, and its compilers take.",
)
REJECTED = _error(
    "B0703",
    "{checker} rejects `{file}`: {text}",
    "Every text that Burnish writes should be accepted, so this is a fault of Burnish and not of "
    "the material. Please report it together with the material.",
)
DOUBTED = _warning(
    "B0704",
    "{checker} about `{file}`: {text}",
    "The text was accepted, but with this remark.",
)
TOOL_BROKE = _error(
    "B0705",
    "{checker} gives no answer about `{file}`: {reason}",
    "The tool crashed or took too long. That is the tool's fault. The shader has not been checked.",
)
TOOL_MISSING = _error(
    "B0706",
    "{checker} cannot check anything: {problem}",
    "`burnish doctor` lists the tools, with a command that installs each missing one.",
)

# --- B08: frames ---------------------------------------------------------------------------------

FRAMES_ONLY = _error(
    "B0801",
    "{what} has a meaning in frames only",
    "A frame draws a pass several times: `sum lamp in rig : Lit(screen)` once for each light, "
    "`each i in 0..4 : Depth(scene)` once for each layer of its results. Loops over numbers go "
    "over a range, `sum i in 0..4 : e`.",
)
NO_STEP = _error(
    "B0802",
    "this is no step of a frame",
    "A step draws a pass or runs a kernel: `name = Pass(what, size) with { input = value }`, "
    "`name = Kernel()`. What it makes is read as `name.target`.",
)
NOT_LEFT = _error(
    "B0803",
    "this is no {what}",
    "What a step makes has names: the targets of its pass, `depth`, or the results of its kernel. "
    "They are read as `step.name`; textures and buffers of the host are declared by `map` and "
    "`buffer`.",
)
NOT_DRAWN = _error(
    "B0804",
    "a pass cannot draw this",
    "The first argument says what is drawn: models that the frame declares by `models name`, or "
    "`screen`, which is one triangle over the whole result, or `vertices(n)`, as many vertices as "
    "that which have nothing but their numbers.",
)
STEP_ARGUMENTS = _error(
    "B0805",
    "`{name}` takes {expected}",
    "A pass is told what it draws and, if that is not the frame's own size, where to: "
    "`Pass(models)`, `Pass(screen, size / 2)`, `Pass(models, other_step)`. A kernel knows by its "
    "results how often it runs. All else is set by `with { name = value }`.",
)
INPUT_MISSING = _error(
    "B0806",
    "`{step}` needs `{name}`",
    "A texture of a pass or a kernel that has no default, and a buffer, is set where the frame is "
    "put together: `with { name = step.target }`, or `with { name = albedo }` where the frame has "
    "a `map albedo` that its host binds.",
)
PLACES_DIFFER = _error(
    "B0807",
    "`{first}` and `{second}` do not fit together: {reason}",
    "What is drawn at once has one size and equally many layers. What a pass draws over has the "
    "format of its own target.",
)
NO_OUTPUT = _error(
    "B0808",
    "frame `{name}` has no output",
    "`output picture = step.target` says what the host gets. What no output needs is not drawn.",
)
NOT_ADDED = _error(
    "B0809",
    "`{target}` of `{step}` is not blended, so each light would replace the one before",
    "`sum lamp in rig` draws once for each light into the same targets. Declare the pass with "
    "`blend add`.",
)
NO_RANGE_OF_STEPS = _error(
    "B0810",
    "steps cannot be repeated over this",
    "`each i in 0..4` and `iterate` need numbers that are known when compiling, 256 at most. "
    "`each face in cube` draws the six faces of a cube, `each level in mips(5)` so many mip "
    "levels, and `sum lamp in rig` once for each light.",
)
NOT_NEEDED = _warning(
    "B0811",
    "nothing needs `{name}`, so it is not drawn",
    "A step is drawn if an output of the frame depends on it. Make it one, or remove it.",
)
NO_MATERIAL_TO_DRAW = _error(
    "B0812",
    "no material of this file is among the models `{name}`",
    "Models of a scene have the materials that the file declares and that are not abstract. "
    "`models name : Base` are those whose material extends `Base`.",
)
NOT_FILTERED = _error(
    "B0813",
    "`{name}` of `{step}` filters its texels, and `{format}` cannot be filtered",
    "Many devices filter no 32-bit floats. Declare the texture with `{ filter = nearest, "
    "mip = none }`, or the target with a 16-bit format.",
)
FRAME_CYCLE = _error(
    "B0814",
    "`{name}` needs itself: {cycle}",
    "A frame draws its steps one after the other, so none of them can need what comes of it. "
    "`previous(step.target)` is what the last frame left there.",
)
NOTHING_BEFORE = _error(
    "B0815",
    "in the first frame, nothing has left `{name}`",
    "A buffer has as many elements as what made it says, and before the first frame nothing did. "
    "`previous(moved.after, seeded.after)` reads the second buffer in the first frame.",
)
NO_VERTEX_INPUTS = _error(
    "B0816",
    "`{step}` reads the vertex input `{input}`, and there are no models that have it",
    "`screen` and `vertices(n)` draw vertices that have nothing but their numbers: the pass makes "
    "all else of `vertex_index`, also `clip_position`.",
)
NOT_ON_HOST = _error(
    "B0817",
    "a host cannot compute {what}",
    "The numbers of a frame are computed by the program that draws it, from parameters and the "
    "sizes of textures. It has no `iterate` and no structures, and reads no texels: a pass or a "
    "kernel does.",
)
NO_SHARED_VERTICES = _error(
    "B0818",
    "`{step}` draws {primitives}, and vertices without models are points or triangles",
    "Lines, primitives with what lies next to them, and patches come of a mesh, whose triangles "
    "have vertices in common. Vertices that have nothing but their numbers share none.",
)
NOT_BROUGHT = _error(
    "B0819",
    "`{name}` of a {record} cannot be what a step leaves",
    "Only lights bring the steps that make their textures, such as a shadow map. For all else a "
    "frame says by `with` what is read.",
)
NOT_CLEARED = _error(
    "B0820",
    "`{name}` is drawn over, so it is not cleared",
    "A step clears what it draws to for the first time. What it draws over stays as another step "
    "has left it.",
)
NO_BLEND_CONSTANT = _error(
    "B0821",
    "`{target}` of `{step}` is blended by a constant, and the frame does not say which",
    "`constant` and `one_minus_constant` are a colour that is set for the whole step: "
    "`Faded(screen) with { blend_constant = vec4(0.5) }`.",
)
NOT_BLENDED = _error(
    "B0822",
    "`{target}` of `{step}` is blended, and `{format}` cannot be blended everywhere",
    "WebGPU and WebGL 2 blend 32-bit floats only where a device has an extension for it. "
    "Draw to a format of 16-bit floats.",
)
NO_SUCH_SIZE = _error(
    "B0823",
    "`{name}` cannot have its size: {reason}",
    "A step draws to textures of the size that stands behind what it draws, or of the frame's "
    "`size`. Sizes that are known only when the frame is drawn are checked then.",
)
AREA_OUTSIDE = _error(
    "B0824",
    "the {area} of `{step}` cannot be meant: {reason}",
    "A viewport lies within the targets, and a scissor has some of their texels: left, top, width "
    "and height, counted from the upper left corner. Those that are known only when the frame is "
    "drawn are checked then.",
)
