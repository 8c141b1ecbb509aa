"""Each checker takes a good shader, and refuses a bad one at the right place."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import pytest

from burnish.targets.toolchain import CHECKERS, Job, Toolchain
from burnish.targets.toolchain.process import Outcome
from burnish.targets.toolchain.toolbox import Toolbox

GL = """#version 330 core
uniform vec3 tint;
in vec3 normal;
out vec4 colour;
void main() {
  colour = vec4(normalize(normal) * tint, 1.0);
}
"""

ES_1 = """#version 100
precision highp float;
uniform vec3 tint;
varying vec3 normal;
void main() {
  gl_FragColor = vec4(normalize(normal) * tint, 1.0);
}
"""

ES = """#version 300 es
precision highp float;
uniform vec3 tint;
in vec3 normal;
out vec4 colour;
void main() {
  colour = vec4(normalize(normal) * tint, 1.0);
}
"""

GL_4 = """#version 450 core
layout(std140, binding = 0) uniform P { vec3 tint; };
layout(location = 0) in vec3 normal;
layout(location = 0) out vec4 colour;
void main() {
  colour = vec4(normalize(normal) * tint, 1.0);
}
"""

ES_31 = """#version 310 es
precision highp float;
layout(std140, binding = 0) uniform P { vec3 tint; };
layout(location = 0) in vec3 normal;
layout(location = 0) out vec4 colour;
void main() {
  colour = vec4(normalize(normal) * tint, 1.0);
}
"""

VULKAN = """#version 450
layout(std140, set = 0, binding = 0) uniform P { vec3 tint; };
layout(location = 0) in vec3 normal;
layout(location = 0) out vec4 colour;
void main() {
  colour = vec4(normalize(normal) * tint, 1.0);
}
"""

HLSL = """cbuffer P : register(b0) { float3 tint; };
float4 shade(float3 normal : TEXCOORD0) : SV_Target0 {
  return float4(normalize(normal) * tint, 1);
}
"""

WGSL = """struct P { tint: vec3<f32> }
@group(0) @binding(0) var<uniform> u: P;
@fragment fn shade(@location(0) normal: vec3<f32>) -> @location(0) vec4<f32> {
  return vec4<f32>(normalize(normal) * u.tint, 1.0);
}
"""

MSL = """#include <metal_stdlib>
using namespace metal;
struct P { alignas(16) packed_float3 tint; };
struct Crossing { float3 normal [[user(location0)]]; };
fragment float4 shade(Crossing input [[stage_in]], constant P& u [[buffer(0)]]) {
  return float4(normalize(input.normal) * float3(u.tint), 1.0f);
}
"""


@dataclass(frozen=True)
class Sample:
    """A good text; ``* tint`` in it becomes ``* taint`` to make it a bad one."""

    text: str
    entry: str
    bad_line: int
    bad_column: int | None = None
    """The column of the unknown word, if a tool names it."""

    def bad_text(self) -> str:
        return self.text.replace("* tint", "* taint").replace("u.tint", "taint")


SAMPLES = {
    "glslang-vulkan": Sample(VULKAN, "main", 6),
    "glslang-gl330": Sample(GL, "main", 6),
    "glslang-gl450": Sample(GL_4, "main", 6),
    "glslang-es100": Sample(ES_1, "main", 6),
    "glslang-es300": Sample(ES, "main", 7),
    "glslang-es310": Sample(ES_31, "main", 7),
    "glslang-hlsl": Sample(HLSL, "shade", 3),
    "dxc-spirv": Sample(HLSL, "shade", 3, 37),
    "dxc-dxil": Sample(HLSL, "shade", 3, 37),
    "naga": Sample(WGSL, "shade", 4, 40),
    "tint": Sample(WGSL, "shade", 4, 40),
    "clang-msl": Sample(MSL, "shade", 6, 50),
}

MAKES_SPIRV = {"glslang-vulkan", "glslang-hlsl", "dxc-spirv", "naga"}


def test_every_checker_has_a_sample() -> None:
    assert set(SAMPLES) == set(CHECKERS)


@pytest.mark.parametrize("checker", SAMPLES)
def test_a_good_shader_is_accepted(toolchain: Toolchain, checker: str) -> None:
    sample = SAMPLES[checker]
    job = Job(checker, "frag", sample.text, sample.entry)
    [verdict] = toolchain.check([job], keep_modules=True)
    assert verdict.status == "accepted", verdict.report()
    assert verdict.messages == ()
    assert (verdict.spirv is not None) == (checker in MAKES_SPIRV)
    assert (verdict.disassembly is not None) == (checker == "dxc-dxil")


@pytest.mark.parametrize("checker", SAMPLES)
def test_a_bad_shader_is_rejected_at_its_line(toolchain: Toolchain, checker: str) -> None:
    sample = SAMPLES[checker]
    job = Job(checker, "frag", sample.bad_text(), sample.entry, name="bad.txt")
    [verdict] = toolchain.check([job], keep_modules=True)
    assert verdict.status == "rejected", verdict.log
    first = verdict.messages[0]
    assert (first.severity, first.line, first.column) == (
        "error",
        sample.bad_line,
        sample.bad_column,
    )
    assert "taint" in first.text
    assert verdict.spirv is None
    assert f"bad.txt:{sample.bad_line}:" in verdict.report()


@pytest.mark.parametrize("checker", ["glslang-hlsl", "dxc-spirv", "dxc-dxil", "naga", "clang-msl"])
def test_an_entry_point_that_is_not_there_is_an_error(toolchain: Toolchain, checker: str) -> None:
    [verdict] = toolchain.check([Job(checker, "frag", SAMPLES[checker].text, "paint")])
    assert verdict.status == "rejected"
    assert "entry point" in verdict.messages[0].text.lower()


def test_an_entry_point_of_another_stage_is_an_error(toolchain: Toolchain) -> None:
    [verdict] = toolchain.check([Job("naga", "vert", WGSL, "shade")])
    assert verdict.status == "rejected"
    assert verdict.messages[0].text == "there is no vert entry point named 'shade'"


def test_tint_refuses_a_texture_read_in_varying_control_flow(toolchain: Toolchain) -> None:
    text = """@group(0) @binding(0) var image: texture_2d<f32>;
