"""What functions cannot have is told in a sentence with the slot's name."""

from __future__ import annotations

import json
from pathlib import Path
from textwrap import dedent

import pytest

import burnish
from burnish.compiler.diagnostics.diagnostic import CompileError
from burnish.compiler.diagnostics.render import render_all
from burnish.engines import known

from ..cli.kit import invoke

PLASTIC = """\
import std.lights.{Directional}
import std.terms.{lambert}
material M {
    tint = rgb(uv, 0)
    rough = ddx(uv.x)
    color = lambert(tint)
}
rig R { sun : Directional }
"""
CASES = {
    "unknown slot": (
        PLASTIC, ["tnt"],
        """\
        error[B0901]: `M` has no slot `tnt`
         --> <text>:3:10
          |
        3 | material M {
          |          ^
          = help: did you mean `tint`?
        """,
    ),
    "lights": (
        PLASTIC, ["color"],
        """\
        error[B0902]: `color` needs lights, and a function has none
          --> <text>:6:5
           |
         6 |     color = lambert(tint)
           |     ^^^^^
        """,
    ),
    "a structure": (
        PLASTIC, ["object_shape"],
        "error[B0903]: `object_shape` is a struct, which no function returns",
    ),
    "derivatives for vertices": (
        PLASTIC, ["rough@vertex"],
        """\
        error[B0502]: `ddx` is not available at the vertex
         --> <text>:5:5
        """,
    ),
    "unknown stage": (
        PLASTIC, ["tint@pixel"],
        "error[B0907]: `tint@pixel` names no stage for a slot",
    ),
    "a storage buffer": (
        "material M {\n    buffer heights : float[]\n    tall = heights[0]\n}\n", ["tall"],
        "error[B0904]: `tall` reads the storage buffer `heights`, which is no argument of a",
    ),
    "a place in a storage buffer, though nobody asks for it": (
        "material M {\n    buffer places : vec3[]\n    position = places[0]\n    t = uv.x\n}\n", [],
        "error[B0904]: `position` reads the storage buffer `places`, which is no argument of a",
    ),
    "nothing without lights": (
        "import std.terms.{lambert}\nmaterial M {\n    color = lambert(rgb(1, 1, 1))\n}\n", [],
        "error[B0906]: `M` gives no value to a slot that a function returns without lights",
    ),
    "vertices of its own": (
        """\
        import std.tessellation.{PhongTessellation}
        material M : Surface + PhongTessellation { tint = rgb(uv, 0) }
        """, [],
        "error[B0905]: `M` makes vertices of its own, and a function makes none",
    ),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_what_is_wrong_is_told(name: str) -> None:
    text, slots, expected = CASES[name]
    with pytest.raises(CompileError) as caught:
        burnish.functions(dedent(text), "wgsl", slots=slots)
    assert dedent(expected).strip() in render_all(caught.value.diagnostics)


def test_a_material_without_functions_is_left_out_beside_others() -> None:
    text = PLASTIC + "material N { color = lambert(rgb(1, 1, 1)) }\n"
    found = burnish.functions(text, "wgsl")
    assert [material.name for material in found] == ["M"]
    (told,) = found.diagnostics
    assert told.message == (
        "`N` is left out: it gives no value to a slot that a function returns without lights"
    )


def test_what_a_profile_lacks_is_told_of_functions() -> None:
    text = "material M {\n    map m : texture2d\n    t = m.gather(uv, 0)\n}\n"
    with pytest.raises(CompileError) as caught:
        burnish.functions(text, "glsl:es300")
    (found,) = caught.value.diagnostics
    assert (
        found.rule.code == "B0701" and found.span is not None and found.span.text.startswith("m.")
    )


OPTIONS: dict[tuple[str, ...], str] = {
    ("--single-file",): "--single-file is about whole shaders: leave it out, or `--emit functions`",
    ("--no-hoist",): "--no-hoist is about whole shaders: leave it out, or `--emit functions`",
    ("--validate",): "--validate is about whole shaders: leave it out, or `--emit functions`",
}


@pytest.mark.parametrize("given", OPTIONS)
def test_options_that_do_not_go_together(tmp_path: Path, given: tuple[str, ...]) -> None:
    source = tmp_path / "m.burnish"
    source.write_text(PLASTIC, encoding="utf-8")
    out = tmp_path / "out"
    result = invoke("compile", str(source), "--emit", "functions", *given, "-o", str(out))
    assert OPTIONS[given] in result.stderr and result.exit_code == 2
    assert not out.exists()


def test_the_command_writes_texts_and_a_document(tmp_path: Path) -> None:
    source = tmp_path / "m.burnish"
    source.write_text(PLASTIC, encoding="utf-8")
    out = tmp_path / "out"
    command = ["compile", str(source), "--emit", "functions", "--target", "wgsl"]
    result = invoke(*command, "-o", str(out))
    assert result.exit_code == 0, result.stderr
    assert result.stdout == (
        f"M: 2 functions (tint, rough) in 1 text and M.functions.json in {out}\n"
    )
    assert sorted(path.name for path in out.iterdir()) == ["M.functions.json", "M.functions.wgsl"]
    printed = invoke(*command, "--slots", "tint", "-o", "-")
    assert printed.stdout.startswith("// M: functions, by Burnish.\n")
    assert "m_rough" not in printed.stdout
    assert invoke(*command, "--slots", "color", "-o", str(out / "other")).exit_code == 1
    assert not (out / "other").exists()


def test_a_pass_that_a_material_is_tied_to_is_no_mistake() -> None:
    text = "pass Cut : Forward { discard when alpha < 0.5 }\n"
    text += "material Leaf by Cut { tint = vec3(uv, 0) }\n"
    assert burnish.functions(text, "wgsl").diagnostics == ()


ENGINES: dict[tuple[str, ...], str] = {
    ("--engine", "godot", "--material", "N"): """\
        error[B0906]: `N` gives no value to a slot that a function returns without lights
         --> m.burnish:9:10
          |
        9 | material N { color = lambert(rgb(1, 1, 1)) }
          |          ^
          = help: an engine lights a surface by slots such as `base_color` and `roughness`;""",
    ("--engine", "godot", "--slots", "tint@vertex"): (
        "error[B0909]: Godot 4 cannot draw `tint@vertex`: it has a place of its own for each slot: "
        "leave out what follows `@`"
    ),
    ("--engine", "godot", "--engine", "three"): "--engine names one engine: run the command once",
    ("--engine", "godot", "--rig", "Q"): "error[B0201]: unknown rig `Q`",
    ("--engine", "unity", "--slots", "base=tint"): "error[B0911]: engines take no value called",
    ("--engine", "godot", "--validate"): "--validate is about whole shaders: leave it out",
    ("--engine", "unity", "--pass", "P"): "--pass is about whole shaders: leave it out",
    ("--emit", "functions", "--prefix", "my-shop"): "--prefix is a name of letters, digits and",
    ("--emit", "functions", "--prefix", "a__b"): "--prefix is a name of letters, digits and single",
    ("--emit", "functions", "--prefix", ""): "--prefix is a name of letters, digits and single `_`",
}


@pytest.mark.parametrize("given", ENGINES)
def test_what_is_asked_of_engines(
    given: tuple[str, ...], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    text = PLASTIC + "material N { color = lambert(rgb(1, 1, 1)) }\n"
    (tmp_path / "m.burnish").write_text(text, encoding="utf-8")
    result = invoke("compile", "m.burnish", *given, "-o", "out")
    assert result.exit_code and dedent(ENGINES[given]).strip() in result.stderr
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    "engine", [name for name in known.names() if known.load(name).write_shaders is None]
)
def test_every_engine_is_told_what_a_slot_is(engine: str, tmp_path: Path) -> None:
    file = tmp_path / "m.burnish"
    file.write_text("material M { stain = rgb(uv, 0)   wear = uv.x }\n", encoding="utf-8")
    slots = "base_color=stain,roughness=wear"
    result = invoke("compile", str(file), "--engine", engine, "--slots", slots, "-o", str(tmp_path))
    assert result.exit_code == 0, result.stderr
    assert "2 functions (stain, wear) in files for" in result.stdout
    document = json.loads((tmp_path / f"M.{engine}.functions.json").read_text("utf-8"))
    roles = [slot["role"] for row in document["functions"] for slot in row["slots"]]
    assert roles == ["base_color", "roughness"]
