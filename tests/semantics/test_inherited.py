"""Values that overrides build on: parameters, textures and vertex inputs behind ``inherited``."""

from __future__ import annotations

import pytest

from burnish.compiler.ir.shader import ParameterInfo
from burnish.compiler.reference.namespace import Lanes

from .kit import Given, Painted, color, shader

BASE = """
abstract material Base {
    /// How much
    param k : float in 0..16 per draw = 0.25
    color = vec3(k, 0, 0)
}
"""
SCALED = "abstract material Scaled : Base { k = 10 * inherited.k }"
SUMMED = "mixin Summed { k : float = inherited.k + 3 }"


def parameters(text: str) -> dict[str, ParameterInfo]:
    return {info.leaf.name: info for info in shader(text).parameters}


@pytest.mark.parametrize(
    ("heirs", "expected"),
    [
        ("material M : Base { k = 10 * inherited.k }", 5),
        ("material M : Base { once = inherited.k  k = 7  color = vec3(once) }", 0.5),
        (f"{SCALED} material M : Scaled {{ k = inherited.k + 1 }}", 6),
        (f"{SCALED} material M : Scaled {{ color = inherited.color + inherited.k }}", 10),
        (f"{SCALED} material M : Scaled {{ param k : float  color = vec3(inherited.k) }}", 5),
        ("abstract material N : Base { param k : float = 2 }"
         "material M : N { k = inherited.k + 1 }", 1.5),
        ("abstract material N : Base { raw = inherited.k }"
         "material M : N { k = 7  color = vec3(raw) }", 0.5),
        (f"{SUMMED} material M : Base + Summed {{ }}", 3.5),
        (f"{SUMMED} material M : Base + Summed {{ k = 2 * inherited.k }}", 7),
        (f"{SUMMED} {SCALED} material M : Scaled + Summed {{ }}", 8),
    ],
)  # fmt: skip
def test_an_override_builds_on_a_parameter(heirs: str, expected: float) -> None:
    assert color(BASE + heirs, {"k": (0.5,)})[0] == expected


@pytest.mark.parametrize(
    "value",
    [
        "sum i in 0..inherited.n : 0.5",
        "sum i in inherited.n..9 : 0.5",
        "iterate x from 0.0 up to inherited.n : x + 0.5",
        "iterate x from 0.0 up to 9 while x < float(inherited.n) : x + 0.5",
        "[0.5, float(inherited.n)][1]",
        "(ambient(vec3(1)) with { ambient_light = vec3(float(inherited.n)) }).x",
    ],
)
def test_it_is_found_wherever_it_is_written(value: str) -> None:
    text = (
        "import std.terms.{ambient}\n"
        "abstract material Counted { param n : int in 1..8 = 3 }\n"
        f"material M : Counted {{ n = 2  color = vec3({value}) }}"
    )
    assert "n" in parameters(text)


def test_the_parameter_stays_one_as_it_was_declared() -> None:
    k = parameters(BASE + "material M : Base { /// Tenfold\nk = 10 * inherited.k }")["k"]
    assert (k.range, k.default, k.doc, k.leaf.group) == ((0, 16), 0.25, "How much", "draw")


@pytest.mark.parametrize(
    "heirs",
    [
        "material M : Base { k = 7 }",
        f"{SCALED} material M : Scaled {{ k = 7 }}",
        f"{SCALED} material M : Scaled {{ color = vec3(1)  k = 7 }}",
        "abstract material N : Base { color = vec3(inherited.k) }"
        "material M : N { color = vec3(1)  k = 7 }",
    ],
)
def test_a_parameter_on_which_nothing_builds_any_more_is_none(heirs: str) -> None:
    assert "k" not in parameters(BASE + heirs)


def test_what_nobody_reads_keeps_its_place() -> None:
    assert "k" in parameters(BASE + "material M : Base { k = 10 * inherited.k  color = vec3(1) }")


def test_the_nearest_declaration_of_a_parameter_describes_it() -> None:
    heirs = """
    abstract material N : Base { param k : float in 0..8 = 4  raw = inherited.k }
    material M : N { k = 7  color = vec3(raw) }"""
    k = parameters(BASE + heirs)["k"]
    assert (k.range, k.default, k.leaf.group) == ((0, 8), 4, "material")


