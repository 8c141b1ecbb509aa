"""Functions for the nodes of an engine's graph: what ``unity`` and ``unreal`` have in common.

A user connects nodes to a function by hand. The engine's coordinates are not those of Burnish, so
each function gets a wrapper. It takes and returns what nodes have, and turns it.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Mapping

from ..compiler.documents.functions import ArgumentRow
from ..compiler.reflection.roles import scene_names
from ..support.frozen import EMPTY, frozen
from ..support.unique import Names
from ..targets.emit.functions import EmittedArgument
from .slot_table import misfit
from .surface import Given, Surface, UnfitError
from .texts import guard, heading, usual
from .values import Place

KEPT = ("tangent", "clip", "camera")
"""The spaces whose coordinates are the same in engines, as far as they have them."""
SPACED = re.compile(r"(\w+)<([^>]*)>")
"""A type with its kind and its spaces: ``point<world>``, ``transform<object, world>``."""
WHOLE = re.compile(r"^u?int")
"""What types of whole numbers begin with, which no node hands on."""
TANGENT = "vertex_tangent"
"""The vertex input of four lanes whose last one says on which side the bitangent is."""

Turned = tuple[str, str]
"""How a value ``{0}`` is turned from the engine's coordinates, and back to them."""


@frozen(kw_only=True)
class Graph:
    """What an engine's graph has for functions, and in which coordinates."""

    title: str
    product: str
    """The engine's name in the heading of a file: ``Unreal Engine``."""
    told: str
    """A comment about the engine's coordinates, and the functions that turn them."""
    nodes: Mapping[Place, str]
    """Where a graph has the values that functions take, by their source or role."""
    outputs: Mapping[str, str]
    """Where a graph takes a value, by the row of the table of all engines."""
    turned: Mapping[str, Turned]
    """By the kind of a type, such as ``point``; ``tangent`` is a tangent with its sign."""
    lanes: tuple[tuple[int, int], ...]
    """By lane of the engine: the lane of Burnish that it is, and its sign."""
    metre: float
    """The length of a metre."""
    data: str
    """What a user sets of a texture that holds no colours."""
    interpolated: str
    """How a graph hands a value from vertices to pixels."""
    parts: Mapping[str, tuple[tuple[str, str], ...]]
    """By role: the names and nodes of the values of which a matrix is made, for their lanes."""
    joined: Mapping[str, str]
    """By role: how the matrix is made of these, ``{x}``, and of the matrix of nodes, ``{0}``."""
    has_matrices: bool
    ports: Mapping[Place, tuple[str, str]] = EMPTY
    """The types of nodes' values that are others than the functions take, and what is made of them.
    """


@frozen
class Port:
    """An input of a node."""

    type: str
    name: str
    told: str


def file_text(
    graph: Graph, surface: Surface, remark: str, node: Callable[[Surface, Given], Iterable[str]]
) -> str:
    """The text of a file: all functions, then what ``node`` writes for each.

    Raises ``UnfitError``.
    """
    called = surface.computed
    parts = [part.text.strip("\n") for part in surface.parts(called)]
    nodes = ["\n".join(node(surface, given)) for given in called]
    properties = filter(None, ["\n".join(property_lines(graph, surface))])
    told = [graph.told] if any("burnish_" in each for each in nodes) else []
    blocks = [heading(surface, graph.product, remark), *told, *parts, *nodes, *properties]
    return guard(f"{surface.name.upper()}_OF_BURNISH", blocks)


def node_name(surface: Surface, given: Given) -> str:
    """The name of the function that a node calls, which no other one of the file has."""
    taken = Names(())
    names = {}
    for each in surface.computed:
        words = each.signature.part.name.split("_")
        names[each.row.name] = taken.new("".join(word.capitalize() for word in words))
    return names[given.row.name]


def nodes_of(
    graph: Graph,
    surface: Surface,
    given: Given,
    of_texture: Callable[[EmittedArgument, str], str],
    names: Names,
) -> tuple[list[Port], str]:
    """The inputs of a node but textures, and the call of the function with all of them.

    ``of_texture`` says what stands for a texture or a sampler, by the texture's name. ``names`` has
    those of textures, and gets those of inputs. Raises ``UnfitError``.
    """
    ports, values = list[Port](), []
    for argument in given.signature.arguments:
        if argument.kind == "value":
            row = surface.arguments[argument.given]
            own, value = _of_value(graph, given, argument, row, names)
            ports += own
            values.append(value)
        else:
            values.append(of_texture(argument, texture_name(given, argument)))
    type_ = given.row.slots[0].type
    call = f"{given.signature.part.name}({', '.join(values)})"
    return ports, _turned(graph, type_, call, back=True)


def texture_name(given: Given, argument: EmittedArgument) -> str:
    """The name in the text of a texture, or of that to which a sampler belongs."""
    arguments = given.signature.arguments
    return next(
        each.name for each in arguments if each.kind == "texture" and each.given == argument.given
    )


def result_lines(graph: Graph, surface: Surface, given: Given) -> Iterator[str]:
    """A comment that says where a result goes to, if that is known."""
    for word, each in surface.inputs.items():
        is_one = not misfit(word, given.row.slots[0])
        if each is given and word in graph.outputs and is_one:
            yield f"// Its result goes to {graph.outputs[word]}."


def property_lines(graph: Graph, surface: Surface) -> Iterator[str]:
    """A comment for each property that goes where a result would, as nothing is computed of it."""
    for word, each in surface.inputs.items():
        if surface.is_parameter(each) and word in graph.outputs:
            (argument,) = each.signature.arguments
            row = surface.arguments[argument.given]
            yield f"// {argument.name}: {_told(graph, row)}.".replace("\n", " ")
            yield f"// It goes to {graph.outputs[word]}."


