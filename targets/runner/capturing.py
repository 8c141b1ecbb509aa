"""Captures vertices: runs a pass that captures by a route, and returns its output as arrays.

Hosts and tests call ``capture``, and ``conform`` calls the parts of it. ``Vertices.mesh`` makes a
mesh of them, which is drawn like any other.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...compiler.documents.drawing import CapturedRow, CaptureRow, VertexInputRow
from ...compiler.documents.reflection import Reflection
from ...compiler.documents.representations import lanes_of
from ...compiler.ir.stages import VERTICES
from ..toolchain import Toolchain
from .binding import pipeline
from .codes import compile_one
from .drivers.device import DriverError
from .drivers.frame_job import OWN, Captured, FrameDraw, FrameJob, FrameStep
from .drivers.pipeline import Pipeline
from .frames.states import Outcome, draw_states
from .instances.shapes import stored_as
from .mesh_buffers import give_mesh, mesh_rows
from .meshes import Mesh, MeshError
from .routes import Route
from .runner import Runner
from .scene_state import SceneState
from .subject import Subject


@dataclass(frozen=True, eq=False, slots=True)
class Vertices:
    """Captured vertices, in the order in which they were drawn."""

    members: Mapping[str, NDArray[Any]]
    """The captured values, by the name of the capture, of shape (vertices, lanes)."""
    primitive: str
    """The primitives: ``triangle``, of three vertices each, ``line``, of two, or ``point``."""
    count: int

    def mesh(self) -> Mesh:
        """A mesh of these vertices, whose channels are the captured values.

        One of them has to be called ``position``. Points and lines are a mesh without triangles.
        Raises ``MeshError`` for values that a mesh cannot have.
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
    """The vertices that a pass captures of a mesh, by a route.

    Raises ``CodeError`` if the route's compiler refuses the texts, ``DriverError``, also for a pass
    that captures nothing, ``PlanError``, and ``BudgetError`` for what is too large.
    """
    reflection = subject.reflection
    if reflection.capture is None:
        raise DriverError(f"{subject.name} is drawn by a pass that captures nothing")
    codes = compile_one(route, subject.files, toolchain)
    (found,) = captured_by(subject, [state], route, pipeline(reflection, route, codes), runner)
    return found


def captured_by(
    subject: Subject,
    states: Sequence[SceneState],
    route: Route,
    bound: Pipeline,
    runner: Runner,
) -> list[Vertices]:
    """The vertices that a route captures for each state, by a stream output or by a kernel.

    Raises ``DriverError``, ``PlanError``, and ``BudgetError`` for jobs that are too large.
    """
    if _capture(subject.reflection).buffer is None:
        job = capture_job(bound, states)
        found: Sequence[Captured] = runner.draw_frame(route, job).captured
    else:
        for state in states:
            give_elements(state)
        found = list(map(_compacted, states, draw_states(subject, states, route, bound, runner)))
    return [vertices(subject.reflection, captured) for captured in found]


def capture_job(bound: Pipeline, states: Sequence[SceneState]) -> FrameJob:
    """The job that captures the vertices of each state by a stream output, in a step of its own.

    The sizes of the states' pictures do not matter.
    """
    own = (OWN,) * len(bound.textures), (OWN,) * len(bound.buffers)
    steps = (
        FrameStep(
            draws=(FrameDraw(0, *own, draw=state.draw()),),
            captures=most(state),
            name=f"draw {number}",
        )
        for number, state in enumerate(states)
    )
    return FrameJob((), (), (bound,), tuple(steps))


def give_elements(state: SceneState) -> None:
    """Give a kernel that captures the values of the mesh that it reads."""
    rows = mesh_rows(state.instance.reflection)
    give_mesh(state.instance, {row.name: _of_elements(row, state) for row, _ in rows})


def _of_elements(row: VertexInputRow, state: SceneState) -> NDArray[Any]:
    """The values of a vertex input for each element: a vertex, or a primitive or a patch that turns
    into others."""
    reflection, copies = state.instance.reflection, state.instance_count
    if reflection.draw.expanded_by or reflection.draw.tessellation:
        return state.attributes[row.name]
    drawn = state.triangles.reshape(-1)
    if row.mesh is not None and row.mesh.is_number:
        is_vertex = row.step == VERTICES
        numbers = np.tile(drawn, copies) if is_vertex else np.repeat(np.arange(copies), len(drawn))
        return numbers[:, None]
    values = state.attributes[row.name]
    if row.step == VERTICES:
        return np.tile(values[drawn], (copies, 1))
    return np.repeat(values, len(drawn), axis=0)


def _compacted(state: SceneState, outcome: Outcome) -> Captured:
    """The vertices that a kernel has written, without those that it marks as absent."""
    row = _capture(state.instance.reflection)
    assert row.buffer is not None, "a kernel captures"
    words = np.frombuffer(outcome.elements[row.buffer], np.uint8).reshape(
        state.instance.extent(), -1
    )
    if row.there is not None:
        words = words[words[:, row.there] != 0, : row.stride]
    return Captured(len(words), words.tobytes())


def most(state: SceneState) -> int:
    """The largest number of vertices that can be captured of a mesh."""
    row = _capture(state.instance.reflection)
    return row.vertices * len(state.triangles) * state.instance_count


def vertices(reflection: Reflection, captured: Captured) -> Vertices:
    """Captured vertices as arrays."""
    row = _capture(reflection)
    words = np.frombuffer(captured.data, np.uint8).reshape(captured.count, row.stride)
    members = {each.name: _member(words, each) for each in row.members}
    return Vertices(members, row.topology, captured.count)


def _capture(reflection: Reflection) -> CaptureRow:
    """The capture of a pass that captures."""
    assert reflection.capture is not None
    return reflection.capture


def _member(words: NDArray[np.uint8], row: CapturedRow) -> NDArray[Any]:
    representation = row.representation
    lanes = lanes_of(representation)
    part = np.ascontiguousarray(words[:, row.offset : row.offset + 4 * lanes])
    return part.view(stored_as(representation)).reshape(len(words), lanes)
