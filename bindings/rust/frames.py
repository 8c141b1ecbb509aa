"""The tables of frames in Rust, and the statements of the functions that draw them."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator

from ...compiler.documents.writing import to_json
from ..fields import Field, Numbers
from ..frames.model import (
    Attachment,
    Copy,
    Dispatch,
    Drawn,
    Frame,
    FrameBuffer,
    FrameTexture,
    Give,
    Pass,
    Read,
    Resource,
    Step,
    Use,
)
from ..frames.printing import FramePrinter
from ..writing import blocks_of


class FrameDrawing(FramePrinter):
    """Prints the tables of a frame, and the statements that draw it."""

    # -- tables ------------------------------------------------------------------------------------

    def texture(self, texture: FrameTexture) -> str:
        """What a host needs to know to make a texture."""
        row = to_json(texture.row)
        uses = ", ".join(map(json.dumps, row["uses"]))
        words = ", ".join(f"{name}: {json.dumps(row[name])}" for name in ("format", "dimension"))
        counts = ", ".join(f"{name}: {row[name]}" for name in ("layers", "levels", "samples"))
        return (
            f"FrameTexture {{ name: {json.dumps(texture.name)}, {words}, {counts}, "
            f"uses: &[{uses}], kept: {json.dumps(row['kept'])} }}"
        )

    def initial(self, buffer: FrameBuffer) -> str:
        """What a buffer is set to, as 32 bits."""
        return "None" if buffer.initial is None else f"Some({buffer.initial & 0xFFFFFFFF})"

    def numbered(self, kind: str, number: int) -> str:
        """A texture or a buffer of the frame."""
        return f"Resource::{kind.capitalize()}({number})"

    # -- statements --------------------------------------------------------------------------------

    def lines(self, frame: Frame) -> Iterator[str]:
        """The statements behind ``begin``."""
        for step in frame.steps:
            if step.row.only_first:
                yield f"if {self._is_first} {{"
                yield from _indented(self._step(step))
                yield "}"
            else:
                yield from self._step(step)

    def first(self, frame: Frame) -> str:
        """The beginning of the statement that calls ``begin``, whose result may not matter."""
        return f"{self._is_first} = !" if frame.asks_for_first else "_ = "

    def sizes(self, frame: Frame) -> str:
        """The sizes of all textures."""
        return ", ".join(self._whole(each.size) for each in frame.textures)

    def counts(self, frame: Frame) -> str:
        """The numbers of elements of all buffers."""
        return ", ".join(f"{self._number(each.count)} as usize" for each in frame.buffers)

    def _whole(self, field: Field) -> str:
        """Lanes that are not negative."""
        return f"{self._number(field)}.map(|side| side as u32)"

    def _step(self, step: Step) -> Iterator[str]:
        match step:
            case Pass():
                yield from self._pass(step)
            case Dispatch():
                yield from self._dispatch(step)
            case Copy():
                yield f"host.copy({step.source.number}, {step.target.number})?;"

    # -- passes ------------------------------------------------------------------------------------

    def _pass(self, step: Pass) -> Iterator[str]:
        if step.layers == 1:
            yield from self._drawn_pass(step)
            return
        yield f"for {self._layer} in 0..{step.layers} {{"
        yield from _indented(self._drawn_pass(step))
        yield "}"

    def _drawn_pass(self, step: Pass) -> Iterator[str]:
        yield "host.begin_pass(&Pass {"
        yield from _indented(self._state(step))
        yield "})?;"
        for drawn in step.draws:
            yield from self._draws(drawn)
        yield "host.end_pass()?;"

    def _state(self, step: Pass) -> Iterator[str]:
        yield f"name: {json.dumps(step.row.name)},"
        yield f"continues: {json.dumps(step.row.continues)},"
        targets = ", ".join(self._attachment(step, target) for target in step.targets)
        yield f"targets: &[{targets}],"
        depth = "None" if step.depth is None else f"Some({self._attachment(step, step.depth)})"
        yield f"depth: {depth},"
        settings = {
            "viewport": (step.viewport, "f32"), "scissor": (step.scissor, "u32"),
            "blend_constant": (step.blend_constant, "f32"),
        }  # fmt: skip
        for name, (field, kind) in settings.items():
            yield f"{name}: {'None' if field is None else f'Some({self._lanes(field, kind)})'},"

    def _lanes(self, field: Field, kind: str) -> str:
        assert isinstance(field.type, Numbers)
        is_float = field.type.kind == "float"
        same = is_float if kind == "f32" else field.type.kind == "uint"
        return self._number(field) + ("" if same else f".map(|lane| lane as {kind})")

    def _attachment(self, step: Pass, target: Attachment) -> str:
        row = target.row
        layer = f"Some({self._layer})" if step.layers > 1 else _option(row.layer)
        stencil = "None"
        if row.stencil is not None:
            clears = row.stencil.load == "clear"
            stencil = (
                f"Some(StencilLoad {{ clear: {_option(row.stencil.clear if clears else None)}, "
                f"store: {json.dumps(row.stencil.store)} }})"
            )
        resolve = "None"
        if row.resolve is not None:
            place = _place(row.resolve.texture, _option(row.resolve.layer), row.resolve.level)
            resolve = f"Some({place})"
        clear = f"Some({self._clear(target)})" if row.load == "clear" else "None"
        return (
            f"Attachment {{ name: {json.dumps(row.name)}, "
            f"place: {_place(target.texture.number, layer, row.level)}, clear: {clear}, "
            f"store: {json.dumps(row.store)}, resolve: {resolve}, stencil: {stencil} }}"
        )

    def _clear(self, target: Attachment) -> str:
        is_depth = target.texture.row.format.startswith("depth")
        if target.clear is None:
            return "[1.0, 0.0, 0.0, 0.0]" if is_depth else "[0.0; 4]"
        number = self._number(target.clear)
        return f"[{number}, 0.0, 0.0, 0.0]" if is_depth else number

    def _draws(self, drawn: Drawn) -> Iterator[str]:
        if drawn.light is None:
            yield from self._calls(drawn)
            return
        count = self._count(drawn.light)
        yield f"for {self._light} in 0..{count} {{"
        yield from _indented(self._calls(drawn))
        yield "}"

    def _calls(self, drawn: Drawn) -> Iterator[str]:
        if drawn.models is None:
            (use,) = drawn.uses
            assert drawn.vertices is not None
            yield "host.fill("
            yield from _indented(self._use(use, "&"))
            yield f"    {self._number(drawn.vertices)} as u32,"
            yield ")?;"
            return
        yield f"host.draw_models({json.dumps(drawn.models)}, &["
        for use in drawn.uses:
            yield from _indented(self._use(use, ""))
        yield "])?;"

    # -- kernels -----------------------------------------------------------------------------------

    def _dispatch(self, step: Dispatch) -> Iterator[str]:
        yield "host.dispatch("
        yield from _indented(self._use(step.use, "&"))
        yield f"    {self._whole(step.groups)},"
        for rows in (step.images, step.buffers):
            pairs = ", ".join(f"({json.dumps(name)}, {each.number})" for name, each in rows)
            yield f"    &[{pairs}],"
        yield ")?;"

    # -- uses --------------------------------------------------------------------------------------

    def _use(self, use: Use, reference: str) -> Iterator[str]:
        material = "None" if use.material is None else f"Some({json.dumps(use.material)})"
        reads = ", ".join(f"({json.dumps(each.name)}, {self._read(each)})" for each in use.reads)
        yield f"{reference}Use {{"
        yield f"    material: {material},"
        yield f"    shader: &{self._spelling.constant(use.shader.name)},"
        yield f"    reads: &[{reads}],"
        statements = [*map(self._give, use.gives), *self._layers(use)]
        if statements:
            type_ = self._spelling.type(blocks_of(use.shader))
            yield f"    give: &|{self._blocks}| {{"
            yield f"        let {self._blocks}: &mut {type_} = of_shader({self._blocks});"
            yield from (f"        {line}" for line in statements)
            yield "    },"
        else:
            yield "    give: &|_| {},"
        yield "},"

    def _read(self, each: Read) -> str:
        now = self._resource(each.source)
        if each.initially is None:
            return now
        return f"if {self._is_first} {{ {self._resource(each.initially)} }} else {{ {now} }}"

    def _resource(self, source: Resource) -> str:
        if source.kind == "host":
            return f"Source::Host({json.dumps(source.name)})"
        return f"Source::Frame({self.numbered(source.kind, source.number)})"

    def _give(self, give: Give) -> str:
        text = self._source(give.source)
        if give.initially is not None:
            text = f"if {self._is_first} {{ {self._source(give.initially)} }} else {{ {text} }}"
        return f"{self._field(give.block.plain_name, give.field)} = {text};"

    def _layers(self, use: Use) -> Iterator[str]:
        if use.layer is not None:
            block, field = use.layer
            yield f"{self._field(block.plain_name, field)} = {self._layer} as _;"


def _place(texture: int, layer: str, level: int) -> str:
    return f"Place {{ texture: {texture}, layer: {layer}, level: {level} }}"


def _option(number: int | None) -> str:
    return "None" if number is None else f"Some({number})"


def _indented(lines: Iterable[str]) -> Iterator[str]:
    """The lines of a block."""
    for line in lines:
        yield f"    {line}"
