"""Asks the downstream compilers about texts that they have to accept, about each one only once.

Tests of one module, and of several, make the same texts: the vertex shaders of most programs are
alike. A store in the user's cache folder keeps the digests of those that were accepted without a
word. So another process does not ask again, and neither does another run, unless something has
changed: the text, the arguments, the code that runs the compilers, or the compilers themselves.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import replace
from functools import cache
from pathlib import Path

from burnish.targets.runner.store import Store, digest, digest_of_sources
from burnish.targets.toolchain import Job, Toolchain, Verdict
from burnish.targets.toolchain import __file__ as toolchain_file
from burnish.targets.toolchain.checkers import CHECKERS, MSL_DECLARATIONS
from burnish.targets.toolchain.tools import tool_named

STORE = "accepted"
LIMIT = 1 << 20
"""The bytes that the store may hold: some ten thousand digests."""


def refused(jobs: Sequence[Job], toolchain: Toolchain) -> list[Verdict]:
    """The verdicts on the texts that are not accepted, for whatever reason."""
    return [each for each in remarks(jobs, toolchain) if each.status != "accepted"]


def remarks(jobs: Sequence[Job], toolchain: Toolchain) -> list[Verdict]:
    """The verdicts on the texts that are not accepted, or not without a message."""
    store = Store(STORE, LIMIT)
    names = [_digest(job) for job in jobs]
    asked: dict[str, Job] = {}
    for name, job in zip(names, jobs, strict=True):
        if store.read(name) is None:
            asked.setdefault(name, job)
    found: dict[str, Verdict] = {}
    for name, verdict in zip(asked, toolchain.check(list(asked.values())), strict=True):
        if verdict.status == "accepted" and not verdict.messages:
            store.write(name, b"")
        else:
            found[name] = verdict
    return [
        replace(found[name], job=job)
        for name, job in zip(names, jobs, strict=True)
        if name in found
    ]


def _digest(job: Job) -> str:
    return digest(_compiler(job.checker), job.stage, job.entry, *job.flags, job.text)


@cache
def _compiler(checker: str) -> str:
    """A digest of all that decides on a checker's verdicts, beside the text."""
    needs = (tool_named(name) for name in CHECKERS[checker].needs)
    files = [path for tool in needs for path in tool.find() or ()]
    declarations = [path for path in sorted(MSL_DECLARATIONS.iterdir()) if path.is_file()]
    return digest(
        checker, digest_of_sources(Path(toolchain_file).parent), *_states([*files, *declarations])
    )


def _states(files: Iterable[Path]) -> Iterator[str]:
    """The path of each file, with its size and the time when it was last changed."""
    for path in files:
        status = path.stat()
        yield f"{path.resolve()} {status.st_size} {status.st_mtime_ns}"
