"""glTF files that are broken, absurd or hostile: each is refused by one clear sentence."""

from __future__ import annotations

import base64
import json
import os
import random
import struct
from collections.abc import Callable
from pathlib import Path
from typing import Any
from zlib import compress, crc32

import numpy as np
import pytest

from burnish.compiler.budget import BudgetError, raised
from burnish.targets.runner.scenes.gltf.container import SUPPORTED
from burnish.targets.runner.scenes.gltf.reading import read_gltf
from burnish.targets.runner.scenes.records import SceneError

from .kit import Builder, Json, glb, png, triangle


def refused(path: Path) -> str:
    """The error about a file, without the file's name."""
    with pytest.raises((SceneError, BudgetError)) as caught:
        read_gltf(path)
    return str(caught.value).replace(str(path), "m")


def changed(change: Callable[[Json], Any], folder: Path) -> str:
    """The error about the triangle's file after a change of its JSON."""
    made = triangle()
    change(made.whole)
    return refused(made.save(folder))


def put(*path_and_value: Any) -> Callable[[Json], None]:
    """A change: ``put("nodes", 0, "mesh", 7)``."""
    *path, last, value = path_and_value

    def change(whole: Json) -> None:
        at: Any = whole
        for step in path:
            at = at[step]
        at[last] = value

    return change


def far(whole: Json) -> None:
    whole["nodes"] = [
        {"scale": [1e30] * 3, "children": [1]}, {"scale": [1e30] * 3, "mesh": 0}
    ]  # fmt: skip


