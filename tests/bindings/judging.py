"""Judges what a compiled program has told: the bytes of all samples, of all defaults, and builtins.

The programs in C++ and Rust tell them in this order, a block in each line.
"""

from __future__ import annotations

from .calls import ROUNDS, every_builtin, expected, is_close, operands, stored
from .kit import Sample, defaults, difference, samples


def assert_bytes(told: list[bytes]) -> None:
    """The bytes of each sample are the runtime's; those of derived values are close to them."""

    def wrong(sample: Sample, found: bytes) -> str:
        text = difference(sample.expected, found)
        return text and f"{sample.block.name} of {sample.material}, {sample.seed}: {text}"

    found = zip(samples(), told[: len(samples())], strict=True)
    assert not [text for each in found if (text := wrong(*each))]


def assert_defaults(told: list[bytes]) -> None:
    """Each block that a host sets begins with its defaults."""
    found = zip(defaults(), told[len(samples()) : -ROUNDS], strict=True)
    assert not [block.name for (block, expected), bytes_ in found if bytes_ != expected]


def assert_builtins(told: list[bytes]) -> None:
    """Each builtin has the reference's value for the operands of each round."""
    wrong = []
    for seed, block in enumerate(told[-ROUNDS:]):
        values = operands(seed)
        for row in every_builtin()[1]:
            pair = expected(row, values), stored(row, block)
            if not all(is_close(*each) for each in zip(*pair, strict=True)):
                given = [values[field.word] for field, _ in row.operands]
                wrong.append(f"{row.function}({given}) is {pair[0]}, not {pair[1]}")
    assert not wrong, "\n".join(wrong[:20])
