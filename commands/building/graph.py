"""Prepares a graph for Ninja: finds what each action makes, and how Burnish is called.

``burnish build --ninja`` calls ``written``; ``ninja.py`` writes the text. The names of outputs are
known once a file is compiled. So the first graph takes as long as a build; later ones take the
names of all actions that are as they were from the records of ``records.py``.

A file with a mistake keeps no other from being built: its action is in the graph, fails and tells
the mistake. What it made before stays named as its output, so that nothing is built of that.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

from ...compiler.diagnostics.diagnostic import Diagnostic
from ...support.frozen import frozen
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
MISTAKES = "burnish-mistakes"
"""The name that keeps a graph with mistakes out of date. No file has it."""
UNKNOWN = "unknown-outputs"
"""The name that stands for the outputs of an action that never was without an error. No file has
it, so the action is always out of date."""


@frozen
class WrittenGraph:
    """A graph, and what was learned by making it."""

    text: str
    diagnostics: tuple[Diagnostic, ...]
    """The warnings of actions without errors."""
    failing: tuple[str, ...]
    """The names of the actions with errors, which these tell by themselves."""


def written(
    batches: Sequence[Batch],
    folder: str,
    path: str,
    called: Sequence[str],
    again: Sequence[str],
    jobs: int,
) -> WrittenGraph:
    """The graph in the file ``path``; beside it, the file is written that names the program.

    Raises ``BuildError`` for names that Ninja cannot have.
    """
    records = Records(folder)
    actions = [action for batch in batches for action in batch.actions]
    diagnostics, failing = _learn(records, actions, jobs)
    outputs = {each.request.output: _outputs(records, each) for each in actions}
    mistakes = (f"{folder}/{MISTAKES}",) if failing else ()
    about = NinjaGraph(path, tuple(called), tuple(again), f"{folder}/{PROGRAM}", jobs, mistakes)
    text = graph(batches, outputs, about)
    records.keep()
    write_all(Path(folder), {PROGRAM: f"{program()}\n"})
    return WrittenGraph(text, tuple(diagnostics), tuple(failing))


def _learn(
    records: Records, actions: Sequence[Action], jobs: int
) -> tuple[list[Diagnostic], list[str]]:
    """Compile what is not known yet: the warnings, and the names of the actions with errors."""
    unknown = [each for each in actions if records.outputs(each) is None]
    diagnostics, failing = list[Diagnostic](), list[str]()
    for action, found in zip(unknown, made(unknown, jobs), strict=True):
        if found.inputs is None:
            failing.append(action.name)
        else:
            diagnostics += found.diagnostics
            records.note(action, written_of(action.request.files, [found]))
    return diagnostics, failing


def _outputs(records: Records, action: Action) -> Sequence[str]:
    """The names of what an action makes, or has made before there was an error."""
    return list(records.outputs(action) or records.last_names(action) or [UNKNOWN])
