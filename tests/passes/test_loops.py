"""Loops, structures and arrays on the way through the passes, and as text."""

from __future__ import annotations

import re

import pytest

import burnish
from burnish.compiler.ir.node import formals_of

from .kit import History, calls, history, ops, shader


def compiled(text: str) -> History:
    return history(shader(text))


def written(text: str, target: str = "glsl:vulkan") -> str:
    """The fragment stage's entry point."""
    whole = burnish.compile(text, (target,)).materials[0].text(target, "fragment")
    return whole[whole.index("void main") :]


STRUCTURES = """
struct Layer { tint : rgb, width : float }
material M {
    param held : Layer
    param pick : int in 0..1
    own   = Layer(vec3(uv, 1), uv.x)
    some  = if uv.x < 0.5 then held else own
    color = [own, some][pick].tint * some.width
}
"""


def test_structures_are_taken_apart() -> None:
    past = compiled(STRUCTURES)
    assert ops(past.roots["semantics"], "struct")
    assert not ops(past.roots["replace_aggregates"], "struct")
    (array,) = ops(past.roots["replace_aggregates"], "array")
    assert str(array.type) == "vec3[2]"


def test_arrays_have_the_users_names_and_are_constants_where_they_can() -> None:
    text = "material M { param n : int in 0..2; w : float[3] = [1, 2, 1]; color = vec3(w[n]) }"
    assert "const float w[3] = float[3](1.0, 2.0, 1.0);" in written(text)
    assert "static const float w[3] = {1.0, 2.0, 1.0};" in (
        burnish.compile(text, ("hlsl",)).materials[0].text("hlsl", "fragment")
    )


INDICES = {
    "sum i in 0..3 : w[i] * uv.x": 0,
    "sum i in 1..n : w[i] * uv.x": 0,
    "w[n - 1]": 0,
    "w[n mod 3]": 0,
    "w[clamp(int(uv.x), 0, 2)]": 0,
    "w[int(uv.x)]": 1,
    "w[n]": 1,
    "sum i in 0..9 : w[i] * uv.x": 1,
}


@pytest.mark.parametrize(("text", "clamps"), INDICES.items(), ids=INDICES)
def test_indices_within_bounds_are_not_clamped(text: str, clamps: int) -> None:
    given = f"material M {{ param w : float[3]; param n : int in 1..3; color = vec3({text}) }}"
    past = compiled(given)
    asked = 1 if "clamp" in text else 0
    assert len(calls(past.roots["simplify"], "clamp")) == clamps + asked


def test_every_loop_has_variables_of_its_own() -> None:
    text = """
    fn wave(i: int, x: float) -> float = sum j in 0..7 : sin(x * float(i * j))
    fn same(i: int, x: float) -> float = sum j in 0..7 : sin(x * float(i * j))
    material M {
        a = sum i in 0..5 : wave(i, uv.x)
        b = max i in 0..5 : same(i, uv.x)
        color = vec3(a, b, 0)
    }
    """
    loops = ops(compiled(text).roots["rename_variables"], "fold")
    assert len(loops) == 4
    assert len({formals_of(loop) for loop in loops}) == 4


def test_what_no_turn_changes_is_no_state() -> None:
    text = """
    struct Ray { from_ : vec3, along : vec3, far : float }
    material M {
        ray   = iterate r from Ray(position, to_eye, 0) up to 8 while r.far < 3 :
            Ray(r.from_, r.along, r.far + length(r.from_ + r.far * r.along))
        color = ray.from_ + ray.far * ray.along
    }
    """
    (loop,) = ops(compiled(text).roots["semantics"], "iterate")
    assert str(loop.type) == "float"


def test_states_that_need_each_other_are_set_together() -> None:
    text = """
    material M {
        pair  = iterate p from [uv.x, uv.y] up to 9 : [p[1] * 0.5, p[0] + 1]
        color = vec3(pair[0], pair[1], 0)
    }
    """
    found = re.findall(r"p_\d(?:_next)? = .*;", written(text))
    assert found[-3:] == ["p_0_next = p_1 * 0.5;", "p_1 = p_0 + 1.0;", "p_0 = p_0_next;"]


def test_a_condition_stands_in_the_loops_first_line_if_it_can() -> None:
    text = "material M { color = vec3(iterate t from uv.x up to 9 while t < uv.y : t + 0.1) }"
    assert re.search(r"for \(int turn = 0; turn < 9 && \w+ < v_uv.y; turn\+\+\) {", written(text))


def test_fixed_parts_of_a_loop_are_computed_before_it() -> None:
    text = "material M { color = vec3(iterate t from uv.x up to 9 : t + sin(uv.y)) }"
    lines = written(text).split("\n")
    assert next(i for i, line in enumerate(lines) if "sin(" in line) < next(
        i for i, line in enumerate(lines) if "for (" in line
    )


def test_a_function_takes_along_what_a_loop_around_its_call_computes() -> None:
    text = """
    import std.lights
    term beams(k: rgb) per light =
        k * light.diffuse * sin(light.to_light) * cos(light.to_light.zxy) * exp(light.to_light)
    material M { color = iterate c from vec3(1) up to 3 while c.x < 4 : 0.1 * beams(vec3(c.y)) }
    rig R { a : Point, b : Directional, c : Spot }
    """
    past = compiled(text)
    assert ops(past.roots["lift_lambdas"], "apply")
    assert burnish.compile(text, ("wgsl",)).materials


def test_matrices_are_chosen_by_branches_however_cheap_they_are() -> None:
    text = "material M { m = if uv.x < 0.5 then mat3(1) else mat3(2); color = m * normal }"
    for target in ("glsl:es300", "hlsl", "wgsl"):
        assert burnish.compile(text, (target,)).materials


def test_a_long_choice_of_matrices_nests_no_deeper_than_front_ends_take() -> None:
    links = "".join(f"if uv.x < {i}.5 then mat2({i}.0) else " for i in range(300))
    text = f"material M {{ m = {links} mat2(uv, uv); color = vec3(m * uv, 0) }}"
    deepest = max(len(line) - len(line.lstrip()) for line in written(text).split("\n")) // 4
    assert deepest < 64