def test_a_derived_value_is_never_called_as_a_parameter() -> None:
    import burnish

    heir = "material M : Base { param g : float = 1  plain = inherited.k  k = cos(g) }"
    base = BASE.replace("vec3(k, 0, 0)", "k * vec3(uv, 0)")
    (material,) = burnish.compile(base + heir, "glsl")
    names = [each.name for each in material.reflection.parameters]
    derived = [
        member.name
        for block in material.reflection.blocks
        if block.derived
        for member in block.members
        if member.parameter
    ]
    assert "k" in names
    assert len(derived) == 1
    assert set(names).isdisjoint(derived)


GLOW = """
light Glow : Light {
    param power : float = 1
    to_light = normal
    falloff  = power
}
light Twice : Glow { power = 2 * inherited.power }
term shine() per light = light.diffuse
material M { color = shine() }
"""


@pytest.mark.parametrize(
    ("rig", "given", "expected"),
    [
        ("a : Twice", {"a.power": (3.0,)}, 6),
        ("a : Glow { power = inherited.power + 5 }", {"a.power": (3.0,)}, 8),
        ("a : Twice { power = inherited.power + 5 }", {"a.power": (3.0,)}, 11),
        ("a : Twice { falloff = inherited.power }", {"a.power": (3.0,)}, 6),
    ],
)
def test_parameters_of_lights(rig: str, given: Given, expected: float) -> None:
    assert color(f"{GLOW} rig R {{ {rig} }}", given)[0] == expected


@pytest.mark.parametrize(
    ("entry", "expected"), [("Twice[2]", 22), ("Twice[2] { power = inherited.power + 1 }", 24)]
)
def test_parameters_of_an_array_of_lights(entry: str, expected: float) -> None:
    white = (1.0, 1.0, 1.0)
    lamps: Lanes = ((white, white, (1.0,)), (white, white, (10.0,)))
    assert color(f"{GLOW} rig R {{ a : {entry} }}", {"a": lamps})[0] == expected


def test_vertex_inputs() -> None:
    text = "material M { vertex_uv = inherited.vertex_uv * 2  color = vec3(uv, 0) }"
    assert color(text) == (0.5, 1.5, 0)


def test_a_parameter_in_front_of_a_vertex_input() -> None:
    text = """
    abstract material A { attribute tint : vec3 }
    abstract material B : A { param tint : vec3  both = inherited.tint }
    material M : B { tint = 2 * inherited.tint  color = both + tint }"""
    given: Given = {"tint": (1.0, 2.0, 3.0)}
    assert color(text, given) == (3, 6, 9)
    whole = shader(text)
    assert "tint" in {info.leaf.name for info in whole.parameters}
    assert "tint" in {info.leaf.name for info in whole.attributes}


PICTURES = """
abstract material Base { map paint : texture2d  color = paint(uv).rgb }
"""
CHECKS = Painted(lambda u, v: (u, v, 0.0, 1.0))


@pytest.mark.parametrize(
    ("heir", "expected", "maps"),
    [
        ("color = 2 * inherited.paint(uv).rgb", (0.5, 1.5, 0), ["paint"]),
        ("color = inherited.paint.level(2 * uv, 0).rgb", (0.5, 1.5, 0), ["paint"]),
        ("map other : texture2d  paint = other", (0.25, 0.75, 0), ["other"]),
        ("map other : texture2d  paint = other  color = inherited.paint(2 * uv).rgb",
         (0.5, 1.5, 0), ["paint", "other"]),
        ("map paint : texture2d = black  color = 2 * inherited.color", (0.5, 1.5, 0), ["paint"]),
        ("map paint : texture2d = black  color = inherited.paint(uv).rgb", (0.25, 0.75, 0),
         ["paint"]),
    ],
)  # fmt: skip
def test_textures(heir: str, expected: Lanes, maps: list[str]) -> None:
    text = f"{PICTURES} material M : Base {{ {heir} }}"
    given: Given = {"paint": CHECKS, "other": CHECKS}  # type: ignore[dict-item]
    assert color(text, given) == pytest.approx(expected)
    assert [info.leaf.name for info in shader(text).textures] == maps


def test_a_pass_builds_on_a_parameter_of_the_material() -> None:
    text = """
    pass P : Forward { ambient_light = 2 * inherited.ambient_light }
    material M { color = ambient_light }"""
    assert color(text, {"ambient_light": (1.0, 2.0, 3.0)}, pass_="P") == (2, 4, 6)


def test_a_pass_builds_on_a_parameter_of_its_own_base() -> None:
    text = """
    pass Faint : Forward { param share : float = 1  color = share * inherited.color }
    pass P : Faint { share = inherited.share / 2 }
    material M { color = vec3(8) }"""
    assert color(text, {"share": (0.5,)}, pass_="P") == (2, 2, 2)
