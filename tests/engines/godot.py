"""Draws many pictures by one process of Godot, and has it parse shaders, for tests.

A picture is of one mesh without any light. Its numbers are those that the shader writes, as floats
of 16 bits: nothing maps tones, and nothing is encoded for a screen.
"""

from __future__ import annotations

import base64
import json
import os
import re
import subprocess
import time
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from burnish.targets.runner.drivers.texels import TEXELS
from burnish.targets.runner.meshes import Mesh
from burnish.targets.runner.textures.texture import Texture
from burnish.targets.toolchain.tools import inspect, program, tool_named

MISSING = "not run: godot is not installed"
"""The reason to skip a test; ``tests/suite/account.py`` lists it."""

LIMIT = 240.0
"""The seconds that one process of Godot may take on a busy machine; it is ended then."""
DISPLAY_LIMIT = 20.0
"""The seconds in which a display is there."""

PROJECT = """\
config_version=5

[application]

config/name="pictures"
"""
PARSER = """\
extends SceneTree


func _initialize() -> void:
	for file in DirAccess.get_files_at("res://"):
		if file.ends_with(".gdshader"):
			print("PARSED ", file)
			(load("res://" + file) as Shader).get_shader_uniform_list()
	quit()
"""

EXACT = """\
void vertex() {
    NORMAL = CUSTOM0.xyz;
    TANGENT = CUSTOM1.xyz;
    BINORMAL = cross(NORMAL, TANGENT) * CUSTOM1.w;
    COLOR = CUSTOM2;
"""
"""The beginning of a vertex shader that reads the exact values of the mesh."""

FORMATS = {"rgba8unorm": 5, "rgba8unorm-srgb": 5, "rgba32float": 11}
"""The formats of textures that it can be given, as Godot's numbers of the formats of images."""

Floats = NDArray[Any]


@dataclass(frozen=True, eq=False)
class Picture:
    """What is drawn."""

    name: str
    shader: str
    """The text of the shader."""
    mesh: Mesh
    size: tuple[int, int]
    object_to_world: Floats
    camera_to_world: Floats
    fov: float
    """In degrees, from bottom to top."""
    near: float
    far: float
    values: Mapping[str, tuple[str, Any]]
    """The type and the value of each uniform."""
    textures: Mapping[str, Texture]


class GodotError(Exception):
    """Godot has not drawn; the text is what it said."""


def is_there() -> bool:
    """True if Godot and what it draws with are installed."""
    return all(inspect(tool_named(name)).problem is None for name in ("godot", "xvfb", "lavapipe"))


def parsed(shaders: Mapping[str, str], folder: Path) -> dict[str, str]:
    """What Godot's own parser says of each shader by name: its error, or nothing.

    It needs neither a display nor a driver, and less than a second.
    """
    _project(folder, PARSER)
    for name, text in shaders.items():
        (folder / f"{name}.gdshader").write_text(text, "utf-8")
    said = _godot(folder, "--headless")
    found = dict.fromkeys(shaders, "")
    seen, name = set(), ""
    for line in said.splitlines():
        if line.startswith("PARSED "):
            name = line.removeprefix("PARSED ").removesuffix(".gdshader")
            seen.add(name)
        elif "SHADER ERROR" in line and name:
            found[name] = line.partition("SHADER ERROR: ")[2]
    if seen != set(shaders):
        raise GodotError(said)
    return found


def drawn(pictures: Sequence[Picture], folder: Path) -> dict[str, Floats]:
    """The numbers of each picture, of shape (height, width, 4), by one process of Godot."""
    _project(folder, Path(__file__).with_suffix(".gd").read_text("utf-8"))
    names = {text: f"shader{number}" for number, text in
             enumerate(dict.fromkeys(each.shader for each in pictures))}  # fmt: skip
    for text, name in names.items():
        (folder / f"{name}.gdshader").write_text(exact(text), "utf-8")
    meshes = list({id(each.mesh): each.mesh for each in pictures}.values())
    places = {id(mesh): place for place, mesh in enumerate(meshes)}
    jobs = [_job(each, names[each.shader], places[id(each.mesh)]) for each in pictures]
    asked = {"meshes": list(map(_mesh, meshes)), "pictures": jobs}
    (folder / "jobs.json").write_text(json.dumps(asked), "utf-8")
    with _display() as display:
        said = _godot(
            folder, "--rendering-driver", "vulkan", "--rendering-method", "mobile",
            "--resolution", "64x64", display=display,
        )  # fmt: skip
    found = {}
    for each in pictures:
        file = folder / f"{each.name}.half"
        if not file.is_file():
            raise GodotError(f"{each.name} was not drawn:\n{said}")
        width, height = each.size
        numbers = np.frombuffer(file.read_bytes(), "<f2").astype(np.float64)
        found[each.name] = numbers.reshape(height, width, 4)
    if "ERROR" in said:
        raise GodotError(said)
    return found


def exact(text: str) -> str:
    """A shader that reads the exact normals, tangents and colours of the mesh."""
    if "void vertex() {\n" in text:
        return text.replace("void vertex() {\n", EXACT, 1)
    return text.replace("void fragment() {", f"{EXACT}}}\n\nvoid fragment() {{", 1)


