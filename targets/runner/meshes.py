"""The type of meshes, and the meshes that come with the runner.

``render`` and ``conform`` offer them by name. They lie in the unit ball around the origin (the
corners of the cube and of the plane lie a little outside), with y upwards and triangles
counter-clockwise as seen from outside.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

CHANNELS = {
    "position": 3, "normal": 3, "uv": 2, "tangent": 4, "color": 4, "uv2": 2, "joints": 4,
    "weights": 4,
}  # fmt: skip
"""The values that a mesh may have at each vertex, with the number of lanes.

``uv`` has v pointing downwards. ``tangent`` points along u; its w is the sign with which
``cross(normal, tangent)`` points up, against v. ``color`` is linear, with alpha last. ``uv2`` are
second texture coordinates. ``joints`` are the numbers of bones, and ``weights`` say how much each
of them moves the vertex; they add up to 1.
"""

BONES = 4
"""The number of bones of the meshes here. Each moves a slice of the height, the lowest one
first."""


class MeshError(ValueError):
    """A mesh cannot be used; the text tells people why."""


@dataclass(frozen=True, eq=False, slots=True)
class Mesh:
    """Triangles, with values at each vertex; or, without triangles, points."""

    channels: Mapping[str, NDArray[Any]]
    """Values by channel (see ``CHANNELS``) or name of a vertex input, of shape (vertices,
    lanes)."""
    triangles: Indices
    """Indices of vertices, of shape (triangles, 3); the first of a triangle is its provoking
    vertex."""
    instances: Mapping[str, NDArray[Any]] = field(default_factory=dict)
    """Values by name of a vertex input per instance, of shape (instances, lanes)."""
    instance_count: int = 1
    patches: Indices | None = None
    """Indices of vertices, of shape (patches, points), for materials that divide patches; if there
    are none, ``patches.py`` makes some of the lattices or of the triangles."""
    lattices: tuple[Indices, ...] = ()
    """Indices of vertices, each of shape (rows, columns): the grids that the mesh consists of. The
    front is seen with the first row at the bottom and the first column at the left."""

    def __post_init__(self) -> None:
        if "position" not in self.channels:
            raise MeshError("a mesh needs the channel `position`")
        counts = {name: len(values) for name, values in self.channels.items()}
        if len(set(counts.values())) > 1:
            shown = ", ".join(f"{name} {count}" for name, count in counts.items())
            raise MeshError(f"the channels of a mesh have different numbers of vertices: {shown}")
        for name, values in self.channels.items():
            if values.ndim != 2 or values.shape[1] != CHANNELS.get(name, values.shape[1]):
                raise MeshError(f"the channel `{name}` has the shape {values.shape}")
            if not np.isfinite(values).all():
                raise MeshError(f"the channel `{name}` has values that are not finite")
        if self.triangles.ndim != 2 or self.triangles.shape[1] != 3:
            raise MeshError(f"triangles have the shape {self.triangles.shape} and not (n, 3)")
        if self.triangles.size and not 0 <= self.triangles.min() <= self.triangles.max() < len(
            self
        ):
            raise MeshError(f"a triangle names a vertex that is not one of the {len(self)}")
        if self.patches is not None and self.patches.ndim != 2:
            raise MeshError(f"patches have the shape {self.patches.shape} and not (n, points)")
        if (
            self.patches is not None
            and self.patches.size
            and not (0 <= self.patches.min() <= self.patches.max() < len(self))
        ):
            raise MeshError(f"a patch names a vertex that is not one of the {len(self)}")

    def __len__(self) -> int:
        """The number of vertices."""
        return len(self.channels["position"])


def mesh(name: str) -> Mesh:
    """The mesh with this name in ``MESHES``; ``KeyError`` if there is none."""
    return MESHES[name]()


def farthest_first(mesh: Mesh, eye: Sequence[float]) -> Mesh:
    """The mesh with its triangles sorted for blending, for a viewer at ``eye`` in object space.

    A triangle must be in the picture before nearer ones are blended with it.
    """
    middles = mesh.channels["position"][mesh.triangles].mean(axis=1)
    distances = np.linalg.norm(middles - np.asarray(eye), axis=1)
    return replace(mesh, triangles=mesh.triangles[np.argsort(-distances, kind="stable")])


def sphere(around: int = 64, down: int = 32) -> Mesh:
    """The unit sphere by latitude and longitude; u goes eastwards from the back, v from the north
    pole."""
    u, v = _lattice(around, down)
    longitude, latitude = 2 * np.pi * u - np.pi, np.pi * v
    ring = np.sin(latitude)
    normal = np.stack([ring * np.sin(longitude), np.cos(latitude), ring * np.cos(longitude)], 1)
    tangent = np.stack([np.cos(longitude), 0 * u, -np.sin(longitude)], 1)
    return _made(normal, normal, u, v, tangent, (around, down))


def torus(around: int = 64, across: int = 32, radius: float = 0.7, tube: float = 0.3) -> Mesh:
    """A ring in the xz plane; u goes around the ring, v around the tube from the top outwards."""
    u, v = _lattice(around, across)
    longitude, angle = 2 * np.pi * u - np.pi, 2 * np.pi * v
    out = np.stack([np.sin(longitude), 0 * u, np.cos(longitude)], 1)
    normal = out * np.sin(angle)[:, None] + np.array([0.0, 1.0, 0.0]) * np.cos(angle)[:, None]
    tangent = np.stack([np.cos(longitude), 0 * u, -np.sin(longitude)], 1)
    return _made(out * radius + normal * tube, normal, u, v, tangent, (around, across))


def plane(cells: int = 8) -> Mesh:
    """A square from -1 to 1 in the xy plane that faces +z, upright for a viewer along -z."""
    u, v = _lattice(cells, cells)
    position = np.stack([2 * u - 1, 1 - 2 * v, 0 * u], 1)
    normal = np.broadcast_to([0.0, 0.0, 1.0], position.shape)
    tangent = np.broadcast_to([1.0, 0.0, 0.0], position.shape)
    return _made(position, normal, u, v, tangent, (cells, cells))


def floor(cells: int = 8) -> Mesh:
    """A square from -1 to 1 in the xz plane that faces +y; v points towards +z."""
    upright = plane(cells)
    u, v = upright.channels["uv"].T
    position = upright.channels["position"] @ _LYING
    normal = upright.channels["normal"] @ _LYING
    tangent = upright.channels["tangent"][:, :3]
    return _made(position, normal, u, v, tangent, (cells, cells))


_LYING = np.array([[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]])
"""The rotation that turns rows of an upright square, so that it lies."""


def lies(mesh: Mesh) -> bool:
    """True if all of a mesh has the same height."""
    return bool(np.ptp(mesh.channels["position"][:, 1]) == 0)


def cube(half: float = 0.7) -> Mesh:
    """An axis-aligned cube; each side shows the whole texture."""
    face = plane(1)
    parts = []
    for turn in _SIDES:
        rotation = np.array(turn, float)
        position = (face.channels["position"] + [0, 0, 1]) @ rotation * half
        normal = face.channels["normal"] @ rotation
        tangent = face.channels["tangent"][:, :3] @ rotation
        u, v = face.channels["uv"].T
        parts.append(_made(position, normal, u, v, tangent, (1, 1)))
    channels = {name: np.concatenate([part.channels[name] for part in parts]) for name in CHANNELS}
    triangles = np.concatenate([part.triangles + 4 * i for i, part in enumerate(parts)])
    lattices = tuple(part.lattices[0] + 4 * i for i, part in enumerate(parts))
    return Mesh(channels, triangles, lattices=lattices)


_SIDES = (
    ((1, 0, 0), (0, 1, 0), (0, 0, 1)),
    ((-1, 0, 0), (0, 1, 0), (0, 0, -1)),
    ((0, 0, -1), (0, 1, 0), (1, 0, 0)),
    ((0, 0, 1), (0, 1, 0), (-1, 0, 0)),
    ((1, 0, 0), (0, 0, -1), (0, 1, 0)),
    ((1, 0, 0), (0, 0, 1), (0, -1, 0)),
)
"""For each side of a cube, the directions of the x, y and z axis of the side that faces +z."""


def cylinder(around: int = 64, rows: int = 8, radius: float = 0.6, half: float = 0.7) -> Mesh:
    """An upright cylinder, closed above and below; v goes from the middle of one end to that of the
    other."""
    side = [(radius, half * (1 - 2 * row / rows), 1.0, 0.0) for row in range(rows + 1)]
    above = [(0.0, half, 0.0, 1.0), (radius, half, 0.0, 1.0)]
    below = [(radius, -half, 0.0, -1.0), (0.0, -half, 0.0, -1.0)]
    return _revolved([*above, *side, *below], around)


def capsule(around: int = 64, rows: int = 12, radius: float = 0.45, half: float = 0.5) -> Mesh:
    """An upright cylinder between two half balls, with so many rows each."""
    turns = [row / rows * np.pi / 2 for row in range(rows + 1)]
    above = [(np.sin(t), np.cos(t), half) for t in turns]
    below = [(np.cos(t), -np.sin(t), -half) for t in turns]
    profile = [(radius * r, middle + radius * y, r, y) for r, y, middle in (*above, *below)]
    return _revolved(profile, around)


def knot(along: int = 192, across: int = 16, tube: float = 0.13) -> Mesh:
    """A rope that is knotted twice around a ring and three times through it; u goes along it."""
    u, v = _lattice(along, across)
    around, through, angle = 4 * np.pi * u, 6 * np.pi * u, 2 * np.pi * v
    ring, wound = 0.6, 0.24
    out = np.stack([np.sin(around), 0 * u, np.cos(around)], 1)
    onwards = np.stack([np.cos(around), 0 * u, -np.sin(around)], 1)
    up = np.array([0.0, 1.0, 0.0])
    c, s = np.cos(through)[:, None], np.sin(through)[:, None]
    outwards = c * out + s * up
    middle = ring * out + wound * outwards
    tangent = 2 * (ring + wound * c) * onwards + 3 * wound * (c * up - s * out)
    tangent /= np.linalg.norm(tangent, axis=1, keepdims=True)
    sideways = np.cross(tangent, outwards)
    normal = np.cos(angle)[:, None] * outwards + np.sin(angle)[:, None] * sideways
    return _made(middle + tube * normal, normal, u, v, tangent, (along, across))


def _revolved(profile: Sequence[tuple[float, float, float, float]], around: int) -> Mesh:
    """The surface that a profile sweeps around the y axis.

    The profile goes from the top to the bottom. Each of its points has a distance to the axis, a
    height, and both of its normal. A point that stands twice is an edge.
    """
    rows = np.array(profile)
    steps = np.linalg.norm(np.diff(rows[:, :2], axis=0), axis=1)
    length = np.concatenate([[0.0], np.cumsum(steps)]) / steps.sum()
    u, _ = _lattice(around, len(rows) - 1)
    radius, height, out_share, up_share = (np.repeat(lane, around + 1) for lane in rows.T)
    longitude = 2 * np.pi * u - np.pi
    out = np.stack([np.sin(longitude), 0 * u, np.cos(longitude)], 1)
    up = np.array([0.0, 1.0, 0.0])
    position = radius[:, None] * out + height[:, None] * up
    normal = out_share[:, None] * out + up_share[:, None] * up
    tangent = np.stack([np.cos(longitude), 0 * u, -np.sin(longitude)], 1)
    v = np.repeat(length, around + 1)
    return _made(position, normal, u, v, tangent, (around, len(rows) - 1))


MESHES: Mapping[str, Callable[[], Mesh]] = {
    "sphere": sphere,
    "plane": plane,
    "floor": floor,
    "cube": cube,
    "torus": torus,
    "cylinder": cylinder,
    "capsule": capsule,
    "knot": knot,
}


def _lattice(across: int, down: int) -> tuple[Floats, Floats]:
    """The u and v of the vertices of a grid of cells, row by row."""
    v, u = np.meshgrid(np.linspace(0, 1, down + 1), np.linspace(0, 1, across + 1), indexing="ij")
    return u.ravel(), v.ravel()


def _faces(across: int, down: int) -> Indices:
    """Two triangles for each cell of a grid, counter-clockwise if u goes right and v down."""
    corner = (np.arange(down)[:, None] * (across + 1) + np.arange(across)).ravel()
    right, below = corner + 1, corner + across + 1
    halves = np.stack([corner, below, below + 1, corner, below + 1, right], 1)
    return halves.reshape(-1, 3)


def _made(
    position: Floats, normal: Floats, u: Floats, v: Floats, tangent: Floats, cells: tuple[int, int]
) -> Mesh:
    """A mesh whose vertices are those of a grid of so many cells in both directions."""
    across, down = cells
    upwards = np.ones((len(u), 1))
    color = np.concatenate([0.5 + 0.4 * position, (0.4 + 0.6 * u)[:, None]], 1)
    channels = {
        "position": position,
        "normal": np.array(normal),
        "uv": np.stack([u, v], 1),
        "tangent": np.concatenate([tangent, upwards], 1),
        "color": color,
        "uv2": np.stack([0.5 + 0.45 * position[:, 0], 0.5 - 0.45 * position[:, 1]], 1),
    }
    channels["weights"], joints = _skin(position)
    rounded: dict[str, NDArray[Any]] = {
        name: values.astype(np.float32).astype(float) for name, values in channels.items()
    }
    lattice = np.arange(len(u)).reshape(down + 1, across + 1)[::-1]
    return Mesh(
        {**rounded, "joints": joints},
        _not_degenerate(_faces(across, down), position),
        lattices=(lattice,),
    )


def _skin(position: Floats) -> tuple[Floats, Indices]:
    """The weights and bones of each vertex: the two bones whose centres are around its height."""
    height = np.clip((position[:, 1] + 1) / 2, 0, 1) * (BONES - 1)
    lower = np.minimum(np.floor(height), BONES - 2).astype(np.int64)
    # Weights are multiples of a step that floats represent exactly, so that they add up to 1.
    share = np.round((height - lower) * 64) / 64
    none = np.zeros(len(position))
    return (
        np.stack([1 - share, share, none, none], 1),
        np.stack([lower, lower + 1, 0 * lower, 0 * lower], 1),
    )


def _not_degenerate(triangles: Indices, position: Floats) -> Indices:
    """The triangles that a pole has not shrunk to a line."""
    a, b, c = (position[triangles[:, i]] for i in range(3))
    area = np.linalg.norm(np.cross(b - a, c - a), axis=1)
    kept: Indices = triangles[area > 1e-9]
    return kept
