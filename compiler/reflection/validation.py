"""Checks documents against JSON Schemas: the part of that language which plans, reflections and
packages are described in.

``schema.py`` calls it. A document may come from anybody, so each value is looked at once, and what
is wrong is counted. Libraries take fifty times as long, and compute all errors of all alternatives
before they give the first one. A schema is compiled to functions once; one that uses a word which
is not known here is refused, so that nothing is left unchecked silently.

In two things the check is stricter than the standard. A whole number has no point, so that it can
be an index in every language. A pattern is about a whole text.
"""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from typing import Any

Schema = Mapping[str, Any]
Place = tuple[Any, str | int] | None
"""The place of what contains a value, and the key of the value in it; ``None`` of the whole."""

MOST = 100
"""How many errors are told."""

_SAID = 60
"""How many letters of a value are told."""


class Found(list[str]):
    """What is wrong in a document, so far."""

    def add(self, place: Place, message: str) -> None:
        """Note an error. Raises ``EnoughError`` where enough are known."""
        self.append(f"{pointer(place)}: {message}")
        if len(self) > MOST:
            raise EnoughError


class EnoughError(Exception):
    """There are more errors than people want to read."""


Words = Sequence[Any]
"""The only values that something may have."""

Check = Callable[[Any, Place, Found], None]
"""Notes what is wrong with a value at a place."""


def pointer(place: Place) -> str:
    """A place as a JSON pointer; ``/`` is the whole document."""
    parts: list[str] = []
    while place is not None:
        place, key = place
        shown = str(key).replace("~", "~0").replace("/", "~1")
        parts.append(shown if len(shown) <= _SAID else f"{shown[:_SAID]}…")
    return "/" + "/".join(reversed(parts))


def shown(value: Any) -> str:
    """A value of a document for a message: containers only by their size."""
    if isinstance(value, dict):
        return "an object"
    if isinstance(value, list):
        return f"a list of {len(value)}"
    if isinstance(value, str) and len(value) > _SAID:
        return json.dumps(f"{value[:_SAID]}…", ensure_ascii=False)
    return json.dumps(value, ensure_ascii=False)


