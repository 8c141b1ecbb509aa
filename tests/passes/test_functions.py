"""Functions that are called repeatedly are functions of the text; all others are written out."""

from __future__ import annotations

import re

import pytest

import burnish

from .agreement import disagreements
from .kit import World, history, shader

WORLDS = [World(seed) for seed in range(3)]

HASH = "fn hash(p: vec2) -> float = fract(sin(dot(p, vec2(12.9, 78.2))) * 43758.5)\n"
NOISE = "fn noise(p: vec2) -> float = mix(hash(floor(p)), hash(floor(p) + 1), fract(p.x))\n"
FBM = "fn fbm(p: vec2, n: int) -> float = sum i in 0..n : noise(p * float(i + 1)) * 0.5\n"
WAVE = "fn wave(x: float, k: float) -> float = sin(x) * cos(x * x) + k * sin(x * 3)\n"


def functions(text: str) -> list[str]:
    """The names of the fragment stage's functions, in order."""
    return [f.name for f in history(shader(text)).staged.program.stage("fragment").functions]


SHARED = {
    "called twice": (WAVE, "vec3(wave(uv.x, uv.y), wave(uv.y, uv.x), 0)", ["wave"]),
    "called once": (WAVE, "vec3(wave(uv.x, uv.y))", []),
    "the same call twice": (WAVE, "vec3(wave(uv.x, uv.y), wave(uv.x, uv.y), 0)", []),
    "hardly more than its call": (
        "fn twice(x: float) -> float = x * 2\n",
        "vec3(twice(uv.x), twice(uv.y), 0)",
        [],
    ),
    "of constants": (WAVE, "vec3(wave(1, 2), wave(2, 3), uv.x)", []),
    "of which one call is left": (WAVE, "vec3(wave(1, 2), wave(uv.x, uv.y), 0)", []),
    "called by functions": (HASH + NOISE, "vec3(noise(uv), noise(uv.yx), 0)", ["hash", "noise"]),
    "of what it gave": (HASH + NOISE, "vec3(noise(uv * noise(uv)))", ["hash", "noise"]),
    "of each other's values": (
        HASH + WAVE,
        "vec3(hash(vec2(wave(uv.x, 1))), wave(hash(uv), uv.y), 0)",
        ["wave", "hash"],
    ),
    "whose loop needs a number": (
        HASH + NOISE + FBM,
        "vec3(fbm(uv, 5), fbm(uv.yx, 5), fbm(uv, 7))",
        ["hash", "noise", "fbm"],
    ),
    "twice in a loop": (
        WAVE,
        "vec3(sum i in 0..9 : wave(uv.x, float(i)) * wave(float(i), uv.x))",
        ["wave"],
    ),
    "for two types": (
        "fn bent<T: floats>(a: T) -> T = sin(a) * cos(a) + sqrt(abs(a))\n",
        "vec3(bent(uv) + bent(uv.yx), bent(uv.x * 2) + bent(uv.y * 3))",
        ["bent", "bent_float"],
    ),
    "of structures": (
        "struct Ray { at : vec2, far : float }\n"
        "fn glow(r: Ray) -> float = sin(r.far) * cos(r.at.x) + sin(r.at.y * 2)\n",
        "vec3(glow(Ray(uv, uv.x)), glow(Ray(uv.yx, 1)), 0)",
        ["glow"],
    ),
}


@pytest.mark.parametrize(("given", "color", "names"), SHARED.values(), ids=SHARED)
def test_what_becomes_a_function(given: str, color: str, names: list[str]) -> None:
    text = f"{given}material M {{ color = {color} }}"
    assert sorted(functions(text)) == sorted(names)
    assert not disagreements(shader(text), WORLDS)


def test_two_functions_of_one_argument_are_not_fused_like_terms() -> None:
    text = HASH + WAVE + "material M { color = vec3(hash(uv) + wave(uv.x, hash(uv * 2))) }"
    text = text.replace("hash(uv * 2)", "hash(uv * 2)) + vec3(wave(uv.y, hash(uv.yx))")
    assert sorted(functions(text)) == ["hash", "wave"]


def test_textures_name_their_functions() -> None:
    text = """
    fn soft(t: texture2d, p: vec2) -> vec3 = t(p).rgb * sin(p.x) + t(p * 2).rgb * cos(p.y)
    material M {
        map albedo : texture2d = white
        map detail : texture2d = gray
        a     = soft(albedo, uv) + soft(albedo, uv * 3)
        b     = soft(detail, uv) + soft(detail, uv * 3)
        color = a * b
    }
    """
    assert sorted(functions(text)) == ["soft_albedo", "soft_detail"]


