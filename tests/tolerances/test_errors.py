"""Planted errors: what each slip makes of a text, and that each error of a host changes a job."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.drivers.frame_job import FrameDraw, FrameJob, FrameStep
from burnish.targets.runner.drivers.pipeline import Pipeline, VertexInput
from burnish.targets.runner.drivers.slots import Place, TextureSlot
from burnish.targets.runner.drivers.texels import Image

from ..mutants.texts import text_changes
from .errors import HOST_ERRORS, SLIPS, HostError

GLSL = """void main() {
    vec3 tint = base * texture(sampler2D(albedo, albedo_sampler), v_uv).xyz;
    vec3 normal = v_normal * inversesqrt(max(dot(v_normal, v_normal), 1.1754944e-38));
    vec3 side = cross(normal, up);
    for (int i = 0; i < min(lamps_count, 8); i++) {
        total += normalize(lamps[i].place) * 0.31830987;
    }
    vec3 color = pow(total, 5.0) + side;
    out_color = vec4(color, 1.0);
}
"""
GLSL_SLIPS = [
    "6 constant of three digits: 0.31830987 -> 0.318",
    "6 not normalised: normalize -> nothing",
    "3 not normalised: * inversesqrt(max(dot(v_normal, v_normal), 1.1754944e-38)) -> nothing",
    "8 term left out: + side -> nothing",
    "6 sum overwritten: += -> =",
    "5 loop one short: ; i < min(lamps_count, 8); i++ -> ; i < min(lamps_count, 8) - 1; i++",
    "5 loop from one: for (int i = 0 -> for (int i = 1",
    "4 cross product turned: cross(normal, up) -> cross(up, normal)",
    "8 other exponent: pow(total, 5.0) -> pow(total, 4.0)",
    "9 1 % too bright: out_color = vec4(color, 1.0); -> out_color = vec4(color * 1.01, 1.0);",
]
READ = "texture(sampler2D(albedo, albedo_sampler), v_uv)"


def test_slips_in_a_text() -> None:
    found = [change.told(GLSL) for change in text_changes(GLSL, SLIPS)]
    assert [told for told in found if READ not in told] == GLSL_SLIPS


@pytest.mark.parametrize(
    ("read", "slips"),
    [
        (READ, [
            "texture(sampler2D(albedo, albedo_sampler), v_uv + 0.015625)",
            "texture(sampler2D(albedo, albedo_sampler), v_uv, 1.0)",
            "pow(texture(sampler2D(albedo, albedo_sampler), v_uv), vec4(2.2))",
        ]),
        ("albedo.Sample(albedo_sampler, input.uv)", [
            "albedo.Sample(albedo_sampler, input.uv + 0.015625)",
            "albedo.SampleBias(albedo_sampler, input.uv, 1.0)",
            "pow(albedo.Sample(albedo_sampler, input.uv), 2.2)",
        ]),
        ("textureSample(albedo, albedo_sampler, input.uv)", [
            "textureSample(albedo, albedo_sampler, input.uv + 0.015625)",
            "textureSampleBias(albedo, albedo_sampler, input.uv, 1.0)",
            "pow(textureSample(albedo, albedo_sampler, input.uv), vec4f(2.2))",
        ]),
    ],
)  # fmt: skip
def test_slips_in_a_read(read: str, slips: list[str]) -> None:
    assert [change.applied(read) for change in text_changes(read, SLIPS)] == slips


PLACE = Place("x", 0, 0)


def _floats(*values: float) -> bytes:
    return np.array(values, "<f4").tobytes()


def _job() -> FrameJob:
    """A triangle with two textures, each with another picture and two levels."""
    texels = np.random.default_rng(7).integers(0, 256, (2, 20, 4), np.uint8)
    first, second = (
        Image("rgba8unorm", 4, 4, (each[:16].tobytes(), each[16:].tobytes())) for each in texels
    )
    slots = (TextureSlot(PLACE, PLACE, wrap="mirror"), TextureSlot(PLACE, PLACE))
    drawn = Draw(
        8, 8, 3, (_floats(0.1, 0.2, 0.3),), np.arange(3, dtype="<u4").tobytes(),
        (_floats(0.7, 3.3),), (first, second),
    )  # fmt: skip
    made = Pipeline({}, (VertexInput("x", 0, "float32"),), (), slots, ())
    return FrameJob((), (), (made,), (FrameStep(draws=(FrameDraw(0, (), (), drawn),)),))


@pytest.mark.parametrize("error", HOST_ERRORS, ids=lambda error: error.name)
def test_each_error_of_a_host_changes_the_job(error: HostError) -> None:
    job = _job()
    assert error.change(job) != job
    nothing = replace(job, pipelines=(), steps=())
    assert error.change(nothing) == nothing
