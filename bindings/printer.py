"""Prints the code of derived values: what all languages have in common.

A language has a subclass with its rows of forms. The subclass says besides how numbers, places and
statements are written.
"""

from __future__ import annotations

import math
import struct
from abc import ABC, abstractmethod
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, ClassVar

from ..compiler.tracing import Expression, Kind
from .forms import WHOLE, Form, operand_kinds
from .spelling import Spelling
from .statements import Each, Fold, Let, Place, Return, Set, Statement


class Printer(ABC):
    """Prints expressions and statements of one language."""

    FORMS: ClassVar[Mapping[str, Form]]
    CONVERSIONS: ClassVar[Mapping[tuple[Kind, Kind], Form]]
    """The forms that make a number of one kind of another; those without a form need none."""
    INDENT: ClassVar[str] = "    "
    END: ClassVar[str] = ";"
    """What ends a statement."""

    def __init__(self) -> None:
        self.used: set[str] = set()
        """The functions of the skeleton that the code calls."""
        self.spelling: Spelling

    # -- what a language says ----------------------------------------------------------------------

    @abstractmethod
    def number(self, value: float, kind: Kind) -> str:
        """A constant."""

    @abstractmethod
    def read(self, place: str, each: Expression) -> str:
        """The number that stands at a place of a block: an expression of its kind."""

    @abstractmethod
    def part(self, place: str, part: tuple[int, ...]) -> str:
        """A lane of a vector, or of a column."""

    @abstractmethod
    def let(self, name: str, value: Expression) -> str:
        """The statement that gives a number a name."""

    @abstractmethod
    def set(self, place: str, statement: Set) -> Iterator[str]:
        """The statements that store a value in a field."""

    @abstractmethod
    def each(self, index: str, count: str, body: Iterable[str]) -> Iterator[str]:
        """The loop over numbers from 0, whose body is indented already."""

    @abstractmethod
    def state(self, name: str, value: Expression) -> str:
        """The statement that makes a variable, which changes later."""

    def change(self, name: str, value: str) -> str:
        """The statement that changes a variable."""
        return f"{name} = {value}{self.END}"

    def returned(self, value: str) -> str:
        """The statement that returns a number."""
        return f"return {value}{self.END}"

    def lesser(self, count: Expression, bound: int) -> str:
        """The number of terms of a fold, which has at most ``bound``."""
        form = self.FORMS["minimum"]
        return form.text.format(self.text(count, kind="int"), self.number(bound, "int"))

    # -- what all have in common -------------------------------------------------------------------

    def text(self, each: Expression, level: int = 0, kind: Kind | None = None) -> str:
        """An expression as one of a kind; in parentheses if it is weaker than ``level``."""
        if kind is not None and kind != each.kind:
            return self._converted(each, level, kind)
        if each.op == "constant":
            text = self.number(each.value, each.kind)
            return f"({text})" if text.startswith("-") and level > 0 else text
        if each.op == "input":
            return self.spelling.local(each.value)
        if each.op == "load":
            return self.read(self._place(each), each)
        if each.op == "call":
            return self._call(each)
        if each.op == "float64" and each.operands[0].kind != "float":
            return self._converted(each.operands[0], level, "float")
        return self._formed(self.form(each), each, level)

    def form(self, each: Expression) -> Form:
        """The form of an operation."""
        return self.FORMS[each.op]

    def _formed(self, form: Form, each: Expression, level: int) -> str:
        self.used.update((form.helper,) if form.helper else ())
        inner = (*form.inner, *(0 for _ in each.operands))
        operands = zip(each.operands, inner, operand_kinds(each), strict=False)
        text = form.text.format(*(self.text(*operand) for operand in operands))
        return f"({text})" if form.level < level else text

    def _converted(self, each: Expression, level: int, kind: Kind) -> str:
        if each.op == "constant":
            return self.text(
                type(each)("constant", (), kind, each.is_natural, _as(each, kind)), level
            )
        form = self.CONVERSIONS.get((each.kind, kind))
        if form is None:
            return self.text(each, level)
        self.used.update((form.helper,) if form.helper else ())
        text = form.text.format(self.text(each, (*form.inner, 0)[0]))
        return f"({text})" if form.level < level else text

    def _call(self, each: Expression) -> str:
        name, _ = each.value
        operands = zip(each.operands, operand_kinds(each), strict=True)
        arguments = ", ".join(self.text(one, 0, kind) for one, kind in operands)
        return f"{self.spelling.function(name)}({arguments})"

    def _place(self, each: Expression) -> str:
        indices = iter(each.operands)
        place: Place = each.value
        texts = [self.text(next(indices), kind="int") if way is None else way for way in place.way]
        found = self.place(place, texts)
        return self.part(found, place.part) if place.part else found

    def place(self, place: Place, way: Iterable[Any]) -> str:
        """A field of a block, or a part of one; words are fields, and anything else an index."""
        text = self.spelling.local(place.block)
        for step, one in zip(place.way, way, strict=True):
            if isinstance(step, str):
                text = f"{text}.{self.spelling.member(step)}"
            else:
                text = self.element(text, one)
        return text

    def element(self, array: str, index: object) -> str:
        """An element of an array."""
        return f"{array}[{index}]"

    def statements(self, statements: Iterable[Statement], indent: str = "") -> Iterator[str]:
        """The lines of statements."""
        for statement in statements:
            for line in self._lines(statement):
                yield f"{indent}{line}"

    def _lines(self, statement: Statement) -> Iterator[str]:
        match statement:
            case Let():
                yield self.let(self.spelling.local(statement.name), statement.value)
            case Set():
                way = [
                    self.spelling.local(statement.index) if step is None else step
                    for step in statement.place.way
                ]
                target = Place(block="derived", way=statement.place.way)
                yield from self.set(self.place(target, way), statement)
            case Each():
                index = self.spelling.local(statement.index)
                body = self.statements(statement.body, self.INDENT)
                yield from self.each(index, self.number(statement.count, "int"), body)
            case Fold():
                yield from self._fold(statement)
            case Return():
                yield self.returned(self.text(statement.value))

    def _fold(self, fold: Fold) -> Iterator[str]:
        for name, value in fold.states:
            yield self.state(self.spelling.local(name), value)
        yield from self.each(
            self.spelling.local(fold.index), self.lesser(fold.count, fold.bound),
            self._turn(fold),
        )  # fmt: skip

    def _turn(self, fold: Fold) -> Iterator[str]:
        yield from self.statements(fold.body, self.INDENT)
        names = [self.spelling.local(name) for name, _ in fold.states]
        # A lane may read the others as they were before.
        new = [self.spelling.local(f"next_{name}") for name, _ in fold.states]
        kinds = [value.kind for _, value in fold.states]
        if len(names) == 1:
            yield self.INDENT + self.change(names[0], self.text(fold.following[0], kind=kinds[0]))
            return
        for name, value in zip(new, fold.following, strict=True):
            yield self.INDENT + self.let(name, value)
        for name, changed in zip(names, new, strict=True):
            yield self.INDENT + self.change(name, changed)


def _as(each: Expression, kind: Kind) -> Any:
    return {"float": float, "int": int, "bool": bool}[kind](each.value)


def single(value: float) -> str:
    """The shortest decimal number that float32 rounds to the same one."""
    stored = _stored(float(value))
    for digits in range(1, 10):
        text = f"{stored:.{digits}g}"
        if _stored(float(text)) == stored:
            break
    return text if any(mark in text for mark in ".en") else f"{text}.0"


def _stored(value: float) -> float:
    (found,) = struct.unpack("<f", struct.pack("<f", value))
    return float(found)


def power_of_two(value: float) -> int | None:
    """The exponent of a power of two that is far from 1; ``None`` for other numbers."""
    fraction, exponent = math.frexp(value)
    return exponent - 1 if fraction == 0.5 and abs(exponent) > 24 else None


__all__ = ["WHOLE", "Printer", "power_of_two", "single"]
