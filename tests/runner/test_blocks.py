"""Bytes of random declarations, read back as the shaders read them."""

from __future__ import annotations

from typing import Any

from hypothesis import given, settings
from hypothesis import strategies as st

import burnish
from burnish import Instance
from burnish.compiler.diagnostics.source import Source, Span
from burnish.compiler.documents.reflection import Reflection
from burnish.compiler.ir.leaves import Parameter
from burnish.compiler.ir.node import Graph
from burnish.compiler.ir.shader import ParameterInfo
from burnish.compiler.ir.types import Array, Struct, Type
from burnish.compiler.layout import layout_blocks
from burnish.compiler.passes.lower_reads import lower_reads
from burnish.compiler.reflection.parameters import Places, Reads, parameter_rows
from burnish.support.frozen import changed

from ..layout.declarations import parameters, values
from ..layout.evaluate import evaluate
from ..layout.memory import read
from ..layout.test_storage import leaves

Case = tuple[list[Parameter], tuple[Any, ...]]
"""Declarations, and a value for each."""

NOWHERE = Span(Source("<none>", ""), 0, 0)


PLAIN = burnish.compile("material M { param a : float = 1  color = vec3(a) }", ())["M"].reflection
"""A reflection whose blocks and parameters are changed to others."""


def reflected(declared: list[Parameter]) -> Reflection:
    """A reflection, of which the parts are right that an instance reads."""
    blocks = layout_blocks(declared)
    infos = [ParameterInfo(p, str(p.type), "", NOWHERE) for p in declared]
    plain = PLAIN.blocks[0]
    return changed(
        PLAIN,
        material="Random",
        blocks=tuple(changed(plain, name=block.name, size=block.size) for block in blocks),
        parameters=parameter_rows(infos, Places(blocks), Reads()),
        derived=(),
        lights=(),
    )


def host(type_: Type, value: Any) -> Any:
    """A value as a host writes it: structures are mappings."""
    match type_:
        case Struct(members=members):
            return {n: host(t, v) for (n, t), v in zip(members, value, strict=True)}
        case Array(element=element):
            return [host(element, part) for part in value]
        case _:
            return value


cases = parameters.flatmap(
    lambda declared: st.tuples(st.just(declared), st.tuples(*(values(p.type) for p in declared)))
)


@settings(max_examples=60)
@given(cases)
def test_what_is_written_is_what_shaders_read(
    case: tuple[list[Parameter], tuple[Any, ...]],
) -> None:
    declared, given_values = case
    instance = Instance(reflected(declared))
    for parameter, value in zip(declared, given_values, strict=True):
        instance.set(parameter.name, host(parameter.type, value))
        assert instance.get(parameter.name) == host_tuples(parameter.type, value)
    (data,) = instance.blocks().values()
    (block,) = layout_blocks(declared)
    found = {
        member.parameter.name: read(data, member.offset, member.type)
        for member in block.members
        if member.parameter is not None
    }
    graph = Graph()
    for parameter, value in zip(declared, given_values, strict=True):
        parts = list(leaves(graph, graph.node("parameter", parameter.type, (), parameter)))
        expected = [evaluate(part, {parameter.name: value}) for part in parts]
        assert [evaluate(part, found) for part in lower_reads(graph, parts)] == expected
    gaps = [member for member in block.members if member.parameter is None]
    assert all(read(data, gap.offset, gap.type) == 0.0 for gap in gaps)


def host_tuples(type_: Type, value: Any) -> Any:
    """A value as a host reads it: arrays are tuples."""
    match type_:
        case Struct(members=members):
            return {n: host_tuples(t, v) for (n, t), v in zip(members, value, strict=True)}
        case Array(element=element):
            return tuple(host_tuples(element, part) for part in value)
        case _:
            return value


@settings(max_examples=20)
@given(cases)
def test_part_by_part_is_as_good_as_at_once(case: Case) -> None:
    declared, given_values = case
    whole, partial = (Instance(reflected(declared)) for _ in range(2))
    for parameter, value in zip(declared, given_values, strict=True):
        whole.set(parameter.name, host(parameter.type, value))
        set_parts(partial, parameter.name, parameter.type, value)
    assert partial.missing == ()
    assert partial.blocks() == whole.blocks()


def set_parts(instance: Instance, name: str, type_: Type, value: Any) -> None:
    """Sets every number, vector and matrix by its own name."""
    match type_:
        case Struct(members=members):
            for (member, inner), part in zip(members, value, strict=True):
                set_parts(instance, f"{name}.{member}", inner, part)
        case Array(element=element):
            for position, part in enumerate(value):
                set_parts(instance, f"{name}[{position}]", element, part)
        case _:
            instance.set(name, value)
