"""``python -m burnish.tests.hosts.scene``: writes what the example hosts draw, as ``scene.json``.

A host reads meshes, pictures, bones, the camera and the lights from this file, which is in a form
that any language reads: flat lists of numbers, matrices column by column. A test fails if the file
is not what this module makes.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from burnish.targets.runner.cameras import Camera, looking
from burnish.targets.runner.meshes import sphere

COMMON = Path(__file__).parents[2] / "examples" / "hosts" / "common"
SCENE = COMMON / "scene.json"

SIZE = 256
"""The width and the height of a host's picture."""
CAMERA: Camera = looking(eye=(1.0, 1.3, 3.6), near=0.5, far=12.0)

Floats = NDArray[np.float64]

_JOINTS = 4
_BENDS = (22.0, -48.0, 44.0, -30.0)
"""The angles in degrees by which the bones of the banner turn, from the upper edge downwards."""
_TWIST = 9.0
"""The angle by which each of them also turns around the vertical."""
_TEXELS = 16


def scene() -> dict[str, Any]:
    """The whole document."""
    return {
        "size": [SIZE, SIZE],
        "camera": {
            "eye": list(CAMERA.eye),
            "view_projection": _columns(CAMERA.world_to_clip(1.0)),
        },
        "meshes": {"ball": ball(), "banner": banner(), "floor": floor()},
        "bones": [_columns(bone) for bone in bones()],
        "pictures": {"tiles": tiles(), "threads": threads()},
        "scenes": {
            "plastic": {
                "models": [_model("ball", "Plastic")],
                "textures": {"albedo": "tiles"},
                "lights": {
                    "sun": {"direction": _unit(-1.0, -1.5, -1.0)},
                    "lamps": [
                        {"place": [1.8, 0.6, 1.4], "diffuse_color": [0.5, 0.35, 0.2]},
                        {"place": [-2.0, -0.5, 1.5], "diffuse_color": [0.1, 0.2, 0.5]},
                    ],
                    "torch": {"place": [0.4, 0.9, 3.0], "axis": _unit(-0.1, -0.25, -1.0)},
                },
            },
            "banner": {
                "models": [_model("banner", "Banner", (0.0, 0.0, 0.0), 1.2)],
                "textures": {"normal_map": "threads"},
                "lights": {"sun": {"direction": _unit(0.8, -0.8, -0.7)}},
            },
            "shadows": {
                "models": [
                    _model("ball", "Clay", (0.62, -0.35, 0.25), 0.65),
                    _model("ball", "Slate", (-0.62, 0.15, -0.1), 0.5),
                    _model("floor", "Slate", (0.0, -1.0, 0.0), 3.0),
                ],
                "textures": {},
                "lights": {"lamp": {"place": [-3.0, 4.5, 2.0], "axis": _unit(3.0, -4.8, -2.0)}},
            },
        },
    }


def ball() -> dict[str, Any]:
    """The unit ball, around which a picture repeats four times."""
    mesh = sphere(32, 16)
    channels = {name: mesh.channels[name] for name in ("position", "normal", "uv")}
    channels["uv"] = channels["uv"] * [4, 2]
    return _mesh(channels, mesh.triangles)


def floor() -> dict[str, Any]:
    """A square from -1 to 1 that faces upwards."""
    corners = np.array([[-1.0, 0.0, -1.0], [-1.0, 0.0, 1.0], [1.0, 0.0, -1.0], [1.0, 0.0, 1.0]])
    channels = {
        "position": corners,
        "normal": np.tile([0.0, 1.0, 0.0], (4, 1)),
        "uv": (corners[:, ::2] + 1) / 2,
    }
    return _mesh(channels, np.array([[0, 1, 2], [2, 1, 3]]))


def banner() -> dict[str, Any]:
    """A cloth, twice as high as wide, that faces the viewer; each bone moves a quarter of it."""
    across, down = 8, 16
    row, column = np.divmod(np.arange((across + 1) * (down + 1)), across + 1)
    u, v = column / across, row / down
    bone = np.clip(v * _JOINTS - 0.5, 0, _JOINTS - 1)
    first = np.minimum(bone.astype(int), _JOINTS - 2)
    share, none = bone - first, np.zeros(len(u))
    channels = {
        "position": np.stack([u - 0.5, 1 - 2 * v, none], 1),
        "normal": np.tile([0.0, 0.0, 1.0], (len(u), 1)),
        "tangent": np.tile([1.0, 0.0, 0.0, 1.0], (len(u), 1)),
        "uv": np.stack([u, v], 1),
        "joints": np.stack([first, first + 1, 0 * first, 0 * first], 1),
        "weights": np.stack([1 - share, share, none, none], 1),
    }
    left = np.array([r * (across + 1) + c for r in range(down) for c in range(across)])
    below = left + across + 1
    triangles = np.stack([left, below, left + 1, left + 1, below, below + 1], 1).reshape(-1, 3)
    return _mesh(channels, triangles)


