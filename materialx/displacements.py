"""Displacements of a document as equations of the mixin ``Displaced``.

What moves a surface is computed at its vertices, and around each pixel for the normal. So it reads
the mesh as it was before, textures at their largest level, and nothing that only pixels have.
"""

from __future__ import annotations

from functools import cache
from types import MappingProxyType

from ..compiler.syntax import ast
from .expressions import Call, Expression, Name, Number, binary
from .leaves import network as network_of
from .library_files import declarations
from .members import Members, MembersTexts
from .model import Definition, Node, Port
from .names import slot_name
from .networks import Network
from .places import Function, Scope
from .problems import UnsupportedError
from .sides import Key, Place, key, sides_of
from .surfaces import material_root, root
from .texts import Equation

KIND = "displacementshader"
MIXIN, BASE = "Displaced", "DisplacedSurface"
"""What a displaced material names: the mixin beside its model, or the base that has it."""
_ALONG_NORMAL, _ANYWHERE = "displacement", "displacement_vector"
_OF_MESH = MappingProxyType({
    "normal_object": "mesh_normal_object", "normal_world": "mesh_normal_world",
})  # fmt: skip
"""Slots that follow from a displacement, and those that it reads in their place."""
_OF_VIEW = ("view_object", "view_world")
_OF_PIXELS = (
    "bordered", "bordered_nearest", "hextiledimage", "hextilednormalmap", "heighttonormal",
    "filtered_step", "splitlr", "splittb",
)  # fmt: skip
"""Functions of ``std.mtlx`` that compare a pixel with those beside it."""
_AT_VERTICES = MappingProxyType({"udim_set": "udim_set_level"})
"""Such functions, and what vertices have in their place."""


@cache
def displaced_slots() -> frozenset[str]:
    """The names that a displaced material has from the mixin."""
    (mixin,) = (
        each for each in declarations("mtlx/displacement.burnish") if each.name.text == MIXIN
    )
    assert isinstance(mixin, ast.Mixin)
    return frozenset(each.name.text for each in mixin.members if hasattr(each, "name"))


def displacement(network: Network, port: Port, scope: Scope) -> tuple[Node, Scope] | None:
    """The node that moves what is drawn; nothing if none does."""
    if port.type == KIND:
        return root(network, port, scope)
    found = material_root(network, port, scope) if port.type == "material" else None
    moving = found[0].inputs.get(KIND) if found is not None else None
    return root(network, moving, found[1]) if found is not None and moving is not None else None


def displaced(members: Members, found: Place) -> Equation:
    """The equation of a node that moves a surface."""
    is_vector, value = _Movement(members, found).written()
    return Equation(_ANYWHERE if is_vector else _ALONG_NORMAL, value)


Moved = tuple[bool, Expression]
"""True if a node moves a surface by a vector, and how far."""


class _Movement:
    """Writes what moves a surface. What the surface is made of, too, is written once."""

    def __init__(self, members: Members, start: Place) -> None:
        self._members, self._start = members, start
        self._network = network_of(_OfMesh(members))
        self._sides = sides_of(start, self._below)
        self._known: dict[Key, Moved] = {}

    def written(self) -> Moved:
        """The value of the node that moves all."""
        with self._network.counted():
            for place in self._sides.places:
                self._count(*place)
        return self._moved(self._start)

    def _below(self, node: Node, scope: Scope) -> list[Place | None]:
        """The nodes that a mix or a dot is made of."""
        names = {"dot": ("in",), "mix": ("bg", "fg")}.get(node.category, ())
        ports = [node.inputs.get(name) for name in names]
        return [None if port is None else root(self._network, port, scope) for port in ports]

    def _count(self, node: Node, scope: Scope) -> None:
        """Ask for all values that a node reads, so that those of two are slots."""
        names = {"displacement": ("displacement", "scale"), "mix": ("mix",)}.get(node.category, ())
        for name in names:
            self._network.input(node, name, scope)

    def _moved(self, place: Place | None) -> Moved:
        if place is None:
            return False, Number(0.0)
        if key(place) not in self._known:
            is_vector, value = self._of(*place)
            if self._sides.is_shared(place):
                node, _ = place
                value = self._members.part(slot_name(node.name), value, node)
            self._known[key(place)] = is_vector, value
        return self._known[key(place)]

    def _of(self, node: Node, scope: Scope) -> Moved:
        if node.category == "displacement":
            port = node.inputs.get("displacement")
            value, scale = (
                self._network.input(node, name, scope) for name in ("displacement", "scale")
            )
            value = self._members.shared(value)
            is_vector = port is not None and port.type == "vector3"
            return is_vector, value if scale == Number(1.0) else binary("*", value, scale)
        if node.category == "dot":
            return self._moved(self._below(node, scope)[0])
        if node.category == "mix":
            return self._mixed(node, scope)
        raise UnsupportedError(f"{node.category} is no displacement that Burnish draws", node.path)

    def _mixed(self, node: Node, scope: Scope) -> Moved:
        sides = [self._moved(side) for side in self._below(node, scope)]
        is_vector = any(vector for vector, _ in sides)
        back, front = (
            value if vector or not is_vector else Call("vec3", (Number(0.0), Number(0.0), value))
            for vector, value in sides
        )
        return is_vector, Call("mix", (back, front, self._network.input(node, "mix", scope)))


class _OfMesh(MembersTexts):
    """The ``Texts`` of a displacement: those of a material, but for what would depend on it."""

    def surface(self, slot: str) -> Expression:
        if slot in _OF_VIEW:
            raise UnsupportedError("a displacement cannot depend on where the viewer is")
        return Name(_OF_MESH.get(slot, slot))

    def function(self, definition: Definition) -> Function | None:
        """A function that reads only its arguments; all others are written out."""
        if any(port.type == "filename" for port in definition.inputs.values()):
            return None
        if not _categories(definition).isdisjoint(_OF_PIXELS):
            return None
        found = super().function(definition)
        return None if found is None or found.sees_surface else found

    def library(self, name: str) -> str:
        if name in _OF_PIXELS:
            raise UnsupportedError("a displacement cannot compare a pixel with those beside it")
        return super().library(_AT_VERTICES.get(name, name))

    def read(self, texture: str, place: Expression) -> Expression:
        return Call(f"{texture}.level", (place, Number(0.0)))


def _categories(definition: Definition) -> set[str]:
    """The categories of all nodes that a definition stands for."""
    found: set[str] = set()
    pending, seen = [definition], {definition.name}
    for each in pending:  # The list grows on the way.
        for node in each.graph.nodes.values() if each.graph is not None else ():
            found.add(node.category)
            inner = node.definition
            if inner is not None and inner.name not in seen:
                seen.add(inner.name)
                pending.append(inner)
    return found
