"""The offsets at which the real compilers place the members of blocks that the targets write.

DXC is asked three times, because its Vulkan layout hides mistakes that D3D's own would show.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from burnish.compiler.ir.build import constant, index, splat, swizzle
from burnish.compiler.ir.build import member as member_of
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Graph, Node
from burnish.compiler.ir.program import Block, Program
from burnish.compiler.ir.storage import byte_size
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    INT,
    MATRICES,
    UINT,
    VEC2,
    VEC3,
    VEC4,
    Array,
    Matrix,
    Scalar,
    Struct,
    Type,
    Vector,
    square,
)
from burnish.compiler.passes.lower_reads import lower_reads
from burnish.targets.emit.emitter import Emission, emit
from burnish.targets.emit.names import Names
from burnish.targets.legalise.legalise import legalise
from burnish.targets.registry import select
from burnish.targets.toolchain import (
    Job,
    Toolchain,
    Verdict,
    block_offsets_dxil,
    block_offsets_spirv,
)

from .declarations import ELEMENTS, parameters, types
from .programs import extern_program_of, program_of

Offsets = dict[str, int]

CONE = Struct("Cone", (("angle", FLOAT), ("soft", BOOL)))
LAMP = Struct(
    "Lamp",
    (
        ("on", BOOL),
        ("place", VEC3),
        ("cone", CONE),
        ("tint", VEC2),
        ("weights", Array(FLOAT, 5)),
        ("turn", square(3)),
        ("mask", Vector("bool", 3)),
    ),
)
"""A member of every kind, each after one that leaves a gap."""

_BETWEEN = [part for each in MATRICES if not each.is_square for part in (each, VEC2)]
"""Each matrix that is not square, and something behind it that would move into its last row."""

KINDS: dict[str, list[Type]] = {
    "scalars and vectors": [FLOAT, VEC2, INT, VEC3, BOOL, UINT, VEC4, VEC2, VEC3],
    "bools": [BOOL, Vector("bool", 2), BOOL, Vector("bool", 3), Vector("bool", 4)],
    "matrices": [FLOAT, square(2), FLOAT, square(3), VEC2, square(4), FLOAT],
    "rectangular matrices": [FLOAT, *_BETWEEN, FLOAT],
    "arrays": [
        FLOAT,
        Array(FLOAT, 5),
        INT,
        Array(VEC2, 3),
        VEC2,
        Array(VEC3, 2),
        FLOAT,
        Array(BOOL, 9),
        FLOAT,
        Array(square(2), 2),
        FLOAT,
        Array(Matrix(3, 2), 2),
        Array(Matrix(4, 3), 2),
    ],
    "structs": [FLOAT, CONE, FLOAT, LAMP, VEC2, Array(CONE, 3), FLOAT, Array(LAMP, 4), FLOAT],
}


@pytest.fixture(scope="module")
def toolchain() -> Iterator[Toolchain]:
    with Toolchain() as tools:
        yield tools


@dataclass(frozen=True)
class Route:
    """A compiler with a way to make it tell a layout."""

    target: str
    checker: str
    flags: tuple[str, ...] = ()


ROUTES = (
    Route("glsl:vulkan", "glslang-vulkan"),
    Route("wgsl", "naga"),
    Route("hlsl", "glslang-hlsl"),
    Route("hlsl", "dxc-spirv"),
    Route("hlsl", "dxc-spirv", ("-fvk-use-dx-layout",)),
    Route("hlsl", "dxc-dxil"),
)


def check(toolchain: Toolchain, program: Program) -> None:
    """All routes report the layout that the program's block says."""
    emissions = [emit(legalise(program, *select(route.target))) for route in ROUTES]
    jobs = [job(route, emission) for route, emission in zip(ROUTES, emissions, strict=True)]
    verdicts = toolchain.check(jobs, keep_modules=True)
    (block,) = program.blocks
    for emission, verdict in zip(emissions, verdicts, strict=True):
        names = emission.names
        expected = {names.blocks[block.name]: expectation(block, names)}
        if verdict.job.checker == "dxc-dxil":
            expected = {name: without_strides(members) for name, members in expected.items()}
        assert reported(verdict) == expected, verdict.job


def job(route: Route, emission: Emission) -> Job:
    (fragment,) = (file for file in emission.files if file.stage == "fragment")
    entry = fragment.entries["fragment"]
    return Job(route.checker, "frag", fragment.text, entry, flags=route.flags)


def reported(verdict: Verdict) -> dict[str, Offsets]:
    assert verdict.status == "accepted", f"{verdict.report()}\n{verdict.job.text}"
    if verdict.disassembly is not None:
        return block_offsets_dxil(verdict.disassembly)
    assert verdict.spirv is not None
    return block_offsets_spirv(verdict.spirv)


def expectation(block: Block, names: Names) -> Offsets:
    """The block's members by the names that the text gives them."""
    found: Offsets = {}
    for member in block.members:
        name = names.member(block.name, member.name)
        found |= inside(name, member.type, member.offset, names)
    return found


