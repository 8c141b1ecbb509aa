"""The tutorial: what each step changes, and the lines that it becomes in each language.

``<!-- changed 2_lambert -->`` marks where the difference between a step and the one before it
stands, and ``<!-- lines 2_lambert -->`` the lines of its fragment shader in three languages.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from difflib import SequenceMatcher
from itertools import groupby, pairwise
from pathlib import Path
from tempfile import TemporaryDirectory

import burnish
from burnish.api.compiled import CompileResult, OutputFile

from .kit import EXAMPLES, Block, blocks
from .outcomes import source_of, told
from .tables import DOCS, spliced

FOLDER = EXAMPLES / "tutorial"
PAGE = DOCS / "tutorial.md"
LANGUAGES = ("hlsl", "glsl", "wgsl")
_MESSAGE = re.compile(r"(^```text from=B\d{4}\n).*?(^```$)", re.MULTILINE | re.DOTALL)
CONTEXT = 1
"""The number of unchanged lines that are shown around changed ones."""
SHORT = 2
"""The number of lines that are shown rather than left out between others."""


@dataclass(frozen=True)
class Step:
    """A step of the course, and of which shader the page shows lines."""

    name: str
    shader: str
    function: str = ""
    """The function of the text that is shown whole."""
    of: str = ""
    """Without one, the file whose equations the shown lines come of; or else the step's changes."""

    @property
    def path(self) -> Path:
        return FOLDER / f"{self.name}.burnish"

    @property
    def lines(self) -> list[str]:
        return self.path.read_text(encoding="utf-8").splitlines()


STEPS = (
    Step("1_color", "Clay", function="main"),
    Step("2_lambert", "Clay"),
    Step("3_phong", "Clay"),
    Step("4_texture", "Bricks"),
    Step("5_normal_map", "Bricks"),
    Step("6_microfacets", "Brass", function="gloss"),
    Step("7_shadows", "Scene.Forward.Brass", of="std/shadows.burnish"),
    Step("8_frame", "Scene.Shown"),
)


def tutorial_page() -> str:
    """The tutorial with differences, lines and messages brought up to date."""
    page = PAGE.read_text(encoding="utf-8")
    for before, step in zip((None, *STEPS), STEPS, strict=False):
        page = spliced(page, f"changed {step.name}", _difference(before, step))
        page = spliced(page, f"lines {step.name}", "\n".join(_texts(before, step)))
    messages = iter([_told(block) for block in blocks(PAGE, "text")])
    return _MESSAGE.sub(lambda fence: fence[1] + next(messages) + fence[2], page)


def _difference(before: Step | None, step: Step) -> str:
    """The first step whole, and what each other one changes."""
    if before is None:
        return _fenced("burnish", step.lines)
    return _fenced("diff", _changed(before, step))


def _fenced(marks: str, lines: Iterable[str]) -> str:
    return "\n".join((f"```{marks}", *lines, "```")) + "\n"


def _told(message: Block) -> str:
    with TemporaryDirectory() as folder:
        return told(source_of(message), Path(folder))


def _changed(before: Step, step: Step) -> Iterator[str]:
    """The lines that a step adds and removes, with those around them; `…` stands for others."""
    old, new = before.lines, step.lines
    groups = SequenceMatcher(None, old, new, autojunk=False).get_grouped_opcodes(CONTEXT)
    for number, group in enumerate(groups):
        if number:
            yield " …"
        for tag, start, end, first, last in group:
            if tag == "equal":
                yield from (f" {line}" for line in new[first:last] if line)
            else:
                yield from (f"-{line}" for line in old[start:end])
                yield from (f"+{line}" for line in new[first:last])


def _texts(before: Step | None, step: Step) -> Iterator[str]:
    made = burnish.compile(step.path, LANGUAGES)
    for language in LANGUAGES:
        yield _fenced(f"{language} made", _shown(made, before, step, language))


def _shown(made: CompileResult, before: Step | None, step: Step, language: str) -> Iterator[str]:
    """The lines of a text that the page is about; `…` stands for others."""
    files = made[step.shader].files
    (file,) = (f for f in files if f.stage == "fragment" and f.name.endswith(language))
    lines = file.text.split("\n")
    if step.function:
        numbers = _function(lines, step.function)
    else:
        numbers = _balanced(lines, _closed(_coming_of(file, before, step)))
    shown = sorted(numbers)
    indent = min(len(lines[n - 1]) - len(lines[n - 1].lstrip()) for n in shown)
    for _, run in groupby(enumerate(shown), lambda pair: pair[1] - pair[0]):
        rows = [number for _, number in run]
        if rows[0] != shown[0]:
            yield "…"
        yield from (lines[number - 1][indent:] for number in rows)


def _function(lines: list[str], name: str) -> Iterable[int]:
    """The numbers of the lines of a function."""
    head = next(i for i, line in enumerate(lines) if re.match(rf"\S.*\b{name}\(", line))
    return range(head + 1, lines.index("}", head) + 2)


def _coming_of(file: OutputFile, before: Step | None, step: Step) -> Iterator[int]:
    """The numbers of the lines of a text that come of what a step names, or of what it changes."""
    changed = _changed_numbers(before, step)
    for number, span in file.spans.items():
        if span.source.name == (step.of or str(step.path)):
            first, last = (span.source.position(at)[0] for at in (span.start, span.end))
            if step.of or changed.intersection(range(first, last + 1)):
                yield number


def _changed_numbers(before: Step | None, step: Step) -> set[int]:
    """The numbers of the lines of a step that the step before it has not."""
    old = before.lines if before else []
    codes = SequenceMatcher(None, old, step.lines, autojunk=False).get_opcodes()
    return {
        number
        for tag, _, _, first, last in codes
        if tag != "equal"
        for number in range(first + 1, last + 1)
    }


def _closed(coming: Iterable[int]) -> set[int]:
    """Numbers with those in short gaps between them."""
    numbers = sorted(coming)
    between = (
        range(before, after) for before, after in pairwise(numbers) if after - before <= SHORT + 1
    )
    return {*numbers, *(number for gap in between for number in gap)}


def _balanced(lines: list[str], numbers: set[int]) -> set[int]:
    """Numbers with those of the braces that close what these lines open."""
    open_braces = 0
    for number in range(min(numbers), max(numbers) + 2):
        if open_braces and lines[number - 1].strip() == "}":
            numbers = numbers | {number}
        if number in numbers:
            open_braces += lines[number - 1].count("{") - lines[number - 1].count("}")
    return numbers
