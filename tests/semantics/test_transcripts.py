"""What is kept of the library's equations changes nothing: no node, no note and no message."""

from __future__ import annotations

import random
import shutil
from pathlib import Path

import pytest

import burnish
from burnish.compiler import frontend
from burnish.compiler.library import FOLDER
from burnish.compiler.semantics.checking import slots
from burnish.compiler.semantics.checking.replay import replayed
from burnish.compiler.semantics.shading import assembly, kept_transcripts
from burnish.compiler.semantics.shading.kept_transcripts import KeptTranscripts
from burnish.compiler.semantics.state.context import Context
from burnish.compiler.semantics.state.scope import Instance
from burnish.compiler.semantics.state.transcripts import Kept, LibraryPart
from burnish.compiler.watching import VARIABLE
from burnish.tests.semantics.elaborations import NoBodies, checked, elaborated, keep_nothing, shown
from burnish.tests.suite.processes import at_once

EXAMPLES = sorted((Path(burnish.__file__).parent / "examples").rglob("*.burnish"))


@pytest.fixture(autouse=True)
def kept(monkeypatch: pytest.MonkeyPatch) -> KeptTranscripts:
    """The transcripts of this test; tests verify graphs otherwise, and then none are used."""
    monkeypatch.delenv(VARIABLE)
    kept = KeptTranscripts()
    monkeypatch.setattr(assembly, "KEPT_TRANSCRIPTS", kept)
    monkeypatch.setattr(assembly, "KEPT_BODIES", NoBodies())
    return kept


