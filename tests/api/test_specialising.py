"""Texts that serve only some values of parameters: ``compile(values=…)`` and ``compile --set``."""

from __future__ import annotations

import re
from collections.abc import Mapping
from pathlib import Path

import pytest

import burnish
from burnish import CompileError

Value = str | float | tuple[float, ...]
BLOCK = re.compile(r"^layout\(std140.*? uniform \w+ \{\n.*?^\};\n\n?", re.M | re.S)
SOURCE = """
material Paint {
    param weight : float in 0..1 = 1
    param gloss  : float in 0..1 = 0.2
    param tint   : rgb = #ff8000
    param count  : int in 0..8 = 4
    param fancy  : bool = true
    param place  : direction<world> = vec3(0, 1, 0)
    param spread : float[3] in 0..1
    map coat : texture2d
    map base : texture2d

    lines = sum i in 0..count : sin(uv.x * float(i)) * spread[i mod 3]
    shine = if gloss > 0.6 then pow(saturate(dot(normal, place)), 40) else 0
    color = (if fancy then base(uv).rgb else tint) * (1 + shine + lines) + weight * coat(uv).rgb
}
"""


def fragment(**values: Value) -> str:
    return compiled(SOURCE, values)


def compiled(source: str, values: Mapping[str, Value]) -> str:
    (material,) = burnish.compile(source, "glsl", values=values)
    return material.text("glsl", "fragment")


def without_blocks(text: str) -> str:
    return BLOCK.sub("", text)


def in_text(**slots: str) -> str:
    """The text with slots in place of some parameters."""
    source = SOURCE
    for name, value in slots.items():
        source = re.sub(rf"param ({name} +: [a-z<>]+)[^\n]*", rf"\1 = {value}", source)
    return source


@pytest.mark.parametrize(
    ("value", "slot"),
    [
        ({"weight": 0}, {"weight": "0"}),
        ({"weight": 1.0, "count": 0}, {"weight": "1", "count": "0"}),
        ({"tint": (0.5, 0.25, 1), "fancy": False}, {"tint": "rgb(0.5, 0.25, 1)", "fancy": "false"}),
        ({"tint": "#ff0000", "fancy": "false"}, {"tint": "#ff0000", "fancy": "false"}),
        ({"count": "3..3"}, {"count": "3"}),
        ({"place": (0, 0, 1)}, {"place": "vec3(0, 0, 1)"}),
    ],
)
def test_a_value_is_a_constant(value: dict[str, Value], slot: dict[str, str]) -> None:
    found = without_blocks(fragment(**value))
    assert found == without_blocks(compiled(in_text(**slot), {}))
    assert found != without_blocks(fragment())


def test_a_range_decides_choices() -> None:
    assert "pow" in fragment() and "pow" in fragment(gloss="0.5..1")
    assert "pow" not in fragment(gloss="0..0.6")
    assert "gloss" not in without_blocks(fragment(gloss="0.7..1"))


def offsets(material: burnish.CompiledMaterial) -> dict[str, tuple[str | None, int]]:
    """The places of the parameters that have one."""
    rows = material.reflection.parameters
    return {row.name: (row.block, row.offset) for row in rows if row.offset is not None}


def test_what_is_dead_is_not_bound_and_the_blocks_stay() -> None:
    (plain,) = burnish.compile(SOURCE, "glsl")
    (special,) = burnish.compile(SOURCE, "glsl", values={"weight": 0, "fancy": True})
    bound = special.reflection.backends["glsl:vulkan"].textures
    assert bound is not None and set(bound) == {"base"}
    assert "coat" not in special.text("glsl", "fragment")
    rows = {row.name: row for row in special.reflection.parameters}
    weight = rows["weight"]
    assert (weight.range, weight.default, weight.read, rows["tint"].read) == ((0, 0), 0, (), ())
    before, after = offsets(plain), offsets(special)
    assert after.items() <= before.items()


def test_a_default_moves_into_the_range() -> None:
    (special,) = burnish.compile(SOURCE, "glsl", values={"gloss": "0.5..0.75"})
    row = next(row for row in special.reflection.parameters if row.name == "gloss")
    assert (row.range, row.default) == ((0.5, 0.75), 0.5)


def test_elements_of_arrays_take_a_range() -> None:
    assert "sin" in fragment(spread="0..0.5")
    assert "sin" not in fragment(spread=0)


@pytest.mark.parametrize(
    ("values", "said"),
    [
        ({"wieght": 0}, "there is no parameter `wieght`: did you mean `weight`?"),
        ({"weight": 2}, "`weight` is declared in 0..1: 2 is not"),
        ({"weight": "0.5..2"}, "`weight` is declared in 0..1: 2 is not"),
        ({"weight": "1..0"}, "the range 1..0 of `weight` is empty"),
        ({"weight": "much"}, "`weight` (float) cannot hold 'much'"),
        ({"tint": (1, 2)}, "`tint` takes 3 numbers (rgb), and was given a list of 2"),
        ({"object_to_world": 1}, "`object_to_world` (transform<object, world>) cannot be narrowed"),
        ({"lines": 1}, "there is no parameter `lines`"),
    ],
)
def test_mistakes_are_told(values: dict[str, Value], said: str) -> None:
    with pytest.raises(CompileError) as raised:
        burnish.compile(SOURCE, "glsl", values=values)
    (found,) = raised.value.diagnostics
    assert found.rule.code == "B0452" and said in found.message


def test_values_of_other_types_are_refused() -> None:
    with pytest.raises(TypeError, match="`values` takes"):
        burnish.compile(SOURCE, "glsl", values={"weight": object()})  # type: ignore[dict-item]


EXAMPLES = Path(__file__).parents[2] / "examples" / "frames"


def texts(path: Path, values: Mapping[str, Value]) -> dict[str, str]:
    result = burnish.compile(path, "glsl", values=values)
    return {each.name: "".join(file.text for file in each.files) for each in result}


def test_a_frame_hands_its_values_on() -> None:
    (path,) = EXAMPLES.glob("glow.burnish")
    assert "glow" in texts(path, {})["Glow.Added"]
    assert "glow" not in texts(path, {"strength": 0})["Glow.Added"]


def test_a_material_of_a_frame_is_named() -> None:
    (path,) = EXAMPLES.glob("lamps.burnish")
    plain = texts(path, {})
    changes = {
        name for name, text in texts(path, {"Clay.base": "0..0"}).items()
        if without_blocks(text) != without_blocks(plain[name])
    }  # fmt: skip
    assert changes == {"Lamps.Forward.Clay"}


@pytest.mark.parametrize("value", ["rusty", "Wear.rusty", 2])
def test_a_member_of_an_enumeration_is_named_or_numbered(value: Value) -> None:
    text = """
enum Wear { clean, used, rusty }
material M {
    param wear : Wear = Wear.clean
    color = if wear == Wear.rusty then vec3(0.75) else vec3(0.5)
}
"""
    (made,) = burnish.compile(text, "wgsl", values={"wear": value})
    assert "0.75" in made.text("wgsl", "fragment") and "0.5" not in made.text("wgsl", "fragment")
