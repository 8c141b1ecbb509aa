"""Builtins as a language spells them."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import NamedTuple

from ...compiler.ir.node import Node
from ...compiler.ir.operations import NATIVE
from ...compiler.ir.types import (
    Matrix,
    Scalar,
    TallMatrix,
    Texture,
    Type,
    Vector,
    scalar_kind,
    width,
)
from ...stdlib.builtins import BUILTINS
from ..description.spellings import Read, Spelling, Spellings
from .context import Context
from .leaves import Leaves
from .precedence import INFIX, PREFIX, Text, infix, prefix


def spelling_of(name: str, operands: Sequence[Type], table: Spellings) -> str:
    """How builtin ``name`` is written for operands of these types."""
    spelled = table.get(name, "")
    if isinstance(spelled, Read):
        texture = operands[0]
        assert isinstance(texture, Texture)
        plain = spelled.layered if texture.layered and spelled.layered else spelled.plain
        return spelled.types.get(str(texture), plain)
    if isinstance(spelled, Spelling):
        spelled = _special(spelled, operands) or spelled.usual
    return spelled or BUILTINS[name].operator or name


def _special(row: Spelling, operands: Sequence[Type]) -> str:
    """What a row says of operands of these types in particular."""
    if any(isinstance(operand, Matrix | TallMatrix) for operand in operands):
        return row.matrix
    if row.vectors and isinstance(operands[0], Vector):
        return row.vectors
    kind = scalar_kind(operands[0])
    if kind == "float":
        return row.floats
    return row.integers if kind in ("int", "uint") else ""


class Callee(NamedTuple):
    """A function of the text, as its callers know it."""

    name: str
    passed: Sequence[str]
    """The arguments in front of its own: blocks, textures and samplers."""

    def call(self, arguments: Iterable[str]) -> Text:
        """The function called with arguments of its own."""
        return Text(f"{self.name}({', '.join([*self.passed, *arguments])})")


class Natives:
    """Prints calls of builtins, for one stage."""

    def __init__(
        self,
        context: Context,
        leaves: Leaves,
        functions: Mapping[Node, Callee],
    ) -> None:
        self._definitions = context.definitions
        self._functions = functions
        self._table = context.natives
        self._fixed: dict[str, str] = {}
        self._forms = context.language.forms
        self._splats = context.language.splats
        self._spell_type = context.types.type
        self._leaves = leaves

    def print(self, node: Node, printed: Sequence[Text]) -> Text:
        """The native ``node`` applied to printed operands."""
        builtin = NATIVE.data(node)
        if node.operands and isinstance(node.operands[0].type, Texture):
            printed = [self._leaves.texture(node.operands[0], builtin), *printed[1:]]
        if self._definitions:
            types = tuple([operand.type for operand in node.operands])
            if (builtin, types) in self._definitions:
                callee = self._functions[self._definitions[builtin, types].body]
                return callee.call(operand.text for operand in printed)
        operands = self._widened(node, printed) if builtin in self._splats else printed
        spelled = self._fixed.get(builtin) or self._spelling(builtin, node)
        if "{" in spelled:
            return self._template(spelled, node, operands)
        return _written(spelled, operands)

    def _spelling(self, builtin: str, node: Node) -> str:
        """How the builtin is written for a node's operands; kept where these do not matter."""
        spelled = spelling_of(builtin, [operand.type for operand in node.operands], self._table)
        if isinstance(self._table.get(builtin, ""), str):
            self._fixed[builtin] = spelled
        return spelled

    def combined(self, name: str, type_: Type, operands: Sequence[Text]) -> Text:
        """Builtin ``name`` of operands that are all of one plain type, which is the result's."""
        spelled = spelling_of(name, [type_] * len(operands), self._table)
        if "{" in spelled:
            return Text(spelled.format(*operands, type=self._spell_type(type_)))
        return _written(spelled, operands)

    def splatted(self, operand: Text, type_: Type) -> Text:
        """A scalar in every lane of a type."""
        lanes = self._forms.lanes[0] * width(type_)
        return Text(
            self._forms.splat.format(type=self._spell_type(type_), value=operand, lanes=lanes)
        )

    def _widened(self, node: Node, operands: Sequence[Text]) -> list[Text]:
        """The operands, scalars among them as vectors where the result is one."""
        if not isinstance(node.type, Vector):
            return list(operands)
        return [
            self.splatted(text, Vector(operand.type.kind, node.type.size))
            if isinstance(operand.type, Scalar)
            else text
            for text, operand in zip(operands, node.operands, strict=True)
        ]

    def _template(self, form: str, node: Node, operands: Sequence[Text]) -> Text:
        textures = (operand for operand in node.operands if isinstance(operand.type, Texture))
        return Text(
            form.format(
                *operands,
                type=self._spell_type(node.type),
                lanes=width(node.type) if isinstance(node.type, Scalar | Vector) else 0,
                sampler="".join(map(self._leaves.sampler, textures)),
                lane=self._lane(node),
            )
        )

    def _lane(self, node: Node) -> str:
        """The language's word for the lane that a constant operand chooses."""
        constants = BUILTINS[str(node.data)].constants
        if not constants or not self._forms.lane_words:
            return ""
        chosen = node.operands[constants[0]].data
        assert isinstance(chosen, int)
        return self._forms.lane_words[chosen]


def _written(spelled: str, operands: Sequence[Text]) -> Text:
    """A symbol between or before its operands, or a call."""
    if len(operands) == 2 and spelled in INFIX:
        return infix(spelled, *operands)
    if len(operands) == 1 and spelled in PREFIX:
        return prefix(spelled, operands[0])
    return Text(f"{spelled}({', '.join(operand.text for operand in operands)})")
