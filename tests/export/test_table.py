"""The rows of leaves are read in both directions: what they say of nodes is true of the library."""

from __future__ import annotations

import pytest

from burnish.materialx.export.table import closure_ways, leaf_category, ways, written_out
from burnish.materialx.known import known
from burnish.materialx.leaves.catalogue import OF_SURFACE, catalogue, input_named
from burnish.stdlib.builtins import BUILTINS


@pytest.mark.parametrize("word", sorted({**ways(), **closure_ways()}))
def test_a_word_is_a_node_with_these_inputs(word: str) -> None:
    way = {**ways(), **closure_ways()}[word]
    assert any(set(way.inputs) <= set(each.inputs) for each in known(way.category))


def test_what_is_written_out_is_a_builtin_that_no_row_has() -> None:
    assert written_out().keys() <= BUILTINS.keys() - ways().keys()


def test_functions_of_nodes_have_arguments_for_their_inputs() -> None:
    found = 0
    for name, leaf in catalogue().items():
        category = leaf_category(leaf.module, name)
        if not category:
            continue
        inputs = {each for definition in known(category) for each in definition.inputs}
        found += 1
        for argument in leaf.arguments:
            is_known = bool(input_named(inputs, argument))
            assert is_known or argument in {"asked", *OF_SURFACE}, (name, argument)
    assert found > 60
