"""Builds the ``Picture`` of a compiled frame; ``command.py`` calls ``frame_picture``."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence
from typing import TYPE_CHECKING, NamedTuple

from ...compiler.documents.plan import (
    AttachmentRow,
    CopyStep,
    DrawStep,
    FrameTextureRow,
    HostSource,
    OutputRow,
    PlaceRow,
    PlanStep,
    PreviousSource,
    ResultSource,
    RunStep,
    SizeRow,
    Source,
    ValueSource,
)
from ...compiler.documents.steps import ParameterStep
from ...compiler.formula import Formulas
from ...compiler.ir.shader import Notes
from ...targets.runner.frames.checks.rows import inputs
from .kinds import ArrowKind, Kind, Mark
from .model import Arrow, Box, Cluster, Picture, Port
from .time_line import mark_of, time_line

if TYPE_CHECKING:
    from ...api.entry_points import CompiledFrame


EVERYWHERE = "size"
"""A parameter that every frame has, and nearly every step reads."""


def frame_picture(frame: CompiledFrame) -> Picture:
    """The steps of a frame, the host's inputs and outputs, and the lives of results."""
    return _FrameBuilder(frame).picture()


class _FrameBuilder:
    def __init__(self, frame: CompiledFrame) -> None:
        self._plan = frame.plan
        self._formulas = Formulas(Notes())
        # The rows of the plan's values are the different ones of the frame's, in order.
        self._values = list(dict.fromkeys(frame.frame.values))
        self._host: dict[str, Box] = {}
        self._arrows: dict[Arrow, None] = {}
        self._makers: dict[str, tuple[str, str]] = {}
        """For each result, the box of the step that leaves it, and the key of the box's row."""
        self._lights = {name: light.name for light in self._plan.lights
                        for name in light.parameters}  # fmt: skip

    def picture(self) -> Picture:
        plan = self._plan
        groups = list(_groups(plan.steps))
        steps = list(map(self._step, groups))
        outputs = list(map(self._output, plan.outputs))
        self._loops()
        clusters = [
            Cluster("from the host", list(self._host.values()), has_border=False),
            Cluster("steps", steps, has_border=False),
            Cluster("outputs", outputs, has_border=False),
        ]
        line = time_line(plan, [len(group.steps) for group in groups], self._what)
        rig = f", rig {plan.rig}" if plan.rig else ""
        return Picture(f"{plan.frame}{rig}", clusters, list(self._arrows), plan.doc, line)

    # --- steps ---

    def _step(self, group: _Group) -> Box:
        """The box of one step, or of several that one equation repeats."""
        last = group.steps[-1]
        if isinstance(last, CopyStep):
            return self._copy(last)
        steps = [step for step in group.steps if not isinstance(step, CopyStep)]
        turns = [step for step in steps if not group.within(step)]
        box = Box(f"step {last.name}", Kind[last.kind.upper()], group.name)
        box.only_first = last.only_first
        box.repeated = self._repeated(turns)
        actions = dict.fromkeys(line for step in steps for line in self._does(step))
        box.subject, *box.lines = actions
        box.place = _place(last.source)
        for step in steps:
            self._read(step, box)
            self._leave(step, box, group.within(step))
        return box

    def _copy(self, step: CopyStep) -> Box:
        before, after, texture = step.copied.result, step.into.result, step.into.texture
        box = Box(f"copy {after}", Kind.COPY, "copy", subject=f"of {before}")
        self._arrow_from(before, box.key, ArrowKind.READ)
        what = self._texture(texture)
        port = Port(f"{after} (copied)", after, what, texture, Mark.WRITTEN, "")
        box.ports.append(port)
        self._makers[after] = box.key, port.key
        return box

    def _does(self, step: DrawStep | RunStep) -> Iterator[str]:
        """The actions of a step, as lines of its box."""
        if isinstance(step, RunStep):
            yield self._shader(step.use.shader)
            return
        yield step.pass_
        for drawn in step.draws:
            if drawn.models is not None:
                yield f"draws {drawn.models}"
            elif drawn.vertices is not None:
                yield f"draws {self._number(drawn.vertices)} vertices"
            if drawn.light is not None:
                yield f"once for each light of {drawn.light}"

    def _shader(self, number: int) -> str:
        """The name of a shader, without that of the frame."""
        name = self._plan.shaders[number].name
        return name.removeprefix(f"{self._plan.frame}.")

    def _repeated(self, steps: Sequence[PlanStep]) -> str:
        """The reason why the steps of an equation are repeated; empty if there is only one."""
        if len(steps) == 1:
            return ""
        drawn = [step.attachments[0] for step in steps if step.attachments]
        levels, layers = {target.level for target in drawn}, {target.layer for target in drawn}
        words, turns = [], len(steps)
        counts = ((len(levels), "mip levels"), (len(layers), self._layers(drawn)))
        for found, word in counts:
            if found > 1 and turns % found == 0:
                words.append(f"{found} {word}")
                turns //= found
        return " × ".join([*([f"{turns} turns"] if turns > 1 else []), *words])

    def _layers(self, drawn: Sequence[AttachmentRow]) -> str:
        of = {self._plan.textures[target.texture].dimension for target in drawn}
        return "faces" if of == {"cube"} else "layers"

    def _read(self, step: PlanStep, box: Box) -> None:
        """Add the arrows from a step's inputs, and notes of the values that the frame sets."""
        for drawn in step.draws:
            if drawn.models is not None:
                self._arrow(self._given_models(drawn.models), box)
            if drawn.light is not None:
                self._arrow(self._given_light(drawn.light), box)
        for row in inputs(step):
            self._input(row.name, row.source, box)
        for target in step.attachments:
            if target.over is not None:
                # If others need the old contents, these were copied to where the step draws.
                copied = target.result in self._makers
                over = target.result if copied else target.over
                self._arrow_from(over, box.key, ArrowKind.OVER)

    def _input(self, name: str, source: Source, box: Box) -> None:
        match source:
            case ValueSource():
                note = f"{name} = {self._number(source.value)}"
                if note not in box.settings:
                    box.settings.append(note)
                for parameter in self._parameters(source.value):
                    self._arrow(self._given_parameter(parameter), box)
            case HostSource():
                self._arrow(self._given_resource(source.host), box)
            case PreviousSource():
                before = self._given(Kind.PREVIOUS, "previous", source.previous)
                before.lines = ["of the last frame"]
                self._arrow(before, box, ArrowKind.READ)
                match source.initially:
                    case HostSource(host=host):
                        self._arrow(self._given_resource(host), box, ArrowKind.INITIAL)
                    case ResultSource(result=result):
                        self._arrow_from(result, box.key, ArrowKind.INITIAL)
            case ResultSource():
                self._arrow_from(source.result, box.key, ArrowKind.READ)

    def _leave(self, step: PlanStep, box: Box, within: str) -> None:
        """Add the results of a step, as rows of its box."""
        prefix = f"{within}." if within else ""
        for target in step.attachments:
            what = self._texture(target.texture)
            self._port(box, target.result, prefix + target.name, what, target.texture,
                       mark_of(target))  # fmt: skip
        for image in step.images:
            what = self._texture(image.texture)
            self._port(box, image.result, prefix + image.name, what, image.texture, Mark.WRITTEN)
        for buffer in step.buffers:
            self._port(box, buffer.result, prefix + buffer.name, "buffer", None, Mark.WRITTEN)

    def _port(
        self, box: Box, result: str, name: str, what: str, texture: int | None, mark: Mark
    ) -> None:
        """Add a row for a result to a box, or replace the row of the same name.

        If several steps of a box leave results by one name, the row is that of the last of them.
        """
        row = next((r for r in self._plan.results if r.name == result), None)
        place = "" if row is None else _place(row.source)
        port = Port(result, name, what, texture, mark, place)
        known = next((p for p in box.ports if p.name == name), None)
        if known is None:
            box.ports.append(port)
        else:
            for of_result, (maker, key) in list(self._makers.items()):
                if (maker, key) == (box.key, known.key):
                    self._makers[of_result] = box.key, result
            # Layers and levels that are drawn one after the other are cleared one by one.
            port.mark = known.mark if known.key == result else mark
            box.ports[box.ports.index(known)] = port
            self._moved(box.key, known.key, result)
        self._makers[result] = box.key, result

    def _moved(self, box: str, before: str, after: str) -> None:
        """Let the arrows from a row of a box begin at another one."""
        for arrow in list(self._arrows):
            if (arrow.source, arrow.port) == (box, before) and before != after:
                del self._arrows[arrow]
                self._arrows[Arrow(box, arrow.target, arrow.kind, after)] = None

    # --- the host ---

    def _given(self, kind: Kind, word: str, name: str, type_: str = "") -> Box:
        """The box of an input, whose key has a word for the kind; made when first asked for."""
        key = f"{word} {name}"
        source = self._plan.sources.get(name) if type_ else None
        place = "" if source is None else _place(source)
        return self._host.setdefault(key, Box(key, kind, name, type_, place=place))

    def _given_models(self, name: str) -> Box:
        (row,) = (row for row in self._plan.models if row.name == name)
        box = self._given(Kind.MODELS, "models", name)
        box.lines = [", ".join(row.materials)]
        box.place = _place(row.source)
        return box

    def _given_light(self, name: str) -> Box:
        return self._given(Kind.LIGHT, "light", name)

    def _given_resource(self, name: str) -> Box:
        textures = {row.name: row.type for row in self._plan.host_textures}
        if name in textures:
            return self._given(Kind.HOST_TEXTURE, "texture", name, textures[name])
        (row,) = (row for row in self._plan.host_buffers if row.name == name)
        return self._given(Kind.HOST_BUFFER, "buffer", name, row.type)

    def _given_parameter(self, name: str) -> Box:
        if name in self._lights:
            return self._given_light(self._lights[name])
        (row,) = (row for row in self._plan.parameters if row.name == name)
        return self._given(Kind.FRAME_PARAMETER, "parameter", name, row.type)

    def _parameters(self, value: int) -> Iterator[str]:
        """The parameters on which a number depends."""
        steps = self._plan.values[value].steps
        names = {step.parameter for step in steps if isinstance(step, ParameterStep)}
        return (name for name in sorted(names) if name != EVERYWHERE)

    def _output(self, row: OutputRow) -> Box:
        _, port = self._makers[row.result]
        box = Box(f"output {row.name}", Kind.OUTPUT, row.name, formula=port)
        box.lines = [row.doc] if row.doc else []
        box.place = _place(row.source)
        self._arrow_from(row.result, box.key, ArrowKind.READ)
        return box

    def _loops(self) -> None:
        """Add the arrows from the last frame's results to the steps that read them."""
        for kept in self._plan.kept:
            target = f"previous {kept.result}"
            if target in self._host:
                self._arrow_from(kept.result, target, ArrowKind.BACK)

    # --- arrows and words ---

    def _arrow(self, source: Box, box: Box, kind: ArrowKind = ArrowKind.GIVEN) -> None:
        self._arrows[Arrow(source.key, box.key, kind)] = None

    def _arrow_from(self, result: str, target: str, kind: ArrowKind) -> None:
        """An arrow from a result of a step; none within a box, whose steps follow each other."""
        maker, port = self._makers[result]
        if maker != target:
            self._arrows[Arrow(maker, target, kind, port)] = None

    def _number(self, value: int) -> str:
        """The computation of a number, in short."""
        node = self._values[value]
        text = self._formulas.text(node)
        return f"{node.type}(…)" if "…" in text else text

    def _texture(self, number: int) -> str:
        return self._what(self._plan.textures[number])

    def _what(self, texture: FrameTextureRow) -> str:
        """The format, the size and the layers of a texture."""
        parts = [texture.format, self._size(texture.size)]
        if texture.dimension == "cube":
            parts.append("cube")
        elif texture.layers > 1:
            parts.append(f"{texture.layers} layers")
        if texture.levels > 1:
            parts.append(f"{texture.levels} levels")
        return " · ".join(parts)

    def _size(self, size: SizeRow) -> str:
        if size.value is None:
            return f"as large as {size.extent_of}"
        text = self._number(size.value)
        found = re.fullmatch(r"ivec2\((\d+)(?:, (\d+))?\)", text)
        if found is not None:
            sides = [max(int(side) >> size.level, 1) for side in (found[1], found[2] or found[1])]
            return f"{sides[0]} x {sides[1]}"
        return f"({text}) / {2**size.level}" if size.level else text


