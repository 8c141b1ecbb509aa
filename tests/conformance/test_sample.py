"""Values that are drawn for a material keep its promises, and are the same every time."""

from __future__ import annotations

import math
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import burnish
from burnish.compiler.documents.values import MemberRow, ParameterRow
from burnish.support.frozen import changed
from burnish.targets.conformance.sample import sample_textures, sample_values
from burnish.targets.runner.instances.instance import Instance
from burnish.targets.runner.meshes import sphere
from burnish.targets.runner.scene import Scene, with_inputs

from ..examples.kit import VARIANTS, Variant

SEEDS = range(5)

EVERYTHING = """\
burnish 1

struct Part {
    tint  : rgb
    way   : direction<world>
    count : int
    turn  : mat2
}

material Everything {
    attribute level : uint
    attribute curl  : vec3

    param exponent : float in 1..512
    param far      : float in 1000..1e6
    param half     : float in 0..1 = 0.5
    param below    : float in -9..-5
    param free     : float
    param large    : float = 100
    param vast     : float = 3e38
    param depths   : vec2 = vec2(-3.4e38)
    param signed   : int in -20..20
    param lowest   : int = -2147483648
    param highest  : uint = 4294967295u
    param masks    : uvec4 in 0..15
    param dim      : rgb in 0.2..0.4
    param near     : point<world> in -1..1
    param way      : direction<world>
    param axis     : direction<object>
    param place    : point<world>
    param turn     : mat3
    param corner   : mat4 = mat4(2)
    param angled   : angle in 10deg..20deg
    param flags    : bvec3
    param weights  : float[5]
    param parts    : Part[3]
    map   first    : texture2d
    map   second   : texture2d = gray
    map   bumps    : texture2d = flat_normal

    color = vec3(exponent + far + half + below + free + large + float(signed + lowest)) * dim
        * vec3(near)
        + way * place + vec3(axis) + turn[0] + corner[1].xyz * angled + vec3(flags) * weights[2]
        + parts[1].tint * vec3(parts[2].way) * float(parts[0].count) + vec3(parts[1].turn[0], 1)
        + (first(uv) + second(uv) + bumps(uv)).rgb + vec3(masks.xyz) * float(highest)
        + curl * float(level)
}
"""


def everything() -> Instance:
    """An instance of a material with parameters of all kinds."""
    (material,) = burnish.compile(EVERYTHING, (), hoist=False).materials
    return material.instance()


def sampled(seed: int) -> Instance:
    """The instance with every kind of parameter, with random values."""
    instance = everything()
    sample_values(instance, seed)
    sample_textures(instance, seed)
    Scene().apply(instance, 1.0)
    return instance


Row = ParameterRow | MemberRow


def _leaves(row: Row, value: Any) -> Iterator[tuple[Row, Any]]:
    """Rows without members, each with a value that is no array's."""
    if row.layout.count is not None:
        element = changed(row, layout=changed(row.layout, count=None))
        for inner in value:
            yield from _leaves(element, inner)
    elif row.members:
        for member in row.members:
            yield from _leaves(member, value[member.name])
    else:
        yield row, value


@pytest.mark.parametrize("seed", SEEDS)
def test_values_keep_promises(seed: int) -> None:
    instance = sampled(seed)
    assert instance.missing == ()
    for parameter in instance.reflection.parameters:
        for row, value in _leaves(parameter, instance.get(parameter.name)):
            lanes = np.array(value, dtype=float).ravel()
            assert np.isfinite(lanes).all()
            if row.range is not None:
                assert (row.range[0] <= lanes).all() and (lanes <= row.range[1]).all()
            if row.type.startswith("direction"):
                assert math.isclose(math.hypot(*lanes), 1.0, rel_tol=1e-6)
            if row.type.startswith("rgb"):
                assert (lanes >= 0).all() and (lanes <= 1).all()


def test_values_go_through_their_ranges() -> None:
    drawn = [sampled(seed) for seed in range(40)]
    for name, low, high in [
        ("exponent", 60, 450), ("signed", -15, 15), ("below", -8.5, -5.5), ("free", -0.8, 0.8),
        ("large", 60, 300), ("half", 0.2, 0.8),
    ]:  # fmt: skip
        values = [instance.get(name) for instance in drawn]
        assert min(values) < low and max(values) > high, name
    flags = [lane for instance in drawn for lane in instance.get("flags")]
    assert {True, False} == set(flags)
    assert len({instance.get("lowest") for instance in drawn}) > 30


