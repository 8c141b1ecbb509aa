"""Has clang check the texts of a dialect of C++ against declarations of its types and functions.

That is the next best thing where the language's own compiler is not available: clang sees every
name, type and argument, but knows of the language only what the declarations say. A row of
``CHECKERS`` names the folder where they stand: headers, which a text includes without their ending,
and ``attributes.txt``, the list of what may stand in double brackets.
"""

from __future__ import annotations

import re
import shutil
import tempfile
from collections.abc import Callable, Iterator, Mapping
from pathlib import Path

from .job import Job, Message, Verdict
from .messages import read_clang
from .toolbox import Toolbox
from .verdicts import accepted_unless_error, undone

_OPTIONS = (
    "-x", "c++", "-std=c++14", "-fsyntax-only", "-nostdinc", "-Wno-unknown-attributes",
    "-fno-crash-diagnostics",  # would leave files
    # Implicit conversions are errors: a text has to state its conversions.
    "-Werror=float-conversion", "-Werror=implicit-int-float-conversion", "-Werror=sign-conversion",
)  # fmt: skip
_ATTRIBUTES = re.compile(r"\[\[(.*?)\]\]")
_ATTRIBUTE = re.compile(r"(\w+)(\(\w+\))?")
_COMMENT = re.compile("//.*")


def check_against(
    declarations: Path, entries: Mapping[str, str]
) -> Callable[[Job, Toolbox], Verdict]:
    """A checker that compiles texts against the declarations in a folder.

    ``entries`` has, by stage, the beginning of a line that defines an entry point: a regular
    expression, in which ``{name}`` stands for the name of the entry point.
    """

    def check(job: Job, toolbox: Toolbox) -> Verdict:
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for header in declarations.glob("*.h"):
                shutil.copyfile(header, folder / header.stem)
            (folder / "shader").write_text(job.text, encoding="utf-8")
            arguments = (*_OPTIONS, "-isystem", ".", *job.flags, "shader")
            outcome = toolbox.run("clang", *arguments, folder=folder)
        if outcome.ending != "ended":
            return undone(job, outcome.ending, outcome.log)
        messages = (
            *read_clang(outcome.log),
            *_wrong_attributes(job.text, _known(declarations)),
            *_lack_of_entry(job, entries[job.stage]),
        )
        return accepted_unless_error(job, messages, outcome.log)

    return check


def headers_in(declarations: Path) -> tuple[str, ...]:
    """The headers that texts may include that are checked against the folder ``declarations``."""
    return tuple(sorted(header.stem for header in declarations.glob("*.h")))


def _known(declarations: Path) -> dict[str, bool]:
    """The known attributes; by attribute, True if it has an argument."""
    lines = (declarations / "attributes.txt").read_text(encoding="utf-8").splitlines()
    rows = [line for line in lines if line and not line.startswith("#")]
    return {row.partition("(")[0]: "(" in row for row in rows}


def _wrong_attributes(text: str, known: dict[str, bool]) -> Iterator[Message]:
    """Attributes that do not exist: clang ignores all that it does not know itself."""
    for number, line in enumerate(text.splitlines(), start=1):
        for found in _ATTRIBUTES.finditer(_COMMENT.sub("", line)):
            for attribute in found[1].split(","):
                each = _ATTRIBUTE.fullmatch(attribute.strip())
                if each is None or known.get(each[1]) != bool(each[2]):
                    said = f"there is no attribute '{attribute.strip()}'"
                    yield Message("error", number, found.start() + 1, said)


def _lack_of_entry(job: Job, form: str) -> Iterator[Message]:
    """The message about a missing entry point, as clang ignores the words that define one."""
    if not re.search(f"^{form.format(name=job.entry)}", job.text, re.MULTILINE):
        said = f"there is no {job.stage} entry point named '{job.entry}'"
        yield Message("error", None, None, said)
