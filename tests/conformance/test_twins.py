"""Shaders written by hand, drawn beside Burnish's of the same surface, and held against both.

What the library computes stands on both sides of every other comparison; here it stands on one.
"""

from __future__ import annotations

import math
import re
import struct
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

import burnish
from burnish.api.entry_points import CompiledMaterial
from burnish.compiler.reference.picture import Expected
from burnish.targets.conformance.bounds import bounds_of
from burnish.targets.conformance.compare import compare
from burnish.targets.runner.cameras import looking
from burnish.targets.runner.codes import Codes, compile_one
from burnish.targets.runner.drivers.pipeline import Pipeline, VertexInput
from burnish.targets.runner.drivers.render_state import RenderTarget
from burnish.targets.runner.drivers.slots import BlockSlot, Place
from burnish.targets.runner.exact import Exact, exact_shader
from burnish.targets.runner.frames.states import states_job
from burnish.targets.runner.meshes import Mesh, cube, sphere, torus
from burnish.targets.runner.reference import expected
from burnish.targets.runner.routes import ROUTES, Route
from burnish.targets.runner.scene import Scene
from burnish.targets.runner.scene_state import Color, SceneState, set_up

from ..bench import __file__ as bench
from .kit import PROFILES, HandWritten, Studio, redrawn

FOLDER = Path(bench).parent
SIZE = (72, 56)
UNCOVERED: Color = (-8.0, -8.0, -8.0, -8.0)
BLOCK_SIZE = 368

Floats = NDArray[np.float64]


def texts(profile: str) -> tuple[HandWritten, ...]:
    """The hand-written shaders in the language of a profile."""
    target, _, dialect = profile.partition(":")
    if target == "glsl":
        return tuple(
            HandWritten(
                f"phong.{suffix}.glsl", target, dialect, {stage: "main"}, _glsl(suffix, dialect)
            )
            for stage, suffix in _SUFFIXES.items()
        )
    text = (FOLDER / "twins" / f"phong.{target}").read_text(encoding="utf-8")
    if target == "hlsl":
        entries: dict[str, str] = {"vertex": "vsmain", "fragment": "main"}
        # By Direct3D's rules it lies in the last lane of the matrix, and by Vulkan's behind it.
        text = text.replace(" float p;", "")
    else:
        entries = {"vertex": "vsmain", "fragment": "fsmain"}
    return (HandWritten(f"phong.{target}", target, dialect, entries, text),)


_SUFFIXES: Mapping[str, str] = {"vertex": "vert", "fragment": "frag"}
_PRECISIONS = "precision highp float;\nprecision highp int;"


@dataclass(frozen=True, slots=True)
class Dialect:
    """The differences of an OpenGL's GLSL from that of Vulkan."""

    header: str
    by_name: bool = False
    """True if blocks and varyings have names only, and no numbers."""
    clip_control: tuple[str, ...] = ()


_DIALECTS: Mapping[str, Dialect] = {
    "gl330": Dialect("#version 330 core", by_name=True),
    "gl450": Dialect("#version 450 core", clip_control=("GL_UPPER_LEFT", "GL_ZERO_TO_ONE")),
    "es300": Dialect(f"#version 300 es\n{_PRECISIONS}", by_name=True),
    "es310": Dialect(f"#version 310 es\n{_PRECISIONS}"),
}


def _glsl(suffix: str, name: str) -> str:
    """The GLSL for Vulkan, or by some words of OpenGL's."""
    text = (FOLDER / "twins" / f"phong.{suffix}.glsl").read_text(encoding="utf-8")
    if name == "vulkan":
        return text
    dialect = _DIALECTS[name]
    text = text.replace("#version 450", dialect.header).replace(",set=0", "")
    if dialect.by_name:
        varying = "out" if suffix == "vert" else "in"
        text = re.sub(rf"layout\(location=\d\) {varying}", varying, text)
        text = text.replace(",binding=0", "")
    if dialect.clip_control:
        return text
    in_gl = r"\1 gl_Position.z = 2.0*gl_Position.z-gl_Position.w;"
    return re.sub(r"(gl_Position=.*;)", in_gl, text)


# --- the scene, in numbers -----------------------------------------------------------------------

STRETCHED = ((1.1, -0.5, 0.0, 0.1), (0.6, 0.5, 0.1, -0.1), (0.0, 0.2, 0.8, 0.2), (0, 0, 0, 1))

SCENES: Mapping[str, tuple[Mesh, Scene]] = {
    "sphere": (sphere(32, 16), Scene()),
    "stretched torus": (
        torus(24, 16), Scene(looking(eye=(-0.7, 1.1, 2.6)), object_to_world=STRETCHED)
    ),
    "inside": (
        cube(),
        Scene(looking(eye=(0.35, -0.2, 0.4), look_at=(-0.5, 0.1, -0.6), fov=math.radians(75))),
    ),
}  # fmt: skip

VALUES: Mapping[str, Any] = {
    "ka": (0.5, 0.3, 0.2),
    "kd": (0.7, 0.4, 0.25),
    "ks": (0.3, 0.6, 0.9),
    "power": 17.0,
    "ambient_light": (0.2, 0.15, 0.1),
    "sun.direction": (0.48, -0.8, 0.36),
    "sun.diffuse_color": (0.8, 0.7, 0.6),
    "lamp.place": (0.5, 0.4, 0.9),
    "lamp.diffuse_color": (0.2, 0.5, 0.4),
    "torch.place": (-0.9, 1.2, 1.6),
    "torch.axis": (0.36, -0.48, -0.8),
    "torch.inner": math.radians(12),
    "torch.outer": math.radians(31),
    "torch.diffuse_color": (0.9, 0.2, 0.8),
}


