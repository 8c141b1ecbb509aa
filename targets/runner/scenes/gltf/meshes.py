"""Makes meshes from the primitives of a glTF file, with triangles, normals and tangents."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from .....compiler.budget import Tally
from ...meshes import Mesh, MeshError
from ..records import SceneError, short
from .accessors import Accessors
from .schema import Primitive

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]
Channels = dict[str, NDArray[Any]]

_POINTS, _TRIANGLES, _STRIP, _FAN = 0, 4, 5, 6
_LINES = {1, 2, 3}


class Size(NamedTuple):
    """The size of a mesh's ingredients, which is known before the mesh is made."""

    vertices: int
    corners: int
    """The number of corners of all triangles."""
    has_normals: bool
    """False if there are no normals: then each triangle gets vertices of its own."""

    @property
    def drawn(self) -> int:
        """The number of vertices that are drawn."""
        return max(self.vertices, self.corners)

    def count_memory(self, memory: Tally) -> None:
        """Count the memory of a mesh, and the memory for making it. Raises ``BudgetError``."""
        vertices = self.vertices if self.has_normals else self.drawn
        memory.add(
            vertices * _KEPT_OF_VERTEX + self.corners * _KEPT_OF_CORNER,
            passing=vertices * _PASSING_OF_VERTEX + self.corners * _PASSING_OF_CORNER,
        )


_KEPT_OF_VERTEX, _KEPT_OF_CORNER = 280, 8
"""The bytes of a mesh: 26 numbers for each vertex, with those of morph targets 35, and the number
of a vertex for each corner."""
_PASSING_OF_VERTEX, _PASSING_OF_CORNER = 160, 80
"""Bytes that are needed in addition while a mesh is made, as measured."""


def is_drawn(primitive: Primitive) -> bool:
    """True if a mesh can be made of a primitive; lines have no surface."""
    return primitive.mode not in _LINES


def size_of(primitive: Primitive, accessors: Accessors, what: str) -> Size:
    """The size of the mesh that a primitive will be; ``what`` names the primitive in errors.

    Raises ``SceneError``, and ``BudgetError`` if the primitive names too many accessors.
    """
    accessors.tell_looked_up(len(primitive.attributes))
    vertices = _check_counts(primitive, accessors, what)
    named = primitive.indices
    corners = vertices if named is None else accessors.count_of(named, what)
    if primitive.mode == _POINTS:
        corners = 0
    elif primitive.mode != _TRIANGLES:
        corners = 3 * max(corners - 2, 0)
    return Size(vertices, corners, "NORMAL" in primitive.attributes)


def mesh_of(
    primitive: Primitive, accessors: Accessors, weights: Sequence[float], what: str
) -> Mesh:
    """The mesh of a primitive. The channels ``morph_…`` lead to the shape that its targets make
    together with these weights. Raises ``SceneError``; ``what`` names the primitive in it."""
    with np.errstate(all="ignore"):  # Infinities and NaNs are refused below.
        channels, triangles = _made(primitive, accessors, weights, what)
        rounded = {name: _single(values) for name, values in channels.items()}
    try:
        return Mesh(rounded, triangles)
    except MeshError as error:
        raise SceneError(f"{what}: {error}") from None


def _made(
    primitive: Primitive, accessors: Accessors, weights: Sequence[float], what: str
) -> tuple[Channels, Indices]:
    """The channels and triangles, complete."""
    named = (primitive.attributes, *primitive.targets)
    accessors.tell_looked_up(sum(1 + len(each) for each in named))
    count = accessors.count_of(primitive.attributes["POSITION"], what)
    channels = _channels(primitive, accessors, what)
    corners = _corners(primitive, accessors, count, what)
    triangles = _triangles(primitive.mode, corners, what)
    if triangles.size and triangles.max() >= count:
        raise SceneError(f"{what}: an index is {triangles.max()}, and there are {count} vertices")
    if primitive.targets:
        channels |= _morphs(primitive, accessors, weights, count, what)
    if "normal" not in channels:
        channels, triangles = _flat(channels, triangles)
    _fill(channels, triangles)
    return channels, triangles


def _single(values: NDArray[Any]) -> NDArray[Any]:
    """The numbers as a GPU gets them."""
    return values.astype(np.float32).astype(np.float64) if values.dtype.kind == "f" else values


