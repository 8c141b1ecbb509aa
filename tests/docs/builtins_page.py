"""The manual of the builtins, made from their table."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping

from burnish.stdlib.builtins import (
    BUILTINS,
    Builtin,
    accuracy,
    arithmetic,
    bits,
    common,
    comparison,
    conversion,
    derivative,
    exponential,
    geometry,
    hyperbolic,
    matrix,
    packing,
    texture,
    trigonometry,
    work_group,
)
from burnish.stdlib.builtins.accuracy import PLATFORMS, Accuracy, Platform, Promise
from burnish.stdlib.builtins.elsewhere import KEYWORDS, METHODS, TYPES, VALUES
from burnish.stdlib.other_names import FUNCTIONS, NODES, SYNONYMS, Instead, Meant
from burnish.targets.conformance.measured import ENVELOPES

from .tables import NOTE, cell, codes, table

BUILTINS_HEAD = f"""{NOTE}

# Builtin functions and operators

This page is made from the table in `stdlib/builtins`, which declares all of them.

A builtin has **one meaning on every backend**. For operands where backends differ or do not
define the result, the entry says under *Outside* what Burnish defines. The compiler adds a guard
to get this result, and leaves it out where it can prove that there are no such operands. See
[guards](language.md#guards-and-unguarded) in the language reference.

**Signatures.** A letter stands for one type throughout a signature:

| letter | types |
|---|---|
| `T` | `float`, `vec2`, `vec3`, `vec4` |
| `V` | `vec2`, `vec3`, `vec4` |
| `S` | `float` |
| `N` | `T`, and `int`, `uint`, `ivec2` … `ivec4`, `uvec2` … `uvec4` |
| `I` | `int`, `uint`, `ivec2` … `ivec4`, `uvec2` … `uvec4` |
| `L` | one lane of `N` |
| `U`, `J` | `uint`, and `int`, with as many lanes as `I` or `T` |
| `B` | `bool`, `bvec2`, `bvec3`, `bvec4` |
| `P`, `Q` | `N` and `B`; `bool`, with as many lanes as `P` or `N` |
| `M`, `A` | `mat2`, `mat3`, `mat4`, `mat2x3` … `mat4x3`; the transpose of `M` |
| `C`, `O` | the vector that is a column of `M`, and one that is a row |
| `Z`, `Y` | a matrix with a row for each column of `M`; the product of `M` and `Z` |
| `F`, `D` | `texture2d`, `texture3d`, `texture_cube`; `depth2d`, `depth_cube` |
| `K` | `vec2`; for `3d` textures and cubes, `vec3` |
| `G`, `H`, `X` | all `2d` and `3d` textures; all `2d_array` ones; all textures |
| `W` | `ivec2`; for `3d` textures, `ivec3` |
| `E` | `vec4`; for depths, `float`; for integers, `ivec4` or `uvec4` |

Where a letter allows vectors, a scalar may be combined with a vector. It counts as a vector with
this scalar in every lane: `max(v, 0)`, `mix(0, v, t)`.

**Accuracy** is the largest error of the float32 operation that the specifications allow. *Ulp* is
a unit in the last place of the result; *correctly rounded* is one of the two floats around the
exact result; *inherited* is the error of the expression that defines the function; `|x|` is the
magnitude of the operand, in a quotient that of the divisor. **Assumed** is what a specification
does not say. **Measured** is the largest error that was found on drivers, over 65 536 operands; if
one becomes four times as large, a test fails. The other numbers are from these sections, if a line
does not name another one:

"""

THEMES = (
    ("Arithmetic", arithmetic.ROWS),
    ("Comparison and logic", comparison.ROWS),
    ("Rounding, limits and blending", common.ROWS),
    ("Powers, roots and logarithms", exponential.ROWS),
    ("Angles", trigonometry.ROWS),
    ("Hyperbolic functions", hyperbolic.ROWS),
    ("Geometry", geometry.ROWS),
    ("Matrices", matrix.ROWS),
    ("Conversion", conversion.ROWS),
    ("Bits", bits.ROWS),
    ("Packing", packing.ROWS),
    ("Textures", texture.ROWS),
    ("Derivatives", derivative.ROWS),
    ("Work groups", work_group.ROWS),
)

WORDS: Mapping[str, str] = {"and": "and", "or": "or", "not": "not", "mod": "mod"}
"""Operators that Burnish writes as words."""

CONSTRUCTORS = {"to_float": "float", "to_int": "int", "to_uint": "uint"}


def builtins_page() -> str:
    """The manual of the builtins."""
    assert [row for _, rows in THEMES for row in rows] == list(BUILTINS.values())
    sections = "\n".join(
        f"- {title}: {accuracy.SECTIONS[name]}" for name, title in PLATFORMS.items()
    )
    lines = [BUILTINS_HEAD + sections + "\n"]
    for title, rows in THEMES:
        lines.append(f"## {title}\n")
        for row in rows:
            lines += _builtin(row)
    lines += _elsewhere()
    return "\n".join(lines).rstrip() + "\n"


ELSEWHERE_HEAD = """## Names in other languages

Every function of GLSL 4.50 and ES 3.00, of HLSL's list of intrinsics and of WGSL is listed above
under the same name, or in this table. Messages about unknown names take their advice from it,
too. Here `x`, `y`, `z` are floats, `n` and `m` ints, `u` and `k` uints, `v` and `w` `vec3`s, `p`
and `q` `vec4`s, `c` a `bvec3`, `a` and `b` `mat3`s, `albedo` a texture. `fwidth(x)` is a function
of the library.
"""


SYNONYMS_HEAD = """The library has other names for these functions of engines, node editors and
collections. Styles do not count: `softLight`, `SoftLight` and `soft_light` are one name.
"""


NODES_HEAD = """Nodes of editors, and functions that people copy, are short here. Styles do not
count.
"""


def _instead(names: Mapping[str, Instead]) -> Iterator[tuple[str, str]]:
    """Rows of names elsewhere, together where the same is written for them."""
    found: dict[tuple[tuple[str, ...], str], list[str]] = {}
    for name, instead in names.items():
        found.setdefault((instead.written, instead.reason), []).append(name)
    for (written, reason), same in found.items():
        yield codes(same), "; ".join(filter(None, (codes(written, " and "), cell(reason))))


def _elsewhere() -> Iterator[str]:
    """The tables of names in other languages, and what to write for them."""
    yield ELSEWHERE_HEAD
    yield table(("function", "here"), _instead(FUNCTIONS))
    yield NODES_HEAD
    yield table(("function", "here"), _instead(NODES))
    yield SYNONYMS_HEAD
    yield table(("function", "in the library"), _synonyms())
    others = ((f"`{name}`", f"`{here}`") for name, here in {**TYPES, **VALUES}.items())
    yield table(("type or value", "here"), others)
    reads = ((f"`.{name}(…)`", f"`{here}`") for name, here in METHODS.items())
    yield table(("read of a texture", "here"), reads)
    words = ((f"`{name}`", cell(here)) for name, here in KEYWORDS.items())
    yield table(("statement or declaration", "here"), words)


def _synonyms() -> Iterator[tuple[str, str]]:
    """The functions of other systems, by those of the library."""
    found: dict[Meant, list[str]] = {}
    for name, meant in SYNONYMS.items():
        found.setdefault(meant, []).append(name)
    for meant, names in found.items():
        here = codes(f"{meant.path}.{each}" for each in meant.names)
        yield codes(names), "; ".join(filter(None, (here, cell(meant.advice))))


def _builtin(row: Builtin) -> Iterator[str]:
    yield f"### {_written(row)}\n"
    yield f"{row.doc}\n"
    yield from (f"- `{text}`" for text in _signatures(row))
    if row.outside:
        yield f"- *Outside:* {row.outside}"
    if row.of_group is not None:
        yield "- Exists in [kernels over buffers](language.md#work-groups) only."
    elif row.uniform_control_flow:
        yield "- Compares neighbouring pixels, so it cannot be used under `@vertex`."
    yield f"- *Accuracy:* {_bounds(row.accuracy)}"
    if assumptions := _assumptions(row.accuracy):
        yield f"- *Assumed:* {assumptions}"
    if measured := _measured(row.name):
        yield f"- *Measured:* {measured}"
    yield ""


def _bounds(row: Accuracy) -> str:
    """The promise of each platform, with its section if it is not that of the platform's table."""
    together = _together(row, lambda promise, _: str(promise.bound))
    sections = _together(row, _section)
    parts = [
        text if len(together) == 1 else f"{', '.join(platforms)}: {text}"
        for text, platforms in together.items()
    ]
    shown = "; ".join(parts)
    return f"{shown} ({', '.join(sections)})" if sections else shown


def _measured(name: str) -> str:
    """The largest errors that were found on drivers."""
    found: dict[str, list[str]] = {}
    for driver, envelope in ENVELOPES.items():
        if name in envelope.errors:
            found.setdefault(str(envelope.errors[name]), []).append(f"`{driver}`")
    return "; ".join(f"{', '.join(drivers)}: {error}" for error, drivers in found.items())


def _section(promise: Promise, platform: Platform) -> str:
    stated = promise.source != accuracy.SECTIONS[platform] and not promise.assumed
    return promise.source if stated else ""


def _assumptions(row: Accuracy) -> str:
    """The promises that no specification makes, and the reasons why they are assumed."""
    whole = _together(row, lambda promise, _: promise.source if promise.assumed else "")
    beyond = _together(row, lambda promise, _: promise.beyond_assumed)
    return "; ".join(
        [f"of {', '.join(platforms)}: {reason}" for reason, platforms in whole.items()]
        + [f"beyond the limit: {reason}" for reason in beyond]
    )


def _together(row: Accuracy, text: Callable[[Promise, Platform], str]) -> dict[str, list[str]]:
    """The titles of the platforms for which a text is the same; none where it is empty."""
    found: dict[str, list[str]] = {}
    for platform, title in PLATFORMS.items():
        found.setdefault(text(row.on(platform), platform), []).append(title)
    return {shown: titles for shown, titles in found.items() if shown}


def _written(row: Builtin) -> str:
    if row.name in CONSTRUCTORS:
        return f"`{CONSTRUCTORS[row.name]}(x)`"
    if row.method is not None:
        return f"`{_read(row)}`"
    if row.operator:
        sign = WORDS.get(row.name, row.operator)
        return f"`{sign}x`" if row.name in ("neg", "bit_not") else f"`{sign}`"
    return f"`{row.name}`"


def _read(row: Builtin) -> str:
    """The code that reads a texture ``t``. Arrays also have a layer, as the second argument."""
    method = f".{row.method}" if row.method else ""
    return f"t{method}({', '.join(row.parameters)})"


def _signatures(row: Builtin) -> Iterator[str]:
    for signature in row.signatures:
        operands, result = signature.split(" -> ")
        if row.name in CONSTRUCTORS:
            yield f"{result}({operands}) -> {result}"
        elif row.method is not None:
            types = operands.split(", ")
            layer = ("layer",) if len(types) > 1 + len(row.parameters) else ()
            names = ("t", *row.parameters[:1], *layer, *row.parameters[1:])
            pairs = zip(names, types, strict=True)
            yield f"{', '.join(f'{name}: {type_}' for name, type_ in pairs)} -> {result}"
        elif row.operator:
            sign, parts = WORDS.get(row.name, row.operator), operands.split(", ")
            gap = " " if sign.isalpha() else ""
            left = f"{parts[0]} {sign} {parts[1]}" if len(parts) == 2 else f"{sign}{gap}{parts[0]}"
            yield f"{left} -> {result}"
        else:
            yield f"{row.name}({operands}) -> {result}"
