"""Every function of GLSL, HLSL and WGSL is here under its name, said otherwise, or left out."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish import stdlib
from burnish.compiler.semantics.checking.calls import NOT_CALLED
from burnish.compiler.semantics.types.typenames import NAMED
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.elsewhere import KEYWORDS, TYPES, VALUES
from burnish.stdlib.other_names import FUNCTIONS, NODES, SYNONYMS

LANGUAGES = ("glsl", "hlsl", "wgsl")
OF_THE_LANGUAGE = {"mod", "not"}
"""Operators here."""
OF_THE_LIBRARY = {"fwidth"}
"""Functions of the prelude."""
CALLED = (BUILTINS.keys() - NOT_CALLED) | OF_THE_LIBRARY


def names(language: str) -> list[str]:
    """The functions that a language has."""
    path = Path(__file__).parent / "names" / f"{language}.txt"
    lines = path.read_text(encoding="utf-8").splitlines()
    return [name for line in lines if not line.startswith("#") for name in line.split()]


@pytest.mark.parametrize("language", LANGUAGES)
def test_every_function_is_accounted_for(language: str) -> None:
    listed = names(language)
    assert len(listed) > 100
    known = CALLED | OF_THE_LANGUAGE | FUNCTIONS.keys() | SYNONYMS.keys()
    assert [name for name in listed if name not in known] == []


def test_what_is_here_is_not_elsewhere() -> None:
    assert CALLED & FUNCTIONS.keys() == set()
    assert NAMED.keys() & TYPES.keys() == set()
    assert set(TYPES.values()) <= NAMED.keys()


def test_functions_of_the_library_are_there() -> None:
    prelude = (Path(stdlib.__file__).parent / "prelude.burnish").read_text(encoding="utf-8")
    assert all(f"fn {name}<" in prelude for name in OF_THE_LIBRARY)


def test_each_says_something() -> None:
    for name, instead in (*FUNCTIONS.items(), *NODES.items()):
        assert instead.hint, name
        assert not instead.hint.endswith("."), name


SAMPLE = {
    "x": "float", "y": "float", "z": "float", "n": "int", "m": "int", "u": "uint", "k": "uint",
    "v": "vec3", "w": "vec3", "p": "vec4", "q": "vec4", "a": "mat3", "b": "mat3",
}  # fmt: skip
"""The names in ``Instead.written`` with their types; the other names are in ``SURROUNDINGS``."""
SURROUNDINGS = "\n".join(
    [
        "material Sample {",
        *(f"    param {name} : {type_}" for name, type_ in SAMPLE.items()),
        "    map albedo : texture2d",
        "    c = v < w",
        "    d = v > w",
        "    color = #fff",
    ]
)
WRITTEN = sorted(
    {text for instead in (*FUNCTIONS.values(), *NODES.values()) for text in instead.written}
)


def test_what_is_written_instead_compiles() -> None:
    slots = [f"    s{number} = {text}" for number, text in enumerate(WRITTEN)]
    text = "\n".join([SURROUNDINGS, *slots, "}"])
    assert burnish.check(text) == ()


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("color = lerp(color, normal, 0.5)", "it is `mix(x, y, z)` here"),
        ("color = vec3(isnan(uv.x))", "no value is infinite or NaN"),
        ("a : float3 = normal", "it is `vec3` here"),
        ("color = float3(uv, 0)", "it is `vec3` here"),
        ("color = vec3(OneMinus(uv.x))", "it is `1 - x` here"),
        ("color = vec3(one_minus(uv.x))", "it is `1 - x` here"),
        ("color = PrincipledBSDF(#fff)", "materials of `std.models` are bases"),
        ("color = vec3(snoise(uv))", "did you mean `simplex_noise`? add `import std.noise."),
        ("color = curlNoise(position)", "did you mean `curl_noise`? add `import std.noise."),
        ("color = vec3(fbm(uv, 4))", "add `import std.noise.{fbm}`"),
        ("a = gl_FragCoord.x", "it is `frag_coord` here"),
        ("a = viewDir", "it is `to_eye` here"),
        ("a = lightDir", "it is `light.to_light` here"),
        ("a = model * vertex_position", "it is `object_to_world` here"),
        ("return color", "a function is one expression"),
        ("static const = 1", "an equation is `name = expression`"),
        ("uniform float x", "a value that the host sets is a parameter"),
        ("color = vec3(a < b ? a : b)", "`if a < b then a else b`"),
    ],
)
def test_a_habit_is_answered(text: str, hint: str) -> None:
    found = burnish.check(f"material M {{ {text} }}")
    assert any(hint in diagnostic.hint for diagnostic in found), [d.hint for d in found]


def test_every_keyword_begins_no_member() -> None:
    for word, hint in KEYWORDS.items():
        found = burnish.check(f"material M {{ {word} thing }}")
        assert any(hint in d.hint for d in found), word


def test_values_are_known_here() -> None:
    for name in VALUES.values():
        text = f"material M {{ a = {name}  color = #fff }}"
        if name.startswith("light."):
            text = f"term t() per light = vec3({name})\nmaterial M {{ color = t() }}"
        assert burnish.check(text) == ()