OWN_WORDS = {
    "version": (put("asset", "version", "1.0"),
                "m is of version 1.0 of glTF: only 2.0 can be read"),
    "type": (put("asset", "version", 2),
             "m is no glTF 2.0: Expected `str`, got `int` - at `$.asset.version`"),
    "nothing": (lambda whole: whole.pop("asset"),
                "m is no glTF 2.0: Object missing required field `asset`"),
    "extension": (put("extensionsRequired", ["KHR_draco_mesh_compression"]),
                  "m needs the extension KHR_draco_mesh_compression, which is not supported: "
                  f"these are {', '.join(sorted(SUPPORTED))}"),
    "4 GB": (put("accessors", 0, "count", 2**32),
             "m is no glTF 2.0: Expected `int` <= 2147483647 - at `$.accessors[0].count`"),
    "2 GB": (put("accessors", 0, "count", 2**31 - 1),
             "m draws 2,147,483,647 vertices, and the limit is 4,000,000 vertices: "
             "`--budget vertices=2148M` raises it"),
    "2 M": (put("accessors", 0, "count", 900_000),
            "accessor 0: it does not lie within buffer view 0"),
    "negative": (put("accessors", 0, "count", -1),
                 "m is no glTF 2.0: Expected `int` >= 1 - at `$.accessors[0].count`"),
    "offset": (put("accessors", 0, "byteOffset", 4),
               "accessor 0: it does not lie within buffer view 0"),
    "stride": (put("bufferViews", 0, "byteStride", 8),
               "accessor 0: its elements are longer than the 8 bytes between them"),
    "odd stride": (put("bufferViews", 0, "byteStride", 13),
                   "m is no glTF 2.0: Expected `int` that's a multiple of 4 - at "
                   "`$.bufferViews[0].byteStride`"),
    "wide stride": (put("bufferViews", 0, "byteStride", 16),
                    "accessor 0: it does not lie within buffer view 0"),
    "view": (put("bufferViews", 0, "byteLength", 40),
             "buffer view 0: it does not lie within buffer 0"),
    "view's place": (put("bufferViews", 0, "byteOffset", 2**31 - 1),
                     "buffer view 0: it does not lie within buffer 0"),
    "no view": (put("accessors", 0, "bufferView", 9), "accessor 0: there is no buffer view 9"),
    "no buffer": (put("bufferViews", 0, "buffer", 9), "buffer view 0: there is no buffer 9"),
    "short buffer": (put("buffers", 0, "byteLength", 37), "buffer 0: it has 36 of 37 bytes"),
    "empty buffer": (lambda whole: whole["buffers"][0].pop("uri"),
                     "buffer 0: it has neither a URI nor the binary part of a .glb"),
    "other type": (put("accessors", 0, "type", "VEC2"),
                   "mesh 0, primitive 0, POSITION: accessor 0 is VEC2, and not VEC3"),
    "no type": (put("accessors", 0, "componentType", 5124),
                "m is no glTF 2.0: Invalid enum value 5124 - at `$.accessors[0].componentType`"),
    "many zeros": (put("accessors", 0, {"componentType": 5126, "count": 2**31 - 1, "type": "MAT4"}),
                   "m draws 2,147,483,647 vertices, and the limit is 4,000,000 vertices: "
                   "`--budget vertices=2148M` raises it"),
    "sparse": (put("accessors", 0, "sparse", {
                   "count": 4, "indices": {"bufferView": 0, "componentType": 5125},
                   "values": {"bufferView": 0}}),
               "accessor 0: it replaces 4 of 3 elements"),
    "sparse order": (put("accessors", 0, "sparse", {
                   "count": 3, "indices": {"bufferView": 0, "componentType": 5121},
                   "values": {"bufferView": 0}}),
               "accessor 0: the indices of what it replaces do not rise within its count"),
    "no positions": (put("meshes", 0, "primitives", 0, "attributes", {}),
                     "mesh 0, primitive 0: it has no positions"),
    "no attribute": (put("meshes", 0, "primitives", 0, "attributes", "POSITIONS", 0),
                     "mesh 0, primitive 0: there is no attribute 'POSITIONS'"),
    "no accessor": (put("meshes", 0, "primitives", 0, "attributes", "NORMAL", 5),
                    "mesh 0, primitive 0: there is no accessor 5"),
    "no mesh": (put("nodes", 0, "mesh", 7), "node 0: there is no mesh 7"),
    "no material": (put("meshes", 0, "primitives", 0, "material", 3),
                    "mesh 0, primitive 0: there is no material 3"),
    "no skin": (put("nodes", 0, "skin", 1), "node 0: there is no skin 1"),
    "no camera": (put("nodes", 0, "camera", 1), "node 0: there is no camera 1"),
    "no light": (put("nodes", 0, "extensions", {"KHR_lights_punctual": {"light": 1}}),
                 "node 0: there is no light 1"),
    "no scene": (put("scene", 4), "there is no scene 4"),
    "no root": (put("scenes", 0, "nodes", [1]), "scene 0: there is no node 1"),
    "root twice": (put("scenes", 0, "nodes", [0, 0]), "scene 0: it names a node twice"),
    "root below": (put("nodes", [{"children": [1]}, {}]), None),
    "no child": (put("nodes", 0, "children", [8]), "node 0: there is no node 8"),
    "own child": (put("nodes", 0, "children", [0]), "node 0 is below itself"),
    "circle": (put("nodes", [{}, {"children": [2]}, {"children": [3]}, {"children": [1]}]),
               "node 1 is below itself"),
    "two parents": (put("nodes", [{"children": [1, 2]}, {"children": [2]}, {}]),
                    "node 2 has two parents, nodes 0 and 1"),
    "rotation": (put("nodes", 0, "rotation", [0, 0, 0, 0]),
                 "node 0: its rotation is a quaternion of length 0, not 1"),
    "far": (far, "node 1: its place in the world is not finite"),
    "huge": (put("nodes", 0, "matrix", [1e308] * 16),
             "node 0: its place in the world is not finite"),
    "perspective": (put("nodes", 0, "matrix", [*[0.0] * 11, 1, 0, 0, 0, 0]),
                    "node 0: its matrix is no move, turn or scale"),
    "lens": (put("cameras", [{"type": "perspective", "perspective": {"yfov": 5e-324, "znear": 1}}]),
             "m is no glTF 2.0: Expected `float` >= 1e-06 - at `$.cameras[0].perspective.yfov`"),
    "weights": (put("meshes", 0, "primitives", 0, "targets", [{}]), None),
    "too many weights": (
        lambda whole: (put("meshes", 0, "primitives", 0, "targets", [{}])(whole),
                       put("nodes", 0, "weights", [1, 2])(whole)),
        "mesh 0, primitive 0: it has 1 morph targets, and 2 weights"),
    "tags": (put("nodes", 0, "extras", {"tags": [1]}),
             "m is no glTF 2.0: Expected `str`, got `int` - at `$.nodes[0].extras.tags[0]`"),
}  # fmt: skip


