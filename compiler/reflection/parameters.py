"""The parameters' side of the reflection: the values that a host sets, and their places."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, TypedDict

from ..constraints import Lanes
from ..documents.values import ChoiceRow, DerivedRow, LayoutRow, LightRow, MemberRow, ParameterRow
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


def parameter_rows(
    infos: Sequence[ParameterInfo], places: Places, reads: Reads
) -> tuple[ParameterRow, ...]:
    """All declared parameters of a shader, or of a frame."""
    names = frozenset(info.leaf.name for info in infos)
    return tuple(_parameter_row(info, names, places, reads) for info in infos)


def _parameter_row(
    info: ParameterInfo, names: frozenset[str], places: Places, reads: Reads
) -> ParameterRow:
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
        read=reads.of(info),
    )


if TYPE_CHECKING:  # Python would compile the annotations while it loads this module.

    class Declared(TypedDict):
        """The fields of a row that say how a value is declared."""

        type: str
        representation: str
        range: tuple[float, float] | None
        choices: tuple[ChoiceRow, ...] | None
        default: Lanes
        doc: str
        library: str | None


def _declaration(info: ParameterInfo) -> Declared:
    return {
        "type": info.declared_type,
        "representation": str(info.leaf.type),
        "range": info.range,
        "choices": choices_of(info.leaf),
        "default": info.default,
        "doc": info.doc,
        "library": info.library or None,
    }


def choices_of(parameter: Parameter) -> tuple[ChoiceRow, ...] | None:
    """The members of the enumeration that a value is of, if it is of any."""
    meaning = parameter.meaning
    if meaning is None or meaning.enumeration is None:
        return None
    return tuple(
        ChoiceRow(name=choice.name, doc=choice.doc) for choice in meaning.enumeration.choices
    )


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
        "choices": None,
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


# --- what is read --------------------------------------------------------------------------------
# A block has all parameters of its group, so that its layout does not depend on what is read of it.

_PARTS = ("member", "index")
"""The operations that take a part of a value."""

_COUNT = ("count",)
"""The path of the number of an array's lights."""

Path = tuple[str, ...]
"""The names of members, from the outermost one to that which is meant; none for a whole value."""


class Reads:
    """The parts of parameters that something reads."""

    def __init__(self) -> None:
        self._paths: dict[str, set[Path]] = {}
        """For each parameter, by name, what is read of it."""
        self._of_lights: dict[str, set[Path]] = {}
        """For each entry of the rig, by name, what shaders of a frame read of its lights."""

    def add(self, nodes: Iterable[Node]) -> None:
        """Add what some nodes read; those that they need are among them."""
        nodes = list(nodes)
        operands: set[int] = set()
        whole: set[int] = set()
        for node in nodes:
            for place, operand in enumerate(node.operands):
                operands.add(operand.id)
                if place or node.op not in _PARTS:
                    whole.add(operand.id)
        for node in nodes:
            if node.id in operands and node.id not in whole:
                continue  # Only parts of it are read.
            if (source := _source(node)) is not None:
                parameter, path = source
                self._paths.setdefault(parameter.name, set()).add(path)

    def add_of_lights(self, shader_reads: Reads, infos: Iterable[ParameterInfo]) -> None:
        """Add what a shader of the frame reads of its lights, whatever they are called there."""
        for info in infos:
            if info.light is not None:
                found = shader_reads._paths.get(info.leaf.name, ())
                of_entry = self._of_lights.setdefault(info.light.entry, set())
                of_entry.update((*_own(info), *path) for path in found)

    def of(self, info: ParameterInfo) -> tuple[str, ...] | None:
        """The parts of a parameter that are read, by name; ``None`` if all of it is."""
        name = info.leaf.name
        paths = set(self._paths.get(name, ()))
        if info.light is not None:
            own = _own(info)
            of_entry = self._of_lights.get(info.light.entry, ())
            paths |= {path[len(own) :] for path in of_entry if path[: len(own)] == own}
            if own == _COUNT and of_entry:
                return None  # The host draws as often as it says.
        if () in paths:
            return None
        return tuple(sorted(".".join((name, *path)) for path in paths))


def _own(info: ParameterInfo) -> Path:
    """The path of a parameter in its light: a single light has a parameter for each member."""
    assert info.light is not None
    name = info.leaf.name.removeprefix(info.light.name).removeprefix(".")
    return (name,) if name else ()


def _source(node: Node) -> tuple[Parameter, Path] | None:
    """The parameter that a node is, or is a part of, and the part; ``None`` for other nodes."""
    path: list[str] = []
    while node.op in _PARTS:
        if node.op == "member":
            path.append(str(node.data))
        node = node.operands[0]
    if not isinstance(node.data, Parameter) or node.data.derived:
        return None
    return node.data, tuple(reversed(path))
