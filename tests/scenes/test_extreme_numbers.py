"""Numbers at the ends of what floats can be: drawn or refused, without a warning of NumPy."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.compiler.budget import BudgetError
from burnish.targets.runner.frames.by_reference import ReferenceFrames
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.staging import staged
from burnish.targets.runner.frames.subjects import FrameSubject
from burnish.targets.runner.instances.values import ParameterError
from burnish.targets.runner.scenes.gltf.reading import read_gltf
from burnish.targets.runner.scenes.records import SceneError

from ..fuzz.hostile.scene_bytes import rich
from .kit import Json

FRAME = """\
import std.gltf.{MetallicRoughness, PunctualPoint, PunctualSpot}
import std.lights.{Directional}

material Scanned : MetallicRoughness {}
rig Studio { sun : Directional  lamps : PunctualPoint[<= 4]  torch : PunctualSpot }
frame Shown { models scene  shown = Forward(scene)  output picture = shown.color }
"""

LAYERED = FRAME.replace("std.gltf.{MetallicRoughness, ", "std.gltf.{").replace(
    "material Scanned : MetallicRoughness",
    "import std.gltf_layers.{Anisotropy, Dispersion, FileSurface, Ior, Iridescence, Specular}\n"
    "import std.gltf_layers.{Transmission, Volume}\n"
    "material Scanned : FileSurface + Anisotropy + Dispersion + Ior + Iridescence + Specular\n"
    "    + Transmission + Volume",
)

VALUES = (1e38, -1e38, 3.4e38, 1e154, 1e300, -1.7e308, 5e-324, 1e-45, -0.0, 1e20)

PLACES: Sequence[tuple[Any, ...]] = (
    ("nodes", 2, "translation"), ("nodes", 2, "translation", 0), ("nodes", 2, "scale"),
    ("nodes", 2, "scale", 1), ("nodes", 2, "rotation"), ("nodes", 2, "rotation", 3),
    ("nodes", 1, "weights", 0), ("nodes", 3, "matrix", 12), ("nodes", 3, "matrix", 15),
    ("nodes", 3, "matrix", 5), ("nodes", 4, "translation", 2), ("nodes", 4, "scale"),
    ("cameras", 0, "perspective", "yfov"), ("cameras", 0, "perspective", "znear"),
    ("cameras", 0, "perspective", "zfar"), ("cameras", 1, "orthographic", "xmag"),
    ("cameras", 1, "orthographic", "ymag"), ("cameras", 1, "orthographic", "znear"),
    ("cameras", 1, "orthographic", "zfar"), ("materials", 0, "normalTexture", "scale"),
    ("materials", 0, "alphaCutoff"), ("materials", 0, "emissiveFactor", 0),
    ("extensions", "KHR_lights_punctual", "lights", 0, "intensity"),
    ("extensions", "KHR_lights_punctual", "lights", 0, "range"),
    ("extensions", "KHR_lights_punctual", "lights", 0, "spot", "innerConeAngle"),
)  # fmt: skip
"""The paths of numbers, or of lists of numbers that all become the same."""


EXTENSIONS: Sequence[tuple[Any, ...]] = tuple(
    ("materials", 0, "extensions", f"KHR_materials_{name}", *place)
    for name, *place in (
        ("anisotropy", "anisotropyRotation"), ("dispersion", "dispersion"), ("ior", "ior"),
        ("iridescence", "iridescenceIor"), ("iridescence", "iridescenceThicknessMaximum"),
        ("specular", "specularColorFactor"), ("volume", "thicknessFactor"),
        ("volume", "attenuationDistance"),
        ("volume", "thicknessTexture", "extensions", "KHR_texture_transform", "offset"),
        ("volume", "thicknessTexture", "extensions", "KHR_texture_transform", "rotation"),
        ("volume", "thicknessTexture", "extensions", "KHR_texture_transform", "scale"),
    )
)  # fmt: skip
"""Those in extensions of the material."""


@pytest.fixture(scope="module")
def frame(tmp_path_factory: pytest.TempPathFactory) -> FrameSubject:
    return compiled(FRAME, tmp_path_factory.mktemp("frame"))


@pytest.fixture(scope="module")
def layered(tmp_path_factory: pytest.TempPathFactory) -> FrameSubject:
    return compiled(LAYERED, tmp_path_factory.mktemp("layered"))


def compiled(text: str, folder: Path) -> FrameSubject:
    path = folder / "f.burnish"
    path.write_text(text)
    (found,) = burnish.compile(path, ("wgsl",)).frames
    return found


def seen() -> Json:
    """The file, with its models before its first camera."""
    whole = rich().whole
    whole["nodes"][2]["translation"] = [-0.5, -0.25, 0.0]
    whole["nodes"][3]["matrix"][14] = 1.0
    return whole


def scenes(place: Sequence[Any], values: Sequence[float]) -> Iterator[Json]:
    """The file with each value at this place, seen by the camera which that may belong to."""
    for value in values:
        whole = seen()
        whole["nodes"][2]["scale"] = whole["nodes"][4]["scale"] = [1.0, 1.0, 1.0]
        whole["nodes"][4]["translation"] = [0.0, 0.0, 0.0]
        if place[:2] == ("cameras", 1):
            del whole["nodes"][3]["camera"]
        at: Any = whole
        for step in place[:-1]:
            at = at[step]
        several = isinstance(at.get(place[-1]) if isinstance(at, dict) else at[place[-1]], list)
        at[place[-1]] = [value] * len(at[place[-1]]) if several else value
        yield whole


@pytest.mark.parametrize("place", PLACES, ids=lambda place: ".".join(map(str, place)))
@pytest.mark.filterwarnings("error")
def test_extreme_numbers(place: Sequence[Any], frame: FrameSubject, tmp_path: Path) -> None:
    check_extremes(place, VALUES, frame, tmp_path / "m.gltf")


@pytest.mark.parametrize("place", EXTENSIONS, ids=lambda place: ".".join(map(str, place[3:])))
@pytest.mark.filterwarnings("error")
def test_extreme_numbers_of_extensions(
    place: Sequence[Any], layered: FrameSubject, tmp_path: Path
) -> None:
    check_extremes(place, VALUES[::3], layered, tmp_path / "m.gltf")


def check_extremes(
    place: Sequence[Any], values: Sequence[float], frame: FrameSubject, path: Path
) -> None:
    for whole in scenes(place, values):
        path.write_text(json.dumps(whole))
        try:
            drawing = ReferenceFrames(
                FrameHost(frame, staged(read_gltf(path), ["Scanned"], []), (8, 8))
            )
            drawing.draw()
        except (BudgetError, SceneError, ParameterError) as error:
            assert len(str(error)) < 300
            continue
        assert drawing.output("picture").levels[0].shape[2:4] == (8, 8)


def test_the_scene_is_seen(frame: FrameSubject, tmp_path: Path) -> None:
    """This proves that the pictures above show the scene."""
    path = tmp_path / "m.gltf"
    path.write_text(json.dumps(seen()))
    drawing = ReferenceFrames(FrameHost(frame, staged(read_gltf(path), ["Scanned"], []), (8, 8)))
    drawing.draw()
    assert np.ptp(drawing.output("picture").levels[0][0]) > 0
