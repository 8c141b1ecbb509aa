"""Makes JSON Schemas of documents: ``burnish schema`` prints them.

They follow draft 2020-12 (https://json-schema.org/draft/2020-12), and describe exactly what
``reading`` takes, so that a host can check documents in any language.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, Literal, get_args, get_origin

from ..constraints import Length, Nested, Pattern, Range
from .docstrings import docs_of
from .shapes import (
    Field,
    alternatives_of,
    bare,
    constraints_of,
    fields_of,
    is_record,
    may_be_null,
)

Schema = dict[str, Any]

_SCALARS: Mapping[Any, str] = {bool: "boolean", int: "integer", float: "number", str: "string"}


def json_schema(kind: type) -> Schema:
    """The JSON Schema of a document; records that it contains are among its ``$defs``."""
    definitions: dict[str, Schema] = {}
    whole = _Schemas(definitions).record(kind)
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": kind.__name__,
        **whole,
        "$defs": dict(sorted(definitions.items())),
    }


class _Schemas:
    def __init__(self, definitions: dict[str, Schema]) -> None:
        self._definitions = definitions

    def record(self, kind: type) -> Schema:
        """The schema of a kind of record."""
        docs = docs_of(kind)
        fields = fields_of(kind)
        properties = {}
        for field in fields:
            described = docs.fields.get(field.name, "")
            about = {"description": described} if described else {}
            properties[field.key] = {**about, **self._field(field)}
        return {
            "description": docs.whole,
            "type": "object",
            "properties": properties,
            "required": [field.key for field in fields if not field.is_optional],
            "additionalProperties": False,
        }

    def _field(self, field: Field) -> Schema:
        """The schema of a record's field."""
        if field.spelling is None:
            return self._schema(field.type)
        words: list[str | None] = [*field.spelling.values()]
        return {"enum": [*words, None] if may_be_null(bare(field.type)) else words}

    def _schema(self, type_: Any) -> Schema:
        constraints, inner = constraints_of(type_), bare(type_)
        for each in constraints:
            if isinstance(each, Nested):
                return self._nested(each)
        found = self._plain(inner)
        for each in constraints:
            found |= _keywords(each)
        return found

    def _plain(self, type_: Any) -> Schema:
        """The schema of a type without constraints."""
        if is_record(type_):
            return self._reference(type_)
        origin = get_origin(type_)
        if origin is Literal:
            words = list(get_args(type_))
            return {"const": words[0]} if len(words) == 1 else {"enum": words}
        if origin is tuple:
            return self._list(get_args(type_))
        if is_mapping(origin):
            return {"type": "object", "additionalProperties": self._schema(get_args(type_)[1])}
        if type_ in _SCALARS:
            return {"type": _SCALARS[type_]}
        return {} if type_ is Any else self._union(type_)

    def _list(self, parts: tuple[Any, ...]) -> Schema:
        if parts and parts[-1] is ...:
            return {"type": "array", "items": self._schema(parts[0])}
        count = {"minItems": len(parts), "maxItems": len(parts)}
        return {"type": "array", **({"items": self._schema(parts[0])} if parts else {}), **count}

    def _union(self, type_: Any) -> Schema:
        """One of several kinds of records, or anything that may be null."""
        schemas = [self._schema(each) for each in alternatives_of(type_)]
        if may_be_null(type_):
            schemas.append({"type": "null"})
        return {"oneOf": schemas}

    def _nested(self, constraint: Nested) -> Schema:
        name = constraint.name
        if name not in self._definitions:
            itself = {"$ref": f"#/$defs/{name}"}
            containers = {"items": itself}
            types = ["number", "boolean", "null", "array"]
            if constraint.objects:
                types.append("object")
                containers["additionalProperties"] = itself
            self._definitions[name] = {
                "description": constraint.doc, "type": types, **containers,
            }  # fmt: skip
        return {"$ref": f"#/$defs/{name}"}

    def _reference(self, kind: type) -> Schema:
        name = kind.__name__
        if name not in self._definitions:
            self._definitions[name] = {}  # A record may contain itself.
            self._definitions[name] = self.record(kind)
        return {"$ref": f"#/$defs/{name}"}


def is_mapping(origin: Any) -> bool:
    """True if a generic type is one of mappings."""
    return isinstance(origin, type) and issubclass(origin, Mapping)


def _keywords(constraint: Any) -> Schema:
    """A constraint as keywords of JSON Schema."""
    match constraint:
        case Range(least, most, multiple_of):
            found = {"minimum": least, "maximum": most, "multipleOf": multiple_of}
            return {key: value for key, value in found.items() if value is not None}
        case Length(least):
            return {"minItems": least}
        case Pattern(text):
            return {"pattern": f"^(?:{text})$"}
        case _:
            return {}
