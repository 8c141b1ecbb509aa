"""Scopes: the values of names while an expression is being checked."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Literal

from ....support.frozen import changed, fresh, frozen, record
from ...diagnostics.source import Span
from ...ir.expansion import Expansion
from ...ir.leaves import Leaf, Parameter
from ...ir.meaning import Meaning
from ...ir.node import Node
from ...ir.shader import PatchPattern, Result
from ...ir.stages import VERTEX, Crossing, StageRow, SystemInput
from ...ir.tessellation import Tessellation
from ...ir.types import Opaque
from ...syntax import ast
from ..inheritance.records import Definition, Record
from ..names.modules import Module, Symbol
from ..types.typenames import Declared, Variable, Variables
from .origins import Origin


@frozen
class Failure:
    """The value of an expression about which something has been reported already."""


FAILURE = Failure()

OUTERMOST = -1
"""Level −1: an override from outside, which wins over the record's own definitions.

It is from a pass, `with` or a rig's entry.
"""


@record
class Instance:
    """A record whose names have values: the surface being shaded, one rig entry, the pass.

    Values are checked on demand and once. ``replaced`` holds slots given from outside (a pass's
    overrides, ``with { … }``, a rig entry's own settings).
    """

    record: Record
    prefix: str = ""
    """Put before names in the output: ``sun`` gives ``sun_to_light``."""
    surface: Instance | None = None
    """The material instance whose slots are visible behind this record's own names."""
    leaves: Mapping[str, Node] = fresh(factory=dict)
    """The values read from outside, by name; for one light of many, members of an array element."""
    replaced: dict[str, Replacement] = fresh(factory=dict)
    made: DerivedVertices | None = None
    """The slots at vertices that are made of those of a mesh, of the surface and the pass."""
    values: dict[tuple[str, int], Node | Failure] = fresh(factory=dict)

    @property
    def bound(self) -> Mapping[str, Node]:
        """The textures and buffers, which the host binds by their names."""
        return {name: leaf for name, leaf in self.leaves.items() if isinstance(leaf.type, Opaque)}

    @property
    def origin(self) -> Origin | None:
        """The origin of vertex inputs, where vertices are made of those of a mesh."""
        return None if self.made is None else self.made.origin

    @property
    def steps(self) -> tuple[DerivedVertices, ...]:
        """The steps that make its vertices of those of a mesh, in pipeline order."""
        return () if self.made is None else (*self.made.base.steps, self.made)

    @property
    def vertex_stage(self) -> StageRow:
        """The stage that delivers its vertices."""
        return VERTEX if self.made is None else self.made.stages[-1]

    def has(self, name: str) -> bool:
        """True if the record defines ``name``."""
        return name in self.record.definitions or name in self.replaced

    def declares(self, name: str, level: int) -> bool:
        """True if ``name`` was declared at ``level`` of the chain, or by an ancestor of that level.

        A name that only a more derived record declares was unknown to whoever wrote the text of
        ``level``.
        """
        found = self.record.definitions.get(name)
        return found is not None and found[-1].level >= level

    def with_replaced(self, replaced: Mapping[str, Replacement]) -> Instance:
        """A copy of the instance with slots given from outside, and nothing checked yet."""
        return changed(self, replaced={**self.replaced, **replaced}, values={})


@frozen
class Replacement:
    """A slot's value given from outside its record: already checked, or to be checked there."""

    value: Node | Failure | None = None
    definition: Definition | None = None
    within: Instance | None = None
    """The instance in whose scope ``definition`` is checked."""
    made: bool = False
    """True if an expansion or a tessellation gives it another value at each vertex it makes."""


@frozen(eq=False)
class VertexGroup:
    """Vertices that are made alike: a group of strips of an expansion, or all of a patch."""

    equations: Mapping[str, ast.Slot]
    """The equations of slots at these vertices."""
    scope: Scope
    """The scope in which they are checked."""


@record
class DerivedVertices:
    """A surface whose vertices are made of those of a mesh, and the slots of it and its pass."""

    base: Instance
    """The surface at the vertices that these are made of.

    They are the mesh's own, or those of divided patches.
    """
    passing: Instance | None
    """The pass as it is there; ``None`` where a material's mixin is checked alone."""
    corners: int
    """The number of vertices of each primitive, or patch, of the mesh."""
    stages: tuple[StageRow, ...]
    """The stages that make the vertices; the last one delivers them."""
    inputs: Mapping[str, SystemInput]
    """The inputs that the pipeline supplies, by their names in expressions."""
    origin: Origin | None = None
    """The origin of the vertex inputs at the vertices that are made."""
    groups: tuple[VertexGroup, ...] = ()
    unset: Instance | None = None
    """In a tessellation, the surface at these vertices if nothing is set anew."""
    passing_unset: Instance | None = None
    """The pass as it is there."""
    expansion: Expansion | None = None
    """The expansion, which is the same for all primitives; ``None`` if it is wrong."""
    tessellation: Tessellation | None = None
    """The tessellation, which is the same for all patches; ``None`` if it is wrong."""
    results: tuple[Result, ...] = ()
    """The results of the stages besides vertices: which strips there are, or a patch's levels."""
    pattern: PatchPattern | None = None
    """The pattern of a tessellation, with the places of the vertices of a patch."""
    values: dict[tuple[int, str], Node | Failure] = fresh(factory=dict)
    """The value of a slot at made vertices, by the number of the group and the slot's name.

    Each is checked on demand and once.
    """

    @property
    def parts(self) -> tuple[Instance, ...]:
        """All surfaces and passes that its equations read, and those that these are made of."""
        before = () if self.base.made is None else self.base.made.parts
        parts = (*before, self.base, self.passing, self.unset, self.passing_unset)
        return tuple(part for part in parts if part is not None)

    def is_set_behind(self, instance: Instance, name: str) -> bool:
        """True if ``instance`` is the surface where nothing is set anew, and this slot is."""
        return instance is self.unset and any(name in group.equations for group in self.groups)

    def base_of(self, instance: Instance) -> Instance:
        """The surface or the pass, whichever ``instance`` is, as ``base`` is."""
        if instance.surface is None:
            return self.base
        assert self.passing is not None
        return self.passing


@frozen
class Corners:
    """``corner`` or ``end``: vertices of the primitive that others are made of."""

    word: str
    instance: Instance
    """The instance whose slots they have.

    It is the surface, or the pass if the expansion stands there, and behind its slots those of the
    surface.
    """
    numbers: tuple[int, ...]
    """The numbers of these vertices in the primitive."""
    crossing: Crossing
    """The crossing of values from them to where they are read."""


@frozen
class Corner:
    """``corner[k]``: a surface or a pass as it is at one of them."""

    instance: Instance
    """The instance at the vertices that the corners are."""
    number: Node
    crossing: Crossing


@frozen
class LightVariable:
    """``light`` inside a ``per light`` term: its slots become the variables of a shared body."""

    variables: dict[str, Node]
    record: Record
    """A light of the rig, from which the slots' types are taken."""
    instance: Instance


@frozen
class Inherited:
    """``inherited``: the names of an instance as the levels above ``level`` define them."""

    instance: Instance
    level: int


@frozen
class Members:
    """``Mode``, the name of an enumeration, whose members are values."""

    symbol: Symbol

    @property
    def example(self) -> str:
        """The hint for the name of an enumeration where a value is wanted."""
        declaration = self.symbol.declaration
        assert isinstance(declaration, ast.Enumeration)
        members = [member.name.text for member in declaration.members]
        written = f"{self.symbol.name}.{members[0] if members else '…'}"
        return (
            f"a value of it is `{written}`; `(n as {self.symbol.name})` is the member of a number"
        )


@frozen
class Undecided:
    """A call, or a choice, whose type is that which is wanted of it: one of several.

    Functions with the same arguments differ in their results, so the place of a call decides.
    """

    results: tuple[Declared, ...]
    """The types that there are."""
    value: Callable[[int], Value]
    """Gives the value of one of these types, by its number."""
    report: Callable[[], None]
    """Reports that no place has decided."""

    def decided(self, *wanted: Declared) -> Value:
        """The value of the one type that is wanted; the same again if none is, or several are."""
        types = {each.type for each in wanted}
        found = [i for i, result in enumerate(self.results) if result.type in types]
        meanings = {each.meaning for each in wanted}
        meant = [i for i in found if self.results[i].meaning in meanings]
        found = meant or found
        return self.value(found[0]) if len(found) == 1 else self


@frozen
class Way:
    """A transform in scope, and the way in which it is taken."""

    instance: Instance
    name: str
    meaning: Meaning
    back: bool = False

    @property
    def ends(self) -> tuple[str, ...]:
        """The spaces from which and to which the way leads."""
        return self.meaning.spaces[::-1] if self.back else self.meaning.spaces


Value = (
    Node | Failure | Instance | LightVariable | Inherited | Corners | Corner | Members | Undecided
)

Application = tuple[Symbol, tuple[int, ...], Instance | None]
"""A function, the ids of its arguments, and the surface that it shades."""


DefaultKey = tuple[
    ast.Argument, tuple[int, ...], tuple[tuple[str, Variable], ...], Instance | None
]  # fmt: skip
"""An argument with a default, the ids of what it reads, type parameters, and the surface."""


@record
class FunctionParts:
    """The equations behind a function's ``where``, for one application of it; checked on demand."""

    declared: Mapping[str, ast.Slot]
    scope: Scope
    """The arguments' scope, in which the equations themselves are checked."""
    values: dict[str, Node | Failure] = fresh(factory=dict)


@frozen
class Scope:
    """A scope for names: locals, the record's own names, the file's names, the surface."""

    module: Module
    instance: Instance | None = None
    level: int = 0
    """The level of ``instance``'s chain whose text is being checked."""
    surface: Instance | None = None
    locals: Mapping[str, Value] = fresh(factory=dict)
    variables: Variables = fresh(factory=dict)
    """The values of type parameters, of the function whose body this is."""
    parts: FunctionParts | None = None
    """The names of that function behind ``where``."""
    loops: int = 0
    """The number of loops of the same expression around the text that is being checked."""

    def inside_loop(self, locals_: Mapping[str, Value]) -> Scope:
        """The scope of a loop's body: this one with the loop's own names."""
        return changed(self, locals={**self.locals, **locals_}, loops=self.loops + 1)


@frozen
class Continuation:
    """Parts of an expression to evaluate after its operands, and what to make of them then.

    They are the body of a loop, which has names of its own, or the sides of a choice.
    """

    expressions: tuple[ast.Expression, ...]
    scope: Scope
    then: Callable[[Sequence[Node]], Value | Continuation]


@frozen
class RigEntry:
    """One line of a rig: its light and where its parameters are kept."""

    name: str
    """The host's name: ``sun``, or ``Rig.sun`` where that name is taken."""
    short_name: str
    """The name that the rig gives it."""
    span: Span
    """The span of the name."""
    record: Record
    kind: Literal["single", "array", "buffer"]
    leaves: tuple[Leaf, ...]
    """The leaves of a single light; of several lights the array or the buffer that holds them."""
    bound: int = 1
    count: Parameter | None = None
    """The run-time count of ``[<= N]`` and ``[]``."""
    replaced: Mapping[str, Replacement] = fresh(factory=dict)
