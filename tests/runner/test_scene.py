"""The places of a scene's lights, the order of meshes for blending, and the values of instances."""

from __future__ import annotations

import numpy as np
import pytest

import burnish
from burnish.compiler.documents.reflection import Reflection
from burnish.targets.runner.cameras import looking
from burnish.targets.runner.meshes import (
    BONES,
    CHANNELS,
    MESHES,
    Mesh,
    MeshError,
    farthest_first,
    mesh,
)
from burnish.targets.runner.scene import (
    Scene,
    placements,
    pose,
    set_by_scene,
    vertex_data,
    with_inputs,
)
from burnish.targets.runner.scene_state import set_up

LAMPS = """
import std.lights.{Directional, Point}
import std.terms.{lambert}
material Wall { color = lambert(vec3(1)) }
rig Hall { sun : Directional  lamps : Point[<= 5]  pair : Point[2] }
"""


@pytest.mark.parametrize(("wanted", "count"), [(0, 0), (3, 3), (64, 5)])
def test_every_light_has_a_place(wanted: int, count: int) -> None:
    """Lights beyond the number that shines have one, too, so that the number can be raised."""
    (material,) = burnish.compile(LAMPS).materials
    instance = material.instance()
    Scene(light_count=wanted).apply(instance, 1.0)
    assert instance.missing == ()
    assert instance.get("lamps.count") == count
    instance.set("lamps.count", 5)
    assert instance.missing == ()
    lamps = [lamp["place"] for name in ("lamps", "pair") for lamp in instance.get(name)]
    assert len(set(lamps)) == 7, "no two stand in one place"


@pytest.mark.parametrize("name", MESHES)
def test_farthest_first(name: str) -> None:
    eye = np.array([1.0, 2.0, 3.0])
    before, after = mesh(name), farthest_first(mesh(name), tuple(eye))
    middles = after.channels["position"][after.triangles].mean(axis=1)
    distances = np.linalg.norm(middles - eye, axis=1)
    assert (np.diff(distances) <= 1e-12).all()
    assert sorted(map(tuple, before.triangles)) == sorted(map(tuple, after.triangles))


@pytest.mark.parametrize("name", MESHES)
def test_triangles_and_normals_agree(name: str) -> None:
    """Normals have length one, and look to the side from which the corners are counter-clockwise;
    tangents lie in the surface, and the third axis leads against v."""
    shape = mesh(name)
    position, normal, uv = (shape.channels[each] for each in ("position", "normal", "uv"))
    tangent = shape.channels["tangent"]
    a, b, c = shape.triangles.T
    face = np.cross(position[b] - position[a], position[c] - position[a])
    face /= np.linalg.norm(face, axis=1, keepdims=True)
    assert np.allclose(np.linalg.norm(normal, axis=1), 1, atol=1e-6)
    for corner in (a, b, c):
        assert (np.sum(face * normal[corner], axis=1) > 0.8).all()
    assert np.allclose(np.sum(normal * tangent[:, :3], axis=1), 0, atol=1e-6)
    (u1, v1), (u2, v2) = (uv[b] - uv[a]).T, (uv[c] - uv[a]).T
    turn = np.sign(u1 * v2 - u2 * v1)[:, None]
    along_v = turn * ((position[c] - position[a]) * u1[:, None]
                      - (position[b] - position[a]) * u2[:, None])  # fmt: skip
    upwards = np.cross(normal[a], tangent[a, :3]) * tangent[a, 3:]
    assert (np.sum(upwards * along_v, axis=1) <= 1e-7).all()


@pytest.mark.parametrize("name", MESHES)
def test_bones_share_each_vertex(name: str) -> None:
    channels = mesh(name).channels
    assert (channels["weights"].sum(axis=1) == 1).all()
    assert 0 <= channels["joints"].min() <= channels["joints"].max() < BONES
    assert not np.isclose(pose(BONES)[BONES - 1], np.eye(4)).all()


CROWD = """
import std.instancing.{Instanced}
material Crowd : Surface + Instanced {
    attribute shade : float per instance
    color = vec3(shade)
}
"""


def test_instances_get_places_of_their_own() -> None:
    (material,) = burnish.compile(CROWD).materials
    state = set_up(material.instance(), _crowd(material.reflection, 5), Scene(), (8, 8))
    assert state.instance_count == 5
    columns = [state.attributes[f"instance_transform.{i}"] for i in range(4)]
    assert np.allclose(np.stack(columns, axis=2), placements(5))
    geometry = state.geometry()
    vertices = len(mesh("cube"))
    assert geometry.vertex_count == 5 * vertices
    assert len(geometry.triangles) == 5 * len(mesh("cube").triangles)
    assert list(geometry.inputs()["instance_index"][::vertices]) == [0, 1, 2, 3, 4]
    assert geometry.inputs()["vertex_index"].max() == vertices - 1
    draw = state.draw()
    assert (draw.instance_count, draw.vertex_count) == (5, vertices)


def test_what_instances_have_can_be_given() -> None:
    (material,) = burnish.compile(CROWD).materials
    plain = mesh("plane")
    columns = {f"instance_transform.{i}": placements(2)[:, :, i] for i in range(4)}
    given = {**columns, "shade": np.array([[0.25], [0.5]])}
    whole = Mesh(plain.channels, plain.triangles, given, 2)
    assert vertex_data(material.reflection, whole)["shade"].tolist() == [[0.25], [0.5]]
    assert with_inputs(material.reflection, whole).instance_count == 2


