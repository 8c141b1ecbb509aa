"""What a shader of Bevy computes: ``Statements`` finds it, for the files that are written of it."""

from __future__ import annotations

from ...compiler.documents.functions import ArgumentRow
from ...targets.emit.wrapping import wrapped
from ..surface import Surface, UnfitError
from ..writer import Writer
from .values import ATTRIBUTES, DEPTHS, LOCATIONS, NORMALS, TABLES, TYPES

DEEP = ("normal", "tangent")
"""Vertex inputs that Bevy leaves out where it draws only depths."""


class Statements(Writer):
    """The statements of Bevy's shaders. ``UnfitError`` is raised for what Bevy lacks."""

    def __init__(self, surface: Surface) -> None:
        if "clip_position" in surface.inputs:
            raise UnfitError("clip_position", "its materials have nothing of that kind")
        super().__init__(surface, TABLES)
        if len(self.between) > LOCATIONS:
            names = ", ".join(self.between)
            reason = f"it hands {names} from vertices to pixels, and {LOCATIONS} such values are"
            raise UnfitError(surface.name, f"{reason} left beside Bevy's own")
        self.depths = list(self._statements(DEPTHS))
        """The statements that decide if a pixel is there, where only its depth is drawn."""
        self.normals = list(self._statements(NORMALS)) if surface.is_lit else []
        """The statement of the normal, where it is drawn alone."""
        self.moves = frozenset(surface.inputs) & {"object_position", "object_normal", "position"}
        """What a material moves."""

    @property
    def has_vertices(self) -> bool:
        """True if the material has a vertex shader of its own."""
        return bool(self.vertices)

    @property
    def has_prepass(self) -> bool:
        """True if it has a shader of its own for pixels that are drawn before they are lit."""
        return bool(self.depths or self.normals or self.between)

    @property
    def attributes(self) -> list[str]:
        """The vertex inputs that are read, by Bevy's members."""
        found = [name for name in ATTRIBUTES if any(self._reads(name, text) for text in self.reads)]
        turned = "object_normal" in self.moves and "normal" not in found
        return [*found, "normal"] if turned else found

    @property
    def needs_deep(self) -> list[str]:
        """Those of them that are needed, and that Bevy leaves out, where it draws only depths."""
        if not (self.has_vertices or self.depths):
            return []
        return [name for name in DEEP if name in self.attributes]

    def _of_vertices(self) -> list[str]:
        """The statements of a vertex: they read what is given, so that their order is free."""
        moved = list(self._statements(TABLES.moved))
        return [*map(self._handed, self.between.values()), *moved]

    @staticmethod
    def _reads(name: str, text: str) -> bool:
        members = {f"given.{name}", f"pixel.{name}", f"world_{name}", f"pixel.world_{name}"}
        return name != "position" and text.partition(".xyz")[0] in members

    def _parameter(self, identifier: str, row: ArgumentRow, at_vertices: bool) -> str:
        """A parameter as functions take it; uniforms have neither bools nor arrays of scalars."""
        text = super()._parameter(identifier, row, at_vertices)
        if identifier not in self.parameters:
            return text
        element, _, count = row.representation.partition("[")
        if element == "bool" and not count:
            return f"{text} != 0u"
        if element not in TYPES:
            raise UnfitError(row.name, f"it is a {row.type}, and Bevy has no such uniforms")
        lanes = {"vec2": ".xy"}.get(element, ".x")
        if count and (lanes == ".xy" or element in ("float", "int", "uint")):
            places = range(int(count.removesuffix("]")))
            elements = ", ".join(f"{text}[{place}]{lanes}" for place in places)
            return f"array<{TYPES[element]}, {len(places)}>({elements})"
        return text


def uniform_type(row: ArgumentRow) -> str:
    """The type of a parameter in the block, in WGSL: elements of arrays have 16 bytes."""
    element, _, count = row.representation.partition("[")
    if element == "bool":
        return "u32"
    if not count:
        return TYPES[element]
    padded = {"float": "vec4<f32>", "vec2": "vec4<f32>", "int": "vec4<i32>", "uint": "vec4<u32>"}
    return f"array<{padded.get(element, TYPES[element])}, {count.removesuffix(']')}>"


def lines_of(statements: list[str]) -> list[str]:
    """Statements of a function, indented and broken where they are long."""
    lines = (line for statement in statements for line in statement.split("\n"))
    return [wrapped(f"    {line}")[0] for line in lines]
