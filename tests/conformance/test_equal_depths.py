"""A pass that finds again what another one has drawn: a difference in the last bits is noticed."""

from __future__ import annotations

import burnish
from burnish.api.compiled import CompiledMaterial, OutputFile
from burnish.support.frozen import changed
from burnish.targets.conformance.conform import conform
from burnish.targets.conformance.rows import Row
from burnish.targets.runner.frames.subjects import FrameSubject
from burnish.targets.runner.routes import ROUTES

from ..frames.kit import FOLDER
from .kit import Studio

ROUTE = ROUTES["lavapipe:glsl"]
SIZE = (24, 20)


def judged(frame: FrameSubject, studio: Studio) -> Row:
    (row,) = conform([("frame", frame)], [ROUTE], studio.runner, studio.toolchain, size=SIZE)
    return row


def moved_away(file: OutputFile) -> OutputFile:
    """A text, with positions that are a little farther away if it computes them."""
    if file.stage != "vertex":
        return file
    body = file.text.rstrip().removesuffix("}")
    return changed(file, text=f"{body}    gl_Position.z *= 1.0000002;\n}}\n")


def rounded_otherwise(shader: CompiledMaterial) -> CompiledMaterial:
    """A shader as a device may compute it that does not keep positions invariant."""
    if ".Added." not in shader.name:
        return shader
    return changed(shader, files=tuple(map(moved_away, shader.files)))


def test_a_position_that_another_shader_computes_otherwise_is_noticed(studio: Studio) -> None:
    path = FOLDER / "light_by_light.burnish"
    (frame,) = burnish.compile(path, (ROUTE.profile,)).frames
    assert judged(frame, studio).status == "agrees"
    other = changed(frame, shaders=tuple(map(rounded_otherwise, frame.shaders)))
    assert judged(other, studio).status == "differs"