def inside(path: str, type_: Type, offset: int, names: Names) -> Offsets:
    """A member and all that is in it."""
    found = {path: offset}
    if isinstance(type_, Array):
        path += "[]"
        type_ = type_.element
        found[path] = byte_size(type_)
    if isinstance(type_, Matrix):
        found[f"{path}[]"] = 16
    if isinstance(type_, Struct):
        for name, member in type_.members:
            final = names.member(type_.name, name)
            found |= inside(f"{path}.{final}", member, offset, names)
            offset += byte_size(member)
    return found


def without_strides(members: Offsets) -> Offsets:
    return {name: offset for name, offset in members.items() if not name.endswith("[]")}


def declared(types: Sequence[Type]) -> list[Parameter]:
    return [Parameter(f"p{i}", type_, "material") for i, type_ in enumerate(types)]


@pytest.mark.parametrize("types", KINDS.values(), ids=KINDS)
def test_compilers_agree(toolchain: Toolchain, types: list[Type]) -> None:
    check(toolchain, program_of(declared(types)))


ACCEPTING = (
    *ROUTES,
    Route("wgsl", "tint"),
    Route("glsl:gl330", "glslang-gl330"),
    Route("glsl:gl450", "glslang-gl450"),
    Route("glsl:es300", "glslang-es300"),
    Route("glsl:es310", "glslang-es310"),
)


def colour_of(graph: Graph, node: Node) -> Node:
    """Something of a value, as a vec4."""
    match node.type:
        case Matrix():
            return colour_of(graph, index(graph, node, constant(graph, INT, 1)))
        case Vector("bool"):
            return colour_of(graph, swizzle(graph, node, (1,)))
        case Scalar("bool"):
            sides = constant(graph, VEC4, (1.0,) * 4), constant(graph, VEC4, (0.0,) * 4)
            return graph.node("select", VEC4, (node, *sides))
        case Vector():
            return swizzle(graph, node, (0, 1, 0, 1))
        case _:
            return splat(graph, node, 4)


def test_reads_at_computed_indices_are_accepted(toolchain: Toolchain) -> None:
    graph = Graph()
    elements = [element for element in ELEMENTS if element != UINT]
    arrays = declared([Array(element, 5) for element in elements])
    turn = Parameter("turn", INT, "material")
    position = graph.node("parameter", INT, (), turn)
    total = constant(graph, VEC4, (0.0,) * 4)
    for array in arrays:
        element = index(graph, graph.node("parameter", array.type, (), array), position)
        total = graph.node("native", VEC4, (total, colour_of(graph, element)), "add")
    program = program_of([*arrays, turn], graph, lower_reads(graph, [total])[0])
    jobs = [job(route, emit(legalise(program, *select(route.target)))) for route in ACCEPTING]
    for verdict in toolchain.check(jobs):
        assert verdict.status == "accepted", f"{verdict.report()}\n{verdict.job.text}"


def test_uses_of_a_matrix_are_accepted(toolchain: Toolchain) -> None:
    """Products with columns and matrices, columns, and all of it from inside a structure."""
    graph = Graph()
    turns = declared([*MATRICES, LAMP])
    position = Parameter("position", INT, "material")
    total = constant(graph, VEC4, (0.0,) * 4)
    for turn in turns:
        whole = graph.node("parameter", turn.type, (), turn)
        if isinstance(turn.type, Struct):
            whole = member_of(graph, whole, "turn")
        assert isinstance(whole.type, Matrix)
        columns, rows = whole.type.columns, whole.type.rows
        at = index(graph, whole, graph.node("parameter", INT, (), position))
        turned = graph.node("native", Matrix(rows, columns), (whole,), "transpose")
        across = index(graph, turned, constant(graph, INT, 0))
        moved = graph.node("native", at.type, (whole, across), "mul")
        twice = graph.node("native", square(rows), (whole, turned), "mul")
        for used in (at, moved, twice):
            total = graph.node("native", VEC4, (total, colour_of(graph, used)), "add")
    program = program_of([*turns, position], graph, lower_reads(graph, [total])[0])
    jobs = [job(route, emit(legalise(program, *select(route.target)))) for route in ACCEPTING]
    for verdict in toolchain.check(jobs):
        assert verdict.status == "accepted", f"{verdict.report()}\n{verdict.job.text}"


@settings(
    max_examples=10,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(parameters)
def test_compilers_agree_on_random_blocks(toolchain: Toolchain, random: list[Parameter]) -> None:
    check(toolchain, program_of(random))


def has_one_layout(type_: Type) -> bool:
    """True if a host's own block can hold a type: its array elements always lie 16 bytes apart."""
    element = type_.element if isinstance(type_, Array) else None
    return not isinstance(element, Scalar) and element not in (VEC2, Vector("bool", 2))


extern_members = st.lists(
    st.tuples(types.filter(has_one_layout), st.integers(0, 20).map(lambda lanes: 4 * lanes)),
    min_size=1,
    max_size=6,
)


@settings(
    max_examples=10,
    derandomize=True,
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
)
@given(extern_members)
def test_compilers_find_a_hosts_members_where_it_puts_them(
    toolchain: Toolchain, members: list[tuple[Type, int]]
) -> None:
    check(toolchain, extern_program_of(members))
