"""Moving affine work to the vertices adds no varying; what crosses is packed."""

from __future__ import annotations

from burnish.compiler.ir.operations import CROSS
from burnish.compiler.ir.program import Varying

from .kit import calls, history, ops, shader


def varyings(text: str) -> tuple[Varying, ...]:
    return history(shader(f"material M {{ {text} }}")).staged.program.varyings


def test_an_affine_value_of_one_crossing_is_computed_at_the_vertices() -> None:
    past = history(shader("material M { param s : vec2  color = (uv * s + vec2(1, 2)).xyx }"))
    assert calls(past.roots["guard"], "add")
    for crossing in ops(past.roots["move_to_vertices"], "cross"):
        assert calls([crossing.operands[0]], "add")
    assert len(ops(past.roots["move_to_vertices"], "cross")) == 1


def test_a_crossing_with_other_uses_stays() -> None:
    past = history(shader("material M { param s : vec2  color = (uv * s).xyx + sin(uv.xyx) }"))
    (crossing,) = ops(past.roots["move_to_vertices"], "cross")
    assert crossing.operands[0].op == "attribute"


def test_what_would_widen_a_varying_stays() -> None:
    past = history(shader("material M { param s : vec3  color = s * uv.x + sin(s * uv.x) }"))
    for crossing in ops(past.roots["move_to_vertices"], "cross"):
        assert str(crossing.type) in ("float", "vec2")


def test_what_is_not_affine_stays() -> None:
    past = history(shader("material M { color = sin(uv.xyx) }"))
    (crossing,) = ops(past.roots["move_to_vertices"], "cross")
    assert crossing.operands[0].op == "attribute"


def test_flat_values_never_move() -> None:
    past = history(
        shader("material M { color = vec3(float(@vertex int(vertex_uv.x)) * 2.0 + 1.0) }")
    )
    (crossing,) = ops(past.roots["move_to_vertices"], "cross")
    assert CROSS.data(crossing).mode == "flat" and str(crossing.type) == "int"


def test_moving_never_adds_a_varying() -> None:
    text = "param s : vec2  a = uv * s  color = vec3(a.x + sin(uv.y), a.y * a.y, 1)"
    past = history(shader(f"material M {{ {text} }}"))
    before = len(ops(past.roots["guard"], "cross"))
    assert len(ops(past.roots["move_to_vertices"], "cross")) <= before


def test_two_pairs_share_a_slot() -> None:
    (slot,) = varyings("color = sin((@vertex cos(vertex_uv)).xyx) + sin(uv.xyx)")
    assert str(slot.field.type) == "vec4"
    assert len(slot.values) == 2


def test_wide_values_come_first_and_each_stays_whole() -> None:
    slots = varyings("color = sin(position) * sin(uv.x) * sin(uv.y)")
    assert [str(slot.field.type) for slot in slots] == ["vec3", "vec2"]


def test_flat_and_smooth_values_do_not_share() -> None:
    text = "color = sin(uv.xyx) * float(@vertex int(vertex_uv.x))"
    modes = [slot.field.mode for slot in varyings(text)]
    assert sorted(modes) == ["flat", "perspective"]


def test_what_nothing_reads_does_not_cross() -> None:
    assert not varyings("color = vec3(1)")
