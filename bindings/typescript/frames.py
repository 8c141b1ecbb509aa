"""The tables of frames in TypeScript, and the statements of the functions that draw them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any

from ...compiler.documents.writing import to_json
from ..frames.model import (
    Attachment,
    Copy,
    Dispatch,
    Drawn,
    Frame,
    FrameTexture,
    Give,
    Pass,
    Read,
    Resource,
    Step,
    Use,
)
from ..frames.printing import FramePrinter
from ..printer import Printer
from ..spelling import Spelling
from ..writing import blocks_of

Literal = Callable[[Any], str]
"""Prints data as TypeScript writes it."""


def texture_row(texture: FrameTexture) -> Mapping[str, Any]:
    """What a host needs to know to make a texture."""
    row = to_json(texture.row)
    names = ("format", "dimension", "layers", "levels", "samples", "uses", "kept")
    return {"name": texture.name, **{name: row[name] for name in names}}


def buffer_rows(frame: Frame) -> list[Mapping[str, Any]]:
    """What a host needs to know to make the buffers."""
    return [
        {"name": each.name, "stride": each.stride, "initial": each.initial}
        for each in frame.buffers
    ]


def kept_rows(frame: Frame) -> list[Mapping[str, Any]]:
    """What is exchanged behind a frame."""
    return [
        {"kind": each.kind, "number": each.number, "previous": each.previous} for each in frame.kept
    ]


class Drawing(FramePrinter):
    """Prints the statements that draw a frame."""

    def __init__(self, spelling: Spelling, printer: Printer, literal: Literal) -> None:
        super().__init__(spelling, printer)
        self._literal = literal

    def lines(self, frame: Frame) -> Iterator[str]:
        """The statements behind ``begin``."""
        for step in frame.steps:
            if step.row.only_first:
                yield f"if ({self._is_first}) {{"
                yield from indented(self._step(step))
                yield "}"
            else:
                yield from self._step(step)

    def first(self, frame: Frame) -> str:
        """The beginning of the statement that calls ``begin``, whose result may not matter."""
        return f"const {self._is_first} = !" if frame.asks_for_first else ""

    def sizes(self, frame: Frame) -> str:
        """The sizes of all textures."""
        return ", ".join(self._number(each.size) for each in frame.textures)

    def counts(self, frame: Frame) -> str:
        """The numbers of elements of all buffers."""
        return ", ".join(self._number(each.count) for each in frame.buffers)

    def _step(self, step: Step) -> Iterator[str]:
        match step:
            case Pass():
                yield from self._pass(step)
            case Dispatch():
                yield from self._dispatch(step)
            case Copy():
                yield f"host.copy({step.source.number}, {step.target.number});"

    # -- passes ------------------------------------------------------------------------------------

    def _pass(self, step: Pass) -> Iterator[str]:
        if step.layers == 1:
            yield from self._drawn_pass(step)
            return
        yield (f"for (let {self._layer} = 0; {self._layer} < {step.layers}; {self._layer} += 1) {{")
        yield from indented(self._drawn_pass(step))
        yield "}"

    def _drawn_pass(self, step: Pass) -> Iterator[str]:
        yield "host.beginPass({"
        yield from indented(self._state(step))
        yield "});"
        for drawn in step.draws:
            yield from self._draws(drawn)
        yield "host.endPass();"

    def _state(self, step: Pass) -> Iterator[str]:
        yield f"name: {self._literal(step.row.name)},"
        yield f"continues: {self._literal(step.row.continues)},"
        targets = ", ".join(self._attachment(step, target) for target in step.targets)
        yield f"targets: [{targets}],"
        if step.depth is not None:
            yield f"depth: {self._attachment(step, step.depth)},"
        settings = {
            "viewport": step.viewport, "scissor": step.scissor,
            "blendConstant": step.blend_constant,
        }  # fmt: skip
        for name, field in settings.items():
            if field is not None:
                yield f"{name}: {self._number(field)},"

    def _attachment(self, step: Pass, target: Attachment) -> str:
        row = to_json(target.row)
        layer = self._layer if step.layers > 1 else self._literal(row["layer"])
        is_depth = target.texture.row.format.startswith("depth")
        parts = {
            "name": self._literal(row["name"]),
            "texture": str(target.texture.number),
            "layer": layer,
            "level": str(row["level"]),
            "load": self._literal(row["load"]),
            "clear": self._clear(target, is_depth=is_depth),
            "store": self._literal(row["store"]),
        }
        for name in ("resolve", "stencil"):
            if row[name] is not None:
                parts[name] = self._literal(row[name])
        return f"{{ {', '.join(f'{name}: {text}' for name, text in parts.items())} }}"

    def _clear(self, target: Attachment, *, is_depth: bool) -> str:
        if target.clear is None:
            return "[1]" if is_depth else "[0, 0, 0, 0]"
        return f"[{self._number(target.clear)}]" if is_depth else self._number(target.clear)

    def _draws(self, drawn: Drawn) -> Iterator[str]:
        if drawn.light is None:
            yield from self._calls(drawn)
            return
        count = self._count(drawn.light)
        yield f"for (let {self._light} = 0; {self._light} < {count}; {self._light} += 1) {{"
        yield from indented(self._calls(drawn))
        yield "}"

    def _calls(self, drawn: Drawn) -> Iterator[str]:
        if drawn.models is None:
            (use,) = drawn.uses
            assert drawn.vertices is not None
            yield "host.fill({"
            yield from indented(self._use(use))
            yield f"}}, {self._number(drawn.vertices)});"
            return
        yield f"host.drawModels({self._literal(drawn.models)}, ["
        for use in drawn.uses:
            yield "  {"
            yield from indented(indented(self._use(use)))
            yield "  },"
        yield "]);"

    # -- kernels -----------------------------------------------------------------------------------

    def _dispatch(self, step: Dispatch) -> Iterator[str]:
        yield "host.dispatch({"
        yield from indented(self._use(step.use))
        images = {name: texture.number for name, texture in step.images}
        buffers = {name: buffer.number for name, buffer in step.buffers}
        groups = self._number(step.groups)
        yield f"}}, {groups}, {self._literal(images)}, {self._literal(buffers)});"

    # -- uses --------------------------------------------------------------------------------------

    def _use(self, use: Use) -> Iterator[str]:
        yield f"material: {self._literal(use.material)},"
        yield f"shader: {self._spelling.constant(use.shader.name)},"
        reads = ", ".join(f"{self._key(each.name)}: {self._read(each)}" for each in use.reads)
        yield f"reads: {{ {reads} }}," if reads else "reads: {},"
        statements = [*map(self._give, use.gives), *self._layers(use)]
        if not statements:
            yield "give() {},"
            return
        yield f"give({self._blocks}: {self._spelling.type(blocks_of(use.shader))}) {{"
        yield from indented(iter(statements))
        yield "},"

    def _key(self, name: str) -> str:
        text = self._literal({name: 0})
        return text[2 : text.rindex(":")]

    def _read(self, each: Read) -> str:
        now = self._resource(each.source)
        if each.initially is None:
            return now
        return f"{self._is_first} ? {self._resource(each.initially)} : {now}"

    def _resource(self, source: Resource) -> str:
        is_host = source.kind == "host"
        return self._literal({source.kind: source.name if is_host else source.number})

    def _give(self, give: Give) -> str:
        place = self._field(give.block.plain_name, give.field)
        text = self._source(give.source)
        if give.initially is not None:
            text = f"{self._is_first} ? {self._source(give.initially)} : {text}"
        return f"{place} = {text};"

    def _layers(self, use: Use) -> Sequence[str]:
        if use.layer is None:
            return ()
        block, field = use.layer
        return (f"{self._field(block.plain_name, field)} = {self._layer};",)


def indented(lines: Iterator[str]) -> Iterator[str]:
    """The lines of a block."""
    for line in lines:
        yield f"  {line}"
