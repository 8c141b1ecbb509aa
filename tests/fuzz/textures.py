"""The reads of textures in random programs, by the type of the texture."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

from .scope import FRAGMENT, UNIFORM

COLORS = ("texture2d", "texture2d_array", "texture3d", "texture_cube", "texture_cube_array")
DEPTHS = ("depth2d", "depth2d_array", "depth_cube", "depth_cube_array")
INTEGERS = tuple(f"{kind}{name}" for kind in "iu" for name in COLORS[:3])
KINDS = (*COLORS, *DEPTHS, *INTEGERS)

DEFAULTS = {
    **dict.fromkeys(COLORS, ("white", "black", "gray", "transparent", "flat_normal")),
    **dict.fromkeys(DEPTHS, ("far", "near")),
    **dict.fromkeys(INTEGERS, ("zero",)),
}
SETTINGS = {
    "filter": ("linear", "nearest"),
    "mip": ("linear", "nearest", "none"),
    **dict.fromkeys(("wrap", "wrap_u", "wrap_v", "wrap_w"), ("repeat", "clamp", "mirror")),
    "compare": ("less_equal", "less", "greater_equal", "greater"),
}


def settings_of(type_: str) -> tuple[str, ...]:
    """The settings that a texture's sampler has."""
    if type_ in INTEGERS:
        return ()
    axes = () if "cube" in type_ else ("wrap", "wrap_u", "wrap_v")
    wrap = (*axes, "wrap_w") if "3d" in type_ else axes
    return ("filter", *wrap, "compare") if type_ in DEPTHS else ("filter", "mip", *wrap)


@dataclass(frozen=True)
class Read:
    """One way to read a texture: what is written behind its name."""

    form: str
    operands: tuple[str, ...]
    result: str
    needs: frozenset[str] = frozenset()


@cache
def reads_of(texture: str, result: str) -> tuple[Read, ...]:
    """The reads of a texture that give a type."""
    return tuple(read for read in all_reads(texture) if read.result == result)


def all_reads(texture: str) -> Iterator[Read]:
    layer = ("int",) if texture.endswith("_array") else ()
    place = ("vec3" if "3d" in texture or "cube" in texture else "vec2", *layer)
    texel = ("ivec3" if "3d" in texture else "ivec2", *layer)
    loaded = {"i": "ivec4", "u": "uvec4", "d": "float"}.get(texture[0], "vec4")
    if texture in COLORS:
        together = frozenset({UNIFORM, FRAGMENT})
        yield _read("", place, "vec4", needs=together)
        yield _read(".bias", (*place, "float"), "vec4", needs=together)
        yield _read(".level", (*place, "float"), "vec4")
        yield _read(".grad", (*place, place[0], place[0]), "vec4")
    if texture in COLORS and "3d" not in texture:
        yield _read(".gather", place, "vec4", last=", 1")
    if texture in DEPTHS:
        yield _read("", (*place, "float"), "float")
    if texture in DEPTHS and "cube" not in texture:
        yield _read(".gather", (*place, "float"), "vec4")
    if "cube" not in texture:
        yield _read(".load", texel, loaded)
        # Mesa clamps to the size of one pixel's level where levels differ (``docs/drivers.md``).
        yield _read(".load", texel, loaded, last=", 1")
    size = "ivec3" if "3d" in texture else "ivec2"
    yield _read(".size", (), size)
    yield _read(".size", ("int",), size)
    yield _read(".levels", (), "int")
    if layer:
        yield _read(".layers", (), "int")


def _read(
    method: str,
    operands: tuple[str, ...],
    result: str,
    last: str = "",
    needs: frozenset[str] = frozenset(),
) -> Read:
    places = ", ".join("{}" for _ in operands)
    return Read(f"{method}({places}{last})", operands, result, needs)