@pytest.mark.parametrize("name", OWN_WORDS)
def test_wrong_files(name: str, tmp_path: Path) -> None:
    change, message = OWN_WORDS[name]
    if message is None:
        made = triangle()
        change(made.whole)
        read_gltf(made.save(tmp_path))
    else:
        assert changed(change, tmp_path) == message


@pytest.mark.parametrize("number", ["NaN", "Infinity", "-Infinity", "1e999"])
def test_json_has_only_finite_numbers(number: str, tmp_path: Path) -> None:
    path = triangle().save(tmp_path)
    path.write_text(path.read_text().replace('"mesh": 0', f'"translation": [0, 0, {number}]'))
    assert refused(path).startswith("m is no glTF")


@pytest.mark.parametrize("number", [np.nan, np.inf])
def test_buffers_have_only_finite_numbers(number: float, tmp_path: Path) -> None:
    made = triangle()
    place = made.array([(0, 0, 0), (1, 0, number), (0, 1, 0)])
    made.whole["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = place
    assert refused(made.save(tmp_path)) == (
        "mesh 0, primitive 0, POSITION: accessor 1 has numbers that are not finite"
    )


@pytest.mark.filterwarnings("error")
def test_a_number_that_signals_when_it_is_converted(tmp_path: Path) -> None:
    """Such a NaN makes NumPy warn where others do not."""
    made = triangle()
    matrices = made.array(np.eye(4).reshape(1, 16))
    data = np.eye(4, dtype="<f4").tobytes()[:-4] + bytes.fromhex("0100807f")
    uri = "data:;base64," + base64.b64encode(data).decode()
    made.whole["buffers"][-1]["uri"] = uri
    made.add("skins", joints=[0], inverseBindMatrices=matrices)
    made.whole["nodes"][0]["skin"] = 0
    assert refused(made.save(tmp_path)) == "skin 0: accessor 1 has numbers that are not finite"


def test_numbers_that_no_gpu_can_hold(tmp_path: Path) -> None:
    made = triangle()
    primitive = made.whole["meshes"][0]["primitives"][0]
    primitive["targets"] = [{"POSITION": made.array([(3e38, 0, 0)] * 3)}]
    made.whole["nodes"][0]["weights"] = [1e300]
    assert refused(made.save(tmp_path)) == (
        "mesh 0, primitive 0: the channel `morph_position` has values that are not finite"
    )


def test_an_index_of_no_vertex(tmp_path: Path) -> None:
    made = triangle()
    made.whole["meshes"][0]["primitives"][0]["indices"] = made.array([0, 1, 3], "u4")
    assert refused(made.save(tmp_path)) == (
        "mesh 0, primitive 0: an index is 3, and there are 3 vertices"
    )


def test_corners_that_make_no_triangles(tmp_path: Path) -> None:
    made = triangle()
    made.whole["meshes"][0]["primitives"][0]["indices"] = made.array([0, 1, 2, 0], "u4")
    assert refused(made.save(tmp_path)) == ("mesh 0, primitive 0: 4 corners do not make triangles")


# --- what is no glTF ----------------------------------------------------------------------------


WHOLE = glb(triangle().whole)
NO_GLTF = {
    "empty": (b"", "m is no glTF: Input data was truncated"),
    "text": (b"hello", "m is no glTF: JSON is malformed: invalid character (byte 0)"),
    "list": (b"[]", "m is no glTF 2.0: Expected `object`, got `array`"),
    "bytes": (b'{"asset": {"version": "\xff"}}', "m is no glTF: 'utf-8' codec can't decode"),
    "deep": (b'{"asset": {"version": "2.0"}, "x": ' + b"[" * 10**6,
             "m is no glTF: its JSON is nested too deeply"),
    "header": (WHOLE[:11], "m is cut off: a .glb has a header of 12 bytes"),
    "no chunk": (b"glTF" + struct.pack("<2I", 2, 12), "m is damaged: its first chunk is not JSON"),
    "half": (WHOLE[:-9], f"m is cut off: it has {len(WHOLE) - 9} of {len(WHOLE)} bytes"),
    "version": (b"glTF" + struct.pack("<2I", 1, 12),
                "m is of version 1 of glTF: only version 2 can be read"),
    "chunk": (b"glTF" + struct.pack("<4I", 2, 20, 2**32 - 1, 0x4E4F534A),
              "m is damaged: the chunk at byte 12 is longer than the file"),
    "chunk's header": (b"glTF" + struct.pack("<2I", 2, 15) + b"abc",
                       "m is damaged: byte 12 is in the middle of a chunk's header"),
    "binary first": (b"glTF" + struct.pack("<4I", 2, 20, 0, 0x004E4942),
                     "m is damaged: its first chunk is not JSON"),
}  # fmt: skip


@pytest.mark.parametrize("name", NO_GLTF)
def test_what_is_no_gltf(name: str, tmp_path: Path) -> None:
    content, message = NO_GLTF[name]
    path = tmp_path / "m.glb"
    path.write_bytes(content)
    assert refused(path).startswith(message)


def test_what_is_no_file(tmp_path: Path) -> None:
    assert refused(tmp_path / "none.gltf") == "cannot read m: No such file or directory"
    assert refused(tmp_path) == "cannot read m: it is not a file"
    os.mkfifo(tmp_path / "pipe.gltf")
    assert refused(tmp_path / "pipe.gltf") == "cannot read m: it is not a file"


# --- files that a file names --------------------------------------------------------------------

OUTSIDE = (
    "../secret.bin", "a/../../secret.bin", "%2e%2e/secret.bin", "..%2fsecret.bin",
    "..\\secret.bin", "/etc/passwd", "%2Fetc%2Fpasswd", "//host/share/x", "\\\\host\\share\\x",
    "C:\\x.bin", "C:x.bin", "file:///etc/passwd", "http://localhost/x.bin", "HTTPS://localhost/x",
    "link.bin", "folder/x.bin",
)  # fmt: skip


@pytest.mark.parametrize("uri", OUTSIDE)
def test_nothing_outside_the_folder_is_read(uri: str, tmp_path: Path) -> None:
    """Every file that these name is there, so that one which is read is noticed."""
    (tmp_path / "secret.bin").write_bytes(bytes(36))
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "x.bin").write_bytes(bytes(36))
    folder = tmp_path / "scene"
    (folder / "a").mkdir(parents=True)
    (folder / "link.bin").symlink_to(tmp_path / "secret.bin")
    (folder / "folder").symlink_to(tmp_path / "elsewhere")
    made = triangle()
    made.whole["buffers"][0]["uri"] = uri
    assert refused(made.save(folder)) == (
        f"buffer 0: `{uri}` is not in the folder of the glTF file"
    )