@group(0) @binding(1) var filtering: sampler;
@fragment fn shade(@location(0) uv: vec2<f32>) -> @location(0) vec4<f32> {
  if (uv.x > 0.5) {
    return textureSample(image, filtering, uv);
  }
  return vec4<f32>();
}
"""
    naga, tint = toolchain.check([Job(name, "frag", text, "shade") for name in ("naga", "tint")])
    assert naga.status == "accepted"
    assert tint.status == "rejected"
    assert (tint.messages[0].line, tint.messages[0].column) == (5, 12)
    assert "4:3: control flow depends on" in tint.messages[0].text


def test_spirv_that_the_validator_refuses_is_rejected(toolchain: Toolchain) -> None:
    """With its own validation switched off, DXC lets two members overlap."""
    text = """struct P { float4 wide[2]; [[vk::offset(20)]] float inside; };
ConstantBuffer<P> p;
float4 main() : SV_Target0 { return p.inside + p.wide[1]; }
"""
    [verdict] = toolchain.check([Job("dxc-spirv", "frag", text, flags=("-Vd",))])
    assert verdict.status == "rejected"
    assert verdict.messages[-1].text.startswith("spirv-val: ")


def test_dxil_that_its_validator_refuses_is_rejected(toolchain: Toolchain) -> None:
    """The library brings its validator along, though not the one that also signs."""
    text = "\nvoid main(float3 p : POSITION, out float4 o : SV_Position) { o.xyz = p; }\n"
    [verdict] = toolchain.check([Job("dxc-dxil", "vert", text)])
    assert verdict.status == "rejected"
    first = verdict.messages[0]
    assert first.line == 2
    assert first.text == "Not all elements of output SV_Position were written."


def test_a_warning_does_not_reject(toolchain: Toolchain) -> None:
    text = "float4 main(float3 v : A) : SV_Target0 {\n  float2 w = v;\n  return w.xyxy;\n}\n"
    [verdict] = toolchain.check([Job("dxc-dxil", "frag", text)])
    assert verdict.status == "accepted"
    [message] = verdict.messages
    assert (message.severity, message.line, message.column) == ("warning", 2, 10)


def test_verdicts_come_in_the_order_of_the_jobs(toolchain: Toolchain) -> None:
    """A mixture of slow, quick and batched jobs, every third one bad, each known by its line."""
    jobs = []
    for number in range(45):
        checker = ("glslang-gl330", "naga", "glslang-hlsl", "tint", "dxc-spirv")[number % 5]
        sample = SAMPLES[checker]
        text = sample.text if number % 3 else sample.bad_text()
        version, body = text.split("\n", 1)
        jobs.append(Job(checker, "frag", version + "\n" * (number + 1) + body, sample.entry))
    for number, verdict in enumerate(toolchain.check(jobs)):
        assert verdict.job is jobs[number]
        if number % 3:
            assert verdict.status == "accepted", verdict.report()
        else:
            assert verdict.status == "rejected"
            assert verdict.messages[0].line == SAMPLES[verdict.job.checker].bad_line + number


def test_an_unknown_checker_is_the_callers_mistake(toolchain: Toolchain) -> None:
    with pytest.raises(KeyError, match="fxc"):
        toolchain.check([Job("fxc", "frag", HLSL)])


VERTEX = """#version 450
layout(location = 0) in vec3 place;
layout(location = 0) out vec3 normal;
void main() {
  normal = place;
  gl_Position = vec4(place, 1.0);
}
"""


HLSL_VERTEX = """struct Crossing { float4 place : SV_Position; float3 normal : TEXCOORD0; };
Crossing shade(float3 place : POSITION) {
  Crossing crossing = { float4(place, 1), place };
  return crossing;
}
"""

GLSL_JOBS = Job("glslang-vulkan", "vert", VERTEX), Job("glslang-vulkan", "frag", VULKAN)
HLSL_JOBS = (
    Job("glslang-hlsl", "vert", HLSL_VERTEX, "shade"), Job("glslang-hlsl", "frag", HLSL, "shade")
)  # fmt: skip


def _with(jobs: tuple[Job, Job], stage: str, old: str, new: str) -> list[Job]:
    """The jobs after changing the text of one."""
    return [
        replace(job, text=job.text.replace(old, new)) if job.stage == stage else job for job in jobs
    ]


@pytest.mark.parametrize(
    ("jobs", "statuses", "processes"),
    [
        (GLSL_JOBS, ["accepted", "accepted"], 1),
        (_with(GLSL_JOBS, "frag", "* tint", "* hue"), ["accepted", "rejected"], 3),
        (_with(GLSL_JOBS, "vert", "= place;", "= hue;"), ["rejected", "accepted"], 3),
        # No program is made of these two. Nobody has said that it should be.
        ([GLSL_JOBS[0], replace(GLSL_JOBS[1], text=VULKAN.replace("in vec3", "in vec4").replace(
            "normal)", "normal.xyz)"))], ["accepted", "accepted"], 3),
        (HLSL_JOBS, ["accepted", "accepted"], 1),
        (_with(HLSL_JOBS, "frag", "* tint", "* hue"), ["accepted", "rejected"], 3),
        (_with(HLSL_JOBS, "vert", "place };", "hue };"), ["rejected", "accepted"], 3),
        # There is one name for the entry points of all texts on a command line.
        ([HLSL_JOBS[0], replace(HLSL_JOBS[1], text=HLSL.replace("shade", "lit"), entry="lit")],
         ["accepted", "accepted"], 2),
    ],
    ids=[
        "both good", "bad fragment", "bad vertex", "unlike",
        "HLSL", "HLSL, bad fragment", "HLSL, bad vertex", "HLSL, two names",
    ],
)  # fmt: skip
def test_the_stages_of_a_program_share_a_process(
    jobs: Sequence[Job],
    statuses: list[str],
    processes: int,
    toolchain: Toolchain,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    """The answers are those of a process for each."""
    alone = [toolchain.check([job], keep_modules=True)[0] for job in jobs]
    started = []
    run = Toolbox.run

    def counted(self: Toolbox, tool: str, *arguments: str, **options: Any) -> Outcome:
        started.append(tool)
        return run(self, tool, *arguments, **options)

    monkeypatch.setattr(Toolbox, "run", counted)
    verdicts = toolchain.check(jobs, keep_modules=True)
    assert [verdict.status for verdict in verdicts] == statuses
    assert started.count("glslang") == processes
    assert [(v.spirv, v.messages) for v in verdicts] == [(v.spirv, v.messages) for v in alone]
