"""Helpers for the tests of the targets: programs, and the texts that they become."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass

from burnish.compiler.ir import build
from burnish.compiler.ir.build import constant
from burnish.compiler.ir.leaves import Parameter, Texture
from burnish.compiler.ir.node import Graph, Node
from burnish.compiler.ir.program import NativeUse, Program
from burnish.compiler.ir.statements import Let, Region
from burnish.compiler.ir.types import (
    FLOAT,
    INT,
    MATRICES,
    TEXTURES,
    UINT,
    VEC4,
    Matrix,
    Scalar,
    ScalarKind,
    TextureType,
    Type,
    Vector,
    scalar_kind,
    width,
    with_width,
)
from burnish.stdlib.builtins import BUILTINS
from burnish.stdlib.builtins.facts import Fact
from burnish.stdlib.builtins.row import Builtin
from burnish.targets import registry
from burnish.targets.description.profile import Profile
from burnish.targets.description.shading_language import Language
from burnish.targets.emit.emitter import Emission, EmitOptions, emit
from burnish.targets.legalise.lacks import lacks
from burnish.targets.legalise.legalise import legalise
from burnish.targets.legalise.values import needs_wide_integers

from .programs import Maker, block, tiny


@dataclass(frozen=True)
class Selected:
    """A language and one of its profiles."""

    language: Language
    profile: Profile

    def __str__(self) -> str:
        return f"{self.language.name}:{self.profile.name}"


PROFILES = [
    Selected(language, profile)
    for language in map(registry.load, registry.names())
    for profile in language.profiles
]


def printed(program: Program, selected: Selected, options: EmitOptions | None = None) -> Emission:
    """A program, legalised and printed."""
    return emit(legalise(program, selected.language, selected.profile), options)


BY_NAME = {str(selected): selected for selected in PROFILES}


def emitted(
    program: Program, selected: Selected, options: EmitOptions | None = None
) -> dict[str, str]:
    """The texts of a program by stage."""
    return {file.stage: file.text for file in printed(program, selected, options).files}


KINDS: Mapping[str, tuple[ScalarKind, ...]] = {
    "T": ("float",), "S": ("float",), "V": ("float",),
    "N": ("float", "int", "uint"), "I": ("int", "uint"), "B": ("bool",),
    "P": ("float", "int", "uint", "bool"),
}  # fmt: skip
OF_KIND: Mapping[str, ScalarKind] = {"Q": "bool", "U": "uint", "J": "int"}
WIDTHS = {"S": (1,), "V": (2, 3, 4)}
FIXED: Mapping[str, Type] = {
    **{kind: Scalar(kind) for kind in ("float", "int", "uint", "bool")},
    **{str(Vector(kind, n)): Vector(kind, n) for kind in KINDS["P"] for n in (2, 3, 4)},
    **{str(texture): texture for texture in TEXTURES},
    **{str(matrix): matrix for matrix in MATRICES},
}
TEXTURE_LETTERS: Mapping[str, tuple[str, ...]] = {
    "F": ("texture2d", "texture3d", "texture_cube"),
    "D": ("depth2d", "depth_cube"),
    "G": (
        "texture2d", "texture3d", "depth2d",
        "itexture2d", "itexture3d", "utexture2d", "utexture3d",
    ),
    "H": ("texture2d_array", "depth2d_array", "itexture2d_array", "utexture2d_array"),
    "X": tuple(map(str, TEXTURES)),
}  # fmt: skip


def instances(row: Builtin) -> Iterator[tuple[tuple[Type, ...], Type]]:
    """The types of operands and result of every instance of every signature."""
    for signature in row.signatures:
        words, _, result = (part.strip() for part in signature.partition("->"))
        letters = words.split(", ")
        for types in _assignments([*letters, result]):
            yield tuple(types[letter] for letter in letters), types[result]


def _assignments(words: list[str]) -> Iterator[dict[str, Type]]:
    free = [word for word in dict.fromkeys(words) if word in {*KINDS, *TEXTURE_LETTERS, "M", "Z"}]
    choices: list[dict[str, Type]] = [{}]
    for word in free:
        choices = [{**one, word: type_} for one in choices for type_ in _family(word)]
    for one in filter(_can_be_multiplied, choices):
        yield {word: _type(word, one) for word in words}


def _family(word: str) -> list[Type]:
    if word in ("M", "Z"):
        return list(MATRICES)
    if word in TEXTURE_LETTERS:
        return [FIXED[name] for name in TEXTURE_LETTERS[word]]
    widths = WIDTHS.get(word, (1, 2, 3, 4))
    return [with_width(kind, lanes) for kind in KINDS[word] for lanes in widths]


def _can_be_multiplied(chosen: Mapping[str, Type]) -> bool:
    """True where no matrix Z is asked for, or where it has a row for each column of M."""
    left, right = chosen.get("M"), chosen.get("Z")
    if not isinstance(left, Matrix) or not isinstance(right, Matrix):
        return True
    return left.columns == right.rows


def _of_matrix(word: str, matrix: Type, factor: Type | None) -> Type:
    """A column, a row, the transpose of a matrix, or the product of two."""
    assert isinstance(matrix, Matrix)
    if word in "CO":
        return Vector("float", matrix.rows if word == "C" else matrix.columns)
    if word == "A":
        return Matrix(matrix.rows, matrix.columns)
    assert isinstance(factor, Matrix)
    return Matrix(factor.columns, matrix.rows)


def _type(word: str, chosen: Mapping[str, Type]) -> Type:
    if word in chosen:
        return chosen[word]
    if word in "COAY":
        return _of_matrix(word, chosen["M"], chosen.get("Z"))
    if word in "LQUJ" and not any(isinstance(t, TextureType) for t in chosen.values()):
        base = next(type_ for letter, type_ in chosen.items() if letter in "NTIP")
        assert isinstance(base, Scalar | Vector)
        return Scalar(base.kind) if word == "L" else with_width(OF_KIND[word], width(base))
    texture = next((type_ for type_ in chosen.values() if isinstance(type_, TextureType)), None)
    if word in "KWE" and texture is not None:
        return _of_texture(word, texture)
    return FIXED[word]


def _of_texture(word: str, texture: TextureType) -> Type:
    if word == "K":
        return Vector("float", 2 if texture.dimension.startswith("2d") else 3)
    if word == "W":
        return Vector("int", 3 if texture.dimension == "3d" else 2)
    return FLOAT if texture.sample == "depth" else Vector(texture.sample, 4)


def is_native(row: Builtin, operands: tuple[Type, ...]) -> bool:
    """True if the hardware's operation is used for some values of these types."""
    kinds = [scalar_kind(type_) or "float" for type_ in operands]
    zeros, ones = (0.0,) * 4, (1.0,) * 4
    rising, pattern = (0.25, 0.5, 0.75, 1.0), (float(0x3F800000),) * 4

    def facts(values: tuple[float, ...]) -> tuple[Fact, ...]:
        pairs = zip(values, kinds, strict=False)
        return tuple(Fact(value, value, unit=True, kind=kind) for value, kind in pairs)

    return any(row.domain(facts(values)) for values in (zeros, ones, rising, pattern))


