"""``python -m tests.library.mutants``: plant errors in the library, and see which tests find them.

A mutant of the library is a copy with one small change (``changes.py``). The tests that know values
from elsewhere (``truth.py``) have to find it: those of the changed declaration first, then those of
all that use it. What they do not find either changes no value, and has a reason in
``equivalent.py``, or shows that a truth is missing.

    python -m tests.library.mutants                       # all
    python -m tests.library.mutants --count 50 --seed 7   # some by chance
    python -m tests.library.mutants --file shadows        # those of one file

The table says for each file how many are caught by a truth; how many the compiler refuses; how many
only the list of parameters shows (``parameters.txt``); how many change no value; and how many
survive, which are told one by one.
"""

from __future__ import annotations

import os
import random
import shutil
import sys
import tempfile
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache, partial
from pathlib import Path

from burnish.compiler import frontend, library
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.semantics.names.standard_library import files_of, import_path, in_library

from ..mutants.judge.children import Answer, in_child
from .changes import Change, changes
from .equivalent import EQUIVALENT
from .test_declarations import ELSEWHERE
from .test_parameters import parameters, test_parameters_are_as_they_were
from .truth import Test, checks, load_all
from .users import truths_about

PATIENCE = 300.0
"""The limit of one mutant, in seconds; one that takes longer counts as found."""
VERDICTS = ("caught", "refused", "golden", "equivalent", "survived")


def all_changes(name: str = "") -> list[Change]:
    """The changes of all files of the library whose names contain this."""
    return [
        change
        for file in _files()
        if file not in ELSEWHERE and name in file
        for change in changes(file, text_of(file))
    ]


def _files() -> list[str]:
    """The files of the library as ``text_of`` takes them: ``noise``, ``mtlx.noise``."""
    folder = library.FOLDER
    return [import_path(path, folder).removeprefix("std.") for path in files_of(folder)]


@cache
def text_of(name: str) -> str:
    """The text of a file of the library."""
    return (library.FOLDER / place_of(name)).read_text("utf-8")


def place_of(name: str) -> str:
    """Where a file of the library lies in its folder."""
    return in_library(f"std.{name}".split("."))


def judged(change: Change) -> Answer:
    """The verdict on a mutant, one of ``VERDICTS``, and by which test it was found."""
    prepare()
    near, far = truths_about(change.declaration)
    tests = (*near, test_parameters_are_as_they_were, *far)
    return in_child(partial(_judged, change, tests), PATIENCE)


@cache
def prepare() -> None:
    """Load what every mutant needs, so that no child does it again."""
    load_all()
    assert list(parameters())


def _judged(change: Change, tests: Sequence[Test]) -> Answer:
    """What tests say of a changed library, in a process that has compiled nothing yet."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(shutil.copytree(library.FOLDER, Path(temporary) / "stdlib"))
        path = folder / place_of(change.file)
        path.write_text(change.applied(text_of(change.file)), "utf-8")
        for module in (library, frontend):
            vars(module)["FOLDER"] = folder
        for test in tests:
            for check in checks(test):
                try:
                    check()
                except CompileError:
                    return {"verdict": "refused", "by": test.__name__}
                except Exception as error:
                    verdict = "golden" if test is test_parameters_are_as_they_were else "caught"
                    return {"verdict": verdict, "by": f"{test.__name__}: {type(error).__name__}"}
    return {"verdict": "equivalent" if change.told in EQUIVALENT else "survived"}


def judge_all(chosen: Sequence[Change]) -> Iterable[tuple[Change, Answer]]:
    """The verdicts on mutants in their order, several at once."""
    prepare()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        yield from zip(chosen, pool.map(judged, chosen), strict=True)


def main() -> None:
    """Judge the mutants that the command line asks for.

    The exit code is 1 if any survived, or is found although it has a reason why it cannot be.
    """
    parser = ArgumentParser(
        prog="python -m tests.library.mutants", description=__doc__,
        formatter_class=RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument("--count", type=int, default=0, help="about how many; 0 for all")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--file", default="", help="only files whose names contain this")
    asked = parser.parse_args()
    found = all_changes(asked.file)
    chance = random.Random(asked.seed)
    chosen = chance.sample(found, min(asked.count, len(found))) if asked.count else found
    counts: defaultdict[str, Counter[str]] = defaultdict(Counter)
    wrong = False
    for change, answer in judge_all(chosen):
        verdict = answer["verdict"]
        for row in (change.file, "all"):
            counts[row][verdict] += 1
        if verdict == "survived":
            print(f"line {change.line(text_of(change.file))}: {change.told}", flush=True)
            wrong = True
        elif verdict != "equivalent" and change.told in EQUIVALENT:
            print(f"not equivalent, but {verdict}: {change.told}", flush=True)
            wrong = True
    print(table(counts))
    sys.exit(wrong)


def table(counts: dict[str, Counter[str]]) -> str:
    """The number of mutants by file and verdict; the last line has those of all files."""
    rows = sorted(counts.items(), key=lambda row: (row[0] == "all", row[0]))
    lines = [f"{'':14}" + "".join(f"{verdict:>12}" for verdict in VERDICTS)]
    for name, counter in rows:
        lines.append(f"{name:14}" + "".join(f"{counter[verdict]:12}" for verdict in VERDICTS))
    return "\n".join(lines)


if __name__ == "__main__":
    main()
