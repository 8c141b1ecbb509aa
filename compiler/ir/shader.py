"""The types of shaders: a material, a pass and a rig put together as one graph.

Semantics makes a ``Shader``; the passes, the reference and the reflection read it.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal

from ...support.frozen import cached_property, fresh, frozen, record
from ..diagnostics.source import Span
from .blending import REPLACES, Blend, Mask
from .capture import Capture
from .expansion import Expansion
from .kernel import ScatterOperator, WorkGroup
from .leaves import Argument, Attribute, Buffer, HostPlace, Leaf, Parameter, Texture
from .node import Graph, Node, Roots
from .render_state import RenderState
from .stages import (
    PLACING,
    RASTERISED,
    TARGET,
    VALUE,
    VERTEX,
    Chain,
    InterpolationMode,
    StageRow,
)
from .tessellation import Tessellation
from .types import Intent

ConstantValue = float | int | bool | tuple["ConstantValue", ...]
"""A value as nested tuples: lanes of a vector, columns of a matrix, elements of an array."""


_MOST_NAMED = 12
"""The most members of an enumeration that a comment in a text names: some have hundreds."""


@frozen
class LightInfo:
    """An entry of a rig: a light, or an array of lights."""

    name: str
    """The host's name: ``torch``, or ``Studio.torch`` where that name is taken."""
    entry: str
    """The name that the rig gives it: ``torch``."""
    kind: str
    """The declaration of the light: ``Lantern``."""
    library: str
    """The declaration of the library that it is, ``std.lights.Lantern``; empty for others."""
    doc: str


@frozen
class LeafInfo:
    """A declared leaf, with everything that a host or an editor may show: one of those below."""

    leaf: Leaf
    declared_type: str
    """The type as written: ``rgb``, ``direction<world>``, ``Lamp[8]``."""
    doc: str
    span: Span


@frozen
class ParameterInfo(LeafInfo):
    """A declared parameter."""

    leaf: Parameter
    range: tuple[float, float] | None = None
    default: ConstantValue | None = None
    members: tuple[ParameterInfo, ...] = ()
    """One row for each member of a structure, or of an array's elements."""
    light: LightInfo | None = None
    """The rig's entry that it belongs to."""
    library: str = ""
    """The declaration of the library that it is: ``std.file.Record.name``; empty for others."""
    declared_by: str = ""
    """The material, mixin, light or other record that declares it; empty if none does."""

    @property
    def comment(self) -> str:
        """The doc comment for texts, which have only numbers for members of an enumeration."""
        meaning = self.leaf.meaning
        if meaning is None or meaning.enumeration is None:
            return self.doc
        names = meaning.enumeration.names[:_MOST_NAMED]
        numbered = ", ".join(f"{number} {name}" for number, name in enumerate(names))
        return f"{self.doc} ({numbered})" if self.doc else numbered


@frozen
class ExternMemberInfo:
    """A member of a block that the host owns."""

    name: str
    """The name, also in the text."""
    offset: int
    """The offset in bytes."""
    info: ParameterInfo


@frozen
class ExternInfo:
    """A block that the host owns."""

    place: HostPlace
    group: str
    doc: str
    span: Span
    members: tuple[ExternMemberInfo, ...]
    """The members, by offset."""


@frozen
class TextureInfo(LeafInfo):
    """A declared texture."""

    leaf: Texture
    library: str = ""
    """The declaration of the library that it is, as for parameters."""
    declared_by: str = ""
    """The record that declares it, as for parameters."""
    is_brought: bool = False
    """True if it belongs to a light that brings the steps to make it, which frames run."""
    intent: Intent | None = None
    """The intent that is declared, or ``color`` if texels become colours; ``None`` for others."""


@frozen
class MeshInput:
    """The meaning of a vertex input for a mesh whose primitives are drawn as instances."""

    name: str
    """A vertex input as it is declared, or a number that the pipeline supplies elsewhere."""
    corner: int | None = None
    """The corner of the primitive whose value it is; ``None`` if it is the same at all of them."""
    is_number: bool = False
    """True if it is such a number.

    That is ``vertex_index``, ``instance_index``, ``primitive_index`` or ``patch_index``.
    """
    is_of_pattern: bool = False
    """True if the mesh does not have it at all: it is the place of a vertex in its patch."""


@frozen
class BufferInfo(LeafInfo):
    """A declared storage buffer."""

    leaf: Buffer
    element: ParameterInfo
    """The description of one element, as of a parameter."""
    count: ParameterInfo
    """The parameter that says how many there are."""
    of_mesh: tuple[tuple[str, AttributeInfo], ...] = ()
    """The vertex inputs whose values the members of its elements hold, by the members' names.

    A kernel that captures vertices has such a buffer, and a vertex stage that has too few inputs
    for the corners of primitives.
    """
    each: int = 1
    """The number of elements that an invocation writes."""


