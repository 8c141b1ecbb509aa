"""Tables of expressions that consist of a text and operands, by the type of their result.

A form is typed as a person would read the manual: the operands have exactly these types.
"""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from functools import cache
from itertools import product

from burnish.compiler.ir.signatures import (
    FAMILIES,
    FIXED,
    TEXTURE_FAMILIES,
    dependent,
    is_factor,
    parsed,
)
from burnish.compiler.ir.types import MATRICES as ALL_MATRICES
from burnish.compiler.ir.types import Type
from burnish.compiler.semantics.checking.expressions import OPERATORS
from burnish.stdlib.builtins import BUILTINS

from .scope import FRAGMENT, GROUPS, LIGHT, LIT, SPACES, SURFACE, TRANSFORMS, UNIFORM

SIZES = (2, 3, 4)
FLOATS = ("float", "vec2", "vec3", "vec4")
INTS, UINTS, BOOLS = (
    (kind, *(f"{kind[0]}vec{n}" for n in SIZES)) for kind in ("int", "uint", "bool")
)
SQUARE_MATRICES = ("mat2", "mat3", "mat4")
MATRICES = tuple(map(str, ALL_MATRICES))
NUMBERS = (*FLOATS, *INTS, *UINTS)
TYPES = (*NUMBERS, *BOOLS, *SQUARE_MATRICES, "mat3x2", "mat4x3")
"""Types that programs ask for. Matrices of other shapes are made on the way to these."""
"""The types of bare numbers."""
GEOMETRIC = (
    "rgb", "angle", "point<world>", "vector<world>", "direction<world>", "normal<world>",
    "point<object>", "vector<object>",
)  # fmt: skip
"""Types that say what a value means."""

_PREFIXES = {"neg": "-", "bit_not": "~", "not": "not "}
_CONVERSIONS = ("to_float", "to_int", "to_uint")


@dataclass(frozen=True)
class Rule:
    """One way to make a value."""

    result: str
    form: str
    operands: tuple[str, ...]
    role: str
    """The name of a builtin, or the kind of the form."""
    needs: frozenset[str] = frozenset()


@cache
def rules_of(result: str) -> Mapping[str, tuple[Rule, ...]]:
    """The ways to make a value of a type, by role."""
    found: defaultdict[str, list[Rule]] = defaultdict(list)
    for rule in _all_rules():
        if rule.result == result:
            found[rule.role].append(rule)
    return {role: tuple(rules) for role, rules in found.items()}


@cache
def _all_rules() -> tuple[Rule, ...]:
    return (*_builtins(), *_constructors(), *_swizzles(), *_meanings())


# --- builtins ------------------------------------------------------------------------------------


def _builtins() -> Iterator[Rule]:
    infix = {builtin: symbol for symbol, builtin in OPERATORS.items()}
    for name, row in BUILTINS.items():
        if row.method is not None or name == "nonzero":
            continue
        needs = frozenset({UNIFORM} if row.uniform_control_flow else ())
        needs |= {FRAGMENT} if row.compares_pixels else {GROUPS} if row.of_group else set()
        for types, type_ in instances(name):
            operands, result = tuple(map(str, types)), str(type_)
            places = ", ".join("{}" for _ in operands)
            form = f"{name}({places})"
            if name in infix:
                form = f"({{}} {infix[name]} {{}})"
            elif name in _PREFIXES:
                form = f"({_PREFIXES[name]}{{}})"
            elif name in _CONVERSIONS:
                form = f"{result}({places})"
            yield Rule(result, form, operands, name, needs)


@cache
def instances(name: str) -> tuple[tuple[tuple[Type, ...], Type], ...]:
    """The types of operands that a builtin accepts, textures aside, with that of the result."""
    found: dict[tuple[Type, ...], Type] = {}
    for signature in BUILTINS[name].signatures:
        words, result = parsed(signature)
        for bound in _bindings(words):
            types = tuple(t for word in words if (t := _stands_for(word, bound)) is not None)
            made = _stands_for(result, bound)
            if made is not None and len(types) == len(words):
                found.setdefault(types, made)
    return tuple(found.items())


def _bindings(words: Iterable[str]) -> Iterator[dict[str, Type]]:
    """Types for the letters of a signature that are free."""
    letters: dict[str, tuple[Type, ...]] = {
        word: FAMILIES[word].types() if word in FAMILIES else ALL_MATRICES
        for word in words
        if word in FAMILIES or word in "MZ"
    }
    if not any(word in TEXTURE_FAMILIES for word in words):
        for types in product(*letters.values()):
            yield dict(zip(letters, types, strict=True))


