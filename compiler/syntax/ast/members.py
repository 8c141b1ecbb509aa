"""Members of materials, lights, passes, kernels, frames and mixins: one class for each kind.

``member_kinds.py`` has a row for each of them, with all else that the compiler knows of a kind.
"""

from __future__ import annotations

from typing import Literal, Protocol, get_args

from ....support.frozen import frozen
from ...diagnostics.source import Span
from .expressions import Expression, Field, Name, Reference, Turns, TypeName

RecordKind = Literal["material", "light", "pass", "kernel", "frame"]
RECORD_KINDS: tuple[RecordKind, ...] = get_args(RecordKind)
"""The kinds of records that have members; a mixin has those of the kind that it is for."""


@frozen(eq=False)
class Param:
    """``param x : T in a..b per group = default``."""

    span: Span
    doc: str
    name: Name
    type: TypeName
    range: tuple[Expression, Expression] | None
    group: Name | None
    default: Expression | None


@frozen(eq=False)
class Texture:
    """``map albedo : texture2d of rgb = white with { filter = linear, wrap = repeat }``."""

    span: Span
    doc: str
    name: Name
    type: TypeName
    content: Name | None
    """The meaning of its texels, if the declaration says one: ``rgb``."""
    group: Name | None
    default: Name | None
    """A word for a texture that a host may bind if it has no picture; or a step of the light."""
    result: Name | None
    """The result of that step: in frames the light brings the texture itself."""
    state: tuple[tuple[Name, Name], ...]

    @property
    def brought(self) -> Field | None:
        """The expression for a result of a step, if the texture is one."""
        if self.default is None or self.result is None:
            return None
        span = self.default.span
        return Field(span.to(self.result.span), Reference(span, self.default.text), self.result)


@frozen(eq=False)
class Buffer:
    """``buffer lamps : Lamp[] per group``: storage that the host binds, of any length."""

    span: Span
    doc: str
    name: Name
    type: TypeName
    group: Name | None


@frozen(eq=False)
class Attribute:
    """``attribute uv0 : vec2``: a vertex input."""

    span: Span
    doc: str
    name: Name
    type: TypeName
    rate: Name | None = None
    """The ``instance`` of ``per instance``."""


@frozen(eq=False)
class Slot:
    """``name : T = e``, an equation; without ``e`` a slot that a derived record must set."""

    span: Span
    doc: str
    name: Name
    type: TypeName | None
    value: Expression | None


@frozen(eq=False)
class Blending:
    """``blend alpha { mask = rgb }``: a state that has a name, and further settings."""

    span: Span
    mode: Name | None
    settings: tuple[tuple[Name, Name], ...] = ()


@frozen(eq=False)
class Target:
    """``target color : rgba8 = e blend alpha``: the value that a pass writes to a render target."""

    span: Span
    doc: str
    name: Name
    format: Name
    value: Expression
    blend: Blending | None


@frozen(eq=False)
class Clear:
    """``clear { color = #112233, depth = 0 }``: the contents before a pass draws."""

    span: Span
    values: tuple[Slot, ...]


@frozen(eq=False)
class Discard:
    """``discard when c``: the pixel is not written where ``c`` holds."""

    span: Span
    condition: Expression


@frozen(eq=False)
class Layers:
    """``layers of 6``: how many layers each render target of a pass has."""

    span: Span
    count: Expression


@frozen(eq=False)
class Views:
    """``views of 2``: how many views of a scene a pass draws, each to a layer of its targets."""

    span: Span
    count: Expression


Settings = tuple[tuple[Name, Expression], ...]
"""Settings, each with its value: a word, which is a reference then, or a constant."""


@frozen(eq=False)
class Raster:
    """``raster { cull = back }``: how a pass turns faces into fragments."""

    span: Span
    settings: Settings


@frozen(eq=False)
class Depth:
    """``depth { compare = less_equal, write = false }``: the depth test of a pass."""

    span: Span
    settings: Settings


@frozen(eq=False)
class Stencil:
    """``stencil { compare = equal, front.pass = invert }``: the stencil test of a pass."""

    span: Span
    settings: Settings