def count_info(buffer: Buffer, span: Span, doc: str = "") -> ParameterInfo:
    """The declared parameter that says how many elements a buffer has.

    ``doc`` tells hosts what is counted; without it, that it is the elements of the buffer.
    """
    count = buffer.count
    doc = doc or f"The number of elements of `{buffer.name}`"
    return ParameterInfo(count, str(count.type), doc, span, (0.0, count.fact.hi), 0)


@frozen
class AttributeInfo(LeafInfo):
    """A declared vertex input, or one column of a declared matrix."""

    leaf: Attribute
    matrix: str = ""
    """The declared matrix that this is a column of."""
    column: int = 0
    mesh: MeshInput | None = None
    """For a lowered expansion, the input of the mesh that it comes from."""


ArgumentSource = Literal["surface", "attribute", "varying", "pipeline", "parameter"]
"""What an argument is: a value of the surface that engines have, a vertex input (interpolated,
where the function is called for pixels), a result of one of the functions for vertices that is
interpolated, a value that the pipeline supplies, or a parameter."""


@frozen
class ArgumentInfo:
    """An argument of functions that an engine calls."""

    leaf: Argument
    declared_type: str
    """The type as written, if the argument is made of a declaration; else its own."""
    doc: str
    source: ArgumentSource
    name_there: str
    """What it is called where it comes from.

    It is the engines' word, or the name of a vertex input, a function, a value of the pipeline, or
    a parameter.
    """
    mode: InterpolationMode = "perspective"
    """How the engine interpolates it, if it lies between vertices and pixels."""
    parameter: ParameterInfo | None = None
    attribute: AttributeInfo | None = None


@frozen
class RenderTarget:
    """The state of a render target, which a host has to set up."""

    format: str
    blend: Blend = REPLACES
    """The blending that the hardware does behind the shader."""
    layers: int = 0
    """The number of layers; 0 where it is a single picture and no array of them.

    All targets of a shader have equally many.
    """
    mask: Mask = "rgba"
    """The lanes that are written, of those that the format has."""
    clear: tuple[float, float, float, float] | None = None
    """The value before anything is drawn, in four lanes; ``None`` leaves it to the host."""

    @property
    def is_replaced(self) -> bool:
        """True if a fragment replaces all of the colour in the target."""
        return self.blend == REPLACES and self.mask == "rgba"


@frozen(key=True)
class Store:
    """The place of a result of the kind ``STORE``: a part of an invocation's element.

    For results of the kind ``SCATTER``, and those beside it, the element is one of their own
    choice.
    """

    buffer: Buffer
    path: tuple[str | int, ...] = ()
    """The members, and numbers of rows, on the way from the element to the part."""
    stride: int = 1
    """The number of stored elements that hold one value, such as the columns of a matrix."""
    offset: int = 0
    """The number of this one among them."""
    as_bits: bool = False
    """True if the bits of the value are written as a uint, whatever its type."""
    of_group: int = 0
    """The number of invocations of a work group, if only the first one of each group writes.

    It is 0 where each invocation writes an element of its own.
    """
    operator: ScatterOperator | None = None
    """The operator that joins a scattered value with the element; ``None`` for others."""


@frozen
class Result:
    """One value that a shader delivers."""

    kind: str
    """A kind of ``stages.py``, such as ``CLIP_POSITION`` or ``TARGET``."""
    stage: StageRow
    """The stage that delivers it, in whose domain the value is."""
    value: Node
    name: str = ""
    """The host's name for it. Results with a name get locations, in order."""
    doc: str = ""
    state: RenderTarget | None = None
    """The state of a result of the kind ``TARGET``, or ``IMAGE``: then only the format counts."""
    store: Store | None = None
    """The place of a result of the kind ``STORE`` or ``SCATTER``, and of those beside it."""
    span: Span | None = None
    """The span that declares a result of the kind ``TARGET``."""
    function: str = ""
    """The function that returns a result of the kind ``VALUE``: for an engine, a name of its own.

    Results with the same one are members of what it returns.
    """


@record
class Notes:
    """Notes about nodes for people, such as names and spans, which the graph itself does not hold.

    A side table, so that sharing a node never loses or confuses what was written. Keys are ids.
    """

    names: dict[int, str] = fresh(factory=dict)
    spans: dict[int, Span] = fresh(factory=dict)
    docs: dict[int, str] = fresh(factory=dict)
    functions: dict[int, str] = fresh(factory=dict)
    """Names for the bodies of ``apply`` nodes."""
    terms: dict[int, str] = fresh(factory=dict)
    """The ``functions`` that are bodies of terms, once for all lights: their sums may be fused."""
    arguments: dict[int, tuple[str, ...]] = fresh(factory=dict)
    """Names for the variables of the bodies of ``apply`` nodes, in order."""
    variables: dict[int, tuple[str, ...]] = fresh(factory=dict)
    """Names for the variables of loops, in order."""
    roles: dict[int, str] = fresh(factory=dict)
    """The role of a value without a name in the named one that it is a part of."""
    wholes: dict[int, str] = fresh(factory=dict)
    """The name that the parts of a value are called after, where it is not the value's own."""

    @cached_property
    def tables(self) -> tuple[dict[int, Any], ...]:
        """All of these, in the order of their declaration."""
        return (
            self.names, self.spans, self.docs, self.functions, self.terms, self.arguments,
            self.variables, self.roles, self.wholes,
        )  # fmt: skip

    def copy(self) -> Notes:
        """The notes as they are now."""
        return Notes(*map(dict, self.tables))

    def take_over(self, others: Notes, ids: Mapping[int, int]) -> None:
        """Takes over the notes of ``others`` about nodes that have other ids here.

        Where several nodes are one here, the first note counts, and the place that comes first.
        """
        for table, other in zip(self.tables, others.tables, strict=True):
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

    def about(self, node: Node) -> tuple[tuple[int, Any], ...]:
        """The notes about a node, each with the number of its table."""
        tables = enumerate(self.tables)
        return tuple((number, table[node.id]) for number, table in tables if node.id in table)

    def follow(self, old: Node, new: Node) -> None:
        """Hands the notes about a node on to one that replaces it, which keeps its own."""
        id_ = old.id
        for table in self.tables:
            if id_ in table:
                table.setdefault(new.id, table[id_])


