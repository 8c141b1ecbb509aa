"""Plans and reflections with mistakes, as they may be received: what Burnish does with each.

``mistaken`` changes what a frame was compiled to, and ``trouble`` reads it as ``burnish render``
does, up to the job that a driver would get. Either the whole of it is possible, or an error says
why it is not: nothing else may be raised.
"""

from __future__ import annotations

import json
import traceback
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from random import Random
from typing import Any

import burnish
from burnish.compiler.budget import BudgetError
from burnish.compiler.documents import writing
from burnish.targets.runner.codes import Codes
from burnish.targets.runner.drivers.device import DriverError
from burnish.targets.runner.drivers.frame_checks import check_frame
from burnish.targets.runner.drivers.frame_job import FrameJob
from burnish.targets.runner.drivers.pipeline import Code
from burnish.targets.runner.drivers.wire import packed, unpacked
from burnish.targets.runner.files import FileError
from burnish.targets.runner.frames.by_route import frame_job
from burnish.targets.runner.frames.checking import PlanError
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.plan_files import read_frame, told_contradictions
from burnish.targets.runner.frames.scenery import in_a_row
from burnish.targets.runner.instances.host_values import MissingValuesError
from burnish.targets.runner.instances.values import ParameterError
from burnish.targets.runner.kernels import EmptyImageError
from burnish.targets.runner.meshes import MeshError
from burnish.targets.runner.routes import ROUTES

from .documents import mutated

FOLDER = Path(__file__).parents[3] / "examples" / "frames"
NAMES = ("deferred", "reaction", "shadows", "smooth_edges", "ripples", "transparency", "wax")
"""Frames that have, together, all that plans can say."""

ROUTE = ROUTES["lavapipe:glsl"]
SIZE = (8, 8)
TOLD = (
    BudgetError, DriverError, EmptyImageError, FileError, MeshError, MissingValuesError,
    ParameterError, PlanError,
)  # fmt: skip
"""The errors whose texts tell people what is wrong."""


@dataclass(frozen=True, slots=True)
class Received:
    """The files of a frame, by their names."""

    plan: Any
    reflections: Mapping[str, Any]
    texts: Mapping[str, str]

    def write(self, folder: Path) -> Path:
        """Write all files, and return the plan's."""
        for name, text in self.texts.items():
            (folder / name).write_text(text, "utf-8")
        return self.write_documents(folder)

    def write_documents(self, folder: Path) -> Path:
        """Write the plan and the reflections, and return the plan's file."""
        for name, document in self.reflections.items():
            (folder / name).write_text(json.dumps(document), "utf-8")
        path = folder / "Frame.plan.json"
        path.write_text(json.dumps(self.plan), "utf-8")
        return path


@cache
def received(name: str) -> Received:
    """The documents and texts that one of ``NAMES`` is compiled to, for one route."""
    (frame,) = burnish.compile(FOLDER / f"{name}.burnish", (ROUTE.profile,)).frames
    texts = {file.name: file.text for shader in frame.shaders for file in shader.files}
    reflections = {f"{each.name}.json": each.reflection for each in frame.shaders}
    return Received(writing.to_json(frame.plan), writing.to_json(reflections), texts)


def mistaken(number: int) -> Received:
    """A frame with mistakes, which follow from a number."""
    random = Random(number)
    whole = received(random.choice(NAMES))
    if random.random() < 0.5:
        return Received(mutated(whole.plan, random), whole.reflections, whole.texts)
    name = random.choice(list(whole.reflections))
    changed = {**whole.reflections, name: mutated(whole.reflections[name], random)}
    return Received(whole.plan, changed, whole.texts)


def outcome(path: Path) -> str:
    """The error of a plan as text; empty if there is none. Raises unexpected errors."""
    try:
        _prepare(path)
    except TOLD as error:
        return str(error)
    return ""


def trouble(path: Path) -> str | None:
    """The traceback of what a plan raises beside errors, or an error that nobody can read; ``None``
    if there is neither."""
    try:
        said = outcome(path)
    except Exception:
        return traceback.format_exc()
    return None if len(said) < LONGEST else f"it says {len(said)} letters: {said[:1000]}"


LONGEST = 40_000
"""The largest length of an error, in characters: a hundred lines."""


def _prepare(path: Path) -> None:
    """Everything up to the driver, and what this checks first."""
    frame = read_frame(path, (ROUTE.profile,))
    with told_contradictions(frame):
        tags = {row.name: row.materials for row in frame.plan.models}
        materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
        host = FrameHost(frame, in_a_row(materials, tags, "cube"), SIZE)
        names = [row.name for row in frame.plan.outputs if row.texture is not None]
        codes = [_codes(shader.files) for shader in frame.shaders]
        job = frame_job(host, ROUTE, codes, names, 2)
    check_frame(unpacked(FrameJob, packed(job)))


def _codes(files: Sequence[Any]) -> Codes:
    return Codes({stage: Code(file.entry_points[stage]) for file in files
                  for stage in file.entry_points})  # fmt: skip
