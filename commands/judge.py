"""Judges the subjects of files for ``burnish conform``, one after the other.

Burnish's main process has a ``Judge``, and so has each process that helps it (``judges.py``). They
agree on subjects by the name of the file and the label, as what is compiled is not sent.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from .compared import ConformRequest, Said, Subjects, profiles_of, subjects_in

if TYPE_CHECKING:
    from ..targets.conformance.rows import Row
    from ..targets.runner.routes import Route
    from ..targets.runner.runner import Runner
    from ..targets.toolchain import Toolchain


class Unit(NamedTuple):
    """One subject as work of a process."""

    file: Path
    label: str
    cost: float
    """The estimated cost of judging it."""


class Forms(NamedTuple):
    """The subjects of one file in both forms, which differ with native stages only."""

    drawn: Subjects
    meant: Subjects
    said: Said


class Contents(NamedTuple):
    """The contents of one file, as far as another process needs to know them."""

    units: tuple[Unit, ...]
    said: Said


class Judge:
    """Judges by some routes."""

    def __init__(
        self,
        request: ConformRequest,
        routes: Sequence[Route],
        runner: Runner,
        toolchain: Toolchain,
    ) -> None:
        self._request, self._routes = request, routes
        self._runner, self._toolchain = runner, toolchain
        self._compiled: dict[Path, Forms] = {}

    def contents(self, file: Path) -> Contents:
        """Compile a file; its subjects are kept, as this judge may have to judge them later."""
        from ..targets.conformance.costs import cost_of

        found = self._compiled[file] = self.subjects(file)
        units = (Unit(file, label, cost_of(subject)) for label, subject in found.meant)
        return Contents(tuple(units), found.said)

    def subjects(self, file: Path) -> Forms:
        """The subjects of a file as routes draw them, and as they are meant."""
        request, profiles = self._request, profiles_of(self._routes)
        meant, said = subjects_in(file, request, profiles, native_stages=False)
        if said.errors or not request.native_stages:
            return Forms(meant, meant, said)
        drawn, more = subjects_in(file, request, profiles, native_stages=True)
        return Forms(drawn, meant, more if more.errors else said)

    def rows(self, unit: Unit) -> Sequence[Row]:
        """A row for each route, with reasons in the source where it differs or proves little.

        If another judge has compiled the file, it is compiled again. Raises ``CompileError`` if it
        has changed meanwhile, and is wrong now.
        """
        from ..compiler.diagnostics.diagnostic import CompileError
        from ..targets.conformance.conform import rows_of, trials_of
        from ..targets.conformance.explaining import with_reasons
        from ..targets.conformance.rows import Row

        drawn, meant, said = self._compiled.get(unit.file) or self.subjects(unit.file)
        if said.errors:
            raise CompileError(said.errors)
        mine = [pair for pair in drawn if pair[0] == unit.label]
        if not mine:
            why = "it is not in its file any more"
            return [Row(unit.label, route, "failed", why) for route in self._routes]
        trials = trials_of(mine, seed=self._request.seed, meant=dict(meant))
        rows = rows_of(trials, self._routes, self._runner, self._toolchain, threads=1)
        return with_reasons(dict(meant)[unit.label], rows, self._request.seed)