def bones() -> list[Floats]:
    """The transform of each bone of the banner, which hangs from its upper edge."""
    found: list[Floats] = []
    bent = np.eye(4)
    for number, angle in enumerate(_BENDS):
        hinge = np.eye(4)
        hinge[1, 3] = 1 - 2 * number / _JOINTS
        turn = _about(0, angle) @ _about(1, _TWIST)
        bent = bent @ hinge @ turn @ np.linalg.inv(hinge)
        found.append(bent)
    return found


def tiles() -> dict[str, Any]:
    """Colours: two rows of tiles, whose lower right halves are darker, so that one sees a turn."""
    row, column = np.mgrid[0:_TEXELS, 0:_TEXELS]
    light = (row // 8 + column // 8) % 2 == 0
    dark_half = (row % 8 + column % 8) > 7
    shade = np.where(light, 255, 190) - np.where(dark_half, 70, 0)
    return _picture(np.stack([shade, shade, shade], 2))


def threads() -> dict[str, Any]:
    """Normals of threads that cross each other: x along u, y against v."""
    row, column = np.mgrid[0:_TEXELS, 0:_TEXELS]
    across = 0.35 * np.sin(2 * np.pi * (column + 0.5) / 4)
    along = 0.2 * np.sin(2 * np.pi * (row + 0.5) / 8)
    normal = np.stack([across, along, np.ones_like(across)], 2)
    normal /= np.linalg.norm(normal, axis=2, keepdims=True)
    return _picture(np.rint((normal + 1) / 2 * 255).astype(int))


def _picture(texels: NDArray[Any]) -> dict[str, Any]:
    """A picture of bytes, its top row first."""
    opaque = np.full((*texels.shape[:2], 1), 255)
    rgba = np.concatenate([texels, opaque], 2)
    return {"width": _TEXELS, "height": _TEXELS, "rgba": rgba.reshape(-1).astype(int).tolist()}


def _mesh(channels: Mapping[str, NDArray[Any]], triangles: NDArray[Any]) -> dict[str, Any]:
    listed = {name: _numbers(values) for name, values in channels.items()}
    return {**listed, "indices": triangles.reshape(-1).tolist()}


def _model(
    mesh: str, material: str, place: Sequence[float] = (0.0, 0.0, 0.0), size: float = 1.0
) -> dict[str, Any]:
    placed = np.diag([size, size, size, 1.0])
    placed[:3, 3] = place
    return {"mesh": mesh, "material": material, "object_to_world": _columns(placed)}


def _about(axis: int, degrees: float) -> Floats:
    """The rotation around an axis."""
    turn, angle = np.eye(4), np.radians(degrees)
    one, other = (axis + 1) % 3, (axis + 2) % 3
    turn[one, one] = turn[other, other] = np.cos(angle)
    turn[other, one] = np.sin(angle)
    turn[one, other] = -turn[other, one]
    return turn


def _unit(*lanes: float) -> list[float]:
    return _numbers(np.array(lanes) / np.linalg.norm(lanes))


def _columns(matrix: Floats) -> list[float]:
    return _numbers(matrix.T)


def _numbers(values: NDArray[Any]) -> list[Any]:
    """The numbers one behind the other, with as many digits as a picture of bytes shows."""
    flat = np.round(values, 5).reshape(-1) + 0  # No number is -0.
    return [int(each) if each == int(each) else each for each in flat.tolist()]


def text(value: Any = None, indent: str = "") -> str:
    """The document as JSON, with each list of numbers in one line."""
    value = scene() if value is None else value
    if isinstance(value, dict) and any(isinstance(each, dict | list) for each in value.values()):
        rows = [f"{json.dumps(k)}: {text(v, indent + '  ')}" for k, v in value.items()]
        opening, closing = "{", "}"
    elif isinstance(value, list) and value and not isinstance(value[0], int | float):
        rows = [text(each, indent + "  ") for each in value]
        opening, closing = "[", "]"
    else:
        return json.dumps(value)
    return f"{opening}\n{indent}  " + f",\n{indent}  ".join(rows) + f"\n{indent}{closing}"


if __name__ == "__main__":
    SCENE.write_text(text() + "\n", encoding="utf-8")
