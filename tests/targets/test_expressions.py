"""Parentheses stand where they are needed, and nesting is no problem."""

from __future__ import annotations

import ast

import pytest
from hypothesis import given
from hypothesis import strategies as st

import burnish
from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Graph, Node
from burnish.compiler.ir.statements import Branch, Region, Statement
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    INT,
    VEC3,
    VEC4,
    Matrix,
    square,
)
from burnish.targets.emit.precedence import Binding, Printed, choice, prefix, writer

from .kit import BY_NAME, PROFILES, Selected, emitted
from .programs import Maker, block, tiny

NAMES: list[Printed] = [(name, Binding.NAME) for name in "abc"]
A, B, C = NAMES
FAR_TOO_DEEP = 1500
"""More than Python's own stack takes. The text grows with its square, as each level is indented."""


def infix(symbol: str, left: Printed, right: Printed) -> Printed:
    """Two operands with a symbol between them."""
    return writer(symbol, 2)((left, right))


def test_the_lowest_integer_is_a_difference() -> None:
    """``-2147483648`` is the negation of a number that does not fit."""
    text = """
        material M {
            low = -2147483647 - 1
            alpha = float(int(uv.x) - low) + float(int(uv.y) * low)
        }
    """
    (material,) = burnish.compile(text, "glsl").materials
    written = material.text("glsl", "fragment")
    assert " - (-2147483647 - 1)" in written and " * (-2147483647 - 1)" in written


def test_parentheses() -> None:
    assert infix("*", A, infix("+", B, C))[0] == "a * (b + c)"
    assert infix("+", infix("*", A, B), C)[0] == "a * b + c"
    assert infix("-", infix("-", A, B), C)[0] == "a - b - c"
    assert infix("-", A, infix("-", B, C))[0] == "a - (b - c)"
    assert infix("/", A, infix("*", B, C))[0] == "a / (b * c)"
    assert prefix("-", prefix("-", A))[0] == "-(-a)"
    assert infix("&&", A, infix("||", B, C))[0] == "a && (b || c)"
    assert infix("||", infix("&&", A, B), C)[0] == "(a && b) || c"
    assert infix("&&", infix("<", A, B), C)[0] == "a < b && c"
    assert infix("==", infix("<", A, B), C)[0] == "(a < b) == c"
    assert infix("<<", A, infix("+", B, C))[0] == "a << (b + c)"
    assert infix("*", choice(A, B, C), A)[0] == "(a ? b : c) * a"


def test_arguments_are_no_list_of_a_template() -> None:
    """WGSL reads ``f(a < b, c > (d))`` as a call of the template ``a<b, c>``."""
    less, more = infix("<", A, B), infix(">=", B, C)
    assert writer("f", 2)((less, more))[0] == "f((a < b), b >= c)"
    assert writer("f", 2)((more, less))[0] == "f(b >= c, a < b)"
    assert writer("f", 3)((A, less, C))[0] == "f(a, a < b, c)"


@st.composite
def trees(draw: st.DrawFn, depth: int = 5) -> tuple[Printed, str]:
    """A printed expression, and the same in full parentheses."""
    if depth == 0 or draw(st.booleans()):
        name = draw(st.sampled_from(NAMES))
        return name, name[0]
    symbol = draw(st.sampled_from(["+", "-", "*", "/", "%", "neg"]))
    left, left_full = draw(trees(depth=depth - 1))
    if symbol == "neg":
        return prefix("-", left), f"(-{left_full})"
    right, right_full = draw(trees(depth=depth - 1))
    return infix(symbol, left, right), f"({left_full} {symbol} {right_full})"


@given(trees())
def test_the_tree_is_kept(tree: tuple[Printed, str]) -> None:
    """Python groups arithmetic as shading languages do."""
    printed, full = tree
    assert ast.dump(ast.parse(printed[0])) == ast.dump(ast.parse(full))


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_deep_branches(selected: Selected) -> None:
    make = Maker()
    level = Parameter("level", FLOAT, "material")
    material = block("Material", "material", [(level, "")])
    value = make.number(0.0)
    statements: tuple[Statement, ...] = ()
    for number in range(FAR_TOO_DEEP):
        test = make.native("lt", BOOL, make.parameter(level), make.number(float(number)))
        value = make.graph.node("select", FLOAT, (test, value, make.number(1.0)))
        statements = (Branch("chosen", value, Region(statements), Region(())),)
    color = build.splat(make.graph, value, 4)
    text = emitted(tiny(color, make, (material,), region=Region(statements)), selected)
    opening = selected.language.forms.if_.partition("{condition}")[0]
    assert text["fragment"].count(opening) == FAR_TOO_DEEP


