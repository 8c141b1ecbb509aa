"""Values that are no nodes: constants with their colour spaces
and units, and what the surface has."""

from __future__ import annotations

from .expressions import Call, Expression
from .model import Port
from .places import Texts
from .problems import UnsupportedError
from .units import measured

LINEAR = (
    "",
    "lin_rec709",
    "none",
    "raw",
    "data",
    "utility - raw",
    "scene_linear",
    "lin_srgb",
    "lin_rec709_scene",
)
"""Names of colour spaces whose numbers stay as they are."""
FROM = {
    "srgb_texture": "from_srgb_texture",
    "srgb_rec709_scene": "from_srgb_texture",
    "gamma18": "from_g18_rec709",
    "g18_rec709": "from_g18_rec709",
    "gamma22": "from_g22_rec709",
    "g22_rec709": "from_g22_rec709",
    "gamma24": "from_rec709_display",
    "rec709_display": "from_rec709_display",
    "acescg": "from_acescg",
    "lin_ap1": "from_acescg",
    "g22_ap1": "from_g22_ap1",
    "lin_adobergb": "from_lin_adobergb",
    "adobergb": "from_adobergb",
    "lin_displayp3": "from_lin_displayp3",
    "srgb_displayp3": "from_srgb_displayp3",
}
"""The functions of ``std.mtlx.color`` by the colour spaces that they decode."""


def constant(texts: Texts, port: Port, kind: str) -> Expression:
    """The value that stands at an input, as linear light of Rec. 709 if it is a colour."""
    assert port.value is not None
    if port.value == "" and kind not in ("string", "filename"):
        raise UnsupportedError("the input has neither a value nor a connection")
    try:
        value = measured(port, kind)
    except UnsupportedError as error:
        raise UnsupportedError(f"the input '{port.name}': {error.text}") from None
    return decoded(texts, value, port.color_space) if kind.startswith("color") else value


def decoded(texts: Texts, value: Expression, space: str) -> Expression:
    """A colour of some colour space as linear light of Rec. 709."""
    if space.lower() in LINEAR:
        return value
    if space.lower() not in FROM:
        raise UnsupportedError(f"there is no colour space '{space}'")
    return Call(texts.library(FROM[space.lower()]), (value,))


PROPERTIES = {
    "Pobject": "position_object",
    "Nobject": "normal_object",
    "Tobject": "tangent_object",
    "Bobject": "bitangent_object",
    "Pworld": "position_world",
    "Nworld": "normal_world",
    "Tworld": "tangent_world",
    "Bworld": "bitangent_world",
    "Vworld": "view_world",
    "UV0": "st",
}
"""The geometric properties of MaterialX, and the slots of ``std.mtlx.surface`` that have them."""


def property_named(texts: Texts, name: str) -> Expression:
    """The value of an unconnected input with a geometric default."""
    if name not in PROPERTIES:
        raise UnsupportedError(f"there is no geometric property '{name}'")
    return texts.surface(PROPERTIES[name])
