"""The row of Godot 4, which the registry of engines loads."""

from __future__ import annotations

from ..engine import Engine
from ..surface import writing
from .language import language
from .shader import shader
from .values import TABLES

ENGINE = Engine(
    name="godot",
    title="Godot 4",
    targets=(),
    write=writing("Godot", "gdshader", shader),
    taken=TABLES.taken,
    dialect=language,
)
