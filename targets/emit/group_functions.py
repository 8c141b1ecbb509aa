"""Prints the functions by which the invocations of a work group join their values.

``stage.py`` makes a ``GroupFunctions`` for each stage. Each joining builtin becomes a function of
the text for each type that it joins: the invocations put their values into a shared array, wait for
each other at barriers, and join the values of others. The order of joining is that of
``compiler/reference/in_groups.py``. Every invocation calls these functions, as all have to reach
the barriers; the value of an invocation without an element is not joined.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from ...compiler.ir.kernel import invocations
from ...compiler.ir.node import Node
from ...compiler.ir.operations import NATIVE, OF_GROUPS
from ...compiler.ir.program import Stage
from ...compiler.ir.types import INT, UINT, Array, Scalar, Type, scalar_kind
from ...stdlib.builtins import BUILTINS
from ...stdlib.builtins.row import GroupPart, OfGroup
from .comments import comment_lines
from .context import Context
from .literals import literal
from .namer import Namer
from .natives import GroupCalls, Natives
from .origins import Marks
from .precedence import CHOICE, NAME, POSTFIX, Printed, call, separable
from .statements import INDENT
from .views import FunctionView

DOCS: Mapping[GroupPart, str] = {
    "all": "The values of all invocations of a work group, joined.",
    "through": "The values of the invocations up to this one, joined.",
    "before": "The values of the invocations before this one, joined.",
}
_WORDS = ("value", "place", "present", "reach", "joined")
"""The parameters and variables of the functions: an invocation's value, its number in the work
group, how many invocations of the group have an element, the distance between two that join, and
the joined value."""

Use = tuple[str, Type]
"""A builtin that joins, and the type of its operand."""


class GroupFunctions(GroupCalls):
    """The functions that one stage needs, and the arrays that its invocations share."""

    def __init__(self, context: Context, stage: Stage, marks: Marks) -> None:
        self._marks = marks
        self._forms, self._types = context.language.forms, context.types
        self._literals = context.language.literals
        group = context.program.work_group
        self._size = 1 if group is None else invocations(group)
        used = [(use.builtin, use.types[0]) for use in stage.natives if use.builtin in OF_GROUPS]
        self._origins: dict[Use, Node] = {}
        """The node of each function's first call, for the source map."""
        builtins = [builtin for builtin, _ in used]
        declare = context.names.common.declare
        self._names = {
            use: declare(use[0] if builtins.count(use[0]) == 1 else f"{use[0]}_{use[1]}")
            for use in used
        }
        types = dict.fromkeys(type_ for _, type_ in used)
        self._arrays = {type_: declare(f"group_{type_}s") for type_ in types}
        namer = context.names.locals(()) if used else None
        self._local = {word: namer.declare(word) for word in _WORDS} if namer else {}
        self._place, self._present = "", ""
        """The calling invocation's number in the work group, and the number of invocations with an
        element, as the entry point names them."""
        self.has_element = ""
        """The condition under which the calling invocation has an element to compute."""

    def __bool__(self) -> bool:
        """True if the stage joins values of a work group."""
        return bool(self._names)

    @property
    def shared(self) -> list[str]:
        """The declarations of the arrays."""
        return [
            self._forms.shared.format(typed=self._types.declare(name, Array(type_, self._size)))
            for type_, name in self._arrays.items()
        ]

    def call(self, node: Node, operand: Printed) -> Printed:
        """The expression for a builtin's result at this invocation."""
        builtin, type_ = NATIVE.data(node), node.type
        self._origins.setdefault((builtin, type_), node)
        arguments = [*separable([operand]), self._place]
        if _part(builtin) == "all":
            arguments.append(self._present)
        if self._forms.shared_argument:
            arguments.insert(0, self._arrays[type_])
        return call(self._names[builtin, type_], arguments)

    def opening(
        self, namer: Namer, natives: Natives, read: str, count: str, index: str
    ) -> list[str]:
        """The first statements of an entry point in which all invocations run to the end.

        ``read`` is the language's number of an invocation, and ``count`` the number of elements. An
        invocation behind the last element has that element's ``index``, so that everything that it
        reads exists.
        """
        whole, number = namer.declare("count"), namer.declare("global_index")
        signed, unsigned = self._types.type(INT), self._types.type(UINT)
        self.has_element = f"{number} < {unsigned}({whole})"
        self._place = namer.declare("place")
        size = self._number(self._size)
        last: Printed = f"{whole} - {literal(1, 'int', self._literals)}", CHOICE
        least = natives.combined("min", INT, [(f"{signed}({number})", POSTFIX), last])
        zero: Printed = literal(0, "int", self._literals), NAME
        lines = [
            self._let(whole, INT, count),
            self._let(number, UINT, read),
            self._let(index, INT, natives.combined("max", INT, [least, zero])[0]),
            self._let(self._place, UINT, f"{number} % {size}"),
        ]
        if any(_part(builtin) == "all" for builtin, _ in self._names):
            self._present = namer.declare("present")
            from_first: Printed = f"{unsigned}({whole}) - ({number} - {self._place})", CHOICE
            present = natives.combined("min", UINT, [from_first, (size, NAME)])
            lines.append(self._let(self._present, UINT, present[0]))
        return lines

    def views(self, natives: Natives) -> list[FunctionView]:
        """The functions, once all calls have been printed; ``natives`` prints how two values are
        joined."""
        return [self._view(use, natives) for use in self._names]

    def _view(self, use: Use, natives: Natives) -> FunctionView:
        builtin, type_ = use
        part, forms, types = _part(builtin), self._forms, self._types
        parameters = [("value", type_), ("place", UINT)]
        if part == "all":
            parameters.append(("present", UINT))
        typed = [
            forms.parameter.format(typed=types.declare(self._local[name], own))
            for name, own in parameters
        ]
        if forms.shared_argument:
            type_text = types.type(Array(type_, self._size))
            passed = forms.shared_argument.format(type=type_text, name=self._arrays[type_])
            typed.insert(0, passed)
        head = forms.function.format(
            type=types.type(type_), name=self._names[use], parameters=", ".join(typed)
        )
        lines = self._all(use, natives) if part == "all" else self._scan(use, natives)
        first, *others = lines
        lines_of = [self._marks.mark(first, self._origins[use]), *others]
        return FunctionView(comment_lines(DOCS[part]), head, lines_of)

    def _all(self, use: Use, natives: Natives) -> Iterator[str]:
        """Joins pairs, one from each half of what is left, until one value is left."""
        forms, array = self._forms, self._arrays[use[1]]
        place, present, reach, joined = (
            self._local[word] for word in ("place", "present", "reach", "joined")
        )
        yield from self._put(use[1], self._local["value"])
        half = (1 << (self._size - 1).bit_length()) // 2
        zero, two = self._number(0), self._number(2)
        yield self._loop(self._number(half), f"{reach} > {zero}", f"{reach} /= {two}")
        condition = f"{place} < {reach} && {place} + {reach} < {present}"
        yield INDENT + forms.if_.format(condition=condition)
        own, other = f"{array}[{place}]", f"{array}[{place} + {reach}]"
        value = self._joined(use, natives, own, other)
        yield INDENT * 2 + forms.assign.format(name=own, value=value)
        yield INDENT + forms.end
        yield INDENT + forms.barrier
        yield forms.end
        yield self._let(joined, use[1], f"{array}[0]")
        yield forms.barrier
        yield forms.return_.format(value=joined)

    def _scan(self, use: Use, natives: Natives) -> Iterator[str]:
        """Joins each value with those before it, at distances 1, 2, 4 … (Hillis and Steele)."""
        forms, array, type_ = self._forms, self._arrays[use[1]], use[1]
        place, reach, joined = (self._local[word] for word in ("place", "reach", "joined"))
        yield self._variable(joined, type_, self._local["value"])
        most, two = self._number(self._size), self._number(2)
        yield self._loop(self._number(1), f"{reach} < {most}", f"{reach} *= {two}")
        yield from (INDENT + line for line in self._put(type_, joined))
        yield INDENT + forms.if_.format(condition=f"{place} >= {reach}")
        value = self._joined(use, natives, f"{array}[{place} - {reach}]", joined)
        yield INDENT * 2 + forms.assign.format(name=joined, value=value)
        yield INDENT + forms.end
        yield INDENT + forms.barrier
        yield forms.end
        if _part(use[0]) == "before":
            yield from self._shifted(type_, natives)
        yield forms.return_.format(value=joined)

    def _shifted(self, type_: Type, natives: Natives) -> Iterator[str]:
        """The value of the invocation before; zero at the first one."""
        forms, place, joined = self._forms, self._local["place"], self._local["joined"]
        yield from self._put(type_, joined)
        kind = scalar_kind(type_)
        assert kind is not None
        zero: Printed = literal(0, kind, self._literals), NAME
        nothing = zero if isinstance(type_, Scalar) else natives.splatted(zero, type_)
        yield forms.assign.format(name=joined, value=nothing[0])
        yield forms.if_.format(condition=f"{place} > {self._number(0)}")
        before = f"{self._arrays[type_]}[{place} - {self._number(1)}]"
        yield INDENT + forms.assign.format(name=joined, value=before)
        yield forms.end
        yield forms.barrier

    def _joined(self, use: Use, natives: Natives, one: str, other: str) -> str:
        builtin, type_ = use
        row = _row(builtin)
        assert row is not None
        return natives.combined(row.joins, type_, [(one, POSTFIX), (other, POSTFIX)])[0]

    def _put(self, type_: Type, value: str) -> Iterator[str]:
        """Stores the value of each invocation in the shared array, and waits for the others."""
        place = f"{self._arrays[type_]}[{self._local['place']}]"
        yield self._forms.assign.format(name=place, value=value)
        yield self._forms.barrier

    def _loop(self, first: str, condition: str, step: str) -> str:
        """The head of the loop over the distance between the invocations that join."""
        return f"for ({self._variable(self._local['reach'], UINT, first)} {condition}; {step}) {{"

    def _variable(self, name: str, type_: Type, value: str) -> str:
        typed = self._types.declare(name, type_)
        return self._forms.variable_set.format(typed=typed, name=name, value=value)

    def _let(self, name: str, type_: Type, value: str) -> str:
        typed = self._types.declare(name, type_)
        return self._forms.let.format(typed=typed, name=name, value=value)

    def _number(self, number: int) -> str:
        return literal(number, "uint", self._literals)


def _row(builtin: str) -> OfGroup | None:
    return BUILTINS[builtin].of_group


def _part(builtin: str) -> GroupPart:
    row = _row(builtin)
    assert row is not None
    return row.part
