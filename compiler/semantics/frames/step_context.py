"""The surroundings of expressions about steps: the owner's equations, layers and levels.

``steps.py`` hands it down from an equation to the expressions in it.
"""

from __future__ import annotations

from collections.abc import Mapping

from ....support.frozen import EMPTY, changed, fresh, frozen
from ...ir.frame import ImageDimension, StepTexture
from ..checking.step_needs import Dependencies, Key
from ..names.modules import Symbol
from ..state.scope import Instance, Scope
from .values import Made


@frozen(eq=False)
class AttachmentPoint:
    """The layers and levels of its images into which a repeated step draws."""

    dimension: ImageDimension = "2d"
    layers: int = 1
    layer: int = 0
    levels: int = 1
    level: int = 0
    images: dict[str, StepTexture] = fresh(factory=dict)
    """The images that the first of the steps has made; all others draw into them as well."""
    suffix: str = ""
    """The suffix that tells the names of the steps apart."""


WHOLE = AttachmentPoint()


@frozen(eq=False)
class EquationOwner:
    """The owner of the equations of steps: the frame, or a light that brings some."""

    instance: Instance
    dependencies: Dependencies
    name: str = ""
    """The prefix of the names of a light's steps; empty for the frame."""
    values: dict[Key, Made] = fresh(factory=dict)
    """The results of evaluating its slots."""

    def scope(self, owner: Symbol, level: int) -> Scope:
        """The scope of an expression of ``owner``, which is one of the record's chain."""
        return Scope(owner.module, self.instance, level)


@frozen(eq=False)
class StepContext:
    """The surroundings of an expression about steps."""

    owner: EquationOwner
    scope: Scope
    name: str
    """The name of the step that the expression makes."""
    states: Mapping[str, Made] = EMPTY
    """The values of the states of ``iterate``."""
    place: AttachmentPoint | None = None
    light: bool = False
    """True if each draw is repeated for each light of the rig."""
    depth: int = 0

    def inside(self) -> StepContext:
        """One expression deeper."""
        return changed(self, depth=self.depth + 1)
