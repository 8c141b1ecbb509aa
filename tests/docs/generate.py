"""``python -m tests.docs.generate``: writes the pages that are made from the compiler's tables.

Run it after changing the grammar, a builtin, a diagnostic, a profile, a capability, a route or a
driver's row. A test fails if a page is not up to date.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping
from itertools import groupby
from pathlib import Path

from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import Rule
from burnish.compiler.ir.rulebook import RULES
from burnish.compiler.syntax.ast import KINDS
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
)
from burnish.stdlib.builtins.accuracy import PLATFORMS, Accuracy, Platform, Promise
from burnish.stdlib.builtins.elsewhere import FUNCTIONS, KEYWORDS, METHODS, TYPES, VALUES
from burnish.targets import registry
from burnish.targets.conformance.drivers import DRIVERS
from burnish.targets.conformance.measured import ENVELOPES
from burnish.targets.description.capabilities import CAPABILITIES
from burnish.targets.description.capability import Capability, Standing, standing
from burnish.targets.description.profile import LIMITED, Profile
from burnish.targets.runner.routes import EVERY_ROUTE

ROOT = Path(__file__).parents[2]
DOCS = ROOT / "docs"
GRAMMAR = ROOT / "compiler" / "syntax" / "burnish.lark"

NOTE = "<!-- Made by `python -m tests.docs.generate`; do not edit. -->"

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
| `M`, `C` | `mat2`, `mat3`, `mat4`; the vector that is a column of `M` |
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


ELSEWHERE_HEAD = """## What other languages call it

Every function of GLSL 4.50 and ES 3.00, of HLSL's list of intrinsics and of WGSL is listed above
under the same name, or in this table. Messages about unknown names take their advice from it,
too. Here `x`, `y`, `z` are floats, `n` and `m` ints, `u` and `k` uints, `v` and `w` `vec3`s, `p`
and `q` `vec4`s, `c` a `bvec3`, `a` and `b` `mat3`s, `albedo` a texture. `fwidth(x)` is a function
of the library.
"""


def _elsewhere() -> Iterator[str]:
    """The tables of names in other languages, and what to write for them."""
    yield ELSEWHERE_HEAD
    found: dict[tuple[tuple[str, ...], str], list[str]] = {}
    for name, instead in FUNCTIONS.items():
        found.setdefault((instead.written, instead.reason), []).append(name)
    rows = (
        (_codes(names), "; ".join(filter(None, (_codes(written, " and "), _cell(reason)))))
        for (written, reason), names in found.items()
    )
    yield _table(("function", "here"), rows)
    others = ((f"`{name}`", f"`{here}`") for name, here in {**TYPES, **VALUES}.items())
    yield _table(("type or value", "here"), others)
    reads = ((f"`.{name}(…)`", f"`{here}`") for name, here in METHODS.items())
    yield _table(("read of a texture", "here"), reads)
    words = ((f"`{name}`", _cell(here)) for name, here in KEYWORDS.items())
    yield _table(("statement or declaration", "here"), words)


def _codes(texts: Iterable[str], between: str = ", ") -> str:
    return between.join(f"`{_cell(text)}`" for text in texts)


def _cell(text: str) -> str:
    """A text as a cell of a table."""
    return text.replace("|", "\\|")


def _builtin(row: Builtin) -> Iterator[str]:
    yield f"### {_written(row)}\n"
    yield f"{row.doc}\n"
    yield from (f"- `{text}`" for text in _signatures(row))
    if row.outside:
        yield f"- *Outside:* {row.outside}"
    if row.uniform_control_flow:
        yield "- Compares neighbouring pixels, so it cannot be used under `@vertex`."
    yield f"- *Accuracy:* {_bounds(row.accuracy)}"
    if assumptions := _assumptions(row.accuracy):
        yield f"- *Assumed:* {assumptions}"
    if measured := _measured(row.name):
        yield f"- *Measured:* {measured}"
    yield ""


def _bounds(row: Accuracy) -> str:
    """What holds on each platform, with the section if it is not that of the platform's table."""
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
    """What no specification says, and why it is assumed."""
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
    """How a texture ``t`` is read. Arrays also have a layer, as the second argument."""
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


