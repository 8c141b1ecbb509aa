"""The compilers' own descriptions of a block's layout, against answers worked out by hand."""

from __future__ import annotations

import pytest

from burnish.targets.toolchain import (
    Job,
    Toolchain,
    block_offsets_dxil,
    block_offsets_spirv,
)

GLSL = """#version 450
struct Cone { float inner; vec3 axis; };
struct Light { vec3 place; Cone cone; };
layout(std140, binding = 0) uniform P {
  vec3 eye; float gain;
  mat3 turn;
  Light lights[2];
  float tail;
  vec4 rows[3];
};
layout(location = 0) out vec4 colour;
void main() {
  colour = vec4(turn * eye, gain + tail) + rows[1] + lights[1].cone.inner;
}
"""

WGSL = """struct Cone { inner: f32, axis: vec3<f32> }
struct Light { place: vec3<f32>, cone: Cone }
struct P {
  eye: vec3<f32>, gain: f32,
  turn: mat3x3<f32>,
  lights: array<Light, 2>,
  tail: f32,
  rows: array<vec4<f32>, 3>,
}
@group(0) @binding(0) var<uniform> u: P;
@fragment fn main() -> @location(0) vec4<f32> {
  return vec4<f32>(u.turn * u.eye, u.gain + u.tail) + u.rows[1] + u.lights[1].cone.inner;
}
"""

HLSL = """struct Cone { float inner; float3 axis; };
struct Light { float3 place; Cone cone; };
cbuffer P : register(b0) {
  float3 eye; float gain;
  column_major float3x3 turn;
  Light lights[2];
  float tail;
  float4 rows[3];
};
float4 main() : SV_Target0 {
  return float4(mul(turn, eye), gain + tail) + rows[1] + lights[1].cone.inner;
}
"""

STD140 = {
    "eye": 0,
    "gain": 12,
    "turn": 16,
    "turn[]": 16,
    "lights": 64,
    "lights[]": 48,
    "lights[].place": 64,
    "lights[].cone": 80,
    "lights[].cone.inner": 80,
    "lights[].cone.axis": 96,
    "tail": 160,
    "rows": 176,
    "rows[]": 16,
}

DX = {
    "eye": 0,
    "gain": 12,
    "turn": 16,
    "turn[]": 16,
    "lights": 64,
    "lights[]": 32,
    "lights[].place": 64,
    "lights[].cone": 80,
    "lights[].cone.inner": 80,
    "lights[].cone.axis": 84,
    "tail": 128,
    "rows": 144,
    "rows[]": 16,
}
"""HLSL's own packing: ``axis`` follows ``inner`` in the same register."""

GLSLANG_HLSL = DX | {"lights[]": 48, "tail": 160, "rows": 176}
"""glslang packs as HLSL does inside a struct, and gets the distance between structs wrong."""


@pytest.mark.parametrize(
    ("job", "expected"),
    [
        (Job("glslang-vulkan", "frag", GLSL), STD140),
        (Job("naga", "frag", WGSL), STD140),
        (Job("dxc-spirv", "frag", HLSL, flags=("-fvk-use-gl-layout",)), STD140),
        (Job("dxc-spirv", "frag", HLSL, flags=("-fvk-use-dx-layout",)), DX),
        (Job("glslang-hlsl", "frag", HLSL), GLSLANG_HLSL),
    ],
    ids=["glslang", "naga", "dxc-gl", "dxc-dx", "glslang-hlsl"],
)
def test_spirv(toolchain: Toolchain, job: Job, expected: dict[str, int]) -> None:
    [verdict] = toolchain.check([job], keep_modules=True)
    assert verdict.spirv is not None, verdict.report()
    assert block_offsets_spirv(verdict.spirv) == {"P": expected}


def test_dxil(toolchain: Toolchain) -> None:
    [verdict] = toolchain.check([Job("dxc-dxil", "frag", HLSL)])
    assert verdict.disassembly is not None, verdict.report()
    without_strides = {name: place for name, place in DX.items() if not name.endswith("[]")}
    assert block_offsets_dxil(verdict.disassembly) == {"P": without_strides}


def test_a_constant_buffer_of_a_type_reads_alike_in_spirv_and_dxil(toolchain: Toolchain) -> None:
    text = """struct Surface { float2 scale; float3 colour; float hardness[2]; };
ConstantBuffer<Surface> surface : register(b1);
float4 main() : SV_Target0 { return surface.scale.x + surface.colour.x + surface.hardness[1]; }
"""
    spirv, dxil = toolchain.check(
        [
            Job("dxc-spirv", "frag", text, flags=("-fvk-use-dx-layout",)),
            Job("dxc-dxil", "frag", text),
        ],
        keep_modules=True,
    )
    assert spirv.spirv is not None, spirv.report()
    assert dxil.disassembly is not None, dxil.report()
    members = {"scale": 0, "colour": 16, "hardness": 32}
    assert block_offsets_spirv(spirv.spirv) == {"Surface": members | {"hardness[]": 16}}
    assert block_offsets_dxil(dxil.disassembly) == {"Surface": members}


def test_an_array_of_matrices_has_two_distances(toolchain: Toolchain) -> None:
    text = """#version 450
layout(std140, binding = 0) uniform P { mat3 turns[4]; };
layout(location = 0) out vec4 colour;
void main() { colour = vec4(turns[1][0], 1.0); }
"""
    [verdict] = toolchain.check([Job("glslang-vulkan", "frag", text)], keep_modules=True)
    assert verdict.spirv is not None
    assert block_offsets_spirv(verdict.spirv) == {"P": {"turns": 0, "turns[]": 48, "turns[][]": 16}}
