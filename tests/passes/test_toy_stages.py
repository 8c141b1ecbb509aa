"""A stage that the compiler has never heard of goes all the way, by its row alone.

Two chains are made by hand: one has a stage between the vertices and the fragments, the other
captures what its vertices come to and has no fragments.
"""

from __future__ import annotations

import json
from collections.abc import Callable, Sequence

import pytest

from burnish.commands.graph.kinds import ArrowKind, Kind
from burnish.commands.graph.program import program_picture
from burnish.commands.graph.text import written
from burnish.compiler.documents.reading import read
from burnish.compiler.documents.reflection import Reflection
from burnish.compiler.documents.writing import to_json
from burnish.compiler.ir import build
from burnish.compiler.ir.program import Field, Stage
from burnish.compiler.ir.shader import (
    RenderTarget,
    Result,
    Shader,
)
from burnish.compiler.ir.stages import (
    CLIP_POSITION,
    FLAT,
    FRAGMENT,
    FRAGMENTS,
    SMOOTH,
    TARGET,
    VARYING,
    VERTEX,
    VERTICES,
    Crossing,
    StageRow,
    SystemInput,
)
from burnish.compiler.ir.statements import Let
from burnish.compiler.ir.types import FLOAT, INT, UINT, VEC2, VEC3, VEC4
from burnish.compiler.ir.verify import InvalidGraphError, verify
from burnish.compiler.passes.pipeline import Options, Staged, stage
from burnish.compiler.reflection import reflect
from burnish.support.frozen import changed
from burnish.targets import registry
from burnish.targets.description.spellings import PipelineInput
from burnish.targets.emit.emitter import emit
from burnish.targets.legalise.lacks import lacks
from burnish.targets.legalise.legalise import legalise

from .toy import Toy

PRIMITIVE = SystemInput("primitive_index", UINT, "emitted")
GEOMETRY = StageRow(
    "geometry", "emitted", "geom", "gs_main", inputs=(PRIMITIVE,), delivers=(CLIP_POSITION,)
)
INTO_GEOMETRY = Crossing(VERTICES, "emitted", "flat")
OUT_OF_GEOMETRY = Crossing("emitted", FRAGMENTS, "perspective")

CAPTURING = StageRow(
    "vertex", VERTICES, "vert", "vs_main", inputs=VERTEX.inputs, delivers=("capture",)
)


def three_stages() -> Shader:
    """Each triangle is pushed along by its number, and shaded by what the new stage made."""
    toy = Toy()
    graph = toy.graph
    place = toy.attribute("place", VEC3)
    uv = toy.attribute("uv", VEC2)
    push = toy.parameter("push", FLOAT)
    at_vertex = toy.named("wave", toy.call("sin", VEC3, place))
    # In the middle stage:
    number = graph.node("input", UINT, (), PRIMITIVE)
    turns = toy.call("to_float", FLOAT, number)
    wave = build.cross(graph, at_vertex, INTO_GEOMETRY)
    both = toy.named("both", toy.call("add", VEC3, toy.call("sin", VEC3, wave), wave))
    tilted = toy.call("mul", VEC3, both, toy.call("mul", FLOAT, turns, push))
    clip = toy.named("placed", build.vector(graph, (tilted, build.floating(graph, 1.0))))
    lifted = toy.call(
        "add", VEC2, build.cross(graph, uv, INTO_GEOMETRY), build.swizzle(graph, both, (0, 1))
    )
    middle = toy.named("coordinate", toy.call("cos", VEC2, lifted))
    # In the last one:
    seen = toy.named("seen", toy.call("sin", VEC2, build.cross(graph, middle, OUT_OF_GEOMETRY)))
    color = build.vector(
        graph, (seen, toy.call("mul", VEC2, seen, toy.call("mul", FLOAT, push, push)))
    )
    return toy.shader(
        [
            Result(CLIP_POSITION, GEOMETRY, clip),
            Result(TARGET, FRAGMENT, color, "color", state=RenderTarget("rgba8")),
        ],
        VERTEX, GEOMETRY, FRAGMENT,
    )  # fmt: skip


def captured() -> Shader:
    """A shader that writes the moved vertices and their distances into a buffer."""
    toy = Toy()
    place = toy.attribute("place", VEC3)
    moved = toy.named("moved", toy.call("add", VEC3, place, toy.call("cos", VEC3, place)))
    return toy.shader(
        [
            Result("capture", CAPTURING, moved, "moved"),
            Result("capture", CAPTURING, toy.call("length", FLOAT, place), "distance"),
        ],
        CAPTURING,
    )  # fmt: skip


@pytest.fixture
def between() -> tuple[Shader, Staged]:
    shader = three_stages()
    return shader, stage(shader, Options())


def fields(found: Sequence[Field]) -> list[tuple[str, str, int]]:
    return [(field.name, str(field.type), field.location) for field in found]