class Compiler:
    """Makes functions of schemas, which may refer to each other."""

    def __init__(self, documents: Mapping[str, Schema]) -> None:
        """``documents`` are all schemas, by the names with which they refer to each other."""
        self._documents = documents
        self._known: dict[str, Check] = {}
        """By reference, what has been compiled of it."""

    def check_of(self, document: str) -> Check:
        """What checks a whole document against the schema of this name."""
        return self._compiled(self._documents[document], document)

    def _compiled(self, schema: Schema, document: str) -> Check:
        unknown = schema.keys() - _KEYWORDS.keys() - _NOTES - {"$ref"}
        if unknown:
            raise ValueError(f"{document} has words that are not known: {sorted(unknown)}")
        makers = dict.fromkeys(_KEYWORDS[key] for key in _KEYWORDS if key in schema)
        rules = [make(self, schema, document) for make in makers]
        if "$ref" in schema:
            rules.append(self._referred(schema["$ref"], document))
        fits = None if "type" not in schema else _type_test(schema["type"])
        wanted = "" if fits is None else _or(_TYPES[name][0] for name in _names(schema["type"]))

        def check(value: Any, place: Place, found: Found) -> None:
            if fits is not None and not fits(value):
                found.add(place, f"{shown(value)} is not {wanted}")
                return
            for rule in rules:
                rule(value, place, found)

        return check

    def _referred(self, reference: str, document: str) -> Check:
        """What a reference means; it is compiled when it is first needed, as some are circles."""
        schema, name, key = self._resolved(reference, document)

        def check(value: Any, place: Place, found: Found) -> None:
            known = self._known.get(key)
            if known is None:
                known = self._known[key] = self._compiled(schema, name)
            known(value, place, found)

        return check

    def _resolved(self, reference: str, document: str) -> tuple[Schema, str, str]:
        """A part of a schema, the document that it stands in, and what it is called everywhere."""
        file, _, path = reference.partition("#")
        name = file or document
        found: Any = self._documents[name]
        for part in filter(None, path.split("/")):
            found = found[part]
        return found, name, f"{name}#{path}"

    # --- keywords --------------------------------------------------------------------------------

    def object_(self, schema: Schema, document: str) -> Check:
        """The members of an object: which there must be, and what each of them is."""
        members = {key: self._compiled(each, document)
                   for key, each in schema.get("properties", {}).items()}  # fmt: skip
        required: Sequence[str] = schema.get("required", ())
        further = schema.get("additionalProperties", True)
        others = None if isinstance(further, bool) else self._compiled(further, document)

        def check(value: Any, place: Place, found: Found) -> None:
            if not isinstance(value, dict):
                return
            for key in required:
                if key not in value:
                    found.add(place, f"there is no `{key}`")
            for key, inner in value.items():
                known = members.get(key, others)
                if known is not None:
                    known(inner, (place, key), found)
                elif further is False:
                    found.add(place, f"there is {shown(key)}, which has no meaning there")

        return check

    def dependent(self, schema: Schema, _document: str) -> Check:
        """Members of an object that go with others."""
        rows: Mapping[str, Sequence[str]] = schema["dependentRequired"]

        def check(value: Any, place: Place, found: Found) -> None:
            if isinstance(value, dict):
                for key, needed in rows.items():
                    for other in needed if key in value else ():
                        if other not in value:
                            found.add(place, f"there is `{key}`, and no `{other}`")

        return check

    def list_(self, schema: Schema, document: str) -> Check:
        """The elements of a list, and how many there are."""
        least, most = schema.get("minItems", 0), schema.get("maxItems")
        each = self._compiled(schema["items"], document) if "items" in schema else None

        def check(value: Any, place: Place, found: Found) -> None:
            if not isinstance(value, list):
                return
            if len(value) < least or (most is not None and len(value) > most):
                found.add(place, f"it has {len(value)} elements, and not {_range(least, most)}")
            if each is not None:
                for number, inner in enumerate(value):
                    each(inner, (place, number), found)

        return check

    def number(self, schema: Schema, _document: str) -> Check:
        """How large a number is."""
        least, most, step = (schema.get(key) for key in ("minimum", "maximum", "multipleOf"))

        def check(value: Any, place: Place, found: Found) -> None:
            if isinstance(value, bool) or not isinstance(value, int | float):
                return
            if (least is not None and value < least) or (most is not None and value > most):
                found.add(place, f"{shown(value)} is not {_range(least, most)}")
            elif step is not None and value % step:
                found.add(place, f"{shown(value)} is no multiple of {step}")

        return check

    def words(self, schema: Schema, _document: str) -> Check:
        """One of a few values."""
        allowed = _allowed(schema)
        known = frozenset(map(_distinct, allowed))
        wanted = _or(map(shown, allowed))

        def check(value: Any, place: Place, found: Found) -> None:
            if isinstance(value, dict | list) or _distinct(value) not in known:
                found.add(place, f"{shown(value)} is not {wanted}")

        return check

    def pattern(self, schema: Schema, _document: str) -> Check:
        """What a text looks like."""
        said: str = schema["pattern"]
        if not (said.startswith("^") and said.endswith("$")):
            raise ValueError(f"a pattern is about a whole text, and {said} is not")
        matches = re.compile(said[1:-1]).fullmatch

        def check(value: Any, place: Place, found: Found) -> None:
            if isinstance(value, str) and not matches(value):
                found.add(place, f"{shown(value)} does not look like {said}")

        return check

    def all_of(self, schema: Schema, document: str) -> Check:
        """Several schemas at once."""
        checks = [self._compiled(each, document) for each in schema["allOf"]]

        def check(value: Any, place: Place, found: Found) -> None:
            for each in checks:
                each(value, place, found)

        return check

    def condition(self, schema: Schema, document: str) -> Check:
        """What holds only of some values, which a member of them tells."""
        applies = self._glance(schema["if"], document, _listed)
        then = self._compiled(schema["then"], document)

        def check(value: Any, place: Place, found: Found) -> None:
            if applies(value):
                then(value, place, found)

        return check

    def alternatives(self, schema: Schema, document: str) -> Check:
        """One of several schemas. Types and constant members tell at a glance which one is meant,
        so that the others are not even tried."""
        is_single = "oneOf" in schema
        schemas = schema["oneOf" if is_single else "anyOf"]
        parts = [(self._glance(each, document, _constants), self._compiled(each, document))
                 for each in schemas]  # fmt: skip
        wanted = _or(self._described(each, document) for each in schemas)

        def check(value: Any, place: Place, found: Found) -> None:
            likely = [each for glance, each in parts if glance(value)]
            if not likely:
                found.add(place, f"it is not {wanted}")
            elif len(likely) == 1:
                likely[0](value, place, found)
            else:
                _check_each(likely, value, place, found, is_single=is_single)

        return check

    # --- alternatives ----------------------------------------------------------------------------

    def _glance(
        self, schema: Schema, document: str, constants: Callable[[Schema], Mapping[str, Words]]
    ) -> Callable[[Any], bool]:
        """Whether neither the type of a value nor one of some members contradicts a schema."""
        schema, document = self._whole(schema, document)
        fits = _type_test(schema["type"]) if "type" in schema else None
        words_of = {key: frozenset(map(_distinct, words))
                    for key, words in constants(schema).items()}  # fmt: skip

        def glance(value: Any) -> bool:
            if fits is not None and not fits(value):
                return False
            if not isinstance(value, dict):
                return True
            return all(
                key not in value or (_is_word(value[key]) and _distinct(value[key]) in words)
                for key, words in words_of.items()
            )

        return glance

    def _described(self, schema: Schema, document: str) -> str:
        """What an error calls an alternative."""
        schema, _ = self._whole(schema, document)
        told = [f"`{key}` is {_or(map(shown, words))}" for key, words in _constants(schema).items()]
        type_ = _or(_TYPES[name][0] for name in _names(schema.get("type", "object")))
        return f"{type_} whose {' and '.join(told)}" if told else type_

    def _whole(self, schema: Schema, document: str) -> tuple[Schema, str]:
        """A schema without the reference that it consists of."""
        while "$ref" in schema:
            schema, document, _ = self._resolved(schema["$ref"], document)
        return schema, document


