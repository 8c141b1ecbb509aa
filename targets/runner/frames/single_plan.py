"""The plan of a single material: one step that draws it, or runs it.

``single.py`` makes a frame of it.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Literal

from ....compiler.documents.plan import (
    AttachmentRow,
    BarrierRow,
    BufferBarrierRow,
    BufferState,
    BufferUse,
    DrawnRow,
    DrawStep,
    FramePlan,
    FrameResultRow,
    FrameTextureRow,
    ModelsRow,
    OutputRow,
    PlaceRow,
    ResolveRow,
    RunStep,
    ShaderRow,
    SizeRow,
    StencilLoad,
    TextureState,
    TextureUse,
    UseRow,
    ValueRow,
    WaitingRow,
    WrittenBuffer,
    WrittenImage,
)
from ....compiler.documents.reflection import Reflection
from ....compiler.documents.steps import ComposedStep, ConstantStep, ParameterStep, StepRow
from ....compiler.documents.values import LayoutRow, ParameterRow
from ....compiler.reflection.plan import VERSION
from ....support.frozen import changed
from ..kernels import DEPTHS
from ..scene import declared_as
from ..scene_state import CLEAR, Color
from .scenery import WHOLE

STEP = "shown"
"""The name of the step."""
SIZE = f"{STEP}.size"
"""The parameter with the size of the picture. A material may have a ``size`` of its own."""

_DEPTH = "depth buffer"
"""The name of the depth attachment beside targets, which none of them can have."""
_PLACE = PlaceRow(file="", line=1, column=1, length=0)
"""The place of all rows: nobody has written the plan."""


def single_plan(
    reflection: Reflection, background: Color, blend_constant: Color = CLEAR
) -> FramePlan:
    """The plan that shows a material, or a kernel.

    Its only shader is called like the material. ``background`` is the clear value of all targets
    for which the pass has none, and ``blend_constant`` the colour of the blend factor ``constant``.
    """
    return _Planning(reflection, background, blend_constant).plan()


class _Planning:
    """A plan that is being made: its values, textures, results and outputs so far."""

    def __init__(self, reflection: Reflection, background: Color, blend_constant: Color) -> None:
        self._material = reflection.material
        self._reflection = reflection
        self._background = background
        self._blend_constant = blend_constant
        self._is_kernel = reflection.extent is not None
        self._values = [_size_value()]
        self._textures: list[FrameTextureRow] = []
        self._results: list[FrameResultRow] = []
        self._outputs: list[OutputRow] = []

    def plan(self) -> FramePlan:
        """The whole plan."""
        reflection = self._reflection
        parameters = (_size_row(), *_parameters_of_lights(reflection))
        self._add_outputs()
        step = self._run() if self._is_kernel else self._draw()
        use: TextureUse = "image" if self._is_kernel else "target"
        if self._shows_depths:
            use = "depth"
        pictures = [row.texture for row in self._outputs if row.texture is not None]
        end = WaitingRow(
            barriers=tuple(_barrier(texture, use, "sampled") for texture in pictures),
            buffer_barriers=tuple(self._waits_for_buffers("written", "read")),
        )
        models = ModelsRow(name=WHOLE, materials=(self._material,), doc="", source=_PLACE)
        return FramePlan(
            plan=VERSION,
            frame=self._material,
            doc=reflection.doc,
            source=_PLACE,
            rig=reflection.rig,
            parameters=parameters,
            lights=tuple(reflection.lights),
            host_textures=(),
            host_buffers=(),
            sources={row.name: _PLACE for row in parameters},
            models=() if self._is_kernel else (models,),
            shaders=(
                ShaderRow(
                    name=self._material,
                    reflection=f"{self._material}.json",
                    pass_=reflection.pass_ or None,
                    rig=reflection.rig or None,
                ),
            ),
            values=tuple(self._values),
            textures=tuple(self._textures),
            results=tuple(self._results),
            steps=(step,),
            end=end,
            kept=(),
            outputs=tuple(self._outputs),
        )

    # --- outputs ---------------------------------------------------------------------------------

    def _add_outputs(self) -> None:
        """Add an output for each render target or image, and for each buffer that is written."""
        use: TextureUse = "image" if self._is_kernel else "target"
        for number, target in enumerate(self._reflection.targets):
            self._textures.append(self._texture(target.name, target.format, use))
            self._add_output(target.name, target.doc, number)
        if self._shows_depths:
            name, _ = DEPTHS
            self._textures.append(self._texture(name, self._depth_format, "depth"))
            self._add_output(name, "", 0)
        for buffer in self._reflection.results:
            self._add_output(buffer.name, buffer.doc, None)

    @property
    def _shows_depths(self) -> bool:
        """True if the picture are the depths: that of a pass without targets."""
        return not (self._reflection.targets or self._reflection.results)

    @property
    def _depth_format(self) -> str:
        has_stencil = self._reflection.render_state.stencil is not None
        return "depth32f_stencil8" if has_stencil else "depth32f"

    def _texture(self, name: str, format_: str, use: TextureUse) -> FrameTextureRow:
        """A texture that becomes an output."""
        layers = self._reflection.draw.layers
        return FrameTextureRow(
            format=format_,
            dimension="2d" if layers is None else "2d_array",
            size=SizeRow(
                value=None if self._is_kernel else 0,
                extent_of=STEP if self._is_kernel else None,
                level=0,
            ),
            layers=1 if layers is None else layers.count,
            levels=1,
            samples=1,
            uses=(use, "sampled"),
            kept=False,
            results=(_result(name),),
        )

    def _add_output(self, name: str, doc: str, texture: int | None) -> None:
        self._add_result(_result(name), texture, doc)
        self._outputs.append(
            OutputRow(name=name, result=_result(name), texture=texture, doc=doc, source=_PLACE)
        )

    def _add_result(self, result: str, texture: int | None, doc: str = "") -> None:
        kind: Literal["texture", "buffer"] = "texture"
        if result not in {name for row in self._textures for name in row.results}:
            kind = "buffer"
        self._results.append(
            FrameResultRow(
                name=result, kind=kind, texture=texture, first=0, last=0, doc=doc, source=_PLACE
            )
        )

    def _constant(self, lanes: Sequence[float]) -> int:
        """The number of a new value of the plan."""
        steps: list[StepRow] = [
            ConstantStep(op="constant", type="float", value=float(lane), args=()) for lane in lanes
        ]
        if len(lanes) > 1:
            parts = tuple(range(len(lanes)))
            steps.append(ComposedStep(op="vector", type=f"vec{len(lanes)}", args=parts))
        self._values.append(ValueRow(representation=steps[-1].type, steps=tuple(steps)))
        return len(self._values) - 1

    # --- the step --------------------------------------------------------------------------------

    def _draw(self) -> DrawStep:
        targets = [self._target(number) for number in range(len(self._reflection.targets))]
        depth = self._depth()
        barriers = [
            _barrier(place.texture, "undefined", "target")
            for target in targets
            for place in target.places
        ]
        if depth is not None:
            barriers.append(_barrier(depth.texture, "undefined", "depth"))
        constant = self._constant(self._blend_constant) if any(self._blend_constant) else None
        use = UseRow(material=self._material, shader=0, inputs=())
        drawn = DrawnRow(models=WHOLE, vertices=None, light=None, uses=(use,))
        return DrawStep(
            kind="draw",
            name=STEP,
            pass_=self._reflection.pass_,
            only_first=False,
            barriers=tuple(barriers),
            buffer_barriers=(),
            targets=tuple(targets),
            depth=depth,
            viewport=None,
            scissor=None,
            blend_constant=constant,
            draws=(drawn,),
            source=_PLACE,
            continues=False,
        )

    def _target(self, number: int) -> AttachmentRow:
        """The attachment of a target: its texture, or a multisampled one that is resolved to it."""
        target, samples = self._reflection.targets[number], self._reflection.render_state.samples
        clear = target.clear
        if clear is None and any(self._background):
            clear = self._background
        value = None if clear is None else self._constant(clear)
        if samples == 1:
            return self._attachment(target.name, number, value, store=True)
        texture = self._add_texture(
            changed(self._textures[number], samples=samples, uses=("target",))
        )
        resolve = ResolveRow(texture=number, layer=0, level=0)
        return self._attachment(target.name, texture, value, store=False, resolve=resolve)

    def _depth(self) -> AttachmentRow | None:
        """The depth attachment, with stencil values, if the pass uses any."""
        state = self._reflection.render_state
        has_stencil = state.stencil is not None
        if not state.depth.is_used and not has_stencil:
            return None
        clear = self._constant([state.depth.clear])
        stencil = StencilLoad(load="clear", store=False, clear=0) if has_stencil else None
        if self._shows_depths:
            return self._attachment(DEPTHS[0], 0, clear, store=True, stencil=stencil)
        result = _result(_DEPTH)
        texture = self._add_texture(
            changed(
                self._textures[0],
                format=self._depth_format,
                samples=state.samples,
                uses=("depth",),
                results=(result,),
            )
        )
        self._add_result(result, texture if state.samples == 1 else None)
        return self._attachment(_DEPTH, texture, clear, store=False, stencil=stencil)

    def _add_texture(self, row: FrameTextureRow) -> int:
        self._textures.append(row)
        return len(self._textures) - 1

    def _attachment(
        self,
        name: str,
        texture: int,
        clear: int | None,
        *,
        store: bool,
        resolve: ResolveRow | None = None,
        stencil: StencilLoad | None = None,
    ) -> AttachmentRow:
        return AttachmentRow(
            name=name,
            result=_result(name),
            texture=texture,
            layer=0 if self._reflection.draw.layers is None else None,
            level=0,
            load="clear",
            clear=clear,
            store=store,
            resolve=resolve,
            over=None,
            stencil=stencil,
        )

    def _run(self) -> RunStep:
        images = tuple(
            WrittenImage(name=row.name, result=row.result, texture=row.texture)
            for row in self._outputs
            if row.texture is not None
        )
        return RunStep(
            kind="run",
            name=STEP,
            only_first=False,
            use=UseRow(material=None, shader=0, inputs=()),
            barriers=tuple(_barrier(image.texture, "undefined", "image") for image in images),
            buffer_barriers=tuple(self._waits_for_buffers("undefined", "written")),
            images=images,
            buffers=tuple(
                WrittenBuffer(name=row.name, result=row.result)
                for row in self._outputs
                if row.texture is None
            ),
            source=_PLACE,
        )

    def _waits_for_buffers(
        self, before: BufferState, after: BufferUse
    ) -> Iterator[BufferBarrierRow]:
        for row in self._outputs:
            if row.texture is None:
                yield BufferBarrierRow(
                    result=row.result, before=before, after=after, only_first=False
                )


def _result(name: str) -> str:
    return f"{STEP}.{name}"


def _barrier(texture: int, before: TextureState, after: TextureUse) -> BarrierRow:
    return BarrierRow(texture=texture, before=before, after=after, only_first=False)


# --- values that the host sets -------------------------------------------------------------------


def _size_row() -> ParameterRow:
    return ParameterRow(
        name=SIZE,
        type="ivec2",
        representation="ivec2",
        range=(1.0, 16384.0),
        default=(512, 512),
        doc="The size of the picture, in pixels",
        library=declared_as("size"),
        role="size",
        group="frame",
        block=None,
        offset=None,
        size=8,
        layout=LayoutRow(stored="ivec2", kind="int", lanes=2),
        members=(),
        count=None,
    )


def _size_value() -> ValueRow:
    step = ParameterStep(op="parameter", type="ivec2", parameter=SIZE, args=())
    return ValueRow(representation="ivec2", steps=(step,))


def _parameters_of_lights(reflection: Reflection) -> list[ParameterRow]:
    """The parameters of the lights, which a frame sets for all its shaders."""
    names = {
        name
        for light in reflection.lights
        for name in (*light.parameters, *filter(None, [light.count]))
    }
    return [
        changed(row, block=None, offset=None) for row in reflection.parameters if row.name in names
    ]
