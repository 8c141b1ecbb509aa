"""Writes a material as a material definition of Filament: ``engine.py`` has it in its row."""

from __future__ import annotations

from collections.abc import Iterator

from ...compiler.documents.functions import ArgumentRow, FunctionTextureRow
from ...targets.emit.wrapping import wrapped
from ..drawing import adds, culled, multiplies
from ..surface import Surface, UnfitError
from ..texts import usual
from ..writer import Writer
from .values import FRAME, HELPERS, NORMAL, PREMULTIPLY, PREPARE, REQUIRED, TABLES, VARIABLES

TYPES = {
    **{f"{of}vec{lanes}": f"{kind}{lanes}" for of, kind in
       (("", "float"), ("i", "int"), ("u", "uint"), ("b", "bool")) for lanes in (2, 3, 4)},
    "float": "float", "int": "int", "uint": "uint", "bool": "bool", "mat3": "mat3", "mat4": "mat4",
}  # fmt: skip
"""Filament's words for the types of parameters."""

SAMPLERS = {
    "2d": "sampler2d", "2d_array": "sampler2dArray", "3d": "sampler3d", "cube": "samplerCubemap",
}  # fmt: skip
GLSL_SAMPLERS = {
    "2d": "sampler2D", "2d_array": "sampler2DArray", "3d": "sampler3D", "cube": "samplerCube",
}  # fmt: skip
FORMATS = {"float": "float", "int": "int", "uint": "uint"}

PRECISE = """\
#if defined(TARGET_MOBILE)
precision highp float;
precision highp int;
#endif"""
"""On phones, Filament computes pixels with 16 bits; the functions mean 32."""
USUAL = """\
#if defined(TARGET_MOBILE)
precision mediump float;
precision mediump int;
#endif"""


def definition(surface: Surface) -> str:
    """The text of a definition. Raises ``UnfitError``."""
    writer = Writer(surface, TABLES)
    if len(writer.between) > VARIABLES:
        names = ", ".join(writer.between)
        raise UnfitError(
            surface.name,
            f"it hands {names} from vertices to pixels, and Filament has {VARIABLES} such values",
        )
    blocks = [_header(surface, writer), _material(surface, writer)]
    if writer.vertices:
        functions = [*_helpers(writer), *_functions(writer, "vertex")]
        body = _function("materialVertex(inout MaterialVertexInputs material)", writer.vertices)
        blocks.append(_block("vertex", [*functions, body]))
    functions = _functions(writer, "fragment")
    body = _function("material(inout MaterialInputs material)", _statements(surface, writer))
    precise = [_precise(writer), *functions, USUAL] if functions else []
    blocks.append(_block("fragment", [*precise, body]))
    return "\n".join(blocks) + "\n"


def _precise(writer: Writer) -> str:
    """The precision of what functions compute, and of samplers of integers, which have no usual."""
    whole = [row for row in writer.textures.values() if row.sample != "float"]
    types = dict.fromkeys(f"{row.sample[0]}{GLSL_SAMPLERS[row.dimension]}" for row in whole)
    return "\n".join([PRECISE, *(f"precision highp {type_};" for type_ in types)])


def _header(surface: Surface, writer: Writer) -> str:
    lines = [f"// {surface.name}, for Filament: by Burnish."]
    lines += [f"// {line}".rstrip() for line in surface.document.doc.splitlines()]
    lines += [f"// The mesh has `{name}` in {place}." for name, place in writer.own_inputs.items()]
    return "\n".join(lines) + "\n"


def _material(surface: Surface, writer: Writer) -> str:
    settings = [
        f"name : {_quoted(surface.name)}",
        f"shadingModel : {'lit' if surface.is_lit else 'unlit'}",
    ]
    required = dict.fromkeys(_required(surface, writer))
    if required:
        settings.append(f"requires : [ {', '.join(required)} ]")
    if writer.between:
        settings.append(f"variables : [ {', '.join(writer.between)} ]")
    parameters = [*_parameters(writer)]
    if parameters:
        settings.append("parameters : [\n" + ",\n".join(parameters) + "\n    ]")
    settings.append(f"blending : {_blending(surface)}")
    settings += _sides(surface, writer)
    settings.append("flipUV : false")
    lines = ",\n".join(f"    {setting}" for setting in settings)
    return f"material {{\n{lines}\n}}\n"


