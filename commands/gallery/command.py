"""The command line of ``burnish gallery``: makes the entries of files, and writes the pages.

Several processes make the entries.
"""

from __future__ import annotations

import os
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor, as_completed
from pathlib import Path
from time import monotonic
from typing import TYPE_CHECKING, NamedTuple

import click

from ...compiler.diagnostics.display import harmless
from ..console import remark, say
from ..failures import errors_as_messages, fail
from ..options import answer_option, budget_option
from ..terminal import FAILED

if TYPE_CHECKING:
    from ...targets.runner.routes import Route
    from ...targets.toolchain.workers import Pool
    from ..catalogue import Listed
    from .entry import Entry

TIME_LIMIT = 600.0
"""The seconds after which a file is given up."""
SHOWN = "lavapipe:glsl"
LARGEST = 1024
"""The most pixels of a picture's side."""


class GalleryRequest(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    folder: Path
    output: Path
    routes: str
    on: str
    size: int
    jobs: int
    title: str | None
    cache: bool


@click.command()
@click.argument("folder", type=click.Path(path_type=Path, exists=True, file_okay=False))
@click.option(
    "-o", "--output", metavar="FOLDER", required=True, type=click.Path(path_type=Path),
    help="The folder for index.html, a page for each file, and their pictures.",
)  # fmt: skip
@click.option(
    "--routes", metavar="ROUTE,…", default="all", show_default=True,
    help="Routes whose pictures are compared with the reference.",
)  # fmt: skip
@click.option(
    "--on", metavar="ROUTE,…", default=SHOWN, show_default=True,
    help="Routes whose pictures are shown beside those of the reference.",
)  # fmt: skip
@click.option(
    "--size", metavar="N", default=256, show_default=True, type=click.IntRange(16, LARGEST),
    help="Pixels of each side of a picture.",
)  # fmt: skip
@click.option(
    "-j", "--jobs", metavar="N", default=os.cpu_count() or 1, type=click.IntRange(1, 64),
    help="The number of processes; by default, one for each processor.",
)  # fmt: skip
@click.option(
    "--title",
    metavar="TEXT",
    help="The heading; by default, that of the README, or the folder's name.",
)
@budget_option
@click.option("--cache/--no-cache", default=True, help="Make unchanged files anew, or not.")
@answer_option
def gallery(**chosen: object) -> None:
    """Make pages that show all materials, kernels and frames of FOLDER.

    For each file there is a page with its pictures by the reference and by a driver, its source,
    its shaders in all languages side by side, its graph, and what `burnish conform` says of each
    route. The first page shows all of them; if the folder has a README.md, then in the order and
    with the headings of its tables. The pages are read from disk, without a server or a network.

    Pages of files that have not changed are not made anew. A file with errors has a page that says
    so, and the exit code is 1; it also is if a route differs from the reference.

    \b
    Example:
        burnish gallery examples -o build/gallery
        burnish gallery materials -o build/materials --routes lavapipe,llvmpipe
    """
    request = GalleryRequest(**chosen)  # type: ignore[arg-type]
    with errors_as_messages():
        _make(request)


def _make(request: GalleryRequest) -> None:
    from ...targets.runner.routes import select
    from ..catalogue import catalogue, title_of
    from ..output import obstacle, unwritable
    from .pages import pages

    begun = monotonic()
    groups = catalogue(request.folder)
    if not groups:
        fail(f"there is no .burnish file in `{request.folder}`")
    if reason := obstacle(request.output):
        raise unwritable(request.output, reason)
    routes, shown = select([request.routes]), select([request.on])
    if not routes:
        raise click.UsageError("--routes names no route")
    files = [listed for group in groups for listed in group.files]
    entries: dict[str, Entry] = {}
    made = 0
    for listed, entry, is_new in _entries(files, routes, shown, request):
        entries[listed.name] = entry
        made += is_new
        _tell(listed, entry, len(entries), len(files), is_new=is_new)
    title = request.title or title_of(request.folder)
    _write(request.output, pages(title, groups, entries, routes))
    wrong = [name for name, entry in sorted(entries.items()) if entry["errors"]]
    count = f"{len(files)} file{'s' if len(files) > 1 else ''}"
    say(
        f"{count}, {made} of them made anew, in {monotonic() - begun:.0f} s: "
        f"{request.output / 'index.html'}"
    )
    if wrong:
        names = ", ".join(map(harmless, wrong))
        remark("error", f"something is wrong with {names}: the pages of these files say what")
        click.get_current_context().exit(FAILED)


def _entries(
    files: Sequence[Listed],
    routes: Sequence[Route],
    shown: Sequence[Route],
    request: GalleryRequest,
) -> Iterator[tuple[Listed, Entry, bool]]:
    """Each file with its entry, as soon as it is there; and True if the entry was made anew."""
    from ...targets.toolchain.limits import WORKERS
    from ...targets.toolchain.surroundings import python_worker
    from ...targets.toolchain.workers import Pool, Worker
    from .kept import KeptEntries

    kept = KeptEntries(routes, shown, request.size)
    to_make = []
    for listed in files:
        known = kept.read(listed.path.resolve()) if request.cache else None
        if known is None:
            to_make.append(listed)
        else:
            yield listed, known, False
    if not to_make:
        return
    names = ",".join(route.name for route in routes), ",".join(route.name for route in shown)
    folder = str(request.folder.absolute())
    command = python_worker(f"{__package__}.worker", folder, *names, str(request.size))
    pool = Pool(min(request.jobs, len(to_make)), lambda: Worker(lambda: command, WORKERS))
    try:
        with ThreadPoolExecutor(request.jobs) as threads:
            root = request.folder.resolve()
            pending = {threads.submit(_made, listed, root, pool): listed for listed in to_make}
            try:
                for future in as_completed(pending):
                    entry = future.result()
                    kept.write(pending[future].path.resolve(), entry)
                    yield pending[future], entry, True
            except BaseException:
                pool.close()
                threads.shutdown(cancel_futures=True)
                raise
    finally:
        pool.close()


def _made(listed: Listed, folder: Path, pool: Pool) -> Entry:
    """The entry of a file, made by a process; or an entry that says that the process has died."""
    from ...compiler.budget import current
    from .entry import failed
    from .making import source_of

    with pool.borrow() as worker:
        answer = worker.ask({"file": listed.name, "limits": current()}, TIME_LIMIT)
    if "entry" in answer.reply:
        entry: Entry = answer.reply["entry"]
        return entry
    source, _problem = source_of(listed.path, folder)
    # The output of the process tells of this machine, and pages may be published. Only its last
    # line is ours: the program, and how it has ended.
    how = answer.log.rstrip().rpartition("\n")[2].partition(": ")[2]
    return failed(source, f"nothing could be made of this file: the process that tried was {how}")


def _tell(listed: Listed, entry: Entry, number: int, total: int, *, is_new: bool) -> None:
    """Print that a file is done, and its errors."""
    from .pages import in_short

    state = in_short(entry) if is_new or entry["errors"] else "unchanged"
    say(f"[{number:{len(str(total))}}/{total}] {listed.name}: {state}")


def _write(folder: Path, contents: dict[str, bytes]) -> None:
    """Write all pages and pictures, or change nothing."""
    from ..output import unwritable
    from ..replacing import replace_all

    try:
        replace_all(str(folder), contents)
    except OSError as error:
        raise unwritable(Path(error.filename or folder), error.strerror or str(error)) from error
