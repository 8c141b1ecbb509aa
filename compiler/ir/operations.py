"""The table of operations: everything that a node of the graph can be.

A row says what the operation means, what its ``data`` is, how many operands it has, which type its
value has and in which forms of the graph it may stand. The verifier checks all of that, so whoever
reads a verified graph may rely on it: ``FOLD.data(node)`` is a ``Folding``, to mypy too, wherever
``node.op == "fold"``. Sets of operations that passes ask for (``LEAVES``, ``LOOPS`` …) follow from
the rows.

A new operation is a name in ``Op`` and a row here; ``tests/passes/test_operations.py`` then names
the tables that have to know it: the reference, range analysis, meanings, emission.
"""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterator, Mapping
from operator import attrgetter
from types import NoneType
from typing import Any, Generic, Literal, TypeVar, get_args

from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.row import nowhere
from ...support.frozen import frozen
from . import result_types
from .leaves import Argument, Attribute, Buffer, Parameter, Texture
from .meaning import Meaning
from .node import Applying, Folding, Formal, Iterating, Node, Op
from .stages import Crossing, SystemInput
from .types import Type

Form = Literal["semantics", "opened", "flat", "guarded", "stored"]
"""The forms of a graph after certain passes, in order.

``semantics``: as semantics leaves it. ``opened``: its binders are opened (``open_binders``).
``flat``: without structures that the shader builds (``replace_aggregates``). ``guarded``: with
hardware operations, and such calls as each profile decides about (``guard``). ``stored``: it reads
parameters as blocks store them (``lower_reads``).
"""

FORMS: tuple[Form, ...] = get_args(Form)

Role = Literal[
    "constant",  # a leaf that is its own value
    "outside",  # a leaf whose value comes from outside the shader
    "variable",  # a leaf that a binder further out gives its value
    "builtin",  # a row of the table of builtins, for its operands
    "join",  # a larger value from parts
    "part",  # a part of a larger value
    "choice",  # one of two values
    "crossing",  # a value of an earlier stage
    "loop",  # turns of a body
    "function",  # a call of a body
    "mark",  # its first operand, about which something is noted
]

Rate = Literal["constant", "draw", "varying", "operands"]
"""The rate at which a value changes.

It changes never; from draw to draw; from vertex to vertex or pixel to pixel; or as often as its
operands do.
"""

Data = TypeVar("Data")

BranchMode = Literal["branch"]
BRANCH: BranchMode = "branch"
"""Data of a ``select`` that has to become a branch: one of its sides is safe only behind it."""


@frozen(eq=False)
class Operation(Generic[Data]):
    """One row: the properties of every node of one operation."""

    name: Op
    role: Role
    kinds: type[Data] | tuple[type[Any], ...]
    """The class of ``data``, or the classes."""
    result: Callable[[Node], Type | None]
    """The type of its value, from its operands and data; ``None`` where they do not fit."""
    arity: int | None = 0
    """The number of operands; ``None``: as many as it needs, at least one."""
    until: Form | None = "stored"
    """The last form in which it may stand; ``None``: only while semantics is still at work."""
    stays: Callable[[Node], bool] = lambda _: False
    """True for nodes that may stay in all later forms, too."""
    rate: Rate = "operands"
    is_global: bool = False
    """True if every function of a program can read it where it is."""
    cost: int = 0
    """ALU operations, not counting its operands; those of builtins are in their rows."""
    noun: str = ""
    """The name of a value of which nothing else is known; empty: as the operation."""
    data: Callable[[Node], Data] = attrgetter("data")
    """The data of a node of this operation."""

    @property
    def is_leaf(self) -> bool:
        """True if it has no operands."""
        return self.arity == 0

    @property
    def forms(self) -> tuple[Form, ...]:
        """The forms of the graph in which it may stand."""
        return () if self.until is None else FORMS[: FORMS.index(self.until) + 1]


LOOP = 32
"""The cost of a loop: it is worth skipping, however little it does in a turn."""

Constant = float | int | bool | tuple["Constant", ...]
"""Data of a constant: a scalar, or the tuple of its lanes; of a matrix, of its columns."""

# --- leaves --------------------------------------------------------------------------------------

