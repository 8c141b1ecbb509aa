"""The values that passes write: targets, overridden slots, discarding and blending."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.ir.blending import NAMED, Blend, BlendEquation, Factor, Operation
from burnish.compiler.ir.shader import Shader
from burnish.compiler.ir.stages import DISCARD, TARGET
from burnish.compiler.reference.namespace import Lanes

from .kit import Given, Painted, at, shader

MATERIAL = "material M { sheen = 0.75  color = vec3(0.5, sheen, 0)  alpha = 0.25 }\n"


def drawn(pass_: str, material: str = MATERIAL) -> Shader:
    """A material drawn by the pass ``P``."""
    return shader(material + pass_, pass_="P")


def outputs(pass_: str, given: Given | None = None, material: str = MATERIAL) -> list[Lanes]:
    """The values that a pass writes to its targets."""
    whole = drawn(pass_, material)
    return [at(whole, result.value, given) for result in whole.results_of(TARGET)]


OVERRIDES: dict[str, Lanes] = {
    "": (0.5, 0.75, 0, 0.25),
    "color = 1": (1, 1, 1, 0.25),
    "color = vec3(0, 1, 0)  alpha = 1": (0, 1, 0, 1),
    "color = inherited.color * 2": (1, 1.5, 0, 0.25),
    "color = vec3(material.sheen)": (0.75, 0.75, 0.75, 0.25),
    "color = vec3(material.alpha)  alpha = 1 - inherited.alpha": (0.75, 0.75, 0.75, 0.75),
    "sheen = 3.0  color = vec3(sheen, material.sheen, 0)": (3, 0.75, 0, 0.25),
    "param width : float = 2  alpha = width": (0.5, 0.75, 0, 2),
}


def word_of(blend: Blend) -> str:
    """The word for a state that has one."""
    return next(word for word, state in NAMED.items() if state == blend)


def states(whole: Shader) -> list[tuple[str, str, str]]:
    """Name, format and blending of each render target."""
    results = whole.results_of(TARGET)
    return [(r.name, r.state.format, word_of(r.state.blend)) for r in results if r.state]


def equation(source: Factor, destination: Factor, operation: Operation = "add") -> BlendEquation:
    return BlendEquation(source, destination, operation)


ADDED = equation("one", "one")
BLENDINGS: dict[str, tuple[Blend, str]] = {
    "": (Blend(ADDED, ADDED), "rgba"),
    "blend { source = zero }": (Blend(equation("zero", "one"), equation("zero", "one")), "rgba"),
    "blend none { mask = gb }": (Blend(), "gb"),
    "blend { mask = none }": (Blend(ADDED, ADDED), "none"),
    "blend { alpha_source = dst_alpha, source = src }": (
        Blend(equation("src", "one"), equation("dst_alpha", "one")), "rgba",
    ),
    "blend alpha { alpha_operation = max }": (
        Blend(equation("src_alpha", "one_minus_src_alpha"), equation("one", "one", "max")), "rgba",
    ),
    "blend multiply { operation = reverse_subtract }": (
        Blend(
            equation("dst", "zero", "reverse_subtract"), equation("dst", "zero", "reverse_subtract")
        ),
        "rgba",
    ),
}  # fmt: skip
"""The blend settings of a target in a pass that adds up, with the resulting state and mask."""


@pytest.mark.parametrize("written", BLENDINGS)
def test_settings_change_what_the_mode_or_the_header_says(written: str) -> None:
    text = (
        "pass P blend add { clip_position = vec4(position, 1)\n"
        f"target t : rgba16f = vec4(1) {written} }} material M {{}}"
    )
    whole = shader(text, pass_="P")
    (result,) = whole.results_of(TARGET)
    assert result.state is not None
    assert (result.state.blend, result.state.mask) == BLENDINGS[written]


def test_clear_values_are_inherited_one_by_one() -> None:
    text = """
    pass B : Forward {
        target more : rg16f = uv
        clear { color = #ff0000, more = vec2(2, 3), depth = 0.5 }
    }
    pass P : B { clear { color = vec4(0, 0, 0.5, 0.25) } }
    material M {}
    """
    whole = shader(text, pass_="P")
    cleared = {r.name: r.state.clear for r in whole.results_of(TARGET) if r.state}
    assert cleared == {"color": (0.0, 0.0, 0.5, 0.25), "more": (2.0, 3.0, 0.0, 1.0)}
    assert whole.render_state.depth.clear == 0.5
    (color, _) = shader(text, pass_="B").results_of(TARGET)
    assert color.state is not None
    assert color.state.clear == (1.0, 0.0, 0.0, 1.0)


@pytest.mark.parametrize(("slots", "expected"), OVERRIDES.items(), ids=OVERRIDES)
def test_slots_of_a_pass(slots: str, expected: Lanes) -> None:
    assert outputs(f"pass P : Forward {{ {slots} }}") == [expected]


def test_an_overridden_slot_is_overridden_for_the_material_too() -> None:
    material = "material M { color = vec3(alpha, uv) }"
    pass_ = "pass P : Forward { alpha = 0.5  uv = 2 * inherited.uv }"
    assert outputs(pass_, None, material) == [(0.5, 0.5, 1.5, 0.5)]


def test_a_slot_that_only_the_pass_has_overrides_nothing() -> None:
    assert outputs("pass P : Forward { sheen = 0.0 }") == [(0.5, 0.75, 0, 0.25)]


MANY = """
pass P blend add {
    clip_position = vec4(position, 1)
    target light : rgba16f = vec4(color, alpha)
    target depth : r32f    = position.x blend none
    target coord : rg8     = uv
}
"""


def test_several_targets() -> None:
    assert outputs(MANY) == [(0.5, 0.75, 0, 0.25), (0.5,), (0.25, 0.75)]
    rows = states(drawn(MANY))
    assert rows == [("light", "rgba16f", "add"), ("depth", "r32f", "none"), ("coord", "rg8", "add")]


def test_an_heir_replaces_a_target_and_adds_others() -> None:
    heir = """
        abstract pass B blend add { target one : r8 = 1  target two : r8 = 2 }
        pass P : B { target three : r8 = 3  target one : r16f = 4 blend multiply
                     clip_position = vec4(position, 1) }
    """
    rows = states(drawn(heir))
    assert rows == [("one", "r16f", "multiply"), ("two", "r8", "add"), ("three", "r8", "add")]
    assert outputs(heir) == [(4,), (2,), (3,)]


DISCARDS: dict[tuple[float, float], bool] = {
    (0.0, 0.0): False,
    (1.0, 0.0): True,
    (0.0, 1.0): True,
    (1.0, 1.0): True,
}


@pytest.mark.parametrize(("coordinate", "expected"), DISCARDS.items())
def test_discards_are_joined(coordinate: Lanes, expected: bool) -> None:
    passes = "abstract pass B : Forward { discard when uv.x > 0.5 }\n"
    whole = drawn(passes + "pass P : B { discard when uv.y > 0.5 }")
    (discard,) = whole.results_of(DISCARD)
    assert at(whole, discard.value, {"vertex_uv": coordinate}) == (expected,)


def test_leaves_of_a_pass_are_not_those_of_its_material() -> None:
    material = "material M { param k : float = 2  map t : texture2d  color = k * t(uv).rgb }"
    whole = drawn("pass P : Forward { param k : float = 3  map t : texture2d"
                  "  color = inherited.color * k * t(uv).rgb }", material)  # fmt: skip
    assert {"k", "P.k"} < {info.leaf.name for info in whole.parameters}
    assert {info.leaf.name for info in whole.textures} == {"t", "P.t"}
    given: Given = {
        "t": (Painted(lambda _u, _v: (1, 10, 100, 1)),),
        "P.t": (Painted(lambda _u, _v: (1, 2, 3, 1)),),
    }
    assert at(whole, whole.results_of(TARGET)[0].value, given)[:3] == (6, 120, 1800)


def test_an_attribute_of_both_is_one() -> None:
    material = "material M { attribute tint : vec3  color = tint }"
    whole = drawn("pass P : Forward { attribute tint : vec3 }", material)
    assert [info.leaf.name for info in whole.attributes].count("tint") == 1
    with pytest.raises(CompileError, match="`tint` is vec3 in `M`, and vec2 here"):
        drawn("pass P : Forward { attribute tint : vec2 }", material)


def test_a_pass_reads_terms_and_inputs_of_the_pipeline() -> None:
    pass_ = """
        term half() = alpha / 2
        pass P : Forward { color = vec3(half(), frag_coord.x, 0) }
    """
    assert outputs(pass_, {"frag_coord": (3.5, 0.5, 0.0, 1.0)}) == [(0.125, 3.5, 0, 0.25)]


@pytest.mark.parametrize(("material", "pass_"), [("A", "P"), ("M", "B")])
def test_nothing_abstract_is_drawn(material: str, pass_: str) -> None:
    text = """
        abstract pass B : Forward { uv : vec2  target coord : rg8 = uv }
        pass P : B { uv = vec2(1) }
        abstract material A { color : rgb }
        material M : A { color = vec3(1) }
    """
    with pytest.raises(CompileError) as caught:
        burnish.compile(text, "wgsl", material=material, pass_=pass_)
    assert [found.rule.code for found in caught.value.diagnostics] == ["B0408"]


def test_an_heir_sets_what_an_abstract_pass_takes_from_the_material() -> None:
    heir = """
        abstract pass B : Forward { uv : vec2  target coord : rg8 = 2 * uv }
        pass P : B { uv = inherited.uv + 1 }
    """
    with pytest.raises(CompileError) as caught:
        drawn(heir)
    assert [found.rule.code for found in caught.value.diagnostics] == ["B0407"]
    material = "material M { color = vec3(uv, 0) }"
    assert outputs(heir.replace("inherited.uv", "vec2(2)"), None, material) == [
        (3, 3, 0, 1),
        (6, 6),
    ]
