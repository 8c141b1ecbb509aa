"""The JSON Schemas of reflections and of plans, and checks against them.

Compiling never imports this module: ``jsonschema`` is needed by those who check only.
"""

from __future__ import annotations

import json
from functools import cache
from importlib.resources import files
from typing import Any

from jsonschema import Draft202012Validator
from jsonschema.exceptions import best_match
from referencing import Registry, Resource

REFLECTION, PLAN = "reflection.schema.json", "plan.schema.json"


def schema(name: str = REFLECTION) -> dict[str, Any]:
    """One of the schemas, which lie beside this module."""
    text = files(__package__).joinpath(name).read_text(encoding="utf-8")
    loaded: dict[str, Any] = json.loads(text)
    return loaded


def validate(reflection: dict[str, Any]) -> None:
    """Raises ``jsonschema.ValidationError`` where the reflection does not follow the schema."""
    _validator(REFLECTION).validate(reflection)


def validate_plan(plan: dict[str, Any]) -> None:
    """Raises ``jsonschema.ValidationError`` where the plan does not follow the schema."""
    _validator(PLAN).validate(plan)


def errors(document: Any, name: str = REFLECTION) -> list[str]:
    """Where a document does not follow its schema: each place with what is wrong there, the
    deepest one of alternatives."""
    found = sorted(map(best_match, ([each] for each in _validator(name).iter_errors(document))),
                   key=lambda error: [str(part) for part in error.absolute_path])  # fmt: skip
    return [f"{error.json_path}: {error.message}" for error in found]


@cache
def _validator(name: str) -> Draft202012Validator:
    rows = Resource.from_contents(schema())
    registry: Registry[Any] = Registry().with_resource(REFLECTION, rows)
    return Draft202012Validator(schema(name), registry=registry)
