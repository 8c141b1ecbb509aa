"""Results of a frame that a shader filters, although many devices cannot filter their format."""

from __future__ import annotations

from collections.abc import Callable, Iterator

from ...support.frozen import frozen
from ..diagnostics.source import Span
from ..ir.frame import Frame, FrameShader, Given, Previous, StepTexture, Use
from ..ir.program import Program
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


def filtered_in(frame: Frame, program_of: Callable[[FrameShader], Program]) -> Iterator[Filtered]:
    """All filtered results of a frame whose format many devices cannot filter.

    Whether a shader filters shows in its program, which is asked for only where it is given such a
    format.
    """
    for step in frame.steps:
        for use in step.uses:
            given = list(_unfilterable(use))
            filters = _filters(use.shader, program_of(use.shader)) if given else frozenset()
            for each, image in given:
                if each.name in filters:
                    yield Filtered(each.name, step.name, image.format, step.span)


def _unfilterable(use: Use) -> Iterator[tuple[Given, StepTexture]]:
    """Yields the inputs of a shader that cannot be filtered."""
    for given in use.given:
        source = given.source.of if isinstance(given.source, Previous) else given.source
        if isinstance(source, StepTexture) and source.format in UNFILTERABLE:
            yield given, source


def _filters(shader: FrameShader, program: Program) -> frozenset[str]:
    """The names of the textures that a shader filters."""
    rows = TextureRows(shader.shader.textures, program).textures()
    return frozenset(row.name for row in rows if row.layout.sample_type == "float")
