"""Reads the parts of SPIR-V's binary form that the checkers and the benchmark need.

A module is a stream of 32-bit words: a header of five words, then instructions. The first word of
an instruction holds its length (upper half) and its opcode (lower half).
"""

from __future__ import annotations

import struct
from collections.abc import Iterator
from dataclasses import dataclass
from enum import IntEnum

from .process import run
from .tools import program

MAGIC = 0x07230203
HEADER_WORDS = 5

OPTIMISE_LIMIT = 60.0
"""The seconds after which spirv-opt is stopped."""


class Op(IntEnum):
    """The opcodes that this package uses."""

    SOURCE_CONTINUED = 2
    SOURCE = 3
    NAME = 5
    MEMBER_NAME = 6
    LINE = 8
    ENTRY_POINT = 15
    EXECUTION_MODE = 16
    CAPABILITY = 17
    TYPE_INT = 21
    TYPE_FLOAT = 22
    TYPE_VECTOR = 23
    TYPE_MATRIX = 24
    TYPE_ARRAY = 28
    TYPE_STRUCT = 30
    TYPE_POINTER = 32
    CONSTANT = 43
    FUNCTION = 54
    FUNCTION_PARAMETER = 55
    FUNCTION_END = 56
    VARIABLE = 59
    DECORATE = 71
    MEMBER_DECORATE = 72
    LABEL = 248
    NO_LINE = 317


EXECUTION_MODELS = {0: "vert", 1: "tesc", 2: "tese", 3: "geom", 4: "frag", 5: "comp"}

_SOURCE = frozenset({Op.SOURCE, Op.SOURCE_CONTINUED})
_NOT_CODE = frozenset({Op.FUNCTION_PARAMETER, Op.LABEL, Op.LINE, Op.NO_LINE})


class SpirvError(ValueError):
    """The bytes are not a SPIR-V module, or a tool failed on them."""


@dataclass(frozen=True, slots=True)
class Instruction:
    """One instruction: its opcode and the words after it."""

    opcode: int
    operands: tuple[int, ...]


def instructions(spirv: bytes) -> Iterator[Instruction]:
    """The instructions of a module, in order. Raises ``SpirvError`` for anything else."""
    words = _words(spirv)
    place = HEADER_WORDS
    while place < len(words):
        length, opcode = words[place] >> 16, words[place] & 0xFFFF
        if length == 0 or place + length > len(words):
            raise SpirvError(f"broken instruction at word {place}")
        yield Instruction(opcode, words[place + 1 : place + length])
        place += length


def string_at(operands: tuple[int, ...], start: int) -> str:
    """The text that starts at one of an instruction's operands."""
    data = struct.pack(f"<{len(operands) - start}I", *operands[start:])
    return data.partition(b"\0")[0].decode(errors="replace")


def entry_points(spirv: bytes) -> set[tuple[str, str]]:
    """The stages and names of a module's entry points, e.g. ``("frag", "main")``."""
    return {
        (EXECUTION_MODELS.get(each.operands[0], "other"), string_at(each.operands, 2))
        for each in instructions(spirv)
        if each.opcode == Op.ENTRY_POINT
    }


def count_instructions(spirv: bytes) -> int:
    """The number of instructions in the bodies of functions, without labels and lines."""
    count, inside = 0, False
    for each in instructions(spirv):
        if each.opcode == Op.FUNCTION:
            inside = True
        elif each.opcode == Op.FUNCTION_END:
            inside = False
        elif inside and each.opcode not in _NOT_CODE:
            count += 1
    return count


def without_source(spirv: bytes) -> bytes:
    """A module without ``OpSource``.

    Older SPIRV-Tools refuse a module whose source language they do not know, for example WGSL.
    """
    kept = list(_words(spirv)[:HEADER_WORDS])
    for each in instructions(spirv):
        if each.opcode not in _SOURCE:
            kept += [(len(each.operands) + 1) << 16 | each.opcode, *each.operands]
    return struct.pack(f"<{len(kept)}I", *kept)


def optimise(spirv: bytes) -> bytes:
    """The module after ``spirv-opt -O``, without debug information.

    Raises ``SpirvError`` if spirv-opt is missing or fails.
    """
    tool = program("spirv-tools", "spirv-opt")
    if tool is None:
        raise SpirvError("spirv-opt is not installed")
    arguments = [str(tool), "--strip-debug", "-O", "-", "-o", "-"]
    outcome = run(arguments, time_limit=OPTIMISE_LIMIT, stdin=without_source(spirv))
    if outcome.ending != "ended" or outcome.code != 0:
        raise SpirvError(f"spirv-opt failed: {outcome.log}")
    return outcome.output


def insist_on_valid(spirv: bytes) -> None:
    """Raise ``SpirvError`` if spirv-val, with the rules of Vulkan 1.1, refuses a module."""
    tool = program("spirv-tools", "spirv-val")
    if tool is None:
        raise SpirvError("spirv-val is not installed")
    arguments = [str(tool), "--target-env", "vulkan1.1", "-"]
    outcome = run(arguments, time_limit=OPTIMISE_LIMIT, stdin=spirv)
    if outcome.ending != "ended" or outcome.code != 0:
        raise SpirvError(f"spirv-val refuses it: {outcome.log}")


def _words(spirv: bytes) -> tuple[int, ...]:
    """The module's words, header included."""
    if len(spirv) % 4 or len(spirv) < 4 * HEADER_WORDS:
        raise SpirvError("not a SPIR-V module: its length is wrong")
    words = struct.unpack(f"<{len(spirv) // 4}I", spirv)
    if words[0] != MAGIC:
        raise SpirvError("not a SPIR-V module: its first word is wrong")
    return words
