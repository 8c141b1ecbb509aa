"""Makes all files of a golden folder: ``burnish conform --golden`` writes them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from io import BytesIO
from typing import Any

import numpy as np
from numpy.typing import NDArray

from .... import __version__
from ....compiler.documents.writing import to_text
from ...runner.frames.subjects import FrameSubject, is_frame, is_shader
from ...runner.job_sizes import check_work
from ...runner.routes import Route
from ...runner.subject import Subject
from ..conform import trials_of
from ..frames import FrameTrial
from ..judging import Stored
from ..trials import ShaderTrial, Trial
from .document import (
    FORMAT,
    NAME,
    VERSION,
    FrameInputs,
    Golden,
    GoldenCase,
    GoldenOutput,
    ShaderInputs,
    StoredRow,
)
from .enclosing import Enclosed, Enclosure, enclosed
from .inputs import FRAME, SHADER, Files, frame_inputs, shader_inputs
from .names import file_name, folder_names
from .viewable import sixteen_bits

Told = Callable[[float], None]
"""Called with the part of the work that is done."""
Labelled = tuple[str, Subject | FrameSubject]


class NothingToDrawError(Exception):
    """No golden folder can have the bounds of a subject; the text says why."""


class GoldenWriting:
    """The files of a golden folder, as far as they are made."""

    def __init__(self, routes: Sequence[Route], seed: int) -> None:
        self._routes, self._seed = routes, seed
        self._contents: dict[str, bytes] = {}
        self._cases: list[GoldenCase] = []

    @property
    def cases(self) -> Sequence[GoldenCase]:
        """The cases that are made."""
        return self._cases

    def add(self, subjects: Sequence[Labelled], told: Told) -> None:
        """Add the cases of all subjects.

        Raises ``NothingToDrawError``, and whatever drawing by the reference raises.
        """
        names = subject_names([subject for _, subject in subjects])
        folders = folder_names(names)
        for number, labelled in enumerate(subjects):

            def part(share: float, done: int = number) -> None:
                told((done + share) / len(subjects))

            self._add(labelled, names[number], folders[number], part)

    def files(self) -> dict[str, bytes]:
        """All files by their paths; the document comes last."""
        document = Golden(
            format=FORMAT,
            version=VERSION,
            burnish=__version__,
            seed=self._seed,
            routes=tuple(route.name for route in self._routes),
            cases=tuple(self._cases),
        )
        return {**self._contents, NAME: to_text(document).encode()}

    def _add(self, labelled: Labelled, name: str, folder: str, told: Told) -> None:
        trial = _trial(labelled, self._seed)
        routes = _able(trial, self._routes)
        for shader in trial.shaders:
            check_work(shader.shader)
        cases = list(trial.cases())
        files = Files(folder, self._contents)
        own_folders = folder_names(cases, taken=(SHADER, FRAME))
        for number, (case, own) in enumerate(zip(cases, own_folders, strict=True)):

            def part(share: float, done: int = number) -> None:
                told((done + share) / len(cases))

            found = enclosed(trial, case, routes, part)
            self._write(f"{folder}/{own}", found)
            width, height = found.size
            self._cases.append(
                GoldenCase(
                    subject=name,
                    case=case,
                    folder=f"{folder}/{own}",
                    width=width,
                    height=height,
                    undecided=int(found.undecided.sum()),
                    routes=tuple(route.name for route in routes),
                    outputs=tuple(map(_output, found.outputs)),
                    inputs=_inputs(trial, case, routes, files, own),
                )
            )

    def _write(self, folder: str, found: Enclosure) -> None:
        self._contents[f"{folder}/undecided.npy"] = _npy(found.undecided.astype("|u1"))
        for output in found.outputs:
            path = f"{folder}/{file_name(output.shown.name)}"
            for end in ("lower", "upper", "reference"):
                self._contents[f"{path}.{end}.npy"] = _npy(getattr(output, end).astype("<f8"))
            self._contents[f"{path}.png"] = sixteen_bits(output.reference)


def subject_names(subjects: Sequence[Subject | FrameSubject]) -> list[str]:
    """The names of subjects: with their rigs and passes where several have the same name."""
    alone = [subject.name for subject in subjects]
    return [
        name if alone.count(name) == 1 else ".".join([name, *_variant(subject)])
        for name, subject in zip(alone, subjects, strict=True)
    ]


def _variant(subject: Subject | FrameSubject) -> tuple[str, ...]:
    """The rig and the pass with which something was compiled."""
    if is_frame(subject):
        return (subject.plan.rig,)
    assert is_shader(subject), "it is no frame"
    return subject.reflection.rig, subject.reflection.pass_


def _trial(labelled: Labelled, seed: int) -> Trial:
    (trial,) = trials_of([labelled], seed=seed)
    if isinstance(trial, tuple):
        raise NothingToDrawError(f"{trial[0]}: {trial[1]}")
    return trial


def _able(trial: Trial, routes: Sequence[Route]) -> Sequence[Route]:
    """The routes whose profiles can express a subject."""
    able = [route for route in routes if trial.lacking(route) is None]
    if not able:
        reason = trial.lacking(routes[0])
        raise NothingToDrawError(f"{trial.label}: none of the routes can draw it: {reason}")
    return able


def _inputs(
    trial: Trial, case: str, routes: Sequence[Route], files: Files, folder: str
) -> ShaderInputs | FrameInputs:
    profiles = {route.profile for route in routes}
    if isinstance(trial, ShaderTrial):
        return shader_inputs(trial, case, profiles, files, folder)
    assert isinstance(trial, FrameTrial)
    return frame_inputs(trial, case, profiles, files)


def _output(output: Enclosed) -> GoldenOutput:
    shown = output.shown
    stored = None if shown.stored is None else _stored(shown.stored)
    return GoldenOutput(name=file_name(shown.name), lanes=shown.lanes, stored=stored)


def _stored(place: Stored) -> StoredRow:
    return StoredRow(buffer=place.buffer, offset=place.offset, stride=place.stride, type=place.type)


def _npy(array: NDArray[Any]) -> bytes:
    """A file in NumPy's format 1.0."""
    file = BytesIO()
    np.lib.format.write_array(file, np.ascontiguousarray(array), version=(1, 0))
    return file.getvalue()