def test_seeds_decide() -> None:
    assert sampled(3).blocks() == sampled(3).blocks()
    assert sampled(3).textures() == sampled(3).textures()
    assert sampled(3).blocks()["Material"] != sampled(4).blocks()["Material"]


def test_a_draw_depends_on_the_name_and_not_on_what_else_there_is() -> None:
    less = EVERYTHING.replace("    param far      : float in 1000..1e6\n", "").replace(" far +", "")
    (material,) = burnish.compile(less, (), hoist=False).materials
    instance = material.instance()
    sample_values(instance, 1)
    whole = sampled(1)
    for name in ("exponent", "free", "turn", "parts", "weights"):
        assert instance.get(name) == whole.get(name)
    assert whole.get("way") != whole.get("axis")


def test_only_what_is_missing() -> None:
    instance = everything()
    sample_values(instance, 0, missing=True)
    assert instance.get("half") == 0.5 and instance.get("large") == 100.0
    assert instance.get("exponent") is not None and instance.get("way") is not None


def test_missing_are_also_parts_of_lights_that_only_a_scene_turns_on(tmp_path: Path) -> None:
    file = tmp_path / "lamps.burnish"
    file.write_text(
        "struct Place { at : vec3 }\n"
        "light Lamp : Light { param place : Place  to_light = normalize(place.at) }\n"
        "term lit() per light = light.diffuse * saturate(dot(normal, light.to_light))\n"
        "material M { color = lit() }\nrig R { lamps : Lamp[<= 3] }\n",
        encoding="utf-8",
    )
    instance = Instance(burnish.compile(file, targets=("wgsl",))["M"].reflection)
    sample_values(instance, 0, missing=True)
    instance.set("lamps.count", 3)
    assert not [name for name in instance.missing if name.startswith("lamps[")]


def test_textures_vary_and_differ() -> None:
    instance = sampled(0)
    textures = instance.textures()
    for texture in textures.values():
        texels = texture.linear()[0]
        assert len(texture.levels) >= 5
        assert (texels.std(axis=(0, 1)) > 0.02).all()
        assert (np.ptp(texels, axis=0).max(0) > 0.05).all()
        assert (np.ptp(texels, axis=1).max(0) > 0.05).all()
        lanes = [texels[..., i] for i in range(4)]
        assert all(abs(a - b).max() > 0.05 for i, a in enumerate(lanes) for b in lanes[:i])
    assert len({texture.levels[0] for texture in textures.values()}) == len(textures)
    assert len({(texture.width, texture.height) for texture in textures.values()}) > 1


def test_flat_normals_stay_near_to_flat() -> None:
    normals = 2 * sampled(0).textures()["bumps"].linear()[0][..., :3] - 1
    assert (normals[..., 2] > 0.5).all() and abs(normals[..., :2]).max() < 0.6


def test_vertex_inputs_that_a_mesh_lacks() -> None:
    mesh = with_inputs(everything().reflection, sphere(8, 4))
    level, curl = mesh.channels["level"], mesh.channels["curl"]
    assert level.shape == (len(mesh), 1) and level.dtype.kind == "i" and (level >= 0).all()
    assert curl.shape == (len(mesh), 3) and (np.ptp(curl, axis=0) > 0.1).all()
    assert len(np.unique(level)) > 2
    assert mesh.channels["normal"] is not None


@pytest.mark.parametrize("variant", VARIANTS, ids=str)
@pytest.mark.parametrize("seed", SEEDS)
def test_examples_take_them(variant: Variant, seed: int) -> None:
    for material in burnish.compile(variant.path, (), rig=variant.rig, pass_=variant.pass_):
        instance = material.instance()
        sample_values(instance, seed)
        sample_textures(instance, seed)
        Scene(light_count=64).apply(instance, 1.5)
        assert instance.missing == ()
        assert all(instance.blocks().values())


def test_a_parameter_that_the_program_lost_keeps_its_range() -> None:
    """The comparison was left out because of the range, but the material still makes it."""
    material = burnish.compile(
        "material M { param few : float[3] in 0.5..4\n"
        "color = if few[int(9 * uv.x)] == 0 then #f00 else #0f0 }", "wgsl",
    ).materials[0]  # fmt: skip
    instance = Instance(material.reflection)
    sample_values(instance, 0, missing=True)
    assert all(0.5 <= value <= 4 for (value,) in instance.values()["few"])
