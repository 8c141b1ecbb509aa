"""The parts of a binding in Rust that its skeleton asks for."""

from __future__ import annotations

import json
from collections.abc import Iterator, Mapping
from functools import partial
from typing import Any

from ...compiler.documents.writing import to_json
from ...support.frozen import changed
from ..describing import about_block, about_field, range_text, sources
from ..fields import Field, Numbers, Pad, Structure
from ..model import Binding, Block, Bound, Buffer, Material
from ..printer import single
from ..spelling import Spelling
from ..writing import blocks_of, drawing, role_fields, table_of
from . import webgpu
from .frames import FrameDrawing
from .functions import FUNCTIONS

_STORED = {"float": "f32", "int": "i32", "uint": "u32"}
_STAGES = {"vertex": 1, "fragment": 2, "compute": 4, "geometry": 8, "control": 16, "evaluation": 32}
_WIDTH = 92


def texts(binding: Binding, spelling: Spelling) -> Mapping[str, Any]:
    """What the skeleton reads besides the binding."""
    parts = _Parts(spelling)
    profiles = [profile for material in binding.materials for profile in material.profiles]
    return {
        "FUNCTIONS": FUNCTIONS,
        "computed": {"float": "f64", "int": "i64", "bool": "bool"},
        "member_type": parts.member_type,
        "element_type": parts.element_type,
        "lanes_type": parts.type,
        "stored": lambda field: _STORED[field.type.kind],
        "default": parts.default,
        "part_name": parts.part_name,
        "asserts": parts.asserts,
        "checks": lambda structure: list(parts.checks(structure, "self")),
        "field_doc": _field_doc,
        "element_doc": _element_doc,
        "plain_doc": _plain_doc,
        "number": {"int": "i32", "uint": "u32"},
        "block_doc": partial(about_block, binding),
        "sources_text": sources,
        "string": _string,
        "option": _option,
        "raw": _raw,
        "bound_row": parts.bound_row,
        "named_row": parts.named_row,
        "has_texts": any(each.text is not None for profile in profiles for each in profile.texts),
        "texture_row": _texture_row,
        "target_row": _target_row,
        "state_row": _state_row,
        "blocks_of": blocks_of,
        "table_of": table_of,
        "drawing": drawing,
        "FrameDrawing": FrameDrawing,
        "given_blocks": _given_blocks,
        "roles": parts.roles,
        "has_webgpu": any(each.name == webgpu.PROFILE for each in profiles),
        "webgpu_profile": webgpu.profile_of,
        "webgpu_blocks": webgpu.sized_blocks(binding.materials),
        "webgpu_groups": partial(webgpu.groups, spelling),
        "webgpu_buffers": webgpu.vertex_buffers,
        "webgpu_targets": webgpu.targets,
        "webgpu_samplers": webgpu.samplers,
        "webgpu_state": webgpu.state,
        "webgpu_formats": webgpu.formats,
    }


