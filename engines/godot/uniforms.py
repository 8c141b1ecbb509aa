"""Parameters and textures of a material as uniforms that Godot's inspector shows."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from ...compiler.documents.functions import ArgumentRow, FunctionTextureRow
from ..surface import UnfitError

TYPES = frozenset(
    {"float", "int", "uint", "bool", "mat2", "mat3", "mat4"}
    | {f"{kind}vec{lanes}" for kind in ("", "i", "u", "b") for lanes in (2, 3, 4)}
)
"""The types that uniforms and varyings have."""
COLORS = ("rgb", "rgba")
"""The written types whose values are colours, which people choose in sRGB."""

SAMPLERS = {
    "2d": "sampler2D",
    "2d_array": "sampler2DArray",
    "3d": "sampler3D",
    "cube": "samplerCube",
}
KINDS = {"float": "", "int": "i", "uint": "u"}
DEFAULTS = {
    "white": "hint_default_white", "black": "hint_default_black",
    "transparent": "hint_default_transparent", "flat_normal": "hint_normal",
}  # fmt: skip
"""Godot's words for textures that stand in until somebody sets one."""


def uniform(name: str, row: ArgumentRow) -> Iterator[str]:
    """The lines of a parameter."""
    element, _, count = row.representation.partition("[")
    if element not in TYPES:
        raise UnfitError(row.name, f"it is a {row.type}, and Godot has no such uniforms")
    yield from doc_comment(row.doc)
    hints = list(_hints(row))
    hint = f" : {', '.join(hints)}" if hints else ""
    array = f"[{count}" if count else ""
    default = "" if row.default is None or array else f" = {_default(row, element)}"
    yield f"uniform {element} {name}{array}{hint}{default};"


def _hints(row: ArgumentRow) -> Iterator[str]:
    if row.type in COLORS:
        yield "source_color"
    elif row.choices is not None and row.representation == "int":
        yield "hint_enum({})".format(", ".join(f'"{each.name}"' for each in row.choices))
    elif row.range is not None and row.representation in ("float", "int"):
        low, high = (_number(end, row.representation) for end in row.range)
        yield f"hint_range({low}, {high})"


def _default(row: ArgumentRow, type_: str) -> str:
    lanes = _flat(row.default)
    if row.type in COLORS:
        lanes = [*map(_encoded, lanes[:3]), *lanes[3:]]
    kind = {"i": "int", "u": "uint", "b": "bool"}.get(type_[0], "float")
    if type_ in ("float", "int", "uint", "bool"):
        return _number(lanes[0], type_)
    if type_.startswith("mat"):
        count = int(type_[-1])
        columns = (lanes[start : start + count] for start in range(0, len(lanes), count))
        written = (", ".join(_number(lane, kind) for lane in column) for column in columns)
        return f"{type_}({', '.join(f'vec{count}({column})' for column in written)})"
    return f"{type_}({', '.join(_number(lane, kind) for lane in lanes)})"


def _flat(value: object) -> list[float]:
    if isinstance(value, Sequence):
        return [lane for part in value for lane in _flat(part)]
    assert isinstance(value, int | float)
    return [value]


def _encoded(linear: float) -> float:
    """A lane of a colour in sRGB, as Godot decodes uniforms that are colours."""
    if linear <= 0.0031308:
        return linear * 12.92
    return 1.055 * float(linear ** (1 / 2.4)) - 0.055


def _number(value: float, kind: str) -> str:
    if kind == "bool":
        return "true" if value else "false"
    if kind in ("int", "uint"):
        return f"{int(value)}{'u' if kind == 'uint' else ''}"
    text = f"{value:.9g}"
    return text if any(mark in text for mark in ".en") else f"{text}.0"


def sampler(name: str, row: FunctionTextureRow) -> Iterator[str]:
    """The lines of a texture."""
    if row.dimension not in SAMPLERS or row.sample not in KINDS:
        raise UnfitError(row.name, f"it is a {row.type}, which Godot's shaders lack")
    if row.default == "flat_normal":
        yield from doc_comment(f"{row.doc} (Import it with Normal Map disabled.)".strip())
    else:
        yield from doc_comment(row.doc)
    type_ = f"{KINDS[row.sample]}{SAMPLERS[row.dimension]}"
    hints = ", ".join(_sampler_hints(row))
    yield f"uniform {type_} {name}{f' : {hints}' if hints else ''};"


def _sampler_hints(row: FunctionTextureRow) -> Iterator[str]:
    if row.intent == "color":
        yield "source_color"
    if row.default in DEFAULTS:
        yield DEFAULTS[row.default]
    state = row.state
    if state is None:
        return
    mips = "" if state.mip == "none" else "_mipmap"
    anisotropic = "_anisotropic" if state.anisotropy and mips else ""
    yield f"filter_{state.filter}{mips}{anisotropic}"
    wraps = {state.wrap, state.wrap_u or state.wrap, state.wrap_v or state.wrap}
    if wraps == {"repeat"}:
        yield "repeat_enable"
    elif wraps == {"clamp"}:
        yield "repeat_disable"
    else:
        odd = ", ".join(sorted(wraps - {"repeat", "clamp"})) or "repeat on one axis alone"
        raise UnfitError(row.name, f"it wants {odd} beyond its edges, which Godot's samplers lack")


def doc_comment(text: str) -> Iterator[str]:
    """A comment that the inspector shows."""
    if text:
        yield f"/** {' '.join(text.split()).replace('*/', '* /')} */"
