"""The verifier finds what is wrong with a graph and says so."""

from __future__ import annotations

from collections.abc import Callable

import pytest

from burnish.compiler.ir import build
from burnish.compiler.ir.leaves import Attribute, Parameter
from burnish.compiler.ir.node import Folding, Formal, Graph, Node, Roots
from burnish.compiler.ir.operations import Form
from burnish.compiler.ir.shader import Result
from burnish.compiler.ir.stages import FLAT, FRAGMENT, RASTERISED, SMOOTH, TARGET
from burnish.compiler.ir.types import (
    BOOL,
    FLOAT,
    INT,
    VEC2,
    VEC3,
    VEC4,
    Matrix,
    square,
)
from burnish.compiler.ir.verify import InvalidGraphError, verify, verify_results
from burnish.compiler.passes import checkpoint
from burnish.compiler.watching import VARIABLE


def one(graph: Graph) -> Node:
    return build.floating(graph, 1.0)


def attribute(graph: Graph) -> Node:
    return graph.node("attribute", VEC3, (), Attribute("p", VEC3))


def crossing(graph: Graph) -> Node:
    return build.cross(graph, attribute(graph), SMOOTH)


def loop(graph: Graph, body: Node, index: Formal | None = None) -> Node:
    operands = (build.constant(graph, INT, 3), one(graph), body)
    return graph.node(
        "fold", FLOAT, operands, Folding("add", 3, None if index is None else (index,))
    )


def variable(graph: Graph, number: int) -> Node:
    bound = graph.node("bound", INT, (), number)
    return graph.node("call", FLOAT, (bound,), "to_float")


def free(graph: Graph) -> Node:
    leaf = graph.node("formal", FLOAT, (), Formal("x"))
    return graph.node("call", FLOAT, (leaf, leaf), "add")


def flag(graph: Graph) -> Node:
    return graph.node("parameter", BOOL, (), Parameter("flag", BOOL, "material"))


def turned(graph: Graph, size: int) -> Node:
    turn = graph.node("parameter", Matrix(size, 4), (), Parameter("m", square(size), "draw"))
    return graph.node("native", VEC4, (turn, attribute(graph)), "mul")


INDEX = Formal("i")


def beside(graph: Graph) -> Node:
    """The variable of a loop, and another one."""
    index = graph.node("call", FLOAT, (graph.node("formal", INT, (), INDEX),), "to_float")
    return graph.node("call", FLOAT, (index, free(graph)), "add")


WRONG: list[tuple[Form, Callable[[Graph], Node], str]] = [
    ("semantics", lambda g: g.node("call", VEC3, (one(g), one(g)), "add"), "instead of float"),
    ("semantics", lambda g: g.node("call", FLOAT, (one(g), flag(g)), "add"), "does not take"),
    ("semantics", lambda g: g.node("constant", FLOAT, (), 1), "does not take"),
    ("semantics", lambda g: g.node("constant", VEC2, (), (1.0,)), "does not take"),
    ("semantics", lambda g: g.node("swizzle", FLOAT, (attribute(g),), (3,)), "does not take"),
    ("semantics", lambda g: g.node("matrix", square(2), (one(g), one(g))), "does not take"),
    ("semantics", lambda g: g.node("select", FLOAT, (one(g),) * 3), "does not take"),
    ("semantics", lambda g: loop(g, variable(g, 1)), "0 is used outside its binder"),
    ("semantics", free, "is used outside its binder"),
    ("opened", lambda g: loop(g, variable(g, 0)), "has not been opened"),
    ("guarded", lambda g: g.node("call", FLOAT, (one(g),), "sqrt"), "has not been guarded"),
    ("stored", flag, "instead of uint"),
    ("stored", lambda g: turned(g, 2), "does not take"),
    (
        "semantics",
        lambda g: build.cross(g, crossing(g), FLAT),
        "crosses from another domain than vertex",
    ),
    ("semantics", lambda g: build.cross(g, flag(g), FLAT), "does not take"),
    ("semantics", lambda g: g.node("swizzle", FLOAT, (attribute(g),)), "does not take"),
    ("semantics", lambda g: g.node("parameter", VEC3, (), Attribute("p", VEC3)), "does not take"),
    ("semantics", lambda g: g.node("vector", VEC2, ()), "does not take"),
    ("semantics", lambda g: loop(g, beside(g), INDEX), "Formal.*'x'.* is used outside its binder"),
    ("opened", lambda g: loop(g, one(g)), "has not been opened"),
]


