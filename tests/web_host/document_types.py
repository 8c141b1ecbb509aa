"""Writes the types of the documents that the host reads: packages, plans and reflections.

``generated.py`` puts them into the tree. json-schema-to-typescript makes them of the JSON Schemas,
which are first put together in one, since each names things of the others. Definitions of plans
have ``Plan`` before their names there, as reflections have some of the same names.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parents[2]
_REFLECTION = "compiler/reflection"
DOCUMENTS = {
    "package": ("targets/web_host", ""),
    "plan": (_REFLECTION, "plan_"),
    "reflection": (_REFLECTION, ""),
}
"""By name, the folder of its schema, and what its definitions have before their names here."""

_FOR_VALIDATORS = {"dependentRequired", "if", "then", "pattern", "minimum", "maximum", "multipleOf"}
"""What types cannot say."""


def whole_schema() -> dict[str, Any]:
    """The schema of packages, with everything that it consists of."""
    definitions: dict[str, Any] = {}
    for name, (folder, prefix) in DOCUMENTS.items():
        path = ROOT / folder / f"{name}.schema.json"
        schema = json.loads(path.read_text(encoding="utf-8"))
        own = {f"{prefix}{key}": each for key, each in schema.pop("$defs").items()}
        schema = {key: each for key, each in schema.items() if key not in ("$id", "title")}
        for key, each in {name: schema, **own}.items():
            definitions[key] = _simplified(each, name)
    package = definitions.pop("package")
    return {**package, "title": "Frame package", "$defs": definitions}


def _simplified(schema: Any, document: str) -> Any:
    """A schema of a document, with only what types say."""
    if isinstance(schema, list):
        return [_simplified(each, document) for each in schema]
    if not isinstance(schema, dict):
        return schema
    kept = {
        key: _simplified(each, document)
        for key, each in schema.items()
        if key not in _FOR_VALIDATORS and not _only_requires(each)
    }
    if kept.get("minItems") != kept.get("maxItems"):
        kept = {key: each for key, each in kept.items() if key not in ("minItems", "maxItems")}
    if "$ref" in kept:
        # Beside a reference, a description would make another type of what is referred to.
        reference = {"$ref": _reference(kept.pop("$ref"), document)}
        return {**kept, "allOf": [reference]} if kept else reference
    return kept


def _only_requires(value: Any) -> bool:
    """Whether these are alternatives that differ in what has to be there."""
    is_list = isinstance(value, list) and value and all(isinstance(each, dict) for each in value)
    return bool(is_list) and all(each.keys() <= {"required", "if", "then"} for each in value)


def _reference(reference: str, document: str) -> str:
    file, _, path = reference.partition("#")
    name = file.removesuffix(".schema.json") or document
    prefix = DOCUMENTS[name][1]
    key = path.removeprefix("/$defs/")
    return f"#/$defs/{prefix}{key}" if key else f"#/$defs/{name}"
