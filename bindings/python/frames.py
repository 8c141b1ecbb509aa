"""The tables of frames in Python, and the statements of the functions that draw them."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import Any

from ...compiler.documents.writing import to_json
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
from ..printer import Printer
from ..spelling import Spelling
from ..writing import blocks_of

Literal = Callable[[Any], str]
"""Prints data as Python writes it."""

_MARGIN = "    "


def texture_row(texture: FrameTexture, literal: Literal) -> str:
    """What a host needs to know to make a texture: the arguments of ``FrameTexture``."""
    row = to_json(texture.row)
    names = ("format", "dimension", "layers", "levels", "samples")
    parts = [texture.name, *(row[name] for name in names)]
    uses = "".join(f"{literal(use)}, " for use in row["uses"]).rstrip(" ")
    return f"{', '.join(map(literal, parts))}, ({uses}), {literal(row['kept'])}"


def buffer_row(buffer: FrameBuffer, literal: Literal) -> str:
    """What a host needs to know to make a buffer: the arguments of ``FrameBuffer``."""
    return ", ".join(map(literal, (buffer.name, buffer.stride, buffer.initial)))


class PythonDrawing(FramePrinter):
    """Prints the statements that draw a frame."""

    def __init__(self, spelling: Spelling, printer: Printer, literal: Literal) -> None:
        super().__init__(spelling, printer)
        self._literal = literal
        self._host = spelling.local("host")
        self._given = 0
        """The number of functions that give values so far, by which they are called."""

    def lines(self, frame: Frame) -> Iterator[str]:
        """The statements behind ``begin``."""
        for step in frame.steps:
            if step.row.only_first:
                yield f"if {self._is_first}:"
                yield from indented(self._step(step))
            else:
                yield from self._step(step)

    def first(self, frame: Frame) -> str:
        """The beginning of the statement that calls ``begin``, whose result may not matter."""
        return f"{self._is_first} = not " if frame.asks_for_first else ""

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
                yield f"{self._host}.copy({step.source.number}, {step.target.number})"

    # -- passes ------------------------------------------------------------------------------------

    def _pass(self, step: Pass) -> Iterator[str]:
        if step.layers == 1:
            yield from self._drawn_pass(step)
            return
        yield f"for {self._layer} in range({step.layers}):"
        yield from indented(self._drawn_pass(step))

    def _drawn_pass(self, step: Pass) -> Iterator[str]:
        yield f"{self._host}.begin_pass(Pass({', '.join(self._state(step))}))"
        for drawn in step.draws:
            yield from self._draws(drawn)
        yield f"{self._host}.end_pass()"

    def _state(self, step: Pass) -> Iterator[str]:
        yield self._literal(step.row.name)
        yield self._literal(step.row.continues)
        yield f"[{', '.join(self._attachment(step, target) for target in step.targets)}]"
        if step.depth is not None:
            yield f"depth={self._attachment(step, step.depth)}"
        settings = {
            "viewport": step.viewport, "scissor": step.scissor,
            "blend_constant": step.blend_constant,
        }  # fmt: skip
        for name, field in settings.items():
            if field is not None:
                yield f"{name}={self._number(field)}"

    def _attachment(self, step: Pass, target: Attachment) -> str:
        row = to_json(target.row)
        layer = self._layer if step.layers > 1 else self._literal(row["layer"])
        is_depth = target.texture.row.format.startswith("depth")
        parts = [
            self._literal(row["name"]), str(target.texture.number), layer, str(row["level"]),
            self._literal(row["load"]), self._clear(target, is_depth=is_depth),
            self._literal(row["store"]),
        ]  # fmt: skip
        for name in ("resolve", "stencil"):
            if row[name] is not None:
                parts.append(f"{name}={self._literal(row[name])}")
        return f"Attachment({', '.join(parts)})"

    def _clear(self, target: Attachment, *, is_depth: bool) -> str:
        if target.clear is None:
            return "(1.0,)" if is_depth else "(0.0, 0.0, 0.0, 0.0)"
        return f"({self._number(target.clear)},)" if is_depth else self._number(target.clear)

    def _draws(self, drawn: Drawn) -> Iterator[str]:
        if drawn.light is None:
            yield from self._calls(drawn)
            return
        count = self._count(drawn.light)
        yield f"for {self._light} in range({count}):"
        yield from indented(self._calls(drawn))

    def _calls(self, drawn: Drawn) -> Iterator[str]:
        uses = []
        for use in drawn.uses:
            yield from self._giving(use)
            uses.append(self._use(use))
        if any(map(_gives, drawn.uses)):
            yield ""
        if drawn.models is None:
            assert drawn.vertices is not None
            yield f"{self._host}.fill({uses[0]}, {self._number(drawn.vertices)})"
        else:
            models = self._literal(drawn.models)
            yield f"{self._host}.draw_models({models}, [{', '.join(uses)}])"

    # -- kernels -----------------------------------------------------------------------------------

    def _dispatch(self, step: Dispatch) -> Iterator[str]:
        yield from self._giving(step.use)
        if _gives(step.use):
            yield ""
        images = self._literal({name: texture.number for name, texture in step.images})
        buffers = self._literal({name: buffer.number for name, buffer in step.buffers})
        arguments = f"{self._use(step.use)}, {self._number(step.groups)}, {images}, {buffers}"
        yield f"{self._host}.dispatch({arguments})"

    # -- uses --------------------------------------------------------------------------------------

    def _giving(self, use: Use) -> Iterator[str]:
        """The function that sets what the frame decides; none if this is nothing."""
        if _gives(use):
            statements = [*map(self._give, use.gives), *self._layers(use)]
            self._given += 1
            kind = self._spelling.type(blocks_of(use.shader))
            yield ""
            yield f"def give_{self._given}({self._blocks}: {kind}) -> None:"
            yield from indented(iter(statements))

    def _use(self, use: Use) -> str:
        reads = ", ".join(f"{self._literal(each.name)}: {self._read(each)}" for each in use.reads)
        parts = [
            self._literal(use.material), self._spelling.constant(use.shader.name), f"{{{reads}}}"
        ]  # fmt: skip
        if _gives(use):
            parts.append(f"give_{self._given}")
        return f"Use({', '.join(parts)})"

    def _read(self, each: Read) -> str:
        now = self._resource(each.source)
        if each.initially is None:
            return now
        return f"{self._resource(each.initially)} if {self._is_first} else {now}"

    def _resource(self, source: Resource) -> str:
        return f"Source({', '.join(map(self._literal, (source.kind, source.number, source.name)))})"

    def _give(self, give: Give) -> str:
        place = self._field(give.block.plain_name, give.field)
        text = self._source(give.source)
        if give.initially is not None:
            text = f"{self._source(give.initially)} if {self._is_first} else {text}"
        return f"{place} = {text}"

    def _layers(self, use: Use) -> Sequence[str]:
        if use.layer is None:
            return ()
        block, field = use.layer
        return (f"{self._field(block.plain_name, field)} = {self._layer}",)


def _gives(use: Use) -> bool:
    """True if the frame decides a value of a shader."""
    return bool(use.gives) or use.layer is not None


def indented(lines: Iterator[str]) -> Iterator[str]:
    """The lines of a block."""
    for line in lines:
        yield f"{_MARGIN}{line}" if line else ""
