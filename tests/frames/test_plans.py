"""Plans: what examples are planned as, and errors that are planted in them."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest

from burnish.compiler.documents.plan import (
    DrawStep,
    FramePlan,
    HostSource,
    PlanStep,
    PreviousSource,
    ResultSource,
    Source,
    ValueSource,
    WaitingRow,
)
from burnish.compiler.documents.reading import ShapeError, read
from burnish.compiler.documents.writing import to_json
from burnish.targets.runner.frames.checking import PlanError, check_plan

from ..golden import assert_golden
from .changes import Change
from .changes import Path as Place
from .kit import EXAMPLES, FOLDER, compiled, inputs_of, of_text

pytestmark = pytest.mark.xdist_group("plans")  # One process compiles all examples.

GOLDEN = Path(__file__).parent / "golden"


def lines(plan: FramePlan) -> Iterator[str]:
    """A plan in a form that people read."""
    for number, row in enumerate(plan.textures):
        layers = f" x {row.layers}" if row.layers > 1 else ""
        layers += f" of {row.samples} samples" if row.samples > 1 else ""
        kept = ", kept" if row.kept else ""
        results = ", ".join(row.results)
        yield f"texture {number}: {row.format} {row.dimension}{layers}{kept}: {results}"
    for step in plan.steps:
        yield ""
        first = " (first frame only)" if step.only_first else ""
        if isinstance(step, DrawStep) and step.continues:
            first += " (in the same render pass)"
        yield f"{step.kind} {step.name}{first}" if step.kind != "copy" else f"copy{first}"
        yield from waits(step)
        for target in step.attachments:
            place = f"[{target.layer}]" if target.layer else ""
            stored = "" if target.store else ", dropped"
            if target.stencil is not None:
                stored += ", with stencil" + ("" if target.stencil.store else " dropped")
            if target.resolve is not None:
                stored += f", resolved to {target.resolve.texture}"
            yield f"  {target.load} {target.name} -> {target.texture}{place}{stored}"
        for each in inputs_of(step):
            yield f"  {each.name} = {source_text(each.source)}"
    yield ""
    yield "end"
    yield from waits(plan.end)


def source_text(source: Source) -> str:
    """The source of an input, as text."""
    match source:
        case ValueSource():
            return f"value {source.value}"
        case HostSource():
            return f"{source.host} of the host"
        case ResultSource():
            return source.result + in_texture(source.texture)
        case PreviousSource():
            found = f"previous({source.previous}){in_texture(source.texture)}"
            first = source.initially
            return found if first is None else f"{found}, first {source_text(first)}"


def in_texture(texture: int | None) -> str:
    """The texture that holds something, as text; empty if none does."""
    return "" if texture is None else f" in texture {texture}"


def waits(place: PlanStep | WaitingRow) -> Iterator[str]:
    """The barriers before a step, or behind the last one, as text."""
    for row in place.barriers:
        yield f"  texture {row.texture}: {row.before} -> {row.after}"
    for each in place.buffer_barriers:
        yield f"  buffer {each.result}: {each.before} -> {each.after}"


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_are_planned_as_before(path: Path) -> None:
    plan = compiled(path).plan
    assert read(FramePlan, to_json(plan)) == plan
    check_plan(plan)
    assert_golden("\n".join(lines(plan)) + "\n", GOLDEN / f"{path.stem}.txt")


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_examples_leave_pictures_that_are_encoded(path: Path) -> None:
    """Or floats: a host that shows the bytes of an output as they are draws no dark picture."""
    plan = compiled(path).plan
    formats = {plan.textures[row.texture].format for row in plan.outputs if row.texture is not None}
    assert formats.isdisjoint(("rgba8", "bgra8", "rgb10a2"))


def planted(plan: dict[str, Any]) -> Iterator[Change]:
    """Changes of one error each: a missing barrier, a wrong load, a texture for another."""
    for s, step in enumerate(plan["steps"]):
        yield from without_waiting(("steps", s), step)
        for t, target in enumerate(step.get("targets", [])):
            other = "clear" if target["load"] == "load" else "load"
            yield Change(("steps", s, "targets", t, "load"), f"{other} instead", other)
        for path, row in places_of_sources(s, step):
            if row.get("texture") is None:
                continue
            for texture in range(len(plan["textures"])):
                if texture != row["texture"]:
                    yield Change((*path, "texture"), f"{texture} instead", texture)
    yield from without_waiting(("end",), plan["end"])


def without_waiting(path: Place, place: dict[str, Any]) -> Iterator[Change]:
    """Changes that leave out one barrier each."""
    for kind in ("barriers", "buffer_barriers"):
        for b in range(len(place[kind])):
            others = [row for number, row in enumerate(place[kind]) if number != b]
            yield Change((*path, kind), f"without row {b}", others)


def places_of_sources(number: int, step: dict[str, Any]) -> Iterator[tuple[Place, dict[str, Any]]]:
    """The sources of a step's inputs, each with its place in the plan."""
    uses: list[tuple[Place, Any]] = [
        (("steps", number, "draws", d, "uses", u), use)
        for d, drawn in enumerate(step.get("draws", []))
        for u, use in enumerate(drawn["uses"])
    ]
    if step["kind"] == "run":
        uses = [(("steps", number, "use"), step["use"])]
    for path, use in uses:
        for i, row in enumerate(use["inputs"]):
            yield (*path, "inputs", i, "source"), row["source"]


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_planted_errors_are_found(path: Path) -> None:
    plan = to_json(compiled(path).plan)
    missed = []
    for change in planted(plan):
        try:
            check_plan(read(FramePlan, change.made(plan)))
        except PlanError:
            continue
        missed.append(change.name)
    assert len(list(planted(plan))) > 5
    assert not missed