def _check_each(
    checks: Iterable[Check], value: Any, place: Place, found: Found, *, is_single: bool
) -> None:
    """Note what is wrong by the alternative that fits best."""
    tried = []
    for check in checks:
        tried.append(Found())
        with suppress(EnoughError):
            check(value, place, tried[-1])
    best = min(tried, key=len)
    if best:
        found.extend(best[: MOST + 1 - len(found)])
        if len(found) > MOST:
            raise EnoughError
    elif is_single and sum(not each for each in tried) > 1:
        found.add(place, "it has the members of several alternatives")


# --- words ---------------------------------------------------------------------------------------

_NOTES = frozenset(("$schema", "$id", "$defs", "title", "description", "default", "type"))
"""What is only for people, or is read where others are."""

_KEYWORDS: Mapping[str, Callable[[Compiler, Schema, str], Check]] = {
    "enum": Compiler.words, "const": Compiler.words,
    "required": Compiler.object_, "properties": Compiler.object_,
    "additionalProperties": Compiler.object_, "dependentRequired": Compiler.dependent,
    "items": Compiler.list_, "minItems": Compiler.list_, "maxItems": Compiler.list_,
    "minimum": Compiler.number, "maximum": Compiler.number, "multipleOf": Compiler.number,
    "pattern": Compiler.pattern, "allOf": Compiler.all_of,
    "if": Compiler.condition, "then": Compiler.condition,
    "oneOf": Compiler.alternatives, "anyOf": Compiler.alternatives,
}  # fmt: skip
"""What compiles each word of a schema; words that belong together are compiled together."""

_TYPES: Mapping[str, tuple[str, tuple[type, ...]]] = {
    "null": ("null", (type(None),)),
    "boolean": ("true or false", (bool,)),
    "integer": ("a whole number", (int,)),
    "number": ("a number", (int, float)),
    "string": ("a text", (str,)),
    "array": ("a list", (list,)),
    "object": ("an object", (dict,)),
}
"""What messages call each type, and what it is in Python, where true is no number here."""


def _names(type_: str | Sequence[str]) -> Sequence[str]:
    return [type_] if isinstance(type_, str) else type_


def _type_test(type_: str | Sequence[str]) -> Callable[[Any], bool]:
    kinds = frozenset(kind for name in _names(type_) for kind in _TYPES[name][1])
    return lambda value: type(value) in kinds


def _allowed(schema: Schema) -> Words:
    """The only values that a schema allows, as far as it lists them."""
    return [schema["const"]] if "const" in schema else schema.get("enum", ())


def _listed(schema: Schema) -> dict[str, Words]:
    """The members of an object that have one of a few values, with these."""
    rows = schema.get("properties", {}).items()
    return {key: _allowed(row) for key, row in rows if _allowed(row)}


def _constants(schema: Schema) -> dict[str, Words]:
    """Those that have only one: by them, people tell alternatives apart."""
    return {key: words for key, words in _listed(schema).items() if len(words) == 1}


def _is_word(value: Any) -> bool:
    return not isinstance(value, dict | list)


def _distinct(value: Any) -> tuple[bool, Any]:
    """A value as a key: true is not 1."""
    return isinstance(value, bool), value


def _range(least: Any, most: Any) -> str:
    if least == most:
        return f"{least}"
    if most is None:
        return f"{least} or more"
    return f"{most} or less" if least is None else f"{least} to {most}"


def _or(words: Iterable[str]) -> str:
    *most, last = words
    return f"{', '.join(most)} or {last}" if most else last


def first_errors(check: Check, document: Any) -> Iterator[str]:
    """Where a document does not follow a schema: each place, with what is wrong there; at last, if
    there is more, a line that says so."""
    found = Found()
    with suppress(EnoughError):
        check(document, None, found)
    yield from found[:MOST]
    if len(found) > MOST:
        yield "and more"
