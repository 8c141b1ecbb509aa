"""Puts functions into an engine's shader: which are called, with what, and what that needs.

The folders of engines write their files of what ``Writer`` has found out.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator

from ..compiler.documents.functions import ArgumentRow, FunctionTextureRow
from ..compiler.reflection.roles import scene_names
from ..targets.emit.functions import EmittedPart
from .surface import Given, Surface, UnfitError
from .values import MOVED, Between, Output, Tables

LANES = {"float": ".x", "vec2": ".xy", "vec3": ".xyz", "vec4": ""}


class Writer:
    """The statements of an engine's shader. ``UnfitError`` is raised for what an engine lacks."""

    def __init__(self, surface: Surface, tables: Tables) -> None:
        self._surface, self._tables = surface, tables
        self._used: dict[str, Given] = {}
        self.parameters: dict[str, ArgumentRow] = {}
        """The parameters that the functions read, by their names in the text."""
        self.textures: dict[str, FunctionTextureRow] = {}
        self.between: dict[str, Between] = {}
        """The values that vertices hand to pixels."""
        self.reads: set[str] = set()
        """All that is read of the engine, as it is written."""
        self._own: dict[str, str] = {}
        self.pixels = list(self._statements(tables.lit if surface.is_lit else tables.unlit))
        """The statements of a pixel."""
        self.vertices = self._of_vertices()
        """The statements of a vertex."""

    def parts(self, stage: str = "") -> list[EmittedPart]:
        """The functions, or those of one stage, and what they need, in order."""
        used = self._used.values()
        return self._surface.parts(each for each in used if stage in ("", each.row.stage))

    @property
    def own_inputs(self) -> dict[str, str]:
        """The engine's vertex inputs, by the names of the material's own."""
        return dict(self._own)

    def _of_vertices(self) -> list[str]:
        moved = list(self._moving())
        rows = list(self.between.values())
        before = [self._handed(row) for row in rows if not row.is_moved]
        after = [self._handed(row) for row in rows if row.is_moved]
        return [*before, *moved, *after]

    def _moving(self) -> Iterator[str]:
        """The statements that move a vertex: all is computed before any of it is changed."""
        found = [(row, self._result(row)) for row in self._tables.moved if self._has(row)]
        for row, value in found if len(found) > 1 else ():
            yield f"{row.type} {MOVED}{row.input} = {value};"
        for row, value in found:
            yield row.statement.format(value=f"{MOVED}{row.input}" if len(found) > 1 else value)

    def _handed(self, row: Between) -> str:
        form = self._tables.hand_over
        return form.format(
            name=row.name, value=row.value, lanes=self._tables.lanes.get(row.type, "")
        )

    def _statements(self, rows: Iterable[Output]) -> Iterator[str]:
        for row in filter(self._has, rows):
            yield row.statement.format(value=self._result(row))

    def _has(self, row: Output) -> bool:
        return row.input in self._surface.inputs

    def _result(self, row: Output) -> str:
        """What the material gives for a value that the engine takes."""
        inputs = self._surface.inputs
        value = self._converted(inputs[row.input], row.type)
        if row.factor in inputs:
            value += f" * {self._call(inputs[row.factor])}"
        return value

    def _converted(self, given: Given, wanted: str) -> str:
        """A call whose value has the type that the engine takes."""
        call, type_ = self._call(given), given.type
        if type_ == wanted:
            return call
        if (type_, wanted) == ("vec4", "vec3"):
            return f"{call}.rgb"
        if (type_, wanted) == ("float", "vec3"):
            return f"vec3({call})"
        title = self._tables.title
        raise UnfitError(given.slot, f"it is a {type_}, and {title} takes a {wanted} there")

    def _call(self, given: Given) -> str:
        if self._surface.is_parameter(given):
            argument = given.signature.arguments[0]
            return self._value(argument.given, argument.name, given)
        self._used[given.row.name] = given
        values = []
        for argument in given.signature.arguments:
            if argument.kind == "value":
                values.append(self._value(argument.given, argument.name, given))
            elif argument.kind == "texture":
                self.textures[argument.name] = self._surface.textures[argument.given]
                values.append(self._tables.texture.format(name=argument.name))
            else:
                values.append(argument.name)
        return f"{given.signature.part.name}({', '.join(values)})"

    def _value(self, name: str, identifier: str, given: Given) -> str:
        row = self._surface.arguments[name]
        at_vertices = given.row.stage == "vertex"
        if row.source == "parameter":
            return self._parameter(identifier, row, at_vertices)
        if row.source == "varying":
            return self._varying(identifier, row)
        tables, place = self._tables, (row.source, row.given)
        found = tables.at_vertices.get(place) if at_vertices else tables.at_pixels.get(place)
        if found is None:
            found = self._own_input(row, given)
            if not at_vertices:
                found = Between(row.representation, identifier, found)
        if isinstance(found, str):
            self.reads.add(found)
            return found
        return self._handed_over(found)

    def _parameter(self, identifier: str, row: ArgumentRow, at_vertices: bool) -> str:
        roles = self._tables.vertex_roles if at_vertices else self._tables.pixel_roles
        if row.role is not None and row.role in roles:
            self.reads.add(roles[row.role])
            return roles[row.role]
        self.parameters[identifier] = row
        return self._tables.parameter.format(name=identifier)

    def _handed_over(self, row: Between) -> str:
        self.between.setdefault(row.name, row)
        self.reads.add(row.value)
        lanes = self._tables.lanes.get(row.type, "")
        return self._tables.between.format(name=row.name, lanes=lanes)

    def _own_input(self, row: ArgumentRow, given: Given) -> str:
        """A vertex input of the material's own: one that the engine has for that."""
        tables = self._tables
        if row.given.partition(".")[0] in scene_names()["instances"]:
            reason = f"it reads `{row.given}` of each instance, and {tables.title} places instances"
            raise UnfitError(given.slot, f"{reason} itself")
        if row.source != "attribute" or row.representation not in LANES or not tables.own_inputs:
            raise UnfitError(given.slot, f"it reads `{row.given}`, which {tables.title} lacks")
        if row.given not in self._own and len(self._own) == len(tables.own_inputs):
            raise UnfitError(
                given.slot,
                f"it reads `{row.given}`, and {tables.title} has {len(tables.own_inputs)} inputs "
                "of a material's own",
            )
        place = self._own.setdefault(row.given, tables.own_inputs[len(self._own)])
        return f"{place}{LANES[row.representation]}"

    def _varying(self, identifier: str, row: ArgumentRow) -> str:
        """A value that a function for vertices computes."""
        given, type_ = self._surface.function(row.given), row.representation
        if type_ not in self._tables.interpolated:
            title = self._tables.title
            raise UnfitError(given.slot, f"it is a {type_}, which {title} does not interpolate")
        is_whole = type_.startswith(("int", "uint", "ivec", "uvec"))
        return self._handed_over(Between(type_, identifier, self._call(given), is_flat=is_whole))
