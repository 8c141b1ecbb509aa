"""The numbers that programs in C and C++ read: values of all samples, then those of builtins."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from .calls import ROUNDS, operands
from .kit import samples


def numbers() -> str:
    """The numbers, one a line; floats are hexadecimal, so that nothing is rounded."""
    given = (sample for sample in samples() if sample.block.derivation is None)
    values = [each.values for each in given] + [operands(seed) for seed in range(ROUNDS)]
    return "\n".join(number for each in values for number in _numbers(tuple(each.values())))


def _numbers(value: Any) -> Iterator[str]:
    if isinstance(value, tuple):
        for each in value:
            yield from _numbers(each)
    else:
        yield value.hex() if isinstance(value, float) else str(int(value))