def port_lines(graph: Graph, surface: Surface, given: Given, ports: list[Port]) -> Iterator[str]:
    """A comment for each input of a node, and for each texture."""
    for port in ports:
        yield f"//   {port.name}: {port.told}".replace("\n", " ")
    for argument in given.signature.arguments:
        if argument.kind == "texture":
            row = surface.textures[argument.given]
            encoding = "sRGB" if row.intent == "color" else graph.data
            yield f"//   {argument.name}: a texture, usually {row.default}, {encoding}"


def node_type(type_: str) -> str:
    """The type of an input or a result: nodes have no whole numbers."""
    return WHOLE.sub("float", type_)


def _of_value(
    graph: Graph, given: Given, argument: EmittedArgument, row: ArgumentRow, names: Names
) -> tuple[list[Port], str]:
    """The inputs for one argument, and what is made of them. Raises ``UnfitError``."""
    _check(graph, given, row)
    name = names.new(argument.name)
    role = row.role or ""
    if role in graph.parts:
        parts = {part: names.new(f"{name}_{part}") for part, _ in graph.parts[role]}
        ports = [Port("float3", parts[part], told) for part, told in graph.parts[role]]
        if graph.has_matrices:
            ports.insert(0, Port(argument.type, name, graph.nodes["role", role]))
        return ports, graph.joined[role].format(name, **parts)
    type_, form = graph.ports.get((row.source, row.given), (node_type(argument.type), "{0}"))
    value = form.format(name)
    if form == "{0}" and type_ != argument.type:
        value = f"{argument.type}(round({name}))"
    kind = "tangent<>" if row.given == TANGENT else row.type
    return [Port(type_, name, _told(graph, row))], _turned(graph, kind, value)


def _check(graph: Graph, given: Given, row: ArgumentRow) -> None:
    """Raise ``UnfitError`` if no node has an argument."""
    reason = ""
    if "[" in row.representation:
        reason = f"it is a {row.type}, and nodes of {graph.title} take no arrays"
    elif _is_matrix(row) and not graph.has_matrices and (row.role or "") not in graph.parts:
        reason = f"it is a {row.type}, and nodes of {graph.title} take no matrices"
    elif _is_half_turned(row.type):
        reason = f"it is a {row.type}, and only one side of it is turned in {graph.title}"
    if reason:
        raise UnfitError(row.name, reason)
    if row.given.partition(".")[0] in scene_names()["instances"]:
        reason = f"it reads `{row.given}` of each instance, and {graph.title} places instances"
        raise UnfitError(given.slot, f"{reason} itself")
    if row.source == "pipeline" and ("pipeline", row.given) not in graph.nodes:
        raise UnfitError(given.slot, f"it reads `{row.given}`, and no node of {graph.title} has it")


def _is_half_turned(type_: str) -> bool:
    """True of a matrix from coordinates that are the engine's to others that are not, or back."""
    found = SPACED.fullmatch(type_)
    spaces = [] if found is None else [each.strip() for each in found[2].split(",")]
    return len(spaces) == 2 and len(set(spaces) & set(KEPT)) == 1


def _is_matrix(row: ArgumentRow) -> bool:
    return row.representation.startswith("mat")


def _told(graph: Graph, row: ArgumentRow) -> str:
    """Where a user finds an argument."""
    known = graph.nodes.get(("role", row.role or "")) or graph.nodes.get((row.source, row.given))
    if known is not None:
        return known
    if row.source == "varying":
        return f"what `{row.given}` is at the vertices, by {graph.interpolated}"
    if row.source != "parameter":
        return f"`{row.given}` of the mesh, which has it as a further texture coordinate"
    kind = f", one of {', '.join(_members(row))}" if row.choices else f" of the type {row.type}"
    said = "" if row.default is None else f", usually {usual(_in_engine(graph, row))}"
    doc = f" ({row.doc.strip()})" if row.doc else ""
    return f"a property{kind}{said}{doc}"


def _members(row: ArgumentRow) -> list[str]:
    return [f"{number} {choice.name}" for number, choice in enumerate(row.choices or ())]


def _in_engine(graph: Graph, row: ArgumentRow) -> object:
    """The default of a parameter in the engine's coordinates."""
    found, value = SPACED.fullmatch(row.type), row.default
    if found is None or found[2] in KEPT or not isinstance(value, (list, tuple)):
        return value
    factor = {"point": graph.metre, "vector": graph.metre, "direction": 1, "normal": 1}.get(
        found[1]
    )
    if factor is None:
        return value
    lanes = [float(lane) for lane in value if isinstance(lane, (int, float))]
    # A zero is added so that none has a sign.
    return tuple(lanes[lane] * sign * factor + 0.0 for lane, sign in graph.lanes)


def _turned(graph: Graph, type_: str, value: str, *, back: bool = False) -> str:
    """A value of a type with a space, turned; all others as they are."""
    found = SPACED.fullmatch(type_)
    if found is None:
        return value
    kind, spaces = found[1], [each.strip() for each in found[2].split(",")]
    if len(spaces) == 2:
        form = graph.turned.get(kind, ("{0}", "{0}"))
        return value if set(spaces) & set(KEPT) else form[back].format(value)
    if kind not in graph.turned or spaces[0] in KEPT:
        return value
    return graph.turned[kind][back].format(value)
