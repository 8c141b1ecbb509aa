"""Displacements of a document as equations of the mixin ``Displaced``.

What moves a surface is computed at its vertices, and around each pixel for the normal. So it reads
the mesh as it was before, textures at their largest level, and nothing that only pixels have.
"""

from __future__ import annotations

from collections.abc import Iterator
from functools import cache
from types import MappingProxyType

from ..compiler.syntax import ast
from .expressions import Call, Expression, Name, Number, binary
from .leaves import network as network_of
from .library_files import declarations
from .members import Members
from .model import Definition, Node, Port
from .networks import Network
from .places import Function, Scope
from .problems import UnsupportedError
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


def displaced(members: Members, found: tuple[Node, Scope]) -> Equation:
    """The equation of a node that moves a surface."""
    network = network_of(_OfMesh(members))
    with network.counted():
        _moved(network, *found, members)
    is_vector, value = _moved(network, *found, members)
    return Equation(_ANYWHERE if is_vector else _ALONG_NORMAL, value)


def _moved(network: Network, node: Node, scope: Scope, members: Members) -> tuple[bool, Expression]:
    """True if a node moves a surface by a vector, and how far. What the surface is made of, too, is
    written once."""
    if node.category == "displacement":
        is_vector = node.inputs.get("displacement") is not None and (
            node.inputs["displacement"].type == "vector3"
        )
        value, scale = (network.input(node, name, scope) for name in ("displacement", "scale"))
        value = members.shared(value)
        return is_vector, value if scale == Number(1.0) else binary("*", value, scale)
    if node.category == "dot":
        return _side(network, node, "in", scope, members)
    if node.category == "mix":
        return _mixed(network, node, scope, members)
    raise UnsupportedError(f"{node.category} is no displacement that Burnish draws", node.path)


def _mixed(network: Network, node: Node, scope: Scope, members: Members) -> tuple[bool, Expression]:
    sides = [_side(network, node, name, scope, members) for name in ("bg", "fg")]
    is_vector = any(vector for vector, _ in sides)
    back, front = (
        value if vector or not is_vector else Call("vec3", (Number(0.0), Number(0.0), value))
        for vector, value in sides
    )
    return is_vector, Call("mix", (back, front, network.input(node, "mix", scope)))


def _side(
    network: Network, node: Node, name: str, scope: Scope, members: Members
) -> tuple[bool, Expression]:
    port = node.inputs.get(name)
    found = root(network, port, scope) if port is not None else None
    return (False, Number(0.0)) if found is None else _moved(network, *found, members)


class _OfMesh:
    """The ``Texts`` of a displacement: those of a material, but for what would depend on it."""

    def __init__(self, members: Members) -> None:
        self._members = members
        self.parameter = members.parameter
        self.texture = members.texture
        self.structures = members.structures
        self.tiles = members.tiles
        self.text = members.text
        self.attribute = members.attribute
        self.part = members.part

    def surface(self, slot: str) -> Expression:
        if slot in _OF_VIEW:
            raise UnsupportedError("a displacement cannot depend on where the viewer is")
        return Name(_OF_MESH.get(slot, slot))

    def function(self, definition: Definition) -> Function | None:
        """A function that reads only its arguments; all others are written out."""
        if any(port.type == "filename" for port in definition.inputs.values()):
            return None
        if any(category in _OF_PIXELS for category in _categories(definition)):
            return None
        found = self._members.function(definition)
        return None if found is None or found.sees_surface else found

    def library(self, name: str) -> str:
        if name in _OF_PIXELS:
            raise UnsupportedError("a displacement cannot compare a pixel with those beside it")
        return self._members.library(_AT_VERTICES.get(name, name))

    def read(self, texture: str, place: Expression) -> Expression:
        return Call(f"{texture}.level", (place, Number(0.0)))


def _categories(definition: Definition, around: frozenset[str] = frozenset()) -> Iterator[str]:
    """The categories of all nodes that a definition stands for."""
    if definition.graph is None or definition.name in around:
        return
    for node in definition.graph.nodes.values():
        yield node.category
        if node.definition is not None:
            yield from _categories(node.definition, around | {definition.name})
