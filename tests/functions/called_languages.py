"""Shaders that call functions, as WGSL and GLSL write them: ``called_shaders.py`` fills them in.

Both have the interface of the whole shader whose place they take, so that a runner draws them.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Mapping, Sequence
from typing import NamedTuple, Protocol

LANES = ("float", "int", "uint", *(f"{kind}vec{n}" for n in (2, 3, 4) for kind in ("", "i", "u")))
"""Types that vertices can hand to pixels."""


class Between(NamedTuple):
    """A value that vertices hand to pixels."""

    name: str
    type: str
    is_flat: bool
    value: str
    """How a vertex computes it."""


class Interface(NamedTuple):
    """What the whole shader declares."""

    head: Sequence[str]
    """Blocks, textures and their structures, of both stages."""
    inputs: str
    """The vertex inputs."""


Shown = Sequence[tuple[str, str]]
"""The names of targets, each with its value."""


class CallingLanguage(Protocol):
    """A language for such shaders."""

    profile: str
    shown: Mapping[str, str]
    """A target of a value, by the type on the machine."""
    builtins: Mapping[str, str]
    """The values of the pipeline at a pixel."""
    input: str
    """A vertex input, and what vertices hand to pixels."""
    member: str
    """A member of a block or a structure, as it is declared."""
    vec4: str

    def interface(self, vertex: str, fragment: str) -> Interface: ...
    def block(self, interface: Interface, identifier: str) -> str | None:
        """What stands before a member of a block; ``None`` if there is no such block."""

    def fragment(self, between: Iterable[Between], shown: Shown) -> Iterable[str]: ...
    def vertex(
        self, inputs: str, between: Sequence[Between], place: str, clip: str
    ) -> Iterable[str]: ...


class Wgsl:
    """WGSL for WebGPU."""

    profile = "wgsl:webgpu"
    shown: Mapping[str, str] = {
        "float": "vec4f(vec3f({0}), 1.0)", "int": "vec4f(vec3f(f32({0})), 1.0)",
        "uint": "vec4f(vec3f(f32({0})), 1.0)",
        "bool": "vec4f(vec3f(select(0.0, 1.0, {0})), 1.0)",
        "vec2": "vec4f({0}, 0.0, 1.0)", "vec3": "vec4f({0}, 1.0)", "vec4": "{0}",
    }  # fmt: skip
    builtins: Mapping[str, str] = {
        "frag_coord": "input.frag_coord",
        "front_facing": "input.front_facing",
    }
    input = "input.{0}"
    member = " {0}: "
    vec4 = "vec4f"
    _words: Mapping[str, str] = {
        "float": "f32", "int": "i32", "uint": "u32",
        **{f"{kind}vec{lanes}": f"vec{lanes}{ending}" for lanes in (2, 3, 4)
           for kind, ending in (("", "f"), ("i", "i"), ("u", "u"))},
    }  # fmt: skip
    _normal = """\
