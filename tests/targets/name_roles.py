"""Programs in which given words are names in one role: parameters, functions, textures and so on.

``test_every_name.py`` has the real compilers read the texts of these programs. Each program
computes something different with each name, so that no two are merged and none is left out.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

Words = Sequence[str]

RESERVED = frozenset({"and", "else", "false", "if", "mod", "not", "or", "then", "true"})
"""The words that are never names in Burnish."""
IN_RECORDS = frozenset({"material", "inherited"})
"""The words that have a meaning of their own in records."""
SURFACE = frozenset(
    {"alpha", "clip_position", "color", "eye", "normal", "position", "to_eye", "uv"}
)  # fmt: skip
"""The slots of the surface: a material can declare them, but they have a type and a meaning."""
TYPES = frozenset({"float", "int", "vec2", "vec3", "rgb"})
"""The types that the programs below use: a structure of that name would hide them."""


@dataclass(frozen=True)
class Role:
    """A place in the language where a word can be a name."""

    program: Callable[[Words], str]
    """The source in which each word is a name in this role."""
    refused: frozenset[str] = frozenset()
    """Words that Burnish itself does not take here, or that mean something else."""
    at_once: int = 600
    """The number of words that one program takes; some tools need very long for very long texts."""
    in_hlsl: int = 600
    """The number of words that DXC takes at once; 0: none of them."""


def _lines(line: str, words: Words, between: str = "\n") -> str:
    """``line`` for each word; ``{w}`` is the word and ``{i}`` its number, which starts at 1."""
    return between.join(line.format(w=word, i=number) for number, word in enumerate(words, 1))


def _material(declarations: str, members: str, term: str, words: Words) -> str:
    """A material whose alpha is the sum of a term for each word."""
    alpha = _lines(term, words, "\n + ")
    return f"{declarations}\nmaterial Subject_ {{\n{members}\nalpha = {alpha}\n}}\n"


def _parameters(words: Words) -> str:
    return _material("", _lines("param {w} : float", words), "uv.x * {w}", words)


def _groups(words: Words) -> str:
    members = _lines("param value_{i} : float per {w}", words)
    return _material("", members, "uv.x * value_{i}", words)


def _slots(words: Words) -> str:
    return _material("", _lines("{w} = uv.x * {i} + uv.y", words), "{w} * {w}", words)


def _functions(words: Words) -> str:
    """Every other function is a term. The arguments and the parts have other ones of the words."""
    declared = []
    for at, word in enumerate(words):
        kind, result = ("term", "") if at % 2 else ("fn", " -> float")
        argument, part = words[at - 1], words[at - 2]
        body = f"({argument} * {at} + y_) * {part} + {part} * y_"
        declared.append(
            f"{kind} {word}({argument}: float, y_: float){result} = {body}"
            f" where {{ {part} = {argument} - {at} * y_ * y_ }}"
        )
    return _material("\n".join(declared), "", "{w}(uv.x, uv.y) * {w}(uv.y, uv.x)", words)


def _structures(words: Words) -> str:
    declared = _lines("struct {w} {{ first_: float second_: vec2 }}", words)
    members = _lines("param value_{i} : {w}[2]", words)
    term = "uv.x * value_{i}[int(uv.y)].first_"
    return _material(declared, members, term, words)


def _members(words: Words) -> str:
    declared = f"struct Kind_ {{ {_lines('{w} : float', words)} }}"
    members = "param value_ : Kind_\nparam values_ : Kind_[2]"
    term = "uv.x * (value_.{w} + values_[int(uv.y)].{w})"
    return _material(declared, members, term, words)


def _textures(words: Words) -> str:
    members = _lines("map {w} : texture2d", words)
    return _material("", members, "{w}(uv).r", words)


def _attributes(words: Words) -> str:
    return _material("", _lines("attribute {w} : float", words), "{w} * {i}", words)


def _varyings(words: Words) -> str:
    members = "attribute start_ : vec2\n" + _lines(
        "{w} = @vertex (start_.x * start_.x * {i})", words
    )
    return _material("", members, "{w} * {w}", words)


DIRECTION = "normalize(vec3(0, 0, 1))"
LIT = f"to_light = {DIRECTION} falloff = uv.x * (place_ + {{i}})"
"""The definitions by which a light of the programs below uses its parameter."""


def _lights(words: Words) -> str:
    declared = f"light Lamp_ : Light {{ param place_ : float {LIT.format(i=1)} }}\n"
    rig = f"rig Rig_ {{\n{_lines('{w} : Lamp_[2]', words)}\n}}\n"
    term = "term lit_() per light = light.falloff\n"
    return f"{declared}{rig}{term}material Subject_ {{ alpha = lit_() }}"


def _kinds_of_lights(words: Words) -> str:
    light = f"light {{w}} : Light {{{{ param place_ : float {LIT.format(i='{i}')} }}}}"
    rig = f"rig Rig_ {{\n{_lines('lamps_{i} : {w}[2]', words)}\n}}\n"
    term = "term lit_() per light = light.falloff\n"
    return f"{_lines(light, words)}{rig}{term}material Subject_ {{ alpha = lit_() }}"


def _parameters_of_lights(words: Words) -> str:
    parameters = _lines("param {w} : float", words)
    falloff = _lines("{w} * {w}", words, " + ")
    slots = f"{parameters}\nfalloff = uv.x * ({falloff})\nto_light = {DIRECTION}"
    rig = "rig Rig_ { lamp_ : Lamp_[2] }\n"
    term = "term lit_() per light = light.falloff\n"
    return f"light Lamp_ : Light {{ {slots} }}\n{rig}{term}material Subject_ {{ alpha = lit_() }}"


def _targets(words: Words) -> str:
    targets = _lines("target {w} : r32f = uv.x * {i}", words)
    return f"pass Pass_ {{\n{targets}\n}}\nmaterial Subject_ {{}}"


def _host_blocks(words: Words) -> str:
    declared = _lines(
        "extern block {w} at group 0, binding {i} {{ value_{i} : float at 0 }}", words
    )
    return _material(declared, "", "uv.x * value_{i}", words)


def _host_members(words: Words) -> str:
    members = "\n".join(f"{word} : float at {4 * at}" for at, word in enumerate(words))
    declared = f"extern block Block_ at group 0, binding 200 {{ {members} }}"
    return _material(declared, "", "uv.x * {w}", words)


def _loops(words: Words) -> str:
    fold = "sum {w} in 0..count_ up to 4 : if {w} > 1 then uv.x else uv.y * {i}"
    iteration = "iterate {w} from uv.x up to 4 while {w} < {i} : {w} * {w} + 1"
    return _material("", "param count_ : int", f"({fold})\n + ({iteration})", words)


def _kernel(members: str, term: str, words: Words) -> str:
    """A kernel that writes the sum of a term for each word."""
    found = _lines(term, words, "\n + ")
    return f"kernel Subject_ {{\n{members}\nresult found_ : float[16] = {found}\n}}\n"


def _buffers(words: Words) -> str:
    return _kernel(_lines("buffer {w} : float[]", words), "{w}[index] * {i}", words)


def _results(words: Words) -> str:
    """Beside functions of the text that join a work group."""
    members = _lines("result {w} : float[16] = float(index) * {i}", words)
    joined = "result joined_ : float[16] = group_sum(float(index))"
    return _kernel(f"{members}\n{joined}", "{i} * 0.5", words)


def _scatters(words: Words) -> str:
    members = _lines("scatter {w} : uint[16] add {i}u at index", words)
    return _kernel(members, "{i} * 0.5", words)


NAMES_OF_VALUES = SURFACE | IN_RECORDS

NAMES_IN_KERNELS = IN_RECORDS | {"float", "index", "texel", "group_sum"}

ROLES: Mapping[str, Role] = {
    "parameter": Role(_parameters, NAMES_OF_VALUES),
    "group": Role(_groups),
    "slot": Role(_slots, NAMES_OF_VALUES),
    # glslang's time for HLSL grows with the square of the number of functions.
    "function, argument and part": Role(_functions, IN_RECORDS, in_hlsl=200),
    "structure": Role(_structures, IN_RECORDS | TYPES),
    "member": Role(_members),
    # glslang takes bindings of samplers below 80.
    "texture": Role(_textures, NAMES_OF_VALUES | {"vec2", "vec3", "vec4"}, at_once=80),
    "attribute": Role(_attributes, NAMES_OF_VALUES, in_hlsl=29),
    "varying": Role(_varyings, NAMES_OF_VALUES, in_hlsl=100),
    "light": Role(_lights),
    "kind of light": Role(_kinds_of_lights, NAMES_OF_VALUES | {"Light"}),
    "parameter of a light": Role(_parameters_of_lights, NAMES_OF_VALUES),
    # Direct3D takes 8 targets. In HLSL they are members of a structure, as varyings are.
    "target": Role(_targets, in_hlsl=0),
    "host block": Role(_host_blocks, NAMES_OF_VALUES),
    "host member": Role(_host_members, NAMES_OF_VALUES),
    # What kernels read and write has numbers of bindings, of which a device has few.
    "buffer": Role(_buffers, NAMES_IN_KERNELS, at_once=200),
    "result": Role(_results, NAMES_IN_KERNELS, at_once=200),
    "scatter": Role(_scatters, NAMES_IN_KERNELS, at_once=120),
    "index of a fold and state of an iteration": Role(_loops, frozenset({"uv"}), at_once=200),
}
