"""The row of Unreal Engine, which the registry of engines loads."""

from __future__ import annotations

from ..engine import Engine
from ..surface import writing
from .functions import functions

ENGINE = Engine(
    name="unreal",
    title="Unreal Engine",
    targets=("hlsl",),
    write=writing("Unreal Engine", "ush", functions),
    unproven="never compiled by Unreal's own compiler",
)