UNREADABLE = {
    "none.bin": "cannot read buffer 0: `none.bin`: No such file or directory",
    "": "buffer 0: `` names no file",
    "a%00b": "buffer 0: `a%00b` names no file",
    "%ff": "buffer 0: `%ff` is no UTF-8",
    "sub": "cannot read buffer 0: `sub`: it is not a file",
    "pipe": "cannot read buffer 0: `pipe`: it is not a file",
    "circle": "cannot read buffer 0: `circle`: ",
    "x" * 5000: "cannot read buffer 0: `" + "x" * 60 + "…`: File name too long",
    "data:,abc": "buffer 0: a URI of data has to be in base64",
    "data:;base64,a*b=": "buffer 0: the data in its URI is no base64",
    "data:;base64,AAAA": "buffer 0: it has 3 of 36 bytes",
}


@pytest.mark.parametrize("uri", UNREADABLE, ids=[uri[:12] or "empty" for uri in UNREADABLE])
def test_what_cannot_be_read(uri: str, tmp_path: Path) -> None:
    (tmp_path / "sub").mkdir()
    os.mkfifo(tmp_path / "pipe")
    (tmp_path / "circle").symlink_to("circle")
    made = triangle()
    made.whole["buffers"][0]["uri"] = uri
    assert refused(made.save(tmp_path)).startswith(UNREADABLE[uri])