DIAGNOSTICS_HEAD = f"""{NOTE}

# Diagnostics

Every error and warning has a code. Codes stay the same from one version to the next, and the code
of a removed diagnostic is not used again. `burnish explain B0203` shows an entry on the command
line, and `burnish check FILE --format json` writes what it finds [for programs](#as-json). Words
in braces are placeholders.

After an error a compile writes nothing, the exit code is 1, and the library raises `CompileError`.
Warnings have no such effect.

## As JSON

`burnish check FILE --format json` writes a list with one object for each diagnostic:

| key | what |
|---|---|
| `code`, `severity` | such as `B0203`; `error`, `warning` or `note` |
| `message` | the first line of what people see |
| `span` | where it is; `null` if it is about no text, such as a folder that cannot be written to |
| `caption` | what is written next to the marked text; may be empty |
| `labels` | further places, each with `span` and `text` |
| `hint` | how to mend this case, as a sentence; empty if that is not known |
| `fixes` | the changes to the text that the hint describes |
| `help` | what the rule means in general |

A `span` has a `file`, a `start`, and an `end`, which is behind the last character. `start` and
`end` have `line` and `column`, which count from 1, and `offset`, the number of characters from the
beginning of the file.

Each entry of `fixes` is a complete way to mend the case; if there are several, choose one. It has
`edits`, which are made together: each replaces its `span` by its `text`. An empty span means that
the text is inserted, an empty text that the span is removed. The edits of one fix do not overlap.
The `applicability` of a fix is one of two words, which rustc uses, too:

- `machine-applicable`: the change is another spelling of what was written. A tool may make it
  without asking.
- `maybe-incorrect`: after the change the diagnostic is gone, but a person has to decide whether
  the result is what was intended.
"""

SECTIONS = {
    "B00": "Files and the command line",
    "B01": "Syntax",
    "B02": "Names",
    "B03": "Types",
    "B04": "Values and meaning",
    "B05": "Stages and rates",
    "B06": "Rigs and lights",
    "B07": "Targets",
}


def diagnostics_page() -> str:
    """The index of all diagnostics."""
    found = [rule for rule in vars(rules).values() if isinstance(rule, Rule)]
    lines = [DIAGNOSTICS_HEAD]
    ordered = sorted(found, key=lambda rule: rule.code)
    for section, members in groupby(ordered, key=lambda rule: rule.code[:3]):
        lines.append(f"## {section}: {SECTIONS[section]}\n")
        for rule in members:
            lines += [f"### {rule.code}\n", f"{rule.severity}: {_code(rule.message)}\n"]
            lines.append(f"{rule.help}\n")
    return "\n".join(lines).rstrip() + "\n"


def _code(message: str) -> str:
    """A message template as inline code, even if it contains back quotes."""
    return f"`` {message} ``"


def language_page() -> str:
    """The language reference with its grammar brought up to date."""
    page = (DOCS / "language.md").read_text(encoding="utf-8")
    page = re.sub(r"(?<=^```lark\n).*?(?=^```$)", lambda _: _grammar(), page, flags=_LINES)
    return _spliced(page, "members", _table(("member", "declares", "belongs in"), _members()))


def _members() -> Iterator[tuple[str, ...]]:
    for kind in KINDS:
        written = re.findall(r"`[^`]+`", kind.form)[0]
        yield written, kind.doc, kind.places


_LINES = re.MULTILINE | re.DOTALL
_REMARK = re.compile(r"(?:^|\s+)// .*$")
_IGNORED = re.compile(r"%ignore|(?:DOC|FILE_DOC|COMMENT|BLANK):")


def _grammar() -> str:
    """The grammar without comments and the rules for blank space."""
    lines = GRAMMAR.read_text(encoding="utf-8").splitlines()
    kept = [_REMARK.sub("", line).rstrip() for line in lines if not _IGNORED.match(line)]
    return re.sub(r"\n{3,}", "\n\n", "\n".join(kept)).strip() + "\n"


def conformance_page() -> str:
    """The page on conformance with its tables of routes and drivers brought up to date."""
    page = (DOCS / "conformance.md").read_text(encoding="utf-8")
    page = _spliced(page, "routes", _table(("route", "text", "how"), _routes()))
    heading = (
        "driver", "", "interpolated", "position", "subtexel", "level", "mixed", "edges, in pixels",
    )  # fmt: skip
    return _spliced(page, "drivers", _table(heading, _drivers()))


