"""``nonzero``: what a host promises of a vector, and who tells of it."""

from __future__ import annotations

from pathlib import Path

import burnish
from burnish.compiler.documents.values import PromiseRow
from burnish.compiler.documents.writing import to_json
from burnish.stdlib.builtins.geometry import SHORTEST

from ..cli.kit import invoke

LIT = """
import std.lights.{Point, FocusedSpot}
import std.terms.{lambert}
material M { color = lambert(vec3(0.8)) }
"""
AT_VERTICES = LIT.replace("= lambert", "= @vertex lambert")


def promised(source: str) -> tuple[PromiseRow, ...]:
    (material,) = burnish.compile(source, ("wgsl",)).materials
    return material.reflection.promises


def rows(source: str) -> list[tuple[str, list[str]]]:
    """The values that are promised, and the parameters that they depend on."""
    return [(row.value, [*row.parameters]) for row in promised(source)]


def test_the_reflection_tells_what_is_promised_of_which_parameters() -> None:
    assert to_json(promised(LIT + "rig R { lamp : Point }")) == [
        {
            "value": "lamp.place - position",
            "least_length": SHORTEST,
            "parameters": ["object_to_world", "lamp.place"],
        }
    ]


def test_a_promise_about_what_is_declared_has_its_name() -> None:
    source = "material M { param v : vec3  map m : texture2d = white  color = nonzero(v) }"
    assert rows(source) == [("v", ["v"])]
    assert rows(source.replace("nonzero(v)", "nonzero(m(uv).rgb)")) == [("m(uv).xyz", [])]


def test_a_promise_in_a_function_that_is_called_repeatedly_is_about_its_arguments() -> None:
    functions = """
        fn unit(v: vec3, by: float) -> vec3 = sin(normalize(nonzero(by * v)) * v.x) + cos(v)
        fn twice(w: vec3) -> vec3 = exp(unit(w, 2) + unit(w.zxy, 3)) + sin(w)
    """
    source = (
        functions
        + """
        material M {
            param a : vec3
            param b : vec3
            param n : vec3
            far = sum i in 0..9 : nonzero(float(i) * n + vec3(uv, 1)).x * b.x
            color = twice(a) + twice(b) + vec3(far)
        }
    """
    )
    assert sorted(rows(source)) == [
        ("by * v", ["a", "b"]), ("float(i) * n + vec3(uv, 1)", ["n"]),
    ]  # fmt: skip


def test_what_no_result_needs_is_not_promised() -> None:
    assert promised("material M { unread = nonzero(uv)  color = vec3(1) }") == ()


def test_a_promise_computes_nothing() -> None:
    with_, without = (
        burnish.compile(f"material M {{ color = vec3({value}, 0) }}", ("glsl",))["M"]
        for value in ("nonzero(uv)", "uv")
    )
    assert with_.text("glsl", "fragment") == without.text("glsl", "fragment")


def test_lamps_are_off_the_surface_so_nothing_is_guarded_for_them() -> None:
    for light in ("Point", "FocusedSpot"):
        (material,) = burnish.compile(LIT + f"rig R {{ lamp : {light} }}", ("wgsl",)).materials
        assert [g.builtin for g in material.guards if "light" in str(g.span)] == []
        text = material.text("wgsl", "fragment")
        assert "normalize(" in text and "inverseSqrt(max(dot(input.normal" in text


def test_a_vector_keeps_its_meaning() -> None:
    source = "material M { color = vec3(dot(nonzero(eye - position), normal)) }"
    assert burnish.check(source) == ()
    (found,) = burnish.check("material M { color = vec3(dot(nonzero(eye - position), #fff)) }")
    assert "vector<world>" in found.message


def test_a_number_declares_a_range_instead() -> None:
    (found,) = burnish.check("material M { param x : float  color = vec3(nonzero(x)) }")
    assert "nonzero" in found.message


def test_a_constant_is_not_called_as_another_that_is_equal(tmp_path: Path) -> None:
    source = tmp_path / "m.burnish"
    equations = "none = uv.x * 0  color = normalize(nonzero(vec3(0) * uv.x)) + none"
    source.write_text(f"material M {{ {equations} }}")
    drawn = invoke("render", source, "-o", tmp_path / "m.png", "--size", "16")
    assert "`vec3(0) * uv.x` is promised not to be zero" in drawn.stderr


def test_a_broken_promise_is_told_by_render(tmp_path: Path) -> None:
    source = tmp_path / "m.burnish"
    source.write_text(AT_VERTICES + "rig R { lamp : Point }")
    arguments = ("render", source, "-o", tmp_path / "m.png", "--mesh", "plane", "--size", "16")
    kept = invoke(*arguments, "--set", "lamp.place=0,0,1")
    assert "warning" not in kept.stderr
    broken = invoke(*arguments, "--set", "lamp.place=0,0,0")
    assert (
        "warning: M: `lamp.place - position` is promised not to be zero, and is: "
        "the pixels that use it are not defined" in broken.stderr
    )
    assert broken.exit_code == 0
