"""The row of Filament, which the registry of engines loads."""

from __future__ import annotations

from ..engine import Engine
from .definition import definition
from .language import language

ENGINE = Engine(
    name="filament",
    title="Filament",
    extension="mat",
    language=language,
    write=definition,
)
