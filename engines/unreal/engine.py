"""The row of Unreal Engine, which the registry of engines loads."""

from __future__ import annotations

from ..engine import Engine
from ..slot_table import INPUTS
from ..surface import writing
from .functions import functions

ENGINE = Engine(
    name="unreal",
    title="Unreal Engine",
    targets=("hlsl",),
    write=writing("Unreal Engine", "ush", functions),
    taken=frozenset(row.name for row in INPUTS),
    by_hand=True,
    unproven="never compiled by Unreal's own compiler",
)
