"""``python -m burnish.tests.fuzz``: tries random programs for a given time; ``make fuzz`` calls it.

Each program is named by a seed and a number, such as ``1:57``, which always give the same program.
What is found is shrunk, printed, and stored as a file. Questions that take long are asked about as
many programs as their share of the time allows.
"""

from __future__ import annotations

import time
from argparse import ArgumentParser, Namespace
from collections import Counter, defaultdict
from collections.abc import Collection, Iterator
from itertools import count
from pathlib import Path
from random import Random

from burnish.targets.runner.routes import select

from .oracles import ORACLES, Case, Finding, Tools, ask
from .programs import program
from .received import KINDS, Received
from .robustness import found
from .shrink import shrunk
from .tree import Node

SHARES = {"rewritten": 0.3, "accepted": 0.3, "drawn": 0.3}
"""The shares of the whole time that these questions may take, at most. If no others are asked, they
share all of it."""

MUTATED_SHARE = 0.15
"""The further time, as a share, for programs with mistakes."""
RECEIVED_SHARE = 0.25
"""The further time, as a share, for all else that may be received: pictures, plans, requests …"""

TELL_EVERY = 15.0
"""Seconds between two lines of progress."""


class Run:
    """One run, with what it has found so far."""

    def __init__(self, asked: Namespace, tools: Tools) -> None:
        self._asked = asked
        self._tools = tools
        self._start = time.monotonic()
        self._told = self._start
        self._spent: defaultdict[str, float] = defaultdict(float)
        self._asked_of: Counter[str] = Counter()
        self._refused = 0
        self.findings: dict[Finding, str] = {}
        """The findings, each with the command that shows it again."""

    def programs(self) -> None:
        """Try programs until the time is over."""
        for name in self._names():
            self._one(name)
            if time.monotonic() - self._told > TELL_EVERY:
                self.tell()

    def tell(self) -> None:
        """Print how far the run is."""
        self._told = time.monotonic()
        asked = ", ".join(f"{name} {number}" for name, number in self._asked_of.items())
        print(f"{self._elapsed():.0f} s: {asked}; {_counted(self.findings)}", flush=True)

    def sum_up(self) -> None:
        """Print what was asked and found, and what to do about it."""
        self.tell()
        print(f"{self._refused} programs were refused for a reason that is allowed.")
        for (route, status), number in sorted(self._tools.statuses.items()):
            print(f"  {route:24} {status:16} {number:6}")
        for finding, again in self.findings.items():
            print(f"{finding.oracle} {finding.place} {finding.sort}\n    again: {again}")

    def _names(self) -> Iterator[str]:
        if self._asked.program:
            yield from self._asked.program
            return
        for number in count():
            if self._elapsed() >= self._asked.seconds:
                return
            yield f"{self._asked.seed}:{number}"

    def _elapsed(self) -> float:
        return time.monotonic() - self._start

    def _one(self, name: str) -> None:
        tree = program(name)
        for oracle in self._due():
            begin = time.monotonic()
            case = Case(str(tree), seed_of(name), self._tools, tree)
            answers = ask(case, oracle)
            self._spent[oracle] += time.monotonic() - begin
            self._asked_of[oracle] += 1
            for finding in answers.findings:
                self._found(name, tree, finding)
            if answers.refused:
                self._refused += not answers.findings
                return

    def _due(self) -> list[str]:
        """The questions to ask about the next program."""
        asked: list[str] = self._asked.oracles
        if self._asked.program:
            return asked
        shares = {oracle: SHARES[oracle] for oracle in asked if oracle in SHARES}
        whole = sum(shares.values()) if len(shares) == len(asked) else 1.0
        return [
            oracle
            for oracle in asked
            if self._spent[oracle] <= shares.get(oracle, whole) / whole * self._elapsed()
        ]

    def _found(self, name: str, tree: Node, finding: Finding) -> None:
        if any(finding.is_like(other) for other in self.findings):
            return
        again = f"python -m burnish.tests.fuzz --program {name} --oracles {finding.oracle}"
        if finding.oracle == "drawn":
            again += f" --routes {finding.place or self._asked.routes}"
        self.findings[finding] = again
        print(f"\nfound in {name}: {finding.oracle} {finding.place} {finding.sort}", flush=True)
        small = shrunk(
            tree, lambda each: shows(each, name, finding, self._tools), self._asked.shrink
        )
        case = Case(str(small), seed_of(name), self._tools, small, finding.place)
        told = [each for each in ask(case, finding.oracle).findings if finding.is_like(each)]
        print(f"{(told or [finding])[0].detail}\n\n{small}\nagain: {again}", flush=True)
        file = f"{finding.oracle}-{name.replace(':', '-')}.burnish"
        head = f"// Found by: {again}\n// {finding.place} {finding.sort}\n"
        _store(self._asked.output / file, f"{head}{small}")


