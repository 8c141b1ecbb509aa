"""Builds the ``FramePicture`` of a compiled frame; ``command.py`` calls ``frame_picture``."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

from ....compiler.formula import Formulas
from ....compiler.ir.shader import Notes
from .model import Arrow, ArrowKind, Box, FramePicture, MarkKind, Port
from .time_line import attachments, mark_of, time_line

if TYPE_CHECKING:
    from ....api import CompiledFrame

    Rows = Mapping[str, Any]
    """A part of the plan."""

EVERYWHERE = "size"
"""A parameter that every frame has, and nearly every step reads."""


def frame_picture(frame: CompiledFrame) -> FramePicture:
    """The steps of a frame, what the host gives and gets, and how long everything is needed."""
    return _Builder(frame).picture()


class _Builder:
    def __init__(self, frame: CompiledFrame) -> None:
        self._plan: Rows = frame.plan
        self._formulas = Formulas(Notes())
        # The rows of the plan's values are the different ones of the frame's, in order.
        self._values = list(dict.fromkeys(frame.frame.values))
        self._host: dict[str, Box] = {}
        self._steps: list[Box] = []
        self._arrows: dict[Arrow, None] = {}
        self._makers: dict[str, tuple[str, str]] = {}
        """For each result, the box of the step that leaves it, and the key of the box's row."""
        self._lights = {name: light["name"] for light in self._plan["lights"]
                        for name in light["parameters"]}  # fmt: skip

    def picture(self) -> FramePicture:
        plan = self._plan
        groups = list(_groups(plan["steps"]))
        for group in groups:
            self._steps.append(self._step(group))
        outputs = list(map(self._output, plan["outputs"]))
        self._loops()
        columns, rows = time_line(plan, [len(group.steps) for group in groups], self._what)
        rig = f", rig {plan['rig']}" if plan["rig"] else ""
        boxes = [*self._host.values(), *self._steps, *outputs]
        return FramePicture(
            f"{plan['frame']}{rig}", plan["doc"], boxes, list(self._arrows), columns, rows
        )

    # --- steps ---

    def _step(self, group: _Group) -> Box:
        """The box of one step, or of several that one equation repeats."""
        last = group.steps[-1]
        if last["kind"] == "copy":
            return self._copy(last)
        steps = [step for step in group.steps if step["kind"] != "copy"]
        turns = [step for step in steps if not group.within(step)]
        box = Box(f"step {last['name']}", last["kind"], group.name)
        box.only_first = last["only_first"]
        box.repeated = self._repeated(turns)
        box.lines = list(dict.fromkeys(line for step in steps for line in self._does(step)))
        box.notes.append(_place(last["source"]))
        for step in steps:
            self._read(step, box)
            self._leave(step, box, group.within(step))
        return box

    def _copy(self, step: Rows) -> Box:
        before, after, texture = step["from"]["result"], step["to"]["result"], step["to"]["texture"]
        box = Box(f"copy {after}", "copy", "copy", [f"of {before}"])
        self._arrow_from(before, box.key, "read")
        port = Port(f"{after} (copied)", after, self._texture(texture), texture, "written", "")
        box.ports.append(port)
        self._makers[after] = box.key, port.key
        return box

    def _does(self, step: Rows) -> Iterator[str]:
        """What a step does, as lines of its box."""
        if step["kind"] == "run":
            yield self._shader(step["shader"])
            return
        yield step["pass"]
        for drawn in step["draws"]:
            if drawn["models"] is not None:
                yield f"draws {drawn['models']}"
            else:
                yield f"draws {self._number(drawn['vertices'])} vertices"
            if drawn["light"] is not None:
                yield f"once for each light of {drawn['light']}"

    def _shader(self, number: int) -> str:
        """The name of a shader, without that of the frame."""
        name: str = self._plan["shaders"][number]["name"]
        return name.removeprefix(f"{self._plan['frame']}.")

    def _repeated(self, steps: Sequence[Rows]) -> str:
        """For what the steps of one equation are repeated; empty if there is only one."""
        if len(steps) == 1:
            return ""
        drawn = [attachments(step)[0] for step in steps if attachments(step)]
        levels, layers = ({target[key] for target in drawn} for key in ("level", "layer"))
        words, turns = [], len(steps)
        for found, word in ((levels, "mip levels"), (layers, self._layers(drawn))):
            if len(found) > 1 and turns % len(found) == 0:
                words.append(f"{len(found)} {word}")
                turns //= len(found)
        return " × ".join([*([f"{turns} turns"] if turns > 1 else []), *words])

    def _layers(self, drawn: Sequence[Rows]) -> str:
        of = {self._plan["textures"][target["texture"]]["dimension"] for target in drawn}
        return "faces" if of == {"cube"} else "layers"

    def _read(self, step: Rows, box: Box) -> None:
        """Add the arrows from what a step reads, and notes of what the frame sets."""
        for drawn in step.get("draws", ()):
            if drawn["models"] is not None:
                self._arrow("given", self._given_models(drawn["models"]), box)
            if drawn["light"] is not None:
                self._arrow("given", self._given("light", drawn["light"], ""), box)
        for use in [use for drawn in step.get("draws", ()) for use in drawn["uses"]] or [step]:
            for row in use["inputs"]:
                self._input(row, box)
        for target in attachments(step):
            if target["over"] is not None:
                # Where others need what was there, it has been copied to where this step draws.
                copied = target["result"] in self._makers
                over = target["result"] if copied else target["over"]
                self._arrow_from(over, box.key, "over")

    def _input(self, row: Rows, box: Box) -> None:
        if "value" in row:
            note = f"{row['name']} = {self._number(row['value'])}"
            if note not in box.notes:
                box.notes.append(note)
            for name in self._parameters(row["value"]):
                self._arrow("given", self._given_parameter(name), box)
        elif "host" in row:
            self._arrow("given", self._given_resource(row["host"]), box)
        elif "previous" in row:
            self._arrow("read", self._given("previous", row["previous"], "of the last frame"), box)
            if row["initially"] is not None and "host" in row["initially"]:
                self._arrow("initial", self._given_resource(row["initially"]["host"]), box)
            elif row["initially"] is not None:
                self._arrow_from(row["initially"]["result"], box.key, "initial")
        else:
            self._arrow_from(row["result"], box.key, "read")

    def _leave(self, step: Rows, box: Box, within: str) -> None:
        """Add what a step leaves, as rows of its box."""
        prefix = f"{within}." if within else ""
        for target in attachments(step):
            what = self._texture(target["texture"])
            self._port(box, target["result"], prefix + target["name"], what, target["texture"],
                       mark_of(target))  # fmt: skip
        for image in step.get("images", ()):
            what = self._texture(image["texture"])
            self._port(box, image["result"], prefix + image["name"], what, image["texture"],
                       "written")  # fmt: skip
        for buffer in step.get("buffers", ()):
            self._port(box, buffer["result"], prefix + buffer["name"], "buffer", None, "written")

    def _port(
        self, box: Box, result: str, name: str, what: str, texture: int | None, mark: MarkKind
    ) -> None:
        """What several steps of a box leave by one name is one row: that of the last of them."""
        row = next((r for r in self._plan["results"] if r["name"] == result), None)
        place = "" if row is None else _place(row["source"])
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

    def _given(self, kind: Any, name: str, line: str) -> str:
        key = f"{kind} {name}"
        if key not in self._host:
            self._host[key] = Box(key, kind, name, [line] if line else [])
        return key

    def _given_models(self, name: str) -> str:
        (row,) = (row for row in self._plan["models"] if row["name"] == name)
        key = self._given("models", name, "")
        self._host[key].lines = [", ".join(row["materials"])]
        self._host[key].notes = [_place(row["source"])]
        return key

    def _given_resource(self, name: str) -> str:
        textures = {row["name"]: row["type"] for row in self._plan["host_textures"]}
        if name in textures:
            return self._declared("texture", name, textures[name])
        (row,) = (row for row in self._plan["host_buffers"] if row["name"] == name)
        return self._declared("buffer", name, row.get("type", "buffer"))

    def _given_parameter(self, name: str) -> str:
        if name in self._lights:
            return self._given("light", self._lights[name], "")
        (row,) = (row for row in self._plan["parameters"] if row["name"] == name)
        return self._declared("parameter", name, row["type"])

    def _declared(self, kind: str, name: str, type_: str) -> str:
        key = self._given(kind, name, type_)
        source = self._plan["sources"].get(name)
        self._host[key].notes = [] if source is None else [_place(source)]
        return key

    def _parameters(self, value: int) -> Iterator[str]:
        """The parameters on which a number depends."""
        names = {step["parameter"] for step in self._plan["values"][value]["steps"]
                 if step["op"] == "parameter"}  # fmt: skip
        return (name for name in sorted(names) if name != EVERYWHERE)

    def _output(self, row: Rows) -> Box:
        box = Box(f"output {row['name']}", "output", row["name"])
        box.lines = [row["doc"]] if row["doc"] else []
        box.notes = [_place(row["source"])]
        self._arrow_from(row["result"], box.key, "read")
        return box

    def _loops(self) -> None:
        """Add the arrows from what is left to what the next frame finds."""
        for kept in self._plan["kept"]:
            target = f"previous {kept['result']}"
            if target in self._host:
                self._arrow_from(kept["result"], target, "back")

    # --- arrows and words ---

    def _arrow(self, kind: ArrowKind, source: str, box: Box) -> None:
        self._arrows[Arrow(source, box.key, kind)] = None

    def _arrow_from(self, result: str, target: str, kind: ArrowKind) -> None:
        """An arrow from what a step leaves; none within a box, whose steps follow each other."""
        maker, port = self._makers[result]
        if maker != target:
            self._arrows[Arrow(maker, target, kind, port)] = None

    def _number(self, value: int) -> str:
        """How a number is computed, in short."""
        node = self._values[value]
        text = self._formulas.text(node)
        return f"{node.type}(…)" if "…" in text else text

    def _texture(self, number: int) -> str:
        return self._what(self._plan["textures"][number])

    def _what(self, texture: Rows) -> str:
        """The format, the size and the layers of a texture."""
        parts = [texture["format"], self._size(texture["size"])]
        if texture["dimension"] == "cube":
            parts.append("cube")
        elif texture["layers"] > 1:
            parts.append(f"{texture['layers']} layers")
        if texture["levels"] > 1:
            parts.append(f"{texture['levels']} levels")
        return " · ".join(parts)

    def _size(self, size: Rows) -> str:
        if size["value"] is None:
            return f"as large as {size['extent_of']}"
        text = self._number(size["value"])
        found = re.fullmatch(r"ivec2\((\d+)(?:, (\d+))?\)", text)
        if found is not None:
            sides = [
                max(int(side) >> size["level"], 1) for side in (found[1], found[2] or found[1])
            ]
            return f"{sides[0]} x {sides[1]}"
        return f"({text}) / {2 ** size['level']}" if size["level"] else text


