"""The state of one elaboration: the trees that are being made, and all that is known already.

This module holds data and no rules. The rules for each kind of expression are handed in, so that
the modules in which they stand can import this one.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping, Sequence
from enum import Enum
from typing import Any, TypeAlias

from ....support.frozen import fresh, frozen, record
from ...diagnostics.diagnostic import Diagnostic, Report
from ...diagnostics.source import Span
from ...ir.meaning import Meaning
from ...ir.node import Formal, Node, reachable
from ...ir.ranges import Ranges
from ...ir.shader import ExternInfo, Notes, ParameterInfo
from ...ir.types import Type
from ...syntax import ast
from ..inheritance.flattening import Records
from ..names.modules import Module, Symbol
from ..types.meanings import Meanings
from ..types.typenames import Declared, TypeResolver
from .conditions import Conditions
from .constants import ConstantValues
from .crossings import Crossings
from .deferred import Deferred
from .places import Places
from .scope import (
    Application,
    Continuation,
    DefaultKey,
    Failure,
    Instance,
    RigEntry,
    Scope,
    Value,
    Way,
)
from .transcripts import Transcripts
from .tree import Tree


@record
class WrittenTypes:
    """The resolved written types, as far as anybody has asked."""

    resolver: TypeResolver
    declared: dict[ast.TypeName, Declared | None] = fresh(factory=dict)
    structs: dict[Symbol, Declared | None] = fresh(factory=dict)
    enumerations: dict[Symbol, Declared | None] = fresh(factory=dict)
    struct_members: dict[str, tuple[tuple[str, Type], ...]] = fresh(factory=dict)
    """The members of structures, by the names that texts call them."""
    ways: dict[tuple[Instance | None, ...], tuple[Way, ...]] = fresh(factory=dict)
    """The transforms in scope, by the instances around an expression (``transform_paths``)."""
    counts: dict[Hashable, int | None] = fresh(factory=dict)
    """Numbers of elements, by the expression and the type parameters that it may read."""


@record
class ExternBlocks:
    """The blocks of the host that have been read so far."""

    known: dict[Symbol, ExternInfo] = fresh(factory=dict)
    """The blocks by their declarations, in the order in which they were met."""
    parameters: dict[tuple[Module, str], ParameterInfo | None] = fresh(factory=dict)
    """The members, by file and name."""
    reading: set[Module] = fresh(factory=set)
    """Files whose blocks are being read: defaults there cannot be made of members."""

    @property
    def infos(self) -> tuple[ExternInfo, ...]:
        """All blocks, in the order in which they were met."""
        return tuple(self.known.values())


@record
class Lights:
    """The lights of the rig, as far as somebody has asked for them."""

    types: dict[int, Declared] = fresh(factory=dict)
    """The declared types of the slots of ``light``, by the variables for them in terms."""
    instances: dict[tuple[str, Instance], tuple[Instance, Formal | None]] = fresh(factory=dict)
    bodies: dict[Application, LightBody | Failure] = fresh(factory=dict)
    """Bodies of terms that are summed over the lights."""
    named: dict[str, Instance] = fresh(factory=dict)
    """The single lights of a rig, whose parameters the equations of a frame read by name."""


@record
class Progress:
    """The values that are being computed at the moment, and those that never can be."""

    active: dict[Hashable, tuple[str, Span]] = fresh(factory=dict)
    """The demands by key, outermost first: to meet one of them again is a cycle."""
    cyclic: set[Hashable] = fresh(factory=set)
    """Values that are defined by themselves, which has been reported."""
    recursive: set[Symbol] = fresh(factory=set)
    """Functions that call themselves, which has been reported."""
    unproven: int = 0
    """The number of times that a check depended on a variable's value, in the current body.

    It may have depended on how large the value is, say. Then its outcome does not hold for all
    values.
    """
    joins_groups: bool = False
    """True if some value has been joined from those of a work group."""
    reads_view: bool = False
    """True if some value depends on the number of the view that is drawn."""
    depth: int = 0
    """The number of values computed inside each other on Python's stack (``evaluation``)."""


Given: TypeAlias = "Node | tuple[Type, Meaning | None]"
"""A call's argument for the body: its node if it is known, otherwise its type and meaning."""


