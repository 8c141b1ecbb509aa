"""The row of Bevy, which the registry of engines loads."""

from __future__ import annotations

from ..engine import Engine
from .extension import write
from .language import language
from .values import TABLES

ENGINE = Engine(
    name="bevy",
    title="Bevy",
    targets=(),
    write=write,
    dialect=language,
    taken=TABLES.taken,
    is_offered=True,
)
