"""The contents of a picture of a material: boxes in clusters, and arrows between them.

``build.py`` makes it, and ``dot.py``, ``svg.py`` and ``text.py`` write it.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

Kind = Literal[
    "attribute", "input", "texture", "buffer", "frame", "view", "rig", "material", "draw", "group",
    "derived", "value", "loop", "call", "crossing", "argument", "result",
]  # fmt: skip

KINDS: dict[Kind, str] = {
    "attribute": "vertex input",
    "input": "supplied by the pipeline",
    "texture": "texture",
    "buffer": "storage buffer",
    "frame": "parameter of the frame",
    "view": "parameter of the view",
    "rig": "parameter of the rig",
    "material": "parameter of the material",
    "draw": "parameter of the draw",
    "group": "parameter of another group",
    "derived": "computed by the host",
    "value": "value",
    "loop": "loop over lights or turns",
    "call": "call of a function",
    "crossing": "crosses to the next stage",
    "argument": "argument, or index of a loop",
    "result": "result of the stage",
}
"""The names of the kinds of boxes, in the order of the legend."""


@dataclass(slots=True)
class Box:
    """A named value."""

    key: str
    kind: Kind
    name: str
    type: str
    formula: str = ""
    """The formula that computes it; empty if the value comes from outside."""
    note: str = ""
    """The place and the frequency of the computation."""
    place: str = ""
    """The place in the source: file, line and column."""
    guarded: bool = False
    """True if the box's formula contains a guard."""
    part: float | None = None
    """The formula's part in the error of a pixel; ``None`` if there is no such pixel."""


@dataclass(slots=True)
class Cluster:
    """The values that are computed in one place: a stage, a function, a loop or the host."""

    title: str
    is_stage: bool = False
    """True for a stage or the host; false for a function or loop."""
    boxes: list[Box] = field(default_factory=list)
    edges: list[tuple[str, str]] = field(default_factory=list)
    """Arrows from a box to one that uses it, by their keys, each once."""


@dataclass(slots=True)
class Picture:
    """One material with one pass and one rig."""

    title: str
    clusters: list[Cluster] = field(default_factory=list)
    crossings: list[tuple[str, str]] = field(default_factory=list)
    """Arrows from boxes of one cluster to boxes of another."""

    @property
    def boxes(self) -> list[Box]:
        """The boxes of all clusters."""
        return [box for cluster in self.clusters for box in cluster.boxes]
