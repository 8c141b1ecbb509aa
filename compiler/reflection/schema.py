"""The JSON Schemas of reflections and of plans, and checks against them.

Compiling never imports this module: ``jsonschema`` is needed by those who check only.
"""

from __future__ import annotations

import json
from importlib.resources import files
from typing import Any

from jsonschema import Draft202012Validator
from referencing import Registry, Resource

REFLECTION, PLAN = "reflection.schema.json", "plan.schema.json"


def schema(name: str = REFLECTION) -> dict[str, Any]:
    """One of the schemas, which lie beside this module."""
    text = files(__package__).joinpath(name).read_text(encoding="utf-8")
    loaded: dict[str, Any] = json.loads(text)
    return loaded


def validate(reflection: dict[str, Any]) -> None:
    """Raises ``jsonschema.ValidationError`` where the reflection does not follow the schema."""
    Draft202012Validator(schema()).validate(reflection)


def validate_plan(plan: dict[str, Any]) -> None:
    """Raises ``jsonschema.ValidationError`` where the plan does not follow the schema."""
    rows = Resource.from_contents(schema())
    registry: Registry[Any] = Registry().with_resource(REFLECTION, rows)
    Draft202012Validator(schema(PLAN), registry=registry).validate(plan)
