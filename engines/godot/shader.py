"""Writes a material as a shader of Godot: ``engine.py`` has ``shader`` in its row."""

from __future__ import annotations

from collections.abc import Iterator

from ...targets.emit.wrapping import wrapped
from ..drawing import adds, culled, multiplies
from ..surface import Surface
from ..writer import Writer
from .uniforms import sampler, uniform
from .values import TABLES

CULLED = {"none": "cull_disabled", "back": "cull_back", "front": "cull_front"}
"""The modes of faces that are not drawn."""


def shader(surface: Surface) -> str:
    """The text of a shader. Raises ``UnfitError``."""
    writer = Writer(surface, TABLES)
    parts = [part.text for part in writer.parts()]
    # A uniform may have the name of an argument, if it is declared behind the functions.
    blocks = [
        "\n".join(_header(surface, writer)),
        *parts,
        "\n".join(_uniforms(writer)),
        "\n".join(_varyings(writer)),
        _function("vertex", writer.vertices),
        _function("fragment", writer.pixels),
    ]
    return "\n\n".join(block.strip("\n") for block in blocks if block) + "\n"


def _header(surface: Surface, writer: Writer) -> Iterator[str]:
    yield f"// {surface.name}, for Godot 4: by Burnish."
    for line in surface.document.doc.splitlines():
        yield f"// {line}".rstrip()
    for name, place in writer.own_inputs.items():
        yield f"// The mesh has `{name}` in {place}."
    yield ""
    yield "shader_type spatial;"
    modes = list(_modes(surface))
    if modes:
        yield f"render_mode {', '.join(modes)};"


def _modes(surface: Surface) -> Iterator[str]:
    if not surface.is_lit:
        yield "unshaded"
    if adds(surface.document):
        yield "blend_add"
    if multiplies(surface.document):
        yield "blend_mul"
    cull = culled(surface.document)
    if cull is not None:
        yield CULLED[cull]
    elif "clip_position" in surface.inputs:  # What covers the screen has no sides.
        yield CULLED["none"]


def _uniforms(writer: Writer) -> Iterator[str]:
    for name, row in writer.parameters.items():
        yield from uniform(name, row)
    for name, texture in writer.textures.items():
        yield from sampler(name, texture)


def _varyings(writer: Writer) -> Iterator[str]:
    for row in writer.between.values():
        flat = "flat " if row.is_flat else ""
        yield f"varying {flat}{row.type} {row.name};"


def _function(name: str, statements: list[str]) -> str:
    if not statements:
        return ""
    lines = [f"void {name}() {{", *(f"    {line}" for line in statements), "}"]
    return wrapped("\n".join(lines))[0]
