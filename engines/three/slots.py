"""The table of slots: which node of three.js's materials each one becomes, and in which space.

A row is found by the word that the library has for its slots (``stdlib/scene.toml``), or by the
names that users give their own.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping

from ...compiler.documents.functions import SlotRow
from ...support.frozen import frozen

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
    names: tuple[str, ...] = ()
    """Names of users' own slots that mean the same."""


PHYSICAL = (
    NodeRow(
        "base_color", "colorNode", "{0}.rgb",
        names=("tint", "base_color", "albedo", "diffuse", "diffuse_color"),
    ),
    NodeRow("alpha", "opacityNode"),
    NodeRow("metallic", "metalnessNode", names=("metallic", "metalness")),
    NodeRow("roughness", "roughnessNode", names=("roughness", "rough")),
    NodeRow("squared_roughness", "roughnessNode", "{0}.sqrt()"),
    NodeRow("normal", "normalNode", WORLD_TO_VIEW),
    NodeRow("emissive", "emissiveNode", names=("emissive", "emission", "glow")),
    NodeRow("emissive", "emissiveNode", "{0}.mul({emissive_strength})", ("emissive_strength",)),
    NodeRow("occlusion", "aoNode", names=("occlusion", "ambient_occlusion")),
    NodeRow("ior", "iorNode", names=("ior",)),
    NodeRow("specular", "specularIntensityNode"),
    NodeRow("specular_color", "specularColorNode"),
    NodeRow("clearcoat", "clearcoatNode", names=("clearcoat",)),
    NodeRow("clearcoat_roughness", "clearcoatRoughnessNode", names=("clearcoat_roughness",)),
    NodeRow("clearcoat_normal", "clearcoatNormalNode", WORLD_TO_VIEW),
    NodeRow("sheen_color", "sheenNode", names=("sheen_color",)),
    NodeRow("sheen_roughness", "sheenRoughnessNode", names=("sheen_roughness",)),
    NodeRow(
        "anisotropy_strength", "anisotropyNode", "{anisotropy_direction}.mul({0})",
        ("anisotropy_direction",),
    ),
    NodeRow("iridescence", "iridescenceNode", names=("iridescence",)),
    NodeRow("iridescence_ior", "iridescenceIORNode", names=("iridescence_ior",)),
    NodeRow(
        "iridescence_thickness", "iridescenceThicknessNode", names=("iridescence_thickness",)
    ),
    NodeRow("transmission", "transmissionNode", names=("transmission",)),
    NodeRow("thickness", "thicknessNode", names=("thickness",)),
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


def words_of(slots: Iterable[SlotRow]) -> Mapping[str, str]:
    """The slots by the word of the table that each one has; the library's words come first."""
    slots = list(slots)
    found = {slot.role: slot.name for slot in reversed(slots) if slot.role}
    for row in PHYSICAL:
        own = [slot.name for slot in slots if slot.role is None and slot.name in row.names]
        if own and row.word not in found:
            found[row.word] = own[0]
    return found


def rows_for(words: Mapping[str, str]) -> Iterator[NodeRow]:
    """The rows that slots set; a row that needs others wins over the one that does not."""
    is_lit = any(row.word in words for row in PHYSICAL if row.word not in ("alpha", "normal"))
    rows = (*(PHYSICAL if is_lit or "color" not in words else UNLIT), *SHARED)
    chosen: dict[str, NodeRow] = {}
    for row in rows:
        if row.word in words and all(word in words for word in row.needs):
            chosen[row.node] = row
    yield from chosen.values()