def test_an_unbound_chain_is_refused_and_not_overflowed() -> None:
    make = Maker()
    value = make.number(2.0)
    for _ in range(FAR_TOO_DEEP):
        value = make.native("sin", FLOAT, value)
    with pytest.raises(AssertionError, match="scheduler"):
        emitted(tiny(build.splat(make.graph, value, 4), make), BY_NAME["glsl:vulkan"])


@pytest.mark.parametrize("selected", PROFILES, ids=str)
def test_lanes_of_a_stored_vector_are_read_at_once(selected: Selected) -> None:
    # The elements of an array in a block have four lanes; a vec3 is the first three of them.
    source = (
        "material M {\n param rows : vec3[3]\n color = vec3(normal) * rows[1].z + rows[2].zyx\n}"
    )
    (material,) = burnish.compile(source, [str(selected)]).materials
    text = next(file.text for file in material.files if "fragment" in file.entry_points)
    assert "rows[1].z" in text
    assert "rows[2].zyx" in text


@pytest.mark.parametrize(
    ("selected", "column"),
    [
        (BY_NAME["glsl:vulkan"], "mat2(1.0, 2.0, 3.0, 4.0)[1]"),
        (BY_NAME["hlsl:sm6"], "transpose(float2x2(1.0, 3.0, 2.0, 4.0))[1]"),
        (BY_NAME["wgsl:webgpu"], "mat2x2f(1.0, 2.0, 3.0, 4.0)[1]"),
        (BY_NAME["msl:metal2"], "float2x2(1.0f, 2.0f, 3.0f, 4.0f)[1]"),
    ],
    ids=str,
)
def test_matrices_are_made_of_columns(selected: Selected, column: str) -> None:
    graph = Graph()
    make = Maker()
    make.graph = graph
    matrix = constant_matrix(graph)
    second = build.index(graph, matrix, build.constant(graph, INT, 1))
    color = build.vector(graph, (second, second))
    assert column in emitted(tiny(color, make), selected)["fragment"]


@pytest.mark.parametrize(
    ("selected", "declared", "product", "column"),
    [
        (BY_NAME["glsl:vulkan"], "mat3x4 turn;", "turn * axis", "turn[1]"),
        (
            BY_NAME["hlsl:sm6"],
            "column_major float4x3 turn;",
            "mul(turn, axis)",
            "transpose(turn)[1]",
        ),
        (
            BY_NAME["wgsl:webgpu"],
            "turn: mat3x4f,",
            "material.turn * material.axis",
            "material.turn[1]",
        ),
        (
            BY_NAME["msl:metal2"],
            "float3x4 turn;",
            "material.turn * float3(material.axis)",
            "material.turn[1]",
        ),
    ],
    ids=str,
)
def test_stored_matrices(selected: Selected, declared: str, product: str, column: str) -> None:
    make = Maker()
    turn = Parameter("turn", Matrix(3, 4), "material")
    axis = Parameter("axis", VEC3, "material")
    material = block("Material", "material", [(turn, ""), (axis, "")])
    turned = make.native("mul", VEC4, make.parameter(turn), make.parameter(axis))
    second = build.index(make.graph, make.parameter(turn), build.constant(make.graph, INT, 1))
    color = make.native("add", VEC4, turned, second)
    text = emitted(tiny(color, make, (material,)), selected)["fragment"]
    assert declared in text
    assert f"{product} + {column};" in text


@pytest.mark.parametrize(
    ("selected", "product"),
    [
        (BY_NAME["glsl:vulkan"], "mat3(axis, axis + axis, axis) * axis"),
        (BY_NAME["hlsl:sm6"], "mul(axis, float3x3(axis, axis + axis, axis))"),
    ],
    ids=str,
)
def test_columns_times_a_vector(selected: Selected, product: str) -> None:
    make = Maker()
    axis = Parameter("axis", VEC3, "material")
    read = make.parameter(axis)
    columns = build.matrix(make.graph, (read, make.native("add", VEC3, read, read), read))
    turned = make.native("mul", VEC3, columns, read)
    color = build.vector(make.graph, (turned, build.constant(make.graph, FLOAT, 1)))
    program = tiny(color, make, (block("Material", "material", [(axis, "")]),))
    assert product in emitted(program, selected)["fragment"]


def constant_matrix(graph: Graph) -> Node:
    return graph.node("constant", square(2), (), (1.0, 2.0, 3.0, 4.0))
