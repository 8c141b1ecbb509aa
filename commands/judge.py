"""Judges the subjects of files for ``burnish conform``, one after the other.

Burnish's main process has a ``Judge``, and so has each process that helps it (``judges.py``). They
agree on subjects by the name of the file and the label, as what is compiled is not sent.
"""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from .compared import ConformRequest, Said, Subjects, profiles_of, subjects_in
from .compile_options import is_range
from .results import LIBRARY

if TYPE_CHECKING:
    from ..compiler.inputs import Inputs
    from ..targets.conformance.frames import FrameTrial
    from ..targets.conformance.golden.writing import GoldenPart
    from ..targets.conformance.rows import Row
    from ..targets.conformance.trials import Version
    from ..targets.runner.frames.helped import Helpers
    from ..targets.runner.routes import Route
    from ..targets.runner.runner import Runner
    from ..targets.toolchain import Toolchain

KEPT = 8
"""The number of files whose subjects a judge keeps, which take much memory."""


class Unit(NamedTuple):
    """One subject as work of a process."""

    file: Path
    label: str
    name: str
    """The name of the subject by itself."""
    variant: tuple[str, ...]
    """Its rig and its pass."""
    read: str
    """The digest of what was read to compile the file."""
    cost: float
    """The estimated cost of judging it."""
    shared: float
    """The part of this cost for which other processes can help."""


class PartOf(NamedTuple):
    """A part of the work that another process has with a subject."""

    unit: Unit
    common: bytes
    """What is common to all parts."""
    number: int


class GoldenOf(NamedTuple):
    """A subject whose bounds are written, instead of drawing it."""

    unit: Unit
    name: str
    """Its name in the golden folder, and that of its folder there."""


