"""``python -m burnish.tests.materialx.suite FOLDER``: compares all documents of a folder.

Each document is imported, and each of its materials is drawn beside the picture by MaterialX's own
text. With ``--bounds``, each material is drawn by every route instead, and held against the bounds
of its own meaning, as ``burnish conform`` does. The command prints a line for each document, with
what does not pass, and a table at the end. Two processes share the documents. Results are kept as
they come, in ``build/materialx.jsonl`` or ``build/materialx_bounds.jsonl``, and a later run does
only what is not there yet; ``--again`` forgets them. ``--only`` names a file with the documents
that count, one a line: those in ``sixty.txt`` use all nodes that MaterialX 1.39.5 tests.

    python -m burnish.tests.materialx.suite ~/MaterialX/resources/Materials \\
        --images ~/MaterialX --images ~/MaterialX/resources
    python -m burnish.tests.materialx.suite ~/MaterialX/resources --bounds \\
        --only tests/materialx/sixty.txt
    python -m burnish.tests.materialx.suite tests/materialx/documents
"""

from __future__ import annotations

import json
from argparse import ArgumentParser, Namespace, RawDescriptionHelpFormatter
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from queue import Empty, SimpleQueue
from typing import Any

import burnish
from burnish.targets.toolchain.limits import BROWSERS, WORKERS
from burnish.targets.toolchain.surroundings import python_worker
from burnish.targets.toolchain.workers import Worker

from ..suite.processes import Background

OUTPUT = Path(burnish.__file__).parent / "build" / "materialx.jsonl"
BOUNDS = OUTPUT.with_name("materialx_bounds.jsonl")
WORKER = f"{__package__}.suite_worker"
BOUNDS_WORKER = f"{__package__}.bounds_worker"
OF_DOCUMENT = 1200.0
"""The seconds that one document may take; some have a hundred renderables."""
PASSED = ("alike", "agrees")
"""The verdicts that need no reason."""

Row = Mapping[str, Any]


def main() -> None:
    """Compare what the command line asks for."""
    asked = _asked()
    if asked.again:
        asked.output.unlink(missing_ok=True)
    done = {row["document"] for row in rows_of(asked.output)}
    waiting: SimpleQueue[Path] = SimpleQueue()
    for path in _documents(asked.folder, asked.only):
        if _name(path, asked.folder) not in done:
            waiting.put(path)
    asked.output.parent.mkdir(exist_ok=True)
    running = [Background(partial(_work, asked, waiting)) for _ in range(asked.processes)]
    for each in running:
        each.returned(limit=asked.limit)
    print(table(list(rows_of(asked.output))))
    print(f"written to {asked.output}")


def _documents(folder: Path, only: Path | None) -> list[Path]:
    """The documents of a folder that count."""
    if only is None:
        return sorted(folder.rglob("*.mtlx"))
    return [folder / name for name in only.read_text("utf-8").splitlines()]


def rows_of(path: Path) -> Iterator[Row]:
    """The results that are kept in a file. A line that was cut off is none."""
    if path.exists():
        for line in path.read_text("utf-8").splitlines():
            try:
                yield json.loads(line)
            except json.JSONDecodeError:
                continue


def _work(asked: Namespace, waiting: SimpleQueue[Path]) -> None:
    """Compare documents, one after the other, in a process that is started again if it dies."""
    # The process of the bounds starts a browser, which has its limits.
    module, limits = (BOUNDS_WORKER, BROWSERS) if asked.bounds else (WORKER, WORKERS)
    worker = Worker(lambda: python_worker(module), limits, tells_command=False)
    try:
        while True:
            try:
                path = waiting.get_nowait()
            except Empty:
                return
            _compare(asked, worker, path)
    finally:
        worker.close()


def _compare(asked: Namespace, worker: Worker, path: Path) -> None:
    name = _name(path, asked.folder)
    request = {"document": str(path), "image_folders": list(map(str, asked.images))}
    answer = worker.ask(request, OF_DOCUMENT)
    if answer.ending == "ended":
        rows = answer.reply["rows"]
    else:
        rows = [
            {"renderable": "", "verdict": "not run", "reason": f"{answer.ending}: {answer.log}"}
        ]
    with asked.output.open("a", encoding="utf-8") as file:
        file.write("".join(json.dumps({"document": name, **row}) + "\n" for row in rows))
    print(_told(name, rows), flush=True)


def _told(name: str, rows: Sequence[Row]) -> str:
    """The verdicts of a document, and a line for each row that does not pass."""
    verdicts = Counter(row["verdict"] for row in rows)
    lines = [f"{name}: {', '.join(f'{count} {verdict}' for verdict, count in verdicts.items())}"]
    lines += [
        f"    {row['renderable']}{_route(row)}: {row['verdict']}: {_first(row['reason'])}"
        for row in rows
        if row["verdict"] not in PASSED
    ]
    return "\n".join(lines)


def _route(row: Row) -> str:
    return f" by {row['route']}" if "route" in row else ""


def _first(reason: str) -> str:
    return (reason.strip().splitlines() or [""])[0][:200]


def _name(path: Path, folder: Path) -> str:
    return path.relative_to(folder).as_posix()


def table(rows: Sequence[Row]) -> str:
    """The numbers of all verdicts, and the most frequent reasons of what did not run."""
    verdicts = Counter(row["verdict"] for row in rows)
    documents = len({row["document"] for row in rows})
    renderables = len({(row["document"], row["renderable"]) for row in rows})
    lines = [f"{renderables} renderables of {documents} documents"]
    lines += [f"{count:6} {verdict}" for verdict, count in verdicts.most_common()]
    reasons = Counter(_first(row["reason"]) for row in rows if row["verdict"] == "not run")
    lines += ["", "not run:"] if reasons else []
    lines += [f"{count:6} {reason}" for reason, count in reasons.most_common(30)]
    by_route = Counter((row["route"], row["verdict"]) for row in rows if "route" in row)
    lines += ["", "by route:"] if by_route else []
    lines += [
        f"{count:6} {route} {verdict}" for (route, verdict), count in sorted(by_route.items())
    ]
    return "\n".join(lines)


def _asked() -> Namespace:
    parser = ArgumentParser(
        prog="python -m burnish.tests.materialx.suite",
        description=__doc__, formatter_class=RawDescriptionHelpFormatter,
    )  # fmt: skip
    parser.add_argument("folder", type=Path, help="the folder with documents")
    parser.add_argument(
        "--images", type=Path, action="append", default=[], help="a further folder with images"
    )
    parser.add_argument(
        "--bounds", action="store_true", help="hold pictures of all routes against their bounds"
    )
    parser.add_argument("--only", type=Path, help="a file with the names of documents, one a line")
    parser.add_argument("--output", type=Path, help="the file of the results")
    parser.add_argument("--processes", type=int, default=2)
    parser.add_argument("--limit", type=float, default=7200.0, help="the seconds of the whole run")
    parser.add_argument("--again", action="store_true", help="forget what was found before")
    asked = parser.parse_args()
    asked.output = asked.output or (BOUNDS if asked.bounds else OUTPUT)
    # Processes run in no folder of the user's.
    asked.folder = asked.folder.resolve()
    asked.images = [folder.resolve() for folder in asked.images]
    return asked


if __name__ == "__main__":
    main()
