"""Layouts: boxes never overlap, arrows point right and keep clear of boxes, for any graph."""

from __future__ import annotations

from itertools import combinations

from hypothesis import given, settings
from hypothesis import strategies as st

from burnish.commands.graph.layout import ROW_GAP, Item, laid_out

Graph = tuple[dict[str, tuple[float, float]], list[tuple[str, str]]]


@st.composite
def graphs(draw: st.DrawFn) -> Graph:
    """Boxes in order of computation, with arrows from earlier to later ones."""
    count = draw(st.integers(1, 14))
    sizes = {
        str(i): (draw(st.integers(20, 200)) * 1.0, draw(st.integers(20, 50)) * 1.0)
        for i in range(count)
    }
    pairs = list(combinations(sizes, 2))
    return sizes, draw(st.lists(st.sampled_from(pairs), unique=True)) if pairs else []


def overlap(one: Item, other: Item) -> bool:
    """True if two boxes share any area."""
    return (
        one.x < other.x + other.width
        and other.x < one.x + one.width
        and one.y < other.y + other.height
        and other.y < one.y + one.height
    )


@settings(max_examples=80)
@given(graph=graphs())
def test_boxes_and_passages_keep_apart_and_arrows_point_right(graph: Graph) -> None:
    sizes, edges = graph
    layout = laid_out(sizes, edges)
    passages = {id(item): item for path in layout.paths.values() for item in path}
    everything = list({**passages, **{id(i): i for i in layout.items.values()}}.values())
    assert not any(overlap(one, other) for one, other in combinations(everything, 2))
    for path in layout.paths.values():
        columns = [item.column for item in path]
        assert columns == list(range(columns[0], columns[-1] + 1))
        assert len(path) > 1
    for item in everything:
        assert item.x >= 0
        assert item.y >= 0
        assert item.x + item.width <= layout.width
        assert item.y + item.height <= layout.height


def test_what_uses_nothing_stands_beside_its_user() -> None:
    sizes = dict.fromkeys("abcde", (10.0, 10.0))
    layout = laid_out(sizes, [("a", "b"), ("b", "c"), ("c", "e"), ("d", "e")])
    assert layout.items["d"].column == layout.items["c"].column


def test_a_chain_is_straight() -> None:
    sizes = {"a": (10.0, 10.0), "b": (30.0, 40.0), "c": (10.0, 20.0)}
    layout = laid_out(sizes, [("a", "b"), ("b", "c")])
    assert len({item.middle for item in layout.items.values()}) == 1


def test_boxes_of_a_column_have_room_between_them() -> None:
    layout = laid_out(dict.fromkeys("abc", (10.0, 10.0)), [])
    heights = sorted(item.y for item in layout.items.values())
    assert heights == [0.0, 10.0 + ROW_GAP, 20.0 + 2 * ROW_GAP]
