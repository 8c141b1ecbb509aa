"""Reading through storage gives what was declared: checked on the bytes themselves."""

from __future__ import annotations

from collections.abc import Iterator

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from burnish.compiler.ir.build import apply, constant, index, matrix, member, swizzle
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Folding, Graph, Node, reachable
from burnish.compiler.ir.operations import PARAMETER
from burnish.compiler.ir.rewrite import rewrite
from burnish.compiler.ir.shader import Notes
from burnish.compiler.ir.storage import byte_size, stored_type
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
    Struct,
    Type,
    Vector,
    square,
)
from burnish.compiler.layout import layout_blocks
from burnish.compiler.packing import packing
from burnish.compiler.passes.lower_reads import lower_reads
from burnish.compiler.reference.evaluate import evaluate as meaning

from .declarations import ELEMENTS, types, values
from .evaluate import evaluate
from .memory import Value, read, write

LAMP = Struct("Lamp", (("on", BOOL), ("place", VEC3), ("cones", Array(FLOAT, 5))))


def parameter(graph: Graph, name: str, type_: Type) -> Node:
    return graph.node("parameter", type_, (), Parameter(name, type_, "material"))


def stored_value(type_: Type, value: Value) -> Value:
    """The value that a shader reads after a host has written ``value``."""
    bytes_ = bytearray(byte_size(stored_type(type_)))
    write(bytes_, 0, packing(type_), value)
    return read(bytes(bytes_), 0, stored_type(type_))


def leaves(graph: Graph, node: Node) -> Iterator[Node]:
    """Every scalar, vector and matrix inside ``node``, by constant indices."""
    match node.type:
        case Struct(members=members):
            for name, _ in members:
                yield from leaves(graph, member(graph, node, name))
        case Array(count=count):
            for i in range(count):
                yield from leaves(graph, index(graph, node, constant(graph, INT, i)))
        case _:
            yield node


@given(types.flatmap(lambda type_: st.tuples(st.just(type_), values(type_))))
def test_every_part_of_a_parameter_keeps_its_value(case: tuple[Type, Value]) -> None:
    type_, value = case
    graph = Graph()
    before = list(leaves(graph, parameter(graph, "p", type_)))
    after = lower_reads(graph, before)
    stored = stored_value(type_, value)
    assert [node.type for node in after] == [node.type for node in before]
    assert [evaluate(node, {"p": stored}) for node in after] == [
        evaluate(node, {"p": value}) for node in before
    ]


@pytest.mark.parametrize("kind", [INT, UINT], ids=str)
@pytest.mark.parametrize("element", ELEMENTS, ids=str)
@settings(max_examples=10)
@given(data=st.data())
def test_a_computed_index_finds_its_element(element: Type, kind: Type, data: st.DataObject) -> None:
    type_ = Array(element, 7)
    value = data.draw(values(type_))
    graph = Graph()
    chosen = index(graph, parameter(graph, "p", type_), parameter(graph, "i", kind))
    (lowered,) = lower_reads(graph, [chosen])
    stored = stored_value(type_, value)
    for i in range(7):
        assert evaluate(lowered, {"p": stored, "i": i}) == value[i]  # type: ignore[index]


def test_parameter_nodes_have_their_stored_types_afterwards() -> None:
    graph = Graph()
    roots = [parameter(graph, str(type_), type_) for type_ in (*ELEMENTS, LAMP)]
    lowered = lower_reads(graph, roots)
    for node in reachable(lowered):
        if node.op == "parameter":
            assert node.type == stored_type(PARAMETER.data(node).type)


def test_lowering_twice_changes_nothing() -> None:
    graph = Graph()
    lamps = parameter(graph, "lamps", Array(LAMP, 4))
    lamp = index(graph, lamps, parameter(graph, "i", INT))
    roots = [member(graph, lamp, "on"), parameter(graph, "turn", square(3))]
    lowered = lower_reads(graph, roots)
    assert lower_reads(graph, lowered) is lowered


def test_what_is_stored_as_it_is_needs_no_conversion() -> None:
    graph = Graph()
    position = parameter(graph, "i", INT)
    chosen = index(graph, parameter(graph, "p", Array(VEC4, 3)), position)
    plain = parameter(graph, "m", square(4))
    assert lower_reads(graph, [chosen, plain]) == (chosen, plain)


def test_a_constant_index_leaves_no_arithmetic() -> None:
    graph = Graph()
    chosen = index(graph, parameter(graph, "p", Array(VEC2, 5)), constant(graph, INT, 3))
    (lowered,) = lower_reads(graph, [chosen])
    row = index(graph, parameter_stored(graph, "p", Array(VEC2, 5)), constant(graph, INT, 1))
    assert lowered is swizzle(graph, row, (2, 3))


def parameter_stored(graph: Graph, name: str, type_: Type) -> Node:
    leaf = Parameter(name, type_, "material")
    return graph.node("parameter", stored_type(type_), (), leaf)


def product(graph: Graph, turn: Node, column: Node) -> Node:
    assert isinstance(turn.type, Matrix)
    return graph.node("native", turn.type.column, (turn, column), "mul")


@pytest.mark.parametrize("type_", [each for each in MATRICES if each.rows < 4], ids=str)
@given(data=st.data())
def test_a_product_is_one_of_the_stored_matrix(type_: Matrix, data: st.DataObject) -> None:
    graph = Graph()
    turn = parameter(graph, "m", type_)
    column = parameter(graph, "v", Vector("float", type_.columns))
    before = product(graph, turn, column)
    (after,) = lower_reads(graph, [before])

    stored = parameter_stored(graph, "m", type_)
    assert stored.type == Matrix(type_.columns, 4)
    rows = graph.node("native", VEC4, (stored, column), "mul")
    assert after is swizzle(graph, rows, tuple(range(type_.rows)))
    assert lower_reads(graph, [after]) == (after,)

    given_values = {"m": data.draw(values(turn.type)), "v": data.draw(values(column.type))}
    written = stored_value(turn.type, given_values["m"])

    def leaf(node: Node) -> Value:
        name = PARAMETER.data(node).name
        return written if node.type == stored.type else given_values[name]

    assert meaning(after, leaf) == meaning(before, leaf)


