"""Golden folders: their bounds hold for whatever routes draw, and their inputs are all it takes."""

from __future__ import annotations

import json
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from jsonschema import Draft202012Validator
from numpy.typing import NDArray

import burnish
from burnish.compiler.documents.reading import read
from burnish.compiler.documents.reflection import Reflection
from burnish.compiler.documents.schema import json_schema
from burnish.compiler.reference.bounds.errors import Errors
from burnish.targets.conformance.conform import trials_of
from burnish.targets.conformance.golden.document import Golden
from burnish.targets.conformance.golden.enclosing import Enclosure, enclosed
from burnish.targets.conformance.golden.inputs import Files
from burnish.targets.conformance.golden.names import folder_names
from burnish.targets.conformance.golden.within import judged, only, outputs_of, read_npy
from burnish.targets.conformance.golden.writing import NothingToDrawError, golden_part, whole
from burnish.targets.conformance.trials import ShaderTrial, Trial
from burnish.targets.runner.binding import pipeline
from burnish.targets.runner.codes import compile_one
from burnish.targets.runner.drivers.draws import Draw
from burnish.targets.runner.drivers.texels import Image
from burnish.targets.runner.frames.states import outcomes, states_job
from burnish.targets.runner.routes import select

from .kit import HandWritten, Studio, redrawn

pytestmark = pytest.mark.xdist_group("golden")  # Its processes would all draw the same.

Array = NDArray[Any]

PROMISES = select(["vulkan,opengl,wgpu"])
LAVAPIPE, SWIFTSHADER = select(["lavapipe:glsl,swiftshader:glsl"])
ALSO = ["wgsl:webgpu", "glsl:gl330", "glsl:gl450", "glsl:es310", "hlsl:sm6", "glsl:vulkan"]

SHINY = """
material Shiny {
    param gloss : float in 1..64 = 20
    map albedo : texture2d
    way = normalize(eye - position)
    color = albedo(uv * 2).rgb * pow(max(dot(normalize(normal), way), 0.01), gloss) + uv.x * 0.25
}
"""


def trial_of(source: str) -> ShaderTrial:
    """The trial of the only material of a text."""
    (material,) = burnish.compile(source, ALSO, partial=True).materials
    (trial,) = trials_of([("it", material)], keep=False)
    assert isinstance(trial, ShaderTrial)
    return trial


@cache
def shiny() -> ShaderTrial:
    """The trial of a material with a highlight and a filtered texture."""
    return trial_of(SHINY)


@cache
def bounds_by(names: str, case: str = "stretched") -> Enclosure:
    """What some routes may draw of it."""
    return enclosed(shiny(), case, select([names]), lambda _share: None)


def untold(_share: float) -> None:
    """Progress that nobody sees."""


