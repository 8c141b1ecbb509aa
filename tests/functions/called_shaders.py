"""Whole shaders that call functions as an engine does, to be drawn and judged like all others.

A probe is a pass whose targets show slots of a material: its shader says what they mean. Its texts
are replaced by others that have the same interface. These compute what an engine has of a surface,
place each vertex as the functions say, and call a function for each target.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Any

import burnish
from burnish.api.compiled import CompiledMaterial
from burnish.api.compiled_functions import CompiledFunctions
from burnish.compiler.documents.backends import BackendRow
from burnish.compiler.documents.functions import ArgumentRow, FunctionRow, FunctionTextRow
from burnish.compiler.documents.reflection import Reflection
from burnish.compiler.ir.shader import Shader

from .called_languages import LANES, WGSL, Between, CallingLanguage

PASS = "Called"
HIDDEN = "is_hidden"
"""The role of the slot that is what the material's own pass discards, which a probe is not."""
TARGETS = 8
"""The targets that a pass may have."""

SHOWN: Mapping[str, str] = {
    "float": "vec4(vec3({0}), 1)",
    "int": "vec4(vec3(float({0})), 1)",
    "uint": "vec4(vec3(float({0})), 1)",
    "bool": "vec4(vec3(if {0} then 1.0 else 0.0), 1)",
    "vec2": "vec4(vec2({0}), 0, 1)",
    "vec3": "vec4(vec3({0}), 1)",
    "vec4": "vec4({0})",
}
"""A target of a slot in Burnish, by the type on the machine."""


class UncallableError(Exception):
    """A function takes what the engine in these shaders does not have."""


@dataclass(frozen=True)
class Text:
    """The text of a stage."""

    name: str
    text: str
    entry_points: Mapping[Any, str]
    target: str
    profile: str
    spans: Mapping[int, Any] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Called:
    """A probe whose texts call functions. Its bounds are those of the source."""

    whole: CompiledMaterial
    files: Sequence[Any]
    language: CallingLanguage

    @property
    def name(self) -> str:
        return self.whole.name

    @property
    def lacking(self) -> Mapping[str, str]:
        return self.whole.lacking

    @property
    def reflection(self) -> Reflection:
        return self.whole.reflection

    @property
    def shader(self) -> Shader:
        return self.whole.shader

    def emitted(self, profile: str) -> Shader:
        """What the texts compute: the same in another order, within the bounds of the source."""
        assert profile == self.language.profile
        return self.whole.shader


def subjects(
    source: str,
    material: str,
    folder: Path,
    slots: Sequence[str] = (),
    language: CallingLanguage = WGSL,
) -> Iterator[tuple[str, Called]]:
    """The subjects for some slots of a material, or for its usual ones.

    Functions are left out that take what there is not here. Raises ``CompileError``.
    """
    found = burnish.functions(
        source, language.profile, material=material, slots=slots, search_path=[folder]
    )
    for made in found:
        varying = {row.given for row in made.document.arguments if row.source == "varying"}
        rows = [
            row
            for row in made.document.functions
            if row.stage == "fragment" and row.name not in varying
            and row.slots[0].representation in SHOWN and row.slots[0].role != HIDDEN
        ]  # fmt: skip
        for start in range(0, len(rows), TARGETS):
            part = rows[start : start + TARGETS]
            called = _called(source, folder, made, part, language)
            if called is not None:
                yield f"{material}.{start}", called


def _called(
    source: str,
    folder: Path,
    made: CompiledFunctions,
    rows: Sequence[FunctionRow],
    language: CallingLanguage,
) -> Called | None:
    """The subject for some slots; ``None`` if none of their functions can be called here."""
    targets = "".join(
        f"    target shown_{row.name} : rgba32f = "
        f"{SHOWN[row.slots[0].representation].format(f'material.{row.name}')}\n"
        for row in rows
    )
    (whole,) = burnish.compile(
        f"{source}\npass {PASS} {{\n{targets}}}\n", [language.profile], material=made.name,
        pass_=PASS, hoist=False, search_path=[folder],
    ).materials  # fmt: skip
    writer = _Writer(whole, made, language)
    callable_ = [row for row in rows if writer.can_call(row)]
    if not callable_:
        return None
    if len(callable_) < len(rows):
        return _called(source, folder, made, callable_, language)
    texts = {"fragment": writer.fragment(rows), "vertex": writer.vertex()}
    files = [
        Text(file.name, texts[file.stage], file.entry_points, file.target, file.profile)
        for file in whole.files
    ]
    return Called(whole, files, language)


