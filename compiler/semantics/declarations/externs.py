"""Blocks that the host already owns: what is declared of them, checked against every backend."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from ....frozen import changed
from ...diagnostics import rules
from ...diagnostics.diagnostic import Label
from ...diagnostics.fixes import either
from ...diagnostics.source import Span
from ...ir.leaves import HostPlace
from ...ir.node import Node
from ...ir.shader import ExternInfo, ExternMemberInfo, ParameterInfo
from ...ir.types import Array, Scalar, Type, Vector
from ...layout import alignment, byte_size, stored_type
from ...syntax import ast
from ..inheritance.records import Definition
from ..names.modules import Module, Symbol
from ..state.scope import FAILURE, Failure
from .parameters import parameter_of

if TYPE_CHECKING:
    from ..state.context import Lowering

LARGEST_GROUP, LARGEST_BINDING = 3, 999
"""What WebGPU has at least: four bind groups, and numbers below 1000 in each."""

LARGEST_OFFSET = 16380
"""The last scalar of 16 KiB, which is what OpenGL ES has for a block."""


class Externs:
    """The ``extern`` blocks that one shader's file declares or that its expressions read."""

    def __init__(self, low: Lowering) -> None:
        self._low = low
        self._known: dict[Symbol, ExternInfo] = {}
        self._parameters: dict[tuple[Module, str], ParameterInfo | None] = {}
        self._learning: set[Module] = set()
        """Files whose blocks are being taken in: defaults there cannot be made of members."""

    @property
    def blocks(self) -> tuple[ExternInfo, ...]:
        """All of them, in the order in which they were met."""
        return tuple(self._known.values())

    def value(self, symbol: Symbol, span: Span) -> Node | Failure:
        """What reads the member that ``symbol`` stands for, where it is written at ``span``."""
        if symbol.module in self._learning:
            self._low.report.add(rules.NOT_CONSTANT, span)
            return FAILURE
        self.learn(symbol.module)
        info = self._parameters.get((symbol.module, symbol.name))
        if info is None:
            return FAILURE
        return self._low.graph.node("parameter", info.parameter.type, (), info.parameter)

    def learn(self, module: Module) -> None:
        """Take in all blocks that a file declares; each once."""
        self._learning.add(module)
        for symbols in module.declared.values():
            declaration = symbols[0].declaration
            if isinstance(declaration, ast.ExternBlock) and symbols[0] not in self._known:
                self._known[symbols[0]] = self._block(symbols[0], declaration)
        self._learning.discard(module)

    def _block(self, symbol: Symbol, block: ast.ExternBlock) -> ExternInfo:
        place = HostPlace(
            block.name.text,
            self._whole(block.bind_group, LARGEST_GROUP),
            self._whole(block.binding, LARGEST_BINDING),
        )
        self._check_place(block, place)
        members = []
        for member in block.members:
            info = self._member(symbol, block, member, place)
            self._parameters[symbol.module, member.name.text] = info
            offset = self._whole(member.offset, LARGEST_OFFSET)
            if info is not None and self._fits(member, info.parameter.type, offset):
                members.append(ExternMemberInfo(member.name.text, offset, info))
        members.sort(key=lambda info: info.offset)
        self._check_overlaps(members)
        return ExternInfo(place, _group(block), block.doc, block.name.span, tuple(members))

    def _member(
        self, symbol: Symbol, block: ast.ExternBlock, member: ast.ExternMember, place: HostPlace
    ) -> ParameterInfo | None:
        group = block.group or ast.Name("frame", block.name.span)
        declared = ast.Param(
            member.span, member.doc, member.name, member.type, None, group, member.default
        )
        name = f"{block.name.text}.{member.name.text}"
        info = parameter_of(self._low, Definition(declared, symbol, 0), name)
        return info and changed(info, parameter=changed(info.parameter, host=place))

    def _whole(self, number: ast.Number, largest: int) -> int:
        """A number from 0 to ``largest``; 0 after reporting another one."""
        if number.kind == "int" and len(number.text) < 10 and int(number.text) <= largest:
            return int(number.text)
        self._low.report.add(rules.EXTERN_NUMBER, number.span, largest=largest)
        return 0

    def _check_place(self, block: ast.ExternBlock, place: HostPlace) -> None:
        for other in self._known.values():
            if other.place.name == place.name:
                self._low.report.add(
                    rules.DUPLICATE_NAME, block.name.span, name=place.name,
                    labels=[Label(other.span, "first declared here")],
                )  # fmt: skip
            elif (other.place.group, other.place.binding) == (place.group, place.binding):
                span = block.bind_group.span.to(block.binding.span)
                self._low.report.add(
                    rules.EXTERN_PLACE_TAKEN, span, name=place.name, other=other.place.name,
                    labels=[Label(other.span, "declared here")],
                )  # fmt: skip

    def _fits(self, member: ast.ExternMember, type_: Type, offset: int) -> bool:
        """Whether every backend can read a type at an offset, or a report of why not."""
        if isinstance(type_, Array) and _is_packed(type_.element):
            self._low.report.add(
                rules.EXTERN_ARRAY, member.type.span, element=type_.element, count=type_.count
            )
            return False
        needed = alignment(stored_type(type_))
        if offset % needed:
            before = offset - offset % needed
            behind = before + needed
            self._low.report.add(
                rules.EXTERN_ALIGNMENT, member.offset.span,
                name=member.name.text, offset=offset, type=type_, alignment=needed,
                hint=either(
                    f"{before} and {behind} are such offsets",
                    member.offset.span, str(before), str(behind),
                ),
            )  # fmt: skip
            return False
        return True

    def _check_overlaps(self, members: Iterable[ExternMemberInfo]) -> None:
        end, last = 0, None
        for member in members:
            if last is not None and member.offset < end:
                self._low.report.add(
                    rules.EXTERN_OVERLAP, member.info.span,
                    name=member.name, offset=member.offset, other=last.name, end=end,
                    labels=[Label(last.info.span, f"ends at byte {end}")],
                )  # fmt: skip
            end = member.offset + byte_size(stored_type(member.info.parameter.type))
            last = member


def _group(block: ast.ExternBlock) -> str:
    return "frame" if block.group is None else block.group.text


def _is_packed(element: Type) -> bool:
    """Whether Burnish's blocks keep several such elements in 16 bytes, as no host does."""
    return isinstance(element, Scalar) or (isinstance(element, Vector) and element.size == 2)