def _check_counts(primitive: Primitive, accessors: Accessors, what: str) -> int:
    """The number of vertices, which is that of every attribute."""
    if "POSITION" not in primitive.attributes:
        raise SceneError(f"{what}: it has no positions")
    counts = {name: accessors.count_of(index, what) for name, index in primitive.attributes.items()}
    count = counts["POSITION"]
    for name, other in counts.items():
        if other != count:
            raise SceneError(f"{what}: it has {count} positions, and {other} of {short(name)}")
    return count


def _channels(primitive: Primitive, accessors: Accessors, what: str) -> Channels:
    """The channels of the attributes that a mesh has a channel for."""
    found: Channels = {}
    for attribute, index in primitive.attributes.items():
        place = f"{what}, {attribute}"
        match attribute:
            case "POSITION" | "NORMAL":
                found[attribute.lower()] = accessors.floats(index, "VEC3", place)
            case "TANGENT" | "WEIGHTS_0":
                name = "tangent" if attribute == "TANGENT" else "weights"
                found[name] = accessors.floats(index, "VEC4", place)
            case "TEXCOORD_0" | "TEXCOORD_1":
                name = "uv" if attribute == "TEXCOORD_0" else "uv2"
                found[name] = accessors.floats(index, "VEC2", place)
            case "JOINTS_0":
                found["joints"] = accessors.integers(index, "VEC4", place)
            case "COLOR_0":
                found["color"] = _color(index, accessors, place)
            case _:
                _check_name(attribute, what)
    return found


def _check_name(attribute: str, what: str) -> None:
    """Refuse an attribute that the specification does not allow; others are left out."""
    if not re.fullmatch(r"_.*|(TEXCOORD|COLOR|JOINTS|WEIGHTS)_[0-9]+", attribute):
        raise SceneError(f"{what}: there is no attribute {short(attribute)!r}")


def _color(index: int, accessors: Accessors, what: str) -> Floats:
    if accessors.type_of(index, what) == "VEC4":
        return accessors.floats(index, "VEC4", what)
    color = accessors.floats(index, "VEC3", what)
    return np.concatenate([color, np.ones((len(color), 1))], 1)


def _corners(primitive: Primitive, accessors: Accessors, count: int, what: str) -> Indices:
    """The vertices in the order in which they are drawn."""
    if primitive.indices is None:
        return np.arange(count)
    return accessors.integers(primitive.indices, "SCALAR", f"{what}, indices").ravel()


def _triangles(mode: int, corners: Indices, what: str) -> Indices:
    """Three vertices for each triangle, counter-clockwise; none for points."""
    if mode == _POINTS:
        return np.zeros((0, 3), np.int64)
    if mode == _TRIANGLES:
        if len(corners) % 3:
            raise SceneError(f"{what}: {len(corners)} corners do not make triangles")
        return corners.reshape(-1, 3)
    first = np.arange(max(len(corners) - 2, 0))
    if mode == _FAN:
        return np.stack([corners[first + 1], corners[first + 2], corners[0 * first]], 1)
    odd = first % 2
    return np.stack([corners[first], corners[first + 1 + odd], corners[first + 2 - odd]], 1)


def _morphs(
    primitive: Primitive, accessors: Accessors, weights: Sequence[float], count: int, what: str
) -> Channels:
    """The sum of all morph targets by their weights: differences by attribute.

    Tangents that the file lacks are made later, those of the changed shape as well.
    """
    if len(weights) != len(primitive.targets):
        raise SceneError(
            f"{what}: it has {len(primitive.targets)} morph targets, and {len(weights)} weights"
        )
    found: Channels = {name: np.zeros((count, 3)) for name in _MORPHS.values()}
    for number, (target, weight) in enumerate(zip(primitive.targets, weights, strict=True)):
        for attribute, channel in _MORPHS.items():
            if attribute in target:
                place = f"{what}, {attribute} of morph target {number}"
                moved = accessors.floats(target[attribute], "VEC3", place)
                if len(moved) != count:
                    raise SceneError(f"{place}: it moves {len(moved)} of {count} vertices")
                found[channel] += weight * moved
    return found


_MORPHS = {
    "POSITION": "morph_position", "NORMAL": "morph_normal", "TANGENT": "morph_tangent",
}  # fmt: skip
"""For each attribute of a morph target that is read, the channel of its changes."""


