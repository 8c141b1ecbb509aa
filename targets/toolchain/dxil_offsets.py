"""Reads the layout of constant buffers out of DXC's disassembly of DXIL.

It is drawn in comments, the name of a struct below its members::

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
    """The types of those members that are single structs."""

    def add(self, name: str, lengths: str, offset: int, inner: _Struct | None = None) -> None:
        """Adds a member and, prefixed with its name, all that is inside it."""
        self.members[name] = offset
        if inner is None:
            return
        if not lengths:
            self.member_types[name] = inner.type_name
        element = name + _LENGTH.sub("[]", lengths)
        for path, place in inner.members.items():
            self.members[f"{element}.{path}"] = place


def block_offsets_dxil(text: str) -> Offsets:
    """The constant buffers' layout, named as ``block_offsets_spirv`` names things.

    DXC prints offsets and no distances, so there are no ``lights[]`` entries. A
    ``ConstantBuffer<T>`` is named ``T``, as it is in SPIR-V.
    """
    blocks: Offsets = {}
    lines = iter(text.splitlines())
    for line in lines:
        if found := _BLOCK.match(line):
            name, members = _unwrapped(found[1], _outermost_struct(lines))
            blocks[name] = members
    return blocks


def _outermost_struct(lines: Iterator[str]) -> _Struct:
    """Reads to the end of the struct that starts next; a buffer without one is empty."""
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
    """A block's name and members; of a ``ConstantBuffer<T>`` those of ``T``.

    DXC shows such a buffer as one with a single member of its own name and of the type ``T``.
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
