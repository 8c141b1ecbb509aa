"""A farm under load: many materials on a few workers of this machine, one of which is killed.

``python -m burnish.tests.bench.farm`` writes a thousand small materials, starts a scheduler and two
workers, and has ``burnish conform`` compare all of them. In the middle it kills a worker. Then it
counts: each material has to have one row, in the order of the files. A test of ``tests/cli`` does
the same with a few.
"""

from __future__ import annotations

import argparse
import json
import re
import signal
import sys
import time
from collections.abc import Iterator, Sequence
from contextlib import ExitStack
from pathlib import Path
from subprocess import DEVNULL
from tempfile import TemporaryDirectory

from ..suite.processes import Program, started, until

LIMIT = 7200.0
"""The seconds that everything may take."""
MATERIAL = "material M{0} {{ color = vec3(fract(uv.x * {0}.0), uv.y, {0} / 4096.0) }}\n"
_HEADING = re.compile(r"m(\d+)\.burnish: M\1\n")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run it, and print figures; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--materials", type=int, default=1000)
    parser.add_argument("--workers", type=int, default=2)
    parser.add_argument("--routes", default="lavapipe:glsl")
    parser.add_argument("--spare", action="store_true", help="kill no worker")
    chosen = parser.parse_args(arguments)
    with TemporaryDirectory() as folder, ExitStack() as running:
        place = Path(folder)
        names = list(_written(place, chosen.materials))
        address, workers = _farm(place, chosen.workers, running)
        begun = time.monotonic()
        command = [
            sys.executable, "-m", "burnish", "conform", *names, "--routes", chosen.routes,
            "--scheduler", address,
        ]  # fmt: skip
        conform = running.enter_context(started(command, cwd=place, stderr=None))
        text, killed = _output(conform, workers[0], 0 if chosen.spare else chosen.materials // 2)
        code = conform.exit_code(LIMIT)
        took = time.monotonic() - begun
    found = [int(number) for number in _HEADING.findall(text)]
    agrees = text.count(" agrees ")
    is_whole = found == list(range(chosen.materials)) and agrees == chosen.materials
    print(f"{chosen.materials} materials on {chosen.workers} workers in {took:.0f} s")
    print(f"exit code {code}")
    print(f"a worker was killed after {killed} rows" if killed else "no worker was killed")
    print(f"rows: {len(found)}, different ones: {len(set(found))}, that agree: {agrees}")
    print("nothing is lost or doubled, and the order is that of the files" if is_whole else text)
    return 0 if is_whole and code == 0 else 1


def _written(place: Path, count: int) -> Iterator[str]:
    """Write the materials; yields the names of their files."""
    for number in range(count):
        name = f"m{number}.burnish"
        (place / name).write_text(MATERIAL.format(number))
        yield name


def _farm(place: Path, count: int, running: ExitStack) -> tuple[str, list[Program]]:
    """A scheduler and some workers: its address, and they."""
    local = ("--host", "127.0.0.1", "--no-dashboard")
    file = place / "scheduler.json"

    def start(what: str, *words: str) -> Program:
        command = [sys.executable, "-m", f"distributed.cli.dask_{what}", *words, *local]
        return running.enter_context(started(command, cwd=place, stdout=DEVNULL, stderr=DEVNULL))

    start("scheduler", "--port", "0", "--scheduler-file", str(file))
    until(lambda: file.exists() and file.read_text(), "the scheduler")
    address = json.loads(file.read_text())["address"]
    workers = [start("worker", address, "--nthreads", "1", "--no-nanny") for _ in range(count)]
    return address, workers


def _output(conform: Program, worker: Program, middle: int) -> tuple[str, int]:
    """All that is printed, and the number of rows after which the worker was killed."""
    text, rows, killed = "", 0, 0
    while line := conform.line(LIMIT).decode():
        text += line
        rows += " agrees " in line
        if middle and not killed and rows >= middle:
            worker.signal(signal.SIGKILL)
            killed = rows
    return text, killed


if __name__ == "__main__":
    raise SystemExit(main())
