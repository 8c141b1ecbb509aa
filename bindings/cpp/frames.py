"""The tables of frames in C++, and the statements of the functions that draw them."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

from ...compiler.documents.writing import to_json
from ..c_family.lines import string
from ..c_family.tables import Tables, plain
from ..fields import Field, Numbers
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
from ..frames.values import PARAMETERS
from ..printer import Printer
from ..spelling import Spelling
from ..writing import blocks_of


class CppFrames(FramePrinter):
    """Prints the tables of frames, and the statements that draw them."""

    def __init__(self, spelling: Spelling, printer: Printer, tables: Tables) -> None:
        super().__init__(spelling, printer)
        self._tables = tables

    # -- tables ------------------------------------------------------------------------------------

    def uses(self, texture: FrameTexture) -> str:
        """What a texture is used for."""
        return ", ".join(self._tables.word("TextureUse", each) for each in texture.row.uses)

    def textures(self, frame: Frame, own: str) -> list[str]:
        """The rows of a frame's textures."""
        return [self._texture(each, f"{own}_texture_{each.number}_uses") for each in frame.textures]

    def _texture(self, texture: FrameTexture, uses: str) -> str:
        row = to_json(texture.row)
        words = self._tables.word
        return (
            f"{{{string(texture.name)}, {words('Format', row['format'])}, "
            f"{words('Dimension', row['dimension'])}, {row['layers']}, {row['levels']}, "
            f"{row['samples']}, {uses}, {_truth(row['kept'])}}}"
        )

    def buffers(self, frame: Frame) -> list[str]:
        """The rows of a frame's buffers."""
        return [
            f"{{{string(each.name)}, {each.stride}, {_truth(each.initial is not None)}, "
            f"{each.initial or 0}u}}"
            for each in frame.buffers
        ]

    def kept(self, frame: Frame) -> list[str]:
        """The rows of what is exchanged behind a frame."""
        return [
            f"{{{_truth(each.kind == 'buffer')}, {each.number}, {each.previous}}}"
            for each in frame.kept
        ]

    def outputs(self, frame: Frame) -> list[str]:
        """The rows of a frame's outputs."""
        return [
            f"{{{string(each.name)}, {_truth(each.kind == 'buffer')}, {each.number}}}"
            for each in frame.outputs
        ]

    def tags(self, frame: Frame, own: str) -> list[str]:
        """The rows of a frame's tags."""
        return [
            f"{{{string(each.name)}, {f'{own}_{plain(each.name)}' if each.materials else '{}'}}}"
            for each in frame.plan.models
        ]

    def names(self, names: Iterable[str]) -> str:
        """Names in quotes."""
        return ", ".join(map(string, names))

    # -- statements --------------------------------------------------------------------------------

    def lines(self, frame: Frame) -> Iterator[str]:
        """The statements behind ``begin``."""
        for step in frame.steps:
            if step.row.only_first:
                yield f"if ({self._is_first}) {{"
                yield from _indented(self._step(step))
                yield "}"
            else:
                yield from self._step(step)

    def reads_parameters(self, frame: Frame) -> bool:
        """True if the function reads its parameters."""
        word = self._spelling.local(PARAMETERS)
        read = any(word in line for line in self.lines(frame))
        return bool(frame.numbers.sources) or read

    def first(self, frame: Frame) -> str:
        """The beginning of the statement that calls ``begin``, whose result may not matter."""
        return f"const bool {self._is_first} = !" if frame.asks_for_first else ""

    def sizes(self, frame: Frame) -> str:
        """The sizes of all textures."""
        return ", ".join(self._lanes(each.size, "two") for each in frame.textures)

    def counts(self, frame: Frame) -> str:
        """The numbers of elements of all buffers."""
        return ", ".join(f"int({self._number(each.count)})" for each in frame.buffers)

    def _lanes(self, field: Field, count: str) -> str:
        return f"burnish::detail::{count}({self._number(field)})"

    def _step(self, step: Step) -> Iterator[str]:
        match step:
            case Pass():
                yield from self._pass(step)
            case Dispatch():
                yield from self._dispatch(step)
            case Copy():
                yield f"host.copy({step.source.number}, {step.target.number});"

    def _pass(self, step: Pass) -> Iterator[str]:
        if step.layers == 1:
            yield from self._drawn_pass(step)
            return
        yield f"for (int {self._layer} = 0; {self._layer} < {step.layers}; ++{self._layer}) {{"
        yield from _indented(self._drawn_pass(step))
        yield "}"

    def _drawn_pass(self, step: Pass) -> Iterator[str]:
        yield "host.begin_pass({"
        yield from _indented(self._state(step))
        yield "});"
        for drawn in step.draws:
            yield from self._draws(drawn)
        yield "host.end_pass();"

    def _state(self, step: Pass) -> Iterator[str]:
        yield f"{string(step.row.name)}, {_truth(step.row.continues)},"
        targets = ", ".join(self._attachment(step, target) for target in step.targets)
        yield f"{{{targets}}},"
        depth = "std::nullopt" if step.depth is None else self._depth(step, step.depth)
        yield f"{depth},"
        settings = (step.viewport, step.scissor, step.blend_constant)
        texts = ("std::nullopt" if each is None else self._four(each) for each in settings)
        yield f"{', '.join(texts)},"

    def _depth(self, step: Pass, depth: Attachment) -> str:
        return f"Attachment{self._attachment(step, depth)}"

    def _four(self, field: Field) -> str:
        assert isinstance(field.type, Numbers)
        if field.type.kind == "float":
            return self._lanes(field, "four")
        lanes = (f"float({self._number(field)}.{lane})" for lane in "xyzw")
        return f"std::array<float, 4>{{{', '.join(lanes)}}}"

    def _attachment(self, step: Pass, target: Attachment) -> str:
        row = to_json(target.row)
        layer = -1 if row["layer"] is None else row["layer"]
        parts = [
            string(row["name"]), target.texture.number,
            self._layer if step.layers > 1 else layer, row["level"],
            _truth(row["load"] == "clear"), self._clear(target), _truth(row["store"]),
        ]  # fmt: skip
        resolve, stencil = row["resolve"], row["stencil"]
        if resolve or stencil:
            numbers = (resolve[each] for each in ("texture", "layer", "level")) if resolve else ()
            texts = ", ".join(map(str, numbers))
            parts.append(f"Attachment::Resolve{{{texts}}}" if resolve else "std::nullopt")
        if stencil:
            truths = _truth(stencil["load"] == "clear"), _truth(stencil["store"])
            parts.append(f"Attachment::StencilLoad{{{', '.join(truths)}}}")
        return f"{{{', '.join(map(str, parts))}}}"

    def _clear(self, target: Attachment) -> str:
        is_depth = target.texture.row.format.startswith("depth")
        if target.clear is None:
            return "{1.0f}" if is_depth else "{}"
        return f"{{{self._number(target.clear)}}}" if is_depth else self._four(target.clear)

    def _draws(self, drawn: Drawn) -> Iterator[str]:
        if drawn.light is None:
            yield from self._calls(drawn)
            return
        count = self._count(drawn.light)
        yield f"for (int {self._light} = 0; {self._light} < {count}; ++{self._light}) {{"
        yield from _indented(self._calls(drawn))
        yield "}"

    def _calls(self, drawn: Drawn) -> Iterator[str]:
        if drawn.models is None:
            (use,) = drawn.uses
            assert drawn.vertices is not None
            yield "host.fill("
            yield from _indented(self._use(use))
            yield f"    int({self._number(drawn.vertices)})"
            yield ");"
            return
        yield f"host.draw_models({string(drawn.models)}, {{"
        for use in drawn.uses:
            yield from _indented(self._use(use))
        yield "});"

    def _dispatch(self, step: Dispatch) -> Iterator[str]:
        yield "host.dispatch("
        yield from _indented(self._use(step.use))
        written = (
            ", ".join(f"{{{string(name)}, {each.number}}}" for name, each in rows)
            for rows in (step.images, step.buffers)
        )
        images, buffers = written
        yield f"    {self._lanes(step.groups, 'three')}, {{{images}}}, {{{buffers}}}"
        yield ");"

    # -- uses --------------------------------------------------------------------------------------

    def _use(self, use: Use) -> Iterator[str]:
        material = "nullptr" if use.material is None else string(use.material)
        reads = ", ".join(f"{{{string(each.name)}, {self._read(each)}}}" for each in use.reads)
        yield "{"
        yield f"    {material}, &{self._spelling.constant(use.shader.name)},"
        yield f"    {{{reads}}},"
        statements = [*map(self._give, use.gives), *self._layers(use)]
        if not statements:
            yield "    [](Blocks&) {},"
        else:
            type_ = self._spelling.type(blocks_of(use.shader))
            yield "    [&](Blocks& all) {"
            yield f"        auto& {self._blocks} = static_cast<{type_}&>(all);"
            yield from (f"        {each}" for each in statements)
            yield "    },"
        yield "},"

    def _read(self, each: Read) -> str:
        now = self._resource(each.source)
        if each.initially is None:
            return now
        return f"{self._is_first} ? {self._resource(each.initially)} : {now}"

    def _resource(self, source: Resource) -> str:
        name = string(source.name) if source.kind == "host" else "nullptr"
        return f"Source{{Source::From::{source.kind}, {source.number}, {name}}}"

    def _give(self, give: Give) -> str:
        place = self._field(give.block.plain_name, give.field)
        text = self._source(give.source)
        if give.initially is not None:
            text = f"{self._is_first} ? {self._source(give.initially)} : {text}"
        is_plain = isinstance(give.field.type, Numbers) and not give.field.capacity
        return f"{place} = {text};" if is_plain else f"burnish::detail::assign({place}, {text});"

    def _layers(self, use: Use) -> Sequence[str]:
        if use.layer is None:
            return ()
        block, field = use.layer
        return (f"{self._field(block.plain_name, field)} = {self._layer};",)


def _indented(lines: Iterator[str]) -> Iterator[str]:
    for line in lines:
        yield f"    {line}"


def _truth(value: object) -> str:
    return "true" if value else "false"
