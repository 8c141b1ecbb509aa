"""Sentences tell what a shader does not compute, what shows it, and what nothing reads any more."""

from __future__ import annotations

import burnish

SOURCE = """
fn ring(x: float, by: float) -> float = by * sin(x)
material Paint {
    param weight : float in 0..1 = 1
    param gloss  : float in 0..1 = 0.2
    param count  : int in 0..8 = 4
    param fancy  : bool = true
    param tint   : rgb
    param stray  : float
    map coat : texture2d
    map base : texture2d

    coated = weight * coat(uv).rgb
    rings = sum i in 0..count : sin(uv.x * float(i) + stray)
    shine = if gloss > 0.6 then pow(saturate(normal.y), 40) else 0
    color = (if fancy then base(uv).rgb else tint) * (1 + shine + rings) + coated * (1 - gloss)
        + ring(uv.y, weight)
}
"""


def told(**values: str | float) -> list[str]:
    (material,) = burnish.compile(SOURCE, "glsl", values=values)
    return [f"{removal.span}: {removal.sentence}" for removal in material.removals]


def test_nothing_is_told_where_nothing_is_known() -> None:
    assert told() == []


def test_a_product_with_zero() -> None:
    assert told(weight=0) == [
        "<text>:2:41: `weight` is 0, so `weight * sin(uv.y)` is 0.",
        "<text>:16:76: `weight` is 0, so `coated * (1 - gloss)` is 0. Nothing reads the map `coat` "
        "any more.",
    ]


def test_a_choice_by_a_range() -> None:
    assert told(gloss="0..0.6") == [
        "<text>:15:13: `gloss` is 0..0.6, so `if gloss > 0.6 then pow(saturate(normal.y), 40) "
        "else 0` is `0`. Nothing reads the attribute `vertex_normal` any more."
    ]


def test_a_choice_by_a_bool() -> None:
    (only,) = told(fancy=True)
    assert only.endswith(
        "`fancy` is true, so `if fancy then base(uv).xyz else tint` is `base(uv).xyz`. "
        "Nothing reads the parameter `tint` any more."
    )


def test_a_loop_without_turns() -> None:
    (only,) = told(count=0)
    assert only.endswith(
        "`count` is 0, so `sum i in 0..count : sin(uv.x * float(i) + stray)` is 0. "
        "Nothing reads the parameter `stray` any more. A loop is gone."
    )


def test_a_weight_of_a_mixture() -> None:
    source = """
    material M {
        param k : float in 1..1
        param low : rgb
        map high : texture2d
        color = mix(low, high(uv).rgb, k)
    }
    """
    (material,) = burnish.compile(source, "glsl")
    (removal,) = material.removals
    assert removal.sentence == (
        "`k` is 1, so `mix(low, high(uv).xyz, k)` is `high(uv).xyz`. "
        "Nothing reads the parameter `low` any more."
    )
