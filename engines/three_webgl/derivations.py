"""Prints the code of derived values as JavaScript over the uniforms of a material of three.js."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from ...bindings.fields import Field, Numbers, Structure
from ...bindings.statements import Place, Set
from ...bindings.typescript.printer import TypeScriptPrinter
from ...compiler.tracing import Expression
from .uniforms import Uniform, is_color, room_of, whole_array

_COLOR, _VECTOR = "rgb", "xyzw"


class UniformPrinter(TypeScriptPrinter):
    """Prints JavaScript that reads and sets ``u``, the uniforms by their names."""

    def __init__(self, uniforms: Iterable[Uniform]) -> None:
        super().__init__()
        self._uniforms = {(each.block.plain_name, each.field.word): each for each in uniforms}
        self.block = ""
        """The plain name of the block whose values are computed."""

    def place(self, place: Place, way: Iterable[Any]) -> str:
        """A value of a uniform: a number, if the place is one of a lane."""
        block = self.block if place.block == "derived" else place.block
        word, *rest = way
        uniform = self._uniforms[block, word]
        text, field = f"u.{uniform.name}.value", uniform.field
        index = ""
        for step in rest:
            inner = isinstance(field.type, Structure) and isinstance(step, str)
            if inner and (found := _member(field, step)) is not None:
                text, field = f"{text}.{found.word}", found
            elif whole_array(field) is not None:
                index = str(step)
            else:
                text = f"{text}[{step}]"
        return self._lane_of(text, field, index, place.part)

    def _lane_of(self, text: str, field: Field, index: str, part: tuple[int, ...]) -> str:
        if not isinstance(field.type, Numbers):
            return text
        if index:
            lane = _lane(part, 4 if field.type.columns else field.type.lanes)
            return f"{text}[{_scaled(index, room_of(field.type), lane)}]"
        return f"{text}{_accessed(field, part)}" if part else text

    def part(self, place: str, _part: tuple[int, ...]) -> str:
        """A lane, which ``place`` has named already."""
        return place

    def read(self, place: str, each: Expression) -> str:
        """The number at a place; one of integers stands for a bool."""
        found: Place = each.value
        is_lane = bool(found.part) or not isinstance(found.way[-1], str)
        return f"({place} !== 0)" if is_lane and each.kind == "bool" else place

    def set(self, place: str, statement: Set) -> Iterator[str]:
        """The statements that store a value: one for each lane."""
        columns = [each if isinstance(each, tuple) else (each,) for each in statement.lanes]
        lanes = [lane for column in columns for lane in column]
        target = Place(block="derived", way=statement.place.way)
        index = self.spelling.local(statement.index) if statement.index else ""
        way = [index if step is None else step for step in statement.place.way]
        for number, lane in enumerate(lanes):
            text = self._lane(lane, statement.field)
            if len(lanes) == 1:
                yield f"{place} = {text};"
                continue
            rows = len(columns[0]) if isinstance(statement.lanes[0], tuple) else 0
            part = divmod(number, rows) if rows else (number,)
            at = self.place(Place(block="derived", way=target.way, part=part), way)
            yield f"{at} = {text};"


def _member(field: Field, name: str) -> Field | None:
    """The member of a structure by its name in the language; the text may have another one."""
    assert isinstance(field.type, Structure)
    names = {each.name.rpartition(".")[2]: each for each in field.type.fields}
    return names.get(name)


def _lane(part: tuple[int, ...], rows: int) -> int:
    """The number of a lane, or of one of a column of so many."""
    *columns, lane = part or (0,)
    return sum(rows * column for column in columns) + lane


def _scaled(index: str, count: int, lane: int) -> str:
    scaled = index if count == 1 else f"{count} * {index}"
    return f"{scaled} + {lane}" if lane else scaled


def _accessed(field: Field, part: tuple[int, ...]) -> str:
    """The lane of a value by the words of three.js."""
    assert isinstance(field.type, Numbers)
    lane = _lane(part, field.type.lanes)
    if field.computed:
        return f"[{lane}]"
    if field.type.columns:
        return f".elements[{lane}]"
    return f".{(_COLOR if is_color(field) else _VECTOR)[lane]}"