def _project(folder: Path, script: str) -> None:
    (folder / "project.godot").write_text(PROJECT, "utf-8")
    (folder / "main.gd").write_text(script, "utf-8")


def _godot(folder: Path, *options: str, display: str = "") -> str:
    """Run the script of a project; returns what Godot said."""
    found = program("godot", "godot")
    assert found is not None
    (driver,) = (path for path in map(Path, _drivers()) if path.is_file())
    command = [str(found), "--path", str(folder), "--audio-driver", "Dummy", *options]
    home = folder / "home"
    home.mkdir(exist_ok=True)
    process = subprocess.run(
        [*command, "--script", "main.gd"],
        env={
            **os.environ, "HOME": str(home), "XDG_RUNTIME_DIR": str(home), "DISPLAY": display,
            "VK_ICD_FILENAMES": str(driver),
        },
        stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=LIMIT, check=False,
    )  # fmt: skip
    if process.returncode != 0:
        raise GodotError(process.stdout)
    return process.stdout


def _drivers() -> Iterator[str]:
    tool = inspect(tool_named("lavapipe"))
    yield str(tool.paths[0])


@contextmanager
def _display() -> Iterator[str]:
    """A display without a screen, which chooses a free number itself."""
    found = program("xvfb", "Xvfb")
    assert found is not None
    reading, writing = os.pipe()
    process = subprocess.Popen(
        [str(found), "-displayfd", str(writing), "-screen", "0", "64x64x24"],
        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, pass_fds=[writing],
    )  # fmt: skip
    os.close(writing)
    try:
        os.set_blocking(reading, False)
        yield f":{_number(reading)}"
    finally:
        os.close(reading)
        process.terminate()
        process.wait(DISPLAY_LIMIT)


def _number(reading: int) -> str:
    give_up = time.monotonic() + DISPLAY_LIMIT
    said = b""
    while not said.endswith(b"\n"):
        if time.monotonic() > give_up:
            raise GodotError("Xvfb has not started")
        try:
            said += os.read(reading, 64)
        except BlockingIOError:
            time.sleep(0.05)
    return said.decode().strip()


# --- what the script reads -----------------------------------------------------------------------


def _job(picture: Picture, shader: str, mesh: int) -> dict[str, Any]:
    return {
        "name": picture.name, "shader": shader, "mesh": mesh, "size": picture.size,
        "object": picture.object_to_world.tolist(), "camera": picture.camera_to_world.tolist(),
        "fov": picture.fov, "near": picture.near, "far": picture.far,
        "values": {name: _value(*given) for name, given in picture.values.items()},
        "textures": {name: _texture(each) for name, each in picture.textures.items()},
    }  # fmt: skip


def _value(type_: str, value: Any) -> dict[str, Any]:
    kind = re.sub(r"\[\d+\]", "[]", type_)
    return {"type": kind, "lanes": np.asarray(value, np.float64).reshape(-1).tolist()}


def _mesh(mesh: Mesh) -> dict[str, list[Any]]:
    count = len(mesh)
    channels = {name: np.asarray(values, np.float64) for name, values in mesh.channels.items()}
    missing = {"uv2": (count, 2), "color": (count, 4), "tangent": (count, 4)}
    channels = {**{name: np.zeros(shape) for name, shape in missing.items()}, **channels}
    channels["normal4"] = np.concatenate([channels["normal"], np.zeros((count, 1))], axis=1)
    # Fronts are clockwise in Godot.
    turned = mesh.triangles[:, [0, 2, 1]]
    flat = {name: values.reshape(-1).tolist() for name, values in channels.items()}
    return {**flat, "triangles": turned.reshape(-1).tolist()}


def _texture(texture: Texture) -> dict[str, Any]:
    size, count = TEXELS[texture.format].size, len(texture.levels)
    sides = [
        (max(texture.width >> level, 1), max(texture.height >> level, 1)) for level in range(count)
    ]
    is_volume = texture.dimension == "3d"
    images = (
        list(_slices(texture, sides, size)) if is_volume else list(_layers(texture, sides, size))
    )
    return {
        "dimension": texture.dimension, "format": FORMATS[texture.format], "images": images,
        "size": [texture.width, texture.height, texture.depth], "mips": count > 1,
    }  # fmt: skip


def _layers(texture: Texture, sides: list[tuple[int, int]], size: int) -> Iterator[dict[str, Any]]:
    """An image of each layer, with all its levels."""
    for layer in range(texture.depth):
        levels = [
            data[layer * w * h * size : (layer + 1) * w * h * size]
            for data, (w, h) in zip(texture.levels, sides, strict=True)
        ]
        yield _image(*sides[0], b"".join(levels), len(levels) > 1)


def _slices(texture: Texture, sides: list[tuple[int, int]], size: int) -> Iterator[dict[str, Any]]:
    """An image of each slice of each level."""
    for data, (w, h) in zip(texture.levels, sides, strict=True):
        for start in range(0, len(data), w * h * size):
            yield _image(w, h, data[start : start + w * h * size], False)


def _image(width: int, height: int, data: bytes, mips: bool) -> dict[str, Any]:
    text = base64.b64encode(data).decode()
    return {"width": width, "height": height, "bytes": text, "mips": mips}