CONSTANT = Operation[Constant](
    "constant", "constant", (float, int, tuple), result_types.constant,
    rate="constant", is_global=True,
)  # fmt: skip
"""A number, a bool, or a vector of them, that is known when compiling.

Constants are interned by how they are written: 1, 1.0 and true are different values, and so are 0.0
and -0.0.
"""

PARAMETER = Operation(
    "parameter", "outside", Parameter, result_types.declared, rate="draw", is_global=True
)
"""A member of a uniform block. Once reads are lowered, it has its stored type."""

TEXTURE = Operation(
    "texture", "outside", Texture, result_types.declared, rate="varying", is_global=True
)
"""A texture with the state of its sampler.

It is an operand of the builtins that read it, and of nothing else.
"""

BUFFER = Operation(
    "buffer", "outside", Buffer, result_types.declared, rate="varying", is_global=True
)
"""A storage buffer.

Its elements are read by ``index``, and nothing else is made of it. Once reads are lowered, it has
its stored type.
"""

ATTRIBUTE = Operation("attribute", "outside", Attribute, result_types.declared, rate="varying")
"""A vertex input."""

ARGUMENT = Operation("argument", "outside", Argument, result_types.declared, rate="varying")
"""An argument of a function that an engine calls.

It is no global value: the functions that this one calls get it as an argument of their own.
"""

INPUT = Operation("input", "outside", SystemInput, result_types.declared, rate="varying")
"""A value that the pipeline supplies to a stage, such as ``front_facing``."""

BOUND = Operation(
    "bound", "variable", int, result_types.own, until="semantics", rate="varying"
)  # fmt: skip
"""A variable of a closed binder, by its de Bruijn index.

The variables of the innermost binder come first, in order, then those of the next one out.
"""

FORMAL = Operation("formal", "variable", Formal, result_types.own, rate="varying")
"""A variable of an opened binder."""

# --- builtins ------------------------------------------------------------------------------------


def _is_by_profile(call: Node) -> bool:
    """True if profiles decide about a call, after the passes."""
    row = BUILTINS.get(CALL.data(call))
    return row is not None and row.by_profile is not nowhere


CALL = Operation(
    "call", "builtin", str, result_types.builtin, arity=None, until="flat", stays=_is_by_profile
)  # fmt: skip
"""A builtin with Burnish's meaning, which is defined for all operands; the data is its name.

Calls that some language can make without a guard stay to the end: ``targets/legalise`` decides.
"""

NATIVE = Operation("native", "builtin", str, result_types.builtin, arity=None)
"""A builtin as the hardware does it.

Where backends agree on it, that is its meaning; elsewhere the result may be anything, so ``guard``
uses it only where operands are proven harmless. Semantics makes one for ``unguarded(…)``.
"""

# --- values from parts ---------------------------------------------------------------------------

VECTOR = Operation("vector", "join", NoneType, result_types.vector, arity=None, noun="joined")
"""The lanes of scalars and vectors of one kind, joined, in order."""

SPLAT = Operation("splat", "join", NoneType, result_types.splat, arity=1, noun="filled")
"""A vector with one scalar in every lane."""

MATRIX = Operation("matrix", "join", NoneType, result_types.matrix, arity=None, noun="columns")
"""A matrix of its columns."""

STRUCT = Operation(
    "struct", "join", NoneType, result_types.aggregate, arity=None, until="opened"
)  # fmt: skip
"""A structure of its members. ``replace_aggregates`` does away with it."""

ARRAY = Operation("array", "join", NoneType, result_types.aggregate, arity=None, noun="elements")
"""An array of its elements.

In the end only arrays of plain values are left, with an index that is known at run time only.
"""

# --- parts of values -----------------------------------------------------------------------------

SWIZZLE = Operation[tuple[int, ...]](
    "swizzle", "part", tuple, result_types.swizzle, arity=1, noun="lanes"
)
"""Lanes of a vector, by their numbers, in any order and also more than once."""

INDEX = Operation("index", "part", NoneType, result_types.index, arity=2, noun="element")
"""A part of an aggregate, of the operands (aggregate, position).

It is an element of an array or a buffer, a column of a matrix or a lane of a vector. The position
lies within bounds: whoever makes an index that is computed clamps it.
"""

MEMBER = Operation("member", "part", str, result_types.member, arity=1, noun="part")
"""A member of a structure, by name: of a uniform block's, or of the states that a loop leaves."""

