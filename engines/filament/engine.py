"""The row of Filament, which the registry of engines loads."""

from __future__ import annotations

from ..engine import Engine
from ..surface import writing
from .definition import definition
from .language import language
from .values import TABLES

ENGINE = Engine(
    name="filament",
    title="Filament",
    targets=(),
    write=writing("Filament", "mat", definition),
    taken=TABLES.taken,
    dialect=language,
)
