"""Makes all files of a golden folder: ``burnish conform --golden`` writes them."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
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
from .names import folder_names
from .viewable import sixteen_bits


class NothingToDrawError(Exception):
    """No golden folder can have the bounds of a subject; the text says why."""


@dataclass(frozen=True, slots=True)
class GoldenPart:
    """The part of a golden folder that is about one subject."""

    cases: tuple[GoldenCase, ...]
    files: Mapping[str, bytes]
    """The files by their paths from the document."""


def golden_part(
    labelled: tuple[str, Subject | FrameSubject],
    name: str,
    routes: Sequence[Route],
    seed: int,
    told: Callable[[float], None] = lambda _share: None,
) -> GoldenPart:
    """All cases of a subject, whose folder has its name. ``told`` is called with the part of the
    work that is done.

    Raises ``NothingToDrawError``, and whatever drawing by the reference raises.
    """
    trial = _trial(labelled, seed)
    able = _able(trial, routes)
    for shader in trial.shaders:
        check_work(shader.shader)
    contents: dict[str, bytes] = {}
    files, found = Files(name, contents), []
    cases = list(trial.cases())
    for number, (case, own) in enumerate(
        zip(cases, folder_names(cases, taken=(SHADER, FRAME)), strict=True)
    ):

        def part(share: float, done: int = number) -> None:
            told((done + share) / len(cases))

        within = enclosed(trial, case, able, part)
        contents |= _arrays(f"{name}/{own}", within)
        width, height = within.size
        found.append(
            GoldenCase(
                subject=name,
                case=case,
                folder=f"{name}/{own}",
                width=width,
                height=height,
                undecided=int(within.undecided.sum()),
                covered=within.covered,
                wide=within.wide,
                routes=tuple(route.name for route in able),
                outputs=tuple(map(_output, _output_names(within), within.outputs)),
                inputs=_inputs(trial, case, able, files, own),
            )
        )
    return GoldenPart(tuple(found), contents)


def whole(parts: Iterable[GoldenPart], routes: Sequence[Route], seed: int) -> dict[str, bytes]:
    """All files of a golden folder by their paths; the document comes last."""
    cases: list[GoldenCase] = []
    files: dict[str, bytes] = {}
    for part in parts:
        cases += part.cases
        files |= part.files
    document = Golden(
        format=FORMAT,
        version=VERSION,
        burnish=__version__,
        seed=seed,
        routes=tuple(route.name for route in routes),
        cases=tuple(cases),
    )
    return {**files, NAME: to_text(document).encode()}


def _arrays(folder: str, found: Enclosure) -> dict[str, bytes]:
    """The files with the bounds of a case."""
    files = {f"{folder}/undecided.npy": _npy(found.undecided.astype("|u1"))}
    for name, output in zip(_output_names(found), found.outputs, strict=True):
        path = f"{folder}/{name}"
        for end in ("lower", "upper", "reference"):
            files[f"{path}.{end}.npy"] = _npy(getattr(output, end).astype("<f8"))
        files[f"{path}.png"] = sixteen_bits(output.reference)
    return files


def subject_names(subjects: Sequence[tuple[str, Sequence[str]]]) -> list[str]:
    """The names of subjects, which have a name and a variant each: a rig and a pass. Where several
    have the same name, it has the variant as well."""
    alone = [name for name, _ in subjects]
    return [
        name if alone.count(name) == 1 else ".".join(filter(None, (name, *variant)))
        for name, variant in subjects
    ]


def variant_of(subject: Subject | FrameSubject) -> tuple[str, ...]:
    """The rig and the pass with which something was compiled."""
    if is_frame(subject):
        return (subject.plan.rig,)
    assert is_shader(subject), "it is no frame"
    return subject.reflection.rig, subject.reflection.pass_


def _trial(labelled: tuple[str, Subject | FrameSubject], seed: int) -> Trial:
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


def _output_names(found: Enclosure) -> list[str]:
    """The names of a case's outputs, which are those of their files."""
    return folder_names(output.shown.name for output in found.outputs)


def _output(name: str, output: Enclosed) -> GoldenOutput:
    shown = output.shown
    stored = None if shown.stored is None else _stored(shown.stored)
    return GoldenOutput(name=name, lanes=shown.lanes, stored=stored)


def _stored(place: Stored) -> StoredRow:
    return StoredRow(buffer=place.buffer, offset=place.offset, stride=place.stride, type=place.type)


def _npy(array: NDArray[Any]) -> bytes:
    """A file in NumPy's format 1.0."""
    file = BytesIO()
    np.lib.format.write_array(file, np.ascontiguousarray(array), version=(1, 0))
    return file.getvalue()
