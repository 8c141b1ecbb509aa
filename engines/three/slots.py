"""Which node of three.js's materials each value of a surface becomes, and in which space.

Which slot of a material is the value says the table of all engines, ``engines/slot_table.py``.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...support.frozen import frozen
from ..slot_table import is_lit

WORLD_TO_VIEW = "{0}.transformDirection(cameraViewMatrix)"
"""A normal of the world, as materials of three.js want it: in the space of the camera."""


@frozen
class NodeRow:
    """A property of a material that a slot sets."""

    word: str
    node: str
    """The property: ``roughnessNode``."""
    form: str = "{0}"
    """The value in JavaScript: ``{0}`` is that of the slot, and ``{name}`` that of another one."""
    needs: tuple[str, ...] = ()
    """The words of the other slots in the form."""


PHYSICAL = (
    NodeRow("base_color", "colorNode", "{0}.rgb"),
    NodeRow("alpha", "opacityNode"),
    NodeRow("metallic", "metalnessNode"),
    NodeRow("roughness", "roughnessNode"),
    NodeRow("squared_roughness", "roughnessNode", "{0}.sqrt()"),
    NodeRow("normal", "normalNode", WORLD_TO_VIEW),
    NodeRow("emissive", "emissiveNode"),
    NodeRow("emissive", "emissiveNode", "{0}.mul({emissive_strength})", ("emissive_strength",)),
    NodeRow("occlusion", "aoNode"),
    NodeRow("ior", "iorNode"),
    NodeRow("specular", "specularIntensityNode"),
    NodeRow("specular_color", "specularColorNode"),
    NodeRow("clearcoat", "clearcoatNode"),
    NodeRow("clearcoat_roughness", "clearcoatRoughnessNode"),
    NodeRow("clearcoat_normal", "clearcoatNormalNode", WORLD_TO_VIEW),
    NodeRow("sheen_color", "sheenNode"),
    NodeRow("sheen_roughness", "sheenRoughnessNode"),
    NodeRow("anisotropy_strength", "anisotropyNode", "vec2(1, 0).mul({0})"),
    NodeRow(
        "anisotropy_strength", "anisotropyNode", "{anisotropy_direction}.mul({0})",
        ("anisotropy_direction",),
    ),
    NodeRow("iridescence", "iridescenceNode"),
    NodeRow("iridescence_ior", "iridescenceIORNode"),
    NodeRow("iridescence_thickness", "iridescenceThicknessNode"),
    NodeRow("transmission", "transmissionNode"),
    NodeRow("thickness", "thicknessNode"),
    NodeRow("attenuation_color", "attenuationColorNode"),
    NodeRow(
        "attenuation_distance", "attenuationDistanceNode", "{0}.greaterThan(0).select({0}, 1e30)"
    ),
    NodeRow("dispersion", "dispersionNode"),
)  # fmt: skip
"""The rows of surfaces that the engine lights, as ``MeshPhysicalNodeMaterial`` has them."""

UNLIT = (NodeRow("color", "colorNode"), NodeRow("alpha", "opacityNode"))
"""The rows of surfaces that have their colour without light: ``MeshBasicNodeMaterial``."""

SHARED = (NodeRow("is_hidden", "maskNode", "{0}.not()"),)
"""The rows of all surfaces."""

VERTICES = ("object_position", "object_normal", "position")
"""The words of slots for vertices, which ``positionNode`` and ``normalLocal`` take."""

_ROWS = (*PHYSICAL, *UNLIT, *SHARED)
TAKEN = frozenset({word for row in _ROWS for word in (row.word, *row.needs)} | set(VERTICES))
"""The values of a surface that materials of three.js take."""


def rows_for(words: Mapping[str, str]) -> Iterator[NodeRow]:
    """The rows that slots set; a row that needs others wins over the one that does not."""
    rows = (*(PHYSICAL if is_lit(words) else UNLIT), *SHARED)
    chosen: dict[str, NodeRow] = {}
    for row in rows:
        if row.word in words and all(word in words for word in row.needs):
            chosen[row.node] = row
    yield from chosen.values()