# --- the rest ------------------------------------------------------------------------------------

SELECT = Operation[BranchMode | None](
    "select", "choice", (str, NoneType), result_types.select, arity=3, cost=1, noun="chosen"
)
"""A choice between two values, of the operands (condition, then, otherwise).

Both may be computed, unless the data is ``BRANCH``: then operations that only one side needs are
computed only if that side is chosen.
"""

CROSS = Operation("cross", "crossing", Crossing, result_types.cross, arity=None, rate="varying")
"""A varying: the value in one stage of a value that the stage before computes.

It is a weighted mean of the values at several vertices; or the value of one of them, which is
always the first one (``flat``) or has a number (``corner``): this number is the second operand, and
belongs to the later stage. The data names the domains of both stages. All nodes under the first
operand belong to the earlier one.
"""

FOLD = Operation(
    "fold", "loop", Folding, result_types.fold, arity=3, cost=LOOP, noun="total"
)  # fmt: skip
"""A fold, of the operands (count, start, body).

``start`` is combined, by the data's operator, with the body's value for each iteration 0, 1, …
below ``count``, which never exceeds the data's bound. The body binds the number of the iteration.
"""

ITERATE = Operation(
    "iterate", "loop", Iterating, result_types.iterate, arity=None, cost=LOOP, noun="state"
)
"""A loop over states, of the operands (count, *starts, going, *nexts).

The states begin as the starts and become the nexts in each iteration below ``count``, as long as
``going`` holds. The value is that of the states in the end. Both ``going`` and the nexts bind the
number of the iteration and the states.
"""

APPLY = Operation(
    "apply", "function", Applying, result_types.apply, arity=None, cost=1, noun="result"
)
"""A call of a body, of the operands (body, *arguments).

The body binds a variable for each argument. Applies of one body are calls of one function.
"""

ASCRIBE = Operation[Meaning | None](
    "as", "mark", (Meaning, NoneType), result_types.marked, arity=1, until=None
)
"""Type ascription: a declaration gives its operand a meaning.

Without data, the operand is a bare number. Semantics makes these nodes and erases them.
"""

CALLED = Operation[Hashable](
    "called", "mark", object, result_types.marked, arity=None, until=None
)  # fmt: skip
"""A call-site annotation, of the operands (value, *arguments).

The value is that of a function of the user's for these arguments; the data says which function.
Semantics makes these and erases them.
"""


def _rows() -> Iterator[Operation[Any]]:
    yield from (CONSTANT, PARAMETER, TEXTURE, BUFFER, ATTRIBUTE, ARGUMENT, INPUT, BOUND, FORMAL)
    yield from (CALL, NATIVE)
    yield from (VECTOR, SPLAT, MATRIX, STRUCT, ARRAY)
    yield from (SWIZZLE, INDEX, MEMBER)
    yield from (SELECT, CROSS, FOLD, ITERATE, APPLY, ASCRIBE, CALLED)


OPERATIONS: Mapping[Op, Operation[Any]] = {row.name: row for row in _rows()}


def with_role(*roles: Role) -> frozenset[Op]:
    """The operations that play one of these roles."""
    return frozenset(row.name for row in OPERATIONS.values() if row.role in roles)


LEAVES = frozenset(row.name for row in OPERATIONS.values() if row.is_leaf)
OUTSIDE = with_role("outside")
BUILTIN_OPS = with_role("builtin")
PARTS = with_role("part")
LOOPS = with_role("loop")
BINDING = with_role("loop", "function")
"""Operations with bodies, in which they bind variables."""
MARKS = with_role("mark")
VARYING = frozenset(row.name for row in OPERATIONS.values() if row.rate == "varying")
"""Operations whose values may differ between the vertices or pixels of a draw."""
GLOBALS = frozenset(row.name for row in OPERATIONS.values() if row.is_global)


OF_GROUPS = frozenset(name for name, row in BUILTINS.items() if row.of_group is not None)
"""The builtins that join the values of a work group: their results are never constant."""


def joins_group(node: Node) -> bool:
    """True if an operation joins the values of all invocations of a work group."""
    return node.head in OF_GROUPS


def builtin_of(node: Node) -> str | None:
    """The builtin that a ``call`` or a ``native`` is of; ``None`` for all other nodes."""
    return CALL.data(node) if node.op in BUILTIN_OPS else None
