"""``python -m tests.library.mutants``: plant errors in the library, and see which tests find them.

A mutant of the library is a copy with one small change (``changes.py``). The tests that know values
from elsewhere (``truth.py``) have to find it: those of the changed declaration first, then those of
its file, and of the files that import it. What they do not find either changes no value, and is
listed in ``EQUIVALENT`` with the reason, or shows that a truth is missing.

    python -m tests.library.mutants                       # all
    python -m tests.library.mutants --count 50 --seed 7   # some by chance
    python -m tests.library.mutants --file shadows        # those of one file
"""

from __future__ import annotations

import os
import random
import re
import shutil
import sys
import tempfile
from argparse import ArgumentParser, RawDescriptionHelpFormatter
from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from functools import cache, partial
from pathlib import Path

from burnish.compiler import frontend, library

from ..mutants.judge.children import Answer, in_child
from .changes import Change, changes
from .test_declarations import ELSEWHERE
from .test_parameters import test_parameters_are_as_they_were
from .truth import TRUTHS, Check, checks, load_all

PATIENCE = 120.0
"""The limit of one mutant, in seconds; one that takes longer counts as found."""

EQUIVALENT: dict[str, str] = {}
"""Changes that no value can show, as ``Change.told`` says them, and why."""


def all_changes(name: str = "") -> list[Change]:
    """The changes of all files of the library whose names contain this."""
    return [
        change
        for path in sorted(library.FOLDER.glob("*.burnish"))
        if path.stem not in ELSEWHERE and name in path.stem
        for change in changes(path.stem, text_of(path.stem))
    ]


@cache
def text_of(name: str) -> str:
    """The text of a file of the library."""
    return (library.FOLDER / f"{name}.burnish").read_text("utf-8")


def judged(change: Change) -> Answer:
    """The verdict on a mutant: ``caught`` with the reason, or ``survived``."""
    load_all()
    return in_child(partial(_judged, change), PATIENCE)


def _judged(change: Change) -> Answer:
    """What the tests say of a changed library, in a process that has compiled nothing yet."""
    with tempfile.TemporaryDirectory() as temporary:
        folder = Path(shutil.copytree(library.FOLDER, Path(temporary) / "stdlib"))
        path = folder / f"{change.file}.burnish"
        path.write_text(change.applied(text_of(change.file)), "utf-8")
        for module in (library, frontend):
            vars(module)["FOLDER"] = folder
        for name, check in _ordered(change):
            try:
                check()
            except Exception as error:
                return {"verdict": "caught", "by": f"{name}: {type(error).__name__}"}
    return {"verdict": "survived"}


def _ordered(change: Change) -> Iterator[tuple[str, Check]]:
    """The checks that may find a change, the likeliest first, with the names of their tests."""
    yield "test_parameters", test_parameters_are_as_they_were
    users = _users(change.file)
    near = [name for name in TRUTHS if name.split(".")[1] == change.file]
    far = [name for name in TRUTHS if name.split(".")[1] in users]
    tests = [test for name in (change.declaration, *near, *far) for test in TRUTHS.get(name, ())]
    for test in dict.fromkeys(tests):
        for check in checks(test):
            yield test.__name__, check


def _users(file: str) -> set[str]:
    """The files of the library that import one, directly or not; every file sees some."""
    names = {path.stem for path in library.FOLDER.glob("*.burnish")}
    if file in ("prelude", "spaces"):
        return names
    found, waiting = set[str](), [file]
    while waiting:
        one = waiting.pop()
        importing = {name for name in names if re.search(rf"import std\.{one}\b", text_of(name))}
        waiting += importing - found
        found |= importing
    return found


def judge_all(chosen: Sequence[Change]) -> Iterable[tuple[Change, Answer]]:
    """The verdicts on mutants in their order, several at once."""
    load_all()
    with ThreadPoolExecutor(os.cpu_count()) as pool:
        yield from zip(chosen, pool.map(judged, chosen), strict=True)


def main() -> None:
    """Judge the mutants that the command line asks for; the exit code is 1 if any survived."""
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
    counts: Counter[str] = Counter()
    for change, answer in judge_all(chosen):
        text = text_of(change.file)
        verdict = answer["verdict"]
        if verdict == "survived" and change.told(text) in EQUIVALENT:
            verdict = "equivalent"
        counts[verdict] += 1
        if verdict == "survived":
            print(f"line {change.line(text)}: {change.told(text)}", flush=True)
    print(", ".join(f"{count} {verdict}" for verdict, count in sorted(counts.items())))
    sys.exit(bool(counts["survived"]))


if __name__ == "__main__":
    main()
