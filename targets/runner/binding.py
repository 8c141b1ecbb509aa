"""Makes a driver's pipeline from a reflection: formats, bindings and names for one route.

``render`` and ``conform`` call ``pipeline`` before they send jobs to the driver.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import replace
from typing import cast

from ...compiler.documents.backends import BackendRow, BindingRow, BlockBindingRow
from ...compiler.documents.drawing import (
    DrawRow,
    LayersRow,
    SamplerState,
    TargetRow,
    TextureRow,
    VertexInputRow,
)
from ...compiler.documents.reflection import Reflection
from ...compiler.documents.values import BlockRow
from ...compiler.ir.formats import TARGET_WORDS
from ...compiler.ir.render_state import WINDING_WORDS
from ...compiler.ir.stages import EVALUATION
from .codes import Codes
from .drivers.pipeline import CapturedOutput, Pipeline, StreamOutput
from .drivers.pipeline import VertexInput as Input
from .drivers.render_state import ALL_LANES, RenderTarget, TargetFormat
from .drivers.slots import BlockSlot, BufferSlot, ImageSlot, Place, TextureSlot
from .loose_uniforms import uniforms_of
from .routes import EVERY_DRIVER, Route

_IN_ITS_PLACE: Mapping[str, TargetFormat] = {
    # The order of lanes in memory is not visible.
    "bgra8unorm": "rgba8unorm",
    "bgra8unorm-srgb": "rgba8unorm-srgb",
    # Not all drivers can draw to ten bits a lane; eight bits are clamped and blended in the same
    # way.
    "rgb10a2unorm": "rgba8unorm",
}
"""The format to draw to in place of one that some driver lacks."""
FORMATS: Mapping[str, TargetFormat] = {
    name: _IN_ITS_PLACE.get(word) or cast(TargetFormat, word) for name, word in TARGET_WORDS.items()
}
"""The format to draw to for each target format of the language."""


def pipeline(reflection: Reflection, route: Route, codes: Codes) -> Pipeline:
    """The pipeline of one material on one route.

    Inputs, blocks, textures and targets are in the order of the reflection; a texture that no stage
    reads has no slot. Raises ``KeyError`` if the reflection lacks the route's profile.
    """
    backend = reflection.backends[route.profile]
    images, state = backend.images, reflection.render_state
    return Pipeline(
        stages=codes.stages,
        inputs=tuple(
            _input(row, backend) for row in reflection.vertex_inputs if row.buffer is None
        ),
        blocks=tuple(_block(row, backend) for row in reflection.blocks),
        textures=_textures(reflection, backend),
        buffers=tuple(_buffers(reflection, backend)),
        images=tuple(
            ImageSlot(_place(images[row.name]), FORMATS[row.format])
            for row in reflection.targets
            if images
        ),
        targets=tuple(
            RenderTarget(FORMATS[row.format], row.blend, row.mask)
            for row in reflection.targets
            if not images
        ),
        layers=_layers(reflection.draw.layers),
        view_mask=_view_mask(reflection.draw.layers),
        primitive=reflection.draw.topology,
        patch_points=reflection.draw.corners if _divided_natively(reflection.draw) else 0,
        cull=state.cull,
        fill=state.fill,
        samples=state.samples,
        alpha_to_coverage=state.alpha_to_coverage,
        depth=state.depth,
        stencil=state.stencil,
        flip_y=backend.flip_y,
        # Vulkan's viewport makes every picture upright, also that of a text for another API.
        front_face=WINDING_WORDS[state.front] if _is_upright(route) else backend.front_face,
        first_row="top" if _is_upright(route) else backend.first_row,
        host_uniforms=tuple(backend.host_uniforms),
        clip_control=tuple(backend.clip_control),
        stream_output=_stream_output(reflection, backend),
    )


def _is_upright(route: Route) -> bool:
    """True for routes that draw every picture upright, whatever API its text is for."""
    return EVERY_DRIVER[route.driver].module == "vulkan"


def _buffers(reflection: Reflection, backend: BackendRow) -> Iterator[BufferSlot]:
    """The buffers that some stage reads, and those that a kernel writes."""
    for read in reflection.buffers:
        if read.stages:
            yield BufferSlot(_place(backend.buffers[read.name]), read.stride)
    for result in reflection.results:
        yield BufferSlot(_place(backend.buffers[result.name]), result.stride, written=True)


def _stream_output(reflection: Reflection, backend: BackendRow) -> StreamOutput | None:
    """The stream output that captures vertices; ``None`` if nothing, or a kernel, captures."""
    captured, names = reflection.capture, backend.captures
    if captured is None or not names:
        return None
    return StreamOutput(
        outputs=tuple(
            CapturedOutput(names[row.name].identifier, location, row.offset)
            for location, row in enumerate(captured.members)
        ),
        stride=captured.stride,
        primitive=captured.topology,
        in_text=backend.stream_output == "text",
    )


def _divided_natively(draw: DrawRow) -> bool:
    return draw.tessellation is not None and draw.tessellation.divided_by == EVALUATION.name


def _layers(row: LayersRow | None) -> int:
    """The number of layers of a single draw; 0 if there are none, or a draw for each."""
    return 0 if row is None or row.parameter is not None else row.count


def _view_mask(row: LayersRow | None) -> int:
    """The views that a single draw reaches, a bit for each; 0 if there are none."""
    return 0 if row is None or row.view_mask is None else row.view_mask


def shows_less(reflection: Reflection) -> bool:
    """True if targets show something else than the numbers that shaders write.

    Blending and masks mix these numbers with the old contents, and several samples with each other,
    where targets are drawn to as the pass declares them.
    """
    joined = reflection.render_state.samples > 1
    return joined or any(map(keeps_something, reflection.targets))


def keeps_something(row: TargetRow) -> bool:
    """True if drawing to a target keeps some of its old contents: by blending, or by a mask."""
    return row.blend is not None or row.mask != ALL_LANES


def _input(row: VertexInputRow, backend: BackendRow) -> Input:
    assert row.location is not None and row.format is not None, "it is in no buffer"
    identifier = backend.vertex_inputs[row.name].identifier
    return Input(identifier, row.location, row.format, row.step)


def _block(row: BlockRow, backend: BackendRow) -> BlockSlot:
    """A block; if it has no name in the text, loose uniforms."""
    binding, pushed = backend.blocks[row.name], backend.push_constants
    loose = () if binding.identifier else tuple(uniforms_of(row, binding))
    is_pushed = pushed is not None and pushed.block == row.name
    return BlockSlot(_place(binding), row.size, loose, is_pushed)


def _place(row: BindingRow | BlockBindingRow) -> Place:
    return Place(row.identifier, row.group, row.binding)


def _textures(reflection: Reflection, backend: BackendRow) -> tuple[TextureSlot, ...]:
    states = {row.texture: row.state for row in reflection.samplers}
    entries = (entry for layout in backend.layouts for entry in layout.entries)
    combined = {entry.name for entry in entries if entry.kind == "combined"}
    return tuple(
        replace(_texture(row, backend, states.get(row.name)), combined=row.name in combined)
        for row in reflection.textures
        if row.stages
    )


def _texture(row: TextureRow, backend: BackendRow, state: SamplerState | None) -> TextureSlot:
    sampler = backend.samplers.get(row.name)
    slot = TextureSlot(
        texture=_place(backend.textures[row.name]),
        sampler=None if sampler is None else _place(sampler),
        dimension=row.dimension,
        sample=row.layout.sample_type,
        sampling=row.layout.sampler,
    )
    if state is None:
        return slot
    return replace(
        slot, filter=state.filter, mip=state.mip, wrap=state.wrap, wrap_u=state.wrap_u,
        wrap_v=state.wrap_v, wrap_w=state.wrap_w, border=state.border, compare=state.compare,
    )  # fmt: skip
