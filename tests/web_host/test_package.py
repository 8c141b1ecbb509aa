"""Packages follow their schema, which the host's types are made of."""

from __future__ import annotations

import json

import pytest
from jsonschema import Draft202012Validator

from burnish.compiler.documents.reading import read
from burnish.compiler.documents.schema import json_schema
from burnish.compiler.documents.writing import to_json
from burnish.targets.web_host.serving.packages import Package

from .test_geometry import hosted


@pytest.mark.parametrize("name", ["instances", "displacement", "thorns"])
def test_packages_follow_their_schema(name: str) -> None:
    _, package = hosted(name)
    document = json.loads(json.dumps(package))
    validator = Draft202012Validator(json_schema(Package))
    wrong = [f"{each.json_path}: {each.message}" for each in validator.iter_errors(document)]
    assert not wrong
    assert to_json(read(Package, document)) == document
