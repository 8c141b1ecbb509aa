"""The contents of a picture of a frame: boxes with arrows between them, and a time line below.

``build.py`` makes it of the frame's plan, and ``svg.py``, ``dot.py`` and ``text.py`` write it.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

Kind = Literal[
    "models", "texture", "buffer", "light", "parameter", "previous", "draw", "run", "copy", "output"
]

KINDS: dict[Kind, str] = {
    "models": "models of the scene",
    "texture": "texture of the host",
    "buffer": "buffer of the host",
    "light": "light of the rig",
    "parameter": "parameter of the frame",
    "previous": "what the last frame left",
    "draw": "pass",
    "run": "kernel",
    "copy": "copy",
    "output": "output",
}
"""The names of the kinds of boxes, in the order of the legend."""

STEPS: frozenset[Kind] = frozenset(("draw", "run", "copy"))

MarkKind = Literal["cleared", "drawn over", "written", "read", "dropped"]

MARKS: dict[MarkKind, str] = {
    "cleared": "cleared and drawn to",
    "drawn over": "drawn over",
    "written": "written as a whole",
    "dropped": "drawn to, and then dropped",
    "read": "read",
}
"""The uses of a texture in a step, in the order of the legend."""
LETTERS: dict[MarkKind, str] = {
    "cleared": "C", "drawn over": "O", "written": "W", "dropped": "D", "read": "r",
}  # fmt: skip
"""The letters for these uses, for texts."""


@dataclass(slots=True)
class Port:
    """A row of a box: a result that the step leaves."""

    key: str
    """The result's name: ``step.target``."""
    name: str
    what: str
    """The format, size and layers of a texture, or the type of a buffer."""
    texture: int | None
    """The number of the texture with the result; ``None`` for buffers."""
    mark: MarkKind
    place: str


@dataclass(slots=True)
class Box:
    """A step, or several that one equation repeats; or an input or output of the host."""

    key: str
    kind: Kind
    name: str
    lines: list[str] = field(default_factory=list)
    """The lines below the name."""
    repeated: str = ""
    """The number of repetitions of the step, and their reason."""
    only_first: bool = False
    """True if the step is done in the first frame only."""
    notes: list[str] = field(default_factory=list)
    """The values that the frame sets, and where they are written."""
    ports: list[Port] = field(default_factory=list)


ArrowKind = Literal["given", "read", "over", "initial", "back"]
"""The kind of dependence: given by the host; read; drawn over; read in the first frame only; or
read in the next frame."""


@dataclass(frozen=True, slots=True)
class Arrow:
    """An arrow between boxes, from one of the rows of the first one if that is a step."""

    source: str
    target: str
    kind: ArrowKind
    port: str = ""


@dataclass(slots=True)
class Column:
    """A step of the plan."""

    number: int
    name: str
    only_first: bool = False
    group: str = ""
    """The key of the box to which it belongs."""


@dataclass(slots=True)
class Life:
    """The columns from which to which a result is needed."""

    result: str
    first: int
    last: int
    before: bool = False
    """True if the last frame left the result."""
    after: bool = False
    """True if the host or the next frame needs the result."""


@dataclass(slots=True)
class Row:
    """A texture, or a buffer, with its results one after the other."""

    title: str
    what: str
    texture: int | None
    lives: list[Life] = field(default_factory=list)
    marks: dict[int, MarkKind] = field(default_factory=dict)
    """The uses of the texture by the steps, by their columns."""

    @property
    def holds(self) -> str:
        """The names of the results."""
        lives = sorted(self.lives, key=lambda life: (life.first, life.last))
        names = (f"{life.result}{' of the last frame' * life.before}" for life in lives)
        return ", ".join(dict.fromkeys(names))


@dataclass(slots=True)
class FramePicture:
    """One frame."""

    title: str
    doc: str = ""
    boxes: list[Box] = field(default_factory=list)
    arrows: list[Arrow] = field(default_factory=list)
    columns: list[Column] = field(default_factory=list)
    rows: list[Row] = field(default_factory=list)

    @property
    def shared(self) -> str:
        """The number of textures, and of the results in them."""
        textures = [row for row in self.rows if row.texture is not None]
        found = {life.result for row in textures for life in row.lives}
        before = sum(all(life.before for life in row.lives) for row in textures)
        kept = f", and {before} of the last frame" if before else ""
        own = _many(len(textures) - before, "texture")
        return f"{_many(len(found), 'result')} in {own}{kept}"


def _many(count: int, word: str) -> str:
    return f"{count} {word}{'' if count == 1 else 's'}"
