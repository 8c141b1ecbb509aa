"""The scenes that are read from glTF files, against values worked out by hand."""

from __future__ import annotations

import math
from pathlib import Path

import numpy as np
import pytest

from burnish.targets.runner.scenes.gltf.reading import read_gltf

from .kit import Builder, glb, png, triangle

HALF = math.sqrt(0.5)


def test_a_triangle_gets_all_that_drawing_needs(tmp_path: Path) -> None:
    scene = read_gltf(triangle().save(tmp_path))
    (model,) = scene.objects
    channels = model.mesh.channels
    assert model.name == "node 0"
    assert model.mesh.triangles.tolist() == [[0, 1, 2]]
    assert channels["normal"].tolist() == [[0, 0, 1]] * 3
    assert channels["color"].tolist() == [[1, 1, 1, 1]] * 3
    assert channels["weights"].tolist() == [[1, 0, 0, 0]] * 3
    assert np.allclose(np.sum(channels["tangent"][:, :3] * channels["normal"], axis=1), 0)
    assert (scene.cameras, scene.lamps, scene.notes) == ((), (), ())


def test_attributes_have_their_numbers(tmp_path: Path) -> None:
    made = Builder()
    attributes = {
        "POSITION": made.array([(0, 0, 0), (2, 0, 0), (0, 2, 0)]),
        "NORMAL": made.array([(0, 0, 2)] * 3),
        "TEXCOORD_0": made.array([(0, 255), (255, 255), (0, 0)], "u1", normalized=True),
        "TEXCOORD_1": made.array([(0.5, 0.25)] * 3),
        "COLOR_0": made.array([(65535, 0, 13107)] * 3, "u2", normalized=True),
        "JOINTS_0": made.array([(3, 1, 0, 0)] * 3, "u1"),
        "WEIGHTS_0": made.array([(0.75, 0.25, 0, 0)] * 3),
        "_OWN": made.array([1.0, 2, 3]),
    }
    made.add(
        "meshes", primitives=[{"attributes": attributes, "indices": made.array([2, 0, 1], "u2")}]
    )
    made.add("nodes", mesh=0)
    (model,) = read_gltf(made.save(tmp_path)).objects
    channels = model.mesh.channels
    assert model.mesh.triangles.tolist() == [[2, 0, 1]]
    assert channels["uv"].tolist() == [[0, 1], [1, 1], [0, 0]]
    assert channels["uv2"].tolist() == [[0.5, 0.25]] * 3
    assert np.allclose(channels["color"], [[1, 0, 0.2, 1]] * 3)
    assert channels["joints"].tolist() == [[3, 1, 0, 0]] * 3
    assert channels["weights"].tolist() == [[0.75, 0.25, 0, 0]] * 3
    # u runs along x; v downwards, so that the third axis points along y.
    assert np.allclose(channels["tangent"], [[1, 0, 0, 1]] * 3)


def test_numbers_with_signs_and_gaps_between_elements(tmp_path: Path) -> None:
    made = Builder()
    data = np.array([(-127, 0, 127, 9), (127, 0, 0, 9), (0, 64, -128, 9)], "i1").tobytes()
    view = made.view(data, byteStride=4)
    place = made.add("accessors", bufferView=view, componentType=5120, count=3, type="VEC3",
                     normalized=True)  # fmt: skip
    made.add("meshes", primitives=[{"attributes": {"POSITION": place}}])
    made.add("nodes", mesh=0)
    (model,) = read_gltf(made.save(tmp_path)).objects
    wanted = [(-1, 0, 1), (1, 0, 0), (0, 64 / 127, -1)]
    assert np.allclose(model.mesh.channels["position"], wanted)


