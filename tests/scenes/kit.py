"""Writes glTF files for tests: as a mapping, with its buffers as data in their URIs."""

from __future__ import annotations

import base64
import json
import struct
from io import BytesIO
from pathlib import Path
from typing import Any

import numpy as np
from PIL import Image

Json = dict[str, Any]

TYPES = {"f4": 5126, "u4": 5125, "u2": 5123, "u1": 5121, "i1": 5120, "i2": 5122}
ELEMENTS = {1: "SCALAR", 2: "VEC2", 3: "VEC3", 4: "VEC4", 16: "MAT4"}


class Builder:
    """A glTF file that grows; ``whole`` is its JSON."""

    def __init__(self) -> None:
        self.whole: Json = {
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [], "meshes": [],
            "accessors": [], "bufferViews": [], "buffers": [],
        }  # fmt: skip

    def add(self, kind: str, **row: Any) -> int:
        """Append a row, and return its number."""
        rows: list[Json] = self.whole.setdefault(kind, [])
        rows.append(row)
        return len(rows) - 1

    def view(self, data: bytes, **more: Any) -> int:
        """A buffer view over bytes of its own."""
        uri = "data:application/octet-stream;base64," + base64.b64encode(data).decode()
        buffer = self.add("buffers", byteLength=len(data), uri=uri)
        return self.add("bufferViews", buffer=buffer, byteLength=len(data), **more)

    def array(self, values: Any, kind: str = "f4", **more: Any) -> int:
        """An accessor of (count, lanes) numbers."""
        array = np.array(values, f"<{kind}")
        lanes = 1 if array.ndim == 1 else array.shape[1]
        return self.add(
            "accessors", bufferView=self.view(array.tobytes()), componentType=TYPES[kind],
            count=len(array), type=ELEMENTS[lanes], **more,
        )  # fmt: skip

    def save(self, folder: Path) -> Path:
        """Write it as ``m.gltf``."""
        path = folder / "m.gltf"
        path.write_text(json.dumps(self.whole))
        return path


def triangle(**primitive: Any) -> Builder:
    """One triangle in the xy plane: the smallest file with a model."""
    made = Builder()
    place = made.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)])
    made.add("meshes", primitives=[{"attributes": {"POSITION": place}, **primitive}])
    made.add("nodes", mesh=0)
    return made


def glb(whole: Json, binary: bytes = b"") -> bytes:
    """A ``.glb`` file."""
    text = json.dumps(whole).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<2I", len(text), 0x4E4F534A) + text
    if binary:
        chunks += struct.pack("<2I", len(binary), 0x004E4942) + binary
    return b"glTF" + struct.pack("<2I", 2, 12 + len(chunks)) + chunks


def png(*color: int) -> bytes:
    """A picture of one texel."""
    stream = BytesIO()
    Image.new("RGBA", (1, 1), color).save(stream, "PNG")
    return stream.getvalue()