Kinds: TypeAlias = "tuple[tuple[Type, Meaning | None], ...]"
"""The type and the meaning of each argument of a call."""


@frozen
class Overloads:
    """The functions that a file has under one name."""

    exact: dict[Kinds, Symbol | None]
    """The functions without type parameters, by their declared arguments.

    There is none of several that differ in their results alone.
    """
    of_count: dict[int, list[Symbol]]
    """All of them, by how many arguments they take by position."""


class Context:
    """One elaboration: its trees, and everything that its expressions can refer to."""

    def __init__(self, report: Report, records: Records, rules: Rules) -> None:
        self.report = report
        self.records = records
        self.rules = rules
        self.rig: tuple[RigEntry, ...] = ()
        self.tree = Tree(records.work)
        self.notes = Notes()
        self.places = Places(self.notes.spans)
        self.crossings = Crossings(self.tree, report, self.follow, self.places)
        self.constants = ConstantValues(report, self._is_wrong, records.work)
        self.meanings = Meanings(self.tree)
        self.ranges = Ranges(())
        """Ranges of values so far: they bound loops and prove lengths."""
        self.extent: Node | None = None
        """The number of elements that a kernel computes."""
        self.ends: dict[Formal, Node] = {}
        """The exclusive upper bounds of the indices of loops that count from 0."""
        self.conditions = Conditions(self.constants, self.ranges)
        self.deferred = Deferred(report, self.tree, self.conditions)
        self.types = WrittenTypes(TypeResolver(report))
        self.externs = ExternBlocks()
        self.progress = Progress()
        self.passing: Instance | None = None
        """The pass, whose transforms are in scope everywhere."""
        self.applied: dict[Application, Node | Failure] = {}
        """Values of functions and of the file's constants."""
        self.defaults: dict[DefaultKey, Node | Failure] = {}
        """Values of arguments that calls leave out."""
        self.overloads: dict[Symbol, Overloads] = {}
        """The overloads, by the first function of each name."""
        self.lights = Lights()
        self.is_step: dict[Instance, Callable[[tuple[str, int]], bool]] = {}
        """For frames, and lights that bring something to them: is a slot a step, without a value?

        The key is the slot's name and the level at which it is defined.
        """
        self.transcripts = Transcripts()
        """How slots of the library got their values in another elaboration."""
        self.call_sizes: dict[Symbol, int] = {}
        """The number of bodies in one call of a function (``call_sizes``)."""
        self.entered: set[Symbol] = set()
        """Functions and terms whose bodies were evaluated."""
        self.twins: dict[Instance, Callable[[], Twin]] = {}
        """For each material, pass or light, the same one in a context apart (``Twin``)."""
        self.is_twin = False
        self.placeholders: set[Node] = set()
        """Arguments and slots without a value, in a declaration that is checked by itself."""
        self.shaded: dict[tuple[Instance, Hashable], Instance] = {}
        """Surfaces with slots replaced by ``with``, by the surface and the new values."""
        self.shaded_from: dict[Instance, tuple[Instance, Mapping[str, Node | Failure]]] = {}
        """For each of these, the surface without replacements, and the new values."""
        self.bodies = SharedBodies()

    def follow(self, old: Node, new: Node) -> None:
        """Hands all knowledge about a node on to its copy."""
        self.notes.follow(old, new)
        self.deferred.follow(old, new)

    def _is_wrong(self, node: Node) -> bool:
        return self.deferred.is_wrong(node)

    def reached(self) -> Iterator[Symbol]:
        """The functions, terms, constants and structures that were checked by being used."""
        yield from self.entered
        yield from self.types.structs
        yield from self.types.enumerations
        yield from (symbol for symbol, *_ in self.applied)

    def is_left_to_a_use(self, node: Node) -> bool:
        """True if a value depends on a placeholder, so that only a use can say what it is."""
        return not self.placeholders.isdisjoint(reachable((node,)))


Twin: TypeAlias = "tuple[Context, Instance]"
"""An instance in a context of its own, which can be asked for the types of overridden slots.

Nothing there is part of the shader or reported, so it does no harm if an overridden equation is
wrong, or is defined by its own override.
"""


class Unfixed(Enum):
    """A form of values with which no body is checked as they are."""

    SPLAT = "one number in all lanes"
    ADAPTS = "a choice between literals, or a large constant expression"


