"""B03: types, meanings, reads of textures, arrays and loops."""

from __future__ import annotations

from .row import error, warning

WRONG_TYPE = error(
    "B0301",
    "expected {expected}, found {found}",
    "Types are never converted silently, except whole-number literals to `float`. Write the "
    "constructor: `float(n)`, `vec3(x)`.",
)
NO_OVERLOAD = error(
    "B0302",
    "`{name}` cannot be called with ({arguments})",
    "The number and the types of the arguments have to match one of the candidates. Arguments "
    "that share a type parameter need the same type.",
)
WRONG_COUNT = error(
    "B0303",
    "`{name}` takes {expected}, found {found}",
    "Arguments are given by position or by name. Only those with a default can be left out.",
)
NO_MEMBER = error(
    "B0304",
    "{type} has no member `{name}`",
    "Vectors have lanes (`v.xyz`, `c.rgb`), structures members, `light` and `material` slots.",
)
NO_OPERATOR = error(
    "B0305",
    "no `{operator}` between {left} and {right}",
    "Arithmetic needs two operands of the same shape, or one of them a single number, and lanes "
    "of the same kind. `and` and `or` take bools.",
)
OVERRIDE_CHANGES_TYPE = error(
    "B0306",
    "`{name}` is {expected} in `{base}`, and {found} here",
    "An override keeps the type, because everything the base computes from the slot relies on it. "
    "Only the length of an array may be another one.",
)
NOT_CALLABLE = error(
    "B0307",
    "{found} cannot be called",
    "Functions, terms and type constructors are called with arguments, textures with a coordinate.",
)
NO_PREFIX_OPERATOR = error(
    "B0308",
    "no `{operator}` of {left}",
    "`-` takes numbers, `not` takes a `bool`.",
)
BRANCH_TYPES = error(
    "B0309",
    "the branches differ: {then} and {otherwise}",
    "An `if` is one value, so both of its branches have one type.",
)
NOT_INDEXABLE = error(
    "B0310",
    "{type} has no elements to index",
    "Vectors, matrices and arrays have elements. The lanes of a vector can also be read by name, "
    "as in `v.x`.",
)
SPACE_COUNT = error(
    "B0311",
    "`{type}` names {expected}, found {found}",
    "`point<world>` names one space, `transform<object, world>` two, plain types none.",
)
NO_RANGE = error(
    "B0312",
    "{type} cannot have a range",
    "Numbers are bounded by `in a..b`, vectors of them lane by lane, and arrays of both.",
)
WRONG_MEANING = error(
    "B0320",
    "expected {expected}, found {found}",
    "The meaning of a value is part of its type: a point is not a vector, a colour is not a "
    "direction, and a value in one space is not a value in another. `x in space` converts "
    "between spaces, `(x as type)` gives another meaning to the same numbers, and `vec3(x)` "
    "takes them as bare numbers, which fit everywhere.",
)
MIXED_SPACES = error(
    "B0321",
    "`{operator}` of values in two spaces: {left} and {right}",
    "Coordinates of two spaces are measured from different origins along different axes. Bring "
    "both into one space first: `x in space`.",
)
MIXED_MEANINGS = error(
    "B0322",
    "`{operator}` means nothing between {left} and {right}",
    "The difference of two points is a vector, and a vector moves a point. The sum of two points "
    "would depend on where the origin lies. Colours, angles and geometry do not mix. Calls such "
    "as `vec3(x)` or `float(x)` take a value as bare numbers.",
)
NOT_OF_A_POINT = error(
    "B0323",
    "`{operator}` cannot be taken of a {left}",
    "A point is a place. It has a distance from another point, but no length of its own, and "
    "there is a direction from one point to another, but no direction of a point.",
)
NOT_UNIT = error(
    "B0324",
    "expected {expected}, found {found}, which may not have length one",
    "A `direction` or `normal` that is declared has length one, and formulas rely on that. The "
    "compiler has to be able to prove it: the value is the result of `normalize`, another "
    "direction, or made of numbers that show it. Interpolation does not keep the length, since "
    "the mean of two directions is shorter.",
)
BARE_ANGLE = error(
    "B0325",
    "`{text}` is not an angle: it has no unit",
    "Angles are written with their unit, `20deg` or `0.35rad`. Only zero needs no unit.",
)
IN_NO_SPACE = error(
    "B0326",
    "{found} is in no space, so there is nothing to convert",
    "`x in space` takes points, vectors, directions and normals, because their types name the "
    "space that they are in.",
)
NO_CONVERSION = error(
    "B0327",
    "there is no transform from {found} into `{space}`",
    "Values are converted by slots that are declared as `transform<A, B>` or `basis<A, B>` in "
    "the record, its surface or the pass. Points need transforms. Only points can be converted "
    "into clip space, and nothing can be converted out of it.",
)
UNINFERABLE_PARAMETER = error(
    "B0328",
    "no argument of `{function}` determines `{name}`",
    "The compiler finds out from the arguments what a type parameter stands for, so the type of "
    "at least one argument without a default has to name it.",
)
AMBIGUOUS_CALL = error(
    "B0329",
    "several functions `{name}` take ({arguments}) equally well",
    "None of them takes the arguments better than the others. Say what is meant: of which type a "
    "number is, as in `float(1)` or `vec3(1)`, what numbers mean, as in `(v as rgb)`, or the name "
    "of an argument that only one of them has.",
)
UNKNOWN_ARGUMENT = error(
    "B0330",
    "`{function}` has no argument `{name}`",
    "An argument that is given by name has the name that the declaration gives it, as in "
    "`ring(p, width = 2)`.",
)
ARGUMENT_TWICE = error(
    "B0331",
    "the argument `{name}` is given twice",
    "Each argument is given once: by its position, or by its name.",
)
POSITION_AFTER_NAME = error(
    "B0332",
    "an argument without a name stands behind one with a name",
    "Arguments that are given by position come first, and then those that are given by name, in "
    "any order.",
)
MISSING_ARGUMENT = error(
    "B0333",
    "`{name}` needs {missing}",
    "Only arguments with a default can be left out of a call.",
)
NOT_BY_NAME = error(
    "B0334",
    "`{name}` takes its arguments by position, without names",
    "The arguments of functions, terms, structures and reads of textures have names. Those of "
    "builtins, of constructors such as `vec3`, and of the steps of a frame have none.",
)
LATER_ARGUMENT = error(
    "B0335",
    "the default of `{argument}` reads `{name}`, which has no value before it",
    "A default can read the arguments that are declared before its own, and what the function "
    "itself can read: constants of the file and, in a term, slots of the surface. `light` has no "
    "value there, as arguments are the same for all lights.",
)
NO_NUMBER = error(
    "B0340",
    "`{operator}` takes numbers, and {left} is an enumeration",
    "Members of an enumeration are told apart by `==` and `!=`, chosen by `if`, and may be "
    "indices of an array. `int(x)` is the number of a member, from 0, and `(n as Mode)` the "
    "member of a number.",
)
MIXED_ENUMS = error(
    "B0341",
    "`{operator}` of members of two enumerations: {left} and {right}",
    "A member is only like a member of the same enumeration, whatever their names are.",
)
MEMBER_AND_NUMBER = error(
    "B0342",
    "`{operator}` of a member of {left} and something else",
    "A member of an enumeration is no number, and a number is no member. `int(x)` is the number "
    "of a member, from 0, and `(n as Mode)` the member of a number.",
)
UNDECIDED_CALL = error(
    "B0343",
    "`{name}` with ({arguments}) gives {results}",
    "Functions that have the same arguments differ in their results. The type that is wanted "
    "decides: that of a slot, a parameter, an argument, a result or the other side of a choice, or "
    "one behind `as`. Operators and builtins want no type.",
)
TEXTURE_LACKS_READ = error(
    "B0350",
    "`{type}` has no {read}",
    "Colours are filtered, depths are compared with a reference, and whole numbers are loaded. "
    "Single texels can be loaded from all textures but cubes.",
)
NOT_A_LANE = error(
    "B0351",
    "this operand has to be a constant in 0..3",
    "On most devices, the lane of the texels that is gathered is part of the instruction.",
)
SETTING_WITHOUT_USE = error(
    "B0352",
    "`{name}` does not apply to `{type}`",
    "Cubes do not wrap, flat textures have no axis w, and only where something wraps by `border` "
    "has it a colour. An anisotropy takes linear filters. Only depths are compared, depths are "
    "read at level 0, and whole numbers are not filtered. Depths and whole numbers are always "
    "data, and textures `of rgb` are colours.",
)
MEMBER_COUNT = error(
    "B0380",
    "`{name}` has the members ({members}), found {found}",
    "A structure is made by a call with a value for each member, in the order of the declaration.",
)
ELEMENTS_DIFFER = error(
    "B0381",
    "the first element is {first}, this one {found}",
    "All elements of an array have one type. Only literals adapt: `[1, x]` is an array of floats "
    "if `x` is one.",
)
UNBOUNDED_LOOP = error(
    "B0382",
    "the maximum number of iterations of this loop is not known",
    "Every loop has to end, and the compiler has to know after how many iterations at most. It "
    "knows that from constants, from the ranges of parameters, and from `clamp` and `mod`.",
)
NO_INITIAL = error(
    "B0383",
    "`{word}` of no terms has no value",
    "The fold may have no terms at all. Say what its result is then: `min i in a..b from x : e`.",
)
STATE_CHANGES = error(
    "B0384",
    "`{name}` is {before} at the start, and {after} after an iteration",
    "A state keeps its type. `iterate x from 1` begins with an `int`, `from 1.0` with a `float`.",
)
STATE_TOO_LARGE = error(
    "B0385",
    "the state has {count} parts, and {most} are the most that a loop can have",
    "Every part of a state is a variable of the loop. Compute what does not change outside of "
    "the loop.",
)
READ_IN_LOOP = error(
    "B0386",
    "{what} {does}, which may have left the loop already",
    "The result is undefined where other pixels have left the loop. Read the texture with an "
    "explicit level, or before the loop.",
)
CROSSING_IN_LOOP = error(
    "B0387",
    "a value that changes in a loop cannot be computed at the vertices",
    "Each iteration would need a varying of its own. That is done for folds of at most 16 "
    "iterations whose bounds are constants, if they come to at most 4096 operations. Otherwise put "
    "`@vertex` in front of the whole loop.",
)
CROSSING_PER_LIGHT = error(
    "B0388",
    "a value that differs between lights cannot be computed at the vertices for each of them",
    "Put `@vertex` in front of the call of the term, so that the sum over the lights is "
    "interpolated: `@vertex shaded(…)`.",
)
LOOPS_TOO_NESTED = error(
    "B0389",
    "loops are nested too deeply: more than {most}",
    "Compilers of shading languages do not take many more. Loops in functions that are called in a "
    "loop count as well. Join several of these loops into one.",
)
BYTES_OF_COLOR = warning(
    "B0390",
    "`{written}` is much brighter than white",
    "The lanes of a colour are amounts of light, of which white has 1. A colour that is known by "
    "its bytes is written as `#ff8000`.",
)
COSINE_OF_VECTOR = warning(
    "B0391",
    "`{function}` gets the cosine of an angle times a length that is not known",
    "The dot product of two directions is the cosine of the angle between them. A vector that is "
    "longer makes it that many times larger, and a power of it, or an angle, means nothing then. "
    "If the length is meant, write `vec3(v)`: numbers without a space are not judged.",
)
ORDER_OF_ARGUMENTS = warning(
    "B0394",
    "the arguments of `{function}` seem to be in another order",
    "`clamp(x, low, high)` and `mix(a, b, share)` begin with what is limited or mixed, and "
    "`smoothstep(low, high, x)` ends with what is compared. If the order is meant, name one of "
    "the numbers by an equation.",
)
WHOLE_RADIANS = warning(
    "B0395",
    "`{function}` takes radians, and {number} is {turns} turns",
    "A number without a unit is an angle in radians. Degrees are written `90deg`.",
)