def block(scene: Scene) -> bytes:
    """The hand-written block, filled by hand: columns and rows of 16 bytes."""
    world = np.array(scene.object_to_world)
    inner, outer = VALUES["torch.inner"], VALUES["torch.outer"]
    normal_matrix = np.linalg.inv(world[:3, :3]).T
    rows: list[Any] = [
        *world.T,
        *scene.camera.world_to_clip(SIZE[0] / SIZE[1]).T,
        *((*column, 0) for column in normal_matrix.T),
        (*scene.camera.eye, 0),
        (*VALUES["ka"], 0),
        (*VALUES["kd"], 0),
        (*VALUES["ks"], VALUES["power"]),
        (*VALUES["ambient_light"], 0),
        (*VALUES["sun.direction"], 0),
        (*VALUES["sun.diffuse_color"], 0),
        (*VALUES["lamp.place"], 0),
        (*VALUES["lamp.diffuse_color"], 0),
        (*VALUES["torch.place"], math.cos(outer)),
        (*VALUES["torch.axis"], 1 / (math.cos(inner) - math.cos(outer))),
        (*VALUES["torch.diffuse_color"], 0),
    ]
    return b"".join(struct.pack("<4f", *row) for row in rows)


# --- drawing -------------------------------------------------------------------------------------


@cache
def material(error: str = "") -> CompiledMaterial:
    """Burnish's, with a line more."""
    source = (FOLDER / "surface.burnish").read_text(encoding="utf-8")
    source = source.replace("    color = ", f"    {error}\n    color = ")
    (made,) = burnish.compile(source, PROFILES).materials
    return made


def state(scene: str, error: str = "") -> SceneState:
    """The scene that Burnish's shader draws."""
    mesh, placed = SCENES[scene]
    taken = set_up(material(error).instance(), mesh, placed, SIZE, UNCOVERED)
    for name, value in VALUES.items():
        taken.instance.set(name, value)
    return taken


def by_hand(route: Route, codes: Codes) -> Pipeline:
    """The hand-written shaders' own pipeline."""
    dialect = _DIALECTS.get(route.profile.removeprefix("glsl:"))
    by_name = dialect is not None and dialect.by_name
    place = Place("P", None, None) if by_name else Place("P", 0, 0)
    return Pipeline(
        codes.stages,
        inputs=(VertexInput("aPos", 0, "float32x3"), VertexInput("aNrm", 1, "float32x3")),
        blocks=(BlockSlot(place, BLOCK_SIZE),),
        textures=(),
        targets=(RenderTarget("rgba32float"),),
        first_row="bottom" if route.bottom_up else "top",
        clip_control=dialect.clip_control if dialect else (),
    )


def drawn_by_burnish(studio: Studio, route: Route, taken: SceneState) -> Floats:
    assert studio.runner.problem(route) is None
    return studio.draw(route.name, material(), taken)[0]


def drawn_by_hand(studio: Studio, route: Route, scene: str) -> Floats:
    taken = state(scene)
    codes = compile_one(route, texts(route.profile), studio.toolchain)
    vertices = tuple(
        taken.attributes[name].astype("<f4").tobytes()
        for name in ("vertex_position", "vertex_normal")
    )
    job = redrawn(
        states_job(Exact.of(material()), [taken], by_hand(route, codes)),
        lambda draw: replace(draw, vertices=vertices, blocks=(block(SCENES[scene][1]),)),
    )
    assert studio.runner.problem(route) is None
    ((picture,),) = studio.pictures(route, job, [taken])
    return picture


def drawn_by_reference(
    studio: Studio, route: Route, taken: SceneState, error: str = ""
) -> Expected:
    bounds = bounds_of(taken, route, studio.runner.device(route))[0]
    program = exact_shader(material(error).shader)
    return expected(program, taken, bounds.rules, bounds.errors)


def agree(got: Floats, wanted: Expected) -> bool:
    steps = [np.ones_like(got)]
    return compare((got,), wanted, wanted.targets, steps, "measured").agrees


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize("name", ROUTES)
def test_twins_agree(studio: Studio, name: str, scene: str) -> None:
    route, taken = ROUTES[name], state(scene)
    ours, theirs = drawn_by_burnish(studio, route, taken), drawn_by_hand(studio, route, scene)
    wanted = drawn_by_reference(studio, route, taken)
    colours = wanted.targets[0][wanted.covered][:, :3]
    assert (np.ptp(colours, axis=0) > 0.1).all()
    assert agree(ours, wanted)
    assert agree(theirs, wanted)


@pytest.mark.parametrize(
    "error",
    [
        "normal = normalize(@vertex (object_to_world * vec4(vertex_normal, 0)).xyz)",
        "normal = -inherited.normal",
        "to_eye = normalize(position - eye)",
        "position = inherited.position + 0.01 * inherited.normal",
        "clip_position = view_projection * vec4(position.xzy, 1)",
    ],
)
def test_an_error_in_the_library_shows(studio: Studio, error: str) -> None:
    route = ROUTES["lavapipe:glsl"]
    theirs = drawn_by_hand(studio, route, "stretched torus")
    wanted = drawn_by_reference(studio, route, state("stretched torus", error), error)
    assert not wanted.undecided.all() and not agree(theirs, wanted)
