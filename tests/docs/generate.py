"""``python -m tests.docs.generate``: writes the pages that are made from the compiler's tables.

Run it after changing the grammar, the library or its examples, a builtin, a diagnostic, a
simplification rule, a profile, a capability, a limit, a route or a driver's row, or a step of the
tutorial, and after keeping new numbers of tolerances. It draws the pictures of pages, too. A test
fails if a page or a picture is not up to date.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator, Mapping
from itertools import groupby
from pathlib import Path
from textwrap import indent

from burnish.commands.explain.programs import ShownProgram, every_shown
from burnish.compiler.budget import LIMITS, amount_with_unit
from burnish.compiler.diagnostics import rules
from burnish.compiler.diagnostics.diagnostic import Rule
from burnish.compiler.ir.rulebook import RULES
from burnish.compiler.passes.rules.notation import conditions, equations
from burnish.compiler.passes.rules.table import RULES as SIMPLIFICATIONS
from burnish.compiler.syntax.ast import KINDS
from burnish.targets.conformance.drivers import DRIVERS, Hardware
from burnish.targets.runner.routes import EVERY_ROUTE
from burnish.targets.toolchain.limits import EVERY_LIMIT, in_words

from .builtins_page import builtins_page
from .library_page import library_page
from .pictures import draw_all
from .tables import DOCS, NOTE, cell, codes, spliced, table
from .targets_page import targets_page
from .tolerances_page import tolerances_page
from .tutorial_page import tutorial_page

ROOT = Path(__file__).parents[2]
GRAMMAR = ROOT / "compiler" / "syntax" / "burnish.lark"

DIAGNOSTICS_HEAD = f"""{NOTE}

# Diagnostics

Every error and warning has a code. Codes stay the same from one version to the next, and the code
of a removed diagnostic is not used again. `burnish explain B0203` shows an entry on the command
line, and `burnish check FILE --format json` writes what it finds [for programs](#as-json). Words
in braces are placeholders.

Where a program can show a diagnostic, there is a short wrong one, about which nothing else is said,
and the same one mended. `burnish explain` also shows what is said about the wrong one.

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
    "B08": "Frames",
    "B09": "Functions for engines",
}


def diagnostics_page() -> str:
    """The index of all diagnostics."""
    found = [rule for rule in vars(rules).values() if isinstance(rule, Rule)]
    lines = [DIAGNOSTICS_HEAD]
    ordered = sorted(found, key=lambda rule: rule.code)
    shown = {entry.code: entry for entry in every_shown()}
    for section, members in groupby(ordered, key=lambda rule: rule.code[:3]):
        lines.append(f"## {section}: {SECTIONS[section]}\n")
        for rule in members:
            lines += [f"### {rule.code}\n", f"{rule.severity}: {_code(rule.message)}\n"]
            lines += [f"{rule.help}\n", *_programs(shown[rule.code])]
    return "\n".join(lines).rstrip() + "\n"


def _programs(entry: ShownProgram) -> Iterator[str]:
    """The programs of a diagnostic as indented code, which no snippet's test runs once more."""
    if entry.reason:
        yield f"No program shows this. {entry.reason}\n"
        return
    for title, program in ((f"Wrong{entry.condition}", entry.wrong), ("Right", entry.right)):
        yield f"{title}:\n"
        yield indent(program, "    ")


def _code(message: str) -> str:
    """A message template as inline code, even if it contains back quotes."""
    return f"`` {message} ``"


def language_page() -> str:
    """The language reference with its grammar brought up to date."""
    page = (DOCS / "language.md").read_text(encoding="utf-8")
    page = re.sub(r"(?<=^```lark\n).*?(?=^```$)", lambda _: _grammar(), page, flags=_LINES)
    return spliced(page, "members", table(("member", "declares", "belongs in"), _members()))


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
    page = spliced(page, "routes", table(("route", "text", "how"), _routes()))
    heading = (
        "driver", "", "interpolated", "position", "subtexel", "product", "level", "footprint",
        "off", "mixed", "fixed", "half", "float", "edges, in pixels", "lines",
    )  # fmt: skip
    return spliced(page, "drivers", table(heading, _drivers()))


def _routes() -> Iterator[tuple[str, ...]]:
    for route in EVERY_ROUTE.values():
        yield f"`{route.name}`", f"`{route.profile}`", route.title


def _drivers() -> Iterator[tuple[str, ...]]:
    for name, row in DRIVERS.items():
        slack = f"{row.edge_slack:.1e}" if row.edge_slack else "0"
        for what, found in (("assumed", row.assumed), ("measured", row.measured)):
            if found is not None:
                yield f"`{name}`", what, *map(str, _hardware(found)), slack, found.lines


def _hardware(found: Hardware) -> tuple[object, ...]:
    """The precision of a device's fixed functions; nothing where it is that of a float32."""
    return (
        found.varying_bits, found.frag_coord_bits, found.subtexel_bits,
        found.product_bits or "", found.mip_bits,
        found.footprint, found.lod_error or "", found.mixing_bits or "", found.fixed_bits or "",
        found.half_bits or "", found.float_bits or "",
    )  # fmt: skip


def graph_page() -> str:
    """The page on graphs with its table of the rules of range analysis brought up to date."""
    page = (DOCS / "graph.md").read_text(encoding="utf-8")
    rows = ((f"`{name}`", words) for name, words in RULES.items())
    return spliced(page, "rules", table(("rule", "what it says"), rows))


def passes_page() -> str:
    """The page on passes with its table of simplification rules brought up to date."""
    page = (DOCS / "passes.md").read_text(encoding="utf-8")
    rows = (
        (rule.name, codes(equations(rule), "<br>"), cell(conditions(rule)), rule.says)
        for rule in SIMPLIFICATIONS
    )
    return spliced(page, "rules", table(("rule", "equation", "where", "why"), rows))


def security_page() -> str:
    """The page on security with its table of limits brought up to date."""
    page = (DOCS / "security.md").read_text(encoding="utf-8")
    rows = ((f"`{row.name}`", amount_with_unit(row.most, row), row.of) for row in LIMITS.values())
    page = spliced(page, "limits", table(("limit", "at most", "of what"), rows))
    processes = [
        (row.of, *map(in_words, (row.memory, row.file, row.output))) for row in EVERY_LIMIT
    ]
    head = ("program", "memory", "each file that it writes", "output")
    return spliced(page, "processes", table(head, processes))


PAGES: Mapping[str, Callable[[], str]] = {
    "language.md": language_page,
    "graph.md": graph_page,
    "builtins.md": builtins_page,
    "library.md": library_page,
    "diagnostics.md": diagnostics_page,
    "conformance.md": conformance_page,
    "passes.md": passes_page,
    "security.md": security_page,
    "targets.md": targets_page,
    "tolerances.md": tolerances_page,
    "tutorial.md": tutorial_page,
}


if __name__ == "__main__":
    for name, page in PAGES.items():
        (DOCS / name).write_text(page(), encoding="utf-8")
        print(f"docs/{name}")
    for picture in draw_all():
        print(picture.relative_to(ROOT))
