"""Results of a frame that a shader filters, although many devices cannot filter their format."""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...frozen import frozen
from ..diagnostics.source import Span
from ..ir.frame import Frame, Image, Previous
from ..ir.program import Program
from ..planning.lifetimes import uses_of
from .textures import TextureRows

UNFILTERABLE = frozenset(("r32f", "rg32f", "rgba32f"))
"""WebGPU and OpenGL ES filter them only with an extension."""


@frozen
class Filtered:
    """A texture that a step filters and should not."""

    name: str
    step: str
    format: str
    span: Span


def filtered_in(frame: Frame, programs: Mapping[str, Program]) -> Iterator[Filtered]:
    """All of them; ``programs`` by the names of the frame's shaders."""
    for step in frame.steps:
        for use in uses_of(step):
            shader = use.shader
            rows = TextureRows(shader.shader.resources, programs[shader.name]).textures()
            filters = {row["name"] for row in rows if row["layout"]["sampleType"] == "float"}
            for given in use.given:
                source = given.source.of if isinstance(given.source, Previous) else given.source
                if (
                    isinstance(source, Image)
                    and source.format in UNFILTERABLE
                    and given.name in filters
                ):
                    yield Filtered(given.name, step.name, source.format, step.span)