@pytest.fixture(scope="module")
def golden(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A golden folder of the material."""
    folder = tmp_path_factory.mktemp("golden")
    material = shiny().shaders[0]
    part = golden_part(("it", material), "Shiny", PROMISES, 0)
    for name, content in whole([part], PROMISES, 0).items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)
    return folder


def test_the_hull_has_what_each_route_may_draw() -> None:
    whole = bounds_by("vulkan,opengl,wgpu")
    for name in ("vulkan:glsl", "opengl:es310", "swiftshader:glsl", "lavapipe:hlsl-dxc"):
        part = bounds_by(name)
        assert (whole.undecided | ~part.undecided).all()
        for inner, outer in zip(part.outputs, whole.outputs, strict=True):
            decided = ~whole.undecided
            assert (outer.lower <= inner.lower)[decided].all()
            assert (outer.upper >= inner.upper)[decided].all()


def test_fewer_promises_have_narrower_bounds() -> None:
    def width(names: str) -> float:
        (output,) = bounds_by(names).outputs
        decided = ~bounds_by("vulkan,opengl,wgpu").undecided
        widths: Array = (output.upper - output.lower)[decided]
        return float(np.median(widths[widths > 0]))

    assert width("lavapipe") < 0.8 * width("vulkan,opengl,wgpu")


def test_the_reference_is_within_and_nothing_is_nan() -> None:
    for case in ("defaults", "stretched", "behind", "inside"):
        found = bounds_by("vulkan,opengl,wgpu", case)
        decided = ~found.undecided
        assert 0 < found.undecided.sum() < 0.05 * found.undecided.size
        for output in found.outputs:
            assert not np.isnan(output.lower).any()
            assert not np.isnan(output.upper).any()
            assert (output.lower <= output.upper).all()
            assert ((output.lower <= output.reference) & (output.reference <= output.upper))[
                decided
            ].all()


def test_bounds_of_the_source_count_too() -> None:
    """A port of the source has operations that Burnish's text does without."""
    trial = trial_of("material M { color = vec3((uv.x + 100.3) - 100.1) * (uv.y / 3.0 * 3.0) }")
    (route,) = select(["vulkan:glsl"])
    found = enclosed(trial, "inside", [route], untold)
    for bounds in trial.promised("inside", route):
        errors = Errors(route.platforms)
        assert bounds.errors == errors
        source = trial.bounded("inside", None, bounds).expected
        decided = ~found.undecided
        assert (found.outputs[0].lower <= source.low[0])[decided].all()
        assert (found.outputs[0].upper >= source.high[0])[decided].all()


def test_what_overflows_is_not_compared() -> None:
    trial = trial_of("material M { color = vec3(exp2(uv.x * 200)) }")
    found = enclosed(trial, "behind", PROMISES[:1], untold)
    (output,) = found.outputs
    assert found.undecided[output.reference[..., 0] > 3.5e38].all()
    assert found.undecided.any()
    assert not found.undecided.all()


@pytest.mark.parametrize("route", ["lavapipe:glsl", "swiftshader:glsl", "llvmpipe:gl330"])
def test_what_drivers_draw_is_within(studio: Studio, golden: Path, route: str) -> None:
    """A grid of 4 places and one of 8; corners before and after snapping; rows from below."""
    trial, outputs = shiny(), outputs_of(golden)
    for case, picture in drawn(studio, trial, route).items():
        found = judged(picture, only(outputs, case))
        assert found.is_good, (route, case, found.worst)
        assert found.compared > 3900


def drawn(studio: Studio, trial: Trial, name: str) -> dict[str, Array]:
    """The pictures of a route, by case."""
    (route,) = select([name])
    assert studio.runner.problem(route) is None
    answers = trial.answers(route, studio.runner.device(route), studio.runner, studio.toolchain)
    return {each.case: each.within(each.questions[-1]).got[0] for each in answers}


PLANTED = {
    "another power": ("gloss)", "gloss * 1.02)"),
    "a texture off by half a texel": ("albedo(uv * 2)", "albedo(uv * 2 + 0.5 / 32)"),
    "swapped lanes": (").rgb", ").rbg"),
    "a vector that is too long": ("normalize(normal)", "(normal * 1.01)"),
    "a constant off by a hundredth": ("0.25", "0.2525"),
}


@pytest.mark.parametrize("name", PLANTED)
def test_planted_errors_are_outside(studio: Studio, golden: Path, name: str) -> None:
    right, wrong = PLANTED[name]
    assert right in SHINY
    trial = trial_of(SHINY.replace(right, wrong))
    outputs = outputs_of(golden)
    pictures = drawn(studio, trial, "lavapipe:glsl")
    found = {case: judged(each, only(outputs, case)) for case, each in pictures.items()}
    assert not all(each.is_good for each in found.values())


def test_the_inputs_are_all_that_a_host_needs(studio: Studio, golden: Path) -> None:
    """Draws from the files of the folder, and from nothing that this process knows."""
    document = json.loads((golden / "golden.json").read_text("utf-8"))
    (row,) = (each for each in document["cases"] if each["case"] == "stretched")
    inputs = row["inputs"]
    reflection = read(Reflection, json.loads((golden / inputs["reflection"]).read_bytes()))
    texts = inputs["texts"]["glsl:vulkan"]
    files = [
        HandWritten(
            "It", "glsl", "vulkan", {stage: text["entry"]}, (golden / text["file"]).read_text()
        )
        for stage, text in texts.items()
    ]
    bound = pipeline(reflection, LAVAPIPE, compile_one(LAVAPIPE, files, studio.toolchain))
    (given,) = inputs["draws"]

    def content(path: str) -> bytes:
        return (golden / path).read_bytes()

    draw = Draw(
        row["width"], row["height"], given["vertex_count"],
        tuple(map(content, given["vertices"].values())), content(given["indices"]),
        tuple(map(content, given["blocks"].values())),
        tuple(
            Image(each["format"], each["width"], each["height"],
                  tuple(map(content, each["levels"])), each["dimension"], each["depth"])
            for each in inputs["textures"].values()
        ),
        given["instance_count"], tuple(map(content, inputs["buffers"].values())),
    )  # fmt: skip
    trial = shiny()
    # Of the state, only the size and the clear values count, which the case says as well.
    state = trial.cases()["stretched"]
    assert [list(each) for each in state.clear] == inputs["clear"]
    job = redrawn(states_job(trial.form("stretched"), [state], bound), lambda _draw: draw)
    found = studio.runner.draw_frame(LAVAPIPE, job)
    ((picture,),) = (each.pictures for each in outcomes(job, found, [state]))
    assert judged(picture, only(outputs_of(golden), "stretched")).is_good


def test_the_document_follows_its_schema(golden: Path) -> None:
    document = json.loads((golden / "golden.json").read_text("utf-8"))
    Draft202012Validator(json_schema(Golden)).validate(document)
    assert read(Golden, document).cases[0].inputs.kind == "shader"
    assert document["routes"] == [route.name for route in PROMISES]


def test_files_are_as_promised(golden: Path) -> None:
    case = golden / "Shiny" / "defaults"
    for end in ("lower", "upper", "reference"):
        path = case / f"color.{end}.npy"
        assert path.read_bytes()[:8] == b"\x93NUMPY\x01\x00"
        found = read_npy(path)
        assert (found.dtype, found.shape) == (np.dtype("<f8"), (56, 72, 4))
        assert found.flags.c_contiguous
    undecided = read_npy(case / "undecided.npy")
    assert (undecided.dtype, undecided.shape) == (np.dtype("u1"), (56, 72))
    head = (case / "color.png").read_bytes()[:33]
    assert (head[:8], head[24], head[25]) == (b"\x89PNG\r\n\x1a\n", 16, 2)


def test_names_of_folders_differ_on_every_system() -> None:
    assert folder_names(["a", "A", "a/b", "a:b", "..", "a"], taken=["shader"]) == [
        "a", "A-2", "a-b", "a-b-2", "unnamed", "a-3",
    ]  # fmt: skip
    assert folder_names(["Shader"], taken=["shader"]) == ["Shader-2"]
    assert folder_names(["Con", "nul", "coin"]) == ["Con-2", "nul-2", "coin"]


def test_names_of_kept_files_differ_on_every_system() -> None:
    contents: dict[str, bytes] = {}
    files = Files("F", contents)
    names = [("t.A.bin", b"1"), ("t.a.bin", b"2"), ("t.A.bin", b"1"), ("t.A.bin", b"3")]
    kept = [files.keep(*each) for each in names]
    assert kept == ["F/t.A.bin", "F/t.a-2.bin", "F/t.A.bin", "F/t.A-3.bin"]
    assert contents == {"F/t.A.bin": b"1", "F/t.a-2.bin": b"2", "F/t.A-3.bin": b"3"}


def test_outputs_whose_names_differ_by_case_have_files_of_their_own() -> None:
    text = """
    material M {}
    pass Both : Forward { target Color : rgba8 = vec4(0.25)  target color : rgba8 = vec4(0.75) }
    """
    (shader,) = burnish.compile(text, ALSO, pass_="Both").materials
    part = golden_part(("it", shader), "M", select(["lavapipe:glsl"]), 0)
    assert {row.name for row in part.cases[0].outputs} == {"color", "Color-2"}
    ends = [path.casefold() for path in part.files]
    assert len(set(ends)) == len(ends)


def test_what_no_route_can_express_is_told() -> None:
    (kernel,) = burnish.compile(
        Path(__file__).with_name("kernels.burnish"), ALSO, partial=True
    ).materials[:1]
    with pytest.raises(NothingToDrawError, match="none of the routes can draw it"):
        golden_part(("it", kernel), "K", select(["opengl:gl330"]), 0)
