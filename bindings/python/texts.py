"""The parts of a binding in Python that its skeleton asks for."""

from __future__ import annotations

import json
import textwrap
from collections.abc import Mapping
from functools import partial
from typing import Any

from ...compiler.documents.drawing import SamplerRow, TargetRow, TextureRow
from ...compiler.documents.writing import to_json
from ...compiler.reflection.roles import known_roles
from ..describing import about_block, about_field, sources
from ..fields import Field, Numbers
from ..model import Binding, Block, Material
from ..printer import single
from ..spelling import Spelling
from ..writing import blocks_of, drawing, table_of
from .frames import PythonDrawing, buffer_row, texture_row
from .functions import FUNCTIONS

_KINDS = {"float": "f32", "int": "i32", "uint": "u32"}
_PREFIXES = {"float": "", "int": "i", "uint": "u"}


def texts(binding: Binding, spelling: Spelling) -> Mapping[str, Any]:
    """What the skeleton reads besides the binding."""
    profiles = (profile for material in binding.materials for profile in material.profiles)
    return {
        "FUNCTIONS": FUNCTIONS,
        "kind_name": _kind_name,
        "python_type": _python_type,
        "python_number": lambda field, value: _number(field.type, value),
        "python_numbers": _numbers,
        "field_doc": _field_doc,
        "block_doc": partial(about_block, binding),
        "sources_text": sources,
        "string": _string,
        "stages": lambda names: (
            "(" + "".join(f"{_string(name)}, " for name in names).rstrip(" ") + ")"
        ),
        "layout_ids": _layout_ids,
        "doc": _doc,
        "choice": partial(_choice, spelling),
        "reflection_of": _reflection_of,
        "format_size": _format_size,
        "texture_row": _texture_row,
        "target_row": _target_row,
        "topology": lambda material: _string(to_json(material.reflection.draw)["topology"]),
        "quoted": _quoted,
        "literal": _literal,
        "blocks_of": blocks_of,
        "table_of": table_of,
        "drawing": drawing,
        "given_blocks": _given_blocks,
        "known_roles": known_roles(),
        "wrapped": lambda names: textwrap.wrap(", ".join(map(_string, names)) + ",", 96),
        "frame_doc": lambda frame: _doc(frame.plan.doc),
        "texture_of_frame": texture_row,
        "buffer_of_frame": buffer_row,
        "Drawing": PythonDrawing,
        "has_webgpu": any(each.name == "wgsl:webgpu" for each in profiles),
    }


def _kind_name(kind: Numbers) -> str:
    """The name of a type of numbers: ``_f32``, ``_vec3``, ``_mat3``. No field is called so."""
    if kind.columns:
        is_square = kind.columns == kind.lanes
        return f"_mat{kind.columns}" if is_square else f"_mat{kind.columns}x{kind.lanes}"
    if kind.lanes == 1:
        return "_flag" if kind.truth else f"_{_KINDS[kind.kind]}"
    padded = "_padded" if kind.stored_lanes != kind.lanes else ""
    return f"_{'b' if kind.truth else _PREFIXES[kind.kind]}vec{kind.lanes}{padded}"


def _python_type(kind: Numbers) -> str:
    if kind.columns:
        return "Columns"
    number = "bool" if kind.truth else "float" if kind.kind == "float" else "int"
    if kind.lanes == 1:
        return number
    return "Lanes" if number == "float" else f"Sequence[{number}]"


def _number(kind: Numbers, value: Any) -> str:
    if kind.kind == "float":
        return single(value)
    return repr(bool(value) if kind.truth else int(value))


def _numbers(kind: Numbers, value: Any) -> str:
    if isinstance(value, tuple | list):
        return f"({', '.join(_numbers(kind, each) for each in value)})"
    return _number(kind, value)


def _choice(spelling: Spelling, field: Field, value: float) -> str:
    """A member of the enumeration that a field is: ``Wear.WORN``."""
    assert field.enumeration is not None
    name = field.enumeration.name
    member = field.enumeration.members[int(value)]
    return f"{spelling.enumeration(name)}.{spelling.choice(name, member.name)}"


def _field_doc(field: Field) -> list[str]:
    return _doc(about_field(field))


def _doc(words: str) -> list[str]:
    """A documenting text, in one line; none for no words."""
    text = " ".join(words.split()).replace("\\", "\\\\").replace('"""', '\\"""').rstrip(".")
    return [f'"""{text[:1].upper()}{text[1:]}."""'] if text else []


def _given_blocks(material: Material) -> list[Block]:
    """The blocks that a host sets."""
    return [block for block in material.blocks if block.derivation is None]


def _string(value: object) -> str:
    """A text, or ``None``, as Python writes it."""
    return "None" if value is None else json.dumps(value, ensure_ascii=False)


def _reflection_of(material: Material) -> str:
    """What a reflection says to be of, if it is the material's."""
    row = material.reflection
    return f"({_string(row.material)}, {_string(row.pass_)}, {_string(row.rig)})"


def _layout_ids(material: Material) -> str:
    rows = {row.name: row.layout_id for row in material.reflection.blocks}
    return "{" + ", ".join(f"{_string(k)}: {_string(v)}" for k, v in rows.items()) + "}"


def _format_size(format_: str | None) -> int:
    """The bytes of a vertex format: ``float32x3``."""
    lanes = (format_ or "").partition("x")[2]
    return 0 if format_ is None else 4 * int(lanes or 1)


def _texture_row(material: Material, row: TextureRow) -> str:
    state = next((each for each in material.reflection.samplers if each.texture == row.name), None)
    layout = to_json(row.layout)
    return ", ".join((
        _string(row.name), _string(layout["viewDimension"]), _string(layout["sampleType"]),
        _string(row.intent), repr(tuple(row.default_texel)), _string(layout["sampler"]),
        _sampler(state),
    ))  # fmt: skip


def _sampler(row: SamplerRow | None) -> str:
    """The state of a sampler as the arguments of WebGPU's ``createSampler`` in wgpu."""
    if row is None:
        return "None"
    state = to_json(row.state)
    found: dict[str, Any] = {"mag_filter": state["filter"], "min_filter": state["filter"]}
    if state["mip"] != "none":
        found["mipmap_filter"] = state["mip"]
    else:
        found["lod_max_clamp"] = 0
    for axis in "uvw":
        found[f"address_mode_{axis}"] = state.get(f"wrap_{axis}", state["wrap"])
    if state.get("compare") is not None:
        found["compare"] = state["compare"]
    if "anisotropy" in state:
        found["max_anisotropy"] = state["anisotropy"]
    return _literal(found)


def _target_row(row: TargetRow) -> str:
    return _literal(to_json(row))


def _literal(value: Any) -> str:
    """Data of JSON as Python writes it."""
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_string(k)}: {_literal(v)}" for k, v in value.items()) + "}"
    if isinstance(value, list):
        return f"[{', '.join(map(_literal, value))}]"
    return _string(value) if isinstance(value, str) else repr(value)


def _quoted(text: str) -> str:
    """A text in triple quotes."""
    return '"""\\\n' + text.replace("\\", "\\\\").replace('"""', '\\"""') + '"""'
