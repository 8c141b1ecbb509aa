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

MOST = 160
"""How many letters a message has at most."""
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
    """Where a document does not follow its schema: each place, as a JSON path, with what is wrong
    there. Where there are alternatives, it is told of the one that is meant most likely."""
    found = [best_match([each]) for each in _validator(name).iter_errors(document)]
    return sorted(f"{error.json_path}: {_short(error.message)}" for error in found if error)


def _short(message: str) -> str:
    """A message without all of what it is about, which may be the whole document."""
    return message if len(message) <= MOST else f"{message[: MOST // 2]} … {message[-MOST // 2 :]}"


@cache
def _validator(name: str) -> Draft202012Validator:
    rows = Resource.from_contents(schema())
    registry: Registry[Any] = Registry().with_resource(REFLECTION, rows)
    return Draft202012Validator(schema(name), registry=registry)
