"""Prints calls of builtins in the words of a language.

By now all of them are ``native`` nodes: operations that the language has itself, or for which
``legalise`` has added a function to the text. ``expressions.py`` prints the operands first.
"""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping, Sequence

from ...compiler.ir.node import Node
from ...compiler.ir.operations import NATIVE, OF_GROUPS
from ...compiler.ir.types import (
    Matrix,
    Scalar,
    TextureType,
    Type,
    Vector,
    scalar_kind,
    width,
)
from ...stdlib.builtins import BUILTINS
from ...support.frozen import frozen
from ..description.spellings import Read, Spelling, Spellings
from .context import Context
from .leaves import LeafPrinter
from .precedence import POSTFIX, Field, Printed, call, separable, writer


def spelling_of(name: str, operands: Sequence[Type], table: Spellings) -> str:
    """The spelling of builtin ``name`` for operands of these types."""
    spelled = table.get(name, "")
    if isinstance(spelled, Read):
        texture = operands[0]
        assert isinstance(texture, TextureType)
        plain = spelled.layered if texture.layered and spelled.layered else spelled.plain
        return spelled.types.get(str(texture), plain)
    if isinstance(spelled, Spelling):
        spelled = _special(spelled, operands) or spelled.usual
    return spelled or BUILTINS[name].operator or name


def _special(row: Spelling, operands: Sequence[Type]) -> str:
    """The spelling in a row for operands of these types in particular; empty if it has none."""
    if any(isinstance(operand, Matrix) for operand in operands):
        return row.matrix
    if row.vectors and isinstance(operands[0], Vector):
        return row.vectors
    kind = scalar_kind(operands[0])
    if kind == "float":
        return row.floats
    return row.integers if kind in ("int", "uint") else ""


@frozen
class EmittedFunction:
    """The name of a function in the text, with the resources that its calls pass."""

    name: str
    passed: Sequence[str]
    """The arguments that precede the function's own: blocks, textures and samplers."""

    def call(self, arguments: Sequence[Printed]) -> Printed:
        """The function called with arguments of its own."""
        return call(self.name, [*self.passed, *separable(arguments)])


class GroupCalls(ABC):
    """Prints the calls of builtins that join the values of a work group."""

    @abstractmethod
    def call(self, node: Node, operand: Printed) -> Printed:
        """The expression for such a call, with its printed operand."""


class Natives:
    """Prints calls of builtins, for one stage."""

    def __init__(
        self,
        context: Context,
        leaves: LeafPrinter,
        functions: Mapping[Node, EmittedFunction],
        groups: GroupCalls,
    ) -> None:
        self._groups = groups
        self._definitions = context.definitions
        self._functions = functions
        self._table = context.dialect.natives
        self._writers = context.dialect.writers
        self._spellings = context.dialect.spellings
        self._forms = context.language.forms
        self._splats = context.language.splats
        self._spell_type = context.types.type
        self._leaves = leaves

    def print(self, node: Node, operands: Sequence[Printed]) -> Printed:
        """The native ``node`` applied to printed operands."""
        builtin = NATIVE.data(node)
        if self._definitions:
            types = tuple([operand.type for operand in node.operands])
            if (builtin, types) in self._definitions:
                return self._functions[self._definitions[builtin, types].body].call(operands)
        if builtin in OF_GROUPS:
            return self._groups.call(node, operands[0])
        if builtin in self._splats:
            operands = self._widened(node, operands)
        write = self._writers.get(builtin)
        return write(operands) if write else self._print(node, builtin, operands)

    def _print(self, node: Node, builtin: str, operands: Sequence[Printed]) -> Printed:
        """Print a native that is not among the dialect's writers, or not yet."""
        types = tuple([operand.type for operand in node.operands])
        reads = bool(types) and isinstance(types[0], TextureType)
        if reads:
            operands = [self._leaves.texture_read(node.operands[0], builtin), *operands[1:]]
        spelled = self._after(builtin, node) or self._spelling(builtin, types)
        if "{" in spelled:
            return self._template(spelled, node, operands)
        write = writer(spelled, len(operands))
        if not reads and isinstance(self._table.get(builtin, ""), str):
            self._writers[builtin] = write
        return write(operands)

    def _spelling(self, builtin: str, types: tuple[Type, ...]) -> str:
        """The spelling for operands of these types, which is found once for all programs."""
        spelled = self._spellings.get((builtin, types))
        if spelled is None:
            spelled = self._spellings[builtin, types] = spelling_of(builtin, types, self._table)
        return spelled

    def _after(self, builtin: str, node: Node) -> str:
        """The spelling for a vector that a certain other native has made; empty for others."""
        row, made = self._table.get(builtin), node.operands[0]
        if isinstance(row, Spelling) and made.op == "native" and isinstance(made.type, Vector):
            return row.after.get(NATIVE.data(made), "")
        return ""

    def combined(self, name: str, type_: Type, operands: Sequence[Printed]) -> Printed:
        """Builtin ``name`` of operands that are all of one plain type, which is the result's."""
        spelled = spelling_of(name, [type_] * len(operands), self._table)
        if "{" in spelled:
            fields = [Field(*operand) for operand in operands]
            return spelled.format(*fields, type=self._spell_type(type_)), POSTFIX
        return writer(spelled, len(operands))(operands)

    def splatted(self, operand: Printed, type_: Type) -> Printed:
        """A scalar in every lane of a type."""
        lanes = self._forms.lanes[0] * width(type_)
        text, value = self._spell_type(type_), Field(*operand)
        return self._forms.splat.format(type=text, value=value, lanes=lanes), POSTFIX

    def _widened(self, node: Node, operands: Sequence[Printed]) -> Sequence[Printed]:
        """The operands; if the result is a vector, scalars among them become vectors too."""
        if not isinstance(node.type, Vector):
            return operands
        return [
            self.splatted(printed, Vector(operand.type.kind, node.type.size))
            if isinstance(operand.type, Scalar)
            else printed
            for printed, operand in zip(operands, node.operands, strict=True)
        ]

    def _template(self, form: str, node: Node, operands: Sequence[Printed]) -> Printed:
        textures = (operand for operand in node.operands if isinstance(operand.type, TextureType))
        text = form.format(
            *[Field(*operand) for operand in operands],
            type=self._spell_type(node.type),
            lanes=width(node.type) if isinstance(node.type, Scalar | Vector) else 0,
            sampler="".join(map(self._leaves.sampler, textures)),
            lane=self._lane(node),
        )
        return text, POSTFIX

    def _lane(self, node: Node) -> str:
        """The language's word for the lane that a constant operand chooses."""
        constants = BUILTINS[NATIVE.data(node)].constants
        if not constants or not self._forms.lane_words:
            return ""
        chosen = node.operands[constants[0]].data
        assert isinstance(chosen, int)
        return self._forms.lane_words[chosen]
