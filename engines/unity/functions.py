"""Writes a material as a file for Custom Function nodes: ``engine.py`` has it in its row.

A node calls a function without a result, whose last argument is an output. Its textures come with
their samplers, as structures of Unity.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...targets.emit.functions import EmittedArgument
from ...targets.emit.wrapping import wrapped
from ..surface import Given, Surface, UnfitError
from ..texts import argument_lines, guard, heading

UNPROVEN = "Never compiled by Unity's own compiler."
STRUCTURES = {
    "2d": "UnityTexture2D", "2d_array": "UnityTexture2DArray", "3d": "UnityTexture3D",
    "cube": "UnityTextureCube",
}  # fmt: skip
"""What Unity has for a texture and its sampler."""

NODES: Mapping[tuple[str, str], str] = {
    ("surface", "uv"): "the node UV",
    ("surface", "position"): "the node Position, in the space World",
    ("surface", "normal"): "the node Normal Vector, in the space World",
    ("surface", "tangent"): "the node Tangent Vector, in the space World",
    ("attribute", "vertex_position"): "the node Position, in the space Object",
    ("attribute", "vertex_normal"): "the node Normal Vector, in the space Object",
    ("attribute", "vertex_uv"): "the node UV",
    ("attribute", "vertex_uv2"): "the node UV, of the channel UV1",
    ("attribute", "vertex_color"): "the node Vertex Color",
    ("pipeline", "front_facing"): "the node Is Front Face",
    ("role", "object_to_world"): "the node Transformation Matrix, Model",
    ("role", "eye"): "the node Camera, its output Position",
}
"""Where a graph has the values that functions take."""


def functions(surface: Surface) -> str:
    """The text of a file. Raises ``UnfitError``."""
    called = [each for each in surface.all if not surface.is_parameter(each)]
    macro = f"{surface.name.upper()}_OF_BURNISH"
    parts = [part.text.strip("\n") for part in surface.parts(called)]
    nodes = ["\n".join(_node(surface, given)) for given in called]
    return guard(macro, [heading(surface, "Unity", UNPROVEN), *parts, *nodes])


def _node(surface: Surface, given: Given) -> Iterator[str]:
    """The function that a node calls, named ``<name>_float`` for its precision."""
    signature = given.signature
    name = "".join(word.capitalize() for word in signature.part.name.split("_"))
    yield f"// The node's name is {name}, and its precision Single."
    yield from argument_lines(surface, given, NODES)
    arguments = [_argument(surface, each) for each in signature.arguments if each.kind != "sampler"]
    output = f"out {signature.returns} {given.slot}_out"
    head = f"void {name}_float({', '.join([*arguments, output])}) {{"
    values = ", ".join(map(_value, signature.arguments))
    body = f"    {given.slot}_out = {signature.part.name}({values});"
    yield from wrapped("\n".join([head, body, "}"]))[0].split("\n")


def _argument(surface: Surface, argument: EmittedArgument) -> str:
    if argument.kind == "value":
        given = surface.arguments[argument.given]
        if "[" in given.representation:
            raise UnfitError(given.name, f"it is a {given.type}, and nodes of Unity take no arrays")
        return f"{argument.type} {argument.name}"
    row = surface.textures[argument.given]
    if row.dimension not in STRUCTURES or row.sample != "float":
        raise UnfitError(row.name, f"it is a {row.type}, and Unity has no such node")
    return f"{STRUCTURES[row.dimension]} {argument.name}"


def _value(argument: EmittedArgument) -> str:
    if argument.kind == "value":
        return argument.name
    if argument.kind == "texture":
        return f"{argument.name}.tex"
    return f"{argument.name.removesuffix('_sampler')}.samplerstate"
