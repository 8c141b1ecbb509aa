"""The types of shaders: a material, a pass and a rig put together as one graph.

Semantics makes a ``Shader``; the passes, the reference and the reflection read it.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property
from typing import Any

from ...frozen import fresh, frozen, record
from ..diagnostics.source import Span
from .blending import REPLACES, Blend, Mask
from .capture import Capture
from .expansion import Expansion
from .kernel import ScatterOperator, WorkGroup
from .leaves import Attribute, Buffer, HostPlace, Parameter, Resource
from .node import Graph, Node, Roots
from .render_state import RenderState
from .stages import PLACING, RASTERISED, Chain, StageRow
from .tessellation import Tessellation

ConstantValue = float | int | bool | tuple["ConstantValue", ...]
"""A value as nested tuples: lanes of a vector, columns of a matrix, elements of an array."""


@frozen
class LightInfo:
    """An entry of a rig: a light, or an array of lights."""

    name: str
    """As a host says it: ``torch``, or ``Studio.torch`` where something else has this name."""
    kind: str
    """The declaration of the light: ``Lantern``."""
    library: str
    """Which declaration of the library that is, ``std.lights.Lantern``; empty for others."""
    doc: str


@frozen
class ParameterInfo:
    """A declared parameter, with everything that a host or an editor may show."""

    parameter: Parameter
    declared_type: str
    """As written: ``rgb``, ``direction<world>``, ``Lamp[8]``."""
    range: tuple[float, float] | None
    default: ConstantValue | None
    doc: str
    span: Span
    members: tuple[ParameterInfo, ...] = ()
    """Of a structure, or of an array's elements: one row for each member."""
    light: LightInfo | None = None
    """The rig's entry that it belongs to."""
    library: str = ""
    """Which declaration of the library it is: ``std.file.Record.name``; empty for others."""


@frozen
class ExternMemberInfo:
    """A member of a block that the host owns."""

    name: str
    """In the text, too."""
    offset: int
    """In bytes."""
    info: ParameterInfo


@frozen
class ExternInfo:
    """A block that the host owns."""

    place: HostPlace
    group: str
    doc: str
    span: Span
    members: tuple[ExternMemberInfo, ...]
    """By offset."""


@frozen
class ResourceInfo:
    """A declared texture."""

    resource: Resource
    doc: str
    span: Span
    library: str = ""
    """Which declaration of the library it is, as for parameters."""
    is_brought: bool = False
    """Whether it is a light's that brings the steps to make it, which frames do."""


@frozen
class MeshInput:
    """What a vertex input means of a mesh whose primitives are drawn as instances."""

    name: str
    """A vertex input as it is declared, or a number that the pipeline supplies elsewhere."""
    corner: int | None = None
    """The corner of the primitive whose value it is; ``None`` if it is the same at all of them."""
    is_number: bool = False
    """Whether it is such a number: ``vertex_index``, ``instance_index``, ``primitive_index`` or
    ``patch_index``."""
    is_of_pattern: bool = False
    """Whether the mesh does not have it at all: it is where a vertex lies in its patch."""


@frozen
class BufferInfo:
    """A declared storage buffer."""

    buffer: Buffer
    element: ParameterInfo
    """What is known of one element, as of a parameter."""
    count: ParameterInfo
    """The parameter that says how many there are."""
    doc: str
    span: Span
    of_mesh: tuple[tuple[str, AttributeInfo], ...] = ()
    """Where a kernel captures vertices, or the vertex stage has too few inputs for the corners of
    primitives: the vertex inputs whose values the members of its elements hold, by the members'
    names."""
    each: int = 1
    """How many elements an invocation writes."""


@frozen
class AttributeInfo:
    """A declared vertex input, or one column of a declared matrix."""

    attribute: Attribute
    declared_type: str
    doc: str
    span: Span
    matrix: str = ""
    """The declared matrix that this is a column of."""
    column: int = 0
    mesh: MeshInput | None = None
    """Of a lowered expansion, where it comes from."""


@frozen
class RenderTarget:
    """The state of a render target, which a host has to set up."""

    format: str
    blend: Blend = REPLACES
    """What the hardware does behind the shader."""
    layers: int = 0
    """How many it has; 0 where it is a single picture and no array of them. All targets of a shader
    have equally many."""
    mask: Mask = "rgba"
    """Which lanes are written, of those that the format has."""
    clear: tuple[float, float, float, float] | None = None
    """What the pass wants to be there before anything is drawn, in four lanes; ``None`` where that
    is a host's affair."""

    @property
    def is_replaced(self) -> bool:
        """Whether nothing is left of what is there where something is drawn."""
        return self.blend == REPLACES and self.mask == "rgba"


@frozen(key=True)
class Store:
    """Where a result of the kind ``STORE`` goes: a part of an invocation's element. Or what one of
    the kind ``SCATTER``, and those beside it, is about: an element of its own choice."""

    buffer: Buffer
    path: tuple[str | int, ...] = ()
    """Members, and numbers of rows, on the way from the element to the part."""
    stride: int = 1
    """How many stored elements hold one value, as the columns of a matrix do."""
    offset: int = 0
    """Which of them this is."""
    as_bits: bool = False
    """Whether the bits of the value are written as a uint, whatever its type."""
    of_group: int = 0
    """For what is written once for each work group, how many invocations that has: the first one
    writes it. 0 where each invocation writes an element of its own."""
    operator: ScatterOperator | None = None
    """How a value is joined with what the element has, of what is scattered."""


