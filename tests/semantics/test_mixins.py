"""Mixins: where they stand in a chain, what they may ask for, and that they are looked at alone."""

from __future__ import annotations

from pathlib import Path

import pytest

import burnish
from burnish.compiler.ir.node import reachable
from burnish.compiler.ir.operations import CROSS
from burnish.compiler.ir.stages import DISCARD, TARGET

from .kit import Given, amid, color, shader

STEPS = """
mixin Doubled { color = 2 * inherited.color }
mixin Raised { color = inherited.color + 3 }
material Plain { color = vec3(1) }
"""


@pytest.mark.parametrize(
    ("header", "value"),
    [
        ("Surface + Doubled + Raised { color = inherited.color }", 0.8 * 2 + 3),
        ("Plain + Doubled + Raised {}", 1 * 2 + 3),
        ("Plain + Raised + Doubled {}", (1 + 3) * 2),
        ("Plain + Raised { color = 10 * inherited.color }", 10 * (1 + 3)),
    ],
)
def test_the_last_mixin_is_the_nearest_to_the_heir(header: str, value: float) -> None:
    text = STEPS.replace("material Plain", "abstract material Plain")
    assert color(f"{text}\nmaterial Made : {header}") == pytest.approx((value,) * 3)


def test_mixins_of_a_base_stand_behind_those_of_its_heir() -> None:
    text = STEPS.replace("material Plain", "abstract material Plain")
    text += "abstract material Middle : Plain + Doubled {}\nmaterial Heir : Middle + Raised {}"
    assert color(text) == pytest.approx((5, 5, 5))


def test_a_mixin_reads_what_it_needs_of_the_base() -> None:
    text = """
    abstract material Painted { tint : rgb = vec3(0.25)  color = vec3(0) }
    mixin Shown { tint : rgb  color = inherited.color + tint }
    material Made : Painted + Shown {}
    """
    assert color(text) == pytest.approx((0.25,) * 3)


def test_what_a_mixin_needs_types_a_slot_that_says_none() -> None:
    text = """
    abstract material Painted { tint = 1  color = vec3(0) }
    mixin Shown { tint : float  color = vec3(tint / 2) }
    material Made : Painted + Shown {}
    """
    assert color(text) == pytest.approx((0.5,) * 3)


def test_what_a_mixin_needs_can_be_set_by_the_heir_or_by_another_mixin() -> None:
    text = """
    mixin Shown { tint : rgb  color = tint }
    mixin Green { tint = vec3(0, 1, 0) }
    """
    assert color(f"{text} material Made : Surface + Shown {{ tint = vec3(1, 0, 0) }}") == (1, 0, 0)
    assert color(f"{text} material Made : Surface + Green + Shown {{}}") == (0, 1, 0)
    assert color(f"{text} material Made : Surface + Shown + Green {{}}") == (0, 1, 0)


def test_mixins_for_lights() -> None:
    text = """
    mixin Dimmed for light { param share : float = 0.5  falloff = inherited.falloff * share }
    light Near : Light { to_light = normal }
    light Lamp : Near + Dimmed + Halved { falloff = 8 * inherited.falloff }
    mixin Halved for light { falloff = inherited.falloff / 2 }
    term seen() per light = light.diffuse
    material Made { color = seen() }
    rig Room { lamp : Lamp }
    """
    assert color(text) == pytest.approx((8 * 0.5 / 2,) * 3)


def test_mixins_for_passes() -> None:
    text = """
    mixin Doubled for pass { color = 2 * inherited.color  discard when alpha < 0.5 }
    pass Twice : Forward + Doubled {}
    material Made { color = vec3(0.25) }
    """
    whole = shader(text, pass_="Twice")
    assert whole.results_of(DISCARD)
    assert [result.name for result in whole.results_of(TARGET)] == ["color"]


def test_attributes_that_two_mixins_bring_along_are_one() -> None:
    text = """
    mixin A { attribute paint : vec4  color = inherited.color * paint.rgb }
    mixin B { attribute paint : vec4  alpha = paint.a }
    material Made : Surface + A + B {}
    """
    whole = shader(text)
    assert [info.leaf.name for info in whole.attributes].count("paint") == 1


@pytest.mark.parametrize(
    ("mixin", "codes"),
    [
        ("mixin A { color = inherited.colour }", ["B0201"]),
        ("mixin A { kd : rgb  color = kd + inherited.color }", []),
        ("mixin A { kd : rgb = 2 * inherited.kd  color = kd }", []),
        ("mixin A { kd : rgb  color = kd.q }", ["B0304"]),
        ("mixin A for light { falloff = dot(to_light, missing) }", ["B0201"]),
        ("mixin A for light { falloff = saturate(to_light.y) }", []),
        ("mixin A for pass { color = 2 * material.color  discard when missing }", ["B0201"]),
        ("mixin A for pass { target more : rgba8 = vec4(color, alpha) }", []),
        ("mixin A { discard when alpha < 1 }", ["B0213"]),
    ],
)
def test_a_mixin_that_nothing_has_is_checked_too(mixin: str, codes: list[str]) -> None:
    assert [found.rule.code for found in burnish.check(mixin)] == codes


CORNERS: list[Given] = [
    {"vertex_position": (1.0, 2.0, 3.0), "place": (4.0, 5.0, 6.0), "turn.0": (1.0, 2.0),
     "turn.1": (3.0, 4.0)},
    {"vertex_position": (3.0, 2.0, 1.0), "place": (4.0, 5.0, 6.0), "turn.0": (3.0, 6.0),
     "turn.1": (5.0, 8.0)},
]  # fmt: skip


def test_a_matrix_of_the_vertices_crosses_column_by_column() -> None:
    whole = shader("material M { attribute turn : mat2  color = vec3(turn * vec2(1, 10), 0) }")
    value = amid(whole, whole.results_of(TARGET)[0].value, CORNERS)
    assert value[:2] == pytest.approx((2 + 10 * 4, 4 + 10 * 6))


def test_what_each_instance_has_is_not_interpolated() -> None:
    text = """
    material M {
        attribute place : vec3 per instance
        moved = place + vec3(float(instance_index), 0, 0) + @vertex (2 * place)
        color = moved + vec3(vertex_position)
    }
    """
    whole = shader(text)
    modes = {
        getattr(node.operands[0].data, "name", node.operands[0].data): CROSS.data(node).mode
        for node in reachable([whole.results_of(TARGET)[0].value])
        if node.op == "cross"
    }
    assert modes == {
        "place": "flat",
        "vertex_position": "perspective",
        "instance_index": "flat",
        "mul": "flat",
    }


OFFERED = """
burnish 1
mixin Framed { object_to_wall : float = 1 }
"""


def test_only_the_file_that_declares_a_slot_is_told_that_nothing_reads_it(tmp_path: Path) -> None:
    (tmp_path / "framed.burnish").write_text(OFFERED)
    user = tmp_path / "user.burnish"
    user.write_text('import "framed.burnish"\nmaterial Made : Surface + Framed {}')
    assert not burnish.check(user)
    user.write_text(f"{OFFERED}\nmaterial Made : Surface + Framed {{}}")
    assert [d.rule.code for d in burnish.check(user)] == ["B0210"]


def test_a_slot_with_a_type_is_an_offer_of_an_abstract_material() -> None:
    """It is new on purpose, though its name is like that of a base, or an order of its words."""
    offer = "abstract material Offer : Surface {{ normal_object{} = vec3(object_normal) }}"
    assert not burnish.check(offer.format(" : vec3"))
    assert [found.rule.code for found in burnish.check(offer.format(""))] == ["B0210"]
