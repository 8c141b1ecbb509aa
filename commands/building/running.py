"""Runs the actions of a build on this machine, in several processes: those that are out of date.

``burnish build`` calls ``run`` with the actions. Each is independent of all others, so one with an
error keeps none from being run, and its old outputs stay as they were.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from pathlib import Path

from ...compiler.diagnostics.diagnostic import CompileError, Diagnostic
from ...support.frozen import changed, frozen
from ..compiled_files import compiled
from ..compiled_record import Compiled
from ..many_files import made_in_processes
from ..output import write_all
from ..ownership import Ownership
from ..written_files import owners_of, written_of
from .actions import Action
from .clearing import cleared
from .locking import held
from .planning import digests_of
from .records import Records

FEW = 8
"""The number of actions for which one more process pays: as long as it takes to start, so long
takes it to compile about eight short files."""

Told = Callable[[Action, Sequence[str]], None]
"""Called with each action that has been run, and the paths of its outputs."""


@frozen
class Built:
    """What has become of a build."""

    run: Mapping[str, tuple[str, ...]]
    """The paths of the outputs of each action that was run without an error, by its name."""
    current: tuple[str, ...]
    """The names of the actions that were up to date."""
    failed: tuple[str, ...]
    """The names of those with errors."""
    removed: tuple[str, ...]
    """The paths of former outputs that nothing makes any more, which were deleted."""
    diagnostics: tuple[Diagnostic, ...]
    """Errors and warnings, in the order of the actions."""


def run(folder: str, actions: Sequence[Action], jobs: int, told: Told) -> Built:
    """Run those actions of a build into a folder that are out of date.

    Raises ``CompileError`` if the folder cannot be written to, and ``BuildError`` if another build
    is writing into it.
    """
    records = Records(folder)
    if not _stale(records, actions) and not records.abandoned(actions):
        return Built({}, tuple(each.name for each in actions), (), (), ())
    with held(Path(folder)):
        records = Records(folder)  # Another build may have ended just before.
        stale, abandoned = _stale(records, actions), records.abandoned(actions)
        current = tuple(each.name for each in actions if each not in stale)
        try:
            found = _run(stale, jobs, told, records)
            removed = (*found.removed, *cleared(abandoned, folder))
            records.forget(abandoned)
            return changed(found, current=current, removed=removed)
        finally:
            records.keep()


def _stale(records: Records, actions: Sequence[Action]) -> list[Action]:
    """The actions that are out of date."""
    return [each for each in actions if each.request.uses_tools or not records.are_current(each)]


def run_part(actions: Sequence[Action], told: Told) -> Built:
    """Run all actions in this process, whether they are out of date or not.

    Other programs have several of these at once: so no folder is held, and nothing is recorded.
    """
    return _run(actions, 1, told, None)


def _run(actions: Sequence[Action], jobs: int, told: Told, records: Records | None) -> Built:
    """Run some actions."""
    diagnostics: list[Diagnostic] = []
    failed, removed, run = list[str](), list[str](), dict[str, tuple[str, ...]]()
    for action, found in zip(actions, made(actions, jobs), strict=True):
        problem = _deliver(action, found, records)
        diagnostics += (*found.diagnostics, *problem)
        if found.inputs is None or problem:
            failed.append(action.name)
            continue
        names = written_of(action.request.files, [found])
        run[action.name] = tuple(f"{action.request.output}/{name}" for name in names)
        told(action, run[action.name])
        if records is not None:
            removed += cleared(records.replaced(action, names), action.variant.request.output)
    return Built(run, (), tuple(failed), tuple(removed), tuple(diagnostics))


def made(actions: Sequence[Action], jobs: int) -> Iterator[Compiled]:
    """What actions make, in their order. Nothing is written."""
    requests = [action.request for action in actions]
    count = min(jobs, len(requests) // FEW)
    if count < 2 or requests[0].uses_tools:
        return map(compiled, requests)
    return made_in_processes(requests, None, count)


def _deliver(action: Action, found: Compiled, records: Records | None) -> Sequence[Diagnostic]:
    """Write what an action has made; returns the errors because of which that was not possible.

    An action with warnings is run again the next time, so that they are told until they are heeded.
    """
    if found.inputs is None:
        return ()
    request = action.request
    owners = owners_of(request.files, [found])
    guard = Ownership(request.output, owners, force=request.force)
    try:
        contents = written_of(request.files, [found])
        write_all(Path(request.output), contents, guard)
    except CompileError as error:
        return error.diagnostics
    if records is None:
        return ()
    # A file may have changed behind the plan; then the record would be one of other inputs.
    if not found.diagnostics and digests_of(found.inputs) == action.inputs:
        records.note(action, contents)
    records.wrote(action, contents)
    return ()
