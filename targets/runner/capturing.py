"""Captures vertices: runs a pass that captures by a route, and gives what it wrote as arrays.

Hosts and tests call ``capture``, and ``conform`` calls the parts of it. ``Vertices.mesh`` makes a
mesh of them, which is drawn like any other.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ..toolchain import Toolchain
from .binding import pipeline
from .codes import compile_one
from .drivers.draw import Captured, CaptureJob, DriverError
from .meshes import Mesh, MeshError
from .routes import Route
from .runner import Runner
from .scene_state import SceneState
from .subject import Subject

KINDS = {"f": "<f4", "v": "<f4", "i": "<i4", "u": "<u4"}
"""The type of a number, by the first letter of the representation."""


@dataclass(frozen=True, eq=False, slots=True)
class Vertices:
    """Captured vertices, in the order in which they were drawn."""

    members: Mapping[str, NDArray[Any]]
    """By the name of the capture, of shape (vertices, lanes)."""
    primitive: str
    """What they are: ``triangle``, of three vertices each, or ``point``."""
    count: int

    def mesh(self) -> Mesh:
        """A mesh of these vertices, whose channels are the captured values.

        One of them has to be called ``position``. Points are a mesh without triangles. Raises
        ``MeshError`` for values that a mesh cannot have.
        """
        if "position" not in self.members:
            raise MeshError("only vertices with a captured `position` make a mesh")
        wide = {
            name: values.astype(_WIDE[values.dtype.kind]) for name, values in self.members.items()
        }
        drawn = self.count if self.primitive == "triangle" else 0
        return Mesh(wide, np.arange(drawn, dtype=np.int64).reshape(-1, 3))


_WIDE = {"f": np.float64, "i": np.int64, "u": np.int64}


def capture(
    subject: Subject, state: SceneState, route: Route, runner: Runner, toolchain: Toolchain
) -> Vertices:
    """What a pass captures of a mesh, by a route.

    Raises ``CodeError`` if the route's compiler refuses the texts, and ``DriverError``, also for a
    pass that captures nothing.
    """
    reflection = subject.reflection
    if reflection["capture"] is None:
        raise DriverError(f"{subject.name} is drawn by a pass that captures nothing")
    codes = compile_one(route, subject.files, toolchain)
    job = CaptureJob(pipeline(reflection, route, codes), (state.draw(),), (most(state),))
    (captured,) = runner.capture(route, job)
    return vertices(reflection, captured)


def most(state: SceneState) -> int:
    """How many vertices are captured of a mesh at most."""
    row = state.instance.reflection["capture"]
    return int(row["vertices"]) * len(state.triangles) * state.instance_count


def vertices(reflection: Mapping[str, Any], captured: Captured) -> Vertices:
    """What was captured, as arrays."""
    row = reflection["capture"]
    words = np.frombuffer(captured.data, np.uint8).reshape(captured.count, row["stride"])
    members = {each["name"]: _member(words, each) for each in row["members"]}
    return Vertices(members, row["primitive"], captured.count)


def _member(words: NDArray[np.uint8], row: Mapping[str, Any]) -> NDArray[Any]:
    representation = row["representation"]
    lanes = int(representation[-1]) if representation[-1].isdigit() else 1
    part = np.ascontiguousarray(words[:, row["offset"] : row["offset"] + 4 * lanes])
    return part.view(KINDS[representation[0]]).reshape(len(words), lanes)