def _required(surface: Surface, writer: Writer) -> Iterator[str]:
    """The vertex inputs; a lit surface has a frame of tangents anyway."""
    for text, name in REQUIRED.items():
        if any(text in read for read in writer.reads) and name != "position":
            yield name
    if surface.is_lit and "normal" in surface.inputs:
        yield "tangents"


def _blending(surface: Surface) -> str:
    if adds(surface.document):
        return "add"
    if multiplies(surface.document):
        return "multiply"
    if "alpha" in surface.inputs:
        return "fade"
    return "masked" if "is_hidden" in surface.inputs else "opaque"


def _sides(surface: Surface, writer: Writer) -> Iterator[str]:
    """Which faces are drawn. Where both are, Filament turns the normal to the one that is seen.

    It would turn what the functions read as well, which then have to turn normals themselves.
    """
    cull = culled(surface.document)
    if cull == "none" and surface.is_lit and not any(FRAME in read for read in writer.reads):
        yield "doubleSided : true"
    elif cull is not None:
        yield f"culling : {cull}"


def _parameters(writer: Writer) -> Iterator[str]:
    for name, row in writer.parameters.items():
        yield _parameter(name, row)
    for name, texture in writer.textures.items():
        yield _sampler(name, texture)


def _parameter(name: str, row: ArgumentRow) -> str:
    element, _, count = row.representation.partition("[")
    if element not in TYPES:
        raise UnfitError(row.name, f"it is a {row.type}, and Filament has no such parameters")
    array = f"[{count}" if count else ""
    return f"{_told(row)}        {{ type : {TYPES[element]}{array}, name : {_quoted(name)} }}"


def _told(row: ArgumentRow) -> str:
    """What a host has to know of a parameter, which a definition has no words for."""
    told = [" ".join(row.doc.split())] if row.doc else []
    if row.range is not None:
        told.append(f"from {row.range[0]:g} to {row.range[1]:g}")
    if row.choices is not None:
        told.append(", ".join(f"{place} is {each.name}" for place, each in enumerate(row.choices)))
    if row.default is not None:
        told.append(f"usually {usual(row.default)}")
    return f"        // {_meaning(row)}{'; '.join(told)}\n" if told else ""


def _quoted(name: str) -> str:
    """A name as Filament takes any: without quotes, ``true`` or ``from`` were words."""
    return f'"{name}"'


def _meaning(row: ArgumentRow) -> str:
    """The type as written, where it says more than the one of the machine."""
    return f"{row.type}: " if row.type != row.representation else ""


def _sampler(name: str, row: FunctionTextureRow) -> str:
    if row.dimension not in SAMPLERS or row.sample not in FORMATS:
        raise UnfitError(row.name, f"it is a {row.type}, which Filament lacks")
    # ES has no usual precision of samplers of integers.
    kind = "" if row.sample == "float" else f", format : {FORMATS[row.sample]}, precision : high"
    told = [
        *([" ".join(row.doc.split())] if row.doc else []),
        f"{row.intent}, usually {row.default}",
    ]
    if row.state is not None:
        told.append(f"filter {row.state.filter}, wrap {row.state.wrap}")
    comment = "; ".join(told)
    type_ = SAMPLERS[row.dimension]
    return f"        // {comment}\n        {{ type : {type_}, name : {_quoted(name)}{kind} }}"


def _helpers(writer: Writer) -> list[str]:
    """What vertices compute of values of Filament, for functions or for pixels."""
    return [text for call, text in HELPERS.items() if call in writer.reads]


def _functions(writer: Writer, stage: str) -> list[str]:
    return [part.text.strip("\n") for part in writer.parts(stage)]


def _statements(surface: Surface, writer: Writer) -> list[str]:
    """The statements of a pixel: the normal comes before the material is prepared."""
    first = 1 if NORMAL.input in surface.inputs and surface.is_lit else 0
    last = (PREMULTIPLY,) if _blending(surface) in ("fade", "add") else ()
    return [*writer.pixels[:first], PREPARE, *writer.pixels[first:], *last]


def _function(head: str, statements: list[str]) -> str:
    lines = [f"void {head} {{", *(f"    {line}" for line in statements), "}"]
    return wrapped("\n".join(lines))[0]


def _block(name: str, parts: list[str]) -> str:
    lines = "\n\n".join(part.strip("\n") for part in parts).split("\n")
    inner = "\n".join(line if line.startswith("#") or not line else f"    {line}" for line in lines)
    return f"{name} {{\n{inner}\n}}\n"
