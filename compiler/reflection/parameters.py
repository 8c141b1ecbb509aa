"""The parameters' side of the reflection: the values that a host sets, and their places."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, TypedDict

from ..constraints import Lanes
from ..documents.values import DerivedRow, LayoutRow, LightRow, MemberRow, ParameterRow
from ..ir.leaves import Parameter
from ..ir.node import Node
from ..ir.program import Block, StoredMember
from ..ir.shader import LightInfo, ParameterInfo
from ..ir.types import Array
from ..packing import PackedMember, Packing, packing, spread
from .bytes import layout_row
from .roles import role_of, role_of_derived
from .values import steps


class Places:
    """Finds the block and the member in which a parameter is kept."""

    def __init__(self, blocks: Sequence[Block]) -> None:
        self._places = {
            (member.parameter.name, block.derived): (block, member)
            for block in blocks
            for member in block.members
            if member.parameter is not None
        }

    def row(self, parameter: Parameter) -> Placed:
        """Block, offset and size; null where the program leaves the block out."""
        found = self._places.get((parameter.name, parameter.derived))
        return _place(found, 0, packing(parameter.type))

    def table_rows(self, parameter: Parameter) -> list[tuple[str, Placed]]:
        """The name and the place of each member of a table's structures."""
        found = self._places.get((parameter.name, parameter.derived))
        table = packing(parameter.type)
        return [(m.name, _place(found, m.offset, spread(table, m))) for m in table.members]

    def derived(self) -> list[StoredMember]:
        """The members that a host has to compute, in order."""
        return [member for (_, derived), (_, member) in self._places.items() if derived]


if TYPE_CHECKING:  # Python would compile the annotations while it loads this module.

    class Placed(TypedDict):
        """The fields of a row that say where a value lies."""

        block: str | None
        offset: int | None
        size: int
        layout: LayoutRow


def _place(found: tuple[Block, StoredMember] | None, further: int, packed: Packing) -> Placed:
    return {
        "block": found[0].name if found else None,
        "offset": found[1].offset + further if found else None,
        "size": packed.size,
        "layout": layout_row(packed),
    }


def parameter_rows(infos: Sequence[ParameterInfo], places: Places) -> tuple[ParameterRow, ...]:
    """All declared parameters of a shader, or of a frame."""
    names = frozenset(info.leaf.name for info in infos)
    return tuple(_parameter_row(info, names, places) for info in infos)


def _parameter_row(info: ParameterInfo, names: frozenset[str], places: Places) -> ParameterRow:
    """One of them; ``names`` are those of all, as one may count the elements of another."""
    parameter = info.leaf
    counter = f"{parameter.name}.count"
    return ParameterRow(
        name=parameter.name,
        **_declaration(info),
        declared_by=info.declared_by or None,
        role=role_of(info),
        group=parameter.group,
        **places.row(parameter),
        members=member_rows(packing(parameter.type), info.members),
        count=counter if counter in names else None,
    )


if TYPE_CHECKING:  # Python would compile the annotations while it loads this module.

    class Declared(TypedDict):
        """The fields of a row that say how a value is declared."""

        type: str
        representation: str
        range: tuple[float, float] | None
        default: Lanes
        doc: str
        library: str | None


def _declaration(info: ParameterInfo) -> Declared:
    return {
        "type": info.declared_type,
        "representation": str(info.leaf.type),
        "range": info.range,
        "default": info.default,
        "doc": info.doc,
        "library": info.library or None,
    }


def member_rows(packed: Packing, infos: Sequence[ParameterInfo]) -> tuple[MemberRow, ...]:
    """Members of a struct or of an array's elements, with their declarations."""
    declared = {info.leaf.short_name: info for info in infos}
    return tuple(_member(member, declared.get(member.name)) for member in packed.members)


def _member(member: PackedMember, info: ParameterInfo | None) -> MemberRow:
    written = str(member.packing.type)
    undeclared: Declared = {
        "type": written,
        "representation": written,
        "range": None,
        "default": None,
        "doc": "",
        "library": None,
    }
    return MemberRow(
        name=member.name,
        **(undeclared if info is None else _declaration(info)),
        offset=member.offset,
        size=member.packing.size,
        layout=layout_row(member.packing),
        members=member_rows(member.packing, () if info is None else info.members),
    )


def derived_rows(
    places: Places, values: Mapping[Parameter, Node], infos: Sequence[ParameterInfo]
) -> tuple[DerivedRow, ...]:
    """The values that the host computes of parameters, with the steps that compute them."""
    roles = {info.leaf.name: role_of(info) for info in infos}
    rows: list[DerivedRow] = []
    for member in places.derived():
        parameter = member.parameter
        assert parameter is not None
        value = values[parameter]
        if value.op == "struct":
            rows += _table_rows(parameter, places, value)
        else:
            representation = str(parameter.type)
            place = places.row(parameter)
            role = role_of_derived(value, roles)
            rows.append(_derived_row(parameter, "", representation, place, member.doc, value, role))
    return tuple(rows)


def _table_rows(parameter: Parameter, places: Places, element: Node) -> list[DerivedRow]:
    """A row for each member of the structures that stand beside an array."""
    members = zip(places.table_rows(parameter), element.operands, strict=True)
    return [
        _derived_row(
            parameter, f".{name}", f"{value.type}[{place['layout'].count}]", place, "", value
        )
        for (name, place), value in members
    ]


def _derived_row(
    parameter: Parameter,
    member: str,
    representation: str,
    place: Placed,
    doc: str,
    value: Node,
    role: str | None = None,
) -> DerivedRow:
    return DerivedRow(
        name=parameter.name + member,
        representation=representation,
        group=parameter.group,
        **place,
        doc=doc,
        role=role,
        steps=steps(value),
    )


def light_rows(parameters: Sequence[ParameterInfo]) -> tuple[LightRow, ...]:
    """The rig's lights: an array is one parameter, a single light one parameter for each member.

    A light may have parameters of several groups, and so in several blocks.
    """
    entries: dict[LightInfo, list[ParameterInfo]] = {}
    for info in parameters:
        if info.light is not None:
            entries.setdefault(info.light, []).append(info)
    return tuple(_light_row(light, infos) for light, infos in entries.items())


def _light_row(light: LightInfo, infos: list[ParameterInfo]) -> LightRow:
    name = light.name
    array = next((info.leaf.type for info in infos if info.leaf.name == name), None)
    names = [info.leaf.name for info in infos]
    counter = f"{name}.count"
    return LightRow(
        name=name,
        entry=light.entry,
        kind=light.kind,
        library=light.library or None,
        doc=light.doc,
        capacity=array.count if isinstance(array, Array) else None,
        count=counter if counter in names else None,
        parameters=tuple(each for each in names if each != counter),
    )
