"""The values of lights, rigs and terms."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.reference.namespace import Lanes

from .kit import color, shader

GLOW = """
light Glow : Light {
    param power : float = 1
    diffuse_color  = vec3(1)
    specular_color = vec3(1)
    to_light = normal
    falloff  = power * boost
    boost    = 1.0
}
term shine(k: rgb) per light = k * light.diffuse
term plain(k: rgb) = k * alpha
"""
POWERS: Lanes = (((1.0,),), ((10.0,),), ((100.0,),))


def shone(rig: str, expression: str = "shine(vec3(1))", members: str = "", **given: Lanes) -> float:
    """The first lane of a colour under a rig; names of leaves have `__` for the dot."""
    text = f"{GLOW}\nrig R {{ {rig} }}\nmaterial M {{ {members}\ncolor = {expression} }}"
    value = color(text, {name.replace("__", "."): value for name, value in given.items()})[0]
    assert isinstance(value, float)
    return value


def test_one_light() -> None:
    assert shone("a : Glow", a__power=(3.0,)) == 3


def test_lights_add_up() -> None:
    assert shone("a : Glow  b : Glow", a__power=(3.0,), b__power=(4.0,)) == 7


def test_all_of_an_array_shine() -> None:
    assert shone("lamps : Glow[3]", lamps=POWERS) == 111


@pytest.mark.parametrize(
    ("count", "expected"), [(-1, 0), (0, 0), (1, 1), (2, 11), (3, 111), (4, 111), (2**31 - 1, 111)]
)
def test_as_many_shine_as_the_host_says_and_there_are(count: int, expected: float) -> None:
    assert shone("lamps : Glow[<= 3]", lamps=POWERS, lamps__count=(count,)) == expected


def test_no_light_shines_until_the_host_counts() -> None:
    assert shone("lamps : Glow[<= 3]", lamps=POWERS) == 0


def test_a_count_is_a_constant() -> None:
    text = "many = 1 + 2\n" + GLOW + "rig R { lamps : Glow[many] }\nmaterial M {}"
    assert "lamps" in {info.leaf.name for info in shader(text).parameters}
    infos = {info.leaf.name: info for info in shader(text).parameters}
    assert infos["lamps"].declared_type == "Glow[3]"
    assert [member.leaf.name for member in infos["lamps"].members] == ["power"]


def test_all_kinds_of_entries_together() -> None:
    rig = "a : Glow  lamps : Glow[3]  more : Glow[<= 3]"
    given = {"a__power": (1000.0,), "lamps": POWERS, "more": POWERS, "more__count": (2,)}
    assert shone(rig, "shine(vec3(1))", "", **given) == 1122


def test_a_rig_sets_slots_of_its_lights() -> None:
    assert shone("a : Glow { power = 5 }") == 5
    assert shone("a : Glow { boost = 5 }", a__power=(2.0,)) == 10
    assert shone("a : Glow { boost = power }", a__power=(3.0,)) == 9
    assert shone("a : Glow { falloff = inherited.falloff + 1 }", a__power=(3.0,)) == 4
    assert shone("lamps : Glow[3] { boost = 2 }", lamps=POWERS) == 222


def test_a_parameter_that_a_rig_sets_is_none_for_the_host() -> None:
    text = GLOW + "rig R { a : Glow { power = 5 }  b : Glow }\nmaterial M {}"
    names = {info.leaf.name for info in shader(text).parameters}
    assert "a.power" not in names
    assert "b.power" in names


def test_a_light_overrides_what_it_inherits() -> None:
    heir = "light Half : Glow { falloff = inherited.falloff / 2  boost = 10.0 }"
    text = GLOW + heir + "rig R { a : Half }\nmaterial M { color = shine(vec3(1)) }"
    assert color(text, {"a.power": (3.0,)}) == (15, 15, 15)


def test_a_light_reads_the_surface_that_it_shines_on() -> None:
    light = "light Near : Glow { falloff = power * position.x + uv.y }"
    text = GLOW + light + "rig R { a : Near }\nmaterial M { color = shine(vec3(1)) }"
    assert color(text, {"a.power": (2.0,)}) == (1.75, 1.75, 1.75)


def test_different_lights_share_what_a_term_reads() -> None:
    light = "light Other : Light { to_light = -normal  falloff = 5 }"
    text = GLOW + light + "rig R { a : Glow  b : Other }\nmaterial M { color = shine(vec3(1)) }"
    assert color(text, {"a.power": (2.0,), "b.diffuse_color": (1.0, 2.0, 3.0)}) == (7, 12, 17)


def test_a_term_that_reads_no_light_counts_each_of_them() -> None:
    text = (
        "term each() per light = 1\nrig R { a : G  b : G[3] }\nmaterial M { color = vec3(each()) }"
    )
    assert color(GLOW.replace("Glow", "G") + text, {"b": POWERS}) == (4, 4, 4)


def test_a_term_without_lights_is_evaluated_once() -> None:
    assert shone("a : Glow  b : Glow", "plain(vec3(2))", "alpha = 0.5") == 1


def test_the_result_of_a_term_is_of_its_written_type() -> None:
    text = "term flat() -> rgb per light = 0.5\nrig R { a : Glow  b : Glow }\n"
    assert color(GLOW + text + "material M { color = flat() }") == (1, 1, 1)


def test_terms_are_overloaded_and_generic() -> None:
    text = """
        term soft(k: float) per light = k * light.falloff
        term soft(k: float, l: float) per light = soft(k) * l
        term same<T: floats>(k: T) -> T per light = k * light.falloff
        rig R { a : Glow }
        material M { color = vec3(soft(2), same(3.0), same(uv).y) }
    """
    assert color(GLOW + text, {"a.power": (10.0,)}) == (20, 30, 7.5)


def test_a_library_light() -> None:
    text = """
        import std.lights
        import std.terms
        rig R { sun : Directional { direction = vec3(0, 0, -1) } }
        material M { color = lambert(vec3(0.5)) + ambient(vec3(1)) }
    """
    assert color(text, {"sun.diffuse_color": (1.0, 0.0, 2.0)}) == pytest.approx((0.6, 0.1, 1.1))


def test_of_several_rigs_one_is_named() -> None:
    text = GLOW + "rig A { a : Glow { power = 1 } } rig B { b : Glow { power = 2 } }"
    text += "material M { color = shine(vec3(1)) }"
    assert color(text, rig="B") == (2, 2, 2)


WITH: dict[str, float] = {
    "alpha": 1,
    "(plain(vec3(1)) with { alpha = 3 }).x": 3,
    "(plain(vec3(alpha)) with { alpha = 3 }).x": 3,
    "(plain(vec3(1)) with { alpha = alpha + 3 }).x": 4,
    "(plain(vec3(1)) with { alpha = 3 }).x + alpha": 4,
    "(deep() with { base = 5 })": 10,
    "(deep() with { double = 3 })": 3,
    "(deep() with { base = 5, double = base })": 1,
    "(around() with { alpha = 7 })": 7,
    "reset()": 2,
    "(reset() with { alpha = 3 })": 6,
    "moved()": 21,
    "(lit() with { normal = vec3(0, 1, 0) })": 1,
}
WITH_HEAD = """
term deep() = material_double()
term material_double() = double
term around() = alpha
term reset() = (around() with { alpha = 2 }) * alpha
term scaled(k: float) = k * alpha
term moved() = scaled(alpha + 2) with { alpha = 7 }
term lit() per light = dot(light.to_light, vec3(0, 1, 0))
rig R { a : Glow }
"""


@pytest.mark.parametrize(("expression", "expected"), WITH.items(), ids=WITH)
def test_with(expression: str, expected: float) -> None:
    members = "base : float = 1  double = 2 * base"
    text = f"{GLOW}{WITH_HEAD}material M {{ {members}  color = vec3({expression}) }}"
    assert color(text)[0] == pytest.approx(expected)


NAMED: dict[str, list[str]] = {
    "param sun : float = 1": ["Shed.sun.place", "lamps"],
    "map lamps : texture2d": ["sun.place", "Shed.lamps"],
    "attribute sun : vec3": ["sun.place", "lamps"],
    "sun = 1.0  lamps = 2.0": ["sun.place", "lamps"],
}


@pytest.mark.parametrize(("member", "expected"), NAMED.items(), ids=NAMED)
def test_a_material_need_not_know_the_names_of_lights(member: str, expected: list[str]) -> None:
    whole = shader(f"""
        light Dot {{ param place : point<world> = vec3(0)  diffuse = vec3(0)  specular = vec3(0)
                    to_light = normalize(place - position + vec3(1, 2, 3)) }}
        rig Shed {{ sun : Dot {{ diffuse_color = vec3(1)  specular_color = vec3(1) }}
                   lamps : Dot[2] }}
        material M {{ {member} }}
    """)
    lights = [info.leaf.name for info in whole.parameters if info.light]
    assert lights == expected


def test_the_library_s_rig_takes_no_name_from_a_material() -> None:
    whole = shader("material Sky { param sun : direction<world> = vec3(0, 1, 0) }")
    assert {"sun", "Daylight.sun.direction"} < {info.leaf.name for info in whole.parameters}


def test_a_rig_is_told_what_words_of_other_systems_are_here() -> None:
    text = "import std.lights.{Spot}\nrig R { l : Spot { penumbra = 0.4 } }\nmaterial M {}"
    (found,) = burnish.check(text)
    assert "`inner` and `outer`" in str(found.hint)
