"""The parts of a binding in C++ that its skeleton asks for."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from functools import partial
from typing import Any

from ...compiler.documents.writing import to_json
from ..describing import about_block, about_field, sources
from ..fields import Field, Numbers, Structure
from ..model import Binding, Bound, Material, Text
from ..naming import in_ascii, snake, words
from ..printer import single
from ..spelling import Spelling
from .functions import FUNCTIONS

_SCALARS = {"float": "float", "int": "std::int32_t", "uint": "std::uint32_t"}
_PREFIXES = {"float": "", "int": "i", "uint": "u"}
_STAGES = {"vertex": 1, "fragment": 2, "compute": 4, "geometry": 8, "control": 16, "evaluation": 32}
_WIDTH = 100


def texts(binding: Binding, spelling: Spelling) -> Mapping[str, Any]:
    """What the skeleton reads besides the binding."""
    parts = _Parts(spelling)
    return {
        "FUNCTIONS": FUNCTIONS,
        "member": parts.member,
        "asserts": parts.asserts,
        "faults": parts.faults,
        "scalar": lambda kind: _SCALARS[kind],
        "doubles": lambda kind: {"float": "double", "int": "std::int64_t", "bool": "bool"}[kind],
        "block_doc": partial(about_block, binding),
        "sources_text": sources,
        "string": _string,
        "bound_row": parts.bound_row,
        "text_row": _text_row,
        "partial": partial,
        "input_row": _input_row,
        "target_row": _target_row,
        "state_row": _state_row,
        "layout_row": _layout_rows,
        "plain": _plain,
        "rows": lambda rows, row: [row(each) for each in rows],
        "texture_rows": _texture_rows,
        "list_of": lambda rows, name: name if rows else "{}",
        "element_type": lambda field: parts.type(field.type),
        "namespace": spelling.namespace(binding.namespace),
    }


class _Parts:
    """Lines that need the names of the binding."""

    def __init__(self, spelling: Spelling) -> None:
        self._spelling = spelling

    def type(self, type_: Numbers | Structure) -> str:
        """The type of a value in the namespace of the binding."""
        if isinstance(type_, Structure):
            return self._spelling.type(type_.name)
        if type_.columns:
            return f"mat{type_.columns}" + ("" if type_.columns == 4 else "x4")
        if type_.lanes == 1:
            return _SCALARS[type_.kind]
        return f"{_PREFIXES[type_.kind]}vec{type_.stored_lanes}"

    def member(self, field: Field) -> Iterator[str]:
        """The lines of a member, with its comment."""
        name = self._spelling.member(field.word)
        many = f"[{field.capacity}]" if field.capacity else ""
        about = about_field(field)
        if about:
            yield f"/// {about[:1].upper()}{about[1:]}."
        yield f"{self.type(field.type)} {name}{many}{self._initial(field)};"

    def _initial(self, field: Field) -> str:
        if field.default is None:
            return "{}"
        if not field.capacity:
            value = self._value(field.type, field.default)
            return f" = {value}" if _is_scalar(field.type) else value
        parts = ", ".join(
            f"{'' if _is_scalar(field.type) else self.type(field.type)}"
            f"{self._value(field.type, each)}"
            for each in field.default
        )
        return f" = {{{parts}}}"

    def _value(self, type_: Numbers | Structure, value: Any) -> str:
        if isinstance(type_, Structure):
            return self._structure(type_, value)
        if type_.columns:
            columns = (
                f"vec4{{{', '.join([*map(_float, column), *['0.0f'] * (4 - len(column))])}}}"
                for column in value
            )
            return f"{{{', '.join(columns)}}}"
        if type_.lanes == 1:
            return _number(type_, value)
        lanes = [_number(type_, lane) for lane in value]
        zero = _number(type_, 0)
        return f"{{{', '.join([*lanes, *[zero] * (type_.stored_lanes - len(lanes))])}}}"

    def _structure(self, type_: Structure, values: Any) -> str:
        """A structure by its members in order, pads among them."""
        given = dict(zip((each.word for each in type_.fields), values, strict=True))
        parts = (
            self._value(part.type, given[part.word]) if isinstance(part, Field) else "{}"
            for part in type_.parts
        )
        return f"{{{', '.join(parts)}}}"

    def asserts(self, structure: Structure) -> Iterator[str]:
        """The assertions that the compiler checks: the size, and where each member lies."""
        name = self._spelling.type(structure.name)
        found = f"sizeof({name}) == {structure.size}"
        for field in structure.fields[1:]:
            next_ = f"offsetof({name}, {self._spelling.member(field.word)}) == {field.offset}"
            if len(found) + len(next_) > _WIDTH - len("static_assert( && );"):
                yield f"static_assert({found});"
                found = next_
            else:
                found = f"{found} && {next_}"
        yield f"static_assert({found});"

    def faults(self, structure: Structure, way: str = "", host: str = "") -> Iterator[str]:
        """The statements that look for values that are out of their ranges."""
        for field in structure.fields:
            place = f"{way}{self._spelling.member(field.word)}"
            yield from self._faults_of(field, place, f"{host}{field.name}", way)

    def _faults_of(self, field: Field, place: str, name: str, way: str) -> Iterator[str]:
        if field.capacity:
            # Elements beyond the count are read by nobody.
            last = (
                f"{way}{self._spelling.member(field.counter)}" if field.counter else field.capacity
            )
            inner = list(self._faults_of_value(field, f"{place}[i]", f"{name}[…]"))
            if inner:
                yield f"for (int i = 0; i < {last}; ++i) {{"
                yield from (f"    {line}" for line in inner)
                yield "}"
        else:
            yield from self._faults_of_value(field, place, name)

    def _faults_of_value(self, field: Field, place: str, name: str) -> Iterator[str]:
        if isinstance(field.type, Structure):
            yield from self.faults(field.type, f"{place}.", f"{name}.")
            return
        lanes = [f"{place}.{lane}" for lane in "xyzw"[: field.type.lanes]]
        if field.range is not None and not field.type.columns:
            shown = " to ".join(f"{bound:g}" for bound in field.range)
            message = _string(f"`{name}` is declared in {shown}")
            for lane in lanes if len(lanes) > 1 else [place]:
                yield f"if (!({_is_inside(field, lane)})) return {message};"
        if field.is_unit:
            message = _string(f"`{name}` has to be of length 1")
            yield f"if (!has_length_one({place})) return {message};"

    def bound_row(self, row: Bound) -> str:
        """A row of the table of bindings."""
        has_block = row.kind == "uniform" and row.is_read
        size = f"sizeof({self._spelling.type(row.name)})" if has_block else "0"
        stages = sum(_STAGES.get(stage, 0) for stage in row.stages)
        return (
            f"{{{_string(row.name)}, Kind::{row.kind}, {_or_none(row.group)}, "
            f"{_or_none(row.binding)}, {stages}, {size}, {_string(row.identifier)}, "
            f"{str(row.is_read).lower()}}}"
        )


def _is_inside(field: Field, lane: str) -> str:
    """The condition that a lane is in its range; numbers without a sign are not below 0."""
    assert isinstance(field.type, Numbers) and field.range is not None
    low, high = (_number(field.type, bound) for bound in field.range)
    if field.type.kind == "uint" and field.range[0] == 0:
        return f"{lane} <= {high}"
    return f"{lane} >= {low} && {lane} <= {high}"


def _is_scalar(type_: Numbers | Structure) -> bool:
    return isinstance(type_, Numbers) and type_.lanes == 1 and not type_.columns


def _float(value: float) -> str:
    return f"{single(value)}f"


def _number(type_: Numbers, value: Any) -> str:
    if type_.kind == "float":
        return _float(value)
    return f"{int(value)}u" if type_.kind == "uint" else str(int(value))


def _or_none(number: int | None) -> int:
    return -1 if number is None else number


def _string(value: object) -> str:
    return "nullptr" if value is None else json.dumps(value, ensure_ascii=False)


def _plain(name: str) -> str:
    """A name in small letters and underscores, as a part of a longer one."""
    return snake(words(in_ascii(name)))


def _text_row(embedded: Callable[[str], str], row: Text) -> str:
    text = "nullptr" if row.text is None else embedded(_raw(row.text))
    return f"{{{_string(row.stage)}, {_string(row.file)}, {_string(row.entry_point)}, {text}}}"


def _raw(text: str) -> str:
    """A text as raw literals, which compilers join; some take no more than 16000 bytes in one."""
    parts, part = [], ""
    for line in text.splitlines(keepends=True):
        if len(part) + len(line) > 8000:
            parts.append(part)
            part = ""
        part += line
    return "\n".join(f'R"burnish({each})burnish"' for each in (*parts, part))


def _texture_row(material: Material, row: Any) -> str:
    layout = to_json(row.layout)
    texel = ", ".join(_float(lane) for lane in row.default_texel)
    state = next((each for each in material.reflection.samplers if each.texture == row.name), None)
    return (
        f"{{{_string(row.name)}, {_string(layout['viewDimension'])}, "
        f"{_string(layout['sampleType'])}, "
        f"{_string(row.intent)}, {{{texel}}}, {_string(layout['sampler'])}, {_sampler(state)}}}"
    )


def _texture_rows(material: Material) -> list[str]:
    return [_texture_row(material, row) for row in material.reflection.textures]


def _sampler(row: Any) -> str:
    if row is None:
        return "{}"
    state = to_json(row.state)
    wraps = ", ".join(_string(state.get(f"wrap_{axis}", state["wrap"])) for axis in "uvw")
    return (
        f"{{{_string(state['filter'])}, {_string(state['mip'])}, {wraps}, "
        f"{_string(state.get('border'))}, {_string(state.get('compare'))}, "
        f"{state.get('anisotropy', 1)}}}"
    )


def _input_row(row: Any) -> str:
    format_ = "none" if row.format is None else row.format
    per_instance = "true" if row.step == "instance" else "false"
    place = f"{_string(row.name)}, {_or_none(row.location)}"
    return f"{{{place}, VertexFormat::{format_}, {per_instance}}}"


def _target_row(row: Any) -> str:
    found = to_json(row)
    blend = "nullptr" if found["blend"] is None else _string(json.dumps(found["blend"]))
    return (
        f"{{{_string(row.name)}, {row.location}, {_string(found['format'])}, "
        f"{_string(row.encoding)}, {_string(row.mask)}, {blend}}}"
    )


def _state_row(material: Material) -> str:
    state = to_json(material.reflection.render_state)
    draw = to_json(material.reflection.draw)
    depth = state["depth"]
    return ", ".join((
        _string(draw["topology"]), _string(state["cull"]), str(state["samples"]),
        _string(depth["compare"]), "true" if depth["write"] else "false", str(depth["bias"]),
        _float(depth["slope_bias"]), _float(depth["bias_clamp"]),
        "true" if state["alpha_to_coverage"] else "false",
    ))  # fmt: skip


def _layout_rows(material: Material) -> list[str]:
    return [_string(row.layout_id) for row in material.reflection.blocks]
