"""The tables of frames in C, and the statements of the functions that draw them.

C has no closures, so what a frame gives to the blocks of a shader is a function of its own, which
gets the state of the frame: its parameters and numbers, and the numbers of the light and the layer.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from typing import NamedTuple

from ...compiler.documents.writing import to_json
from ..c_family.lines import string
from ..c_family.tables import Tables
from ..fields import Field, Numbers
from ..frames.model import (
    Attachment,
    Copy,
    Dispatch,
    Drawn,
    Frame,
    FrameTexture,
    Give,
    Lights,
    Pass,
    Read,
    Resource,
    Step,
    Use,
)
from ..frames.printing import FramePrinter
from ..frames.values import NUMBERS, PARAMETERS
from ..printer import Printer
from ..spelling import Spelling
from ..writing import blocks_of


class Giving(NamedTuple):
    """A function that sets the fields of a shader's blocks which the frame decides."""

    name: str
    lines: list[str]


class CFrame(FramePrinter):
    """Prints the tables of a frame, and the statements that draw it."""

    def __init__(self, spelling: Spelling, printer: Printer, tables: Tables, frame: Frame) -> None:
        super().__init__(spelling, printer)
        self._tables, self._frame = tables, frame
        self._parameters, self._numbers = map(spelling.local, (PARAMETERS, NUMBERS))
        self.giving: list[Giving] = []
        """The functions that the statements name."""
        self.lines = [line for step in frame.steps for line in self._guarded(step)]
        """The statements behind ``begin``."""

    # -- tables ------------------------------------------------------------------------------------

    def uses(self, texture: FrameTexture) -> str:
        """What a texture is used for."""
        return ", ".join(self._tables.word("TextureUse", each) for each in texture.row.uses)

    def textures(self, own: str) -> list[str]:
        """The rows of the frame's textures."""
        return [self._texture(each, f"{own}_{each.number}_uses") for each in self._frame.textures]

    def _texture(self, texture: FrameTexture, uses: str) -> str:
        row = to_json(texture.row)
        words = self._tables.word
        return (
            f"{{{string(texture.name)}, {words('Format', row['format'])}, "
            f"{words('Dimension', row['dimension'])}, {row['layers']}, {row['levels']}, "
            f"{row['samples']}, {uses}, {len(texture.row.uses)}, {_truth(row['kept'])}}}"
        )

    def buffers(self) -> list[str]:
        """The rows of the frame's buffers."""
        return [
            f"{{{string(each.name)}, {each.stride}, {_truth(each.initial is not None)}, "
            f"{each.initial or 0}u}}"
            for each in self._frame.buffers
        ]

    def kept(self) -> list[str]:
        """The rows of what is exchanged behind the frame."""
        return [
            f"{{{_truth(each.kind == 'buffer')}, {each.number}, {each.previous}}}"
            for each in self._frame.kept
        ]

    def outputs(self) -> list[str]:
        """The rows of the frame's outputs."""
        return [
            f"{{{string(each.name)}, {_truth(each.kind == 'buffer')}, {each.number}}}"
            for each in self._frame.outputs
        ]

    def tags(self, own: str) -> list[str]:
        """The rows of the frame's tags."""
        rows = []
        for number, each in enumerate(self._frame.plan.models):
            count = len(each.materials)
            materials = f"{own}_{number}_materials" if count else "NULL"
            rows.append(f"{{{string(each.name)}, {materials}, {count}}}")
        return rows

    def names(self, names: Iterable[str]) -> str:
        """Names in quotes."""
        return ", ".join(map(string, names))

    # -- the beginning -----------------------------------------------------------------------------

    @property
    def first(self) -> str:
        """The beginning of the statement that calls ``begin``, whose result may not matter."""
        return f"const bool {self._is_first} = !" if self._frame.asks_for_first else ""

    @property
    def sizes(self) -> str:
        """The sizes of all textures."""
        return ", ".join(self._lanes(each.size, 2) for each in self._frame.textures)

    @property
    def counts(self) -> str:
        """The numbers of elements of all buffers."""
        return ", ".join(f"(int){self._number(each.count)}" for each in self._frame.buffers)

    @property
    def unread(self) -> list[str]:
        """The statements that name what no other one reads: compilers warn of it."""
        text = "\n".join((*self.lines, self.sizes, self.counts))
        needs_parameters = bool(self._frame.numbers.sources) or _reads(text, self._parameters)
        return [
            f"(void){name};"
            for name, is_read in (
                (self._parameters, needs_parameters), (self._numbers, _reads(text, self._numbers)),
            )
            if not is_read
        ]  # fmt: skip

    # -- statements --------------------------------------------------------------------------------

    def _guarded(self, step: Step) -> Iterator[str]:
        if step.row.only_first:
            yield f"if ({self._is_first}) {{"
            yield from _indented(self._step(step))
            yield "}"
        else:
            yield from self._step(step)

    def _step(self, step: Step) -> Iterator[str]:
        match step:
            case Pass():
                yield from self._pass(step)
            case Dispatch():
                yield from self._dispatch(step)
            case Copy():
                yield f"host->copy(host->user, {step.source.number}, {step.target.number});"

    def _pass(self, step: Pass) -> Iterator[str]:
        loop = f"for (int {self._layer} = 0; {self._layer} < {step.layers}; ++{self._layer}) "
        yield ("" if step.layers == 1 else loop) + "{"
        yield from _indented(self._drawn_pass(step))
        yield "}"

    def _drawn_pass(self, step: Pass) -> Iterator[str]:
        targets = [self._attachment(step, each) for each in step.targets]
        if targets:
            yield from _listed("const burnish_Attachment targets[]", targets)
        if step.depth is not None:
            yield f"const burnish_Attachment depth = {self._attachment(step, step.depth)};"
        rows = {
            "viewport": step.viewport, "scissor": step.scissor, "constant": step.blend_constant,
        }  # fmt: skip
        for name, field in rows.items():
            if field is not None:
                yield f"const float {name}[] = {self._four(field)};"
        yield "const burnish_Pass pass = {"
        yield f"    {string(step.row.name)}, {_truth(step.row.continues)},"
        yield f"    {'targets' if targets else 'NULL'}, {len(targets)},"
        given = ("&depth" if step.depth else "NULL", *(n if f else "NULL" for n, f in rows.items()))
        yield f"    {', '.join(given)},"
        yield "};"
        yield "host->begin_pass(host->user, &pass);"
        for drawn in step.draws:
            yield from self._draws(drawn, has_layer=step.layers > 1)
        yield "host->end_pass(host->user);"

    def _attachment(self, step: Pass, target: Attachment) -> str:
        row = to_json(target.row)
        layer = -1 if row["layer"] is None else row["layer"]
        parts = {
            "name": string(row["name"]), "texture": target.texture.number,
            "layer": self._layer if step.layers > 1 else layer, "level": row["level"],
            "is_cleared": _truth(row["load"] == "clear"), "clear": self._clear(target),
            "is_stored": _truth(row["store"]),
        }  # fmt: skip
        if (resolve := row["resolve"]) is not None:
            places = ", ".join(str(resolve[each]) for each in ("texture", "layer", "level"))
            parts |= {"is_resolved": "true", "resolve": f"{{{places}}}"}
        if (stencil := row["stencil"]) is not None:
            loaded = f"{{{_truth(stencil['load'] == 'clear')}, {_truth(stencil['store'])}}}"
            parts |= {"has_stencil": "true", "stencil": loaded}
        return f"{{{', '.join(f'.{name} = {value}' for name, value in parts.items())}}}"

    def _clear(self, target: Attachment) -> str:
        is_depth = target.texture.row.format.startswith("depth")
        if target.clear is None:
            return "{1.0f}" if is_depth else "{0}"
        return f"{{{self._number(target.clear)}}}" if is_depth else self._four(target.clear)

    def _lanes(self, field: Field, count: int, cast: str = "") -> str:
        lanes = (f"{cast}{self._number(field)}[{number}]" for number in range(count))
        return f"{{{', '.join(lanes)}}}"

    def _four(self, field: Field) -> str:
        assert isinstance(field.type, Numbers)
        return self._lanes(field, 4, "" if field.type.kind == "float" else "(float)")

    def _draws(self, drawn: Drawn, *, has_layer: bool) -> Iterator[str]:
        has_light = drawn.light is not None
        loop = ""
        if drawn.light is not None:
            count = self._count(drawn.light)
            loop = f"for (int {self._light} = 0; {self._light} < {count}; ++{self._light}) "
        yield f"{loop}{{"
        yield from _indented(self._calls(drawn, self._state(has_light, has_layer)))
        yield "}"

    def _state(self, has_light: bool, has_layer: bool) -> str:
        parts = (
            self._parameters, self._numbers,
            self._is_first if self._frame.asks_for_first else "false",
            self._light if has_light else "0", self._layer if has_layer else "0",
        )  # fmt: skip
        return f"const burnish_FrameState state = {{{', '.join(parts)}}};"

    def _calls(self, drawn: Drawn, state: str) -> Iterator[str]:
        yield state
        yield from self._uses(drawn.uses)
        if drawn.models is None:
            assert drawn.vertices is not None
            yield f"host->fill(host->user, uses, (int){self._number(drawn.vertices)});"
        else:
            count = len(drawn.uses)
            yield f"host->draw_models(host->user, {string(drawn.models)}, uses, {count});"

    def _dispatch(self, step: Dispatch) -> Iterator[str]:
        yield "{"
        yield f"    {self._state(False, False)}"
        yield from _indented(self._uses((step.use,)))
        yield f"    const int groups[] = {self._lanes(step.groups, 3)};"
        given = []
        for name, rows in (("images", step.images), ("buffers", step.buffers)):
            written = [f"{{{string(own)}, {each.number}}}" for own, each in rows]
            if written:
                yield from _indented(_listed(f"const burnish_Written {name}[]", written))
            given.append(f"{name if written else 'NULL'}, {len(written)}")
        yield f"    host->dispatch(host->user, uses, groups, {', '.join(given)});"
        yield "}"

    # -- uses --------------------------------------------------------------------------------------

    def _uses(self, uses: tuple[Use, ...]) -> Iterator[str]:
        rows = []
        for number, use in enumerate(uses):
            reads = [f"{{{string(each.name)}, {self._read(each)}}}" for each in use.reads]
            if reads:
                yield from _listed(f"const burnish_Read reads_{number}[]", reads)
            material = "NULL" if use.material is None else string(use.material)
            listed = f"reads_{number}" if reads else "NULL"
            shader = self._spelling.constant(use.shader.name)
            rows.append(
                f"{{{material}, &{shader}, {listed}, {len(reads)}, {self._given(use)}, &state}}"
            )
        yield from _listed("const burnish_Use uses[]", rows)

    def _read(self, each: Read) -> str:
        now = self._resource(each.source)
        if each.initially is None:
            return now
        first = f"(burnish_Source){self._resource(each.initially)}"
        return f"{self._is_first} ? {first} : (burnish_Source){now}"

    def _resource(self, source: Resource) -> str:
        name = string(source.name) if source.kind == "host" else "NULL"
        return f"{{BURNISH_FROM_{source.kind.upper()}, {source.number}, {name}}}"

    def _given(self, use: Use) -> str:
        """The function that gives a use what the frame decides; alike ones are one."""
        lines = [line for give in use.gives for line in self._give(give)]
        if use.layer is not None:
            block, field = use.layer
            lines.append(f"{self._field(block.plain_name, field)} = {self._layer};")
        if not lines:
            return "NULL"
        lines = [*self._read_by(lines, use), *lines]
        known = next((each.name for each in self.giving if each.lines == lines), None)
        if known is None:
            wish = f"give.{self._frame.name}.{len(self.giving)}"
            known = self._spelling.function(wish)
            self.giving.append(Giving(known, lines))
        return known

    def _read_by(self, lines: list[str], use: Use) -> Iterator[str]:
        """The statements that take what others read out of the state of the frame."""
        text = "\n".join(lines)
        type_ = self._spelling.type
        pointers = (
            (self._parameters, type_(self._frame.parameters.name), "parameters"),
            (self._numbers, type_(self._frame.numbers.name), "numbers"),
        )
        for name, pointed, member in pointers:
            if _reads(text, name):
                yield f"const {pointed}* {name} = (const {pointed}*)state->{member};"
        values = (
            ("bool", self._is_first, "is_first"), ("int", self._light, "light"),
            ("int", self._layer, "layer"),
        )  # fmt: skip
        for kind, name, member in values:
            if _reads(text, name):
                yield f"const {kind} {name} = state->{member};"
        own = type_(blocks_of(use.shader))
        yield f"{own}* {self._blocks} = ({own}*)all;"

    def _give(self, give: Give) -> Iterator[str]:
        place = self._field(give.block.plain_name, give.field)
        source = self._source(give.source)
        type_ = give.field.type
        initially = None if give.initially is None else self._source(give.initially)
        is_number = isinstance(type_, Numbers) and type_.stored_lanes == 1 and not type_.columns
        if is_number and not give.field.capacity:
            text = source if initially is None else f"{self._is_first} ? {initially} : {source}"
            yield f"{place} = {text};"
            return
        now = f"BURNISH_ASSIGN({place}, {source});"
        if initially is None:
            yield now
        else:
            yield f"if ({self._is_first}) BURNISH_ASSIGN({place}, {initially});"
            yield f"else {now}"

    # -- names -------------------------------------------------------------------------------------

    def _number(self, field: Field) -> str:
        return f"{self._numbers}->{self._spelling.member(field.word)}"

    def _count(self, lights: Lights) -> str:
        return super()._count(lights).replace(".", "->", 1)

    def _field(self, block: str, field: Field) -> str:
        return super()._field(block, field).replace(".", "->", 1)


def _listed(declared: str, rows: list[str]) -> Iterator[str]:
    """The declaration of an array, with a line for each element."""
    yield f"{declared} = {{"
    yield from (f"    {row}," for row in rows)
    yield "};"


def _reads(text: str, name: str) -> bool:
    """True if statements read a variable."""
    return re.search(rf"(?<![\w.>\"]){re.escape(name)}\b", text) is not None


def _indented(lines: Iterable[str]) -> Iterator[str]:
    for line in lines:
        yield f"    {line}"


def _truth(value: object) -> str:
    return "true" if value else "false"
