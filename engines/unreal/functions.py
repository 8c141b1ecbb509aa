"""Writes a material as a file that Custom nodes include: ``engine.py`` has it in its row.

A node's inputs are its arguments. A texture input called ``X`` brings ``XSampler`` along.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...targets.emit.functions import EmittedArgument
from ..surface import Given, Surface, UnfitError
from ..texts import argument_lines, guard, heading

NODES: Mapping[tuple[str, str], str] = {
    ("surface", "uv"): "TexCoord",
    ("surface", "position"): "Absolute World Position",
    ("surface", "normal"): "VertexNormalWS",
    ("surface", "tangent"): "VertexTangentWS",
    ("attribute", "vertex_uv"): "TexCoord",
    ("attribute", "vertex_uv2"): "TexCoord, of the index 1",
    ("attribute", "vertex_color"): "Vertex Color",
    ("pipeline", "front_facing"): "TwoSidedSign, greater than 0",
    ("role", "eye"): "Camera Position",
}
"""Where a material has the values that functions take."""
UNPROVEN = "Never compiled by Unreal's own compiler."
DIMENSIONS = ("2d", "2d_array", "3d", "cube")


def functions(surface: Surface) -> str:
    """The text of a file. Raises ``UnfitError``."""
    called = [each for each in surface.all if not surface.is_parameter(each)]
    macro = f"{surface.name.upper()}_OF_BURNISH"
    parts = [part.text.strip("\n") for part in surface.parts(called)]
    nodes = ["\n".join(_node(surface, given)) for given in called]
    return guard(macro, [heading(surface, "Unreal Engine", UNPROVEN), *nodes, *parts])


def _node(surface: Surface, given: Given) -> Iterator[str]:
    """How a Custom node calls a function."""
    for row in (surface.textures[name] for name in given.row.textures):
        if row.dimension not in DIMENSIONS or row.sample != "float":
            raise UnfitError(row.name, f"it is a {row.type}, and no input of a node is one")
    for argument in given.signature.arguments:
        if argument.kind == "value" and "[" in surface.arguments[argument.given].representation:
            told = surface.arguments[argument.given]
            raise UnfitError(told.name, f"it is a {told.type}, and nodes of Unreal take no arrays")
    values = ", ".join(map(_value, given.signature.arguments))
    yield f"// {given.slot}, of the type {given.signature.returns}. The code of the Custom node:"
    yield f"//     return {given.signature.part.name}({values});"
    yield from argument_lines(surface, given, NODES)


def _value(argument: EmittedArgument) -> str:
    """An argument; the editor names samplers."""
    if argument.kind == "sampler":
        return f"{argument.name.removesuffix('_sampler')}Sampler"
    return argument.name
