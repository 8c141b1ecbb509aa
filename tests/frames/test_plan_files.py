"""Plans that are read from files, and what is said of those that are broken or hostile."""

from __future__ import annotations

import json
import os
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

import burnish
from burnish.api.entry_points import CompiledFrame
from burnish.compiler.budget import BudgetError, raised
from burnish.compiler.documents.writing import to_json
from burnish.targets.runner.files import FileError
from burnish.targets.runner.frames.checking import PlanError
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.plan_files import read_frame, told_contradictions
from burnish.targets.runner.frames.scenery import in_a_row
from burnish.targets.runner.instances.instance import Instance

from .kit import FOLDER, compiled

FRAME = compiled(FOLDER / "deferred.burnish")
PROFILES = ("wgsl:webgpu",)
CLAY = "Deferred.Surfaces.Clay"


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    """A folder with all that ``burnish compile`` writes of the frame, for one target."""
    write_files(tmp_path, FRAME, "Deferred.plan.json")
    return tmp_path


def write_files(folder: Path, frame: CompiledFrame, name: str) -> None:
    """Write all that ``burnish compile`` writes of a frame, whose plan has this file name."""
    (folder / name).write_text(json.dumps(to_json(frame.plan)), "utf-8")
    for shader in frame.shaders:
        reflection = json.dumps(to_json(shader.reflection))
        (folder / f"{shader.name}.json").write_text(reflection, "utf-8")
        for file in shader.files:
            (folder / file.name).write_text(file.text, "utf-8")


def compiled_for(profile: str) -> CompiledFrame:
    """A frame with kernels over images, in the texts of one profile."""
    (frame,) = burnish.compile(FOLDER / "ripples.burnish", (profile,)).frames
    return frame


def said(folder: Path) -> str:
    """The error of the plan in a folder, as text."""
    with pytest.raises((PlanError, FileError, BudgetError)) as failed:
        read_frame(folder / "Deferred.plan.json", PROFILES)
    return str(failed.value)


def edit(path: Path, change: Callable[[Any], object]) -> None:
    """Change a document."""
    document = json.loads(path.read_text("utf-8"))
    change(document)
    path.write_text(json.dumps(document), "utf-8")


def test_a_frame_comes_back_as_it_was_compiled(folder: Path) -> None:
    found = read_frame(folder / "Deferred.plan.json", PROFILES)
    assert (found.name, found.plan) == (FRAME.name, FRAME.plan)
    for stored, made in zip(found.shaders, FRAME.shaders, strict=True):
        assert stored.reflection == made.reflection
        assert [(f.name, f.text, f.entry_points) for f in stored.files] == [
            (f.name, f.text, dict(f.entry_points)) for f in made.files
        ]


def test_a_text_with_other_directives_reaches_no_driver(folder: Path) -> None:
    """OpenGL's drivers and browsers compile GLSL themselves."""
    text = folder / f"{CLAY}.frag.wgsl"
    text.write_text(f"// first\n  #define A B\n{text.read_text('utf-8')}", "utf-8")
    assert said(folder) == (
        f'`{CLAY}.frag.wgsl`, line 2: no text of Burnish has the directive "#define A B"'
    )


def test_texts_for_another_target_are_missed(folder: Path) -> None:
    with pytest.raises(PlanError) as raised:
        read_frame(folder / "Deferred.plan.json", ("glsl:vulkan",))
    assert str(raised.value) == (
        "Deferred.Surfaces.Clay has no text for glsl:vulkan: `Deferred.Surfaces.Clay.json` lists "
        "wgsl:webgpu. Compile the source with --target glsl:vulkan"
    )


NO_JSON = "`Deferred.plan.json` is no JSON that can be read: "
NO_PLAN = "`Deferred.plan.json` is no plan that can be read:"
OTHER_VERSION = "and Burnish reads version 2: compile the source again"
TOO_DEEP = "lists and objects stand in each other more than 200 times"
TEXTS = {
    "": "`Deferred.plan.json` is no JSON that can be read: Expecting value, line 1, column 1",
    "[]": "`Deferred.plan.json` is no plan: it has no `plan`, which is its version",
    '{"plan": 7}': f"{NO_PLAN}\n  /plan: this is version 7, {OTHER_VERSION}",
    '{"plan": true}': f"{NO_PLAN}\n  /plan: this is version true, {OTHER_VERSION}",
    '{"plan": 2, "plan": 2}': "`Deferred.plan.json` is no JSON that can be read: "
    '"plan" stands twice in one object',
    '{"plan": NaN}': "`Deferred.plan.json` is no JSON that can be read: NaN is no number of JSON",
    '{"plan": 1e999}': "`Deferred.plan.json` is no JSON that can be read: 1e999 is too large "
    "for a number",
    '{"plan": ' + 201 * "[" + 201 * "]" + "}": f"{NO_JSON}{TOO_DEEP}",
    '{"plan": ' + 100_000 * "[": f"{NO_JSON}{TOO_DEEP}",
    '{"plan": ' + "9" * 5000 + "}": f"{NO_JSON}{'9' * 20}… is too large for a whole number",
    '{"plan": -9007199254740993}': f"{NO_JSON}-9007199254740993 is too large for a whole number",
    '{"plan": "\\ud800"}': f"{NO_JSON}a text in it has half of a character",
    '{"plan": 2, "plan\u202e\\n": 0}': f"{NO_PLAN}\n  /: there is no `frame`",
}


