"""JSON Schemas say of documents what reading does: the same documents follow them."""

from __future__ import annotations

import json
from collections.abc import Callable, Iterator, Mapping
from functools import cache
from random import Random
from typing import Any

import pytest
from jsonschema import Draft202012Validator

from burnish.compiler.documents.plan import FramePlan
from burnish.compiler.documents.reading import ShapeError, read
from burnish.compiler.documents.reflection import Reflection
from burnish.compiler.documents.schema import json_schema
from burnish.compiler.documents.typescript import typescript
from burnish.compiler.documents.writing import to_json
from burnish.targets.runner.frames.host import FrameHost
from burnish.targets.runner.frames.scenery import in_a_row
from burnish.targets.web_host.package import frame_package
from burnish.targets.web_host.serving.packages import Package

from ..frames.kit import FOLDER, compiled
from ..fuzz.hostile.documents import mutated
from ..fuzz.hostile.plans import NAMES, received

TRIED = 150
ENOUGH = 3


@cache
def _package(name: str) -> Any:
    frame = compiled(FOLDER / f"{name}.burnish")
    tags = {row.name: row.materials for row in frame.plan.models}
    materials = list(dict.fromkeys(each for listed in tags.values() for each in listed))
    host = FrameHost(frame, in_a_row(materials, tags, "cube"), (8, 8))
    return json.loads(json.dumps(to_json(frame_package(host))))


DOCUMENTS: Mapping[type, Callable[[str], list[Any]]] = {
    FramePlan: lambda name: [received(name).plan],
    Reflection: lambda name: [*received(name).reflections.values()],
    Package: lambda name: [_package(name)],
}
"""The documents of a kind that belong to an example."""


@cache
def standard(kind: type) -> Draft202012Validator:
    """A library's validator for the schema of a kind.

    The library reads patterns as Python does, where ``$`` also matches before a last line break; by
    the standard it does not.
    """
    text = json.dumps(json_schema(kind))
    return Draft202012Validator(json.loads(text.replace(')$"', ')\\\\Z"')))


def without_points(document: Any) -> Any:
    """A document in which no number is 1.0, which is whole by the standard, and not here."""
    return json.loads(json.dumps(document), parse_float=lambda _text: 0.25)


def is_read(kind: type, document: Any) -> bool:
    """True if a document can be read."""
    try:
        read(kind, document)
    except ShapeError:
        return False
    return True


@pytest.mark.parametrize("kind", DOCUMENTS)
def test_documents_follow_their_schemas(kind: type) -> None:
    for name in NAMES[:ENOUGH]:
        for document in DOCUMENTS[kind](name):
            assert [each.message for each in standard(kind).iter_errors(document)] == []
            assert is_read(kind, document)


@pytest.mark.parametrize("kind", DOCUMENTS)
def test_the_same_is_wrong_as_by_the_standard(kind: type) -> None:
    documents = [each for name in NAMES for each in DOCUMENTS[kind](name)]
    check, random, wrong = standard(kind), Random(kind.__name__), 0
    for number in range(TRIED):
        document = without_points(mutated(random.choice(documents), random))
        is_valid = check.is_valid(document)
        wrong += not is_valid
        assert is_read(kind, document) == is_valid, number
    assert TRIED / 4 < wrong < TRIED


def records(schema: Any) -> Iterator[tuple[str, Any]]:
    """The schema of each record of a document, with its name."""
    yield schema["title"], schema
    for name, each in schema["$defs"].items():
        if "properties" in each:
            yield name, each


def alternatives(part: Any) -> Iterator[str]:
    """The names of all records that stand beside others, of which one is meant."""
    if isinstance(part, dict):
        named = [
            each["$ref"].rpartition("/")[2] for each in part.get("oneOf", ()) if "$ref" in each
        ]
        if len(named) > 1:
            yield from named
        part = list(part.values())
    if isinstance(part, list):
        for each in part:
            yield from alternatives(each)


@pytest.mark.parametrize("kind", DOCUMENTS)
def test_the_schema_is_one_and_describes_every_property(kind: type) -> None:
    """Exceptions are words by which records are told apart, and lists that are always empty."""
    schema = json_schema(kind)
    Draft202012Validator.check_schema(schema)
    told_apart = set(alternatives(schema))
    assert len(told_apart) > 10
    for name, record in records(schema):
        assert record["additionalProperties"] is False, name
        assert record["description"], name
        for key, row in record["properties"].items():
            is_telling = name in told_apart and row.keys() <= {"const", "enum"}
            target = schema["$defs"][row["$ref"].rpartition("/")[2]] if "$ref" in row else {}
            described = row.get("description") or target.get("description")
            assert described or is_telling or row.get("maxItems") == 0, f"{name}.{key}"


def test_words_are_those_of_webgpu() -> None:
    found = json_schema(Reflection)["$defs"]
    assert found["DepthState"]["properties"]["compare"]["enum"][3] == "less-equal"
    assert found["SamplerState"]["properties"]["compare"]["enum"][-1] is None
    modes = '"repeat" | "clamp-to-edge" | "mirror-repeat" | "clamp-to-border"'
    assert f"  wrap: {modes};" in typescript(Reflection)


def test_bounds_are_keywords() -> None:
    """The bounds of a block, of lanes, of a mask, and of a place."""
    found = json_schema(Reflection)["$defs"]
    assert found["BlockRow"]["properties"]["size"] == {
        "description": "Bytes, a multiple of 16.",
        "type": "integer", "minimum": 0, "multipleOf": 16,
    }  # fmt: skip
    assert found["TargetRow"]["properties"]["mask"]["pattern"] == "^(?:r?g?b?a?|none)$"
    assert found["LayoutRow"]["required"] == ["stored"]
    assert found["CaptureRow"]["properties"]["members"]["minItems"] == 1
