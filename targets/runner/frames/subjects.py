"""Frames as something compiled, beside single materials and kernels, which hosts also draw."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol, TypeGuard

from ....compiler.documents.plan import FramePlan
from ..subject import Subject


class PlannedFrame(Protocol):
    """The parts of a frame that are needed to execute its plan."""

    @property
    def name(self) -> str:
        """The frame's name."""

    @property
    def plan(self) -> FramePlan:
        """The plan that a host executes."""

    @property
    def shaders(self) -> Sequence[Subject]:
        """The shaders, in the order of the plan."""


class FrameSubject(PlannedFrame, Protocol):
    """A compiled frame, as ``burnish.compile`` returns it."""

    @property
    def plan_of_reference(self) -> FramePlan:
        """The plan that the reference executes: one of its own, in which results share nothing."""


@dataclass(frozen=True, slots=True)
class SingleFrame:
    """A frame with one shader."""

    name: str
    plan: FramePlan
    shaders: Sequence[Subject]

    @property
    def plan_of_reference(self) -> FramePlan:
        """The plan itself, as the results of one step share nothing."""
        return self.plan


def is_frame(subject: Subject | FrameSubject) -> TypeGuard[FrameSubject]:
    """True if something compiled is a frame."""
    return not is_shader(subject)


def is_shader(subject: Subject | PlannedFrame) -> TypeGuard[Subject]:
    """True if something compiled is a material or a kernel, and no frame."""
    return hasattr(subject, "files")
