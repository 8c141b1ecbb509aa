"""The functions for nodes of Unity and Unreal: DXC takes them. These engines have not seen them.

Unity's structures of a texture and its sampler are stubs here.
"""

from __future__ import annotations

import json
import re
from pathlib import Path

import pytest

from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.engines import known
from burnish.targets.toolchain import Job, Toolchain

from ..cli.kit import invoke
from ..golden import assert_golden
from ..suite.verdicts import refused
from .files import EXAMPLES, files_of

GOLDEN = Path(__file__).parent / "golden"
STUBS = "".join(
    f"struct Unity{kind} {{ {kind}<float4> tex; SamplerState samplerstate; }};\n"
    for kind in ("Texture2D", "Texture2DArray", "Texture3D", "TextureCube")
)
ENTRY = "\nfloat4 main() : SV_Target {\n    return float4(0, 0, 0, 0);\n}\n"
NODES = {"plastic": "Plastic", "water": "Water", "texture_array": "Terrain", "fins": "Mole",
         "dissolving": "Board", "foliage": "Leaf", "normal_map": "TangentSpaceBumps"}  # fmt: skip


@pytest.mark.parametrize("engine", ["unity", "unreal"])
def test_text(engine: str) -> None:
    for name, text in files_of(engine, EXAMPLES / "plastic.burnish", "Plastic").items():
        assert "ever compiled by" in text.splitlines()[0]
        assert_golden(text, GOLDEN / name)
    assert known.load(engine).unproven.startswith("never compiled by ")


ODD = """\
material Odd {
    param glow_out : float = 1
    param albedoSampler : float = 1
    param object_to_world_x : vec3 = vec3(1)
    map albedo : texture2d = white
    x1   = uv.x * glow_out
    x_1  = uv.x * glow_out * 2
    side = if front_facing then albedoSampler else 0.5
    glow = albedo(uv).rgb * glow_out * side * (object_to_world * vec4(object_to_world_x, 1)).xyz
    roughness = vec3(x1, x_1, 1)
}
"""
"""Names that nodes have besides, slots whose names are the same without underscores, a condition,
and a slot that is no roughness."""


def test_dxc_takes_the_functions(tmp_path: Path) -> None:
    jobs = []
    (tmp_path / "odd.burnish").write_text(ODD, encoding="utf-8")
    sources = {EXAMPLES / f"{name}.burnish": material for name, material in NODES.items()}
    for engine in ("unity", "unreal"):
        for source, material in (*sources.items(), (tmp_path / "odd.burnish", "Odd")):
            files = files_of(engine, source, material)
            lines = "".join(files.values()).splitlines()
            inner = "\n".join(line for line in lines if not line.startswith("#"))  # the guard
            text = (STUBS if engine == "unity" else "") + inner + ENTRY
            jobs.append(Job("dxc-dxil", "frag", text, name=f"{engine} {material}"))
            assert "Smoothness" not in text or material != "Odd"
    with Toolchain() as toolchain:
        assert not [(each.job.name, each.messages[:3]) for each in refused(jobs, toolchain)]


SPACES = """\
enum Look { plain, torn }
material Spaces {
    param middle : point<world> = vec3(1, 2, 3)
    param up : direction<world> = vec3(0, 1, 0)
    param look : Look = Look.torn
    position = inherited.position + vec3(0, 0.1, 0)
    facing = dot(normal, up) + length(position - middle)
    ragged = if look == Look.torn then 1.0 else 0.0
}
"""
TOLD = {
    "unity": (
        "position_out = burnish_turned(spaces_position(burnish_turned(vertex_position), "
        "burnish_object_to_world(object_to_world, object_to_world_place)));",
        "// middle: a property of the type point<world>, usually (-1, 2, 3)",
        "// up: a property of the type direction<world>, usually (0, 1, 0)",
        "// object_to_world_place: the node Object, its output Position",
        "// normal: the node Normal Vector, in the space World",
        "// look: a property, one of 0 plain, 1 torn, usually 1",
        "float look, out float ragged_out",
        "// Its result goes to Position of the Vertex context",
    ),
    "unreal": (
        "return burnish_unreal_place(spaces_position(burnish_place(vertex_position), "
        "burnish_object_to_world(object_to_world_x, object_to_world_y, object_to_world_z, "
        "object_to_world_place)));",
        "// middle: a property of the type point<world>, usually (100, 300, 200)",
        "// up: a property of the type direction<world>, usually (0, 0, 1)",
        "// normal: VertexNormalWS",
        "// look: a property, one of 0 plain, 1 torn, usually 1",
        "int(round(look))",
        "// Its result goes to World Position Offset, less Absolute World Position",
    ),
}
"""Values with a space are turned on their way in and out; all others are as the functions say."""


@pytest.mark.parametrize("engine", TOLD)
def test_nodes_have_the_coordinates_of_their_engine(engine: str) -> None:
    (text,) = files_of(engine, SPACES, "Spaces").values()
    whole = " ".join(text.split()).replace("( ", "(").replace(" )", ")")
    for expected in TOLD[engine]:
        assert expected in whole, whole


@pytest.mark.parametrize("engine", TOLD)
def test_instances_are_the_engines(engine: str) -> None:
    with pytest.raises(CompileError, match=r"of each instance, and .* places instances itself"):
        files_of(engine, EXAMPLES / "instances.burnish", "Cobbles")


def test_unreal_has_no_matrices() -> None:
    with pytest.raises(CompileError, match="nodes of Unreal take no matrices"):
        files_of("unreal", EXAMPLES / "decal.burnish", "Wall")


GIVEN = """\
import std.models.{GltfSurface}
material Lava : GltfSurface {
    param crust : rgb = #402010
    base_color = crust
    gloss = 0.3 * uv.x
    metallic = 0
}
"""
TOLD_OF_PROPERTIES = """\
// crust: a property of the type rgb, usually (0.05127, 0.01444, 0.005182).
// It goes to Base Color."""


@pytest.mark.parametrize("engine", TOLD)
def test_no_node_hands_on_a_property_or_a_constant_of_the_library(engine: str) -> None:
    (text,) = files_of(engine, GIVEN, "Lava").values()
    assert TOLD_OF_PROPERTIES in text
    assert set(re.findall(r"(?<=lava_)\w+(?=\()", text)) == {
        "metallic", "roughness", "occlusion", "gloss",
    }, text  # fmt: skip


@pytest.mark.parametrize("engine", TOLD)
def test_the_command_tells_what_is_in_the_file(engine: str, tmp_path: Path) -> None:
    source = tmp_path / "lava.burnish"
    source.write_text(GIVEN, encoding="utf-8")
    result = invoke("compile", source, "--engine", engine, "-o", tmp_path)
    assert "Lava: 4 functions (metallic, roughness, occlusion, gloss) in files" in result.stdout
    document = json.loads((tmp_path / f"Lava.{engine}.functions.json").read_text("utf-8"))
    assert [row["name"] for row in document["functions"]] == [
        "metallic", "roughness", "occlusion", "gloss",
    ]  # fmt: skip
