"""Prepares a graph for Ninja: finds what each action makes, and how Burnish is called.

``burnish build --ninja`` calls ``written``; ``ninja.py`` writes the text. The names of outputs are
known once a file is compiled. So the first graph takes as long as a build; later ones take the
names of all actions that are as they were from the records of ``records.py``.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...compiler.diagnostics.diagnostic import CompileError, Diagnostic
from ..console import show
from ..output import write_all
from ..written_files import written_of
from .actions import Action, Batch
from .ninja import NinjaGraph, graph
from .program import program
from .records import Records
from .running import made

PROGRAM = "burnish-program.txt"
"""A file in the folder of a build that says which Burnish writes there. Ninja runs all actions
again when it changes, which it does with another Burnish only."""


def written(
    batches: Sequence[Batch],
    folder: str,
    path: str,
    called: Sequence[str],
    again: Sequence[str],
    jobs: int,
) -> str:
    """The text of the graph in the file ``path``, and beside it the file that names the program.

    Raises ``CompileError`` if a file has errors, and ``BuildError`` for names that Ninja cannot
    have.
    """
    about = NinjaGraph(path, tuple(called), tuple(again), f"{folder}/{PROGRAM}", jobs)
    actions = [action for batch in batches for action in batch.actions]
    text = graph(batches, _outputs(actions, folder, jobs), about)
    write_all(Path(folder), {PROGRAM: f"{program()}\n"})
    return text


def _outputs(actions: Sequence[Action], folder: str, jobs: int) -> dict[str, list[str]]:
    """The names of what each action makes, by its folder of outputs.

    Raises ``CompileError`` with all errors.
    """
    records = Records(folder)
    unknown = [each for each in actions if records.outputs(each) is None]
    diagnostics: list[Diagnostic] = []
    failed = False
    for action, found in zip(unknown, made(unknown, jobs), strict=True):
        diagnostics += found.diagnostics
        failed |= found.inputs is None
        if found.inputs is not None:
            records.note(action, written_of(action.request.files, [found]))
    if failed:
        raise CompileError(diagnostics)
    show(diagnostics)
    records.keep()
    return {each.request.output: list(records.outputs(each) or ()) for each in actions}