class _Group(NamedTuple):
    """The steps of one equation, with the copies between them.

    A repeated equation has steps with numbers, such as ``soft.0``, which may have steps of their
    own, ``soft.0.source``; the last turn has no number.
    """

    name: str
    steps: list[Rows]

    def within(self, step: Rows) -> str:
        """The name of a step within a turn of the equation; empty for the turn itself."""
        parts = step["name"].removeprefix(self.name).strip(".").split(".")
        return ".".join(part for part in parts if not re.fullmatch(r"(level)?\d+", part))


_NUMBERED = re.compile(r"(.+?)\.(level)?\d+(\.|$)")
"""The name of one of several steps; the first group is what all of them have in common."""


def _groups(steps: Sequence[Rows]) -> Iterator[_Group]:
    """The steps of each equation; a copy belongs to the step behind it, if that is not the first
    one of its equation, and otherwise stands alone."""
    repeated = {found[1] for step in steps if (found := _NUMBERED.match(step.get("name", "")))}
    group = _Group("", [])
    copies: list[Rows] = []
    for step in steps:
        if step["kind"] == "copy":
            copies.append(step)
            continue
        name = _base(step["name"], repeated)
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


def _place(source: Rows) -> str:
    return f"{source['file']}:{source['line']}:{source['column']}"
