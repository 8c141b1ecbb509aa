"""Languages without global resources hand them to functions as arguments."""

from __future__ import annotations

import re
from pathlib import Path

import pytest

from burnish.support.frozen import changed
from burnish.targets import registry
from burnish.targets.emit.emitter import Emission, emit
from burnish.targets.legalise.forms import form_for
from burnish.targets.legalise.legalise import legalise

from .kit import SINGLE, staged

WGSL = registry.load("wgsl")
TOY = changed(
    WGSL,
    resource_arguments=True,
    forms=changed(WGSL.forms, block_argument="{name}: ptr<uniform, {type}>"),
)
"""WGSL, if its blocks, textures and samplers were arguments."""


def printed(source: str | Path) -> Emission:
    profile = TOY.profiles[0]
    form = form_for(staged(source), profile)
    return emit(legalise(form.program, TOY, profile, form.undecided))


def functions(text: str) -> dict[str, tuple[str, str]]:
    """The parameters and the body of each function of a text, by name, without line breaks."""
    flat = re.sub(r"(?<=[(,])\s+|\s+(?=\))", " ", text).replace("( ", "(").replace(" )", ")")
    found = re.findall(r"^fn (\w+)\((.*?)\)(?: -> [^\n]*)? \{\n(.*?)^\}", flat, re.M | re.S)
    return {name: (parameters, body) for name, parameters, body in found}


def test_a_language_with_global_resources_passes_nothing() -> None:
    assert legalise(staged(SINGLE[0]).program, WGSL, WGSL.profiles[0]).passed == {}


def test_a_function_gets_the_texture_that_it_reads() -> None:
    text = """
    material M {
        map grain : texture2d
        rows = sum i in 0..40 : grain.load(ivec2(uv * float(i)), i).r
        more = sum i in 0..40 : grain.load(ivec2(uv.yx * float(i)), i + 1).r
        color = vec3(rows + more)
    }
    """
    found = functions(printed(text).files[1].text)
    assert found["safe_load"][0].startswith("grain: texture_2d<f32>, place: vec2i, ")
    assert "safe_load(grain, safe_to_int(input.uv * " in found["main"][1]
    assert "grain" not in found["safe_to_int"][0]


def test_the_function_of_a_light_gets_the_blocks_that_it_reads() -> None:
    path = next(path for path in SINGLE if path.stem == "plastic")
    found = functions(printed(path).files[1].text)
    assert found["lambert_phong"][0].startswith("material: ptr<uniform, Material>, to_light: ")
    assert "lambert_phong(material, " in found["main"][1]


def test_a_function_gets_what_only_those_read_that_it_calls() -> None:
    text = """
    fn grit(t: texture2d, steps: float[4], p: vec2) -> vec3 =
        t.level(p, steps[clamp(int(p.x), 0, 3)]).rgb * sin(p.x) + t.level(p.yx, 2).bgr * cos(p.y)
    fn layers(t: texture2d, steps: float[4], p: vec2) -> vec3 =
        grit(t, steps, p) * exp(p.x) + grit(t, steps, p * p.y) * tan(p.x) + grit(t, steps, sin(p))
    material M {
        map grain : texture2d
        param steps : float[4]
        color = layers(grain, steps, uv) + layers(grain, steps, uv.yx)
            + layers(grain, steps, 2 * uv)
    }
    """
    found = functions(printed(text).files[1].text)
    passed = "material, grain, grain_sampler, "
    declared = "material: ptr<uniform, Material>, grain: texture_2d<f32>, grain_sampler:"
    for name, called in (("main", "layers_grain"), ("layers_grain", "grit_grain")):
        assert found[called][0].startswith(declared)
        assert f"{called}({passed}" in found[name][1]
    assert "steps" not in found["layers_grain"][0]


@pytest.mark.parametrize("path", SINGLE, ids=lambda path: path.stem)
def test_functions_get_what_they_read_or_hand_on(path: Path) -> None:
    emission = printed(path)
    names = emission.names
    resources = {*names.variables.values(), *names.textures.values(), *names.samplers.values()}
    for file in emission.files:
        found = functions(file.text)
        gets = {
            name: [word for word in re.findall(r"(\w+):", parameters) if word in resources]
            for name, (parameters, _) in found.items()
        }
        for name, (_, body) in found.items():
            read = {word for word in re.findall(r"(?<!\.)\b\w+\b", body) if word in resources}
            assert name == "main" or read == set(gets[name])
            for called, arguments in re.findall(r"\b(\w+)\(([\w, ]*)", body):
                assert arguments.split(", ")[: len(gets.get(called, ()))] == gets.get(called, [])
