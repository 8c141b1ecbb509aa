"""Compiles the files of a command line: each by itself, and many of them in several processes.

``compilation.py`` joins what they become. A file is an input like any other program's: it shares
nothing with the files beside it but what both import. So what each of them has become is kept, and
after an edit only those files are compiled again that have read the edited one.
"""

from __future__ import annotations

import os
import pickle
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

from .compile_options import CompileRequest
from .compiled_files import compiled
from .compiled_record import Compiled
from .kept_files import KeptFiles

if TYPE_CHECKING:
    from .results import Question

SEVERAL = 16
"""The number of files from which on other processes pay: each of them starts as long as eight short
files take."""
_PROCESS = f"{__package__}.compile_process"
TIME_LIMIT = 600.0
"""The seconds after which a process is given up; its file is then compiled here."""


def compiled_files(request: CompileRequest, question: Question | None) -> Iterator[Compiled]:
    """What each file of a request becomes, in their order; files with errors become nothing.

    ``question`` is the command line if what they become may be kept, and taken from earlier ones.
    """
    return compiled_each([request.of_one(file) for file in request.files], question)


def compiled_each(
    requests: Sequence[CompileRequest], question: Question | None
) -> Iterator[Compiled]:
    """What the only file of each request becomes, as above."""
    kept = None if question is None else KeptFiles(question)
    known = {} if kept is None else {each: kept.find(each) for each in requests}
    wanted = [each for each in requests if known.get(each) is None]
    made = _made(wanted, kept)
    for each in requests:
        yield known.get(each) or next(made)
    if kept is not None and wanted:
        kept.prune()


def compiled_and_kept(request: CompileRequest, kept: KeptFiles | None) -> Compiled:
    """What the only file of a request becomes, which is kept for the next time."""
    found = compiled(request)
    if kept is not None:
        kept.keep(request, found)
    return found


def _made(requests: Sequence[CompileRequest], kept: KeptFiles | None) -> Iterator[Compiled]:
    """What files become that are compiled."""
    from ..compiler.watching import is_watched

    count = min(os.cpu_count() or 1, len(requests) // (SEVERAL // 2))
    if count < 2 or requests[0].uses_tools or is_watched():
        return (compiled_and_kept(request, kept) for request in requests)
    return made_in_processes(requests, kept, count)


def made_in_processes(
    requests: Sequence[CompileRequest], kept: KeptFiles | None, count: int
) -> Iterator[Compiled]:
    """What files become that so many processes compile, in the order of the requests."""
    from concurrent.futures import ThreadPoolExecutor

    from ..targets.toolchain.limits import WORKERS
    from ..targets.toolchain.surroundings import python_worker
    from ..targets.toolchain.workers import Pool, Worker

    here = os.getcwd()  # noqa: PTH109 - Processes start elsewhere, and paths may be relative.
    workers = Pool(count, lambda: Worker(lambda: python_worker(_PROCESS), WORKERS))
    threads = ThreadPoolExecutor(count)  # Each waits for one of the processes.

    def ask(request: CompileRequest) -> Compiled:
        with workers.borrow() as worker:
            answer = worker.ask({}, TIME_LIMIT, pickle.dumps((here, request, kept)))
        if not answer.data:
            return compiled_and_kept(request, kept)  # Whatever ended the process, there is this.
        found: Compiled = pickle.loads(answer.data)
        return found

    try:
        yield from threads.map(ask, requests)
    finally:
        # A thread whose process is closed must not take the next file.
        threads.shutdown(wait=False, cancel_futures=True)
        workers.close()