def test_files_in_the_folder_are_read(tmp_path: Path) -> None:
    """Deeper ones, those with odd names, and links that stay inside."""
    data = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], "<f4").tobytes()
    (tmp_path / "deep" / "er").mkdir(parents=True)
    (tmp_path / "deep" / "er" / "ä b.bin").write_bytes(data)
    (tmp_path / "near.bin").symlink_to("deep/er/ä b.bin")
    for uri in ("deep/er/%C3%A4%20b.bin", "./deep/er/ä b.bin", "near.bin"):
        made = triangle()
        made.whole["buffers"][0]["uri"] = uri
        assert len(read_gltf(made.save(tmp_path)).objects) == 1


PICTURES: dict[str, tuple[Json, str]] = {
    "both": ({"uri": "a.png", "bufferView": 0}, "image 0: it has either a URI or a buffer view"),
    "neither": ({}, "image 0: it has either a URI or a buffer view"),
    "no picture": ({"bufferView": 0}, "image 0 is not a picture of a known format: PNG or JPEG"),
    "outside": ({"uri": "../a.png"}, "image 0: `../a.png` is not in the folder of the glTF file"),
    "other format": ({"uri": "a.gif"}, "image 0 is not a picture of a known format: PNG or JPEG"),
    "half": ({"uri": "a.png"}, "cannot read image 0: Truncated File Read"),
}


@pytest.mark.parametrize("name", PICTURES)
def test_pictures(name: str, tmp_path: Path) -> None:
    image, message = PICTURES[name]
    (tmp_path / "a.gif").write_bytes(b"GIF89a" + bytes(20))
    (tmp_path / "a.png").write_bytes(png(1, 2, 3, 4)[:20])
    made = triangle(material=0)
    made.whole["images"] = [image]
    made.whole["textures"] = [{"source": 0}]
    made.whole["materials"] = [{"normalTexture": {"index": 0}}]
    assert refused(made.save(tmp_path)).startswith(message)


def test_textures_without_a_picture(tmp_path: Path) -> None:
    made = triangle(material=0)
    made.whole["materials"] = [{"normalTexture": {"index": 0}}]
    assert refused(made.save(tmp_path)) == "material 0, normal_map: there is no texture 0"
    made.whole["textures"] = [{"source": 3}]
    assert refused(made.save(tmp_path)) == "material 0, normal_map: texture 0 has no picture"


# --- small files that would cost much -----------------------------------------------------------


def zeros(made: Builder, count: int = 2**19) -> int:
    """An accessor of zeros, which take no space in the file."""
    return made.add("accessors", componentType=5126, count=count, type="VEC3")


def test_the_same_vertices_again_and_again(tmp_path: Path) -> None:
    """The limit is smaller here: so many vertices as are allowed take much memory."""
    made = Builder()
    primitive = {"attributes": {"POSITION": zeros(made, 2**9)}, "mode": 0}
    made.add("meshes", primitives=[primitive] * 1000)
    made.add("nodes", mesh=0)
    with raised({"vertices": 2**11}):
        assert refused(made.save(tmp_path)) == (
            "m draws 2,560 vertices, and the limit is 2,048 vertices: `--budget vertices=2560` "
            "raises it"
        )


