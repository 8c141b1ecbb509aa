"""The JSON Schema of the reflection, and a check against it.

Compiling never imports this module: ``jsonschema`` is needed by those who check only.
"""

from __future__ import annotations

import json
from importlib.resources import files
from typing import Any

from jsonschema import Draft202012Validator

SCHEMA = "reflection.schema.json"


def schema() -> dict[str, Any]:
    """The schema that lies beside this module."""
    text = files(__package__).joinpath(SCHEMA).read_text(encoding="utf-8")
    loaded: dict[str, Any] = json.loads(text)
    return loaded


def validate(reflection: dict[str, Any]) -> None:
    """Raises ``jsonschema.ValidationError`` where the reflection does not follow the schema."""
    Draft202012Validator(schema()).validate(reflection)
