"""``burnish build``: compiles many files in many variants, or says how other programs do so."""

from __future__ import annotations

import os
import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import click

from .answering import begin, collector
from .building.variants import OF_VARIANTS, asked_for, variants_of, with_options
from .console import remark, say
from .failures import fail
from .message_forms import DOCUMENTS, show_in
from .options import each_once, messages_option, search_option
from .single_output import STDOUT, deliver, insist_on_own
from .terminal import FAILED

if TYPE_CHECKING:
    from .building.actions import Action
    from .building.running import Built

NINJA_FILE = "build.ninja"
MEMORY = 512 << 20
"""The bytes of memory that a compile takes at most, but for extreme materials."""


class BuildRequest(NamedTuple):
    """The command line after parsing; the names are those of the options."""

    files: tuple[Path, ...]
    output: str
    variants: tuple[str, ...]
    ninja: bool
    actions: bool
    part: bool
    batch: int
    to: str | None
    jobs: int | None
    program: str
    search_path: tuple[Path, ...]
    form: str
    """The form of messages."""
    options: dict[str, Any]
    """The options of every compile."""


@click.command()
@click.argument("files", type=click.Path(path_type=Path), nargs=-1, required=True, metavar="FILE…")
@click.option(
    "-o", "--output", metavar="FOLDER", default="build", show_default=True,
    help="The folder for all outputs; each FILE has one of its own in it.",
)  # fmt: skip
@click.option(
    "--variant", "variants", metavar="NAME:OPTIONS", multiple=True,
    help="Compile all files once more in this way, into a folder of this name: "
    "`'night: --rig Night --set lamps.count=0'`; may be given many times.",
)  # fmt: skip
@click.option("--ninja", is_flag=True, help="Write a graph for Ninja, and compile nothing.")
@click.option(
    "--actions", is_flag=True, help="Print all actions with their digests as JSON, likewise.",
)  # fmt: skip
@click.option(
    "--part", is_flag=True,
    help="Compile all FILEs in this process, whether that is needed or not: what the commands of "
    "--ninja and --actions do.",
)  # fmt: skip
@click.option(
    "--batch", metavar="N", type=click.IntRange(1, 1000), default=1, show_default=True,
    help="Put about N files into each command of --ninja or --actions: many commands take less "
    "time then, and few take more.",
)  # fmt: skip
@click.option(
    "--to", metavar="FILE",
    help=f"The file for --ninja (by default {NINJA_FILE}) or --actions (by default `-`, which "
    "prints it).",
)  # fmt: skip
@click.option(
    "-j", "--jobs", metavar="N", type=click.IntRange(1, 1024),
    help="Compile so many files at once; by default one for each processor, as far as there is "
    "memory.",
)  # fmt: skip
@click.option(
    "--program", metavar="WORDS", default="burnish", show_default=True,
    help="The words by which --ninja and --actions call Burnish, such as `python3 -m burnish`.",
)  # fmt: skip
@search_option
@messages_option
@with_options
def build(**chosen: Any) -> None:
    """Compile all FILEs that have changed, or of which something that they import has.

    A FILE may be a folder: then all files below it are meant that declare a material, a kernel or a
    frame. What materials/plastic.burnish becomes lies in FOLDER/materials/plastic, as `burnish
    compile` writes it. A file that declares several rigs is compiled with each, into a folder for
    each. A file with an error keeps no other from being compiled.

    Each file with its rig and its variant is an action: a command, with all files that it reads,
    and the folder that it writes. Burnish runs them itself, or writes them down for others: --ninja
    for Ninja, and --actions, with digests, for farms that take Bazel's Remote Execution API.
    `burnish schema actions` prints the schema of the latter.

    \b
    Example:
        burnish build materials -o build
        burnish build materials --variant 'far: --set detail=0' --variant 'near: --hoist'
        burnish build materials --ninja && ninja
        burnish build materials --actions --to actions.json
    """
    names = [row.field for row in OF_VARIANTS]
    each_once(chosen["values"])
    options = {name: chosen.pop(name) for name in names}
    request = BuildRequest(**chosen, options=options)
    if request.form in DOCUMENTS:
        begin("build", request.form)
    _check_options(request)
    from ..compiler.diagnostics.diagnostic import CompileError
    from .building.actions import BuildError
    from .building.planning import Demand, actions_of

    try:
        _check_folder(request.output)
        variants = variants_of(request.output, request.search_path, options, request.variants)
        demand = Demand.NOTHING
        if request.actions or request.ninja:
            demand = Demand.READABLE if request.actions else Demand.THERE
        actions = actions_of(request.files, request.search_path, variants, demand)
        if request.actions:
            _write_actions(request, actions)
        elif request.ninja:
            _write_ninja(request, actions)
        else:
            _run(request, actions)
    except BuildError as error:
        fail(str(error))
    except CompileError as error:
        show_in(request.form, error.diagnostics)
        click.get_current_context().exit(FAILED)