@frozen
class Result:
    """One value that a shader delivers."""

    kind: str
    """A kind of ``stages.py``, such as ``CLIP_POSITION`` or ``TARGET``."""
    stage: StageRow
    """The stage that delivers it, in whose domain the value is."""
    value: Node
    name: str = ""
    """What a host knows it by. Results with a name get locations, in order."""
    doc: str = ""
    state: RenderTarget | None = None
    """For a result of the kind ``TARGET``, or ``IMAGE``: then only the format counts."""
    store: Store | None = None
    """For a result of the kind ``STORE`` or ``SCATTER``, and those beside it."""
    span: Span | None = None
    """Where a result of the kind ``TARGET`` is declared."""


@record
class Notes:
    """What people want to know about nodes and the graph itself does not say.

    A side table, so that sharing a node never loses or confuses what was written. Keys are ids.
    """

    names: dict[int, str] = fresh(factory=dict)
    spans: dict[int, Span] = fresh(factory=dict)
    docs: dict[int, str] = fresh(factory=dict)
    functions: dict[int, str] = fresh(factory=dict)
    """Names for the bodies of ``apply`` nodes."""
    terms: dict[int, str] = fresh(factory=dict)
    """Those of them that are bodies of terms, once for all lights: sums of these may be fused."""
    arguments: dict[int, tuple[str, ...]] = fresh(factory=dict)
    """Names for the variables of the bodies of ``apply`` nodes, in order."""
    variables: dict[int, tuple[str, ...]] = fresh(factory=dict)
    """Names for the variables of loops, in order."""
    roles: dict[int, str] = fresh(factory=dict)
    """What a value without a name is to the named one that it is a part of."""
    wholes: dict[int, str] = fresh(factory=dict)
    """What the parts of a value are called after, where that is not its name."""

    @cached_property
    def _tables(self) -> tuple[dict[int, Any], ...]:
        """All of these, in the order of their declaration."""
        return (
            self.names, self.spans, self.docs, self.functions, self.terms, self.arguments,
            self.variables, self.roles, self.wholes,
        )  # fmt: skip

    def copy(self) -> Notes:
        """The notes as they are now."""
        return Notes(*map(dict, self._tables))

    def take_over(self, others: Notes, ids: Mapping[int, int]) -> None:
        """Keep what ``others`` says of nodes that have other ids here.

        Where several of them are one, what was noted first counts, and the place that comes first.
        """
        for table, other in zip(self._tables, others._tables, strict=True):
            for id_, noted in other.items():
                if id_ in ids:
                    table.setdefault(ids[id_], noted)
        for id_, span in others.spans.items():
            if id_ in ids and span.is_before(self.spans[ids[id_]]):
                self.spans[ids[id_]] = span

    def forget_function(self, node: Node) -> None:
        """A value that a body gives where it is written out is no body itself."""
        for table in (self.functions, self.terms, self.arguments):
            table.pop(node.id, None)

    def follow(self, old: Node, new: Node) -> None:
        """Hand what is noted of a node on to one that replaces it, which keeps what it has."""
        id_ = old.id
        for table in self._tables:
            if id_ in table:
                table.setdefault(new.id, table[id_])


@frozen
class PatchPattern:
    """What is known of a vertex of a patch: values of its number and of the levels of the patch."""

    place: Node
    """Its coordinate in the patch, as the evaluation stage gets it."""
    is_there: Node
    """Whether the patch is divided into that many."""


@record
class Shader:
    """One material under one pass and one rig, before any optimisation."""

    name: str
    doc: str
    pass_name: str
    rig_name: str
    graph: Graph
    notes: Notes
    parameters: tuple[ParameterInfo, ...]
    """All declared parameters in declaration order, used or not: they fix the blocks' layout.

    Those of the host's own blocks come last.
    """
    resources: tuple[ResourceInfo, ...]
    attributes: tuple[AttributeInfo, ...]
    results: tuple[Result, ...]
    """All that it delivers. Nothing else says so: what needs the roots of the graph, or where they
    are written to, reads these rows."""
    externs: tuple[ExternInfo, ...] = ()
    """The host's own blocks."""
    buffers: tuple[BufferInfo, ...] = ()
    written: tuple[BufferInfo, ...] = ()
    """The buffers that a kernel writes."""
    chain: Chain = RASTERISED
    """The stages that it may need, in pipeline order."""
    expansion: Expansion | None = None
    """What each primitive of the mesh turns into, whichever stage does it."""
    layer: Parameter | None = None
    """Where render targets have layers and each of these has a draw of its own: what says for which
    one a draw is."""
    capture: Capture | None = None
    """What is written of each vertex instead of drawing, by a stream output or by a kernel."""
    tessellation: Tessellation | None = None
    """What each patch of the mesh is divided into, whichever stage does it."""
    levels: tuple[Result, ...] = ()
    """Where the host divides all patches alike, what the control stage would have delivered."""
    pattern: PatchPattern | None = None
    """Where the vertices of a patch lie, for pipelines that do not divide patches; ``None`` where a
    host makes the pattern for all of them."""
    listed: int = 0
    """How many vertices each patch turns into at most, where the vertices themselves find out or
    are captured."""
    work_group: WorkGroup | None = None
    """Which invocations of a kernel run together."""
    render_state: RenderState = RenderState()
    """What the pass asks of the pipeline."""

    @property
    def roots(self) -> Roots:
        """The values of all results: what passes and walks over the graph start from."""
        return Roots([result.value for result in self.results])

    @property
    def placing(self) -> frozenset[str]:
        """The kinds of results whose values all shaders have to compute alike that compute them
        in the same way."""
        return PLACING if self.render_state.is_invariant else frozenset()

    @property
    def layers(self) -> int:
        """How many layers each render target has; 0 where they are single pictures."""
        return max((r.state.layers for r in self.results if r.state is not None), default=0)

    def results_of(self, kind: str) -> tuple[Result, ...]:
        """The results of one kind, in order."""
        return tuple(result for result in self.results if result.kind == kind)
