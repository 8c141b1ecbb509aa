"""Prints the values that a stage reads from outside: parameters, textures, inputs and varyings.

``stage.py`` makes a ``LeafPrinter`` for each stage. ``expressions.py`` and ``natives.py`` call it.
"""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Sequence

from ...compiler.ir.node import Node
from ...compiler.ir.operations import ARGUMENT, ATTRIBUTE, BUFFER, CROSS, PARAMETER, TEXTURE
from ...compiler.ir.program import Stage, Varying
from ...compiler.ir.stages import PATCHES, SystemInput
from ...compiler.ir.types import Scalar, Type, Vector, of_floats, scalar_kind, width, with_width
from ...stdlib.builtins import BUILTINS
from .context import Context
from .precedence import NAME, POSTFIX, Field, Printed


class LeafPrinter:
    """Prints the leaves of the graph for one stage."""

    def __init__(
        self,
        context: Context,
        stage: Stage,
    ) -> None:
        self._forms = context.language.forms
        self._texture = context.profile.samplers.joined or context.language.forms.texture
        self._textures = context.textures
        self._types = context.types
        self._stored = context.language.types.stored
        self._names = context.names
        self._inputs = context.dialect.inputs
        self._members = context.members
        self._attributes_of_floats = context.profile.attributes_of_floats
        self._read_parameters = context.read_parameters
        self._crossings = dict(_crossings(context.program.entering(stage)))
        faces = context.program.interfaces_into(stage)
        self._points = {f.name for face in faces if face.through for f in face.fields}
        """The varyings that the stage before hands on from control points."""

    def parameter(self, node: Node) -> Printed:
        """A member of a uniform block, in its stored type."""
        printed = self._read_parameters.get(node)
        if printed is None:
            printed = self._read_parameters[node] = self._parameter(node)
        return printed

    def _parameter(self, node: Node) -> Printed:
        parameter = PARAMETER.data(node)
        block, member, stored = self._members[parameter]
        assert node.type == stored, f"{parameter.name} is stored as {stored}, not {node.type}"
        text = self._forms.member.format(
            block=self._names.variables.get(block, ""), name=self._names.member(block, member)
        )
        return self.loaded((text, NAME), stored)

    def is_block(self, elements: Sequence[Node]) -> bool:
        """True if these are all members of a uniform block, in their order."""
        if any(element.op != "parameter" for element in elements):
            return False
        parameters = [PARAMETER.data(element) for element in elements]
        block = self._members[parameters[0]][0]
        return parameters == [each for each, place in self._members.items() if place[0] == block]

    def loaded(self, member: Printed, type_: Type) -> Printed:
        """A member of a block as a value of its type, if the block stores it as another type."""
        if not self._stored or str(type_) not in self._stored:
            return member
        value, type_text = Field(*member), self._types.type(type_)
        return self._forms.stored.format(value=value, type=type_text), POSTFIX

    def texture(self, node: Node) -> Printed:
        """A texture by its name."""
        return self._names.textures[TEXTURE.data(node).name], NAME

    def buffer(self, node: Node) -> Printed:
        """A storage buffer by its name."""
        return self._names.buffers[BUFFER.data(node).name], NAME

    def texture_read(self, node: Node, builtin: str) -> Printed:
        """A texture as ``builtin`` reads it: together with its sampler, if the read uses that."""
        if BUILTINS[builtin].sampler is None:
            return self.texture(node)
        text = self._texture.format(
            texture=self._names.textures[TEXTURE.data(node).name],
            sampler=self.sampler(node),
            type=self._textures.combined(TEXTURE.data(node)),
        )
        return text, POSTFIX

    def sampler(self, node: Node) -> str:
        """The name of a texture's sampler; empty if the texture has none."""
        return self._names.samplers.get(TEXTURE.data(node).name, "")

    def attribute(self, node: Node) -> Printed:
        """A vertex input; integers are made of floats where a host hands these on."""
        text, level = self._read(self._names.attributes[ATTRIBUTE.data(node).name])
        if self._attributes_of_floats and of_floats(node.type) != node.type:
            return f"{self._types.type(node.type)}({text})", POSTFIX
        return text, level

    def argument(self, node: Node) -> Printed:
        """An argument of a function that an engine calls."""
        return self._names.arguments[ARGUMENT.data(node)], NAME

    def input(self, row: SystemInput, wanted: Sequence[int] | None = None) -> tuple[str, Type]:
        """A value that the pipeline supplies, and its type in the language.

        ``wanted`` are the lanes of the value that are used, if not all are.
        """
        supplied = self._inputs[row.name]
        text, kind = supplied.read.format(name=row.name), scalar_kind(supplied.type)
        lanes = tuple(range(width(row.type))) if wanted is None else wanted
        if wanted is None and len(lanes) == width(supplied.type):
            return text, supplied.type
        assert kind is not None
        type_ = with_width(kind, len(lanes))
        return self.swizzle((text, NAME), lanes, type_)[0], type_

    def interpolated(
        self, node: Node, corner: str, wanted: tuple[int, ...] | None = None
    ) -> Printed:
        """A value that crosses: the varying, or those of its lanes that hold the value.

        ``corner`` is the number of the corner whose value it is, where it is one's. ``wanted`` are
        the lanes of the value that are used, if not all are.
        """
        slot, first, total = self._crossings[node.operands[0].id, CROSS.data(node).mode]
        name = (self._names.points if slot in self._points else self._names.varyings)[slot]
        printed = self._read(name)
        if CROSS.data(node).origin == PATCHES:
            printed = self._forms.of_patch.format(name=name), NAME
        elif corner:
            printed = self._forms.corner.format(name=name, corner=corner), POSTFIX
        lanes = tuple(range(width(node.type))) if wanted is None else wanted
        if wanted is None and len(lanes) == total:
            return printed
        kind = scalar_kind(node.type)
        assert kind is not None
        type_ = Vector(kind, len(lanes)) if len(lanes) > 1 else Scalar(kind)
        return self.swizzle(printed, [first + lane for lane in lanes], type_)

    def swizzle(self, vector: Printed, lanes: Sequence[int], type_: Type) -> Printed:
        """Lanes of a vector, which have this type."""
        forms = self._forms
        form = forms.lane if len(lanes) == 1 else forms.swizzle
        letters = "".join([forms.lanes[lane] for lane in lanes])
        type_text = self._types.type(type_)
        return form.format(vector=Field(*vector), lanes=letters, type=type_text), POSTFIX

    def _read(self, name: str) -> Printed:
        return self._forms.input.format(name=name), NAME


def _crossings(
    varyings: Iterable[Varying],
) -> Iterator[tuple[tuple[int, Hashable], tuple[str, int, int]]]:
    """The place of each value between stages: its slot, first lane there, and the slot's lanes."""
    for varying in varyings:
        first = 0
        total = width(varying.field.type)
        for value in varying.values:
            yield (value.id, varying.field.mode), (varying.field.name, first, total)
            first += width(value.type)
