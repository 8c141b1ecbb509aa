"""The shader of a material: WGSL that Bevy composes with its own modules."""

from __future__ import annotations

from ...support.frozen import frozen
from ..surface import Surface
from ..values import Between
from .statements import Statements, lines_of, uniform_type
from .texts import filled
from .values import FIRST_LOCATION, TYPES

BLOCK = 100
"""The binding of parameters; Bevy's own material has those before."""

IMPORTS = {
    "decal::clustered": "clustered::", "mesh_functions": "mesh_functions::",
    "mesh_view_bindings": "mesh_view_bindings::", "pbr_bindings": "pbr_bindings::",
    "pbr_fragment": "pbr_fragment::", "pbr_functions": "pbr_functions::",
    "pbr_types": "pbr_types::", "skinning": "skinning::",
    "view_transformations": "view_transformations::",
}  # fmt: skip
"""Modules of Bevy's shaders, by what stands before their members."""

TEXTURES = {"float": "f32", "int": "i32", "uint": "u32"}


@frozen
class Binding:
    """A texture or a sampler in the shader."""

    name: str
    type: str
    number: int


@frozen(kw_only=True)
class Shader:
    """Everything that the template prints."""

    name: str
    doc: tuple[str, ...]
    structure: str
    parameters: tuple[tuple[str, str], ...]
    bindings: tuple[Binding, ...]
    functions: tuple[str, ...]
    output: str
    """The structure that vertices hand to pixels."""
    between: tuple[str, ...]
    """Its members beside those of Bevy."""
    inputs: str
    """The parameters of fragment shaders."""
    has_vertices: bool
    has_prepass: bool
    has_alpha: bool
    moves: frozenset[str]
    in_object: tuple[str, ...]
    """Statements of a vertex in the space of its object."""
    in_world: tuple[str, ...]
    """Statements that move it in the world."""
    surface: tuple[str, ...]
    """Statements of a pixel that is lit."""
    depths: tuple[str, ...]
    normals: tuple[str, ...]


def shader_text(surface: Surface, statements: Statements) -> str:
    """The text of the shader."""
    shader = _shader(surface, statements)
    body = filled("shader.wgsl.j2", shader=shader)
    imports = [name for name, used in IMPORTS.items() if used in body]
    return filled("header.wgsl.j2", shader=shader, imports=imports) + body


def bindings(surface: Surface, statements: Statements) -> list[Binding]:
    """Textures and their samplers, in the order of their bindings."""
    samplers = {
        argument.given: argument.name
        for each in surface.all
        for argument in each.signature.arguments
        if argument.kind == "sampler"
    }
    found: list[Binding] = []
    for name, row in statements.textures.items():
        kind = f"texture_{row.dimension}<{TEXTURES[row.sample]}>"
        found.append(Binding(name, kind, BLOCK + 1 + len(found)))
        if row.name in samplers:
            found.append(Binding(samplers[row.name], "sampler", BLOCK + 1 + len(found)))
    return found


def structure(surface: Surface) -> str:
    """The name of the structure of parameters."""
    return f"{surface.name}Parameters"


def _shader(surface: Surface, statements: Statements) -> Shader:
    between = list(statements.between.values())
    members = [_member(number, row) for number, row in enumerate(between)]
    world = [each for each in statements.vertices if each.startswith("world_position = ")]
    before = [each for each in statements.vertices if each not in world]
    inputs = ["pixel: VertexOutput", "@builtin(front_facing) front_facing: bool", *members]
    return Shader(
        name=surface.name,
        doc=tuple(surface.document.doc.splitlines()),
        structure=structure(surface),
        parameters=tuple((name, uniform_type(row)) for name, row in statements.parameters.items()),
        bindings=tuple(bindings(surface, statements)),
        functions=tuple(part.text.strip("\n") for part in statements.parts()),
        output=f"{surface.name}VertexOutput" if between else "VertexOutput",
        between=tuple(members),
        inputs=_inputs(inputs),
        has_vertices=statements.has_vertices,
        has_prepass=statements.has_prepass,
        has_alpha="alpha" in surface.inputs,
        moves=statements.moves,
        in_object=tuple(lines_of(before)),
        in_world=tuple(lines_of(world)),
        surface=tuple(lines_of(statements.pixels)),
        depths=tuple(lines_of(statements.depths)),
        normals=tuple(lines_of(statements.normals)),
    )


def _inputs(inputs: list[str]) -> str:
    """The parameters of a function, each in a line of its own where there are many."""
    if len(inputs) == 2:
        return ", ".join(inputs)
    return "\n    " + ",\n    ".join(inputs) + ",\n"


def _member(number: int, row: Between) -> str:
    flat = "@interpolate(flat) " if row.is_flat else ""
    return f"@location({FIRST_LOCATION + number}) {flat}{row.name}: {TYPES[row.type]}"