def _turning(channels: Channels, triangles: Indices) -> Floats:
    """The change of the tangents on the way to the shape that the morph targets make."""
    changed = channels | {
        name: channels[name] + channels[f"morph_{name}"] for name in ("position", "normal")
    }
    changed["normal"] = _unit(changed["normal"], (0, 1, 0))
    turned: Floats = _tangents(changed, triangles) - channels["tangent"]
    return turned[:, :3]


def _flat(channels: Channels, triangles: Indices) -> tuple[Channels, Indices]:
    """Flat triangles: each has vertices of its own, with its normal, as glTF wants it.

    That is done for a mesh without normals. Points look upwards.
    """
    if not len(triangles):
        return channels | {"normal": _all_alike((0, 1, 0), len(channels["position"]))}, triangles
    corners = triangles.ravel()
    split = {name: values[corners] for name, values in channels.items()}
    split["normal"] = _flat_normals(split["position"])
    if "morph_position" in split:
        changed = _flat_normals(split["position"] + split["morph_position"])
        split["morph_normal"] = changed - split["normal"]
    return split, np.arange(len(corners)).reshape(-1, 3)


def _flat_normals(corners: Floats) -> Floats:
    """The normal of each triangle, for each of its corners, which follow each other."""
    a, b, c = (corners[side::3] for side in range(3))
    return np.repeat(_unit(np.cross(b - a, c - a), (0, 1, 0)), 3, axis=0)


def _fill(channels: Channels, triangles: Indices) -> None:
    """Add what materials may read and the file lacks: neutral values, and tangents."""
    count = len(channels["position"])
    for name, neutral in _NEUTRAL.items():
        if name not in channels:
            channels[name] = neutral(count)
    channels["normal"] = _unit(channels["normal"], (0, 1, 0))
    if "tangent" not in channels:
        channels["tangent"] = _tangents(channels, triangles)
        if "morph_position" in channels:
            channels["morph_tangent"] = _turning(channels, triangles)


def _all_alike(value: Sequence[float], count: int) -> Floats:
    return np.tile(np.array(value, np.float64), (count, 1))


_NEUTRAL: Mapping[str, Callable[[int], NDArray[Any]]] = {
    "uv": lambda count: _all_alike((0, 0), count),
    "uv2": lambda count: _all_alike((0, 0), count),
    "color": lambda count: _all_alike((1, 1, 1, 1), count),
    "joints": lambda count: np.zeros((count, 4), np.int64),
    "weights": lambda count: _all_alike((1, 0, 0, 0), count),
}


def _tangents(channels: Channels, triangles: Indices) -> Floats:
    """Tangents along u (Lengyel): of each triangle by its size on the surface, then perpendicular
    to the normal; the sign says whether v runs against or along the third axis."""
    position, normal, uv = channels["position"], channels["normal"], channels["uv"]
    along_u, along_v = np.zeros_like(position), np.zeros_like(position)
    a, b, c = triangles.T
    edge1, edge2 = position[b] - position[a], position[c] - position[a]
    (u1, v1), (u2, v2) = (uv[b] - uv[a]).T, (uv[c] - uv[a]).T
    turn = np.sign(u1 * v2 - u2 * v1)[:, None]
    for corner in (a, b, c):
        np.add.at(along_u, corner, turn * (edge1 * v2[:, None] - edge2 * v1[:, None]))
        np.add.at(along_v, corner, turn * (edge2 * u1[:, None] - edge1 * u2[:, None]))
    tangent = along_u - normal * np.sum(normal * along_u, axis=1, keepdims=True)
    tangent = _unit(tangent, (0, 0, 0))
    lost = ~tangent.any(axis=1)
    tangent[lost] = _perpendicular(normal[lost])
    upwards = np.sum(np.cross(normal, tangent) * -along_v, axis=1)
    return np.concatenate([tangent, np.where(upwards < 0, -1.0, 1.0)[:, None]], 1)


def _perpendicular(normal: Floats) -> Floats:
    """Any direction at a right angle to each normal."""
    axis = np.eye(3)[np.argmin(np.abs(normal), axis=1)]
    return _unit(np.cross(axis, normal), (1, 0, 0))


def _unit(vectors: Floats, otherwise: Sequence[float]) -> Floats:
    """The vectors with length one; ``otherwise`` for those without a direction."""
    largest = np.max(np.abs(vectors), axis=1, keepdims=True)
    scaled = vectors / np.where(largest > 0, largest, 1)
    length = np.linalg.norm(scaled, axis=1, keepdims=True)
    return np.where(length > 0, scaled / np.where(length > 0, length, 1), otherwise)