def test_sparse_accessors_replace_elements(tmp_path: Path) -> None:
    made = Builder()
    indices = made.view(np.array([1, 2], "<u2").tobytes())
    values = made.view(np.array([(1, 0, 0), (0, 3, 0)], "<f4").tobytes())
    place = made.add(
        "accessors", componentType=5126, count=3, type="VEC3",
        sparse={"count": 2, "indices": {"bufferView": indices, "componentType": 5123},
                "values": {"bufferView": values}},
    )  # fmt: skip
    made.add("meshes", primitives=[{"attributes": {"POSITION": place}}])
    made.add("nodes", mesh=0)
    (model,) = read_gltf(made.save(tmp_path)).objects
    assert model.mesh.channels["position"].tolist() == [[0, 0, 0], [1, 0, 0], [0, 3, 0]]


@pytest.mark.parametrize(
    ("mode", "triangles"),
    [(0, []), (4, [[0, 1, 2]]), (5, [[0, 1, 2], [1, 3, 2]]), (6, [[1, 2, 0], [2, 3, 0]])],
)
def test_strips_and_fans(mode: int, triangles: list[list[int]], tmp_path: Path) -> None:
    """The order in which the specification lists the corners of each triangle."""
    made = Builder()
    corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)][: 3 if mode == 4 else 4]
    normals = made.array([(0, 0, 1)] * len(corners))
    attributes = {"POSITION": made.array(corners), "NORMAL": normals}
    made.add("meshes", primitives=[{"attributes": attributes, "mode": mode}])
    made.add("nodes", mesh=0)
    (model,) = read_gltf(made.save(tmp_path)).objects
    assert model.mesh.triangles.tolist() == triangles


def test_lines_are_left_out_and_told(tmp_path: Path) -> None:
    scene = read_gltf(triangle(mode=1).save(tmp_path))
    assert scene.objects == ()
    assert scene.notes == ("mesh 0, primitive 0: it consists of lines, and is left out",)


def test_nodes_stand_on_those_above_them(tmp_path: Path) -> None:
    made = triangle()
    made.whole["nodes"] = [
        {"children": [1, 2], "translation": [0, 10, 0], "extras": {"tags": ["all"]}},
        {"mesh": 0, "rotation": [0, 0, HALF, HALF], "scale": [2, 1, 1], "name": "turned"},
        {"mesh": 0, "matrix": [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 5, 6, 7, 1],
         "extras": {"tags": ["far", "away"]}},
    ]  # fmt: skip
    turned, moved = read_gltf(made.save(tmp_path)).objects
    assert turned.name == "turned"
    # Twice as long along x, then a quarter of a turn from x to y.
    assert np.allclose(turned.object_to_world @ [1, 0, 0, 1], [0, 12, 0, 1])
    assert np.allclose(turned.object_to_world @ [0, 1, 0, 1], [-1, 10, 0, 1])
    assert np.allclose(moved.object_to_world @ [0, 0, 0, 1], [5, 16, 7, 1])
    assert turned.mesh is moved.mesh
    assert turned.tags == {"all"}
    assert moved.tags == {"all", "far", "away"}


def test_a_hundred_thousand_nodes_one_below_the_other(tmp_path: Path) -> None:
    made = triangle()
    count = 99_999
    made.whole["nodes"] = [
        *({"children": [n + 1], "translation": [1, 0, 0]} for n in range(count)), {"mesh": 0}
    ]  # fmt: skip
    (model,) = read_gltf(made.save(tmp_path)).objects
    assert model.object_to_world[0, 3] == count