class _Writer:
    """Writes the stages of one probe; what pixels need is known when vertices are written."""

    def __init__(
        self, whole: CompiledMaterial, made: CompiledFunctions, language: CallingLanguage
    ) -> None:
        self._language = language
        self._backend: BackendRow = whole.reflection.backends[language.profile]
        self._blocks = {row.name: row.block for row in whole.reflection.parameters}
        self._made = made
        texts = {file.stage: file.text for file in whole.files}
        self._interface = language.interface(texts["vertex"], texts["fragment"])
        self._row = made.document.backends[language.profile]
        self._arguments = {row.name: row for row in made.document.arguments}
        self._functions = {row.name: row for row in made.document.functions}
        self._between: dict[str, Between] = {}

    def can_call(self, row: FunctionRow) -> bool:
        """True if there is all that a function takes, and what places the vertices."""
        try:
            self.fragment([row])
            self.vertex()
        except UncallableError:
            return False
        finally:
            self._between.clear()
        return True

    def fragment(self, rows: Sequence[FunctionRow]) -> str:
        shown = [
            (f"shown_{row.name}", self._language.shown[row.slots[0].representation].format(value))
            for row, value in [(row, self._call(row)) for row in rows]
        ]
        return self._whole("fragment", self._language.fragment(self._between.values(), shown))

    def vertex(self) -> str:
        names = {
            row.slots[0].role: row for row in self._functions.values() if row.stage == "vertex"
        }
        if "position" in names:
            place = self._call(names["position"])
        elif "object_position" in names:
            place = self._transformed(self._call(names["object_position"]), 1)
        else:
            place = self._transformed(self._input("vertex_position"), 1)
        clip = f"{self._parameter('view_projection')} * {self._language.vec4}(place, 1.0)"
        if "clip_position" in names:
            clip = self._call(names["clip_position"])
        between = list(self._between.values())
        whole = self._language.vertex(self._interface.inputs, between, place, clip)
        return self._whole("vertex", whole)

    def _whole(self, stage: str, entry: Iterable[str]) -> str:
        """The text of a stage: without the functions for others, which may have derivatives."""
        emission = self._made.file(self._language.profile).emission
        own = [
            each.part for each in emission.functions if self._functions[each.name].stage == stage
        ]
        needed = {name for part in own for name in part.needs}
        every = (*emission.helpers, *(each.part for each in emission.functions))
        texts = [each.text for each in every if each.name in needed or each in own]
        return "\n".join([*self._interface.head, *texts, *entry, ""])

    # --- values ----------------------------------------------------------------------------------

    def _call(self, row: FunctionRow) -> str:
        text: FunctionTextRow = self._row.functions[row.name]
        values = []
        for each in text.arguments:
            if each.kind == "value":
                values.append(self._value(self._arguments[each.given], row.stage))
            else:
                kinds = self._backend.textures if each.kind == "texture" else self._backend.samplers
                if each.given not in kinds:
                    raise UncallableError(f"the probe does not read {each.given}")
                values.append(kinds[each.given].identifier)
        return f"{text.identifier}({', '.join(values)})"

    def _value(self, row: ArgumentRow, stage: str) -> str:
        if "[" in row.representation or row.members:
            raise UncallableError(f"{row.name} is laid out in another way in a block")
        if row.source == "parameter":
            value = self._parameter(row.given)
            if row.representation.startswith("mat") and "4" not in row.representation:
                raise UncallableError(f"{row.name} is laid out in another way in a block")
            return f"({value} != 0u)" if row.representation == "bool" else value
        if row.source == "pipeline":
            if stage == "vertex":
                return self._input(row.given)
            if row.given not in self._language.builtins:
                raise UncallableError(f"pixels have no {row.given}")
            return self._language.builtins[row.given]
        if stage == "vertex":
            return self._input(row.given)
        if row.representation not in LANES:
            raise UncallableError(f"a {row.representation} is not interpolated")
        name = f"given_{row.name}"
        is_flat = row.interpolation == "flat" or row.representation[0] in "iu"
        value = self._at_vertices(row)
        self._between[name] = Between(name, row.representation, is_flat, value)
        return self._language.input.format(name)

    def _at_vertices(self, row: ArgumentRow) -> str:
        """What a vertex hands to pixels, as an engine has it."""
        if row.source == "varying":
            return self._call(self._functions[row.given])
        if row.source == "attribute":
            return self._input(row.given)
        return self._of_surface(row.given)

    def _of_surface(self, word: str) -> str:
        if word == "uv":
            return self._input("vertex_uv")
        if word == "position":
            return "place"
        if word == "normal":
            matrix = self._parameter("object_to_world")
            return f"matrix_of_normals({matrix}) * {self._input('vertex_normal')}"
        assert word == "tangent"
        return self._transformed(f"{self._input('vertex_tangent')}.xyz", 0)

    def _transformed(self, value: str, w: int) -> str:
        """A place (``w`` is 1) or a vector of the object in the world."""
        matrix = self._parameter("object_to_world")
        return f"({matrix} * {self._language.vec4}({value}, {w}.0)).xyz"

    def _input(self, name: str) -> str:
        row = self._backend.vertex_inputs.get(name)
        identifier = name if row is None else row.identifier
        if self._language.member.format(identifier) not in self._interface.inputs:
            raise UncallableError(f"the probe has no input {name}")
        return self._language.input.format(identifier)

    def _parameter(self, given: str) -> str:
        name, *path = given.split(".")
        block = self._blocks.get(name)
        if block is None:
            raise UncallableError(f"the probe does not read {name}")
        row = self._backend.blocks[block]
        before = self._language.block(self._interface, row.identifier)
        if before is None:
            raise UncallableError(f"the probe has no block {block}")
        # Words of the language have `_` behind them, as names of members.
        steps = (step if self._has_member(step) else f"{step}_" for step in path)
        return before + ".".join((row.members[name], *steps))

    def _has_member(self, name: str) -> bool:
        return self._language.member.format(name) in "\n".join(self._interface.head)


def broken(subject: Called) -> Called:
    """A subject whose first target is wrong by a thousandth, to see that this is found."""
    wrong = rf"\1{subject.language.vec4}(1.001) * \2 + 0.001;"
    files = [
        replace(file, text=re.sub(r"(\bshown_\w+ = )(.*);", wrong, file.text, count=1))
        for file in subject.files
    ]
    return replace(subject, files=files)
