"""The JSON Schemas of reflections and of plans, and checks against them.

Compiling never imports this module: only those who check, and those who read documents from files.
"""

from __future__ import annotations

import json
from collections.abc import Sequence
from functools import cache
from importlib.resources import files
from typing import Any

from .validation import Check, Compiler, first_errors

REFLECTION, PLAN = "reflection.schema.json", "plan.schema.json"


class SchemaError(ValueError):
    """A document does not follow its schema; the text says where, in lines."""


def schema(name: str = REFLECTION) -> dict[str, Any]:
    """One of the schemas, which lie beside this module."""
    text = files(__package__).joinpath(name).read_text(encoding="utf-8")
    loaded: dict[str, Any] = json.loads(text)
    return loaded


def validate(document: Any, name: str = REFLECTION) -> None:
    """Raises ``SchemaError`` where a document does not follow its schema."""
    if found := errors(document, name):
        raise SchemaError("\n".join(found))


def errors(document: Any, name: str = REFLECTION) -> Sequence[str]:
    """The first places at which a document does not follow its schema: each as a JSON pointer, with
    what is wrong there."""
    return list(first_errors(_check(name), document))


@cache
def _check(name: str) -> Check:
    return Compiler({each: schema(each) for each in (REFLECTION, PLAN)}).check_of(name)