def test_a_guard_goes_only_if_all_calls_do_without() -> None:
    root = "fn root(x: float) -> float = sqrt(x) * sin(x) + sqrt(x * 2)\n"
    proven = history(
        shader(root + "material M { color = vec3(root(abs(uv.x)) + root(abs(uv.y))) }")
    )
    asking = history(shader(root + "material M { color = vec3(root(abs(uv.x)) + root(uv.y)) }"))
    assert not proven.staged.guards
    assert {guard.builtin for guard in asking.staged.guards} == {"sqrt"}


def test_what_depends_on_parameters_leaves_the_shader() -> None:
    text = """
    fn turned(m: mat3, v: vec3) -> vec3 = inverse(m) * v
    material M { param a : mat3; param b : mat3; color = turned(a, turned(b, normal)) }
    """
    past = history(shader(text))
    assert "turned" not in [f.name for f in past.staged.program.stage("fragment").functions]
    assert len(past.staged.derived) >= 2


def test_names_and_comments_of_functions() -> None:
    text = "/// Mixes bits.\n" + HASH + "material M { color = vec3(hash(uv), hash(uv.yx), 0) }"
    for target, head in (("glsl", "float hash(vec2 p) {"), ("wgsl", "fn hash(p: vec2f) -> f32 {")):
        whole = burnish.compile(text, (target,)).materials[0].text(target, "fragment")
        assert re.search(re.escape(f"/// Mixes bits.\n{head}"), whole)


LIT = """import std.lights
rig R {{ one : Point; two : Point }}
term lit(w: vec2, b: float) per light =
    light.diffuse * sin(dot(light.to_light, normal)) * ({of_each})
material M {{
    param tint : vec2
    wide = sin(uv) * 2
    u    = wide.x
    bent = cos(uv.x) * cos(uv.y)
    color = {color}
}}
"""

PASSED = {
    "the whole for its parts": ("w.x * light.to_light.x + w.y", "lit(cos(uv), 0)", ["cos"]),
    "what has its sign turned": ("-b * light.to_light.x + b", "lit(uv, bent)", ["bent"]),
    "a part that the user named": ("b + light.to_light.x", "lit(wide, u)", ["u"]),
    "no uniform": ("-w.x * light.to_light.x + w.y", "lit(tint, 0)", []),
}


@pytest.mark.parametrize(("of_each", "color", "names"), PASSED.values(), ids=PASSED)
def test_what_a_body_needs_of_its_caller(of_each: str, color: str, names: list[str]) -> None:
    text = LIT.format(of_each=of_each, color=color)
    *_, lit = history(shader(text)).staged.program.stage("fragment").functions
    assert [formal.name for formal, _type in lit.parameters] == [
        "diffuse", "to_light", *names, "normal"
    ]  # fmt: skip


WHOLES = {
    "a loop's states": "(iterate p from Pair(uv.x, normal) for i in 0..9 : Pair(p.a, p.b + p.a)).b",
    "an element": "pairs[int(frag_coord.x) mod 3].b",
}


@pytest.mark.parametrize("member", WHOLES.values(), ids=WHOLES)
def test_only_plain_values_are_passed(member: str) -> None:
    """Members of what is no plain value are passed themselves."""
    text = (
        "import std.lights\nrig R { one : Point; two : Point }\n"
        "struct Pair { a : float, b : vec3 }\n"
        "term lit(v: vec3) per light = light.diffuse * sin(dot(light.to_light, v)) * cos(v)\n"
        f"material M {{ param pairs : Pair[3]  color = lit({member}) }}"
    )
    assert not disagreements(shader(text), WORLDS)


CIRCLES = {
    "by a condition": (
        "fn f(x: float, y: float) -> float ="
        " if x < sqrt(y) then sqrt(x) * sin(x + y) else sin(y) / x\n"
    ),
    "by a state": (
        "struct Pair { a : float, b : float }\n"
        "fn f(x: float, y: float) -> float = (iterate s from Pair(x, y) for i in 0..12"
        " while s.a < 2 : Pair(s.a + s.b, s.b * 0.5 + s.a)).a\n"
    ),
}


@pytest.mark.parametrize("given", CIRCLES.values(), ids=CIRCLES)
def test_what_a_function_gives_may_be_what_it_gets(given: str) -> None:
    text = f"{given}material M {{ color = vec3(f(f(f(uv.x, uv.y), f(uv.y, uv.x)), uv.x)) }}"
    assert "f" in functions(text)
    assert not disagreements(shader(text), WORLDS)