def test_a_plan_of_another_version_is_refused() -> None:
    plan = to_json(compiled(EXAMPLES[0]).plan)
    with pytest.raises(ShapeError) as failed:
        read(FramePlan, {**plan, "plan": 1, "steps": 3})
    assert str(failed.value) == (
        "/plan: this is version 1, and Burnish reads version 2: compile the source again"
    )


OVER = """
material Clay { color = #a08060 }
material Glass { color = #80c0ff  alpha = 0.3 }
pass Panes : Forward blend alpha {}
frame Both {
    models scene
    models panes : Glass
    solid = Forward(scene)
    both  = Panes(panes, solid)
    output picture = both.color
    OUTPUT
}
"""


def test_what_nobody_else_needs_is_drawn_over_in_place() -> None:
    plan = of_text(OVER.replace("OUTPUT", "")).plan
    assert [step.kind for step in plan.steps] == ["draw", "draw"]
    assert plan.textures[0].results == ("solid.color", "both.color")
    assert [(row.name, row.load) for row in plan.steps[1].attachments] == [
        ("color", "load"), ("depth", "load")
    ]  # fmt: skip
    assert [isinstance(step, DrawStep) and step.continues for step in plan.steps] == [False, True]


def test_what_others_need_is_copied_before() -> None:
    plan = of_text(OVER.replace("OUTPUT", "output before = solid.color")).plan
    assert [step.kind for step in plan.steps] == ["draw", "copy", "draw"]
    check_plan(plan)


TABLES = """
import std.frames.{FullScreen}
pass Table : FullScreen {
    param scale : float = 1
    target value : r16f = scale * uv.x
}
pass Scaled : FullScreen {
    map table : texture2d
    target value : r16f = 2 * table(uv).r
}
frame Tables {
    param scale : float = 1
    STEPS
    shown = Scaled(screen) with { table = table.value }
    output picture = shown.value
    output ANOTHER
}
"""


@pytest.mark.parametrize(
    ("steps", "another", "expected"),
    [
        ("table = Table(screen, 4) with { scale = 3 }", "other = shown.value", {"table"}),
        ("table = Scaled(screen, 4) with { table = one.value }  "
         "one = Table(screen, 2 + 2) with { scale = 3 }", "other = shown.value", {"table", "one"}),
        # What the host gives may change: a parameter of the pass or of the frame, and the size.
        ("table = Table(screen, 4)", "other = shown.value", set()),
        ("table = Table(screen, 4) with { scale = scale }", "other = shown.value", set()),
        ("table = Table(screen, size / 2) with { scale = 3 }", "other = shown.value", set()),
        ("table = Table(screen, 4) with { scale = 3, scissor = ivec4(0, 0, 2, 2) }",
         "other = shown.value", {"table"}),
        ("table = Table(screen, 4) with { scale = 3, clear.value = scale }",
         "other = shown.value", set()),
        ("table = Table(screen, 4) with { scale = 3, viewport = ivec4(0, 0, int(scale), 2) }",
         "other = shown.value", set()),
        # What others draw over, and what the host gets, is drawn anew.
        ("table = Table(screen, one) with { scale = 3 }  "
         "one = Table(screen, 4) with { scale = 3 }", "other = shown.value", set()),
        ("table = Table(screen, 4) with { scale = 3 }", "other = table.value", set()),
    ],
)  # fmt: skip
def test_what_is_the_same_in_every_frame_is_drawn_once(
    steps: str, another: str, expected: set[str]
) -> None:
    plan = of_text(TABLES.replace("STEPS", steps).replace("ANOTHER", another)).plan
    assert read(FramePlan, to_json(plan)) == plan
    check_plan(plan)
    assert {step.name for step in plan.steps if step.only_first} == expected


