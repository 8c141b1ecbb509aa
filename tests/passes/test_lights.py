"""Sums over lights: one pass over the rig for all terms, one function for what lights share."""

from __future__ import annotations

from burnish.compiler.ir.node import formals_of
from burnish.compiler.ir.operations import FOLD
from burnish.compiler.ir.statements import Loop

from .kit import History, history, ops, shader

HEADER = "import std.lights\nimport std.terms\n"
TWO_TERMS = "material M { color = lambert(vec3(0.5)) + phong(vec3(1), 8.0) }\n"
THREE_TERMS = "material M { color = lambert(vec3(0.5)) + phong(vec3(1), 8.0) + lambert(uv.xyx) }\n"


def compiled(text: str) -> History:
    return history(shader(HEADER + text))


def test_two_terms_go_over_the_rig_once() -> None:
    past = compiled(TWO_TERMS + "rig R { lamps : Point[<= 8] }")
    assert len(ops(past.roots["simplify"], "fold")) == 2
    (loop,) = ops(past.roots["fuse"], "fold")
    assert FOLD.data(loop).bound == 8


def test_the_terms_of_one_light_are_one_function() -> None:
    past = compiled(TWO_TERMS + "rig R { one : Point; two : Point; three : Spot }")
    calls = ops(past.roots["fuse"], "apply")
    assert len(calls) == 3
    assert len({call.operands[0] for call in calls}) == 1
    names = [function.name for function in past.staged.program.stage("fragment").functions]
    assert names == ["lambert_phong"]


def test_a_term_that_ends_in_a_guard_keeps_its_name() -> None:
    past = compiled(
        "term ours(k: rgb) per light = k * light.diffuse / dot(to_eye, light.to_light)\n"
        "material M { color = ours(vec3(0.5)) }\n"
        "rig R { one : Point; two : Point }"
    )
    names = [function.name for function in past.staged.program.stage("fragment").functions]
    assert names == ["ours"]


def test_a_third_term_joins_the_other_two() -> None:
    past = compiled(THREE_TERMS + "rig R { one : Point; lamps : Point[<= 3] }")
    assert len(ops(past.roots["fuse"], "fold")) == 1
    assert len({call.operands[0] for call in ops(past.roots["fuse"], "apply")}) == 1


def test_lights_that_share_an_argument_keep_their_own() -> None:
    past = compiled(
        "light Up : Light { param q : float = 1.0; to_light = normal; falloff = q }\n"
        "material M { color = lambert(vec3(0.5)) }\n"
        "rig R { one : Up; two : Up }"
    )
    for call in ops(past.roots["fuse"], "apply"):
        formals = formals_of(call)
        assert len(set(formals)) == len(formals), "one variable for two arguments"


def test_a_body_that_is_used_once_is_written_out() -> None:
    past = compiled(TWO_TERMS + "rig R { sun : Directional }")
    names = [function.name for function in past.staged.program.stage("fragment").functions]
    assert names == []


def test_functions_are_closed_but_for_uniforms() -> None:
    past = compiled(TWO_TERMS + "rig R { one : Point; two : Point }")
    function = past.staged.program.stage("fragment").functions[-1]
    formals = {formal for formal, _ in function.parameters}
    assert {node.data for node in ops([function.value], "formal")} <= formals
    assert not ops([function.value], "cross")


def test_a_counted_rig_is_one_loop_with_its_bound() -> None:
    past = compiled(TWO_TERMS + "rig R { lamps : Point[<= 8] }")
    statements = past.staged.program.stage("fragment").region.statements
    (loop,) = [statement for statement in statements if isinstance(statement, Loop)]
    assert loop.bound == 8
    assert "lamps.count" in repr(loop.count)