class _Group(NamedTuple):
    """The steps of one equation, with the copies between them.

    A repeated equation has steps with numbers, such as ``soft.0``, which may have steps of their
    own, ``soft.0.source``; the last repetition has no number.
    """

    name: str
    steps: list[PlanStep]

    def within(self, step: PlanStep) -> str:
        """The name of a step within a repetition of the equation; empty for the latter itself."""
        parts = step.name.removeprefix(self.name).strip(".").split(".")
        return ".".join(part for part in parts if not re.fullmatch(r"(level)?\d+", part))


_NUMBERED = re.compile(r"(.+?)\.(level)?\d+(\.|$)")
"""A pattern of the name of one of several steps; the first group is the part that all have in
common."""


def _groups(steps: Sequence[PlanStep]) -> Iterator[_Group]:
    """The steps of each equation.

    A copy belongs to the step behind it, if that is not the first one of its equation, and
    otherwise stands alone.
    """
    repeated = {found[1] for step in steps if (found := _NUMBERED.match(step.name))}
    group = _Group("", [])
    copies: list[PlanStep] = []
    for step in steps:
        if isinstance(step, CopyStep):
            copies.append(step)
            continue
        name = _base(step.name, repeated)
        if name == group.name:
            group.steps.extend([*copies, step])
        else:
            yield from [group] if group.steps else []
            yield from (_Group("copy", [copy]) for copy in copies)
            group = _Group(name, [step])
        copies = []
    yield from [group] if group.steps else []


def _base(name: str, repeated: Collection[str]) -> str:
    """The name of the repeated equation to which a step belongs, or its own name."""
    parts = name.split(".")
    bases = (".".join(parts[:length]) for length in range(1, len(parts)))
    return next((base for base in bases if base in repeated), name)


def _place(source: PlaceRow) -> str:
    return f"{source.file}:{source.line}:{source.column}"