def _stands_for(word: str, bound: dict[str, Type]) -> Type | None:
    if word == "Z" and not is_factor(bound["M"], bound["Z"]):
        return None
    return bound.get(word) or FIXED.get(word) or dependent(word, bound)


# --- what is made of parts -----------------------------------------------------------------------


def _constructors() -> Iterator[Rule]:
    for scalar, vectors in ((t[0], t[1:]) for t in (FLOATS, INTS, UINTS, BOOLS)):
        two, three, four = vectors
        joined: dict[str, list[tuple[str, ...]]] = {
            two: [(scalar, scalar)],
            three: [(scalar,) * 3, (two, scalar), (scalar, two)],
            four: [(scalar,) * 4, (three, scalar), (two, two), (scalar, two, scalar)],
        }
        for type_, ways in joined.items():
            for operands in (*ways, (scalar,)):
                yield Rule(type_, f"{type_}({_places(operands)})", operands, "constructor")
        for smaller, larger in ((two, three), (two, four), (three, four)):
            yield Rule(smaller, f"{smaller}({{}})", (larger,), "constructor")
    for matrix, type_ in zip(ALL_MATRICES, MATRICES, strict=True):
        columns = (str(matrix.column),) * matrix.columns
        yield Rule(type_, f"{type_}({_places(columns)})", columns, "constructor")
        yield Rule(type_, f"{type_}({{}})", ("float",), "constructor")
        for other in MATRICES:
            if other != type_:
                yield Rule(type_, f"{type_}({{}})", (other,), "constructor")
    for kind in ("float", "int", "uint"):
        yield Rule("bool", "bool({})", (kind,), "constructor")
        yield Rule(kind, f"{kind}({{}})", (kind,), "constructor")


def _places(operands: tuple[str, ...]) -> str:
    return ", ".join("{}" for _ in operands)


def _swizzles() -> Iterator[Rule]:
    picks = {1: ("x", "y", "r"), 2: ("yx", "xx", "xy", "rg"), 3: ("yxy", "xxy"), 4: ("xyyx",)}
    wide = {1: ("z", "b"), 2: ("zx", "yz"), 3: ("zyx", "bgr", "xzz"), 4: ("zyxx",)}
    for types in (FLOATS, INTS, UINTS, BOOLS):
        for source in types[1:]:
            for lanes, result in enumerate(types, 1):
                allowed = picks[lanes] + (wide[lanes] if source[-1] in "34" else ())
                for lanes_text in allowed:
                    yield Rule(result, f"{{}}.{lanes_text}", (source,), "swizzle")
            for index in ("{} mod " + source[-1], "clamp({}, 0, 1)", "{}"):
                yield Rule(types[0], f"{{}}[{index}]", (source, "int"), "index")
    for matrix, type_ in zip(ALL_MATRICES, MATRICES, strict=True):
        column = str(matrix.column)
        yield Rule(column, "{}[{} mod " + str(matrix.columns) + "]", (type_, "int"), "index")
        yield Rule(column, "{}[1]", (type_,), "index")


# --- what values mean ----------------------------------------------------------------------------

_N = frozenset[str]()
_S, _F = frozenset({SURFACE}), frozenset({FRAGMENT})
_BENCH, _TURNED = frozenset({SURFACE, SPACES}), frozenset({TRANSFORMS})
_EVERYWHERE = frozenset({SURFACE, FRAGMENT, LIT, LIGHT})
_LIT, _LIGHT = frozenset({SURFACE, LIT}), frozenset({SURFACE, LIGHT})

