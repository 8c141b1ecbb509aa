"""Makes the blocks of a material, with the code that computes derived ones.

They are called as in its reflection, until ``block_names`` has seen the blocks of all materials.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from ..compiler.documents.reflection import Reflection
from ..compiler.documents.steps import ParameterStep
from ..compiler.documents.values import BlockMember, BlockRow, DerivedRow, ParameterRow
from ..compiler.tracing import given
from ..support.frozen import changed
from ..support.unique import Names
from .derivation import Value, Values
from .fields import Field, Structure
from .helpers import Helpers
from .loose import end, loose
from .materials import Block, Derivation, Source
from .scheduling import Schedule, roots_of
from .statements import Each, Place, Set, Statement
from .structures import Structures, derived_field, table


class Blocks:
    """The blocks of one material."""

    def __init__(self, reflection: Reflection, structures: Structures, helpers: Helpers) -> None:
        """``structures`` and ``helpers`` are those of the binding, and get the material's."""
        self._reflection, self._structures, self._helpers = reflection, structures, helpers
        self._fields: dict[str, tuple[str, Field]] = {}
        """The plain name of the block and the field of each parameter."""

    def all(self) -> Iterator[Block]:
        """The blocks that a host fills, then those that are computed from them."""
        rows = self._reflection.blocks
        for row in rows:
            if not row.derived:
                yield self._given(row)
        yield from self._only_read()
        for row in rows:
            if row.derived:
                yield self._derived(row)

    def _given(self, row: BlockRow) -> Block:
        """A block that a host fills."""
        parameters = {each.name: each for each in self._reflection.parameters}
        words = {
            member.parameter: member.name for member in row.members if member.parameter is not None
        }
        fields = []
        for member in row.members:
            if member.parameter is not None:
                parameter = parameters[member.parameter]
                field = self._field(parameter, member.name, member.offset, words)
                self._fields[parameter.name] = row.name, field
                fields.append(field)
        structure = Structure(name=row.name, size=row.size, fields=tuple(fields))
        return Block(
            structure=structure, plain_name=row.name, group=row.group, layout_id=row.layout_id
        )

    def _field(self, row: ParameterRow, word: str, offset: int, words: Mapping[str, str]) -> Field:
        arrays = (each for each in self._reflection.parameters if each.count == row.name)
        counted = next(arrays, None)
        counts = "" if counted is None else words.get(counted.name, "")
        field = self._structures.field(row, word, offset, counts)
        return changed(field, counter=words.get(row.count, "") if row.count else "")

    def _only_read(self) -> Iterator[Block]:
        """Values that only derived ones need: a host sets them in blocks without a buffer."""
        needed = {
            step.parameter
            for steps in self._reflection.computed
            for step in steps
            if isinstance(step, ParameterStep)
        }
        rows = [
            row
            for row in self._reflection.parameters
            if row.name in needed and row.name not in self._fields
        ]
        for group in dict.fromkeys(row.group for row in rows):
            yield self._loose(group, [row for row in rows if row.group == group])

    def _loose(self, group: str, rows: Sequence[ParameterRow]) -> Block:
        name = _pascal(group)
        taken = {each.name for each in self._reflection.blocks}
        name = name if name not in taken else f"{name}Values"
        fields = loose(self._structures, rows)
        self._fields |= {field.name: (name, field) for field in fields}
        structure = Structure(name=name, size=end(fields), fields=fields)
        return Block(structure=structure, plain_name=name, group=group, layout_id="")

    def _derived(self, row: BlockRow) -> Block:
        """A block whose fields are computed."""
        rows = [each for each in self._reflection.derived if each.block == row.name]
        hints: dict[int, str] = {}
        values = Values(self._fields, self._helpers, hints)
        fields: list[Field] = []
        plain: list[tuple[Place, Field, Value]] = []
        tables: list[tuple[Field, list[tuple[Place, Field, Value]]]] = []
        index = given("i", "int", is_natural=True)
        for member in row.members:
            if member.parameter is None:
                continue
            own = [each for each in rows if each.name == member.parameter]
            if own and own[0].layout.count is None:
                field = derived_field(own[0], member.name, member.offset)
                place = Place(block=row.name, way=(field.word,))
                plain.append((place, field, values.of(own[0].steps)))
                _hint(hints, field, plain[-1][2])
            else:
                field, members = self._table(row, member, own, rows)
                computed = [
                    (place, each, values.of(steps.steps, ((index,),)))
                    for place, each, steps in members
                ]
                tables.append((field, computed))
            fields.append(field)
        statements = computing(plain, tables, hints)
        sources = tuple(Source(plain_name=each, name=each) for each in values.sources)
        structure = Structure(name=row.name, size=row.size, fields=tuple(fields))
        return Block(
            structure=structure, plain_name=row.name, group=row.group, layout_id=row.layout_id,
            derivation=Derivation(sources=sources, statements=statements),
            steps=tuple(each.steps for each in rows),
        )  # fmt: skip

    def _table(
        self,
        block: BlockRow,
        member: BlockMember,
        own: Sequence[DerivedRow],
        rows: Sequence[DerivedRow],
    ) -> tuple[Field, list[tuple[Place, Field, DerivedRow]]]:
        """The field of an array of derived values, with the places of what its elements have."""
        if own:
            field = derived_field(own[0], member.name, member.offset)
            return field, [(Place(block=block.name, way=(field.word, None)), field, own[0])]
        inside = [each for each in rows if each.name.startswith(f"{member.parameter}.")]
        name, _, count = member.type.rstrip("]").partition("[")
        size = next(each.size for each in block.structs if each.name == name)
        structure = table(self._structures, name, size, inside, member.offset)
        field = Field(
            name=member.parameter or "", word=member.name, type=structure, offset=member.offset,
            stride=size, capacity=int(count), computed=True,
        )  # fmt: skip
        places = [
            (Place(block=block.name, way=(field.word, None, each.word)), each, steps)
            for each, steps in zip(structure.fields, inside, strict=True)
        ]
        return field, places


def _hint(hints: dict[int, str], field: Field, lanes: Value) -> None:
    if len(lanes) == 1:
        hints[id(lanes[0])] = field.word


def computing(
    plain: Sequence[tuple[Place, Field, Value]],
    tables: Sequence[tuple[Field, Sequence[tuple[Place, Field, Value]]]],
    hints: Mapping[int, str],
) -> tuple[Statement, ...]:
    """The statements that compute a block's fields, and the members of its tables' elements."""
    names = Names(("i", "derived"))
    schedule = Schedule(names, hints, roots_of(lanes for _, _, lanes in plain))
    _set(schedule, plain, "")
    for field, members in tables:
        inner = schedule.inner(roots_of(lanes for _, _, lanes in members))
        _set(inner, members, "i")
        schedule.add(Each(index="i", count=field.capacity, body=inner.statements))
    return schedule.statements


def _set(schedule: Schedule, values: Sequence[tuple[Place, Field, Value]], index: str) -> None:
    for place, field, lanes in values:
        found = schedule.lanes(lanes)
        schedule.add(Set(place=place, field=field, index=index, lanes=found))


def _pascal(group: str) -> str:
    return "".join(word.capitalize() for word in group.split("_"))
