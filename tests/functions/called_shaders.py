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

PROFILE = "wgsl:webgpu"
PASS = "Called"
HIDDEN = "is_hidden"
"""The role of the slot that is what the material's own pass discards, which a probe is not."""
TARGETS = 8
"""The targets that a pass may have."""

SHOWN: Mapping[str, tuple[str, str]] = {
    "float": ("vec4(vec3({0}), 1)", "vec4f(vec3f({0}), 1.0)"),
    "int": ("vec4(vec3(float({0})), 1)", "vec4f(vec3f(f32({0})), 1.0)"),
    "uint": ("vec4(vec3(float({0})), 1)", "vec4f(vec3f(f32({0})), 1.0)"),
    "bool": ("vec4(vec3(if {0} then 1.0 else 0.0), 1)", "vec4f(vec3f(select(0.0, 1.0, {0})), 1.0)"),
    "vec2": ("vec4(vec2({0}), 0, 1)", "vec4f({0}, 0.0, 1.0)"),
    "vec3": ("vec4(vec3({0}), 1)", "vec4f({0}, 1.0)"),
    "vec4": ("vec4({0})", "{0}"),
}
"""A target of a slot in Burnish and in WGSL, by the type on the machine."""

WORDS: Mapping[str, str] = {
    "float": "f32", "int": "i32", "uint": "u32",
    **{f"{kind}vec{lanes}": f"vec{lanes}{ending}" for lanes in (2, 3, 4)
       for kind, ending in (("", "f"), ("i", "i"), ("u", "u"))},
}  # fmt: skip
"""Types that vertices can hand to pixels."""
BUILTINS = {"frag_coord": ("position", "vec4f"), "front_facing": ("front_facing", "bool")}
NORMAL = """\
fn matrix_of_normals(m: mat4x4f) -> mat3x3f {
    let columns = mat3x3f(m[0].xyz, m[1].xyz, m[2].xyz);
    let ways = mat3x3f(
        cross(columns[1], columns[2]), cross(columns[2], columns[0]), cross(columns[0], columns[1])
    );
    return ways * (1.0 / determinant(columns));
}"""
"""The inverse transpose of an object's matrix, by which engines turn normals."""


class UncallableError(Exception):
    """A function takes what the engine in these shaders does not have."""


@dataclass(frozen=True)
class Text:
    """The text of a stage."""

    name: str
    text: str
    entry_points: Mapping[Any, str]
    target: str = "wgsl"
    profile: str = "webgpu"
    spans: Mapping[int, Any] = field(default_factory=dict)


@dataclass(frozen=True, eq=False)
class Called:
    """A probe whose texts call functions. Its bounds are those of the source."""

    whole: CompiledMaterial
    files: Sequence[Any]

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
        assert profile == PROFILE
        return self.whole.shader


def subjects(
    source: str, material: str, folder: Path, slots: Sequence[str] = ()
) -> Iterator[tuple[str, Called]]:
    """The subjects for some slots of a material, or for its usual ones.

    Functions are left out that take what there is not here. Raises ``CompileError``.
    """
    found = burnish.functions(source, PROFILE, material=material, slots=slots, search_path=[folder])
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
            called = _called(source, folder, made, part)
            if called is not None:
                yield f"{material}.{start}", called


def _called(
    source: str, folder: Path, made: CompiledFunctions, rows: Sequence[FunctionRow]
) -> Called | None:
    """The subject for some slots; ``None`` if none of their functions can be called here."""
    targets = "".join(
        f"    target shown_{row.name} : rgba32f = "
        f"{SHOWN[row.slots[0].representation][0].format(f'material.{row.name}')}\n"
        for row in rows
    )
    (whole,) = burnish.compile(
        f"{source}\npass {PASS} {{\n{targets}}}\n", [PROFILE], material=made.name, pass_=PASS,
        hoist=False, search_path=[folder],
    ).materials  # fmt: skip
    writer = _Writer(whole, made)
    callable_ = [row for row in rows if writer.can_call(row)]
    if not callable_:
        return None
    if len(callable_) < len(rows):
        return _called(source, folder, made, callable_)
    texts = {"fragment": writer.fragment(rows), "vertex": writer.vertex()}
    files = [Text(file.name, texts[file.stage], file.entry_points) for file in whole.files]
    return Called(whole, files)


