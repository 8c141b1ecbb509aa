"""Surfaces of MaterialX as the colour and the coverage of a material.

A surface is made of closures, which are asked once for each light, for the light from everywhere,
and for what passes. So the closures become a term with this question as its argument.
"""

from __future__ import annotations

from typing import NamedTuple

from .expressions import Binary, Call, Expression, Member, Name, Number, binary, laid_out
from .leaves import network as network_of
from .links import output_of
from .members import Members, MembersTexts
from .model import Node, Port
from .networks import Network
from .places import Scope
from .problems import UnsupportedError
from .texts import Equation, equations
from .unknown_nodes import no_definition

_ASKED = Name("asked")


class Shown(NamedTuple):
    """What a surface looks like: its colour, already times its opacity, and its opacity."""

    color: Expression
    alpha: Expression | None = None


def root(
    network: Network, port: Port, scope: Scope, enter: bool = True
) -> tuple[Node, Scope] | None:
    """The node that a surface comes from; graphs on the way are entered.

    With ``enter`` false, a node that stands for a graph is not entered. Nothing if the input is not
    connected.
    """
    seen: set[tuple[Scope, int]] = set()
    while True:
        if (scope, id(port)) in seen:
            raise UnsupportedError("this surface depends on itself", scope.graph.path)
        seen.add((scope, id(port)))
        if port.interface:
            if scope.node is None or scope.outer is None:
                inner = scope.graph.inputs.get(port.interface)
                if inner is None or scope.outer is None:
                    return None
                port, scope = inner, scope.outer
                continue
            found = scope.node.inputs.get(port.interface)
            if found is None:
                return None
            port, scope = found, scope.outer
            continue
        link = port.link
        if link is None:
            return None
        if link.graph:
            scope = network.group(link.graph, scope)
            port = output_of(scope.graph, link.output)
            continue
        node = scope.graph.nodes.get(link.node)
        if node is None:
            raise UnsupportedError(f"there is no node '{link.node}'")
        if node.category == "dot" and "in" in node.inputs:
            port = node.inputs["in"]
            continue
        if not enter or node.definition is None or node.definition.graph is None:
            return node, scope
        scope = network.entered(node, scope)
        port = output_of(scope.graph, node.output(link.output))


def surface_root(
    network: Network, port: Port, scope: Scope, enter: bool = True
) -> tuple[Node, Scope] | None:
    """The surface that something drawn comes from: that of a material is an input of its node."""
    found = material_root(network, port, scope, enter)
    if found is None or found[0].category != "surfacematerial":
        return found
    node, place = found
    below = node.inputs.get("surfaceshader")
    surface = root(network, below, place, enter) if below is not None else None
    if surface is not None and surface[0] == node:
        raise UnsupportedError("this material depends on itself", node.path)
    return surface


def material_root(
    network: Network, port: Port, scope: Scope, enter: bool = True
) -> tuple[Node, Scope] | None:
    """The node that a material comes from: definitions whose graphs have one are entered. Of what
    is no material, the node itself."""
    found = root(network, port, scope, enter)
    seen: set[tuple[Scope, str]] = set()
    while found is not None and found[0].type == "material":
        node, place = found
        if (place, node.name) in seen:
            raise UnsupportedError("this material depends on itself", node.path)
        seen.add((place, node.name))
        is_graph = node.definition is not None and node.definition.graph is not None
        if node.category == "surfacematerial" or not is_graph:
            return found
        inner = network.entered(node, place)
        found = root(network, next(iter(inner.graph.outputs.values())), inner, enter)
    return found


def shown(members: Members, network: Network, node: Node, scope: Scope, name: str) -> Shown:
    """The colour and coverage of a surface; its closures become terms that begin with ``name``."""
    rows = {"surface": _closures, "surface_unlit": _unlit}
    if node.definition is None:
        raise UnsupportedError(no_definition(node), node.path)
    if node.category not in rows:
        raise UnsupportedError(f"{node.category} is no surface that Burnish draws", node.path)
    return rows[node.category](members, network, node, scope, name)


