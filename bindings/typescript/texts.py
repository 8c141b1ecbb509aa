"""The parts of a binding in TypeScript that its skeleton asks for."""

from __future__ import annotations

import json
import re
import textwrap
from collections.abc import Iterable, Iterator, Mapping
from functools import partial
from typing import Any

from ...compiler.documents.drawing import TargetRow, TextureRow, VertexInputRow
from ...compiler.documents.writing import to_json
from ...compiler.reflection.roles import known_roles
from ..describing import about_block, about_field, sources
from ..fields import Field, Structure
from ..model import Binding, Block, Material
from ..spelling import Spelling
from ..writing import blocks_of, drawing, table_of
from .fields import Fields, in_order, is_computed, is_optional, is_scalar
from .frames import Drawing, buffer_rows, kept_rows, texture_row
from .functions import FUNCTIONS
from .webgl import has_webgl, state
from .webgpu import PROFILE, pipeline, sampler

_WIDTH = 100
_KEY = re.compile(r"[A-Za-z_$][\w$]*")


def texts(binding: Binding, spelling: Spelling) -> Mapping[str, Any]:
    """What the skeleton reads besides the binding."""
    fields = Fields(spelling)
    return {
        "FUNCTIONS": FUNCTIONS,
        "has_webgpu": any(_has_webgpu(material) for material in binding.materials),
        "has_webgl_any": any(map(has_webgl, binding.materials)),
        "has_webgl": has_webgl,
        "render_state": state,
        "needs_complete": _has_parts(binding),
        "is_scalar": is_scalar,
        "is_optional": is_optional,
        "is_computed": is_computed,
        "in_order": in_order,
        "values_type": fields.values_type,
        "given_type": fields.given_type,
        "read_type": fields.read_type,
        "view": fields.view,
        "reading": fields.reading,
        "storing": fields.storing,
        "resets": fields.resets,
        "kind_type": lambda kind: "boolean" if kind == "bool" else "number",
        "about": _about,
        "doc": _doc,
        "block_doc": partial(about_block, binding),
        "sources_text": sources,
        "string": _literal,
        "literal": _literal,
        "key": _key,
        "quoted": _quoted,
        "layout_ids": _layout_ids,
        "reflection_of": _reflection_of,
        "vertex_input": _vertex_input,
        "texture": _texture,
        "target": _target,
        "texture_row": texture_row,
        "buffer_rows": buffer_rows,
        "kept_rows": kept_rows,
        "blocks_of": blocks_of,
        "table_of": table_of,
        "drawing": drawing,
        "Drawing": Drawing,
        "known_roles": known_roles(),
        "wrapped": _wrapped,
        "given_blocks": _given_blocks,
        "pipelines": lambda material: [pipeline(material)] if _has_webgpu(material) else [],
    }


def _has_webgpu(material: Material) -> bool:
    return any(profile.name == PROFILE for profile in material.profiles)


def _about(field: Field) -> str:
    text = about_field(field)
    return f"{text[:1].upper()}{text[1:]}." if text else ""


def _doc(text: str, margin: str) -> Iterator[str]:
    """A comment for editors; none if there is nothing to say."""
    plain = text.replace("*/", "*\\/")
    if not plain:
        return
    if len(margin) + len(plain) + len("/**  */") <= _WIDTH:
        yield f"{margin}/** {plain} */"
        return
    yield f"{margin}/**"
    prefix = f"{margin} * "
    yield from textwrap.wrap(
        plain, _WIDTH, initial_indent=prefix, subsequent_indent=prefix,
        break_long_words=False, break_on_hyphens=False,
    )  # fmt: skip
    yield f"{margin} */"


def _literal(value: Any) -> str:
    """Data of JSON as TypeScript writes it."""
    if isinstance(value, Mapping):
        parts = ", ".join(f"{_key(name)}: {_literal(each)}" for name, each in value.items())
        return f"{{ {parts} }}" if parts else "{}"
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_literal, value))}]"
    if isinstance(value, float) and value.is_integer():
        return str(int(value))
    return json.dumps(value, ensure_ascii=False)


def _wrapped(names: Iterable[str]) -> list[str]:
    """The lines of a list of names."""
    return textwrap.wrap(", ".join(map(_literal, names)) + ",", _WIDTH - 2)


def _key(name: str) -> str:
    """The name of a property."""
    return name if _KEY.fullmatch(name) else _literal(name)


def _quoted(text: str) -> str:
    """A text between backquotes."""
    plain = text.replace("\\", "\\\\").replace("`", "\\`").replace("${", "\\${")
    return f"`{plain}`"


def _has_parts(binding: Binding) -> bool:
    """True if a host sets structures, or arrays of them."""
    every = [*binding.structures, *(block.structure for block in binding.blocks)]
    return any(
        isinstance(field.type, Structure) and not field.computed
        for each in every
        for field in each.fields
    )


def _given_blocks(material: Material) -> list[Block]:
    """The blocks that a host sets."""
    return [block for block in material.blocks if block.derivation is None]


def _reflection_of(material: Material) -> list[str]:
    """What a reflection says to be of, if it is the material's."""
    row = material.reflection
    return [row.material, row.pass_, row.rig]


def _layout_ids(material: Material) -> Mapping[str, str]:
    return {row.name: row.layout_id for row in material.reflection.blocks}


def _vertex_input(row: VertexInputRow) -> Mapping[str, Any]:
    return {"name": row.name, "location": row.location, "format": row.format, "step": row.step}


def _texture(material: Material, row: TextureRow) -> Mapping[str, Any]:
    layout = to_json(row.layout)
    return {
        "dimension": layout["viewDimension"],
        "sampleType": layout["sampleType"],
        "intent": row.intent,
        "texel": row.default_texel,
        "samplerType": layout["sampler"],
        "sampler": sampler(material, row.name),
    }


def _target(row: TargetRow) -> Mapping[str, Any]:
    found = to_json(row)
    return {name: found[name] for name in ("name", "location", "format", "encoding")}
