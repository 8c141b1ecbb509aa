"""The contents of a picture: boxes in clusters, arrows between them, and perhaps a time line.

``equations.py`` makes it of the equations of a material, ``program.py`` of the stages of its
program and ``frame.py`` of the plan of a frame; ``svg.py``, ``dot.py`` and ``text.py`` write it.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from .kinds import ArrowKind, Kind, Mark, shade


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
    mark: Mark
    place: str


@dataclass(slots=True)
class Input:
    """A row of a box: something that it reads, with the name of whatever gives it."""

    label: str
    """The name of an argument, or a sign; it may be empty."""
    words: str
    """A constant, or the name of another box and what is picked out of it."""
    is_read: bool
    """True if it is read of another box; false for a constant."""

    @property
    def text(self) -> str:
        """The row in words."""
        if self.label in ("", self.words):
            return self.words
        is_sign = not self.label[0].isalnum()
        return f"{self.label}{' ' if is_sign else ': '}{self.words}"


@dataclass(slots=True)
class Box:
    """A value, or an input or output of the host, an equation, a step or its repetitions."""

    key: str
    kind: Kind
    name: str
    type: str = ""
    formula: str = ""
    """The formula that computes it; empty if the value comes from outside, and for steps."""
    note: str = ""
    """The place and the frequency of the computation, if its kind does not say it."""
    subject: str = ""
    """The pass or kernel of a step, or the result of which it makes a copy."""
    lines: list[str] = field(default_factory=list)
    """The actions of a step, and other lines below the name."""
    settings: list[str] = field(default_factory=list)
    """The values that the frame sets for a step."""
    place: str = ""
    """The place in the source: file, line and column."""
    guarded: bool = False
    """True if the box's formula contains a guard."""
    part: float | None = None
    """The formula's part in the error of a pixel; ``None`` if there is no such pixel."""
    repeated: str = ""
    """The number of repetitions of a step, and their reason."""
    only_first: bool = False
    """True if a step is done in the first frame only."""
    ports: list[Port] = field(default_factory=list)
    inputs: list[Input] = field(default_factory=list)

    @property
    def heading(self) -> str:
        """The name, and the type if there is one."""
        return f"{self.name}: {self.type}" if self.type else self.name

    @property
    def what(self) -> str:
        """The kind, more exactly if that is known; empty if a formula says more."""
        if self.subject:
            return f"{self.kind.words} {self.subject}"
        return self.note or ("" if self.formula else self.kind.words)

    @property
    def below(self) -> Iterator[str]:
        """The lines below the heading."""
        if self.formula and self.formula != self.name:
            yield self.formula
        if self.kind.is_said and not self.formula:
            yield self.what
        if self.subject:
            yield self.subject
        yield from self.lines
        if self.repeated:
            yield f"× {self.repeated}"
        if self.only_first:
            yield "first frame only"

    @property
    def error(self) -> str:
        """The formula's part in the error of a pixel, in words; empty if it has none."""
        return f"{self.part:.1%} of the error" if self.part else ""

    @property
    def facts(self) -> list[str]:
        """The facts that do not stand in the box, for readers who point at it."""
        guard = "a guard stays in it" if self.guarded else ""
        kind = self.note or self.kind.words
        return list(filter(None, [kind, self.error, guard, self.place, *self.settings]))

    @property
    def fill(self) -> str:
        """The colour: of its kind, or if there is a pixel, of the part in its error."""
        return self.kind.fill if self.part is None else shade(self.part)

    @property
    def is_dark(self) -> bool:
        """True if the letters have to be white."""
        return self.kind.is_dark and self.part is None


@dataclass(frozen=True, slots=True)
class Arrow:
    """An arrow between boxes, given by their keys.

    It comes from one of the rows of the first one if that has rows, and leads to a row of the other
    one if that has inputs.
    """

    source: str
    target: str
    kind: ArrowKind
    port: str = ""
    row: int | None = None
    """The number of the input at which it ends."""


@dataclass(slots=True)
class Cluster:
    """Boxes that belong together: what a stage, a function, a loop or the host computes.

    The clusters of a frame, and of a material's equations, have no borders: in a picture, these
    mix, so that every arrow points right.
    """

    title: str
    boxes: list[Box] = field(default_factory=list)
    has_border: bool = True
    is_stage: bool = False
    """True for a stage or the host; false for a function or loop."""


@dataclass(slots=True)
class Column:
    """A step of a plan."""

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
    marks: dict[int, Mark] = field(default_factory=dict)
    """The uses of the texture by the steps, by their columns."""

    @property
    def ordered(self) -> list[Life]:
        """The lives of the results, the earliest first."""
        return sorted(self.lives, key=lambda life: (life.first, life.last))

    @property
    def holds(self) -> str:
        """The names of the results."""
        names = (f"{life.result}{' of the last frame' * life.before}" for life in self.ordered)
        return ", ".join(dict.fromkeys(names))


@dataclass(slots=True)
class TimeLine:
    """The steps of a frame, and what each texture holds from step to step."""

    columns: list[Column]
    rows: list[Row]

    @property
    def used(self) -> list[Mark]:
        """The kinds of marks that there are, in the order of the legend."""
        found = {mark for row in self.rows for mark in row.marks.values()}
        return [mark for mark in Mark if mark in found]

    @property
    def shared(self) -> str:
        """The number of textures, and of the results in them."""
        textures = [row for row in self.rows if row.texture is not None]
        found = {life.result for row in textures for life in row.lives}
        before = sum(all(life.before for life in row.lives) for row in textures)
        kept = f", and {before} of the last frame" if before else ""
        own = _many(len(textures) - before, "texture")
        return f"{_many(len(found), 'result')} in {own}{kept}"


@dataclass(slots=True)
class Picture:
    """One material with one pass and one rig, or one frame."""

    title: str
    clusters: list[Cluster]
    arrows: list[Arrow]
    doc: str = ""
    time_line: TimeLine | None = None

    @property
    def boxes(self) -> list[Box]:
        """The boxes of all clusters."""
        return [box for cluster in self.clusters for box in cluster.boxes]


def _many(count: int, word: str) -> str:
    return f"{count} {word}{'' if count == 1 else 's'}"