_MEANINGS: Mapping[str, tuple[tuple[str, tuple[str, ...], frozenset[str]], ...]] = {
    "rgb": (
        ("#c08040", (), _N), ("#3af", (), _N), ("rgb({})", ("vec3",), _N),
        ("({} * {})", ("rgb", "float"), _N), ("({} + {})", ("rgb", "rgb"), _N),
        ("({} * {})", ("rgb", "rgb"), _N), ("saturate({})", ("rgb",), _N),
        ("mix({}, {}, {})", ("rgb", "rgb", "float"), _N),
        ("({} as rgb)", ("vec3",), _N), ("ambient({})", ("rgb",), _LIT),
        ("lambert({})", ("rgb",), _LIT), ("phong({}, {})", ("rgb", "float"), _LIT),
        ("blinn_phong({}, 8)", ("rgb",), _LIT), ("light.diffuse", (), _LIGHT),
        ("light.specular", (), _LIGHT),
        ("(lambert({}) with {{{{ normal = {} }}}})", ("rgb", "normal<world>"), _LIT),
        ("(phong({}, 4) with {{{{ to_eye = {} }}}})", ("rgb", "direction<world>"), _LIT),
    ),
    "angle": (
        ("30deg", (), _N), ("0.5rad", (), _N), ("0.1turn", (), _N),
        ("angle({})", ("float",), _N), ("({} + {})", ("angle", "angle"), _N),
        ("({} * {})", ("angle", "float"), _N), ("asin({})", ("float",), _N),
        ("atan2({}, {})", ("float", "float"), _N),
    ),
    "point<world>": (
        ("position", (), _S), ("eye", (), _S),
        ("({} + {})", ("point<world>", "vector<world>"), _N),
        ("({} - {})", ("point<world>", "vector<world>"), _N),
        ("mix({}, {}, {})", ("point<world>", "point<world>", "float"), _N),
        ("({} as point<world>)", ("vec3",), _N),
        ("({} in world)", ("point<object>",), _S),
    ),
    "point<object>": (
        ("object_position", (), _S), ("({} as point<object>)", ("vec3",), _N),
        ("({} + {})", ("point<object>", "vector<object>"), _N),
    ),
    "vector<object>": (
        ("({} - {})", ("point<object>", "point<object>"), _N),
        ("({} as vector<object>)", ("vec3",), _N),
        ("({} * {})", ("vector<object>", "float"), _N),
    ),
    "vector<world>": (
        ("({} - {})", ("point<world>", "point<world>"), _N),
        ("({} + {})", ("vector<world>", "vector<world>"), _N),
        ("({} * {})", ("vector<world>", "float"), _N),
        ("cross({}, {})", ("vector<world>", "vector<world>"), _N),
        ("reflect({}, {})", ("vector<world>", "normal<world>"), _N),
        ("({} in world)", ("vector<object>",), _S),
        ("({} as vector<world>)", ("vec3",), _N),
    ),
    "direction<world>": (
        ("to_eye", (), _S), ("normalize({})", ("vector<world>",), _N),
        ("light.to_light", (), _LIGHT),
    ),
    "normal<world>": (
        ("normal", (), _S), ("(-{})", ("normal<world>",), _N),
        ("normalize(({} as normal<world>))", ("vec3",), _N),
    ),
    "float": (
        ("250mm", (), _N),
        ("dot({}, {})", ("direction<world>", "normal<world>"), _N),
        ("distance({}, {})", ("point<world>", "point<world>"), _N),
        ("fwidth({})", ("float",), frozenset({UNIFORM, FRAGMENT})),
        ("length({})", ("vector<world>",), _N), ("float({})", ("angle",), _N),
        ("cos({})", ("angle",), _N), ("{}.x", ("rgb",), _N),
        ("frag_coord.x", (), _F), ("frag_coord.z", (), _F),
        ("light.falloff", (), _LIGHT),
    ),
    "vec2": (("uv", (), _S), ("frag_coord.xy", (), _F)),
    "vec3": (
        ("vec3({})", ("rgb",), _N), ("vec3({})", ("point<world>",), _N),
        ("vec3({})", ("direction<world>",), _N),
        ("vec3({})", ("normal<world>",), _N),
        ("vec3({})", ("vector<world>",), _N),
        ("vec3({} in bench)", ("point<world>",), _BENCH),
        ("vec3({} in bench)", ("vector<world>",), _BENCH),
        ("normalize(nonzero(vec3(1.5, {})))", ("vec2",), _N),
        ("turned(vec3(0, 1, 0), {}, vec3({}))", ("angle", "vec3"), _TURNED),
    ),
    "vec4": (
        ("vec4(rgba({}, {}))", ("rgb", "float"), _N),
        ("vec4(#80c0ff40)", (), _N), ("frag_coord", (), _F),
    ),
    "mat4": (
        ("mat4(object_to_world)", (), _S),
        ("mat4(rotation(vec3(0, 1, 0), {}))", ("angle",), _TURNED),
        ("mat4(translation(vec3({})))", ("vec3",), _TURNED),
    ),
    "bool": (("front_facing", (), _F),),
    "uint": (("instance_index", (), _S), ("vertex_index", (), _S)),
}  # fmt: skip


def _meanings() -> Iterator[Rule]:
    for result, rows in _MEANINGS.items():
        for form, operands, needs in rows:
            role = "meaning" if needs <= _EVERYWHERE else "rare meaning"
            yield Rule(result, form.format(*map(_bare, operands)), operands, role, needs)


def _bare(operand: str) -> str:
    """The place of an operand. That of a number takes the meaning away that a function gave it."""
    return f"{operand}({{}})" if operand in FLOATS else "{}"
