"""Storage buffers with the attributes that vertices read of a mesh, instead of vertex inputs.

``lower_capture`` has a kernel read such a buffer, and ``corners_in_buffer`` the vertex stage where
the corners of a primitive need more vertex inputs than there are.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ...support.frozen import changed
from ..diagnostics.source import Span
from ..ir.kernel import WRITTEN_GROUP
from ..ir.leaves import Attribute, Buffer, Parameter
from ..ir.shader import AttributeInfo, BufferInfo, ParameterInfo, Shader, count_info
from ..ir.types import RuntimeArray, Struct, Type

MESH = "mesh"
"""The name of the buffer, which a host binds for each draw, or for a capturing kernel."""
VERTEX_STRUCT, PRIMITIVE_STRUCT = "MeshVertex", "MeshPrimitive"
"""The names of the structures that are the elements of these buffers."""


def mesh_buffer(
    shader: Shader, infos: Iterable[AttributeInfo], *, is_primitive: bool
) -> BufferInfo:
    """The buffer that has the inputs of a vertex, or of a primitive, in each element."""
    rows = [(member_name(info.leaf), info) for info in infos]
    taken = {name for info in shader.leaves for name in _structs_of(info.leaf.type)}
    struct = Struct(
        free_name(PRIMITIVE_STRUCT if is_primitive else VERTEX_STRUCT, taken),
        tuple((name, info.leaf.type) for name, info in rows),
    )
    span = rows[0][1].span
    # A mesh's values are taken as they are: contracts beyond their types are not checked.
    described = tuple(
        ParameterInfo(Parameter(name, type_, ""), str(type_), info.doc, span)
        for (name, type_), (_, info) in zip(struct.members, rows, strict=True)
    )
    buffer = Buffer(free_name(MESH, names_taken(shader)), RuntimeArray(struct), WRITTEN_GROUP)
    element = ParameterInfo(Parameter("", struct, ""), struct.name, "", span, members=described)
    return changed(buffer_info(buffer, element, span), of_mesh=tuple(rows))


def member_name(leaf: Attribute) -> str:
    """The name of the member of an element that has the values of a vertex input."""
    return leaf.name.replace(".", "_")


def buffer_info(buffer: Buffer, element: ParameterInfo, span: Span) -> BufferInfo:
    """A buffer that nobody has declared, with the number of its elements."""
    return BufferInfo(buffer, str(buffer.type), "", span, element, count_info(buffer, span))


def names_taken(shader: Shader) -> set[str]:
    """The names of all parameters, textures and buffers."""
    return {
        *(info.leaf.name for info in shader.parameters),
        *(info.leaf.name for info in shader.textures),
        *(info.leaf.name for info in shader.buffers),
    }


def free_name(name: str, taken: set[str]) -> str:
    """A name like this that nothing has."""
    while name in taken:
        name += "_"
    return name


def _structs_of(type_: Type) -> Iterator[str]:
    """The name of the structure that a parameter or a buffer consists of, if it does."""
    while not isinstance(type_, Struct) and hasattr(type_, "element"):
        type_ = type_.element
    if isinstance(type_, Struct):
        yield type_.name