fn matrix_of_normals(m: mat4x4f) -> mat3x3f {
    let columns = mat3x3f(m[0].xyz, m[1].xyz, m[2].xyz);
    let ways = mat3x3f(
        cross(columns[1], columns[2]), cross(columns[2], columns[0]), cross(columns[0], columns[1])
    );
    return ways * (1.0 / determinant(columns));
}"""

    def interface(self, vertex: str, fragment: str) -> Interface:
        head: dict[str, str] = {}
        inputs = ""
        for paragraph in f"{vertex}\n\n{fragment}".split("\n\n"):
            part = paragraph.strip("\n")
            if part.startswith("struct VertexInput"):
                inputs = part
            elif part.startswith("struct ") and "@location" not in part and "@builtin" not in part:
                head.setdefault(part.split()[1], part)
            elif part.startswith("@group"):
                head |= {line: line for line in part.split("\n")}
        return Interface(list(head.values()), inputs)

    def block(self, interface: Interface, identifier: str) -> str | None:
        found = re.search(rf"var<uniform> (\w+): {identifier};", "\n".join(interface.head))
        return None if found is None else f"{found[1]}."

    def fragment(self, between: Iterable[Between], shown: Shown) -> Iterable[str]:
        return [
            "struct FragmentInput {",
            "    @builtin(position) frag_coord: vec4f,",
            "    @builtin(front_facing) front_facing: bool,", *self._members(between), "}",
            "struct FragmentOutput {",
            *(f"    @location({n}) {name}: vec4f," for n, (name, _) in enumerate(shown)), "}",
            "@fragment", "fn main(input: FragmentInput) -> FragmentOutput {",
            "    var output: FragmentOutput;",
            *(f"    output.{name} = {value};" for name, value in shown),
            "    return output;", "}",
        ]  # fmt: skip

    def vertex(
        self, inputs: str, between: Sequence[Between], place: str, clip: str
    ) -> Iterable[str]:
        return [
            self._normal, inputs, "struct VertexOutput {", *self._members(between),
            "    @builtin(position) clip_position: vec4f,", "}",
            "@vertex", "fn main(input: VertexInput) -> VertexOutput {",
            "    var output: VertexOutput;", f"    let place = {place};",
            *(f"    output.{each.name} = {each.value};" for each in between),
            f"    output.clip_position = {clip};", "    return output;", "}",
        ]  # fmt: skip

    def _members(self, between: Iterable[Between]) -> Iterator[str]:
        for number, each in enumerate(between):
            flat = "@interpolate(flat) " if each.is_flat else ""
            yield f"    @location({number}) {flat}{each.name}: {self._words[each.type]},"


class Glsl:
    """GLSL for Vulkan."""

    profile = "glsl:vulkan"
    shown: Mapping[str, str] = {
        "float": "vec4(vec3({0}), 1.0)", "int": "vec4(vec3({0}), 1.0)",
        "uint": "vec4(vec3({0}), 1.0)", "bool": "vec4(vec3({0} ? 1.0 : 0.0), 1.0)",
        "vec2": "vec4({0}, 0.0, 1.0)", "vec3": "vec4({0}, 1.0)", "vec4": "{0}",
    }  # fmt: skip
    builtins: Mapping[str, str] = {"frag_coord": "gl_FragCoord", "front_facing": "gl_FrontFacing"}
    input = "{0}"
    member = " {0};"
    vec4 = "vec4"
    _normal = """\
mat3 matrix_of_normals(mat4 m) {
    mat3 columns = mat3(m[0].xyz, m[1].xyz, m[2].xyz);
    mat3 ways = mat3(
        cross(columns[1], columns[2]), cross(columns[2], columns[0]), cross(columns[0], columns[1])
    );
    return ways * (1.0 / determinant(columns));
}"""

    def interface(self, vertex: str, fragment: str) -> Interface:
        both = f"{vertex}\n\n{fragment}"
        head = {line: line for line in both.split("\n") if line.startswith("#")}
        for paragraph in both.split("\n\n"):
            part = paragraph.strip("\n")
            first = part.split("\n")[0]
            if part.startswith("struct ") or (" uniform " in first and first.endswith("{")):
                head.setdefault(first, part)
            elif " uniform " in first:
                head |= {line: line for line in part.split("\n")}
        inputs = re.findall(r"^layout\(location = \d+\) in [^;]*;", vertex, re.M)
        return Interface(list(head.values()), "\n".join(inputs))

    def block(self, interface: Interface, identifier: str) -> str | None:
        return "" if f" uniform {identifier} {{" in "\n".join(interface.head) else None

    def fragment(self, between: Iterable[Between], shown: Shown) -> Iterable[str]:
        return [
            *self._members(between, "in"),
            *(f"layout(location = {n}) out vec4 {name};" for n, (name, _) in enumerate(shown)),
            "void main() {", *(f"    {name} = {value};" for name, value in shown), "}",
        ]  # fmt: skip

    def vertex(
        self, inputs: str, between: Sequence[Between], place: str, clip: str
    ) -> Iterable[str]:
        return [
            self._normal, inputs, *self._members(between, "out"), "void main() {",
            f"    vec3 place = {place};",
            *(f"    {each.name} = {each.value};" for each in between),
            f"    gl_Position = {clip};", "}",
        ]  # fmt: skip

    def _members(self, between: Iterable[Between], way: str) -> Iterator[str]:
        for number, each in enumerate(between):
            flat = "flat " if each.is_flat else ""
            yield f"layout(location = {number}) {flat}{way} {each.type} {each.name};"


WGSL, GLSL = Wgsl(), Glsl()
LANGUAGES: Mapping[str, CallingLanguage] = {each.profile: each for each in (WGSL, GLSL)}
