"""The document of a golden folder, ``golden.json``: its cases, and the files of each.

``burnish conform --golden`` writes it, and ``burnish schema golden`` prints its JSON Schema. What
judges pictures by it (``within.py``) reads only the names of outputs and files.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Literal

from ....compiler.constraints import Count, Positive
from ....compiler.ir.types import Dimension
from ....support.frozen import frozen
from ...runner.drivers.texels import TextureFormat

FORMAT: Literal["burnish-golden"] = "burnish-golden"
VERSION: Literal[1] = 1
"""The version of the form of golden folders; who reads them refuses others."""
NAME = "golden.json"
"""The name of the document in its folder."""


@frozen(kw_only=True)
class Golden:
    """A golden folder: what devices may draw in some cases, and what to draw there."""

    format: Literal["burnish-golden"]
    version: Literal[1]
    burnish: str
    """The version of Burnish that has written it."""
    seed: int
    """The seed of random values."""
    routes: tuple[str, ...]
    """The routes whose devices may draw what lies within the bounds."""
    cases: tuple[GoldenCase, ...]


@frozen(kw_only=True)
class GoldenCase:
    """One picture, or several of the same size: a subject in a scene with values."""

    subject: str
    """The name of the material, kernel or frame, with its rig and pass if it has several."""
    case: str
    """The name of the scene, or of a frame's output."""
    folder: str
    """The folder with the files of the case, below that of the document."""
    width: Positive
    height: Positive
    """Rows of a picture. Those of layers and faces stand one below the other."""
    undecided: Count
    """The number of pixels that are not compared."""
    covered: Count
    """The number of pixels that show the object."""
    wide: Count
    """The number of these whose bounds say nothing: they are wider than an eighth of the range of
    the picture's values."""
    routes: tuple[str, ...]
    """The routes whose bounds it has: those that can express the subject."""
    outputs: tuple[GoldenOutput, ...]
    """The pictures of the case."""
    inputs: ShaderInputs | FrameInputs
    """What to draw."""


@frozen(kw_only=True)
class GoldenOutput:
    """One picture of a case. Its files have its name."""

    name: str
    """The name of a render target or output, or a part of a buffer's elements."""
    lanes: Positive
    """The number of lanes, up to four."""
    stored: StoredRow | None
    """Where the lanes lie in a buffer; null for pixels. The elements are then a single row."""


@frozen(kw_only=True)
class StoredRow:
    """The place of a part of each element in a buffer, or in captured vertices."""

    buffer: str
    """The name of the buffer; empty for vertices that a stream output captures."""
    offset: Count
    """The offset in an element, in bytes; the lanes follow each other, four bytes each."""
    stride: Positive
    """Bytes from one element to the next."""
    type: str
    """The type of a lane: `<f4`, `<i4` or `<u4`."""


# --- inputs -----------------------------------------------------------------------------------
# All files are named from the folder of the document.


@frozen(kw_only=True)
class ShaderInputs:
    """What a material or a kernel needs: the texts, and the bytes of every slot."""

    kind: Literal["shader"]
    reflection: str
    """The file with the reflection, by which a host binds."""
    texts: Mapping[str, Mapping[str, ShaderText]]
    """The texts by profile, such as `wgsl:webgpu`, and stage."""
    extent: tuple[Count, Count, Count] | None
    """The elements of a kernel along x, y and z; null if something is drawn."""
    draws: tuple[DrawInputs, ...]
    """The draws: one, or one for each layer. A kernel has one, without vertices."""
    clear: tuple[tuple[float, float, float, float], ...]
    """The values to which the targets are cleared."""
    blend_constant: tuple[float, float, float, float]
    """The constant by which targets are blended."""
    textures: Mapping[str, TextureInput]
    """The textures that are read, by name; the reflection has their samplers."""
    buffers: Mapping[str, str]
    """Files with the contents of storage buffers before the draw, by name."""


@frozen(kw_only=True)
class DrawInputs:
    """One draw call, or one dispatch."""

    vertex_count: Count
    instance_count: Count
    vertices: Mapping[str, str]
    """Files with the values of all vertices or instances, by vertex input."""
    indices: str | None
    """The file with a 32-bit index for each corner; null for a kernel."""
    index_count: Count
    blocks: Mapping[str, str]
    """Files with the bytes of uniform blocks, by name."""


@frozen(kw_only=True)
class ShaderText:
    """The text of a stage."""

    file: str
    entry: str
    """The name of the entry point."""


@frozen(kw_only=True)
class TextureInput:
    """A texture with all its levels."""

    format: TextureFormat
    dimension: Dimension
    width: Positive
    height: Positive
    depth: Positive
    """Layers, faces or slices."""
    levels: tuple[str, ...]
    """A file for each level: texels row by row, the top row first, layer by layer."""


@frozen(kw_only=True)
class FrameInputs:
    """What a frame needs, which is a package for the host of web pages."""

    kind: Literal["frame"]
    package: str
    """The file with the package: the plan, all shaders with their texts, and the scene."""
    output: str
    """The output of the plan."""
    frame: Count
    """How many frames are drawn before the one that is meant."""