@pytest.mark.parametrize(("form", "make", "reason"), WRONG)
def test_what_is_wrong_is_found(form: Form, make: Callable[[Graph], Node], reason: str) -> None:
    with pytest.raises(InvalidGraphError, match=reason):
        verify([make(Graph())], stage=form)


def test_only_parameters_are_stored_otherwise() -> None:
    graph = Graph()
    verify([graph.node("native", BOOL, (one(graph), one(graph)), "lt")], stage="stored")


def test_calls_that_each_profile_decides_about_stay() -> None:
    graph = Graph()
    number = graph.node("parameter", INT, (), Parameter("n", INT, "draw"))
    verify([graph.node("call", INT, (number, number), "div")], stage="stored")


def test_a_value_that_is_the_same_all_over_a_draw_exists_in_every_stage() -> None:
    graph = Graph()
    color = build.vector(graph, (one(graph),) * 4)
    verify_results([Result(TARGET, FRAGMENT, color, "color")], RASTERISED)
    verify([color], stage="stored")


def test_a_stored_matrix_is_multiplied_with_a_column() -> None:
    verify([turned(Graph(), 3)], stage="stored")


def test_a_formal_has_the_type_of_what_it_stands_for() -> None:
    graph = Graph()
    formal = Formal("i")
    body = graph.node("formal", FLOAT, (), formal)
    with pytest.raises(InvalidGraphError, match="used as a float"):
        verify([loop(graph, body, formal)], stage="opened")


def test_an_operand_is_older_than_its_user() -> None:
    graph, other = Graph(), Graph()
    for number in range(3):
        build.constant(other, INT, number)
    with pytest.raises(InvalidGraphError, match="not older"):
        verify([graph.node("call", FLOAT, (one(other),), "sqrt")], stage="semantics")


def test_nested_binders_are_well_formed() -> None:
    graph = Graph()
    both = graph.node("call", FLOAT, (variable(graph, 0), variable(graph, 1)), "add")
    verify([loop(graph, loop(graph, both))], stage="semantics")


def test_deep_graphs_are_verified_without_recursion() -> None:
    graph = Graph()
    node = one(graph)
    for _ in range(50_000):
        node = graph.node("native", FLOAT, (node, one(graph)), "add")
    verify([node], stage="stored")


def test_the_error_names_the_pass(monkeypatch: pytest.MonkeyPatch) -> None:
    with pytest.raises(InvalidGraphError) as caught:
        checkpoint.verified("fuse", "opened", Roots([free(Graph())]))
    assert caught.value.__notes__ == ["after fuse"]
    monkeypatch.delenv(VARIABLE)
    checkpoint.verified("fuse", "opened", Roots([free(Graph())]))


def test_graphs_whose_nodes_have_the_same_ids_are_verified_each_by_itself() -> None:
    verify([one(Graph())], stage="semantics")
    with pytest.raises(InvalidGraphError, match="does not take"):
        verify([Graph().node("constant", FLOAT, (), 1)], stage="semantics")


def test_a_node_that_fits_a_graph_of_one_form_is_looked_at_again_in_the_next() -> None:
    graph = Graph()
    root = graph.node("call", FLOAT, (one(graph),), "sqrt")
    for _ in range(2):
        verify([root], stage="flat")
        with pytest.raises(InvalidGraphError, match="has not been guarded"):
            verify([root], stage="guarded")