def test_cameras(tmp_path: Path) -> None:
    made = triangle()
    made.add("cameras", type="perspective", name="eye",
             perspective={"yfov": math.pi / 2, "znear": 1, "zfar": 3})  # fmt: skip
    made.add("cameras", type="perspective", perspective={"yfov": 1, "znear": 0.5})
    made.add("cameras", type="orthographic",
             orthographic={"xmag": 9, "ymag": 2, "znear": 0, "zfar": 10})  # fmt: skip
    made.whole["nodes"] += [
        {"camera": 0, "translation": [0, 0, 5], "scale": [3, 3, 3]}, {"camera": 1}, {"camera": 2},
    ]  # fmt: skip
    made.whole["scenes"] = [{"nodes": [0, 1, 2, 3]}]
    eye, endless, flat = read_gltf(made.save(tmp_path)).cameras
    assert np.allclose(eye.eye, (0, 0, 5))
    # At distance two, two units above the middle, with a quarter of a turn from bottom to top.
    x, y, z, w = eye.world_to_clip(2) @ [4, 2, 3, 1]
    assert np.allclose([x / w, y / w, z / w, w], [1, 1, 0.75, 2])
    assert np.allclose(eye.world_to_clip(1) @ [0, 0, 4, 1], [0, 0, 0, 1])
    _, _, z, w = endless.world_to_clip(1) @ [0, 0, -1e9, 1]
    assert z / w == pytest.approx(1)
    assert np.allclose(flat.world_to_clip(2) @ [4, -2, -5, 1], [1, -1, 0.5, 1])


def test_lights(tmp_path: Path) -> None:
    made = triangle()
    made.whole["extensionsUsed"] = ["KHR_lights_punctual"]
    made.whole["extensions"] = {"KHR_lights_punctual": {"lights": [
        {"type": "directional", "color": [1, 0.5, 0], "intensity": 4, "name": "sun"},
        {"type": "point", "range": 7},
        {"type": "spot", "spot": {"innerConeAngle": 0.25, "outerConeAngle": 0.5}},
    ]}}  # fmt: skip
    made.whole["nodes"] += [
        {"extensions": {"KHR_lights_punctual": {"light": n}}, "translation": [n, 2, 3],
         "rotation": [-HALF, 0, 0, HALF]}
        for n in range(3)
    ]  # fmt: skip
    made.whole["scenes"] = [{"nodes": [0, 1, 2, 3]}]
    sun, lamp, torch = read_gltf(made.save(tmp_path)).lamps
    assert (sun.name, sun.kind) == ("sun", "directional")
    # A white matt surface sends the irradiance over pi.
    assert sun.color == pytest.approx((4 / math.pi, 2 / math.pi, 0))
    # A quarter of a turn around x takes what looks along -z to -y.
    assert np.allclose(sun.direction, (0, -1, 0))
    assert (lamp.kind, lamp.place, lamp.reach) == ("point", (1, 2, 3), 7)
    assert (torch.kind, torch.inner, torch.outer, torch.reach) == ("spot", 0.25, 0.5, math.inf)


