"""Entry points that call every function of a text once, for compilers that take whole shaders.

Values of the surface differ from pixel to pixel, and parameters do not: so what is said about
control flow is said of a text in the way in which an engine uses it.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass

from burnish.api.compiled_functions import CompiledFunctions, FunctionFile
from burnish.compiler.documents.functions import ArgumentRow, ArgumentTextRow, FunctionTextRow
from burnish.targets import registry
from burnish.targets.description.profile import Profile
from burnish.targets.toolchain import Job

STAGES = {"vertex": "vert", "fragment": "frag"}


@dataclass(frozen=True)
class Words:
    """The words of a language for such an entry point."""

    heads: Mapping[str, str]
    """By stage."""
    ends: Mapping[str, str]
    call: str
    uniform: str
    """A variable that is the same everywhere."""
    varying: Mapping[str, str]
    """A value that differs, by the kind of its lanes: of a ``{type}``."""
    texture: str


KINDS = {"bool": "bool", "uint": "uint", "uvec": "uint", "int": "int", "ivec": "int"}
"""The kinds of lanes, by what the types in documents begin with."""
GLSL = Words(
    heads={
        "vertex": "void main() {",
        "fragment": "layout(location = 0) out vec4 color;\nvoid main() {",
    },
    ends={"vertex": "gl_Position = vec4(0.0); }", "fragment": "color = vec4(0.0); }"},
    call="{call};",
    uniform="{type} {name};",
    varying={
        "float": "{type}(differs)", "int": "{type}(int(differs))", "uint": "{type}(uint(differs))",
        "bool": "{type}(differs > 0.5)",
    },
    texture="uniform {type} {name};",
)  # fmt: skip
WGSL = Words(
    heads={
        "vertex": "@vertex fn main(@builtin(vertex_index) number: u32)"
        " -> @builtin(position) vec4f { let differs = f32(number);",
        "fragment": "@fragment fn main(@builtin(position) place: vec4f) -> @location(0) vec4f {"
        " let differs = place.x;",
    },
    ends=dict.fromkeys(STAGES, "return vec4f(0.0); }"),
    call="_ = {call};",
    uniform="let {name} = {type}();",
    varying={
        "float": "{type}(differs)", "int": "{type}(i32(differs))", "uint": "{type}(u32(differs))",
        "bool": "{type}(differs > 0.5)",
    },
    texture="@group(0) @binding({binding}) var {name}: {type};",
)  # fmt: skip
HLSL = Words(
    heads={
        "vertex": "float4 main(uint number : SV_VertexID) : SV_Position { float differs = number;",
        "fragment": "float4 main(float4 place : SV_Position) : SV_Target {"
        " float differs = place.x;",
    },
    ends=dict.fromkeys(STAGES, "return float4(0.0, 0.0, 0.0, 0.0); }"),
    call="{call};",
    uniform="static {type} {name};",
    varying=dict.fromkeys(("float", "int", "uint", "bool"), "({type})differs"),
    texture="{type} {name} : register({register}{binding});",
)
WORDS = {"glsl": GLSL, "wgsl": WGSL, "hlsl": HLSL}


def jobs(compiled: CompiledFunctions) -> Iterator[Job]:
    """A job for each text, stage and compiler."""
    for file in compiled.files:
        profile = registry.load(file.target).profile(file.profile)
        for stage, short in STAGES.items():
            names = [row.name for row in compiled.document.functions if row.stage == stage]
            if names:
                text = calling(compiled, file, profile, stage, names)
                for checker in profile.checkers:
                    yield Job(checker, short, text, "main", f"{file.name} {stage}")


def calling(
    compiled: CompiledFunctions,
    file: FunctionFile,
    profile: Profile,
    stage: str,
    names: Sequence[str],
) -> str:
    """The text with an entry point that calls these functions."""
    key = f"{file.target}:{file.profile}"
    row, words = compiled.document.backends[key], WORDS[file.target]
    functions = [row.functions[name] for name in names]
    rows = {each.name: each for each in compiled.document.arguments}
    globals_, calls = _globals(functions, words, file.target), list[str]()
    locals_: dict[str, str] = {}
    for function in functions:
        given = []
        for each in function.arguments:
            name = f"given_{each.identifier}"
            given.append(name)
            if each.kind == "value":
                locals_[name] = _value(each, name, rows[each.given], words)
        call = f"{function.identifier}({', '.join(given)})"
        calls.append(words.call.format(call=call))
    preamble = (*profile.preamble, *row.requires, *profile.defaults)
    differs = "float differs = gl_FragCoord.x;" if stage == "fragment" else "float differs = 1.0;"
    head = [words.heads[stage], *([differs] if file.target == "glsl" else [])]
    body = [*head, *locals_.values(), *calls, words.ends[stage]]
    parts = [each.part for each in file.emission.functions if each.name in names]
    needed = {name for part in parts for name in part.needs}
    known = [*(each for each in file.emission.helpers if each.name in needed), *parts]
    # In GLSL, no text for vertices may have derivatives, whether they are called or not.
    is_apart = file.target == "glsl" and stage == "vertex"
    whole = "\n\n".join(each.text for each in known) if is_apart else file.text
    return "\n".join([*preamble, whole, *globals_, *body, ""])


def _globals(functions: Iterable[FunctionTextRow], words: Words, target: str) -> list[str]:
    found: dict[str, str] = {}
    for function in functions:
        for each in function.arguments:
            name = f"given_{each.identifier}"
            if each.kind != "value" and name not in found:
                register = "t" if each.kind == "texture" else "s"
                line = words.texture.format(
                    type=each.type, name=name, binding=len(found), register=register
                )
                separate = target == "glsl" and not each.type.startswith(
                    ("sampler2", "sampler3", "samplerC", "isampler", "usampler")
                )
                place = f"layout(set = 0, binding = {len(found)}) " if separate else ""
                found[name] = place + line
    return list(found.values())


def _value(argument: ArgumentTextRow, name: str, row: ArgumentRow, words: Words) -> str:
    """A statement that gives an argument a value."""
    type_ = argument.type
    is_plain = not row.representation.startswith("mat") and "[" not in row.representation
    if row.source == "parameter" or not is_plain:
        if words is HLSL and type_.endswith("]"):
            type_, _, count = type_.partition("[")
            name = f"{name}[{count}"
        return words.uniform.format(type=type_, name=name)
    found = (kind for start, kind in KINDS.items() if row.representation.startswith(start))
    value = words.varying[next(found, "float")].format(type=type_)
    declared = f"let {name}" if words is WGSL else f"{type_} {name}"
    return f"{declared} = {value};"
