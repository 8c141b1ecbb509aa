"""The library as its users see it."""

from __future__ import annotations

import json
import sys
from pathlib import Path

import pytest

import burnish
from burnish.compiler.documents.writing import to_json
from burnish.compiler.ir.node import reachable
from burnish.targets import registry

from ..suite.processes import run

EXAMPLES = Path(__file__).parents[2] / "examples"
PLASTIC = EXAMPLES / "plastic.burnish"
TWO = "material A { color = vec3(1) }\nmaterial B { color = vec3(0) }\n"
LIGHTS = "import std.lights.{Point}\nimport std.terms.{lambert, phong}\n"


def test_a_result_holds_materials_by_name_and_in_order() -> None:
    result = burnish.compile(TWO, ("wgsl",))
    assert [material.name for material in result] == ["A", "B"]
    assert len(result) == 2
    assert result["B"] is result.materials[1]
    with pytest.raises(KeyError):
        result["C"]


def test_all_targets_are_all_profiles_that_need_not_be_named() -> None:
    everything = [
        f"{name}:{profile.name}" for name in registry.names()
        for profile in registry.load(name).profiles if not profile.on_request
    ]  # fmt: skip
    assert "glsl:es100" not in everything
    (plain,) = burnish.compile("material M { color = #808080 }", "all")
    assert (
        list(dict.fromkeys(f"{file.target}:{file.profile}" for file in plain.files)) == everything
    )


def test_targets_may_be_one_text() -> None:
    (material,) = burnish.compile("material A { color = vec3(1) }", "wgsl,glsl:es300")
    assert {(file.target, file.profile) for file in material.files} == {
        ("wgsl", "webgpu"),
        ("glsl", "es300"),
    }
    assert "#version 300 es" in material.text("glsl:es300", "vertex")
    with pytest.raises(KeyError, match="no fragment text for hlsl"):
        material.text("hlsl", "fragment")


def test_errors_carry_all_diagnostics(tmp_path: Path) -> None:
    path = tmp_path / "wrong.burnish"
    path.write_text("material A { color = one alpha = two }")
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(path)
    for diagnostics in (caught.value.diagnostics, burnish.check(path)):
        messages = [found.message for found in diagnostics]
        assert messages == ["unknown name `one`", "unknown name `two`"]


def test_what_does_not_vary_with_the_light_is_computed_before_the_loop() -> None:
    source = LIGHTS + (
        "material A { map gloss : texture2d  color = phong(gloss(uv).rgb, 20) }\n"
        "rig R { lamps : Point[<= 16] }\n"
    )
    text = burnish.compile(source, ("wgsl",))["A"].text("wgsl", "fragment")
    loop = text.index("for (")
    assert text.index("textureSample(") < loop
    assert text.index("normalize(view.eye - input.position)") < loop


def test_a_light_with_the_name_of_a_parameter_is_called_after_its_rig_too() -> None:
    source = LIGHTS + (
        "material A { param lamps : float = 1  color = lambert(vec3(lamps)) }\n"
        "rig R { lamps : Point[2] }\n"
    )
    (material,) = burnish.compile(source, ("wgsl",))
    assert [light.name for light in material.reflection.lights] == ["R.lamps"]
    names = {parameter.name for parameter in material.reflection.parameters}
    assert {"lamps", "R.lamps"} <= names


def test_a_block_too_large_for_a_profile_is_told() -> None:
    source = "material A { param m : mat4[1025]  color = m[int(uv.x)][0].xyz }"
    with pytest.raises(burnish.CompileError, match="65600 bytes in a uniform block"):
        burnish.compile(source, ("hlsl",))


FOUR = "material Four { map t : texture2d  color = t.gather(uv, 0).rgb }"


def test_a_profile_that_lacks_something_is_an_error_or_goes_without() -> None:
    with pytest.raises(burnish.CompileError, match="glsl:es300 has no gathering"):
        burnish.compile(FOUR, ("wgsl", "glsl:es300"))
    (material,) = burnish.compile(FOUR, ("wgsl", "glsl:es300"), partial=True)
    assert material.lacking == {"glsl:es300": "glsl:es300 has no gathering of texels"}
    assert {file.target for file in material.files} == {"wgsl"}
    assert list(material.reflection.backends) == ["wgsl:webgpu"]


MASKED = """material Clay { color = #b5651d }
pass Early : Forward {
    target nothing : r8 = 0 blend { mask = none }
}
"""


def test_a_blending_that_a_profile_lacks_is_told_where_the_target_is_declared() -> None:
    """This holds also for a target whose value is a constant, which has no place in the text."""
    with pytest.raises(burnish.CompileError) as caught:
        burnish.compile(MASKED, ("glsl:es310",), pass_="Early")
    (told,) = caught.value.diagnostics
    assert told.message == "glsl:es310 has no blending of its own for each target"
    assert told.span is not None and told.span.text == "nothing"


