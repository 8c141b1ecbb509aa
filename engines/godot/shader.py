"""Writes a material as a shader of Godot: ``engine.py`` has ``shader`` in its row."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from ..engine import EngineError, Given, Surface
from .uniforms import TYPES, sampler, uniform
from .values import AT_PIXELS, AT_VERTICES, MOVED, OUTPUTS, ROLES, UNLIT, Between, Output

CUSTOM = 4
"""The values of its own that a vertex of Godot can have."""


def shader(surface: Surface) -> str:
    """The text of a shader. Raises ``EngineError``."""
    return _Writer(surface).text()


class _Writer:
    def __init__(self, surface: Surface) -> None:
        self._surface = surface
        self._used: dict[str, Given] = {}
        self._uniforms: dict[str, tuple[str, ...]] = {}
        self._varyings: dict[str, Between] = {}
        """The values between vertices and pixels, with their declarations."""
        self._flat: set[str] = set()
        self._custom: dict[str, str] = {}

    def text(self) -> str:
        """The whole text."""
        is_lit = self._surface.is_lit
        pixels = list(self._statements(OUTPUTS if is_lit else UNLIT))
        moved = list(self._statements(MOVED))
        vertices = [*self._before(), *moved, *self._after()]
        parts = [part.text for part in self._surface.parts(iter(self._used.values()))]
        uniforms = [line for lines in self._uniforms.values() for line in lines]
        blocks = [
            "\n".join(self._header(is_lit)),
            *parts,
            "\n".join(uniforms),
            "\n".join(self._declared()),
            _function("vertex", vertices),
            _function("fragment", pixels),
        ]
        return "\n\n".join(block.strip("\n") for block in blocks if block) + "\n"

    def _header(self, is_lit: bool) -> Iterator[str]:
        yield f"// {self._surface.name}, for Godot 4: by Burnish."
        for line in self._surface.document.doc.splitlines():
            yield f"// {line}".rstrip()
        yield ""
        yield "shader_type spatial;"
        if not is_lit:
            yield "render_mode unshaded;"

    def _statements(self, rows: Iterable[Output]) -> Iterator[str]:
        inputs = self._surface.inputs
        for row in rows:
            if row.input in inputs:
                value = self._converted(inputs[row.input], row.type)
                if row.factor in inputs:
                    value += f" * {self._call(inputs[row.factor])}"
                yield row.statement.format(value=value)

    def _converted(self, given: Given, wanted: str) -> str:
        """A call whose value has the type that Godot takes."""
        call, type_ = self._call(given), given.type
        if type_ == wanted:
            return call
        if (type_, wanted) == ("vec4", "vec3"):
            return f"{call}.rgb"
        if (type_, wanted) == ("float", "vec3"):
            return f"vec3({call})"
        raise EngineError(f"`{given.slot}` is a {type_}, and Godot takes a {wanted} there")

    def _call(self, given: Given) -> str:
        at_vertices = given.row.stage == "vertex"
        if given.is_parameter:
            argument = given.signature.arguments[0]
            return self._value(argument.given, argument.name, given, at_vertices)
        self._used[given.row.name] = given
        values = []
        for argument in given.signature.arguments:
            if argument.kind == "value":
                values.append(self._value(argument.given, argument.name, given, at_vertices))
            elif argument.kind == "texture":
                row = self._surface.textures[argument.given]
                self._uniforms.setdefault(argument.name, tuple(sampler(argument.name, row)))
                values.append(argument.name)
        return f"{given.signature.part.name}({', '.join(values)})"

    def _value(self, name: str, identifier: str, given: Given, at_vertices: bool) -> str:
        row = self._surface.arguments[name]
        if row.source == "parameter":
            if row.role in ROLES:
                return ROLES[row.role]
            self._uniforms.setdefault(identifier, tuple(uniform(identifier, row)))
            return identifier
        if row.source == "varying":
            return self._varying(identifier, row.given, row.representation)
        rows: Mapping[tuple[str, str], str | Between] = AT_VERTICES if at_vertices else AT_PIXELS
        found = rows.get((row.source, row.given))
        if found is None:
            found = self._own_attribute(row.given, row.source, row.representation, given)
            if not at_vertices:
                found = Between(row.representation, identifier, found)
        if isinstance(found, str):
            return found
        return self._between(found, row.interpolation == "flat")

    def _between(self, found: Between, is_flat: bool = False) -> str:
        self._varyings[found.name] = found
        if is_flat:
            self._flat.add(found.name)
        return found.name

    def _own_attribute(self, name: str, source: str, type_: str, given: Given) -> str:
        """A vertex input of the material's own: one of Godot's custom values."""
        number = len(self._custom)
        if source != "attribute" or type_ not in ("float", "vec2", "vec3", "vec4"):
            raise EngineError(f"`{given.slot}` reads `{name}`, which Godot does not have")
        if name not in self._custom and number == CUSTOM:
            raise EngineError(f"`{given.slot}` reads `{name}`, and Godot has {CUSTOM} such inputs")
        lanes = {"float": ".x", "vec2": ".xy", "vec3": ".xyz", "vec4": ""}[type_]
        return self._custom.setdefault(name, f"CUSTOM{number}{lanes}")

    def _varying(self, identifier: str, function: str, type_: str) -> str:
        """A value that a function for vertices computes."""
        given = self._surface.function(function)
        if type_ not in TYPES:
            raise EngineError(f"`{given.slot}` is a {type_}, which Godot does not interpolate")
        is_whole = type_.startswith(("int", "uint", "ivec", "uvec"))
        return self._between(Between(type_, identifier, self._call(given)), is_whole)

    def _before(self) -> Iterator[str]:
        """Statements of values of the mesh, before it is moved."""
        for name, between in self._varyings.items():
            if not name.startswith("world_"):
                yield f"{name} = {between.value};"

    def _after(self) -> Iterator[str]:
        """Statements of values of the world, where the vertex is at last."""
        for name, between in self._varyings.items():
            if name.startswith("world_"):
                yield f"{name} = {between.value};"

    def _declared(self) -> Iterator[str]:
        for name, between in self._varyings.items():
            flat = "flat " if name in self._flat else ""
            yield f"varying {flat}{between.type} {name};"


def _function(name: str, statements: list[str]) -> str:
    if not statements:
        return ""
    return "\n".join([f"void {name}() {{", *(f"    {line}" for line in statements), "}"])
