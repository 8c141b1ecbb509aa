"""What engines light a surface by, and the slots of materials in which it is found: one table.

``stdlib/scene.toml`` says what the library's own slots are. Materials may call theirs as they like:
the table has the names of the library's models and terms, and whoever uses other names says so.
What a value is called in an engine, and which values it has not got, says its own folder.
"""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping, Sequence

from ..compiler.documents.functions import FunctionRow, Functions, SlotRow
from ..compiler.ir.functions import Offer
from ..compiler.reflection.roles import scene_names
from ..support.frozen import changed, frozen


@frozen
class Kind:
    """What slots for a value have to be."""

    types: tuple[str, ...]
    """Their types on the machine."""
    told: str
    """What they are, in messages."""
    space: str = ""
    """The space of what has a direction or a place; a type without any is taken, too."""

    def takes(self, slot: SlotRow) -> bool:
        """True for a slot of this kind."""
        _, sign, space = slot.type.partition("<")
        is_elsewhere = bool(self.space) and bool(sign) and space != f"{self.space}>"
        return slot.representation in self.types and not is_elsewhere


NUMBER = Kind(("float",), "a number")
HUE = Kind(("vec3", "vec4", "float"), "a colour")
CONDITION = Kind(("bool",), "a condition")
NORMAL = Kind(("vec3",), "a normal of the world", "world")
OBJECT_NORMAL = Kind(("vec3",), "a normal of the object", "object")
PLACE = Kind(("vec3",), "a place in the world", "world")
OBJECT_PLACE = Kind(("vec3",), "a place of the object", "object")
CLIP_PLACE = Kind(("vec4",), "a place of four lanes in clip space", "clip")
AXIS = Kind(("vec2",), "two numbers: along the tangent and the bitangent")


@frozen
class Input:
    """A value by which an engine lights a surface."""

    name: str
    """The engines' word for it, which is the role of slots of the library."""
    own: tuple[str, ...] = ()
    """Slots or parameters of a user's own in which it may be; the first that there is is taken."""
    kind: Kind = NUMBER
    at_vertices: bool = False
    """True if it is computed for vertices."""
    changed: bool = False
    """True if it counts only where the material says something else than the library.

    An engine has the mesh's place and normal itself.
    """

    moves: bool = False
    """True if a change of what the library makes it of counts as well.

    ``scene.toml`` lists these slots, which move the points of a mesh.
    """

    blended: bool = False
    """True if it counts only where the pass blends to which the material is tied, if it is."""

    beside: tuple[str, ...] = ()
    """The rows without which it has no effect."""

    @property
    def is_needed(self) -> bool:
        """True if a surface looks wrong all over where an engine does not take it."""
        return self.at_vertices or self.name in NEEDED

    @property
    def stage(self) -> str:
        """The stage for which it is computed."""
        return "vertex" if self.at_vertices else "fragment"

    def offers(
        self, words: Mapping[str, str], moving: Sequence[str], usual: float | str | None
    ) -> Iterator[Offer]:
        """What the core is asked for; ``words`` are the roles of slots of the library.

        ``moving`` are the slots that move meshes and that the engine is not given themselves,
        and ``usual`` is what the engine has itself.
        """
        made_of = tuple(moving) if self.moves else ()
        for full, word in words.items():
            if word == self.name:
                owner, _, name = full.rpartition(".")
                yield Offer(
                    name, self.at_vertices, owner, self.changed, made_of, self.blended, usual,
                    self.beside,
                )  # fmt: skip
        for name in self.own:
            yield Offer(name, self.at_vertices)

    def rank(self, slot: SlotRow) -> int | None:
        """The place of a slot among those that may be this value; ``None`` if it is not one."""
        if slot.role is not None:
            return 0 if slot.role == self.name else None
        return 1 + self.own.index(slot.name) if slot.name in self.own else None


COLOR = "color"
"""The light that a surface sends out: of a surface that no lights are needed for."""

NEEDED = ("alpha", "is_hidden", "normal", COLOR)
"""Values of pixels without which a surface has another shape, or none of its looks."""

BASE_COLOR = ("base_color", "albedo", "tint", "diffuse", "diffuse_color", "kd", "base")

OF_MODELS: Mapping[str, tuple[str, ...]] = {
    "specular_level": (), "specular_weight": (), "specular_tint": (), "edge_color": (),
    "diffuse_roughness": (), "anisotropic": (), "subsurface": (),
    "subsurface_color": ("subsurface",), "sheen": (), "sheen_tint": ("sheen",), "fuzz": (),
    "fuzz_color": ("fuzz",), "fuzz_roughness": ("fuzz",), "thin_film": (),
    "thin_film_thickness": ("thin_film",), "thin_film_ior": ("thin_film",),
    "clearcoat_gloss": ("clearcoat",), "clearcoat_color": ("clearcoat",),
    "clearcoat_ior": ("clearcoat",), "clearcoat_darkening": ("clearcoat",),
}  # fmt: skip
"""Values of single models of the library, each with those without which it has no effect."""


def _of_model(name: str) -> Kind:
    return HUE if name.endswith("_color") else NUMBER