@pytest.mark.parametrize("text", TEXTS, ids=lambda text: text[:20])
def test_what_is_no_plan_is_told(folder: Path, text: str) -> None:
    (folder / "Deferred.plan.json").write_text(text, "utf-8")
    wanted = TEXTS[text].splitlines()
    assert said(folder).splitlines()[: len(wanted)] == wanted


def test_other_bytes_are_told(folder: Path) -> None:
    (folder / "Deferred.plan.json").write_bytes(b'{"plan": "\xff"}')
    assert said(folder) == "`Deferred.plan.json` is no text in UTF-8"


def test_places_are_told_at_which_a_plan_does_not_follow_its_schema(folder: Path) -> None:
    def change(plan: Any) -> None:
        del plan["textures"][0]["format"]
        plan["steps"][0]["depth"]["load"] = "maybe"
        plan["kept"] = 3

    edit(folder / "Deferred.plan.json", change)
    assert said(folder).splitlines() == [
        "`Deferred.plan.json` is no plan that can be read:",
        "  /textures/0: there is no `format`",
        '  /steps/0/depth/load: "maybe" is not "load" or "clear"',
        "  /kept: 3 is not a list",
    ]


def test_a_broken_reflection_is_told(folder: Path) -> None:
    edit(folder / f"{CLAY}.json", lambda reflection: reflection.pop("targets"))
    assert said(folder).splitlines() == [
        "`Deferred.Surfaces.Clay.json` is no reflection that can be read:",
        "  /: there is no `targets`",
    ]


def test_an_exchanged_reflection_is_told(folder: Path) -> None:
    text = (folder / "Deferred.Surfaces.Jade.json").read_text("utf-8")
    (folder / f"{CLAY}.json").write_text(text, "utf-8")
    assert said(folder) == (
        "Deferred, Deferred.Surfaces.Clay: Deferred.Surfaces.Clay.json is the reflection of "
        "another shader"
    )


def test_a_missing_text_is_told(folder: Path) -> None:
    (folder / f"{CLAY}.frag.wgsl").unlink()
    assert said(folder) == "cannot read `Deferred.Surfaces.Clay.frag.wgsl`: No such file or " \
        "directory"  # fmt: skip
    (folder / f"{CLAY}.frag.wgsl").mkdir()
    assert said(folder) == "cannot read `Deferred.Surfaces.Clay.frag.wgsl`: it is not a file"


@pytest.mark.parametrize(
    "name",
    ["../secret.json", "/etc/passwd", "..\\secret.json", "C:secret.json", "a/b.json", "..", "",
     "a\nb.json"],
)  # fmt: skip
def test_no_file_outside_of_the_folder_is_read(folder: Path, name: str) -> None:
    def other_reflection(plan: Any) -> None:
        plan["shaders"][0]["reflection"] = name

    def other_text(reflection: Any) -> None:
        reflection["backends"]["wgsl:webgpu"]["files"][0]["file"] = name

    wanted = f"Deferred.Surfaces.Clay: {json.dumps(name)} is not the name of a file"
    edit(folder / f"{CLAY}.json", other_text)
    assert said(folder) == wanted
    edit(folder / "Deferred.plan.json", other_reflection)
    assert said(folder) == wanted


def test_no_link_leads_out_of_the_folder(folder: Path) -> None:
    (folder / f"{CLAY}.json").rename(folder / "other.json")
    (folder / f"{CLAY}.json").symlink_to(folder / "other.json")
    assert said(folder) == (
        f"cannot read `{CLAY}.json`: it is a link, and links are not followed there"
    )


def test_pipes_and_devices_are_not_opened(folder: Path) -> None:
    (folder / f"{CLAY}.json").unlink()
    os.mkfifo(folder / f"{CLAY}.json")
    assert said(folder) == f"cannot read `{CLAY}.json`: it is not a file"


def test_files_are_not_read_without_limits(folder: Path) -> None:
    with raised({"document": 1000}):
        assert said(folder) == (
            "`Deferred.plan.json` has 11.6 kB, and the limit is 1 kB: `--budget "
            "document=12k` raises it"
        )
    with raised({"document": 60_000}):
        assert re.fullmatch(
            "`Deferred.plan.json`, with the files that it names, has .* kB, and the limit is 60 "
            "kB: `--budget document=.*k` raises it",
            said(folder),
        )


def test_values_are_counted_before_they_are_made(folder: Path) -> None:
    (folder / "Deferred.plan.json").write_text("[" + ",".join(["[]"] * 2_100_000), "utf-8")
    assert said(folder) == (
        "`Deferred.plan.json`, with the files that it names, has 4,200,001 values, and the limit "
        "is 3,000,000 values: `--budget values=4201k` raises it"
    )


