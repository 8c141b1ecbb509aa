"""``python -m tests.mutants``: judge random mutants, and list those that nothing notices.

A mutant is a copy of the package with one small change. If the change alters a text, a plan or
what a driver is told, ``conform`` should call the result ``differs`` or ``failed``. If it does not,
the mutant is a survivor, which is either equivalent or shows a hole in the tests.

    python -m tests.mutants --count 100               # of all parts, as many of each
    python -m tests.mutants --area passes --seed 7    # of one part
    python -m tests.mutants --file targets/emit/wrapping.py --count 0    # all of one file

The seed determines which mutants are chosen. Each takes a second or less: only materials that run
the changed line are compiled, only texts that differ are drawn, and small pictures come first.
"""

from __future__ import annotations

import random
import sys
import tempfile
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections import Counter
from pathlib import Path

from .copies import JUDGES, MOST, copy
from .places import AREAS, Mutant, mutants


def main() -> None:
    """Judge the mutants that the command line asks for."""
    asked = _asked()
    chosen = _chosen(asked)
    print(f"{len(chosen)} mutants, seed {asked.seed}", flush=True)
    counts: dict[str, Counter[str]] = {}
    with tempfile.TemporaryDirectory() as folder, copy(Path(folder), asked.materials) as package:
        known = package.known(asked.known, drawn=True)
        for mutant in chosen:
            found = package.judged(mutant, known, asked.most)
            counts.setdefault(mutant.area, Counter())[found.verdict] += 1
            print(f"{found.verdict:9} {mutant}", flush=True)
            if why := found.by or "; ".join(found.different):
                print(f"{'':9} {why}", flush=True)
    for area, counter in counts.items():
        print(f"{area:12}", ", ".join(f"{n} {verdict}" for verdict, n in counter.items()))
    sys.exit(any(counter["survived"] for counter in counts.values()))


def _chosen(asked: Namespace) -> list[Mutant]:
    """The chosen mutants: as many of each part.

    Their order is random, so that a run that is stopped early is fair, too.
    """
    chance = random.Random(asked.seed)
    rows = []
    for area in asked.area or AREAS:
        found = [mutant for mutant in mutants(area) if asked.file in mutant.path]
        count = -(-asked.count // len(asked.area or AREAS)) or len(found)
        rows += chance.sample(found, min(count, len(found)))
    chance.shuffle(rows)
    return rows


def _asked() -> Namespace:
    parser = ArgumentParser(
        prog="python -m tests.mutants", description=__doc__,
        formatter_class=RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=50, help="about how many; 0 for all")
    parser.add_argument("--area", action="append", choices=list(AREAS), help="a part; repeatable")
    parser.add_argument("--file", default="", help="only files whose paths contain this")
    parser.add_argument("--materials", type=_folder, nargs="+", default=JUDGES, help="folders")
    parser.add_argument("--most", type=int, default=MOST, help="how many materials judge each")
    parser.add_argument("--known", type=Path, help="keeps what is known of the unchanged package")
    return parser.parse_args()


def _folder(text: str) -> Path:
    """A folder for a process that runs elsewhere."""
    return Path(text).resolve()


if __name__ == "__main__":
    main()
