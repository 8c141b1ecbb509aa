"""Packages follow their schema, which the host's types are made of."""

from __future__ import annotations

import json
from typing import Any

import pytest
from jsonschema import Draft202012Validator
from referencing import Registry, Resource

from ..layout.test_reflection import objects
from .document_types import DOCUMENTS, ROOT
from .test_geometry import hosted


@pytest.fixture(scope="module")
def validator() -> Draft202012Validator:
    paths = [ROOT / folder / f"{name}.schema.json" for name, (folder, _) in DOCUMENTS.items()]
    schemas = {path.name: json.loads(path.read_text(encoding="utf-8")) for path in paths}
    resources = [(name, Resource.from_contents(each)) for name, each in schemas.items()]
    registry: Registry[Any] = Registry().with_resources(resources)
    return Draft202012Validator(schemas["package.schema.json"], registry=registry)


def test_the_schema_describes_every_property(validator: Draft202012Validator) -> None:
    schema: Any = validator.schema
    Draft202012Validator.check_schema(schema)
    for path, part in objects(schema):
        if path.endswith(".properties"):
            continue
        assert part["additionalProperties"] is False, path
        for name, row in part["properties"].items():
            assert "description" in row or "$ref" in row, f"{path}.{name}"


@pytest.mark.parametrize("name", ["instances", "displacement", "thorns"])
def test_packages_follow_their_schema(validator: Draft202012Validator, name: str) -> None:
    _, package = hosted(name)
    # Tuples are lists in JSON.
    document = json.loads(json.dumps(package))
    wrong = [f"{each.json_path}: {each.message}" for each in validator.iter_errors(document)]
    assert not wrong
