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
    return "\n".join(number for each in values for number in lanes(tuple(each.values())))


def lanes(value: Any) -> Iterator[str]:
    """The numbers of a value in nested tuples."""
    if isinstance(value, tuple):
        for each in value:
            yield from lanes(each)
    else:
        yield value.hex() if isinstance(value, float) else str(int(value))
