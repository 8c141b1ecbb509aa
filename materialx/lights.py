"""The lights of a document as a rig."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from types import MappingProxyType
from typing import NamedTuple

from .definitions import Functions
from .expressions import Call, Expression
from .leaves import network as network_of
from .leaves.catalogue import module_of
from .members import Members
from .model import Graph, Node
from .names import slot_name
from .places import Scope
from .problems import UnsupportedError
from .texts import Equation, File, equations

RIG = "DocumentLights"


class _Kind(NamedTuple):
    """A light of ``std.mtlx.lights``, and its equations by the inputs of the nodes."""

    name: str
    inputs: Mapping[str, str]


_SHARED = {"color": "diffuse_color", "intensity": "intensity"}
_POINT = {"position": "place", **_SHARED, "decay_rate": "decay_rate"}
_KINDS = MappingProxyType({
    "directional_light": _Kind("DirectionalLight", {"direction": "direction", **_SHARED}),
    "point_light": _Kind("PointLight", _POINT),
    "spot_light": _Kind("SpotLight", {
        **_POINT, "direction": "axis", "inner_angle": "inner_angle", "outer_angle": "outer_angle",
    }),
})  # fmt: skip


def lights_of(top: Graph) -> list[Node]:
    """The nodes of a document that shine."""
    return [node for node in top.nodes.values() if node.type == "lightshader"]


def rig_of(
    nodes: list[Node], top: Graph, file: File, functions: Functions
) -> Iterator[UnsupportedError]:
    """Write the rig with these lights to a file; yields those that are left out, and why."""
    rows = []
    for node in nodes:
        try:
            rows.append(_light(node, Scope(top), file, functions))
        except UnsupportedError as error:
            error.path = error.path or node.path
            yield error
    if rows:
        name = file.names.fresh(RIG)
        lines = "\n".join(rows)
        file.declarations.append(f"/// The lights of the document.\nrig {name} {{\n{lines}\n}}")


def _light(node: Node, scope: Scope, file: File, functions: Functions) -> str:
    """The lines of a light in a rig."""
    if node.category not in _KINDS:
        raise UnsupportedError(f"{node.category} is no light of Burnish: it is left out")
    kind = _KINDS[node.category]
    members = Members(file, functions, ())
    network = network_of(members)
    values = {
        slot: network.input(node, name, scope)
        for name, slot in kind.inputs.items()
        if name in node.inputs
    }
    if members.lines():
        raise UnsupportedError("a light has only constants here: it is left out")
    file.imported(module_of(kind.name), kind.name)
    head = f"    {slot_name(node.name)} : {kind.name} {{"
    rows = equations([Equation(slot, _unit(slot, value)) for slot, value in values.items()])
    lines = [f"    {row}" for row in rows]
    return "\n".join([head, *lines, "    }"]) if rows else f"{head}}}"


def _unit(slot: str, value: Expression) -> Expression:
    """A direction of length one."""
    return Call("normalize", (value,)) if slot in ("direction", "axis") else value
