"""Takes a ``.gltf`` or ``.glb`` file apart: its JSON as records, and the bytes in it.

A record of two bytes, such as ``{}``, takes a hundred in memory. So the values in the JSON are
counted, in its bytes, before records are made of it.
"""

from __future__ import annotations

import struct
from pathlib import Path

import msgspec

from .....compiler.budget import Tally, check
from ...files import FileError, read_file
from ..records import SceneError, short
from .schema import File

SUPPORTED = frozenset({
    "KHR_lights_punctual", "KHR_materials_anisotropy", "KHR_materials_clearcoat",
    "KHR_materials_dispersion", "KHR_materials_emissive_strength", "KHR_materials_ior",
    "KHR_materials_iridescence", "KHR_materials_sheen", "KHR_materials_specular",
    "KHR_materials_transmission", "KHR_materials_unlit", "KHR_materials_variants",
    "KHR_materials_volume", "KHR_mesh_quantization", "KHR_texture_transform",
})  # fmt: skip
"""The extensions that a file may require."""

_MAGIC = b"glTF"
_JSON, _BINARY = 0x4E4F534A, 0x004E4942

_BYTES_OF_VALUE = 90
"""The most memory that a value of JSON takes as a record: measured with arrays of each kind of
record, with nothing in them."""
_BYTES_OF_BYTE = 5
"""The most memory that a byte of JSON takes: itself, and that of a text with a character that takes
four."""


def open_file(path: Path, memory: Tally) -> tuple[File, memoryview | None]:
    """The records of a file, and the binary part of a ``.glb``.

    ``memory`` counts the memory that they take. Raises ``SceneError``, and ``BudgetError`` if that
    is too much.
    """
    try:
        data = memoryview(read_file(path, str(path)))
    except FileError as error:
        raise SceneError(str(error)) from None
    if data[:4] == _MAGIC:
        text, binary = _chunks(data, path)
        memory.add(len(data))
    else:
        text, binary = data, None
    check("document", len(text), f"the JSON of {path} has")
    file = _records(bytes(text), path, memory)
    _check_version(file, path)
    return file, binary


def _chunks(data: memoryview, path: Path) -> tuple[memoryview, memoryview | None]:
    """The JSON and the binary part of a ``.glb``."""
    if len(data) < 12:
        raise SceneError(f"{path} is cut off: a .glb has a header of 12 bytes")
    _magic, version, length = struct.unpack_from("<3I", data)
    if version != 2:
        raise SceneError(f"{path} is of version {version} of glTF: only version 2 can be read")
    if length > len(data):
        raise SceneError(f"{path} is cut off: it has {len(data)} of {length} bytes")
    found: list[tuple[int, memoryview]] = []
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


def _records(text: bytes, path: Path, memory: Tally) -> File:
    values = most_values(text)
    check("values", values, f"the JSON of {path} has")
    memory.add(values * _BYTES_OF_VALUE + len(text) * _BYTES_OF_BYTE)
    try:
        return msgspec.json.decode(text, type=File)
    except msgspec.ValidationError as error:
        raise SceneError(f"{path} is no glTF 2.0: {short(str(error), 300)}") from None
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise SceneError(f"{path} is no glTF: {error}") from None
    except RecursionError:
        raise SceneError(f"{path} is no glTF: its JSON is nested too deeply") from None


def most_values(text: bytes) -> int:
    """The most values that a JSON text can have.

    Each value but the first one follows a comma, or the beginning of a list or an object. Those in
    strings are counted too.
    """
    return 1 + sum(map(text.count, (b",", b"[", b"{")))


def _check_version(file: File, path: Path) -> None:
    needed = file.asset.min_version or file.asset.version
    if needed.partition(".")[0] != "2":
        raise SceneError(f"{path} is of version {short(needed, 20)} of glTF: only 2.0 can be read")
    if unknown := sorted(set(file.extensions_required) - SUPPORTED):
        raise SceneError(
            f"{path} needs the extension {short(unknown[0])}, which is not supported: these are "
            f"{', '.join(sorted(SUPPORTED))}"
        )
