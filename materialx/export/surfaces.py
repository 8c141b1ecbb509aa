"""Finds the surface of MaterialX that a material extends: an imported one, or of ``std.models``."""

from __future__ import annotations

from collections.abc import Mapping
from math import atan2
from typing import NamedTuple

from ...compiler.semantics.names.modules import Symbol
from ..definitions import FOLDER
from ..known import categories, surface
from ..members import SURFACE
from ..model import Definition
from ..models import model_name, slots_of
from ..names import slot_name
from .lanes import lanes
from .nodes import Nodes
from .values import Constant, Value

_STANDARD = {
    "OpenPbr": "open_pbr_surface",
    "GltfSurface": "gltf_pbr",
    "Principled": "disney_principled",
}
"""The surfaces that the models of ``std.models`` are."""
_SPELLED = {
    "open_pbr_surface": {
        "normal": "geometry_normal", "tangent": "geometry_tangent",
    },
}  # fmt: skip
"""Slots of all surfaces, by the names that inputs of a model have for them."""

ALONG, TURNED = "anisotropy_direction", "anisotropy_rotation"
"""A slot of ``GltfSurface`` that MaterialX states as an angle, and the input for it."""


class Root(NamedTuple):
    """What a material extends."""

    level: int
    """Its place in the chain of bases: what stands before it is the material's own."""
    definition: Definition | None
    """The surface; nothing for a material that shows a colour of its own."""
    slots: Mapping[str, str]
    """The inputs by the slots that they are."""
    is_standard: bool
    """True for a model of ``std.models``."""


def root_of(chain: tuple[Symbol, ...]) -> Root | None:
    """The surface that the record with this chain extends; nothing if there is none."""
    for level, symbol in enumerate(chain):
        path = symbol.module.path
        if symbol.module.is_standard:
            name = symbol.module.import_path
            if name == "std.models" and symbol.name in _STANDARD:
                return _root(level, _STANDARD[symbol.name], is_standard=True)
            if symbol.name == SURFACE:
                return Root(level, None, {}, is_standard=True)
        elif path is not None and path.parent.name == FOLDER:
            for category in categories().get(path.stem, ()):
                if symbol.name == model_name(category):
                    return _root(level, category, is_standard=False)
    return None


def _root(level: int, category: str, *, is_standard: bool) -> Root:
    definition = surface(category)
    if not is_standard:
        slots = {slot: name for name, slot in slots_of(definition).items()}
    else:
        slots = {slot_name(name): name for name in definition.inputs}
        slots |= _SPELLED.get(category, {})
    return Root(level, definition, slots, is_standard)


def turned(nodes: Nodes, direction: Value) -> Value:
    """The angle of a direction in the plane of tangents."""
    if isinstance(direction, Constant):
        x, y = direction.numbers
        return Constant("float", (atan2(y, x),))
    x_lane, y_lane = lanes(nodes, direction)
    return nodes.node("atan2", {"iny": y_lane, "inx": x_lane}, "float")
