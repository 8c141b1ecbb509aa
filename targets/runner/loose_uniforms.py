"""Lists the loose uniforms that replace a block, in texts that have no blocks.

``binding.py`` asks for profiles with loose uniforms (``Profile.loose_uniforms``). A host then sets
each uniform by its name, from the bytes that the block would have: those of structures and of their
arrays have names such as ``lamps[2].place``.
"""

from __future__ import annotations

import re
from collections.abc import Iterator

from ...compiler.documents.backends import BlockBindingRow
from ...compiler.documents.values import BlockRow
from .drivers.slots import UniformSlot

_ARRAY = re.compile(r"(.+)\[(\d+)\]$")


def uniforms_of(block: BlockRow, binding: BlockBindingRow) -> Iterator[UniformSlot]:
    """The uniforms of a block of the reflection, by its entry in a backend's ``blocks``."""
    structs = {row.name: row for row in block.structs}
    names = binding.members
    pending = [
        (names[row.name], row.type, row.offset, row.size)
        for row in block.members
        if row.parameter is not None
    ]
    while pending:
        name, type_, offset, size = pending.pop()
        array = _ARRAY.match(type_)
        element = array[1] if array else type_
        if element not in structs:
            yield UniformSlot(name, offset, size)
            continue
        struct = structs[element]
        places = [f"{name}[{number}]" for number in range(int(array[2]))] if array else [name]
        for number, place in enumerate(places):
            start = offset + number * struct.size
            for member in struct.members:
                own = names[f"{element}.{member.name}"]
                pending.append((f"{place}.{own}", member.type, start + member.offset, member.size))
