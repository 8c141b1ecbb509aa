"""What a picture of a material shows: boxes in clusters, and arrows between them."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

Kind = Literal[
    "attribute", "input", "texture", "frame", "view", "rig", "material", "draw", "group",
    "derived", "value", "loop", "call", "crossing", "argument", "result",
]  # fmt: skip

KINDS: dict[Kind, str] = {
    "attribute": "vertex input",
    "input": "supplied by the pipeline",
    "texture": "texture",
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
"""What the kinds of boxes are called, in the order of the legend."""


@dataclass(slots=True)
class Box:
    """A named value."""

    key: str
    kind: Kind
    name: str
    type: str
    formula: str = ""
    """How it is computed; empty for what comes from outside."""
    note: str = ""
    """Where it is computed, and how often."""
    place: str = ""
    """Where it is written: file, line and column."""
    guarded: bool = False
    """Whether a guard stands in it."""


@dataclass(slots=True)
class Cluster:
    """What is computed in one place: a stage, a function, the host."""

    title: str
    is_stage: bool = False
    """Whether it is a stage, or the host, and not a function or loop in one."""
    boxes: list[Box] = field(default_factory=list)
    edges: list[tuple[str, str]] = field(default_factory=list)
    """From a box to one that uses it, by key; without repetition."""


@dataclass(slots=True)
class Picture:
    """One material under one pass and one rig."""

    title: str
    clusters: list[Cluster] = field(default_factory=list)
    crossings: list[tuple[str, str]] = field(default_factory=list)
    """From boxes of one cluster to those of another."""

    @property
    def boxes(self) -> list[Box]:
        """All of them."""
        return [box for cluster in self.clusters for box in cluster.boxes]
