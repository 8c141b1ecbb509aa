"""Mutates glTF files: the values of their JSON, and their bytes.

``mutated`` makes any number of files of a few good ones. Whatever is in such a file, reading it
ends with a scene or with one of the errors in ``TOLD``, whose text is a sentence.
"""

from __future__ import annotations

import base64
import json
import struct
from collections.abc import Callable, Sequence
from copy import deepcopy
from io import BytesIO
from pathlib import Path
from random import Random
from typing import Any

import numpy as np
from PIL import Image

from burnish.compiler.budget import BudgetError
from burnish.targets.runner.scenes.records import SceneError

from ...scenes.kit import Builder, Json, glb, png, triangle

TOLD = (SceneError, BudgetError)
"""The errors that reading a scene may raise."""

_NUMBERS: Sequence[object] = (
    0, -0.0, 1, -1, 2, 3, 4, 5, 7, 255, 256, 5121, 5126, 65535, 65536, 10**6, 2**31 - 1, 2**31,
    2**32, 2**63, 2**64, 10**30, 0.5, 1e-45, 1e-320, 1e38, -1e38, 3.4e38, 3.5e38, 1e154, 1e300,
    -1.7e308, float("inf"), float("-inf"), float("nan"),
)  # fmt: skip
_OTHERS: Sequence[object] = (
    None, True, False, "", "a", "..", "../m.gltf", "%2e%2e%2fm.gltf", "/dev/zero", "file:///m",
    "m.gltf", ".", "a\0b", "a\nb\x1b[31m", "\ud800", "data:;base64,AAAA", "data:;base64,A", "data:",
    "SCALAR", "MAT4", "VEC3", "perspective", "spot", "MASK", [], {}, [[]], [0], [0] * 16,
    [1e38] * 3, [1e38] * 16, [0, 0, 0, 1e-30], {"a": 0}, "x" * 20_000,
)  # fmt: skip
_SNIPPETS = (b"", b"9", b"-1", b"null", b'"', b"[]", b"1e9", b"\xff", b"{", b"}", b",", b"\\ud800",
             b"\0", b"1e400", b"NaN", b"-", b".")  # fmt: skip


def seeds() -> list[bytes]:
    """Good files, which have everything that is read."""
    scenes = [triangle().whole, rich().whole, _sparse().whole]
    texts = [json.dumps(whole).encode() for whole in scenes]
    whole = rich().whole
    uri = whole["buffers"][0].pop("uri")
    return [*texts, glb(whole, base64.b64decode(uri.partition(",")[2]))]


def mutated(seed: bytes, chance: Random) -> bytes:
    """A file with a few changes: mostly of its JSON, which stays JSON then."""
    if seed.startswith(b"glTF"):
        return _mutated_container(seed, chance)
    if chance.random() < 0.3:
        return _changed_bytes(seed, chance)
    whole = json.loads(seed)
    for _ in range(chance.choice((1, 1, 1, 2, 3, 5))):
        _change(whole, chance)
    return json.dumps(whole).encode("utf-8", "surrogatepass")


def read(content: bytes, path: Path, reading: Callable[[Path], object]) -> str | None:
    """Write a file and read it: what is told of it, or ``None`` for a scene."""
    path.write_bytes(content)
    try:
        reading(path)
    except TOLD as error:
        return str(error)
    return None


def _mutated_container(seed: bytes, chance: Random) -> bytes:
    (length,) = struct.unpack_from("<I", seed, 12)
    text, rest = seed[20 : 20 + length], seed[20 + length :]
    match chance.randrange(4):
        case 0:
            return _changed_bytes(seed, chance)
        case 1:
            at = chance.randrange(0, 24)
            return seed[:at] + bytes((chance.randrange(256),)) + seed[at + 1 :]
        case 2:
            text = mutated(text.rstrip(), chance)
        case _:
            rest = rest[:8] + _changed_bytes(rest[8:], chance)
    text += b" " * (-len(text) % 4)
    head = struct.pack("<3I", 2, 20 + len(text) + len(rest), len(text))
    return b"glTF" + head + b"JSON" + text + rest


def _changed_bytes(content: bytes, chance: Random) -> bytes:
    found = bytearray(content)
    for _ in range(chance.randint(1, 6)):
        at = chance.randrange(len(found) + 1)
        found[at : at + chance.randint(0, 3)] = chance.choice(_SNIPPETS)
    return bytes(found)