@frozen(eq=False)
class Capture:
    """``capture place : vec3 = e``: a value of each vertex that a pass keeps."""

    span: Span
    doc: str
    name: Name
    type: TypeName
    value: Expression


StripShape = Literal["strip", "list", "line", "points"]
"""The shape of strips.

``strip``: triangles that each share two vertices with the one before. ``list``: triangles that
share none. ``line``: lines from each vertex to the next one. ``points``: points.
"""


@frozen(eq=False)
class Strips:
    """``strip of 4 as i for s in 0..n where c like corner[0] { … }``: a group of an expansion."""

    span: Span
    shape: StripShape
    count: Expression
    """The number of vertices of each of the strips."""
    vertex: Name | None
    """The name of the number of a vertex in its strip."""
    turns: Turns | None
    """The number of strips, and the name of the number of one."""
    condition: Expression | None
    like: Expression | None
    """The corner whose values slots have that are not set."""
    equations: tuple[Slot, ...]


@frozen(eq=False)
class Expand:
    """``expand point { strip of 4 as i { … } }``: the expansion of each primitive of a mesh."""

    span: Span
    doc: str
    primitive: Name
    strips: tuple[Strips, ...]


@frozen(eq=False)
class Tessellate:
    """``tessellate triangle by e as at { … }``: the division of each patch of a mesh."""

    span: Span
    doc: str
    patch: Name
    points: Expression | None
    """The number of control points of a patch."""
    ends: tuple[Expression, ...] | None
    """The numbers of those that are its corners."""
    spacing: Name | None
    level: Expression
    """The level of edges: into how many steps an edge is divided."""
    inside: Expression | None
    lines: Expression | None
    """The number of lines of a patch of isolines."""
    coordinate: Name | None
    """The name of the place of a vertex in its patch."""
    equations: tuple[Slot, ...]


@frozen(eq=False)
class Result:
    """``result after : T[n] = e``: the value that a kernel writes to each of ``n`` elements.

    ``result totals : T[] per group = e`` is one for each work group.
    """

    span: Span
    doc: str
    name: Name
    type: TypeName
    per: Name | None
    value: Expression


Scattering = Literal["add", "min", "max", "and", "or"]
"""The operator that joins a value with an element; the order of joining never matters."""


@frozen(eq=False)
class Scatter:
    """``scatter bins : uint[n] add 1u at i where c``: values to join with elements."""

    span: Span
    doc: str
    name: Name
    type: TypeName
    operator: Scattering
    value: Expression
    place: Expression
    condition: Expression | None


@frozen(eq=False)
class Extent:
    """``runs over n``: for how many elements a kernel runs."""

    span: Span
    count: Expression


@frozen(eq=False)
class WorkGroup:
    """``work_group of 16 by 16``: how many invocations of a kernel run together."""

    span: Span
    sides: tuple[Expression, ...]


@frozen(eq=False)
class Models:
    """``models mirrors : Shiny``: models of the host's scene that a frame draws."""

    span: Span
    doc: str
    name: Name
    material: Name | None
    """The base of the materials of these models."""


@frozen(eq=False)
class Output:
    """``output picture = toned.color``: a result of a frame that its host gets."""

    span: Span
    doc: str
    name: Name
    value: Expression


Member = (
    Param | Texture | Buffer | Attribute | Slot | Target | Discard | Clear | Layers | Views | Raster
    | Depth | Stencil
    | Capture | Expand | Tessellate | Result | Scatter | Extent | WorkGroup | Models | Output
)  # fmt: skip
"""Every kind of member; its class has the fields ``span`` and, if comments describe it, ``doc``."""


class NamedMember(Protocol):
    """A member of a kind that has a name."""

    @property
    def span(self) -> Span:
        """The whole member."""

    @property
    def doc(self) -> str:
        """The doc comment of the member."""

    @property
    def name(self) -> Name:
        """The name that it declares."""


class ReadMember(NamedMember, Protocol):
    """A member of a kind whose name means a value in expressions (``overridden`` below)."""

    @property
    def type(self) -> TypeName | None:
        """The type that is written, if one is."""