def test_the_same_numbers_again_and_again(tmp_path: Path) -> None:
    made = Builder()
    place = zeros(made, 2**17)
    targets = [{"POSITION": place}] * 1000
    primitive = {"attributes": {"POSITION": place}, "mode": 0, "targets": targets}
    made.add("meshes", primitives=[primitive])
    made.add("nodes", mesh=0)
    assert refused(made.save(tmp_path)) == (
        "reading m takes 67,300,026 numbers, and the limit is 67,108,864 numbers: "
        "`--budget numbers=68M` raises it"
    )


def test_too_many_objects(tmp_path: Path) -> None:
    made = triangle()
    made.whole["nodes"] = [{"mesh": 0}] * (2**16 + 1)
    made.whole["scenes"] = [{"nodes": list(range(2**16 + 1))}]
    assert refused(made.save(tmp_path)) == (
        "m has 65,537 objects, and the limit is 4,096 objects: `--budget objects=66k` raises it"
    )


def test_damage_is_reported_and_nothing_else_happens(tmp_path: Path) -> None:
    """Random changes of a file's text: it is read, or refused by a ``SceneError``."""
    made = triangle(material=0)
    made.whole["materials"] = [{"normalTexture": {"index": 0}}]
    made.whole["textures"] = [{"source": 0}]
    made.whole["images"] = [{"bufferView": made.view(png(1, 2, 3, 4))}]
    whole, chance = json.dumps(made.whole).encode(), random.Random(7)
    refusals = 0
    for _ in range(400):
        content = bytearray(whole)
        for _ in range(chance.randint(1, 6)):
            at = chance.randrange(len(content))
            content[at : at + chance.randint(0, 3)] = chance.choice(
                (b"", b"9", b"-1", b"null", b'"', b"[]", b"1e9", b"\xff", b"{")
            )
        path = tmp_path / "m.gltf"
        path.write_bytes(content)
        try:
            read_gltf(path)
        except (SceneError, BudgetError):
            refusals += 1
    assert refusals > 200


def test_too_many_primitives_are_refused_before_any_is_made(tmp_path: Path) -> None:
    """One primitive is a few bytes in the file, and a mesh in memory."""
    made = triangle()
    made.whole["meshes"][0]["primitives"] *= 2**16 + 1
    made.whole["accessors"] = []  # whoever made the first mesh would miss this
    assert refused(made.save(tmp_path)) == (
        "m has 65,537 objects, and the limit is 4,096 objects: `--budget objects=66k` raises it"
    )


@pytest.mark.parametrize(
    ("width", "height", "message"),
    [
        (0, 0, "image 0 is not a picture of a known format: PNG or JPEG"),
        (60_000, 60_000, "image 0 is too large: no side may have over 8192"),
        (20_000, 1, "image 0 has 20000 x 1 texels, and no side may have more than 8192"),
    ],
)
def test_pictures_that_claim_another_size_than_they_have(
    width: int, height: int, message: str, tmp_path: Path
) -> None:
    def chunk(name: bytes, data: bytes) -> bytes:
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", crc32(name + data))

    header = struct.pack(">2I5B", width, height, 8, 6, 0, 0, 0)
    parts = (b"IHDR", header), (b"IDAT", compress(bytes(1000))), (b"IEND", b"")
    picture = b"\x89PNG\r\n\x1a\n" + b"".join(chunk(*part) for part in parts)
    uri = "data:image/png;base64," + base64.b64encode(picture).decode()
    made = triangle(material=0)
    texture = made.add("textures", source=made.add("images", uri=uri))
    made.add("materials", pbrMetallicRoughness={"baseColorTexture": {"index": texture}})
    assert refused(made.save(tmp_path)) == message