def test_a_mesh_without_instances_is_refused() -> None:
    (material,) = burnish.compile(CROWD).materials
    with pytest.raises(MeshError, match="does not have for each instance: it has nothing"):
        set_up(material.instance(), mesh("plane"), Scene(), (8, 8))


def _crowd(reflection: Reflection, count: int) -> Mesh:
    return with_inputs(reflection, mesh("cube"), count)


NAMED = (
    "eye",
    "bones",
    "object_to_world",
    "view_projection",
    "morph",
    "place",
    "axis",
    "direction",
)
"""Names that parameters of the library have."""


@pytest.mark.parametrize("declared", ["float", "uvec3", "mat4[64]", "Dual[4]"])
@pytest.mark.parametrize("name", NAMED)
def test_a_scene_sets_no_parameter_for_its_name(name: str, declared: str) -> None:
    """A pass has none of the library's parameters, so it may use all of these names."""
    text = f"""
        struct Dual {{ real : vec4, dual : vec4 }}
        pass P : Forward {{ param {name} : {declared} }}
        material M {{}}
    """
    (material,) = burnish.compile(text, "wgsl", pass_="P").materials
    instance = material.instance()
    Scene().apply(instance, 1.0)
    names = {row.name for row in material.reflection.parameters}
    own = f"P.{name}" if f"P.{name}" in names else name
    assert own not in set_by_scene(material.reflection)
    row = next(row for row in material.reflection.parameters if row.name == own)
    assert row.library is None


def test_a_light_s_parameters_are_set_for_what_they_are() -> None:
    text = """
        import std.lights.{Spot}
        light Own : Light {
            param place : float = 7
            param axis : uint = 3u
            param at : point<world>
            param way : direction<world> = vec3(0, 1, 0)
            to_light = normalize(at + way * place * float(axis) - position)
        }
        rig R { own : Own  spot : Spot }
        material M { color = matt() }
        term matt() per light = light.diffuse * light.to_light.x
    """
    (material,) = burnish.compile(text, "wgsl").materials
    instance = material.instance()
    Scene().apply(instance, 1.0)
    assert instance.missing == ()
    assert (instance.own.place, instance.own.axis, instance.own.way) == (7.0, 3, (0.0, 1.0, 0.0))
    assert set_by_scene(material.reflection) >= {"own.at", "spot.place", "spot.axis", "eye"}


@pytest.mark.parametrize("name", sorted(CHANNELS.keys() - {"color"}))
def test_an_input_that_is_called_like_a_channel_leaves_the_channel_alone(name: str) -> None:
    text = f"""
        pass P : Forward {{
            attribute {name} : uvec2
            target own : rgba8 = vec4(vec2({name}), material.uv.x, material.normal.y)
        }}
        material M {{}}
    """
    (material,) = burnish.compile(text, "wgsl", pass_="P").materials
    whole = with_inputs(material.reflection, mesh("sphere"))
    values = vertex_data(material.reflection, whole)
    assert values[name].dtype.kind == "i" and values[name].shape[1] == 2
    for channel in ("position", "normal", "uv"):
        expected = mesh("sphere").channels[channel]
        assert (values[f"vertex_{channel}"] == expected).all()


def test_what_the_camera_sees() -> None:
    """The camera looks at the middle. Depths are 0 at ``near`` and 1 at ``far``."""
    middle = (0.5, 0.25, 0.0)
    camera = looking(look_at=middle)
    x, y, _depth, w = camera.world_to_clip(1.5) @ [*middle, 1]
    assert np.allclose((x, y), 0)
    assert np.isclose(w, np.linalg.norm(np.subtract(camera.eye, middle)))
    ahead = looking(eye=(0.0, 0.0, 5.0)).world_to_clip(1.5)
    half = np.tan(np.radians(19))
    for distance, depth in ((0.1, 0.0), (20.0, 1.0)):
        corner = [1.5 * half * distance, half * distance, 5 - distance, 1]
        assert np.allclose(ahead @ corner, distance * np.array([1, 1, depth, 1]))


LIGHTS = [
    ((-1.465, 1.95, 1.746), (0.8, 0.76, 0.68)),
    ((2.459, 1.688, -0.324), (0.22, 0.3, 0.4)),
    ((-2.163, 1.425, -1.514), (0.4, 0.24, 0.18)),
    ((0.6, 1.163, 2.7), (0.24, 0.4, 0.28)),
    ((1.139, 1.95, -1.975), (0.4, 0.38, 0.34)),
]
"""The place and the colour of each light.

The first is at the upper left, and each stands a golden angle further than the one before. Of
three, the other two together are as bright as the first.
"""


def test_where_lights_are_and_how_they_shine() -> None:
    text = LAMPS.replace("sun : Directional", "").replace("pair : Point[2]", "")
    (material,) = burnish.compile(text).materials
    instance = material.instance()
    Scene().apply(instance, 1.0)
    assert instance.get("lamps.count") == 3
    lamps = [(lamp["place"], lamp["diffuse_color"]) for lamp in instance.get("lamps")]
    assert np.allclose(np.array(lamps), np.array(LIGHTS), rtol=0, atol=6e-4)


def test_inputs_that_a_mesh_does_not_have_get_waves() -> None:
    text = "material M {attribute shade : float attribute code : uint alpha = shade + float(code)}"
    (material,) = burnish.compile(text).materials
    values = vertex_data(material.reflection, with_inputs(material.reflection, mesh("cube")))
    assert np.allclose(values["shade"][:3, 0], [0.40757, 0.89995, 0.12531], atol=1e-5)
    assert values["code"][:8, 0].tolist() == [0, 5, 1, 2, 1, 6, 4, 6]
