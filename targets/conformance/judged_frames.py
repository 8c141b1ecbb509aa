"""Frames as the reference draws them to judge drivers: with a plan and a scene of its own."""

from __future__ import annotations

from ...compiler.documents.plan import FramePlan
from ..runner.frames.host import FrameHost
from ..runner.frames.scenery import in_a_row
from ..runner.frames.subjects import FrameSubject, PlannedFrame
from .cases import Size

MESH = "torus"
"""The mesh of all models of a frame."""
SEVERAL = 2
"""The number of frames that are drawn if one reads what the last one left."""


class Meant:
    """A frame with a plan that nobody else executes."""

    def __init__(self, subject: FrameSubject) -> None:
        self.name = subject.name
        self.shaders = subject.shaders
        self.plan = subject.plan_of_reference


def frames_of(plan: FramePlan) -> int:
    """The number of frames that are drawn."""
    return SEVERAL if plan.kept else 1


def judged_host(subject: FrameSubject, size: Size) -> FrameHost:
    """A frame as the reference draws it."""
    return host_of(Meant(subject), size)


def host_of(subject: PlannedFrame, size: Size) -> FrameHost:
    """A frame with the scene that it is judged in: a model of each material."""
    tags = {row.name: row.materials for row in subject.plan.models}
    materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
    return FrameHost(subject, in_a_row(materials, tags, MESH), size)
