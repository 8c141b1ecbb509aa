"""The corners of expanded primitives on targets where these primitives have no stage.

``lower_expansion`` asks for values at these corners. They are vertices of the mesh, or vertices of
the patches into which a tessellation divides it.
"""

from __future__ import annotations

from ..ir import build
from ..ir.expansion import Expansion
from ..ir.node import Node
from ..ir.shader import AttributeInfo, Result, Shader
from ..ir.tessellation import Tessellation
from ..ir.types import INT, UINT, Type
from .corner_inputs import VERTEX_INDEX, CornerInputs, at_number, listed_vertex
from .patch_vertices import PatchVertices, levels_of, most_cells


class MeshCorners:
    """The corners of the primitives of a mesh, each of which is an instance of the draw."""

    levels: tuple[Result, ...] = ()
    """The tessellation levels that the host computes. A mesh without patches has none."""
    listed = 0
    is_there: Node | None = None
    """A condition: the primitive exists. ``None``, as nothing else is drawn."""

    def __init__(self, shader: Shader, expansion: Expansion) -> None:
        inputs = CornerInputs(shader, expansion.corners, expansion.span)
        self._inputs = inputs
        self.at_corner = inputs.at_corner
        self.number = inputs.number
        self.vertex = listed_vertex(shader.graph, expansion.listed)
        """The number of a vertex among all that its primitive turns into."""

    @property
    def attributes(self) -> tuple[AttributeInfo, ...]:
        """The vertex inputs that are read."""
        return self._inputs.attributes


class CellCorners:
    """The corners of the cells into which patches are divided, which are triangles or lines.

    A patch is an instance of the draw, and has all that its cells turn into, one after the other.
    """

    def __init__(self, shader: Shader, patches: Tessellation, expansion: Expansion) -> None:
        self._graph = shader.graph
        self._names = shader.notes.names
        self._patches = patches
        self._vertices = PatchVertices(shader, patches)
        self._places: dict[Node, Node] = {}
        levels = levels_of(shader)
        self._cell: Node | None = None
        """The number of the cell, where each vertex finds out itself where it lies."""
        self.levels: tuple[Result, ...] = ()
        """The tessellation levels that the host computes, if all patches are divided alike."""
        self.listed = 0
        """The number of vertices that a patch is drawn with, where no host divides it."""
        each = expansion.listed
        if shader.pattern is None:
            self.levels = levels
            index = self._graph.node("input", UINT, (), VERTEX_INDEX)
            own = self._call(UINT, "mod", index, build.constant(self._graph, UINT, each))
            self.vertex = self._call(INT, "to_int", own)
            """The number of a vertex among all that its cell turns into."""
        else:
            self.listed = each * most_cells(patches, levels)
            index = listed_vertex(self._graph, self.listed)
            self._cell = self._call(INT, "div", index, self._number(each))
            self.vertex = self._call(INT, "mod", index, self._number(each))

    @property
    def attributes(self) -> tuple[AttributeInfo, ...]:
        """The vertex inputs that are read."""
        return self._vertices.attributes

    @property
    def is_there(self) -> Node | None:
        """A condition: the patch has the cell. ``None`` if there is no other in the draw."""
        return None if self._cell is None else self._vertices.is_there(self._vertex_at(0))

    def at_corner(self, value: Node, number: Node) -> Node:
        """A value of the patch's vertices at one corner of the cell."""
        return self._vertices.at(value, self._place(number))

    def _place(self, number: Node) -> Node:
        """The coordinates of a corner in the patch."""
        if number.op == "constant" and isinstance(number.data, int):
            return self._known_place(number.data)
        if number not in self._places:
            found = [*map(self._known_place, range(self._patches.kind.cell))]
            place = self._places[number] = at_number(self._graph, self._names, found, number)
            self._names.setdefault(place.id, self._patches.kind.coordinate.name)
        return self._places[number]

    def _known_place(self, corner: int) -> Node:
        if self._cell is None:
            return self._vertices.given_place(corner)
        return self._vertices.place(self._vertex_at(corner))

    def _vertex_at(self, corner: int) -> Node:
        """The number of a corner among the vertices of the patch."""
        assert self._cell is not None
        first = self._call(INT, "mul", self._cell, self._number(self._patches.kind.cell))
        return self._call(INT, "add", first, self._number(corner)) if corner else first

    def _number(self, value: int) -> Node:
        return build.constant(self._graph, INT, value)

    def _call(self, type_: Type, name: str, *operands: Node) -> Node:
        return self._graph.node("call", type_, operands, name)


Corners = MeshCorners | CellCorners