def _check_options(request: BuildRequest) -> None:
    """Raise ``UsageError`` for options that make no sense together."""
    if request.ninja and request.actions:
        raise click.UsageError("--ninja and --actions write different documents: choose one")
    if request.to is not None and not (request.ninja or request.actions):
        raise click.UsageError("--to names the file for --ninja or --actions: give one of them")
    if request.part and (request.ninja or request.actions):
        raise click.UsageError("--part compiles, and --ninja and --actions do not: choose one")
    if request.actions and request.to in (None, STDOUT) and collector() is not None:
        raise click.UsageError("--actions prints a document: name a file for it with --to")
    if request.output == STDOUT:
        raise click.UsageError("a build writes many files: -o names the folder for them")


def _check_folder(folder: str) -> None:
    """Raise ``CompileError`` if the folder cannot be written to."""
    from .output import obstacle, unwritable

    if reason := obstacle(Path(folder)):
        raise unwritable(Path(folder), reason)


def _called(request: BuildRequest) -> list[str]:
    try:
        words = shlex.split(request.program)
    except ValueError as error:
        raise click.BadParameter(str(error), param_hint="--program") from error
    if not words:
        raise click.BadParameter("it has no word", param_hint="--program")
    return words


def _write_actions(request: BuildRequest, actions: Sequence[Action]) -> None:
    from ..compiler.documents.writing import to_text
    from .building.batching import batches_of
    from .building.document import document_of

    batches = batches_of(actions, request.batch)
    text = to_text(document_of(batches, _called(request)))
    to = request.to or STDOUT
    insist_on_own(to, '"build": ', "burnish build --actions")
    deliver(to, text.removesuffix("\n") if to == STDOUT else text)


def _write_ninja(request: BuildRequest, actions: Sequence[Action]) -> None:
    from .building.batching import batches_of
    from .building.graph import written

    path, jobs = request.to or NINJA_FILE, _jobs(request)
    insist_on_own(path, "Written by `burnish build --ninja`", "burnish build --ninja")
    batches = batches_of(actions, request.batch)
    again = _again(request, path)
    found = written(batches, request.output, path, _called(request), again, jobs)
    deliver(path, found.text)
    show_in(request.form, found.diagnostics)
    if path != STDOUT:
        say(f"{path}: {_counted(len(batches), 'action')}{_of_failing(found.failing)}")
    if found.failing and (collected := collector()) is not None:
        from ..compiler.documents.answer import BuildAnswer

        collected.find(BuildAnswer(run=(), up_to_date=(), failed=found.failing, removed=()))


def _of_failing(names: Sequence[str]) -> str:
    """The end of a line about a graph, which names what cannot be built until it is mended."""
    listed = ", ".join(f"`{name}`" for name in names)
    return f"; {listed} will fail, and tell the mistake" if names else ""


def _again(request: BuildRequest, path: str) -> list[str]:
    """The arguments that write a graph again."""
    jobs = [] if request.jobs is None else [f"--jobs={request.jobs}"]
    return [
        "build", "--ninja", f"--to={path}", f"--output={request.output}",
        *(f"--variant={each}" for each in request.variants), *jobs, f"--batch={request.batch}",
        f"--program={request.program}",
        *(f"--include={each}" for each in request.search_path),
        *asked_for(request.options), "--", *map(str, request.files),
    ]  # fmt: skip


def _run(request: BuildRequest, actions: Sequence[Action]) -> None:
    from .building.running import run, run_part

    def told(action: Action, outputs: Sequence[str]) -> None:
        say(f"{action.name}: {_counted(len(outputs), 'file')} in {action.request.output}")
        if (collected := collector()) is not None:
            collected.write(outputs)

    if request.part:
        found = run_part(actions, told)
    else:
        found = run(request.output, actions, _jobs(request), told)
    show_in(request.form, found.diagnostics)
    if found.removed:
        say(f"{_counted(len(found.removed), 'former output')} removed, as nothing makes them now")
    _find(found)
    if not request.part or found.failed:
        _count(found)


def _find(found: Built) -> None:
    """Give the answer for programs its record, if it is asked for."""
    if (collected := collector()) is None:
        return
    from ..compiler.documents.answer import BuildAnswer, BuiltRow

    collected.find(
        BuildAnswer(
            run=tuple(BuiltRow(name=name, outputs=paths) for name, paths in found.run.items()),
            up_to_date=found.current, failed=found.failed, removed=found.removed,
        )
    )  # fmt: skip


def _count(found: Built) -> None:
    """Print how many actions were run; end the command if any of them has failed."""
    counts = f"{_counted(len(found.run), 'action')} run, {len(found.current)} up to date"
    say(f"{counts}, {len(found.failed)} failed" if found.failed else counts)
    if found.failed:
        names = ", ".join(f"`{name}`" for name in found.failed)
        remark("note", f"the outputs of what failed are as they were: {names}")
        click.get_current_context().exit(FAILED)


def _jobs(request: BuildRequest) -> int:
    """The number of compiles at once, for which there are processors and memory."""
    if request.jobs is not None:
        return request.jobs
    processors = os.cpu_count() or 1
    try:
        memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES")
    except (AttributeError, ValueError, OSError):
        return processors
    return max(1, min(processors, memory // MEMORY))


def _counted(count: int, what: str) -> str:
    return f"1 {what}" if count == 1 else f"{count} {what}s"
