"""The fields that each form of a language can have, and those that it has to have.

``faults.py`` compares the forms of each language with them when it is loaded.
"""

from __future__ import annotations

from collections.abc import Mapping
from types import MappingProxyType

FIELDS: Mapping[str, frozenset[str]] = MappingProxyType(
    {
        form: frozenset(fields.split())
        for form, fields in {
            "let": "typed name value",
            "constant_array": "typed name value",
            "variable": "typed name",
            "variable_set": "typed name value",
            "assign": "name value",
            "accumulate": "name value",
            "if_": "condition",
            "else_if": "condition",
            "loop": "index index_typed zero count bound",
            "enough": "index count",
            "loop_while": "index index_typed zero count bound going",
            "leave": "going",
            "deliver": "name value",
            "deliver_position": "value",
            "deliver_layer": "value",
            "store_texel": "name place value",
            "corner": "name corner",
            "of_patch": "name",
            "edge_level": "number",
            "inner_level": "number",
            "return_": "value",
            "function": "type name parameters",
            "parameter": "typed name type",
            "select": "condition then otherwise",
            "at_most": "value bound",
            "constructor": "type parts",
            "lane": "vector lanes type",
            "swizzle": "vector lanes type",
            "element": "aggregate position",
            "splat": "type value lanes",
            "matrix": "type transposed columns",
            "product_of_stored": "matrix vector zeros",
            "product_of_columns": "transposed columns vector",
            "column": "matrix position",
            "array": "type elements",
            "member": "block name",
            "block_argument": "type name",
            "buffer_argument": "type name",
            "written_argument": "type name",
            "atomic": "type",
            "scatter": "function place value",
            "shared": "typed",
            "shared_argument": "type name",
            "stored": "value type",
            "texture": "texture sampler type",
            "input": "name",
        }.items()
    }
)
"""The fields that each form can have, or each form of a table."""


NEEDED: Mapping[str, tuple[frozenset[str], ...]] = MappingProxyType(
    {
        form: tuple(frozenset(word.split("|")) for word in fields.split())
        for form, fields in {
            "let": "typed|name value",
            "constant_array": "typed|name value",
            "variable": "typed|name",
            "variable_set": "typed|name value",
            "assign": "name value",
            "accumulate": "name value",
            "if_": "condition",
            "else_if": "condition",
            "loop": "index|index_typed count|bound",
            "enough": "index count",
            "loop_while": "index|index_typed count|bound going",
            "leave": "going",
            "return_": "value",
            "function": "name parameters",
            "parameter": "typed|name",
            "select": "condition then otherwise",
            "at_most": "value",
            "constructor": "parts",
            "lane": "vector lanes",
            "swizzle": "vector lanes",
            "element": "aggregate position",
            "splat": "value",
            "matrix": "columns",
            "product_of_stored": "matrix vector zeros",
            "product_of_columns": "columns vector",
            "column": "matrix position",
            "array": "elements",
            "member": "name",
            "stored": "value",
            "texture": "texture",
            "input": "name",
            "scatter": "place value",
        }.items()
    }
)
"""The fields that a form loses something without, if it is written at all: of each set, one field
has to be there."""

MAY_BE_EMPTY = frozenset(
    {
        "accumulate", "array", "array_of_block", "loop_while", "matrix_by_rows", "member_end",
        "splat_constant",
    }
)  # fmt: skip
"""Rows with a default that a language may leave empty, or set to false, all the same: it needs
nothing there, or writes something else. All other forms that have a default are written."""
