"""Reads the layout of constant buffers from DXC's disassembly of DXIL, for the layout tests.

DXC prints the layout as comments, in which the name of a struct follows its members::

    ; cbuffer P
    ; {
    ;   struct hostlayout.P
    ;   {
    ;       struct struct.Lamp
    ;       {
    ;           float3 pos;                     ; Offset:   16
    ;       } lights[2];;                       ; Offset:   16
    ;   } P;                                    ; Offset:    0 Size:    44
    ; }
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass, field

from .offsets import Offsets

_BLOCK = re.compile(r"; cbuffer (\S+)$")
_OPEN = re.compile(r";\s+struct (?:struct\.|hostlayout\.)*(\S+)$")
_CLOSE = re.compile(r";\s+\} (\w+)((?:\[\d+\])*);+\s+; Offset:\s*(\d+)")
_MEMBER = re.compile(r";\s+\w.* (\w+)((?:\[\d+\])*);\s+; Offset:\s*(\d+)")
_LENGTH = re.compile(r"\[\d+\]")


@dataclass(slots=True)
class _Struct:
    """A struct while its members are being read."""

    type_name: str
    members: dict[str, int] = field(default_factory=dict)
    member_types: dict[str, str] = field(default_factory=dict)
    """For each member that is a single struct, the name of its type."""

    def add(self, name: str, lengths: str, offset: int, inner: _Struct | None = None) -> None:
        """Add a member and everything inside it, whose names get the member's name as a prefix."""
        self.members[name] = offset
        if inner is None:
            return
        if not lengths:
            self.member_types[name] = inner.type_name
        element = name + _LENGTH.sub("[]", lengths)
        for path, place in inner.members.items():
            self.members[f"{element}.{path}"] = place


def block_offsets_dxil(text: str) -> Offsets:
    """The layout of the constant buffers, with the same names as ``block_offsets_spirv`` uses.

    DXC prints offsets but no strides, so there are no ``lights[]`` entries. A ``ConstantBuffer<T>``
    is named ``T``, as it is in SPIR-V.
    """
    blocks: Offsets = {}
    lines = iter(text.splitlines())
    for line in lines:
        if found := _BLOCK.match(line):
            name, members = _unwrapped(found[1], _outermost_struct(lines))
            blocks[name] = members
    return blocks


def _outermost_struct(lines: Iterator[str]) -> _Struct:
    """Read to the end of the next struct; a buffer without a struct is empty."""
    open_structs: list[_Struct] = []
    for line in lines:
        if found := _OPEN.match(line):
            open_structs.append(_Struct(found[1]))
        elif (found := _CLOSE.match(line)) and open_structs:
            inner = open_structs.pop()
            if not open_structs:
                return inner
            open_structs[-1].add(found[1], found[2], int(found[3]), inner)
        elif (found := _MEMBER.match(line)) and open_structs:
            open_structs[-1].add(found[1], found[2], int(found[3]))
    return _Struct("")


def _unwrapped(name: str, struct: _Struct) -> tuple[str, dict[str, int]]:
    """A block's name and members; for a ``ConstantBuffer<T>``, those of ``T``.

    DXC prints such a buffer as one that has a single member with its own name, of the type ``T``.
    """
    inner = struct.member_types.get(name)
    if inner is None:
        return name, struct.members
    prefix = f"{name}."
    members = {
        path.removeprefix(prefix): place
        for path, place in struct.members.items()
        if path.startswith(prefix)
    }
    return inner, members
