"""Reading SPIR-V, counting in it, and optimising it."""

from __future__ import annotations

import struct

import pytest

from burnish.targets.toolchain import (
    Job,
    SpirvError,
    Toolchain,
    block_offsets_spirv,
    count_instructions,
    optimise,
)
from burnish.targets.toolchain.spirv import MAGIC, Op

WGSL = """@fragment fn main(@location(0) x: f32) -> @location(0) vec4<f32> {
  let unused = x * 3.0;
  return vec4<f32>(x + x);
}
"""


def _module(*instructions: tuple[int, ...]) -> bytes:
    words = [MAGIC, 0x10000, 0, 100, 0]
    for opcode, *operands in instructions:
        words += [(len(operands) + 1) << 16 | opcode, *operands]
    return struct.pack(f"<{len(words)}I", *words)


def test_only_what_is_done_in_functions_counts() -> None:
    add, give_back = (129, 1, 2, 3, 4), (253,)
    function = [(Op.FUNCTION, 1, 2, 0, 3), (Op.FUNCTION_PARAMETER, 1, 4), (Op.LABEL, 5)]
    body = [(Op.LINE, 1, 2, 3), add, (Op.NO_LINE,), add, give_back, (Op.FUNCTION_END,)]
    assert count_instructions(_module(add, *function, *body, *function, *body)) == 6


@pytest.mark.parametrize(
    "junk",
    [
        b"",
        b"junk",
        b"x" * 23,
        b"\0" * 24,
        _module((Op.LABEL, 1))[:-4],
        _module() + b"\0" * 4,
    ],
)
def test_anything_else_than_spirv_is_refused(junk: bytes) -> None:
    for read in (count_instructions, block_offsets_spirv, optimise):
        with pytest.raises(SpirvError):
            read(junk)


def test_spirv_opt_takes_what_naga_makes_of_wgsl(toolchain: Toolchain) -> None:
    [verdict] = toolchain.check([Job("naga", "frag", WGSL)], keep_modules=True)
    assert verdict.spirv is not None, verdict.report()
    better = optimise(verdict.spirv)
    # load, add, composite, store, return
    assert count_instructions(better) == 5 < count_instructions(verdict.spirv)


@pytest.mark.usefixtures("no_tools")
def test_a_missing_optimiser_is_named() -> None:
    with pytest.raises(SpirvError, match="spirv-opt is not installed"):
        optimise(_module())
