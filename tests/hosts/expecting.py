"""Draws the scenes of ``examples/hosts`` by Burnish's own host, and compares pictures with them."""

from __future__ import annotations

import json
from dataclasses import replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image

import burnish
from burnish.targets.runner.frames.by_route import draw_frames
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import Model, Scenery
from burnish.targets.runner.frames.single import single_frame
from burnish.targets.runner.frames.subjects import PlannedFrame
from burnish.targets.runner.meshes import Mesh
from burnish.targets.runner.pictures import to_image
from burnish.targets.runner.routes import ROUTES
from burnish.targets.runner.runner import Runner
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.textures.texture import Texture
from burnish.targets.toolchain import Toolchain

from .scene import CAMERA, COMMON, SCENE, SIZE

Picture = NDArray[np.uint8]
"""Rows from the top, of pixels with three bytes, encoded as sRGB."""

ROUTE = ROUTES["lavapipe:glsl"]
SCENES = ("plastic", "banner", "shadows")
APART = 2
"""The number of steps of 255 by which a byte may differ."""
SHARE = 0.01
"""The share of pixels that may differ by more: those at edges."""
WHITE = {"diffuse_color": (1, 1, 1), "specular_color": (1, 1, 1)}
"""What the library declares for lights. Scenes of the runner make other colours up."""


def runner() -> Runner:
    """The runner that draws what is expected."""
    return Runner((ROUTE,), parallel=1)


def whole_scene(name: str, drawing: Runner, toolchain: Toolchain) -> Picture:
    """The picture of a scene, as Burnish's own host draws it."""
    document = _document()
    asked = document["scenes"][name]
    host = FrameHost(_frame(name), _scenery(asked["models"]), (SIZE, SIZE))
    for light, values in asked["lights"].items():
        given = values if isinstance(values, list) else [values]
        lamps = [{**WHITE, **each} for each in given]
        host.set(light, lamps if isinstance(values, list) else lamps[0])
    for texture, picture in asked["textures"].items():
        is_color = texture == "albedo"
        host.set(texture, _texture(document["pictures"][picture], srgb=is_color))
    (outputs,) = draw_frames(host, ROUTE, drawing, toolchain)
    (texels, *_) = outputs.values()
    return np.array(to_image(texels[0]))


@cache
def _document() -> Any:
    return json.loads(SCENE.read_text(encoding="utf-8"))


def _frame(name: str) -> PlannedFrame:
    """The scene's frame, or the frame of its only material."""
    found = burnish.compile(COMMON / "materials" / f"{name}.burnish", (ROUTE.profile,))
    return found.frames[0] if found.frames else single_frame(found.materials[0])


def _scenery(rows: list[dict[str, Any]]) -> Scenery:
    bones = np.array([_matrix(bone) for bone in _document()["bones"]])
    models = tuple(
        Model(
            _mesh(row["mesh"]),
            row["material"],
            tuple(map(tuple, _matrix(row["object_to_world"]).tolist())),
            bones=bones,
        )
        for row in rows
    )
    return Scenery(models, Scene(CAMERA))


def _mesh(name: str) -> Mesh:
    channels = dict(_document()["meshes"][name])
    triangles = np.array(channels.pop("indices")).reshape(-1, 3)
    count = len(channels["position"]) // 3
    arrays = {name: np.array(values).reshape(count, -1) for name, values in channels.items()}
    floats = {name: each.astype(float) for name, each in arrays.items() if name != "joints"}
    return Mesh({**arrays, **floats}, triangles)


def _matrix(columns: list[float]) -> NDArray[np.float64]:
    return np.array(columns, float).reshape(4, 4).T


def _texture(picture: dict[str, Any], *, srgb: bool) -> Texture:
    """A picture of one level, as hosts upload it."""
    shape = (picture["height"], picture["width"], 4)
    texels = np.array(picture["rgba"], np.uint8).reshape(shape)
    whole = Texture.of_array(texels, srgb=srgb)
    return replace(whole, levels=whole.levels[:1])


def difference(drawn: Path, wanted: Picture) -> str:
    """What is wrong with a picture that a host has drawn; empty if it is the one that is wanted."""
    with Image.open(drawn) as opened:
        if opened.size != (SIZE, SIZE):
            return f"{drawn.name} has {opened.size} pixels"
        found = np.array(opened.convert("RGBA"))
    if (found[..., 3] < 255).any():
        return f"{drawn.name} is not opaque"
    apart = np.abs(found[..., :3].astype(int) - wanted).max(axis=2)
    wrong = float((apart > APART).mean())
    if wrong <= SHARE:
        return ""
    return (
        f"{drawn.name}: {wrong:.1%} of the pixels are off by more than {APART}, up to {apart.max()}"
    )
