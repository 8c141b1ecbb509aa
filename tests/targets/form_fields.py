"""The fields that each form of a language can have, and how to find those of a text."""

from __future__ import annotations

from collections.abc import Mapping
from string import Formatter
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
            "loop": "index index_typed zero count",
            "loop_while": "index index_typed zero count going",
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
            "matrix": "type columns",
            "product_of_columns": "type columns vector",
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


def fields_of(form: str) -> frozenset[str]:
    """The names of the fields in a form; those of operands are numbers."""
    return frozenset(name for _text, name, _spec, _conversion in Formatter().parse(form) if name)