def _routes() -> Iterator[tuple[str, ...]]:
    for route in EVERY_ROUTE.values():
        yield f"`{route.name}`", f"`{route.profile}`", route.title


def _drivers() -> Iterator[tuple[str, ...]]:
    for name, row in DRIVERS.items():
        slack = f"{row.edge_slack:.1e}" if row.edge_slack else "0"
        for what, found in (("assumed", row.assumed), ("measured", row.measured)):
            if found is not None:
                bits = (
                    found.varying_bits, found.frag_coord_bits, found.subtexel_bits, found.mip_bits,
                    found.mixing_bits or "",
                )  # fmt: skip
                yield f"`{name}`", what, *map(str, bits), slack


def graph_page() -> str:
    """The page on graphs with its table of the rules of range analysis brought up to date."""
    page = (DOCS / "graph.md").read_text(encoding="utf-8")
    rows = ((f"`{name}`", words) for name, words in RULES.items())
    return _spliced(page, "rules", _table(("rule", "what it says"), rows))


def targets_page() -> str:
    """The page on targets with its tables of capabilities and of limits brought up to date."""
    page = (DOCS / "targets.md").read_text(encoding="utf-8")
    profiles = _profiles()
    heading = ("", *(f"`{name}`" for name in profiles))
    page = _spliced(page, "capabilities", _table(heading, _standings(profiles)))
    page = _spliced(page, "rows", _paragraphs(profiles))
    return _spliced(page, "limits", _table(heading, _limits(profiles)))


def _profiles() -> dict[str, Profile]:
    """All profiles by their full names."""
    return {
        f"{language.name}:{profile.name}": profile
        for language in map(registry.load, registry.names())
        for profile in language.profiles
    }


def _standings(profiles: Mapping[str, Profile]) -> Iterator[tuple[str, ...]]:
    for row in CAPABILITIES:
        yield row.name, *(standing(row, profile).kind for profile in profiles.values())


def _paragraphs(profiles: Mapping[str, Profile]) -> str:
    """An entry for each capability: what it is, and where it is not native, why and what then."""
    return "".join(
        f"**{row.name}.** {row.doc}\n\n{''.join(_elsewhere_of(row, profiles))}"
        for row in CAPABILITIES
    )


def _elsewhere_of(row: Capability, profiles: Mapping[str, Profile]) -> Iterator[str]:
    found: dict[Standing, list[str]] = {}
    for name, profile in profiles.items():
        cell = standing(row, profile)
        if cell.kind != "native":
            found.setdefault(cell, []).append(name)
    for cell, names in found.items():
        then = cell.how or row.instead
        ending = f": {then}" if then else ""
        missing = " and no ".join(cell.missing)
        where = f"{_codes(names)}, where there is no {missing}"
        yield f"- *{cell.kind.capitalize()}* in {where}{ending}.\n"
    if found:
        yield "\n"


def _limits(profiles: Mapping[str, Profile]) -> Iterator[tuple[str, ...]]:
    for field, limited in LIMITED.items():
        yield limited.what, *(_limit(field, profile) for profile in profiles.values())


def _limit(field: str, profile: Profile) -> str:
    """A limit as people see it; a dash where there is none, or nothing that could have one."""
    number, stage = getattr(profile.limits, field), LIMITED[field].stage
    is_there = number is not None and (stage is None or stage in profile.stages)
    return str(number) if is_there else "–"


def _spliced(page: str, name: str, text: str) -> str:
    """The page with ``text`` between its marks ``<!-- name -->`` and ``<!-- end -->``."""
    marked = re.compile(f"(?<=<!-- {name} -->\n).*?(?=<!-- end -->)", re.DOTALL)
    return marked.sub(lambda _: text, page, count=1)


def _table(heading: tuple[str, ...], rows: Iterable[tuple[str, ...]]) -> str:
    lines = (heading, ("---",) * len(heading), *rows)
    return "".join(f"| {' | '.join(cells)} |\n" for cells in lines)


PAGES: Mapping[str, Callable[[], str]] = {
    "language.md": language_page,
    "graph.md": graph_page,
    "builtins.md": builtins_page,
    "diagnostics.md": diagnostics_page,
    "conformance.md": conformance_page,
    "targets.md": targets_page,
}


if __name__ == "__main__":
    for name, page in PAGES.items():
        (DOCS / name).write_text(page(), encoding="utf-8")
        print(f"docs/{name}")