class Forms(NamedTuple):
    """The subjects of one file in both forms, which differ with native stages only."""

    drawn: Subjects
    meant: Subjects
    said: Said
    read: str
    """The digest of what was read to compile them; empty if there are errors."""
    versions: Mapping[str, Version]
    """The materials of which subjects are versions, by labels; empty if all serve all values."""


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
        helpers: Helpers | None = None,
    ) -> None:
        """``helpers`` may draw parts of frames."""
        self._request, self._routes = request, routes
        self._runner, self._toolchain = runner, toolchain
        self._helpers = helpers
        self.forms = lru_cache(KEPT)(self._compiled)
        """The subjects of a file; those of the last few files are kept."""
        self._trial = lru_cache(1)(self._trial_of)
        """The trial of a subject for whose parts this judge is asked, one after the other."""

    def contents(self, file: Path) -> Contents:
        """The contents of a file. Its subjects are kept, as this judge may be asked for them."""
        return contents_of(file, self.forms(file))

    def rows(self, unit: Unit) -> Sequence[Row]:
        """A row for each route, with reasons in the source where it differs or proves little.

        If the file is not one of the last that this judge has compiled, it is compiled again. Then
        the rows have failed if it is another one now. Raises ``MemoryError``.
        """
        from ..targets.conformance.conform import rows_of, trials_of
        from ..targets.conformance.explaining import with_reasons
        from ..targets.conformance.rows import LACKS_MEMORY

        drawn, meant, _said, read, versions = self.forms(unit.file)
        if read != unit.read:
            return self.failed(unit, "its file has changed meanwhile")
        mine = [pair for pair in drawn if pair[0] == unit.label]
        seed = self._request.seed
        trials = trials_of(
            mine, seed=seed, meant=dict(meant), versions=versions, helpers=self._helpers
        )
        rows = rows_of(trials, self._routes, self._runner, self._toolchain, threads=1)
        if any(row.problem == LACKS_MEMORY for row in rows):
            raise MemoryError
        return rows if versions else with_reasons(dict(meant)[unit.label], rows, seed)

    def part(self, about: PartOf) -> bytes | None:
        """A part of the pictures of a frame, which another judge draws; ``None`` if it fails.

        The other one then draws the part, and finds the reason. Raises ``MemoryError``.
        """
        from ..targets.conformance.refusals import REFUSALS

        try:
            trial = self._trial(about.unit)
            return None if trial is None else trial.part(about.common, about.number)
        except REFUSALS:
            return None

    def golden(
        self, about: GoldenOf, told: Callable[[float], None] = lambda _share: None
    ) -> GoldenPart | str:
        """The part of a golden folder about a subject; or the reason why there is none.

        ``told`` is called with the part of the work that is done. Raises ``MemoryError``.
        """
        from ..targets.conformance.golden.writing import NothingToDrawError, golden_part
        from ..targets.conformance.refusals import REFUSALS

        unit, seed = about.unit, self._request.seed
        _drawn, meant, _said, read, _versions = self.forms(unit.file)
        if read != unit.read:
            return f"{unit.label}: its file has changed meanwhile"
        (subject,) = (pair for pair in meant if pair[0] == unit.label)
        try:
            return golden_part(subject, about.name, self._routes, seed, told)
        except NothingToDrawError as error:
            return str(error)
        except REFUSALS as error:
            return f"{unit.label}: {error}"

    def failed(self, unit: Unit, problem: str) -> Sequence[Row]:
        """The rows of a subject that cannot be judged."""
        from ..targets.conformance.rows import Row

        return [Row(unit.label, route, "failed", problem) for route in self._routes]

    def _trial_of(self, unit: Unit) -> FrameTrial | None:
        """The trial of a frame, without help; ``None`` if its file is another one now."""
        from ..targets.conformance.cases import SIZE
        from ..targets.conformance.frames import FrameTrial
        from ..targets.runner.frames.subjects import is_frame

        drawn, _meant, _said, read, _versions = self.forms(unit.file)
        subject = dict(drawn).get(unit.label)
        if read != unit.read or subject is None:
            return None
        assert is_frame(subject), "only frames have parts"
        return FrameTrial(unit.label, subject, SIZE)

    def _compiled(self, file: Path) -> Forms:
        request, profiles = self._request, profiles_of(self._routes)
        inputs: list[Inputs] = []
        meant, said = subjects_in(file, request, profiles, native_stages=False, read=inputs.append)
        drawn = meant
        if request.native_stages and not said.errors:
            drawn, more = subjects_in(
                file, request, profiles, native_stages=True, read=inputs.append
            )
            said = more if more.errors else said
        versions: Mapping[str, Version] = {}
        if request.values and not said.errors:
            sources, _said = subjects_in(
                file, request, profiles, native_stages=False, specialise=False, read=inputs.append
            )
            versions = _versions(sources, request)
        return Forms(drawn, meant, said, "" if said.errors else _digest_of(inputs), versions)


def _versions(sources: Subjects, request: ConformRequest) -> dict[str, Version]:
    """The materials of which a request draws versions, by their labels."""
    from ..targets.conformance.trials import Version
    from ..targets.runner.frames.subjects import is_shader

    narrowed = frozenset(name for name, _text in request.values)
    fixed = frozenset(name for name, text in request.values if not is_range(text))
    return {
        label: Version(source, narrowed, fixed) for label, source in sources if is_shader(source)
    }


def contents_of(file: Path, forms: Forms) -> Contents:
    """The contents of a file whose subjects were compiled."""
    from ..targets.conformance.costs import cost_of, shared_cost_of
    from ..targets.conformance.golden.writing import variant_of

    units = (
        Unit(
            file, label, subject.name, variant_of(subject), forms.read, cost_of(subject),
            shared_cost_of(subject),
        )
        for label, subject in forms.meant
    )  # fmt: skip
    return Contents(tuple(units), forms.said)


def _digest_of(inputs: Iterable[Inputs]) -> str:
    """A digest of all that compiles have read, and of the paths where they have looked in vain.

    It is the same on another machine of a farm, which has the files elsewhere.
    """
    from ..targets.runner.store import digest

    here = os.path.realpath(os.curdir)

    def named(path: str) -> str:
        return os.path.relpath(path, LIBRARY if path.startswith(LIBRARY) else here)

    return digest(
        *(
            repr((
                sorted((named(path), content) for path, content in each.contents.items()),
                sorted((asked, named(real)) for asked, real in each.links.items()),
            ))
            for each in inputs
        )
    )  # fmt: skip
