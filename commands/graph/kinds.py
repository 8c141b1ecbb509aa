"""The kinds of boxes, arrows and marks: a row for each, with its words and looks.

The writers of all formats read these tables. A legend has the rows that a picture uses, in the
order of the table.
"""

from __future__ import annotations

from enum import Enum


class Kind(Enum):
    """A kind of box: its words, the colours of its inside and of its line, and other looks.

    ``round`` boxes come from outside or go there; ``dashed`` ones were made before; ``dark`` ones
    have white letters; and ``said`` means that a box without a formula says its kind.
    """

    # Inputs of a material, or of a frame.
    ATTRIBUTE = "vertex input", "#e6f0d8", "#6b8f3a", "round"
    INPUT = "supplied by the pipeline", "#eef3e6", "#8aa36b", "round"
    TEXTURE = "texture", "#d8efe6", "#2f8f6b", "round"
    BUFFER = "storage buffer", "#d5ecf0", "#23808f", "round"
    MODELS = "models of the scene", "#fde3d3", "#c2622a", "round"
    HOST_TEXTURE = "texture of the host", "#d8efe6", "#2f8f6b", "round"
    HOST_BUFFER = "buffer of the host", "#d5ecf0", "#23808f", "round"
    LIGHT = "light of the rig", "#fdf0cf", "#b98a14", "round"
    FRAME_PARAMETER = "parameter of the frame", "#f3e6f5", "#9a5ba6", "round"
    VIEW_PARAMETER = "parameter of the view", "#e9e3f8", "#6f58b5", "round"
    RIG_PARAMETER = "parameter of the rig", "#fdf0cf", "#b98a14", "round"
    MATERIAL_PARAMETER = "parameter of the material", "#fde3d3", "#c2622a", "round"
    DRAW_PARAMETER = "parameter of the draw", "#e3e9f8", "#4a68b0", "round"
    OTHER_PARAMETER = "parameter of another group", "#f0e8e0", "#8c7458", "round"
    PREVIOUS = "what the last frame left", "#ffffff", "#5b6570", "round dashed"
    # Values of a material.
    DERIVED = "computed by the host", "#f7f3df", "#8f7f2a", "round dashed said"
    VALUE = "value", "#ffffff", "#5b6570"
    LOOP = "loop over lights or turns", "#e2f1f8", "#2b7da3"
    CALL = "call of a function", "#efe9fb", "#7a55c7"
    CROSSING = "crosses to the next stage", "#dff3f1", "#12857a", "said"
    ARGUMENT = "argument, or index of a loop", "#f1f1f1", "#8a8a8a", "round"
    RESULT = "result of the stage", "#34404c", "#1d252d", "dark"
    # Equations of a material, as they are written.
    INHERITED = "inherited", "#eef3e6", "#8aa36b", "round"
    LIGHTS = "lights of the rig", "#fdf0cf", "#b98a14", "round"
    EQUATION = "equation", "#ffffff", "#34404c"
    OPERATION = "operation", "#f1f3f5", "#8b97a3"
    FUNCTION = "function", "#efe9fb", "#7a55c7"
    TERM = "term", "#e2f1f8", "#2b7da3"
    STATEMENT = "statement of the material", "#f0e8e0", "#8c7458"
    DRAWN_BY = "pass that draws the material", "#34404c", "#1d252d", "dark"
    # Steps of a frame.
    DRAW = "pass", "#e3e9f8", "#4a68b0"
    RUN = "kernel", "#d9eef2", "#23808f"
    COPY = "copy", "#ececec", "#8a8a8a"
    OUTPUT = "output", "#34404c", "#1d252d", "round dark"

    def __init__(self, words: str, fill: str, line: str, looks: str = "") -> None:
        self.words = words
        self.fill = fill
        self.line = line
        self.is_round = "round" in looks
        self.is_dashed = "dashed" in looks
        self.is_dark = "dark" in looks
        self.is_said = "said" in looks


class ArrowKind(Enum):
    """A kind of dependence: its words, the width, dashes and colour of the line, and what a text
    adds to the name of the source.

    Without words, there is nothing to explain, and without a colour, an arrow has that of its
    source. A text leaves out arrows whose addition is ``None``.
    """

    USE = "", 1.1, "", "#8b97a3", None
    WIRE = "", 1.4, "", "", None
    CROSSING = "", 1.6, "", "#12857a", None
    GIVEN = "given by the host", 1.0, "", "", ""
    READ = "read", 1.5, "", "", ""
    OVER = "drawn over", 3.0, "", "", ", drawn over"
    INITIAL = "read in the first frame only", 1.5, "2 3", "", ", in the first frame"
    BACK = "read in the next frame", 1.5, "6 3", "", None

    def __init__(self, words: str, width: float, dash: str, color: str, told: str | None) -> None:
        self.words = words
        self.width = width
        self.dash = dash
        self.color = color
        self.told = told


class Mark(Enum):
    """A use of a texture by a step: its words, and its letter in texts."""

    CLEARED = "cleared and drawn to", "C"
    DRAWN_OVER = "drawn over", "O"
    WRITTEN = "written as a whole", "W"
    DROPPED = "drawn to, and then dropped", "D"
    READ = "read", "r"

    def __init__(self, words: str, letter: str) -> None:
        self.words = words
        self.letter = letter


_TEXTURES = (
    "#4e79a7", "#f28e2b", "#59a14f", "#b07aa1", "#e15759", "#3d9a94", "#c9a227", "#9c755f",
    "#d37295", "#6b7fd7", "#7f8c3a", "#5b6570",
)  # fmt: skip
"""The colours of textures; they repeat if there are more textures."""
_FAULTLESS, _FAULTY = (0xFF, 0xFF, 0xFF), (0xE8, 0x4A, 0x35)
"""The fills of boxes without any part in a pixel's error, and of boxes that make all of it."""


def texture_color(number: int | None) -> str:
    """The colour of a texture, or of a buffer, which has no number."""
    return Kind.BUFFER.line if number is None else _TEXTURES[number % len(_TEXTURES)]


def shade(part: float) -> str:
    """The fill for a part of the error: by its root, so that small parts can be seen, too."""
    share = min(part, 1.0) ** 0.5
    pairs = zip(_FAULTLESS, _FAULTY, strict=True)
    return "#" + "".join(f"{round(a + share * (b - a)):02x}" for a, b in pairs)
