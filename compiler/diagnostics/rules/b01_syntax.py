"""B01: texts that do not follow the grammar."""

from __future__ import annotations

from .row import error, warning

UNEXPECTED = error(
    "B0101",
    "expected {expected}, found {found}",
    "The text does not follow the grammar here. A file is a set of declarations, and the body of a "
    "declaration a set of equations `name = expression`.",
)
UNKNOWN_CHARACTER = error(
    "B0102",
    "unexpected character {character}",
    "Names are made of the letters a to z, digits and `_`. Other characters belong in comments.",
)
FOREIGN_OPERATOR = error(
    "B0103",
    "Burnish has no operator `{operator}`",
    "Logic is spelt `and`, `or`, `not`; the remainder `mod`; a choice `if c then a else b`. There "
    "is no assignment: a name is given its value once, by an equation.",
)
BAD_NUMBER = error(
    "B0104",
    "`{text}` is not a number",
    "Numbers are written `2`, `7u`, `0xFF`, `0.5`, `1e-3`, angles `30deg` or `0.5rad`, "
    "lengths `5mm` or `2m`. A float "
    "needs no suffix, and there are digits after its point.",
)
BAD_COLOR = error(
    "B0105",
    "`{text}` is not a colour",
    "Colours have 3, 6 or 8 hexadecimal digits: `#rgb`, `#rrggbb`, `#rrggbbaa`.",
)
UNFINISHED_TEXT = error(
    "B0106",
    'this text has no closing `"`',
    "Quoted texts are names of files. They end on the line on which they begin.",
)
UNFINISHED_COMMENT = error(
    "B0107",
    "this comment has no closing `*/`",
    "A comment from `/*` runs to the next `*/`; comments do not nest.",
)
UNCLOSED = error(
    "B0108",
    "this `{opening}` is never closed",
    "Every opening bracket needs its closing one.",
)
CHAINED_COMPARISON = error(
    "B0109",
    "comparisons do not chain",
    "`a < b < c` would compare a bool with `c`. Write `a < b and b < c`.",
)
RESERVED_WORD = error(
    "B0110",
    "`{word}` is a reserved word and cannot be a name",
    "Only these words are reserved: and, else, false, if, mod, not, or, then, true.",
)
TOO_NESTED = error(
    "B0111",
    "brackets are nested too deeply: more than {limit}",
    "Give the inner parts names of their own: an equation for each costs nothing.",
)
UNKNOWN_EDITION = error(
    "B0112",
    "unknown edition `{edition}`",
    "The first line may name the edition of the language that the file is written in. This "
    "compiler knows edition 1.",
)
STRAY_DOC = warning(
    "B0113",
    "this doc comment describes nothing",
    "A `///` comment stands above a declaration or member, or on the line it ends on. Use `//!` "
    "for the file as a whole, and `//` for a remark of any other kind.",
)
UNPARENTHESISED = error(
    "B0114",
    "`{word}` needs parentheses here",
    "An `if`, a fold such as `sum`, or an `iterate` extends as far to the right as possible. As "
    "a part of a larger expression it needs parentheses.",
)
BAD_NAME = error(
    "B0115",
    "`{text}` is not a name",
    "Names are made of the letters a to z and A to Z, digits and `_`, which every shading "
    "language can spell.",
)
MERGE_CONFLICT = error(
    "B0116",
    "a merge conflict is left in this file",
    "A version control system left both sides here, between lines of `<<<<<<<`, `=======` and "
    "`>>>>>>>`. Keep the side that is meant and remove these lines; only the first side is read.",
)