def test_a_column_is_one_of_the_stored_matrix() -> None:
    graph = Graph()
    position = parameter(graph, "i", INT)
    (column,) = lower_reads(graph, [index(graph, parameter(graph, "m", square(3)), position)])
    stored = parameter_stored(graph, "m", square(3))
    assert column is swizzle(graph, index(graph, stored, position), (0, 1, 2))


def test_a_matrix_in_a_struct_is_multiplied_as_it_is_stored() -> None:
    graph = Graph()
    probes = Array(Struct("Probe", (("on", BOOL), ("turn", square(3)))), 2)
    probe = index(graph, parameter(graph, "probes", probes), parameter(graph, "i", INT))
    column = parameter(graph, "v", VEC3)
    (lowered,) = lower_reads(graph, [product(graph, member(graph, probe, "turn"), column)])
    assert [node for node in reachable([lowered]) if node.op == "matrix"] == []


def test_matrices_that_are_no_parameters_stay_square() -> None:
    graph = Graph()
    column = parameter(graph, "v", VEC3)
    turn = parameter(graph, "m", square(3))
    first, second = (index(graph, turn, constant(graph, INT, i)) for i in (0, 1))
    other = matrix(graph, (second, first, column))
    small = matrix(graph, tuple(swizzle(graph, each, (0, 1)) for each in (first, second)))
    of_array = index(graph, parameter(graph, "a", Array(square(3), 2)), constant(graph, INT, 1))
    flat = parameter(graph, "u", VEC2)
    roots = [product(graph, other, column), product(graph, of_array, column),
             product(graph, small, flat)]  # fmt: skip
    for lowered in lower_reads(graph, roots):
        assert lowered.op == "native"
        assert isinstance(lowered.operands[0].type, Matrix)


def test_structs_travel_stored_through_binders_and_selects() -> None:
    graph = Graph()
    lamps = parameter(graph, "lamps", Array(LAMP, 4))
    formal = graph.node("bound", LAMP, (), 0)
    body = index(graph, member(graph, formal, "cones"), constant(graph, INT, 4))
    turn = graph.node("bound", INT, (), 0)
    first = index(graph, lamps, constant(graph, INT, 0))
    lamp = index(graph, lamps, turn)
    chosen = graph.node("select", LAMP, (member(graph, lamp, "on"), lamp, first))
    term = apply(graph, body, (chosen,))
    start = constant(graph, FLOAT, 0.0)
    count = constant(graph, INT, 4)
    total = graph.node("fold", FLOAT, (count, start, term), Folding("add", 4))
    value = tuple((i % 2 == 1, (0.0, 1.0, 2.0), (*[0.5] * 4, float(i + 1))) for i in range(4))

    (lowered,) = lower_reads(graph, [total])

    assert evaluate(total, {"lamps": value}) == 1 + 2 + 1 + 4
    stored = stored_value(Array(LAMP, 4), value)
    assert evaluate(lowered, {"lamps": stored}) == 1 + 2 + 1 + 4


def test_notes_follow_what_is_lowered() -> None:
    graph = Graph()
    on = parameter(graph, "on", BOOL)
    notes = Notes(names={on.id: "lit"}, docs={on.id: "Whether it shines."})
    (lowered,) = lower_reads(graph, [on], notes.follow)
    assert lowered.op == "native"
    assert notes.names[lowered.id] == "lit"
    assert notes.docs[lowered.id] == "Whether it shines."


def test_a_name_that_is_there_already_stays() -> None:
    graph = Graph()
    old, new = constant(graph, FLOAT, 1.0), constant(graph, FLOAT, 2.0)
    notes = Notes(names={old.id: "old", new.id: "new"})
    rewrite(graph, [old], lambda _graph, node, _operands: new if node is old else None,
            notes.follow)  # fmt: skip
    assert notes.names[new.id] == "new"


def test_rewriting_a_deep_graph_does_not_recurse() -> None:
    graph = Graph()
    one = constant(graph, FLOAT, 1.0)
    node = start = parameter(graph, "p", FLOAT)
    for _ in range(100_000):
        node = graph.node("native", FLOAT, (node, one), "add")
    (same,) = rewrite(graph, [node], lambda *_: None)
    assert same is node
    (other,) = rewrite(graph, [node], lambda _graph, inner, _new: one if inner is start else None)
    assert len(reachable([other])) == 100_001


def test_host_and_shader_agree_on_a_whole_block() -> None:
    declared = [
        Parameter("power", FLOAT, "material"),
        Parameter("uv", VEC2, "material"),
        Parameter("flags", Array(BOOL, 6), "material"),
    ]
    (block,) = layout_blocks(declared)
    bytes_ = bytearray(block.size)
    given_values = {"power": 4.0, "uv": (0.25, 0.5), "flags": (True, False) * 3}
    places = {m.parameter.name: m for m in block.members if m.parameter}
    for leaf in declared:
        write(bytes_, places[leaf.name].offset, packing(leaf.type), given_values[leaf.name])
    found = {name: read(bytes(bytes_), m.offset, m.type) for name, m in places.items()}
    assert found == {"power": 4.0, "uv": (0.25, 0.5), "flags": ((1, 0, 1, 0), (1, 0, 0, 0))}