def _counted(found: Collection[object]) -> str:
    return "1 finding" if len(found) == 1 else f"{len(found)} findings"


def _store(path: Path, text: str) -> None:
    """Write a program that shows something into a file, and say where it is."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text, encoding="utf-8")
    except OSError as error:
        print(f"not stored, but printed above: {error}\n", flush=True)
    else:
        print(f"stored as {path}\n", flush=True)


def seed_of(name: str) -> int:
    """The seed of the values with which a program is evaluated."""
    return int(name.partition(":")[2] or 0)


def shows(tree: Node, name: str, finding: Finding, tools: Tools) -> bool:
    """True if a smaller program shows the same defect as the program of a name."""
    case = Case(str(tree), seed_of(name), tools, tree, finding.place)
    return any(finding.is_like(other) for other in ask(case, finding.oracle).findings)


def _parser() -> ArgumentParser:
    parser = ArgumentParser(prog="python -m burnish.tests.fuzz", description=__doc__)
    parser.add_argument("--seconds", type=float, default=60.0, help="how long to try programs")
    parser.add_argument("--seed", default="0", help="the first part of the programs' names")
    parser.add_argument(
        "--program", action="append", metavar="SEED:NUMBER", help="only this program, whole"
    )
    parser.add_argument(
        "--oracles", type=lambda text: text.split(","), default=[*ORACLES], metavar="NAME,…",
        help=f"the questions to ask, of {', '.join(ORACLES)}",
    )  # fmt: skip
    parser.add_argument(
        "--routes", default="lavapipe:glsl,chromium:webgpu", help="the routes that draw"
    )
    parser.add_argument(
        "--shrink", type=float, default=60.0, help="seconds for shrinking one finding"
    )
    parser.add_argument(
        "--output", type=Path, default=Path("build/fuzz"), help="the folder for what is found"
    )
    parser.add_argument(
        "--received", type=lambda text: text.split(","), default=[], metavar="KIND,…",
        help=f"instead of programs, only try what may be received, of {', '.join(KINDS)}",
    )  # fmt: skip
    parser.add_argument("--show", action="store_true", help="print the programs, and ask nothing")
    return parser


def main() -> int:
    """Run, and return the exit code: 1 if anything was found, 130 if somebody stopped it before."""
    asked = _parser().parse_args()
    if asked.show:
        for name in asked.program or [f"{asked.seed}:0"]:
            print(f"// {name}\n{program(name)}")
        return 0
    print(f"seed {asked.seed}: the programs are {asked.seed}:0, {asked.seed}:1 …", flush=True)
    with Tools(select([asked.routes])) as tools:
        run, stopped, troubles = Run(asked, tools), False, 0
        try:
            if not asked.received:
                run.programs()
            if not (asked.program or asked.received):
                troubles = _mutated(asked)
            if not asked.program:
                troubles += _received(asked)
        except KeyboardInterrupt:
            stopped = True
            print("\nstopped", flush=True)
        run.sum_up()
    return 1 if run.findings or troubles else 130 if stopped else 0


def _mutated(asked: Namespace) -> int:
    """Try programs with mistakes, too, and return how many of them made trouble."""
    first = Random(asked.seed).randrange(10**9)
    print(f"programs with mistakes, from {first} on", flush=True)
    troubles = 0
    for number, text, trouble in found(first, MUTATED_SHARE * asked.seconds):
        troubles += 1
        print(f"\nfound with mistakes {number}:\n{text}\n{trouble}", flush=True)
        _store(asked.output / f"mistakes-{number}.burnish", text)
    return troubles


def _received(asked: Namespace) -> int:
    """Try other hostile things, too, and return how many of them made trouble."""
    tried = Received(asked.received or tuple(KINDS))
    share = 1.0 if asked.received else RECEIVED_SHARE
    troubles = 0
    for name, text in tried.found(asked.seed, share * asked.seconds):
        troubles += 1
        print(f"\nfound with {name}:\n{text}", flush=True)
        _store(asked.output / f"{name.replace(':', '-')}.txt", text)
    print(", ".join(f"{kind} {number}" for kind, number in tried.done.items()), flush=True)
    return troubles


raise SystemExit(main())
