"""Captures: what of a vertex is written where, and in which stage it is computed."""

from __future__ import annotations

import pytest

import burnish
from burnish.compiler.diagnostics.render import render
from burnish.compiler.ir.stages import CAPTURE, CAPTURED, CAPTURED_EXPANDED, EMITTING

from .kit import shader

PASS = """
/// A step.
pass Moved {
    capture position : point<world> = position      /// Where it goes
    capture number   : uint = 7u
    capture uv       : vec2 = uv
}
"""


def test_members_lie_behind_one_another_without_gaps() -> None:
    made = shader(f"material M {{ color = vec3(1) }} {PASS}", pass_="Moved")
    assert made.chain == CAPTURED
    assert made.capture is not None
    assert [
        (m.name, str(m.type), m.declared_type, m.offset, m.doc) for m in made.capture.members
    ] == [
        ("position", "vec3", "point<world>", 0, "Where it goes"),
        ("number", "uint", "uint", 12, ""),
        ("uv", "vec2", "vec2", 16, ""),
    ]
    assert made.capture.stride == 24
    assert [(r.kind, r.stage.name, r.name) for r in made.results] == [
        (CAPTURE, "vertex", name) for name in ("position", "number", "uv")
    ]


def test_of_an_expansion_the_emitted_vertices_are_captured() -> None:
    text = "material M { expand point { points of 2 {} points of 1 {} } color = vec3(1) }"
    made = shader(text + PASS, pass_="Moved")
    assert made.chain == CAPTURED_EXPANDED
    assert {result.stage.name for result in made.results} == {"geometry"}
    assert len(made.results_of(EMITTING)) == 2
    assert made.expansion is not None
    assert (made.expansion.emits, made.expansion.listed, made.expansion.starts) == (
        "point",
        3,
        (0, 2),
    )


def test_a_derived_pass_replaces_a_capture_and_adds_to_them() -> None:
    derived = "pass More : Moved { capture number : float = uv.x  capture heat : float = 1 }"
    made = shader(f"material M {{ color = vec3(1) }} {PASS} {derived}", pass_="More")
    assert made.capture is not None
    members = [(member.name, str(member.type)) for member in made.capture.members]
    assert members == [("position", "vec3"), ("number", "float"), ("uv", "vec2"), ("heat", "float")]


@pytest.mark.parametrize(
    ("value", "what"),
    [("frag_coord.x", "`frag_coord`"), ("ddx(uv.x)", "`ddx`")],
)
def test_what_only_fragments_have_is_not_captured(value: str, what: str) -> None:
    text = f"material M {{ color = vec3(1) }}\npass Moved {{ capture x : float = {value} }}"
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(text, "glsl", pass_="Moved")
    (found,) = caught.value.diagnostics
    assert render(found).startswith(f"error[B0502]: {what} is not available at the vertex")


def test_a_pass_that_captures_inherits_no_targets() -> None:
    text = "material M { color = vec3(1) }\npass Moved : Forward { capture x : float = uv.x }"
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(text, "glsl", pass_="Moved")
    (found,) = caught.value.diagnostics
    assert found.rule.code == "B0560"
    assert found.span is not None and found.span.text == "x"
