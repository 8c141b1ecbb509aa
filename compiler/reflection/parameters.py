"""The parameters' side of the reflection: what a host sets, and where it lies."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from ..ir.leaves import Parameter
from ..ir.node import Node
from ..ir.program import Block, StoredMember
from ..ir.types import Array
from ..packing import PackedMember, Packing, packing
from ..semantics.shader import ParameterInfo
from .bytes import layout_row
from .values import listed, steps

LIGHT_GROUP = "rig"


class Places:
    """Finds the block and the member in which a parameter is kept."""

    def __init__(self, blocks: Sequence[Block]) -> None:
        self._places = {
            (member.parameter.name, block.derived): (block, member)
            for block in blocks
            for member in block.members
            if member.parameter is not None
        }

    def row(self, parameter: Parameter) -> dict[str, Any]:
        """Block, offset and size; null where the program leaves the block out."""
        found = self._places.get((parameter.name, parameter.derived))
        return {
            "block": found[0].name if found else None,
            "offset": found[1].offset if found else None,
            "size": packing(parameter.type).size,
            "layout": layout_row(packing(parameter.type)),
        }

    def derived(self) -> list[StoredMember]:
        """The members that a host has to compute, in order."""
        return [member for (_, derived), (_, member) in self._places.items() if derived]


def parameter_row(info: ParameterInfo, names: frozenset[str], places: Places) -> dict[str, Any]:
    """One declared parameter; ``names`` are those of all parameters."""
    parameter = info.parameter
    counter = f"{parameter.name}.count"
    return {
        "name": parameter.name,
        **_declaration(info),
        "group": parameter.group,
        **places.row(parameter),
        "members": _members(packing(parameter.type), info.members),
        "count": counter if counter in names else None,
    }


def _declaration(info: ParameterInfo) -> dict[str, Any]:
    return {
        "type": info.declared_type,
        "representation": str(info.parameter.type),
        "range": listed(info.range),
        "default": listed(info.default),
        "doc": info.doc,
    }


def _members(packed: Packing, infos: Sequence[ParameterInfo]) -> list[dict[str, Any]]:
    """Members of a struct or of an array's elements, with what was declared about them."""
    declared = {info.parameter.name.rpartition(".")[2]: info for info in infos}
    return [_member(member, declared.get(member.name)) for member in packed.members]


def _member(member: PackedMember, info: ParameterInfo | None) -> dict[str, Any]:
    written = str(member.packing.type)
    undeclared = {
        "type": written,
        "representation": written,
        "range": None,
        "default": None,
        "doc": "",
    }
    return {
        "name": member.name,
        **(undeclared if info is None else _declaration(info)),
        "offset": member.offset,
        "size": member.packing.size,
        "layout": layout_row(member.packing),
        "members": _members(member.packing, () if info is None else info.members),
    }


def derived_rows(places: Places, values: Mapping[Parameter, Node]) -> list[dict[str, Any]]:
    """What the host computes, with the steps that compute it."""
    return [_derived_row(member, places, values) for member in places.derived()]


def _derived_row(
    member: StoredMember, places: Places, values: Mapping[Parameter, Node]
) -> dict[str, Any]:
    parameter = member.parameter
    assert parameter is not None
    return {
        "name": parameter.name,
        "representation": str(parameter.type),
        "group": parameter.group,
        **places.row(parameter),
        "doc": member.doc,
        "steps": steps(values[parameter]),
    }


def light_rows(parameters: Sequence[ParameterInfo]) -> list[dict[str, Any]]:
    """The rig's lights: an array is one parameter, a single light one parameter for each member."""
    entries: dict[str, list[ParameterInfo]] = {}
    for info in parameters:
        if info.light and info.parameter.group == LIGHT_GROUP:
            entries.setdefault(info.light, []).append(info)
    return [_light_row(name, infos) for name, infos in entries.items()]


def _light_row(name: str, infos: list[ParameterInfo]) -> dict[str, Any]:
    array = next((info.parameter.type for info in infos if info.parameter.name == name), None)
    names = [info.parameter.name for info in infos]
    counter = f"{name}.count"
    return {
        "name": name,
        "capacity": array.count if isinstance(array, Array) else None,
        "count": counter if counter in names else None,
        "parameters": [each for each in names if each != counter],
    }