@frozen
class PatchPattern:
    """A vertex of a patch: values that depend on its number and on the levels of the patch."""

    place: Node
    """The vertex's coordinate in the patch, as the evaluation stage gets it."""
    is_there: Node
    """A condition: the patch is divided into that many."""


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
    textures: tuple[TextureInfo, ...]
    attributes: tuple[AttributeInfo, ...]
    results: tuple[Result, ...]
    """All results of the shader.

    Nothing else says so: code that needs the roots of the graph, or where they are written to,
    reads these rows.
    """
    externs: tuple[ExternInfo, ...] = ()
    """The host's own blocks."""
    buffers: tuple[BufferInfo, ...] = ()
    written: tuple[BufferInfo, ...] = ()
    """The buffers that a kernel writes."""
    chain: Chain = RASTERISED
    """The stages that it may need, in pipeline order."""
    expansion: Expansion | None = None
    """The expansion of each primitive of the mesh, whichever stage does it."""
    layer: Parameter | None = None
    """The parameter that says for which layer a draw is.

    It exists where render targets have layers and each of these has a draw of its own.
    """
    views: int = 0
    """The number of views that the pass draws, each to a layer of its own.

    It is 0 where nothing tells views apart, and 1 without layers where ``view_index`` is read
    although the pass says nothing of views.
    """
    capture: Capture | None = None
    """The values that are written of each vertex instead of drawing.

    A stream output or a kernel writes them.
    """
    tessellation: Tessellation | None = None
    """The division of each patch of the mesh, whichever stage does it."""
    levels: tuple[Result, ...] = ()
    """The tessellation levels, if the host divides all patches alike.

    The control stage would have delivered them otherwise.
    """
    pattern: PatchPattern | None = None
    """The places of the vertices of a patch, for pipelines that do not divide patches.

    ``None`` where a host makes the pattern for all of them.
    """
    listed: int = 0
    """The largest number of vertices for each patch.

    It is set where the vertices themselves find out their number, or are captured.
    """
    work_group: WorkGroup | None = None
    """The work group: the invocations of a kernel that run together."""
    render_state: RenderState = RenderState()
    """The pipeline state that the pass asks for."""
    arguments: tuple[ArgumentInfo, ...] = ()
    """The arguments of functions that an engine calls, once it is known what they are made of."""

    @property
    def leaves(self) -> tuple[LeafInfo, ...]:
        """All that is declared: parameters, textures, buffers that are read, and vertex inputs."""
        return (*self.parameters, *self.textures, *self.buffers, *self.attributes)

    @property
    def roots(self) -> Roots:
        """The values of all results, from which passes and walks over the graph start."""
        return Roots([result.value for result in self.results])

    @property
    def placing(self) -> frozenset[str]:
        """The kinds of results that have to be invariant.

        All shaders that compute their values in the same way get the same values.
        """
        return PLACING if self.render_state.is_invariant else frozenset()

    @property
    def targets(self) -> tuple[RenderTarget, ...]:
        """The states of the render targets, in order."""
        states = (result.state for result in self.results_of(TARGET))
        return tuple(state for state in states if state is not None)

    @property
    def has_functions(self) -> bool:
        """True if its results are returned by functions that an engine calls."""
        return any(result.kind == VALUE for result in self.results)

    @property
    def is_lowered(self) -> bool:
        """True if it has vertices and fragments alone, of one view: what every target draws."""
        return self.chain == RASTERISED and not self.views

    @property
    def corner_buffer(self) -> Buffer | None:
        """The buffer from which the vertex stage of a draw reads the mesh, if it has one."""
        if self.chain[0] != VERTEX:
            return None
        return next((info.leaf for info in self.buffers if info.of_mesh), None)

    @property
    def layers(self) -> int:
        """The number of layers of each render target; 0 where they are single pictures."""
        return max((r.state.layers for r in self.results if r.state is not None), default=0)

    def results_of(self, kind: str) -> tuple[Result, ...]:
        """The results of one kind, in order."""
        return tuple(result for result in self.results if result.kind == kind)
