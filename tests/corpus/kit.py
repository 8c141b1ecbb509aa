"""The corpus as a reader of its files has it, and its numbers."""

from __future__ import annotations

import json
import struct
from collections.abc import Iterator
from functools import cache
from typing import Any

import pytest

from burnish.targets.conformance.corpus.making import make
from burnish.targets.conformance.corpus.operands import OPERATIONS

SEED = 1
NAMES = tuple(OPERATIONS)

each_name = pytest.mark.parametrize(
    "name", [pytest.param(name, marks=pytest.mark.xdist_group(f"corpus {name}")) for name in NAMES]
)
"""A test of each operation. Those of one run in one process, which makes its file once."""

Json = dict[str, Any]


@cache
def _text(name: str) -> str:
    return make([name], SEED, "test", lambda _share: None)[f"{name}.json"]


def corpus(name: str) -> Json:
    """The file of an operation, with the seed that the command takes by itself."""
    found: Json = json.loads(_text(name))
    return found


def cases(name: str) -> Iterator[tuple[Json, Json]]:
    """Each case of an operation, with its overload."""
    for overload in corpus(name)["overloads"]:
        for case in overload["cases"]:
            yield overload, case


def number(bits: str, kind: str) -> float:
    """The number that bits stand for."""
    if kind == "float":
        (found,) = struct.unpack(">f", bytes.fromhex(bits))
        return float(found)
    value = int(bits, 16)
    return value - 2**32 if kind == "int" and value >= 2**31 else value


def shown(overload: Json, case: Json) -> str:
    """The operands of a case, for messages."""
    return ", ".join(
        f"{type_['name']}({', '.join(repr(number(bits, type_['kind'])) for bits in lanes)})"
        for type_, lanes in zip(overload["operands"], case["operands"], strict=True)
    )
