"""The textures of a material in Rust: fields, how images are loaded, and what stands in."""

from __future__ import annotations

import struct
from collections.abc import Iterator

from ...compiler.documents.drawing import SamplerState
from ...compiler.documents.functions import FunctionTextureRow
from ...support.frozen import frozen
from .fields import Field, identifier, number, sentences

DIMENSIONS = {
    "2d": "D2", "2d_array": "D2Array", "3d": "D3", "cube": "Cube", "cube_array": "CubeArray",
}  # fmt: skip
FORMATS = {"float": "Rgba16Float", "int": "Rgba16Sint", "uint": "Rgba16Uint"}
LANES = {"float": "4e", "int": "4h", "uint": "4H"}
SAMPLES = {
    "float": "", "int": ', sample_type = "s_int"', "uint": ', sample_type = "u_int"',
}  # fmt: skip
WRAPS = {
    "repeat": "Repeat", "clamp": "ClampToEdge", "mirror": "MirrorRepeat", "border": "ClampToBorder",
}  # fmt: skip
BORDERS = {"transparent": "TransparentBlack", "black": "OpaqueBlack", "white": "OpaqueWhite"}


@frozen
class Texel:
    """A texture of one texel, which stands in until another is set."""

    constant: str
    name: str
    dimension: str
    format: str
    lanes: str


@frozen
class Loading:
    """How an image for a texture is loaded."""

    name: str
    is_srgb: str
    sampler: tuple[str, ...]


def texel(row: FunctionTextureRow) -> Texel:
    """What stands in for a texture."""
    dimension, format_ = DIMENSIONS[row.dimension], FORMATS[row.sample]
    lanes = [*row.default_texel, 0, 0, 0][:4]
    given = lanes if row.sample == "float" else [int(lane) for lane in lanes]
    halves = struct.unpack("<4H", struct.pack(f"<{LANES[row.sample]}", *given))
    kind = "" if row.sample == "float" else f"_{row.sample}"
    constant = f"{row.default}{kind}_{row.dimension}".upper()
    text = ", ".join(f"{half:#06x}" if half else "0" for half in halves)
    return Texel(constant, row.default.replace("_", " "), dimension, format_, f"[{text}]")


def field(row: FunctionTextureRow, number_: int, is_sampled: bool) -> Field:
    """The field of a texture whose binding is ``number_``, and that of its sampler the next."""
    dimension = "" if row.dimension == "2d" else f', dimension = "{row.dimension}"'
    attributes = [f"texture({number_}{dimension}{SAMPLES[row.sample]})"]
    if is_sampled:
        attributes.append(f"sampler({number_ + 1})")
    kind = "" if row.sample == "float" else "Of whole numbers."
    doc = sentences(row.doc, kind, f"Until it is set, {row.default.replace('_', ' ')}.")
    default = f"{texel(row).constant}.clone()"
    return Field(identifier(row.name), "Handle<Image>", default, doc, tuple(attributes))


def loading(row: FunctionTextureRow) -> Loading:
    """How an image for a texture is loaded."""
    is_srgb = "true" if row.intent == "color" else "false"
    state = row.state
    return Loading(row.name, is_srgb, tuple(_sampler(state)) if state is not None else ())


def _sampler(state: SamplerState) -> Iterator[str]:
    for axis in "uvw":
        wrap = getattr(state, f"wrap_{axis}") or state.wrap
        yield f"address_mode_{axis}: ImageAddressMode::{WRAPS[wrap]}"
    word = state.filter.capitalize()
    yield f"mag_filter: ImageFilterMode::{word}"
    yield f"min_filter: ImageFilterMode::{word}"
    mip = "Nearest" if state.mip == "none" else state.mip.capitalize()
    yield f"mipmap_filter: ImageFilterMode::{mip}"
    if state.mip == "none":
        yield f"lod_max_clamp: {number(0)}"
    if state.anisotropy:
        yield f"anisotropy_clamp: {state.anisotropy}"
    if state.border is not None:
        yield f"border_color: Some(ImageSamplerBorderColor::{BORDERS[state.border]})"