def _change(whole: Any, chance: Random) -> None:
    """Change one value somewhere: another value, another place, or none."""
    places = list(_places(whole))
    if not places:
        return
    holder, key = chance.choice(places)
    match chance.randrange(8):
        case 0 | 1 | 2:
            holder[key] = chance.choice(_NUMBERS)
        case 3:
            holder[key] = deepcopy(chance.choice(_OTHERS))
        case 4:
            other, from_ = chance.choice(places)
            holder[key] = deepcopy(other[from_])
        case 5:
            del holder[key]
        case 6 if isinstance(holder, list):
            holder += deepcopy(holder * chance.choice((1, 2, 50)))
        case _ if isinstance(holder, dict):
            holder[str(chance.choice(places)[1])] = deepcopy(holder[key])
        case _:
            holder.insert(0, chance.choice(_NUMBERS))


def _places(value: Any) -> Any:
    """All places of a JSON value, each as what holds it and a key or an index."""
    waiting = [value]
    while waiting:
        holder = waiting.pop()
        keys = holder if isinstance(holder, dict) else range(len(holder))
        for key in list(keys):
            yield holder, key
            if isinstance(holder[key], dict | list):
                waiting.append(holder[key])


def rich() -> Builder:
    """A scene with a skin, morph targets, materials with pictures, cameras, lights and tags; with
    a single buffer."""
    made = Builder()
    corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)])
    lanes = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}
    kinds = {"f4": 5126, "u2": 5123, "u1": 5121}
    data = bytearray()

    def view(content: bytes) -> int:
        data.extend(bytes(-len(data) % 4))
        at = len(data)
        data.extend(content)
        return made.add("bufferViews", buffer=0, byteOffset=at, byteLength=len(content))

    def array(values: Any, kind: str = "f4", **more: Any) -> int:
        found = np.array(values, f"<{kind}")
        count = 1 if found.ndim == 1 else found.shape[1]
        return made.add(
            "accessors", bufferView=view(found.tobytes()), componentType=kinds[kind],
            count=len(found), type=lanes[count], **more,
        )  # fmt: skip

    attributes = {
        "POSITION": array(corners), "NORMAL": array([(0, 0, 1)] * 4),
        "TANGENT": array([(1, 0, 0, 1)] * 4), "TEXCOORD_0": array(corners[:, :2]),
        "TEXCOORD_1": array(corners[:, :2] * 255, "u1", normalized=True),
        "COLOR_0": array([(1, 0, 0)] * 4), "JOINTS_0": array([(0, 1, 0, 0)] * 4, "u2"),
        "WEIGHTS_0": array([(0.5, 0.5, 0, 0)] * 4),
    }  # fmt: skip
    moved = {"POSITION": array(corners), "NORMAL": array(corners)}
    primitive = {"attributes": attributes, "indices": array([0, 1, 2, 0, 2, 3], "u2"),
                 "material": 0, "targets": [moved, moved]}  # fmt: skip
    plain = {"attributes": {"POSITION": attributes["POSITION"]}}
    made.add("meshes", primitives=[primitive], weights=[0.5, 0.25])
    made.add("meshes", primitives=[{**plain, "mode": mode} for mode in (0, 1, 5, 6)])
    made.add("skins", joints=[1, 2], inverseBindMatrices=array([np.eye(4).ravel()] * 2))
    whole = made.whole
    whole["images"] = [
        {"bufferView": view(png(1, 2, 3, 4)), "mimeType": "image/png"},
        {"uri": "data:image/jpeg;base64," + base64.b64encode(_jpeg()).decode()},
    ]
    whole["samplers"] = [{"wrapS": 33071}]
    whole["textures"] = [{"source": 0, "sampler": 0}, {"source": 1}]
    whole["materials"] = [{
        "name": "m", "emissiveFactor": [1, 0.5, 0], "alphaMode": "MASK", "alphaCutoff": 0.3,
        "pbrMetallicRoughness": {
            "baseColorFactor": [1, 1, 1, 1], "metallicFactor": 0.5, "roughnessFactor": 0.5,
            "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1},
        },
        "normalTexture": {"index": 0, "scale": 2, "texCoord": 1},
        "occlusionTexture": {"index": 1, "strength": 0.5}, "emissiveTexture": {"index": 1},
        "extensions": _extensions(),
    }]  # fmt: skip
    whole["cameras"] = [
        {"type": "perspective", "perspective": {"yfov": 1, "znear": 0.1, "zfar": 10}},
        {"type": "orthographic",
         "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 10}},
    ]  # fmt: skip
    lights = [
        {"type": "spot", "color": [1, 1, 1], "intensity": 3, "range": 5,
         "spot": {"innerConeAngle": 0.1, "outerConeAngle": 0.5}},
        {"type": "point"}, {"type": "directional"},
    ]  # fmt: skip
    whole["extensions"] = {
        "KHR_lights_punctual": {"lights": lights},
        "KHR_materials_variants": {"variants": [{"name": "a"}, {"name": "b"}]},
    }
    shown = {"mappings": [{"material": 0, "variants": [0]}]}
    primitive["extensions"] = {"KHR_materials_variants": shown}
    whole["extensionsUsed"] = ["KHR_lights_punctual", "EXT_other"]
    whole["animations"] = [{}]
    whole["nodes"] = [
        {"children": [1, 2, 3], "scale": [1, 2, 3], "extras": {"tags": ["a", "b"]}},
        {"mesh": 0, "skin": 0, "name": "moved", "weights": [1, 2]},
        {"mesh": 1, "rotation": [0, 0, 0, 1], "translation": [1, 2, 3],
         "extras": {"tags": ["b"]}},
        {"matrix": np.eye(4).ravel().tolist(), "camera": 0},
        *({"extensions": {"KHR_lights_punctual": {"light": n}}} for n in range(3)),
        {"camera": 1, "translation": [0, 0, 5]},
    ]  # fmt: skip
    whole["scenes"] = [{"nodes": [0, 4, 5, 6, 7]}]
    uri = "data:;base64," + base64.b64encode(data).decode()
    whole["buffers"] = [{"byteLength": len(data), "uri": uri}]
    return made


def _extensions() -> Json:
    """Each extension of a material, with textures that lie on it in several ways."""
    moved = {"offset": [0.5, 0.25], "rotation": 1, "scale": [2, -1], "texCoord": 1}
    plain = {"index": 1}
    placed = {"index": 0, "extensions": {"KHR_texture_transform": moved}}
    return {
        "KHR_materials_anisotropy": {"anisotropyStrength": 0.5, "anisotropyRotation": 2,
                                     "anisotropyTexture": placed},
        "KHR_materials_clearcoat": {"clearcoatFactor": 0.5, "clearcoatNormalTexture": placed},
        "KHR_materials_dispersion": {"dispersion": 0.5},
        "KHR_materials_emissive_strength": {"emissiveStrength": 2},
        "KHR_materials_ior": {"ior": 1.25},
        "KHR_materials_iridescence": {"iridescenceFactor": 0.5, "iridescenceIor": 1.5,
                                      "iridescenceThicknessTexture": plain},
        "KHR_materials_sheen": {"sheenColorFactor": [1, 0.5, 0], "sheenColorTexture": plain},
        "KHR_materials_specular": {"specularColorFactor": [2, 1, 1], "specularTexture": placed},
        "KHR_materials_transmission": {"transmissionFactor": 0.5, "transmissionTexture": plain},
        "KHR_materials_unlit": {},
        "KHR_materials_volume": {"thicknessFactor": 2, "thicknessTexture": placed,
                                 "attenuationDistance": 3, "attenuationColor": [1, 0.5, 0]},
    }  # fmt: skip


def _sparse() -> Builder:
    made = triangle()
    changed = made.array([1, 2], "u2")
    values = made.array([(0, 1, 0), (1, 1, 0)])
    accessors: list[Json] = made.whole["accessors"]
    accessors[0]["sparse"] = {
        "count": 2,
        "indices": {"bufferView": accessors[changed]["bufferView"], "componentType": 5123},
        "values": {"bufferView": accessors[values]["bufferView"]},
    }
    made.whole["nodes"][0]["scale"] = [1, 1, 1]
    return made


def _jpeg() -> bytes:
    stream = BytesIO()
    Image.new("RGB", (8, 8), (1, 2, 3)).save(stream, "JPEG")
    return stream.getvalue()