VALUES: dict[str, tuple[dict[str, Any], str]] = {
    "no function": (
        {"op": "call", "type": "float", "args": [0], "function": "explode"},
        "Deferred, value 2: there is no function `explode`",
    ),
    "of no part": (
        {"op": "index", "type": "float", "args": [0, 0]},
        "Deferred, value 2: its steps cannot be computed",
    ),
    "of what is behind": (
        {"op": "splat", "type": "float", "args": [7]},
        "Deferred, value 2: step 1 is computed of [7], which do not stand before it",
    ),
    "a vector": (
        {"op": "vector", "type": "float", "args": [0, 0]},
        "Deferred, value 2: its steps compute no float",
    ),
    "a sum without end": (
        {"op": "fold", "type": "float", "args": [0, 0, 0], "operator": "add", "bound": 2**40},
        f"Deferred, value 2: step 1 has {2**40} terms",
    ),
    "of itself": (
        {"op": "splat", "type": "float", "args": [1]},
        "Deferred, value 2: step 1 is computed of [1], which do not stand before it",
    ),
}
"""The last step of the number that is the exposure, and what is said of it."""


@pytest.mark.parametrize("name", VALUES)
def test_steps_of_values_that_cannot_be_computed(folder: Path, name: str) -> None:
    step, wanted = VALUES[name]
    edit(folder / "Deferred.plan.json", lambda plan: plan["values"][2]["steps"].append(step))
    with pytest.raises(PlanError) as raised:
        frame = read_frame(folder / "Deferred.plan.json", PROFILES)
        FrameHost(frame, in_a_row(["Clay", "Jade"], {}, "cube"), (8, 8)).number(2)
    assert str(raised.value) == wanted


def test_steps_of_values_follow_the_schema(folder: Path) -> None:
    def change(plan: Any) -> None:
        plan["values"][2]["steps"] = [{"op": "index", "type": "float", "args": [0]}]

    edit(folder / "Deferred.plan.json", change)
    assert said(folder).splitlines() == [
        "`Deferred.plan.json` is no plan that can be read:",
        "  /values/2/steps/0/args: it has 1 elements, and not 2",
    ]


def test_reflections_that_say_what_cannot_be(folder: Path) -> None:
    """The schema does not check types, so using them fails; for own frames that stays a bug."""

    def add_a_matrix(reflection: Any) -> None:
        steps = reflection["derived"][0]["steps"]
        (matrix,) = [n for n, step in enumerate(steps) if step["op"] == "parameter"]
        steps.append({"op": "swizzle", "type": "vec3", "args": [matrix], "lanes": [0, 1, 2]})
        steps.append({"op": "index", "type": "vec3", "args": [matrix, matrix]})

    edit(folder / f"{CLAY}.json", add_a_matrix)
    frame = read_frame(folder / "Deferred.plan.json", PROFILES)
    with pytest.raises(PlanError) as raised, told_contradictions(frame):
        Instance(frame.shaders[0].reflection).blocks()
    assert str(raised.value).startswith("Deferred: its files contradict each other: ")
    with pytest.raises(KeyError), told_contradictions(FRAME):
        raise KeyError


GROUPS = {
    "glsl:vulkan": "layout(local_size_x = 8, local_size_y = 8) in;",
    "hlsl:sm6": "[numthreads(8, 8, 1)]",
    "wgsl:webgpu": "@compute @workgroup_size(8, 8)",
}
"""The work group of a kernel over images, as texts for some profiles declare it."""


@pytest.mark.parametrize("profile", GROUPS)
def test_a_work_group_is_that_of_the_text(tmp_path: Path, profile: str) -> None:
    """With another one, a kernel would leave texels as they are, or write past the last of them."""
    whole = compiled_for(profile)
    path = tmp_path / "Ripples.plan.json"
    write_files(tmp_path, whole, path.name)
    read_frame(path, (profile,))
    shader = next(each for each in whole.shaders if each.name == "Ripples.Waves")
    (file,) = (each for each in shader.files if "compute" in each.entry_points)
    assert f"\n{GROUPS[profile]}\n" in file.text
    document = tmp_path / "Ripples.Waves.json"
    edit(document, lambda found: found.update(work_group=[16, 16, 1]))
    with pytest.raises(PlanError) as raised:
        read_frame(path, (profile,))
    assert str(raised.value) == (
        f"Ripples.Waves: its work group is 16 x 16 x 1, and `{file.name}` declares 8 x 8 x 1: "
        "compile the source again"
    )
    edit(document, lambda found: found.update(work_group=[8, 8, 1]))
    text = tmp_path / file.name
    text.write_text(file.text.replace(GROUPS[profile], f"// {GROUPS[profile]}"), "utf-8")
    with pytest.raises(PlanError) as raised:
        read_frame(path, (profile,))
    assert str(raised.value) == (
        f"Ripples.Waves: `{file.name}` has 0 lines that declare its work group"
    )