def test_the_chain_is_walked_in_pipeline_order(between: tuple[Shader, Staged]) -> None:
    program = between[1].program
    assert [stage.name for stage in program.stages] == ["vertex", "geometry", "fragment"]
    joined = [(face.origin, face.destination) for face in program.interfaces]
    assert joined == [("vertex", "emitted"), ("emitted", "fragment")]


def test_each_stage_has_what_it_reads_and_delivers(between: tuple[Shader, Staged]) -> None:
    vertex, geometry, fragment = between[1].program.stages
    assert fields(vertex.inputs) == [("place", "vec3", 0), ("uv", "vec2", 1)]
    assert fields(vertex.outputs) == fields(geometry.inputs)
    assert fields(geometry.inputs) == [("wave", "vec3", 0), ("uv", "vec2", 1)]
    assert fields(geometry.outputs) == fields(fragment.inputs) == [("coordinate", "vec2", 0)]
    assert fields(fragment.outputs) == [("color", "vec4", 0)]
    assert kinds(vertex) == [VARYING, VARYING]
    assert kinds(geometry) == [CLIP_POSITION, VARYING]
    assert kinds(fragment) == [TARGET]
    assert (vertex.builtin_inputs, geometry.builtin_inputs) == ((), ("primitive_index",))


def kinds(made: Stage) -> list[str]:
    return [output.kind for output in made.results]


def test_each_stage_schedules_its_own_work(between: tuple[Shader, Staged]) -> None:
    names = [[_name(s) for s in made.region.statements] for made in between[1].program.stages]
    assert names == [[], ["both"], ["seen"]]


def _name(statement: object) -> str:
    assert isinstance(statement, Let)
    return statement.name


def test_names_of_varyings_differ_in_the_whole_program() -> None:
    toy = Toy()
    uv = toy.named("uv", toy.attribute("uv", VEC2))
    middle = toy.named("uv", build.cross(toy.graph, uv, INTO_GEOMETRY))
    last = toy.call("sin", VEC2, build.cross(toy.graph, middle, OUT_OF_GEOMETRY))
    color = build.vector(toy.graph, (last, last))
    shader = toy.shader([Result(TARGET, FRAGMENT, color, "color")], VERTEX, GEOMETRY, FRAGMENT)
    program = stage(shader, Options()).program
    assert [varying.field.name for varying in program.varyings] == ["uv_2", "uv"]


def test_it_is_reflected(between: tuple[Shader, Staged]) -> None:
    shader, staged = between
    derived = {value.parameter: value.expression for value in staged.derived}
    found = reflect(shader, staged.program, {}, derived)
    assert read(Reflection, json.loads(json.dumps(to_json(found)))) == found
    assert found.pipeline_inputs == {
        "vertex": (), "geometry": ("primitive_index",), "fragment": ()
    }  # fmt: skip
    joined = [(row.name, row.from_stage, row.to_stage) for row in found.varyings]
    assert joined == [
        ("wave", "vertex", "geometry"),
        ("uv", "vertex", "geometry"),
        ("coordinate", "geometry", "fragment"),
    ]
    stages = {block.name: block.stages for block in found.blocks}
    assert stages == {"Material": ("geometry", "fragment")}


def test_it_is_emitted(between: tuple[Shader, Staged]) -> None:
    """A language that spells the stage's inputs prints it like any other."""
    target, profile = registry.select("glsl:vulkan")
    spelled = PipelineInput(INT, "gl_PrimitiveID")
    target = changed(target, inputs={**target.inputs, PRIMITIVE.name: spelled})
    files = emit(legalise(between[1].program, target, profile)).files
    assert [(file.suffix, file.entries) for file in files] == [
        ("vert.glsl", {"vertex": "main"}),
        ("geom.glsl", {"geometry": "main"}),
        ("frag.glsl", {"fragment": "main"}),
    ]
    vertex, geometry, fragment = (file.text for file in files)
    for name, writer, reader in (
        ("flat {} vec3 v_wave;", vertex, geometry),
        ("flat {} vec2 v_uv;", vertex, geometry),
        ("{} vec2 v_coordinate;", geometry, fragment),
    ):
        assert name.format("out") in writer
        assert name.format("in") in reader
    assert "gl_Position" not in vertex + fragment
    assert "gl_Position" in geometry and "gl_PrimitiveID" in geometry


def test_a_profile_without_the_stage_lacks_it(between: tuple[Shader, Staged]) -> None:
    program = between[1].program
    _, profile = registry.select("glsl:vulkan")
    (lack,) = lacks(program, profile)
    assert lack.feature == "geometry stage"
    assert not list(lacks(program, changed(profile, stages=(VERTEX, GEOMETRY, FRAGMENT))))