class _Parts:
    """Lines that need the names of the binding."""

    def __init__(self, spelling: Spelling) -> None:
        self._spelling = spelling

    def type(self, type_: Numbers | Structure) -> str:
        """The type of a value: a number, or an array of lanes or of columns."""
        if isinstance(type_, Structure):
            return self._spelling.type(type_.name)
        number = _STORED[type_.kind]
        if type_.lanes == 1 and not type_.columns:
            return number
        column = f"[{number}; {type_.stored_lanes}]"
        return f"[{column}; {type_.columns}]" if type_.columns else column

    def part_name(self, part: Field | Pad) -> str:
        """The name of a member."""
        return f"_pad{part.number}" if isinstance(part, Pad) else self._spelling.member(part.word)

    def member_type(self, part: Field | Pad) -> str:
        """The type of a member."""
        if isinstance(part, Pad):
            return f"[u32; {part.lanes}]"
        one = self.element_type(part)
        return f"[{one}; {part.capacity}]" if part.capacity else one

    def element_type(self, field: Field) -> str:
        """The type of a field, or of an element of an array."""
        if field.enumeration is not None:
            return self._spelling.enumeration(field.enumeration.name)
        return self.type(field.type)

    def default(self, part: Field | Pad) -> str:
        """What a member is before a host sets it: zeros where it has no default."""
        if isinstance(part, Pad):
            return f"[0; {part.lanes}]"
        return self._member(part, part.default)

    def _member(self, field: Field, value: Any) -> str:
        if not field.capacity:
            return self._one(field, value)
        each = [None] * field.capacity if value is None else value
        return _array([self._one(field, one) for one in each])

    def _one(self, field: Field, value: Any) -> str:
        if field.enumeration is None:
            return self._value(field.type, value)
        name = field.enumeration.name
        member = field.enumeration.members[int(value or 0)].name
        return f"{self._spelling.enumeration(name)}::{self._spelling.choice(name, member)}"

    def _value(self, type_: Numbers | Structure, value: Any) -> str:
        if isinstance(type_, Structure):
            return self._structure(type_, value)
        zero = _number(type_, 0)
        if type_.columns:
            columns = [()] * type_.columns if value is None else value
            return _array([_lanes(type_, column, zero) for column in columns])
        if type_.lanes == 1:
            return zero if value is None else _number(type_, value)
        return _lanes(type_, value or (), zero)

    def _structure(self, type_: Structure, values: Any) -> str:
        name = self._spelling.type(type_.name)
        if values is None:
            return f"{name}::DEFAULT"
        given = dict(zip((each.word for each in type_.fields), values, strict=True))
        members = (
            f"{self.part_name(part)}: "
            + (
                self.default(part)
                if isinstance(part, Pad)
                else self._member(part, given[part.word])
            )
            for part in type_.parts
        )
        return f"{name} {{ {', '.join(members)} }}"

    def asserts(self, structure: Structure) -> Iterator[str]:
        """The assertions that the compiler checks: the size, and where each member lies."""
        name = self._spelling.type(structure.name)
        found = f"size_of::<{name}>() == {structure.size}"
        for field in structure.fields[1:]:
            next_ = f"offset_of!({name}, {self._spelling.member(field.word)}) == {field.offset}"
            if len(found) + len(next_) > _WIDTH - len("const _: () = assert!( && );"):
                yield f"const _: () = assert!({found});"
                found = next_
            else:
                found = f"{found} && {next_}"
        yield f"const _: () = assert!({found});"

    def checks(self, structure: Structure, way: str, host: str = "") -> Iterator[str]:
        """The statements that look for values that are out of their ranges."""
        for field in structure.fields:
            place = f"{way}.{self._spelling.member(field.word)}"
            name = f"{host}{field.name}"
            if not field.capacity:
                yield from self._checks_of_value(field, place, f"&{place}", name)
                continue
            inner = list(self._checks_of_value(field, "each", "each", f"{name}[…]"))
            if inner:
                yield f"for each in {place}.iter(){self._in_use(field, way)} {{"
                yield from (f"    {line}" for line in inner)
                yield "}"

    def _in_use(self, field: Field, way: str) -> str:
        """The elements of an array that are read: those beyond its count are not."""
        if not field.counter:
            return ""
        return f".take({way}.{self._spelling.member(field.counter)}.max(0) as usize)"

    def _checks_of_value(
        self, field: Field, place: str, reference: str, name: str
    ) -> Iterator[str]:
        if isinstance(field.type, Structure):
            yield from self.checks(field.type, place, f"{name}.")
            return
        if field.range is not None and not field.type.columns:
            place, reference = (
                (f"{place}.0", f"&{place}.0") if field.enumeration else (place, reference)
            )
            low, high = (_number(field.type, bound) for bound in field.range)
            shown = range_text(field.range)
            lanes = [f"&{place}[{lane}]" for lane in range(field.type.lanes)]
            for lane in lanes if len(lanes) > 1 else [reference]:
                condition = f"!({low}..={high}).contains({lane})"
                yield from _refusal(condition, f"`{name}` is declared in {shown}")
        if field.is_unit:
            condition = f"!has_length_one(&{place}[..{field.type.lanes}])"
            yield from _refusal(condition, f"`{name}` has to be of length 1")

    def roles(self, material: Material) -> list[tuple[str, list[str]]]:
        """The roles of a material's fields, each with the places of its fields."""
        found: dict[str, list[str]] = {}
        for block in _given_blocks(material):
            for field in role_fields(block):
                if field.role is not None and isinstance(field.type, Numbers):
                    names = (self._spelling.member(each) for each in (block.plain_name, field.word))
                    found.setdefault(field.role, []).append(".".join(names))
        return list(found.items())

    def bound_row(self, row: Bound) -> str:
        """A row of the table of bindings that have numbers."""
        return (
            f"Binding {{ {self._bound(row)}, group: {row.group}, binding: {row.binding}, "
            f"{self._bytes(row)}, is_read: {str(row.is_read).lower()} }}"
        )

    def named_row(self, row: Bound) -> str:
        """A row of the table of what is bound by its name in the text."""
        return f"NamedBinding {{ {self._bound(row)}, {self._bytes(row)} }}"

    def _bound(self, row: Bound) -> str:
        stages = sum(_STAGES.get(stage, 0) for stage in row.stages)
        return (
            f"name: {_string(row.name)}, kind: Kind::{row.kind.capitalize()}, stages: {stages}, "
            f"identifier: {_string(row.identifier)}"
        )

    def _bytes(self, row: Bound) -> str:
        has_type = row.kind == "uniform" and row.is_read
        size = f"size_of::<{self._spelling.type(row.name)}>()" if has_type else "0"
        return f"size: {size}"


def _given_blocks(material: Material) -> list[Block]:
    """The blocks that a host sets."""
    return [block for block in material.blocks if block.derivation is None]