@pytest.mark.parametrize(
    ("argument", "value"),
    [
        ("source", None), ("source", [PLASTIC]), ("source", b"plastic.burnish"),
        ("targets", None), ("targets", 3), ("targets", (3,)), ("targets", b"wgsl"),
        ("material", 3), ("rig", ["R"]), ("pass_", b"P"),
        ("search_path", "folder"), ("search_path", [3]), ("search_path", None),
        ("hoist", "no"), ("flip_y", 1), ("single_file", None), ("partial", "yes"),
    ],
)  # fmt: skip
def test_arguments_of_wrong_types(argument: str, value: object) -> None:
    """The error names the argument; the value does not cause another error further in."""
    given: dict[str, object] = {"source": TWO, argument: value}
    with pytest.raises(TypeError, match=f"^`{argument}` takes "):
        burnish.compile(**given)  # type: ignore[arg-type]
    if argument in ("source", "rig", "pass_", "search_path"):
        with pytest.raises(TypeError, match=f"^`{argument}` takes "):
            burnish.check(**given)  # type: ignore[arg-type]


def test_a_folder_of_the_search_path_that_there_is_not(tmp_path: Path) -> None:
    folder = tmp_path / "nowhere"
    with pytest.raises(burnish.CompileError, match=r"there is no folder `.*nowhere`"):
        burnish.compile(TWO, search_path=[folder])
    assert [found.rule.code for found in burnish.check(TWO, search_path=[folder])] == ["B0013"]


def test_instances_of_what_is_no_reflection() -> None:
    said = "`reflection` takes a reflection, and was given a value of type NoneType"
    with pytest.raises(TypeError, match=said):
        burnish.Instance(None)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"^/: there is no `material`\n/: there is no `pass`\n"):
        burnish.Instance({"format": 3})
    instance = burnish.compile(FOUR, "wgsl")["Four"].instance()
    for call in (instance.set, instance.set_text):
        with pytest.raises(TypeError, match="`name` takes a text"):
            call(3, "1")  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="`name` takes a text"):
        instance.get(None)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="`text` takes a text"):
        instance.set_text("t", 3)  # type: ignore[arg-type]


def test_textures_of_what_is_none() -> None:
    texture = burnish.Texture
    with pytest.raises(TypeError, match="`path` takes the path of a picture"):
        texture.load(3)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="`text` takes a text"):
        texture.parse(3)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"`dimension` is one of 2d, .*, and not '4d'"):
        texture.of_array([[0.5]], dimension="4d")  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"`sample` is one of float, .*, and not 3"):
        texture.parse("x.png", sample=3)  # type: ignore[arg-type]
    for color in ("abc", [[1], 2], {"red": 1}):
        with pytest.raises(burnish.PictureError, match="colour"):
            texture.solid(color)  # type: ignore[arg-type]


def test_sums_that_share_sums_take_no_longer_than_their_graph() -> None:
    """A shader with too many nested calls to inline is refused at once."""

    def source(count: int) -> str:
        functions = "\n".join(
            f"fn f{i}(x: float) -> float = f{i - 1}(x) + f{i - 1}(sin(x))" for i in range(1, count)
        )
        last = f"material A {{ alpha = f{count - 1}(uv.x) }}"
        return f"fn f0(x: float) -> float = x\n{functions}\n{last}"

    shader = burnish.compile(source(40), ())["A"].shader
    assert sum(node.op == "call" for node in reachable(shader.roots)) < 100
    assert burnish.compile(source(10), ("glsl",))["A"].text("glsl", "fragment").count("sin(") == 9
    with pytest.raises(burnish.CompileError, match="operations in place of calls of A"):
        burnish.compile(source(40), ("glsl",))


def test_what_was_compiled_before_changes_nothing() -> None:
    """The order of a reflection's lists stays, too: hosts compare reflections with stored ones."""
    script = (
        "import burnish, json, sys\n"
        "from burnish.compiler.documents.writing import to_json\n"
        "material = burnish.compile(sys.argv[1]).materials[0]\n"
        "texts = [file.text for file in material.files]\n"
        "print(json.dumps([texts, to_json(material.reflection)]))"
    )
    fresh = run([sys.executable, "-c", script, str(PLASTIC)], check=True)
    for other in ("normal_map", "skinned", "octaves"):
        burnish.compile(EXAMPLES / f"{other}.burnish")
    (material,) = burnish.compile(PLASTIC)
    texts = [file.text for file in material.files]
    assert [texts, to_json(material.reflection)] == json.loads(fresh.stdout)
