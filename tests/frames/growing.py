"""Documents in which one list, or one object with free keys, has as many elements as one likes.

The lists are found in the JSON Schemas, so that those which a schema gets later are found as well.
``test_growing.py`` asks whether twice the elements are twice the work.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from copy import deepcopy
from dataclasses import dataclass
from typing import Any

Path = tuple[str | int, ...]
ANY = "*"
"""In a path, any element of a list, or any key of an object with free keys."""

DEEPEST = 14
"""How long the paths are that are followed: some definitions contain themselves."""


@dataclass(frozen=True, slots=True)
class Growing:
    """A list or an object of a document, and what its elements look like."""

    path: Path
    element: Mapping[str, Any]
    """Their schema."""
    document: str
    """The document whose schema that stands in."""
    is_list: bool

    @property
    def name(self) -> str:
        """What tests call it."""
        return "/".join(map(str, self.path))


class Schemas:
    """Schemas that refer to each other, by their names."""

    def __init__(self, documents: Mapping[str, Mapping[str, Any]]) -> None:
        self._documents = documents

    def growing(self, name: str) -> Sequence[Growing]:
        """All lists and objects of a document that can be as long as one likes."""
        found: dict[Path, Growing] = {}
        for each in self._inside(self._documents[name], name, (), ()):
            found.setdefault(each.path, each)
        return list(found.values())

    def grown(self, document: Any, where: Growing, name: str, count: int) -> Any:
        """A document with so many elements there: like those that it has, or the least that the
        schema allows. Each has names of its own."""
        whole = deepcopy(document)
        place = self._place(whole, where.path, name)
        values = list(place) if where.is_list else list(place.values())
        sample = values[0] if values else self.sample(where.element, where.document)
        if where.is_list:
            place[:] = [_numbered(sample, number) for number in range(count)]
        else:
            place.clear()
            place.update({f"key {number}": _numbered(sample, number) for number in range(count)})
        return whole

    def sample(self, schema: Mapping[str, Any], name: str) -> Any:
        """The least value that follows a schema."""
        schema, name = self.whole(schema, name)
        for key in ("oneOf", "anyOf"):
            if key in schema and "properties" not in schema:
                return self.sample(schema[key][-1], name)
        if "const" in schema or "enum" in schema:
            return schema.get("const", schema.get("enum", [None])[0])
        type_ = schema.get("type", "null")
        type_ = type_ if isinstance(type_, str) else type_[0]
        if type_ == "object":
            rows = schema.get("properties", {})
            needed = schema.get("required", ())
            return {key: self.sample(rows[key], name) for key in needed}
        if type_ == "array":
            least = schema.get("minItems", 0)
            return [self.sample(schema["items"], name) for _ in range(least)]
        least = schema.get("minimum", 0)
        return {"string": "x", "boolean": False, "null": None}.get(type_, least)

    def whole(self, schema: Mapping[str, Any], name: str) -> tuple[Mapping[str, Any], str]:
        """A schema without the reference that it consists of, and the document that has it."""
        while "$ref" in schema:
            file, _, path = schema["$ref"].partition("#")
            name = file or name
            schema = self._documents[name]
            for part in filter(None, path.split("/")):
                schema = schema[part]
        return schema, name

    def _inside(
        self, schema: Mapping[str, Any], name: str, path: Path, around: tuple[int, ...]
    ) -> Iterator[Growing]:
        schema, name = self.whole(schema, name)
        if around.count(id(schema)) > 1 or len(path) > DEEPEST:
            return
        around = (*around, id(schema))
        for key in ("oneOf", "anyOf"):
            for each in schema.get(key, ()):
                yield from self._inside(each, name, path, around)
        for key, row in schema.get("properties", {}).items():
            yield from self._inside(row, name, (*path, key), around)
        items, others = schema.get("items"), schema.get("additionalProperties")
        if items is not None:
            if schema.get("maxItems") is None:
                yield Growing(path, *self.whole(items, name), is_list=True)
            yield from self._inside(items, name, (*path, ANY), around)
        if isinstance(others, dict):
            yield Growing(path, *self.whole(others, name), is_list=False)
            yield from self._inside(others, name, (*path, ANY), around)

    def _place(self, value: Any, path: Path, name: str) -> Any:
        """The container at a path, which is made where a document has none."""
        schema, name = self.whole(self._documents[name], name)
        for key, following in zip(path, (*path[1:], ANY), strict=True):
            row, of = self._below(schema, name, value, key)
            inner = _step(value, key, following)
            if not isinstance(inner, dict | list) or not inner:
                _put(value, key, self._container(row, of))
                inner = _step(value, key, following)
            value, (schema, name) = inner, self.whole(row, of)
        return value

    def _below(
        self, schema: Mapping[str, Any], name: str, value: Any, key: str | int
    ) -> tuple[Mapping[str, Any], str]:
        """The schema of what stands under a key."""
        for each, of in self._alternatives(schema, name):
            if key == ANY:
                found = each.get("items", each.get("additionalProperties"))
            else:
                found = each.get("properties", {}).get(key)
            kind = each.get("properties", {}).get("kind", {}).get("const")
            fits = kind is None or not isinstance(value, dict) or value.get("kind", kind) == kind
            if isinstance(found, dict) and fits:
                return found, of
        raise AssertionError(f"nothing stands at {key}")

    def _alternatives(
        self, schema: Mapping[str, Any], name: str
    ) -> Iterator[tuple[Mapping[str, Any], str]]:
        schema, name = self.whole(schema, name)
        yield schema, name
        for key in ("oneOf", "anyOf"):
            for each in schema.get(key, ()):
                yield from self._alternatives(each, name)

    def _container(self, schema: Mapping[str, Any], name: str) -> Any:
        """The least list or object that follows a schema."""
        for each, of in self._alternatives(schema, name):
            if "items" in each:
                return []
            if "properties" in each or "additionalProperties" in each:
                return self.sample({**each, "type": "object"}, of)
        raise AssertionError("no container")


def _step(value: Any, key: str | int, following: str | int) -> Any:
    """What stands under a key; of any elements, the first one with what is wanted next."""
    if key != ANY:
        return value.get(key)
    elements = list(value) if isinstance(value, list) else list(value.values())
    fitting = (each for each in elements if isinstance(each, dict) and following in each)
    return next(fitting, next(iter(elements), None))


def _put(value: Any, key: str | int, inner: Any) -> None:
    if key != ANY:
        value[key] = inner
    elif isinstance(value, list):
        value[:] = [inner]
    else:
        value.clear()
        value["key"] = inner


def _numbered(sample: Any, number: int) -> Any:
    """An element with a name of its own, where it has one."""
    if number == 0:
        return sample
    if isinstance(sample, str):
        return f"{sample}{number}"
    if not isinstance(sample, dict):
        return deepcopy(sample)
    keys = ("name", "result", "reflection", "file")
    return {**sample, **{key: f"{sample[key]}{number}" for key in keys
                         if isinstance(sample.get(key), str)}}  # fmt: skip