def test_it_is_drawn(between: tuple[Shader, Staged]) -> None:
    found = program_picture(*between, everything=False)
    assert [cluster.title for cluster in found.clusters if cluster.is_stage] == [
        "vertex stage",
        "geometry stage",
        "fragment stage",
    ]
    names = {box.key: box.name for box in found.boxes}
    stages = {key: key.split(".")[0] for key in names}
    crossed = [
        (stages[arrow.source], names[arrow.source], stages[arrow.target])
        for arrow in found.arrows
        if arrow.kind is ArrowKind.CROSSING and stages[arrow.source] != "host"
    ]
    assert sorted(crossed) == [
        ("geometry", "coordinate", "fragment"),
        ("vertex", "uv", "geometry"),
        ("vertex", "wave", "geometry"),
    ]
    assert "geometry stage" in written(found)


def test_nothing_may_skip_a_stage() -> None:
    toy = Toy()
    uv = toy.attribute("uv", VEC2)
    skipping = build.cross(toy.graph, uv, Crossing(VERTICES, FRAGMENTS, "flat"))
    with pytest.raises(InvalidGraphError, match="crosses from another domain than emitted"):
        verify([build.cross(toy.graph, skipping, OUT_OF_GEOMETRY)], stage="semantics")
    with pytest.raises(InvalidGraphError, match="made of values per vertex and per emitted"):
        crossed = build.cross(toy.graph, uv, INTO_GEOMETRY)
        verify([toy.call("add", VEC2, uv, crossed)], stage="semantics")


def test_a_value_may_cross_in_two_ways() -> None:
    toy = Toy()
    uv = toy.attribute("uv", VEC2)
    smooth, flat = (build.cross(toy.graph, uv, crossing) for crossing in (SMOOTH, FLAT))
    color = build.vector(toy.graph, (smooth, flat))
    shader = toy.shader([Result(TARGET, FRAGMENT, color, "color")], VERTEX, FRAGMENT)
    program = stage(shader, Options()).program
    slots = [(varying.field.name, varying.field.mode) for varying in program.varyings]
    assert slots == [("uv", "perspective"), ("uv_2", "flat")]
    _, fragment = emit(legalise(program, *registry.select("glsl:vulkan"))).files
    assert "out_color = vec4(v_uv, v_uv_2);" in fragment.text


MISFITS = {
    "made of what another stage has": (
        lambda toy: Result(TARGET, FRAGMENT, toy.attribute("c", VEC4), "c"),
        "no value per fragment",
    ),
    "of a kind that the stage does not deliver": (
        lambda toy: Result(TARGET, VERTEX, toy.attribute("c", VEC4), "c"),
        "a vertex stage does not deliver a target",
    ),
    "of a stage that is not there": (
        lambda toy: Result(TARGET, GEOMETRY, toy.attribute("c", VEC4), "c"),
        "no geometry stage in the chain",
    ),
    "crossing into a stage that is not there": (
        lambda toy: Result(
            TARGET,
            FRAGMENT,
            build.cross(toy.graph, toy.attribute("c", VEC4), INTO_GEOMETRY),
            "c",
        ),
        "no two stages that follow each other are joined so",
    ),
}


@pytest.mark.parametrize(("result", "problem"), MISFITS.values(), ids=MISFITS)
def test_a_result_fits_the_chain(result: Callable[[Toy], Result], problem: str) -> None:
    toy = Toy()
    with pytest.raises(InvalidGraphError, match=problem):
        stage(toy.shader([result(toy)], VERTEX, FRAGMENT), Options())


def test_there_may_be_no_fragments() -> None:
    shader = captured()
    staged = stage(shader, Options())
    (only,) = staged.program.stages
    assert fields(only.outputs) == [("moved", "vec3", 0), ("distance", "float", 1)]
    assert (kinds(only), staged.program.interfaces) == (["capture", "capture"], ())
    derived = {value.parameter: value.expression for value in staged.derived}
    found = reflect(shader, staged.program, {}, derived)
    assert read(Reflection, json.loads(json.dumps(to_json(found)))) == found
    assert (found.targets, found.varyings) == ((), ())
    (cluster,) = program_picture(shader, staged, everything=False).clusters
    assert {box.name for box in cluster.boxes if box.kind is Kind.RESULT} == {"moved", "distance"}


def test_what_is_captured_is_handed_on() -> None:
    target, profile = registry.select("glsl:vulkan")
    program = stage(captured(), Options()).program
    (file,) = emit(legalise(program, target, profile)).files
    assert (file.suffix, file.entries) == ("vert.glsl", {"vertex": "main"})
    assert "layout(location = 0) out vec3 v_moved;" in file.text
    assert "layout(location = 1) out float v_distance;" in file.text
    assert "v_moved = place + cos(place);" in file.text


def test_a_result_that_no_skeleton_writes_is_not_lost_in_silence() -> None:
    toy = Toy()
    row = changed(CAPTURING, delivers=("depth",))
    shader = toy.shader([Result("depth", row, toy.attribute("far", FLOAT))], row)
    program = stage(shader, Options()).program
    with pytest.raises(NotImplementedError, match="no skeleton writes a depth"):
        emit(legalise(program, *registry.select("glsl:vulkan")))