def _refusal(condition: str, message: str) -> Iterator[str]:
    yield f"if {condition} {{"
    yield f"    return Err({_string(message)});"
    yield "}"


def _array(values: list[str]) -> str:
    """An array by its elements, in short where all are the same."""
    if len(values) > 1 and len(set(values)) == 1:
        return f"[{values[0]}; {len(values)}]"
    return f"[{', '.join(values)}]"


def _lanes(type_: Numbers, lanes: Any, zero: str) -> str:
    found = [_number(type_, lane) for lane in lanes]
    return _array([*found, *[zero] * (type_.stored_lanes - len(found))])


def _number(type_: Numbers, value: Any) -> str:
    return single(value) if type_.kind == "float" else str(int(value))


def _field_doc(part: Field | Pad) -> str:
    """What is said of a field; the fourth lanes of columns are Rust's own affair."""
    if isinstance(part, Pad):
        return ""
    if part.enumeration is not None:  # Its type says which members there are.
        part = changed(part, enumeration=None, range=None)
    return _plain_doc("; ".join(filter(None, (about_field(part), _unread(part.type)))))


def _element_doc(buffer: Buffer) -> str:
    """What is said of the elements of a buffer."""
    about = f"an element of the storage buffer `{buffer.name}`, of {buffer.stride} bytes"
    return _plain_doc(
        "; ".join(filter(None, (buffer.doc.rstrip("."), about, _unread(buffer.type))))
    )


def _unread(type_: Numbers | Structure) -> str:
    """How lanes that are not read get there, where there are any."""
    if isinstance(type_, Structure) or type_.stored_lanes == type_.lanes:
        return ""
    what = "columns" if type_.columns else "vectors"
    return f"{what} of {type_.lanes} lanes, which `columns` fills up"


def _plain_doc(text: str) -> str:
    """A text as a sentence in one line."""
    text = " ".join(text.split()).rstrip(".")
    return f"{text[:1].upper()}{text[1:]}." if text else ""


def _string(value: str) -> str:
    """A text as Rust writes it: JSON's escapes of control characters are spelled otherwise."""
    text = json.dumps(value, ensure_ascii=False)
    return text.replace("\\b", "\\x08").replace("\\f", "\\x0c")


def _option(value: object) -> str:
    """A text or a number that may be missing."""
    if value is None:
        return "None"
    return f"Some({_string(value) if isinstance(value, str) else value})"


def _raw(text: str) -> str:
    """A text as a raw literal, with as many marks around it as it takes."""
    marks = "#"
    while f'"{marks}' in text:
        marks += "#"
    return f'r{marks}"{text}"{marks}'


def _texture_row(material: Material, row: Any) -> str:
    layout = to_json(row.layout)
    texel = ", ".join(single(lane) for lane in row.default_texel)
    state = next((each for each in material.reflection.samplers if each.texture == row.name), None)
    return (
        f"Texture {{ name: {_string(row.name)}, dimension: {_string(layout['viewDimension'])}, "
        f"sample_type: {_string(layout['sampleType'])}, intent: {_string(row.intent)}, "
        f"texel: &[{texel}], sampler_type: {_option(layout['sampler'])}, "
        f"sampler: {_sampler(state)} }}"
    )


def _sampler(row: Any) -> str:
    if row is None:
        return "None"
    state = to_json(row.state)
    wraps = ", ".join(_string(state.get(f"wrap_{axis}", state["wrap"])) for axis in "uvw")
    return (
        f"Some(Sampler {{ filter: {_string(state['filter'])}, mip: {_string(state['mip'])}, "
        f"wrap: [{wraps}], border: {_option(state.get('border'))}, "
        f"compare: {_option(state.get('compare'))}, anisotropy: {state.get('anisotropy', 1)} }})"
    )


def _target_row(row: Any) -> str:
    found = to_json(row)
    blend = None if found["blend"] is None else json.dumps(found["blend"])
    return (
        f"Target {{ name: {_string(row.name)}, location: {row.location}, "
        f"format: {_string(found['format'])}, encoding: {_option(row.encoding)}, "
        f"mask: {_string(row.mask)}, blend: {_option(blend)} }}"
    )


def _state_row(material: Material) -> Mapping[str, str]:
    """The state of the pipeline by the names of members."""
    state = to_json(material.reflection.render_state)
    depth = state["depth"]
    return {
        "topology": _string(to_json(material.reflection.draw)["topology"]),
        "corners": str(material.reflection.draw.corners),
        "cull": _string(state["cull"]),
        "samples": str(state["samples"]),
        "depth_compare": _string(depth["compare"]),
        "depth_write": str(depth["write"]).lower(),
        "depth_bias": str(depth["bias"]),
        "depth_slope_bias": single(depth["slope_bias"]),
        "depth_bias_clamp": single(depth["bias_clamp"]),
        "alpha_to_coverage": str(state["alpha_to_coverage"]).lower(),
    }