FACES = """
import std.frames.{FullScreen}
pass Filled : FullScreen blend add { target value : rgba16f = vec4(uv, 0, 1) }
pass Shown : FullScreen {
    map cube : texture_cube
    target value : rgba8 = cube.level(vec3(uv, 1), 0)
}
frame Faces {
    first = each face in cube : Filled(screen, 8)
    both  = each face in cube : Filled(screen, [first.value])
    shown = Shown(screen) with { cube = both.value }
    output picture = shown.value
    OUTPUT
}
"""


@pytest.mark.parametrize(("output", "copies"), [("", 0), ("output other = first.value", 1)])
def test_all_faces_of_a_cube_are_drawn_over_in_place(output: str, copies: int) -> None:
    plan = of_text(FACES.replace("OUTPUT", output)).plan
    check_plan(plan)
    assert [step.kind for step in plan.steps].count("copy") == copies
    assert len(plan.textures) == 2 + copies


SAMPLED = """
import std.frames.{FullScreen}
pass Filled : FullScreen blend add {
    raster { samples = 4 }
    target value : rgba16f = vec4(uv, 0, 1)
}
frame Sampled {
    cube  = each face in cube : Filled(screen, 8)
    both  = each face in cube : Filled(screen, [cube.value])
    chain = each level in mips(3) : Filled(screen, 8)
    output faces  = both.value
    output levels = chain.value
}
"""


def test_layers_and_levels_have_samples_of_their_own() -> None:
    """Faces that others draw over are kept apart, and others are drawn one after the other."""
    plan = of_text(SAMPLED).plan
    check_plan(plan)
    several = [row for row in plan.textures if row.samples > 1]
    assert [row.results for row in several] == [("cube.value", "both.value")] * 5 + [
        ("cube.value", "both.value", "chain.value"), ("chain.value",), ("chain.value",)
    ]  # fmt: skip
    resolved = [row.resolve for step in plan.steps for row in step.attachments]
    places = [(row.layer, row.level) for row in resolved if row is not None]
    assert places == [(face, 0) for face in range(6)] + [(0, level) for level in range(3)]
    alone = of_text(SAMPLED.replace("both.value", "cube.value")).plan
    check_plan(alone)
    several = [row for row in alone.textures if row.samples > 1]
    assert len(several) == 3
    assert several[0].results == ("cube.value", "chain.value")


def test_a_step_may_be_called_like_a_word_for_what_is_repeated() -> None:
    """`each face in cube` draws six faces, also where that is a step called `cube`."""
    plan = of_text(SAMPLED.replace("chain", "mips")).plan
    names = [step.name for step in plan.steps]
    assert names[0] == "cube.0" and names[-1] == "mips.level2"


def test_what_is_exchanged_has_the_uses_of_both_textures() -> None:
    plan = compiled(FOLDER / "reaction.burnish").plan
    (row,) = plan.kept
    assert row.texture is not None and row.previous is not None
    one, other = (plan.textures[number].uses for number in (row.texture, row.previous))
    assert sorted(one) == sorted(other) == ["image", "sampled"]


CAMERA = """
material Clay { color = #a08060 }
frame Seen {
    param shown : transform<world, clip>
    param other : float = 1
    models scene
    drawn = Forward(scene) with { clear.color = vec4(other) }
    map_  = Forward(scene, 16) with { view_projection = shown }
    output picture = drawn.color
    output map = map_.color
}
"""


def test_the_parameters_of_the_camera_are_marked() -> None:
    frame = of_text(CAMERA)
    roles = {row.name: row.role for row in frame.plan.parameters}
    assert [roles[name] for name in ("shown", "other", "size")] == ["world_to_clip", None, "size"]
    (shader,) = frame.shaders
    roles = {row.name: row.role for row in shader.reflection.parameters}
    assert roles["view_projection"] == "world_to_clip"
    assert roles["object_to_world"] == "object_to_world"


def test_a_step_that_is_not_drawn_has_no_shader() -> None:
    frame = of_text("""
        import std.frames.{FullScreen}
        pass Left : FullScreen { target value : rgba32f = vec4(uv, 0, 1) }
        pass Drawn : FullScreen { target value : rgba32f = vec4(1) }
        frame Seen {
            left   = Left(screen)
            drawn  = Drawn(screen)
            output picture = drawn.value
        }
    """)
    assert [shader.name for shader in frame.shaders] == ["Seen.Drawn"]
    check_plan(frame.plan, [shader.reflection for shader in frame.shaders])