INPUTS: tuple[Input, ...] = (
    Input("base_color", BASE_COLOR, kind=HUE),
    Input("metallic", ("metallic", "metalness")),
    Input("roughness", ("roughness", "rough")),
    Input("squared_roughness"),
    Input("ior", ("ior",), changed=True),
    Input("specular", changed=True),
    Input("specular_color", kind=HUE, changed=True),
    Input("clearcoat", ("clearcoat",), changed=True),
    Input("clearcoat_roughness", ("clearcoat_roughness",), changed=True, beside=("clearcoat",)),
    Input("clearcoat_normal", kind=NORMAL, changed=True, beside=("clearcoat", "normal")),
    Input("sheen_color", ("sheen_color",), kind=HUE, changed=True),
    Input("sheen_roughness", ("sheen_roughness",), changed=True, beside=("sheen_color",)),
    Input("anisotropy_strength", changed=True),
    Input("anisotropy_direction", kind=AXIS, changed=True, beside=("anisotropy_strength",)),
    Input("iridescence", ("iridescence",), changed=True),
    Input("iridescence_ior", ("iridescence_ior",), changed=True, beside=("iridescence",)),
    Input(
        "iridescence_thickness", ("iridescence_thickness",), changed=True, beside=("iridescence",)
    ),
    Input("transmission", ("transmission",), changed=True),
    Input("thickness", ("thickness",), changed=True, beside=("transmission",)),
    Input("attenuation_color", kind=HUE, changed=True),
    Input("attenuation_distance", changed=True),
    Input("dispersion", changed=True),
    *(
        Input(name, kind=_of_model(name), changed=True, beside=beside)
        for name, beside in OF_MODELS.items()
    ),
    Input(
        "emissive",
        ("emissive", "emission", "glow"),
        kind=HUE,
        changed=True,
        beside=("emissive_strength",),
    ),
    Input("emissive_strength", changed=True),
    Input("occlusion", ("occlusion", "ambient_occlusion")),
    Input("normal", kind=NORMAL, changed=True, moves=True),
    Input("alpha", changed=True, blended=True),
    Input("is_hidden", kind=CONDITION, changed=True),
    Input(COLOR, kind=HUE, changed=True),
    Input("position", kind=PLACE, at_vertices=True, changed=True, moves=True),
    Input("clip_position", kind=CLIP_PLACE, at_vertices=True, changed=True),
    Input("object_position", kind=OBJECT_PLACE, at_vertices=True, changed=True),
    Input("object_normal", kind=OBJECT_NORMAL, at_vertices=True, changed=True),
)

USUAL: Mapping[str, Mapping[str, float | str]] = {
    "bevy": {"emissive": 0, "ior": 1.5, "clearcoat_roughness": 0.5, "thickness": 0},
    "filament": {"emissive": 0, "clearcoat_roughness": 0},
    "godot": {"emissive": 0, "clearcoat_roughness": 0},
    "three": {
        "ior": 1.5, "specular": 1, "clearcoat_roughness": 0, "clearcoat_normal": "normal",
        "sheen_roughness": 1, "iridescence_ior": 1.3, "iridescence_thickness": 400, "thickness": 0,
        "emissive": 0,
    },
    "unity": {"emissive": 0, "clearcoat_roughness": 0},
    "unreal": {"emissive": 0, "clearcoat_roughness": 0.1},
}  # fmt: skip
"""What engines have themselves where a material gives no such slot, by the names of engines.

It is a number, or the slot that stands in its place. A slot that the library declares as something
else is given, even if the material says nothing of it.
"""


_ROWS = {row.name: row for row in INPUTS}


def misfit(value: str, slot: SlotRow) -> str:
    """Why a slot cannot be a value of the table; empty if it can."""
    kind = _ROWS[value].kind
    return "" if kind.takes(slot) else f"it is a {slot.type}, and `{value}` is {kind.told}"


def is_lit(words: Collection[str]) -> bool:
    """True if an engine lights a surface that gives these values; else it sends out its own."""
    return COLOR not in words


def found(document: Functions) -> Mapping[str, FunctionRow]:
    """The function for each value that a material gives, by the value's name.

    Each function returns one slot. A slot that somebody has named comes first, then those of the
    library, and a user's own in the order of the table.
    """
    rows = document.functions
    by_slot = {(row.slots[0].name, row.stage): row for row in rows}
    best: dict[str, FunctionRow] = {}
    for value in INPUTS:
        ranked = [
            (rank, number)
            for number, row in enumerate(rows)
            if row.stage == value.stage and (rank := value.rank(row.slots[0])) is not None
        ]
        named = by_slot.get((document.named.get(value.name, ""), value.stage))
        if named is not None:
            best[value.name] = named
        elif ranked:
            best[value.name] = rows[min(ranked)[1]]
    return best


def offers(
    engine: str, named: Mapping[str, str], only: Collection[str], taken: Collection[str]
) -> tuple[Offer, ...]:
    """All slots that engines can use, or ``only`` some of them, if it has any.

    ``named`` are slots that a user has named for a value, such as ``stain`` for ``base_color``, and
    ``taken`` the values that the engine takes: of a user's own names, there are none for others.
    """
    scene, usual = scene_names(), USUAL.get(engine, {})
    offered = [
        changed(offer, blended=False) if only else offer
        for row in INPUTS
        for offer in row.offers(scene["slots"], _moving(row.name, taken), usual.get(row.name))
        if (offer.owner or row.name in taken) and (not only or offer.name in only)
    ]
    places = {row.name: row.at_vertices for row in INPUTS}
    return (*(Offer(slot, places[word], None) for word, slot in named.items()), *offered)


def left_to(engine: str) -> tuple[Offer, ...]:
    """The slots that an engine's user sets himself where a material says nothing of them."""
    every = [row.name for row in INPUTS]
    return tuple(each for each in offers(engine, {}, (), every) if each.owner and each.changed)


def _moving(value: str, taken: Collection[str]) -> list[str]:
    """The slots that move a value of the mesh, without those that the engine takes themselves."""
    rows = scene_names()["moving"].items()
    names = [full.rpartition(".")[2] for full, moved in rows if value in moved.split()]
    return [name for name in names if name not in taken]