@pytest.mark.parametrize(
    ("inner", "outer", "read"),
    [(0.5, 0.5, (0.5, 0.5)), (0.7, 0.5, (0.5, 0.5)), (0.2, 1.5708, (0.2, math.pi / 2))],
)
def test_cones_with_a_hard_edge(
    inner: float, outer: float, read: tuple[float, float], tmp_path: Path
) -> None:
    """They are drawn, and a note says which."""
    made = triangle()
    made.whole["extensionsUsed"] = ["KHR_lights_punctual"]
    spot = {"innerConeAngle": inner, "outerConeAngle": outer}
    made.whole["extensions"] = {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": spot}]}}
    made.whole["nodes"][0]["extensions"] = {"KHR_lights_punctual": {"light": 0}}
    found = read_gltf(made.save(tmp_path))
    (torch,) = found.lamps
    assert (torch.inner, torch.outer) == read
    said = "light 0: its inner cone is not inside the outer one; its edge is hard"
    assert found.notes == ((said,) if inner >= outer else ())


def test_a_material_says_if_it_has_two_sides(tmp_path: Path) -> None:
    made = triangle(material=0)
    made.add("materials", doubleSided=True)
    (found,) = read_gltf(made.save(tmp_path)).objects
    assert found.look.parameters["is_two_sided"] is True


def test_skins(tmp_path: Path) -> None:
    made = triangle()
    resting = [[1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, -1, 0, 1]] * 2
    made.whole["skins"] = [{"joints": [2, 1], "inverseBindMatrices": made.array(resting)}]
    made.whole["nodes"] = [
        {"mesh": 0, "skin": 0, "translation": [99, 0, 0]},
        {"translation": [0, 5, 0], "children": [2]},
        {"translation": [1, 0, 0]},
    ]
    made.whole["scenes"] = [{"nodes": [0, 1]}]
    (model,) = read_gltf(made.save(tmp_path)).objects
    assert model.object_to_world.tolist() == np.eye(4).tolist()
    assert model.bones is not None
    assert np.allclose(model.bones @ [0, 1, 0, 1], [[1, 5, 0, 1], [0, 5, 0, 1]])


def test_morph_targets_add_up(tmp_path: Path) -> None:
    made = triangle()
    targets = [
        {"POSITION": made.array([(1, 0, 0), (0, 0, 0), (0, 0, 2)])},
        {"POSITION": made.array([(0, 4, 0)] * 3), "NORMAL": made.array([(0, 0, 1)] * 3)},
    ]
    made.whole["meshes"][0]["primitives"][0]["targets"] = targets
    made.whole["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = made.array([(0, 0, 1)] * 3)
    made.whole["meshes"][0]["weights"] = [0.5, 0.25]
    made.whole["nodes"] = [{"mesh": 0}, {"mesh": 0, "weights": [0, 1]}]
    made.whole["scenes"] = [{"nodes": [0, 1]}]
    first, second = read_gltf(made.save(tmp_path)).objects
    assert first.look.parameters["morph"] == 1
    moved = first.mesh.channels["morph_position"].tolist()
    assert moved == [[0.5, 1, 0], [0, 1, 0], [0, 1, 1]]
    assert first.mesh.channels["morph_normal"].tolist() == [[0, 0, 0.25]] * 3
    assert second.mesh.channels["morph_position"].tolist() == [[0, 4, 0]] * 3


def test_tangents_follow_morph_targets(tmp_path: Path) -> None:
    """They are those of the targets; or, if the file has none, made of the shape they lead to."""
    made = triangle()
    primitive = made.whole["meshes"][0]["primitives"][0]
    primitive["attributes"] |= {
        "NORMAL": made.array([(0, 0, 1)] * 3), "TEXCOORD_0": made.array([(0, 0), (1, 0), (0, 1)]),
    }  # fmt: skip
    # A quarter turn around z: what was along x is along y.
    primitive["targets"] = [{"POSITION": made.array([(0, 0, 0), (-1, 1, 0), (-1, -1, 0)])}]
    made.whole["meshes"][0]["weights"] = [1]
    (found,) = read_gltf(made.save(tmp_path)).objects
    assert np.allclose(found.mesh.channels["morph_tangent"], [(-1, 1, 0)] * 3)
    primitive["attributes"]["TANGENT"] = made.array([(1, 0, 0, 1)] * 3)
    primitive["targets"][0]["TANGENT"] = made.array([(0, 0, 2)] * 3)
    (found,) = read_gltf(made.save(tmp_path)).objects
    assert np.allclose(found.mesh.channels["morph_tangent"], [(0, 0, 2)] * 3)


def test_flat_normals_follow_morph_targets(tmp_path: Path) -> None:
    made = triangle(targets=[{}])
    lifted = made.array([(0, 0, 0), (-1, 0, 1), (0, 0, 0)])
    made.whole["meshes"][0]["primitives"][0]["targets"] = [{"POSITION": lifted}]
    made.whole["meshes"][0]["weights"] = [1]
    (found,) = read_gltf(made.save(tmp_path)).objects
    channels = found.mesh.channels
    assert np.allclose(channels["normal"] + channels["morph_normal"], [(-1, 0, 0)] * 3)


def test_materials(tmp_path: Path) -> None:
    made = triangle(material=0)
    (tmp_path / "my textures").mkdir()
    (tmp_path / "my textures" / "a.png").write_bytes(png(188, 0, 255, 255))
    made.whole["images"] = [
        {"uri": "my%20textures/a.png"},
        {"bufferView": made.view(png(10, 20, 30, 40)), "mimeType": "image/png"},
    ]
    made.whole["textures"] = [{"source": 0}, {"source": 1}]
    made.whole["materials"] = [{
        "name": "Brass",
        "pbrMetallicRoughness": {
            "baseColorFactor": [0.5, 0.25, 1, 0.75], "metallicFactor": 0.5, "roughnessFactor": 0.25,
            "baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1},
        },
        "normalTexture": {"index": 1, "scale": 2},
        "emissiveFactor": [1, 0.5, 0],
        "alphaMode": "MASK", "alphaCutoff": 0.25,
        "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 8}},
    }]  # fmt: skip
    (model,) = read_gltf(made.save(tmp_path)).objects
    look = model.look
    assert look.name == "Brass"
    numbers = {
        "base_color": (0.5, 0.25, 1, 0.75), "metallic": 0.5, "roughness": 0.25, "normal_scale": 2,
        "occlusion_strength": 1, "emissive": (8, 4, 0), "is_opaque": False, "alpha_cutoff": 0.25,
        "is_two_sided": False,
    }  # fmt: skip
    assert {name: look.parameters[name] for name in numbers} == numbers
    assert look.needs == {}
    assert look.textures.keys() == {"base_color_map", "metallic_roughness_map", "normal_map"}
    # A colour is sRGB, of which 188 is a half of the light; everything else is numbers.
    (color,) = look.textures["base_color_map"].linear()
    assert np.allclose(color[0, 0], (0.5, 0, 1, 1), atol=0.005)
    (texels,) = look.textures["normal_map"].linear()
    assert (255 * texels[0, 0]).round().tolist() == [10, 20, 30, 40]
    assert look.textures["normal_map"] is look.textures["metallic_roughness_map"]


def test_a_binary_file(tmp_path: Path) -> None:
    made = Builder()
    data = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0)], "<f4").tobytes()
    made.add("buffers", byteLength=len(data))
    made.add("bufferViews", buffer=0, byteLength=len(data))
    made.add("accessors", bufferView=0, componentType=5126, count=3, type="VEC3")
    made.add("meshes", primitives=[{"attributes": {"POSITION": 0}}])
    made.add("nodes", mesh=0)
    path = tmp_path / "m.glb"
    path.write_bytes(glb(made.whole, data))
    (model,) = read_gltf(path).objects
    assert model.mesh.channels["position"].tolist() == [[0, 0, 0], [1, 0, 0], [0, 1, 0]]


