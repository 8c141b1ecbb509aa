"""The row of Unity, which the registry of engines loads."""

from __future__ import annotations

from ..engine import Engine
from ..slot_table import INPUTS
from ..surface import writing
from .functions import functions

ENGINE = Engine(
    name="unity",
    title="Unity",
    targets=("hlsl",),
    write=writing("Unity", "hlsl", functions),
    taken=frozenset(row.name for row in INPUTS),
    by_hand=True,
    unproven="never compiled by Unity's own compiler",
)