@pytest.fixture
def replays(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """The names of slots that got their values by transcripts."""
    found: list[str] = []

    def noted(ctx: Context, instance: Instance, name: str, *others: object) -> object:
        value = replayed(ctx, instance, name, *others)  # type: ignore[arg-type]
        found.extend([name] if value is not None else [])
        return value

    monkeypatch.setattr(slots, "replayed", noted)
    return found


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_are_the_same_with_transcripts(path: Path) -> None:
    fresh = checked(path)
    assert [elaborated(path) for _ in range(2)] == [fresh] * 2


HEADS = (
    "Surface", "Surface + Tangents", "Surface + VertexColors", "Surface + Bent",
    "Surface + Tangents + Bent", "Surface + Bent + Tangents", "Other", "Surface + Morphed",
)  # fmt: skip
MEMBERS = (
    "color = ambient(vec3(0.5)) + lambert(shade) + phong(vec3(1), 8)",
    "color = lambert(shade) with { normal = to_eye }",
    "color = inherited.color * alpha",
    "shade = vec3(uv, alpha)",
    "shade = vec3(position in clip)",
    "position = inherited.position + 0.1 * normal",
    "position : point<world> = @vertex (object_position in world)",
    "position = missing",
    "object_position = inherited.object_position + vector<object>(uv, 0)",
    "object_normal = vertex_normal",
    "normal = normalize(inherited.normal + to_eye)",
    "normal = (object_normal in world)",
    "normal : direction<world> = inherited.to_eye",
    "to_eye = normalize(eye - inherited.position)",
    "uv = inherited.uv * 2",
    "uv : vec2 = 0",
    "alpha = 2",
    "alpha = true",
    "param eye : point<world> per material = vec3(0)",
    "eye = position",
    "param ambient_light : rgb in 0..2 = vec3(1)",
    "clip_position = vec4(uv, 0, 1)",
    "clip_position = inherited.clip_position",
    "clip_position = color",
    "param turned : transform<world, view> per view = mat4(1)",
    "object_to_world : transform<object, world> = mat4(1)",
    "param shortcut : transform<object, clip> per view = mat4(1)",
    "pi = 3",
    "moved = @vertex (object_normal in world)",
    "again = position in clip",
    "vertex_position = missing",
    "front_facing = false",
    "sized = fwidth(uv)",
    "reached = tangent",
)  # fmt: skip
BESIDE = (
    "mixin Bent for material { normal = normalize(inherited.normal + 0.1 * to_eye)\n"
    " bent = position in clip }\n",
    "abstract material Other : Surface { deep : float\n position = inherited.position\n"
    " color = vec3(deep) }\n",
    "material Second : Surface { color = phong(vec3(1), 2)\n shade = normal }\n",
    "light Own : Spot { falloff = inherited.falloff * 2 }\n",
    "light Near : Point { to_place = inherited.to_place * 2\n position = to_place }\n",
    "light Flat : Light { to_light = to_eye }\n",
    "pass Moved : Forward { clip_position = vec4(vec3(position), 1) }\n",
    "pass Viewed : Forward { param seen : transform<world, view> = mat4(1) }\n",
    "fn fwidth(x: vec2) -> float = x.y\n",
)
LIGHTS = (
    "Directional", "Point", "Point[<= 4]", "Spot[2]", "Spot { inner = 10deg }", "FocusedSpot[]",
    "FocusedSpot", "Own", "Own[2]", "Near", "Flat", "Directional[<= 2] { falloff = 0.5 }", "Light",
)  # fmt: skip
IMPORTS = (
    "import std.lights\nimport std.terms\nimport std.tangents\nimport std.vertices\n"
    "import std.morphing\n"
)


def program(chance: random.Random) -> str:
    """A program of a few declarations, right or wrong, that build on those of the library."""
    beside = chance.sample(BESIDE, chance.randrange(len(BESIDE)))
    members = chance.sample(MEMBERS, chance.choice((0, 1, 1, 2, 2, 3, 5)))
    lights = [f" light{n} : {name}\n" for n, name in enumerate(chance.sample(LIGHTS, 3))]
    material = f"material M : {chance.choice(HEADS)} {{\n {chr(10).join(members)}\n}}\n"
    rig = f"rig R {{\n{''.join(lights[: chance.choice((0, 1, 2, 3))])}}}\n"
    parts = [*beside, material, rig if chance.random() < 0.8 else ""]
    chance.shuffle(parts)
    return f"burnish 1\n{IMPORTS}{''.join(parts)}"


@pytest.mark.parametrize("seed", range(8))
def test_random_programs_are_the_same_in_a_process_that_has_compiled_others(
    seed: int, replays: list[str]
) -> None:
    chance = random.Random(seed)
    for _ in range(30):
        text = program(chance)
        assert elaborated(text) == checked(text), text
    assert {"position", "normal", "to_eye", "to_light", "diffuse"} <= set(replays)


def test_results_are_the_same_with_transcripts() -> None:
    """Texts, reflections, the places behind each line, and what a decision rests on."""
    text = EXAMPLES[0].parent.joinpath("plastic.burnish").read_text()
    with pytest.MonkeyPatch.context() as patch:
        keep_nothing(patch)
        fresh = _results(text)
    assert [_results(f"{text}\n") for _ in range(2)] == [fresh] * 2


def _results(text: str) -> list[object]:
    (material,) = burnish.compile(text).materials
    files = [(f.name, f.text, [*map(shown, f.spans)]) for f in material.files]
    return [files, repr(material.reflection), material.guards]


def test_slots_of_the_library_are_replayed_and_others_are_checked(replays: list[str]) -> None:
    text = "material M { position = vec3(0)\n color = vec3(to_eye) * normal }"
    for _ in range(3):
        elaborated(text)
    assert "normal" in replays
    assert not {"position", "to_eye", "clip_position", "color"} & set(replays)


OTHER_POINT = """
struct MeshPoint { height : float  weight : float }
fn point(x: float) -> MeshPoint = MeshPoint(x, 2 * x)
material M { color = point(uv.x).weight * vec3(normal) }
"""
"""A structure that is called as one of the library's surface."""


def test_structures_of_the_library_are_made_again_unless_others_have_their_names(
    replays: list[str],
) -> None:
    for text, is_replayed in ((OTHER_POINT, False), (OTHER_POINT.replace("Mesh", ""), True)):
        fresh = checked(text)
        replays.clear()
        assert [elaborated(text) for _ in range(3)] == [fresh] * 3
        assert ("object_shape" in replays) == is_replayed
        results = [[f.text for f in burnish.compile(f"{text}// {n}\n").materials[0].files]
                   for n in range(2)]  # fmt: skip
        assert results[0] == results[1]


def test_a_library_that_changes_is_checked_anew(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    shutil.copytree(FOLDER, tmp_path / "stdlib")
    monkeypatch.setattr(frontend, "FOLDER", tmp_path / "stdlib")
    prelude = tmp_path / "stdlib" / "prelude.burnish"
    own = prelude.read_text()
    for change in (
        ("uv       : vec2          = vertex_uv", "uv : vec2 = vertex_uv * 2"),
        ("normalize(nonzero(eye - position))", "normalize(eye - position)"),
        ("/// Where the viewer stands", "/// The viewer"),
        ("rgb per rig = vec3(0.1)", "rgb per view = vec3(0.2)"),
        ("param eye : point<world> per view", "param eye : point<view> per view"),
        ("clip_position : point<clip> = position in clip", "clip_position : point<clip> = color"),
    ):
        for text in (own, own.replace(*change), own):
            prelude.write_text(text)
            for _ in range(3):
                source = "material M { color = vec3(uv, 1) * to_eye }"
                assert elaborated(source) == checked(source)


def test_a_light_of_the_library_reads_the_slots_that_its_surface_has(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    """Also those that the user's material overrides."""
    shutil.copytree(FOLDER, tmp_path / "stdlib")
    monkeypatch.setattr(frontend, "FOLDER", tmp_path / "stdlib")
    lights = tmp_path / "stdlib" / "lights.burnish"
    lights.write_text(
        f"{lights.read_text()}\nlight Odd : Light {{ to_light = inherited.normal }}\n"
    )
    source = """
    import std.lights.{Odd}
    import std.terms.{lambert}
    material M { normal = to_eye  color = lambert(vec3(1)) }
    rig R { odd : Odd }
    """
    assert [elaborated(source) for _ in range(3)] == [checked(source)] * 3


def test_few_transcripts_are_kept(monkeypatch: pytest.MonkeyPatch) -> None:
    few = KeptTranscripts(most=2)
    monkeypatch.setattr(assembly, "KEPT_TRANSCRIPTS", few)
    for chance in map(random.Random, range(12)):
        text = program(chance)
        assert elaborated(text) == checked(text)
    assert len(few) == 2


def test_nothing_is_kept_of_what_was_not_finished(
    kept: KeptTranscripts, monkeypatch: pytest.MonkeyPatch
) -> None:
    text = "material M { color = normal }"
    fresh = checked(text)
    elaborated(text)
    with monkeypatch.context() as patch:

        def interrupted(_part: LibraryPart) -> Kept:
            raise KeyboardInterrupt

        patch.setattr(kept_transcripts, "_transcribed", interrupted)
        with pytest.raises(KeyboardInterrupt):
            elaborated(text)
    assert len(kept) == 0
    assert elaborated(text) == fresh


def test_who_watches_passes_gets_everything_checked(
    monkeypatch: pytest.MonkeyPatch, replays: list[str]
) -> None:
    monkeypatch.setenv(VARIABLE, "1")
    for _ in range(3):
        elaborated("material M { color = normal }")
    assert not replays


def test_threads_share_transcripts() -> None:
    texts = [program(random.Random(seed)) for seed in range(6)]
    fresh = [checked(text) for text in texts]

    def work() -> list[list[str]]:
        return [elaborated(text) for text in texts]

    assert at_once([work] * 4) == [fresh] * 4