def _closures(members: Members, network: Network, node: Node, scope: Scope, name: str) -> Shown:
    with network.counted():
        for word in ("edf", "opacity"):
            if is_connected(node, word):
                network.input(node, word, scope)
    sums: list[Expression] = []
    if is_connected(node, "bsdf"):
        sums += _lit(members, network, node, scope, name)
    if is_connected(node, "edf"):
        sums.append(network.input(node, "edf", scope))
    color: Expression = sums[0] if sums else Call("vec3", (Number(0.0),))
    for other in sums[1:]:
        color = Binary("+", color, other)
    opacity = network.input(node, "opacity", scope)
    if opacity == Number(1.0):
        return Shown(color)
    return Shown(Binary("*", opacity, color), opacity)


def is_connected(node: Node, name: str) -> bool:
    """True if an input comes from a node or from an input of the graph."""
    port = node.inputs.get(name)
    return port is not None and (port.link is not None or bool(port.interface))


def _lit(
    members: Members, network: Network, node: Node, scope: Scope, name: str
) -> list[Expression]:
    """The terms of closures, and their sum over all questions."""
    file = members.file
    term = file.names.fresh(f"{name}_bsdf")
    closures = network_of(_Parts(members), _ASKED, network)
    with closures.counted():
        closures.input(node, "bsdf", scope)
    value = closures.input(node, "bsdf", scope)
    file.imported("std.mtlx.asking", "Asked")
    parts = closures.texts
    assert isinstance(parts, _Parts)
    if parts.rows and value == Name(parts.rows[-1].name):
        value = parts.rows.pop().value or value
    head = f"term {term}(asked: Asked) ="
    lines = [
        "/// What the surface scatters, by what is asked.",
        f"{head} {laid_out(value, len(head) + 1, 0)}",
    ]
    if parts.rows:
        lines += ["where {", *equations(parts.rows), "}"]
    file.declarations.append("\n".join(lines))
    lit = file.names.fresh(f"{name}_lit")
    by_light = file.imported("std.mtlx.asking", "by_light")
    head = f"term {lit}() per light ="
    of_light = Call(by_light, (Name("light.to_light"), Name("to_eye")))
    scattered = Member(Call(term, (of_light,)), "response")
    light = laid_out(Binary("*", Name("pi * light.diffuse"), scattered), len(head) + 1, 0)
    file.declarations.append(f"/// The light of the rig that it scatters.\n{head} {light}")
    questions = ["from_everywhere", *(["passing"] if closures.transmits else [])]
    sums: list[Expression] = [Call(lit, ())]
    for question in questions:
        asked = Call(
            file.imported("std.mtlx.asking", question), (Name("to_eye"), Name("ambient_light"))
        )
        sums.append(Member(Call(term, (asked,)), "response"))
    return sums


class _Parts(MembersTexts):
    """The ``Texts`` of closures: parts behind ``where``; all else is the material's."""

    def __init__(self, members: Members) -> None:
        super().__init__(members)
        self.rows: list[Equation] = []

    def part(self, name: str, value: Expression, node: Node) -> Expression:
        found = super().part(name, value, node)
        # The same counter gives names to slots and to these parts, which would hide slots.
        self.rows.append(self._members.slots.pop())
        return found


def _unlit(_members: Members, network: Network, node: Node, scope: Scope, _name: str) -> Shown:
    emission, color, opacity, passing, tint = (
        network.input(node, word, scope)
        for word in ("emission", "emission_color", "opacity", "transmission", "transmission_color")
    )
    shown = color if emission == Number(1.0) else binary("*", emission, color)
    if opacity != Number(1.0):
        shown = binary("*", opacity, shown)
    alpha: Expression | None = None if opacity == Number(1.0) else opacity
    if passing != Number(0.0):
        through = Call(
            "dot",
            (binary("*", passing, tint), Call("vec3", (Binary("/", Name("1.0"), Number(3.0)),))),
        )
        alpha = binary("*", opacity, Binary("-", Number(1.0), through))
    return Shown(shown, alpha)
