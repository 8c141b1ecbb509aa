"""Where expressions about steps stand: in whose equations, and in which layers and levels.

``steps.py`` hands it down from an equation to the expressions in it.
"""

from __future__ import annotations

from collections.abc import Mapping

from ....frozen import EMPTY, changed, fresh, frozen
from ...ir.frame import Image, ImageDimension
from ..checking.step_needs import Dependencies, Key
from ..names.modules import Symbol
from ..state.scope import Instance, Scope
from .values import Made


@frozen(eq=False)
class Place:
    """Into which layers and levels of its images a step draws that is repeated."""

    dimension: ImageDimension = "2d"
    layers: int = 1
    layer: int = 0
    levels: int = 1
    level: int = 0
    images: dict[str, Image] = fresh(factory=dict)
    """Those that the first of the steps has made, and all others draw into as well."""
    suffix: str = ""
    """What tells the names of the steps apart."""


WHOLE = Place()


@frozen(eq=False)
class Owner:
    """Whose equations say what steps are: the frame's, or those of a light that brings some."""

    instance: Instance
    dependencies: Dependencies
    name: str = ""
    """What the steps of a light are called after; empty for the frame."""
    values: dict[Key, Made] = fresh(factory=dict)
    """What has been made of its slots."""

    def scope(self, owner: Symbol, level: int) -> Scope:
        """Where an expression stands that ``owner``, one of the record's chain, says."""
        return Scope(owner.module, self.instance, level)


@frozen(eq=False)
class Around:
    """Where an expression about steps stands."""

    owner: Owner
    scope: Scope
    name: str
    """What the step is called that the expression makes."""
    states: Mapping[str, Made] = EMPTY
    """What the states of ``iterate`` are."""
    place: Place | None = None
    light: bool = False
    """Whether each draw is repeated for each light of the rig."""
    depth: int = 0

    def inside(self) -> Around:
        """One expression deeper."""
        return changed(self, depth=self.depth + 1)