def can_have(selected: Selected, program: Program) -> bool:
    """True if a profile has all that a program needs; the other programs are refused."""
    return not list(lacks(program, selected.profile))


def has(profile: Profile, row: Builtin, operands: tuple[Type, ...]) -> bool:
    """True if a profile that has a builtin also has it for operands of these types."""
    textures = [type_ for type_ in operands if isinstance(type_, TextureType)]
    if row.name in profile.cannot or not profile.textures.issuperset(textures):
        return False
    are_square = all(type_.is_square for type_ in operands if isinstance(type_, Matrix))
    if not are_square and not profile.rectangular_matrices:
        return False
    node = constant(Graph(), INT, 0)
    return profile.wide_integers or not needs_wide_integers(NativeUse(row.name, operands, node))


def program_of_rows(profile: Profile) -> Program:
    """A fragment stage that calls every instance of every builtin that a profile has natively.

    Only kernels join the values of work groups: ``test_kernels.py`` has their texts.
    """
    make = Maker()
    lanes = {
        kind: Parameter(f"some_{kind}", type_, "material")
        for kind, type_ in (("float", FLOAT), ("int", INT), ("uint", UINT))
    }
    textures: dict[str, Texture] = {}
    material = block("Material", "material", [(parameter, "") for parameter in lanes.values()])

    def texture(type_: TextureType, how: str) -> Node:
        name = f"{type_}_{how}"
        texture = textures.setdefault(name, Texture(name, type_, "material"))
        return make.graph.node("texture", type_, (), texture)

    def call(row: Builtin, operands: tuple[Type, ...], result: Type) -> Node:
        how = "loaded" if row.sampler is None else "sampled"
        nodes = [texture(t, how) if isinstance(t, TextureType) else operand(t) for t in operands]
        for place in row.constants:
            nodes[place] = build.constant(make.graph, INT, 2)
        return make.native(row.name, result, *nodes)

    def operand(type_: Type) -> Node:
        match type_:
            case Matrix(columns):
                return build.matrix(make.graph, (operand(type_.column),) * columns)
            case Vector(kind=kind, size=size):
                return build.splat(make.graph, operand(Scalar(kind)), size)
            case Scalar(kind="bool"):
                return make.native("gt", type_, operand(FLOAT), make.number(0.5))
            case Scalar(kind=kind):
                return make.parameter(lanes[kind])
        raise TypeError(type_)

    lets = [
        Let(f"{row.name}_{number}", call(row, operands, result))
        for row in BUILTINS.values()
        if row.of_group is None
        for number, (operands, result) in enumerate(instances(row))
        if is_native(row, operands) and has(profile, row, operands)
    ]
    color = build.constant(make.graph, VEC4, (0.5, 0.5, 0.5, 1.0))
    return tiny(
        color, make, (material,), textures=tuple(textures.values()), region=Region(tuple(lets))
    )