class _Writer:
    """Writes the stages of one probe; what pixels need is known when vertices are written."""

    def __init__(self, whole: CompiledMaterial, made: CompiledFunctions) -> None:
        self._backend: BackendRow = whole.reflection.backends[PROFILE]
        self._blocks = {row.name: row.block for row in whole.reflection.parameters}
        self._made = made
        texts = [whole.text("wgsl", "vertex"), whole.text("wgsl", "fragment")]
        self._head, self._inputs = _interface(texts)
        self._row = made.document.backends[PROFILE]
        self._arguments = {row.name: row for row in made.document.arguments}
        self._functions = {row.name: row for row in made.document.functions}
        self._between: dict[str, tuple[str, str, str]] = {}
        """The type, the way of interpolation and the value, by the name between the stages."""

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
        outputs, statements = [], []
        for place, row in enumerate(rows):
            shown = SHOWN[row.slots[0].representation][1].format(self._call(row))
            outputs.append(f"    @location({place}) shown_{row.name}: vec4f,")
            statements.append(f"    output.shown_{row.name} = {shown};")
        head = [
            "    @builtin(position) frag_coord: vec4f,",
            "    @builtin(front_facing) front_facing: bool,",
        ]
        members = [*head, *self._members()]
        return self._whole(
            ["struct FragmentInput {", *members, "}", "struct FragmentOutput {", *outputs, "}"],
            ["@fragment", "fn main(input: FragmentInput) -> FragmentOutput {",
             "    var output: FragmentOutput;", *statements, "    return output;", "}"],
        )  # fmt: skip

    def vertex(self) -> str:
        names = {
            row.slots[0].role: row for row in self._functions.values() if row.stage == "vertex"
        }
        matrix = self._parameter("object_to_world")
        if "position" in names:
            place = self._call(names["position"])
        elif "object_position" in names:
            place = f"({matrix} * vec4f({self._call(names['object_position'])}, 1.0)).xyz"
        else:
            place = f"({matrix} * vec4f({self._input('vertex_position')}, 1.0)).xyz"
        clip = f"{self._parameter('view_projection')} * vec4f(place, 1.0)"
        if "clip_position" in names:
            clip = self._call(names["clip_position"])
        values = [f"    output.{name} = {value};" for name, (_, _, value) in self._between.items()]
        return self._whole(
            [NORMAL, self._inputs, "struct VertexOutput {", *self._members(),
             "    @builtin(position) clip_position: vec4f,", "}"],
            ["@vertex", "fn main(input: VertexInput) -> VertexOutput {",
             "    var output: VertexOutput;", f"    let place = {place};", *values,
             f"    output.clip_position = {clip};", "    return output;", "}"],
        )  # fmt: skip

    def _whole(self, structures: Iterable[str], entry: Iterable[str]) -> str:
        functions = self._made.file(PROFILE).text
        return "\n".join([*self._head, functions, *structures, *entry, ""])

    def _members(self) -> Iterator[str]:
        for place, (name, (type_, way, _)) in enumerate(self._between.items()):
            flat = "@interpolate(flat) " if way == "flat" else ""
            yield f"    @location({place}) {flat}{name}: {type_},"

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
            if row.given not in BUILTINS:
                raise UncallableError(f"pixels have no {row.given}")
            return f"input.{row.given}"
        if stage == "vertex":
            return self._input(row.given)
        if row.representation not in WORDS:
            raise UncallableError(f"a {row.representation} is not interpolated")
        name = f"given_{row.name}"
        way = "flat" if row.interpolation == "flat" or row.representation[0] in "iu" else ""
        self._between[name] = (WORDS[row.representation], way, self._at_vertices(row))
        return f"input.{name}"

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
        matrix = self._parameter("object_to_world")
        if word == "normal":
            return f"matrix_of_normals({matrix}) * {self._input('vertex_normal')}"
        assert word == "tangent"
        return f"({matrix} * vec4f({self._input('vertex_tangent')}.xyz, 0.0)).xyz"

    def _input(self, name: str) -> str:
        row = self._backend.vertex_inputs.get(name)
        identifier = name if row is None else row.identifier
        if f" {identifier}: " not in self._inputs:
            raise UncallableError(f"the probe has no input {name}")
        return f"input.{identifier}"

    def _parameter(self, given: str) -> str:
        name, *path = given.split(".")
        block = self._blocks.get(name)
        if block is None:
            raise UncallableError(f"the probe does not read {name}")
        row = self._backend.blocks[block]
        found = re.search(rf"var<uniform> (\w+): {row.identifier};", "\n".join(self._head))
        if found is None:
            raise UncallableError(f"the probe has no block {block}")
        # Words of the language have `_` behind them, as names of members.
        steps = (step if self._has_member(step) else f"{step}_" for step in path)
        return ".".join((found[1], row.members[name], *steps))

    def _has_member(self, name: str) -> bool:
        return f"    {name}: " in "\n".join(self._head)


def _interface(texts: Iterable[str]) -> tuple[list[str], str]:
    """What both stages declare of blocks and textures, and the structure of vertex inputs."""
    head: dict[str, str] = {}
    inputs = ""
    for paragraph in "\n\n".join(texts).split("\n\n"):
        part = paragraph.strip("\n")
        if part.startswith("struct VertexInput"):
            inputs = part
        elif part.startswith("struct ") and "@location" not in part and "@builtin" not in part:
            head.setdefault(part.split()[1], part)
        elif part.startswith("@group"):
            head |= {line: line for line in part.split("\n")}
    return list(head.values()), inputs


def broken(subject: Called) -> Called:
    """A subject whose first target is wrong by a thousandth, to see that this is found."""
    files = [
        replace(
            file,
            text=re.sub(
                r"(output\.shown_\w+ = )(.*);", r"\1vec4f(1.001) * \2 + 0.001;", file.text, count=1
            ),
        )
        for file in subject.files
    ]
    return replace(subject, files=files)
