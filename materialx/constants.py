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
    "unknown",
    "utility - raw",
    "scene_linear",
    "lin_srgb",
    "lin_rec709_srgb",
    "lin_rec709_scene",
    "linear rec.709 (srgb)",
    "utility - linear - srgb",
    "utility - linear - rec.709",
)
"""Names of colour spaces whose numbers stay as they are."""
FROM = {
    "srgb_texture": "from_srgb_texture",
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
"""The functions of ``std.mtlx.color`` by the colour spaces of MaterialX that they decode."""
OF_OTHERS = {
    "from_srgb_texture": (
        "srgb_rec709_scene", "srgb encoded rec.709 (srgb)", "srgb - texture",
        "utility - srgb - texture", "srgb_tx",
    ),
    "from_g18_rec709": (
        "g18_rec709_scene", "gamma 1.8 encoded rec.709", "gamma 1.8 rec.709 - texture",
    ),
    "from_g22_rec709": (
        "g22_rec709_scene", "gamma 2.2 encoded rec.709", "gamma 2.2 rec.709 - texture",
    ),
    "from_rec709_display": (
        "g24_rec709_scene", "gamma 2.4 encoded rec.709", "gamma 2.4 rec.709 - texture",
    ),
    "from_acescg": ("lin_ap1_scene", "aces - acescg"),
    "from_g22_ap1": ("g22_ap1_scene", "gamma 2.2 encoded ap1", "gamma 2.2 ap1 - texture"),
    "from_srgb_ap1": ("srgb_ap1", "srgb_ap1_scene", "srgb encoded ap1"),
    "from_lin_adobergb": ("lin_adobergb_scene", "linear adobergb"),
    "from_adobergb": ("g22_adobergb", "g22_adobergb_scene", "gamma 2.2 encoded adobergb"),
    "from_lin_displayp3": (
        "lin_p3d65", "lin_p3d65_scene", "linear p3-d65", "utility - linear - p3-d65",
    ),
    "from_srgb_displayp3": ("srgb_p3d65", "srgb_p3d65_scene", "srgb encoded p3-d65"),
    "from_lin_rec2020": (
        "lin_rec2020", "lin_rec2020_scene", "linear rec.2020", "utility - linear - rec.2020",
    ),
    "from_aces2065_1": (
        "aces2065-1", "aces2065_1", "lin_ap0", "lin_ap0_scene", "aces - aces2065-1",
    ),
    "from_acescc": ("acescc", "aces - acescc", "acescc_ap1"),
    "from_acescct": ("acescct", "aces - acescct", "acescct_ap1"),
    "from_lin_ciexyzd65": (
        "cie_xyz_d65", "cie-xyz-d65", "lin_ciexyzd65", "lin_ciexyzd65_scene",
        "cie xyz-d65 - scene-referred",
    ),
}  # fmt: skip
"""The names that the Color Interop Forum and configurations of OpenColorIO give to spaces, in small
letters, by the functions that decode them. MaterialX leaves them to OpenColorIO."""
_DECODERS = FROM | {name: function for function, names in OF_OTHERS.items() for name in names}


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
    if space.lower() not in _DECODERS:
        raise UnsupportedError(f"there is no colour space '{space}'")
    return Call(texts.library(_DECODERS[space.lower()]), (value,))


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