Shape: TypeAlias = "str | Unfixed | None"
"""What checks may see in an argument besides its type: of a constant, the expression as a text."""


@frozen
class Signature:
    """The key of calls of a function that share a body."""

    symbol: Symbol
    given: tuple[Given, ...]
    """The kind, or the value, of each argument, and then of each replaced slot."""
    shapes: tuple[Shape, ...]
    """For each number, vector and matrix among these, what checks may see in it."""
    units: tuple[bool, ...]
    """For each of them, does it have length one? Empty, if the body is ``repeated``."""
    surface: Instance | None
    """The surface that is shaded; without replaced slots, unless the body is ``repeated``."""
    slots: tuple[str, ...]
    """The names of the slots that are replaced; none if the body is ``repeated``."""
    repeated: bool
    """True if each call repeats the body, with its own arguments in it; otherwise it applies it."""


@frozen
class SharedBody:
    """The result of a function for a signature."""

    value: Node
    """The value of the body: of one that is applied, closed."""
    formals: tuple[Formal, ...]
    """The variables of the body."""
    parts: tuple[Node, ...] = ()
    """The placeholders for the parts of the arguments, in a body that is repeated."""
    own: tuple[Node, ...] = ()
    """The nodes of a body that is repeated, operands before users."""


@frozen(eq=False)
class NotedNode:
    """A node of a body that is kept."""

    node: Node
    noted: tuple[tuple[int, Any], ...]
    """What is noted about it, each with the number of its table."""


@frozen(eq=False)
class KeptBody:
    """The body of a library function, as it was checked in an elaboration of its own."""

    value: Node
    formals: tuple[Formal, ...]
    """The variables of the body."""
    parts: tuple[NotedNode, ...]
    """The placeholders for the parts of the arguments, with the names and docs that they got.

    There are none if the body is applied.
    """
    constants: tuple[NotedNode, ...]
    """The nodes that are the same for all arguments, operands before users."""
    own: tuple[NotedNode, ...]
    """The nodes that each call repeats, operands before users; none if the body is applied."""
    applicable: frozenset[Node]
    """The bodies among the constants that may be applied."""
    structures: tuple[tuple[Symbol, Declared | None], ...]
    """The structures that values in it may be of, each with its type."""
    made: int
    """The number of nodes that checking it makes."""


def _none_kept(_signature: Signature, _parts: tuple[Node, ...]) -> KeptBody | None:
    return None


@record
class SharedBodies:
    """The bodies of functions, as far as they have been checked."""

    kept: Callable[[Signature, tuple[Node, ...]], KeptBody | None] = _none_kept
    """Gives the body of a library function for a signature and the parts of a call's arguments."""
    copies: dict[Node, Node] = fresh(factory=dict)
    """The constants of kept bodies, as they were made here."""
    known: dict[Signature, SharedBody | KeptBody | Failure | None] = fresh(factory=dict)
    """Checked bodies; ``None`` where they depend on the arguments' values."""
    applicable: set[Node] = fresh(factory=set)
    """Bodies among these that do not depend on the caller, with their variables bound."""
    withheld: dict[Signature, tuple[Diagnostic, ...]] = fresh(factory=dict)
    """Errors in a function's body that occur as long as nothing is known of its arguments."""


@frozen
class LightBody:
    """A term's body, closed, and the variables in it that stand for slots of the light."""

    body: Node
    slots: Mapping[str, Node]


@frozen
class Rule:
    """The rule for one kind of expression; ``Any`` is the class of its syntax tree."""

    operands: Callable[[Any, Scope], Sequence[ast.Expression]]
    """The parts that are checked first, in the expression's own scope and in this order."""
    value: Callable[[Context, Any, Sequence[Node], Scope], Value | Continuation]
    """The expression's value, given those of its operands.

    Nobody asks for it where one of them is wrong, or is no value: that has been reported.
    """


@frozen
class OpenRule:
    """A rule whose operands may be more than values: have members, or be called."""

    operands: Callable[[Any, Scope], Sequence[ast.Expression]]
    value: Callable[[Context, Any, Sequence[Value], Scope], Value | Continuation]
    """Gives the expression's value; it sees wrong operands, too."""


Rules: TypeAlias = Mapping[type[ast.Expression], Rule | OpenRule]
"""The rule for each kind of expression."""
