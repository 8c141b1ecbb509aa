"""Takes a ``.gltf`` or ``.glb`` file apart: its JSON as records, and the bytes in it."""

from __future__ import annotations

import struct
from pathlib import Path

import msgspec

from ..records import SceneError
from .folder import read_limited
from .schema import File

MAX_JSON = 2**26
"""The most bytes of JSON: 64 MB; geometry and pictures are not in it, or as texts."""
SUPPORTED = frozenset({
    "KHR_lights_punctual", "KHR_materials_emissive_strength", "KHR_mesh_quantization",
})  # fmt: skip
"""The extensions that a file may require."""

_MAGIC = b"glTF"
_JSON, _BINARY = 0x4E4F534A, 0x004E4942


def open_file(path: Path) -> tuple[File, bytes | None]:
    """The records of a file, and the binary part of a ``.glb``. Raises ``SceneError``."""
    data = read_limited(path, str(path))
    if data.startswith(_MAGIC):
        text, binary = _chunks(data, path)
    else:
        text, binary = data, None
    if len(text) > MAX_JSON:
        raise SceneError(f"{path} has {len(text)} bytes of JSON, and may have {MAX_JSON}")
    file = _records(text, path)
    _check_version(file, path)
    return file, binary


def _chunks(data: bytes, path: Path) -> tuple[bytes, bytes | None]:
    """The JSON and the binary part of a ``.glb``."""
    if len(data) < 12:
        raise SceneError(f"{path} is cut off: a .glb has a header of 12 bytes")
    _magic, version, length = struct.unpack_from("<3I", data)
    if version != 2:
        raise SceneError(f"{path} is of version {version} of glTF: only version 2 can be read")
    if length > len(data):
        raise SceneError(f"{path} is cut off: it has {len(data)} of {length} bytes")
    found: list[tuple[int, bytes]] = []
    at = 12
    while at < length and len(found) < 2:
        if at + 8 > length:
            raise SceneError(f"{path} is damaged: byte {at} is in the middle of a chunk's header")
        size, kind = struct.unpack_from("<2I", data, at)
        if at + 8 + size > length:
            raise SceneError(f"{path} is damaged: the chunk at byte {at} is longer than the file")
        found.append((kind, data[at + 8 : at + 8 + size]))
        at += 8 + size
    if not found or found[0][0] != _JSON:
        raise SceneError(f"{path} is damaged: its first chunk is not JSON")
    binary = found[1][1] if len(found) > 1 and found[1][0] == _BINARY else None
    return found[0][1], binary


def _records(text: bytes, path: Path) -> File:
    try:
        return msgspec.json.decode(text, type=File)
    except msgspec.ValidationError as error:
        raise SceneError(f"{path} is no glTF 2.0: {error}") from None
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise SceneError(f"{path} is no glTF: {error}") from None
    except RecursionError:
        raise SceneError(f"{path} is no glTF: its JSON is nested too deeply") from None


def _check_version(file: File, path: Path) -> None:
    needed = file.asset.min_version or file.asset.version
    if needed.partition(".")[0] != "2":
        raise SceneError(f"{path} is of version {needed[:20]} of glTF: only 2.0 can be read")
    if unknown := sorted(set(file.extensions_required) - SUPPORTED):
        raise SceneError(
            f"{path} needs the extension {unknown[0]}, which is not supported: these are "
            f"{', '.join(sorted(SUPPORTED))}"
        )