def test_what_is_left_out_is_told(tmp_path: Path) -> None:
    made = triangle()
    made.whole["extensionsUsed"] = ["KHR_materials_subsurface", "KHR_lights_punctual"]
    made.whole["animations"] = [{"channels": [], "samplers": []}]
    made.whole["nodes"][0]["extras"] = "what an application likes"
    scene = read_gltf(made.save(tmp_path))
    assert scene.notes == (
        "the extension KHR_materials_subsurface is left out", "animations are left out",
    )  # fmt: skip


def test_how_a_texture_is_read_is_told_where_it_differs(tmp_path: Path) -> None:
    made = triangle(material=0)
    made.whole["images"] = [{"bufferView": made.view(png(1, 2, 3, 4))}]
    made.whole["samplers"] = [{"wrapS": 33071}, {"minFilter": 9987, "magFilter": 9729}]
    made.whole["textures"] = [{"source": 0, "sampler": 0}, {"source": 0, "sampler": 1}]
    made.whole["materials"] = [{
        "normalTexture": {"index": 0}, "occlusionTexture": {"index": 1, "texCoord": 2},
    }]  # fmt: skip
    assert read_gltf(made.save(tmp_path)).notes == (
        "material 0, normal_map: its sampler is left out, as materials say how they read",
        "material 0, occlusion_map: it is read with the first texture coordinates",
    )
