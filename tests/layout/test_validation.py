"""Documents are checked against their schemas: as the standard says, and without taking long."""

from __future__ import annotations

import json
from random import Random
from typing import Any

import pytest
from jsonschema import Draft202012Validator
from referencing import Registry, Resource

from burnish.compiler.reflection.schema import PLAN, REFLECTION, errors, schema
from burnish.compiler.reflection.validation import MOST, Compiler, first_errors

from ..fuzz.hostile.documents import mutated
from ..fuzz.hostile.plans import received

FRAME = received("reaction")
DOCUMENTS: dict[str, list[Any]] = {PLAN: [FRAME.plan], REFLECTION: [*FRAME.reflections.values()]}
TRIED = 150


def standard(name: str) -> Draft202012Validator:
    """What a library makes of a schema."""
    registry: Registry[Any] = Registry().with_resources(
        (each, Resource.from_contents(schema(each))) for each in (PLAN, REFLECTION)
    )
    return Draft202012Validator(schema(name), registry=registry)


def without_points(document: Any) -> Any:
    """A document in which no number is 1.0, which is whole by the standard, and not here."""
    return json.loads(json.dumps(document), parse_float=lambda _text: 0.25)


@pytest.mark.parametrize("name", DOCUMENTS)
def test_the_same_is_wrong_as_by_the_standard(name: str) -> None:
    check, random, wrong = standard(name), Random(name), 0
    for number in range(TRIED):
        document = without_points(mutated(random.choice(DOCUMENTS[name]), random))
        is_valid = check.is_valid(document)
        wrong += not is_valid
        assert (not errors(document, name)) == is_valid, f"{number}: {errors(document, name)}"
    assert TRIED / 4 < wrong < TRIED


def test_no_more_is_told_than_people_read() -> None:
    plan = {**FRAME.plan, "textures": [7] * 300_000}
    found = errors(plan, PLAN)
    assert found[:2] == ["/textures/0: 7 is not an object", "/textures/1: 7 is not an object"]
    assert (len(found), found[-1]) == (MOST + 1, "and more")


def test_alternatives_are_told_apart_by_their_constants() -> None:
    step = next(each for each in FRAME.plan["steps"] if each["kind"] == "run")
    others: dict[str, Any] = {
        "/steps/0/barriers/0/to": {"barriers": [{**step["barriers"][0], "to": "x" * 90}]},
        "/steps/0": {"kind": "fly"},
        "/steps/0/inputs/0": {"inputs": [{"name": "x"}]},
        "/steps/0/inputs/1": {"inputs": [step["inputs"][0], {"name": "x", "value": 0, "host": ""}]},
    }
    told = [errors({**FRAME.plan, "steps": [{**step, **other}]}, PLAN) for other in others.values()]
    assert [each for found in told for each in found] == [
        f'/steps/0/barriers/0/to: "{"x" * 60}…" is not "target", "depth", "image", "sampled", '
        '"copied_from" or "copied_to"',
        '/steps/0: it is not an object whose `kind` is "draw", an object whose `kind` is "run" or '
        'an object whose `kind` is "copy"',
        "/steps/0/inputs/0: there is no `value`",
        "/steps/0/inputs/1: it has the members of several alternatives",
    ]


RULES: dict[str, tuple[dict[str, Any], Any, str]] = {
    "type": ({"type": ["integer", "null"]}, 1.0, "/: 1.0 is not a whole number or null"),
    "true is no number": ({"type": "number"}, True, "/: true is not a number"),
    "const": ({"const": 1}, True, "/: true is not 1"),
    "minimum": ({"minimum": 0}, -1, "/: -1 is not 0 or more"),
    "range": ({"minimum": 0, "maximum": 1}, 2, "/: 2 is not 0 to 1"),
    "multiple": ({"multipleOf": 16}, 8, "/: 8 is no multiple of 16"),
    "pattern": ({"pattern": "^a?$"}, "a\n", '/: "a\\n" does not look like ^a?$'),
    "length": ({"minItems": 2}, [1], "/: it has 1 elements, and not 2 or more"),
    "unknown": ({"additionalProperties": False}, {"a/b~": 0},
                '/: there is "a/b~", which has no meaning there'),
    "place": ({"additionalProperties": {"type": "null"}}, {"a/b~": 0}, "/a~1b~0: 0 is not null"),
    "dependent": ({"dependentRequired": {"a": ["b"]}}, {"a": 0}, "/: there is `a`, and no `b`"),
}  # fmt: skip


@pytest.mark.parametrize("name", RULES)
def test_messages_name_the_place_and_what_is_there(name: str) -> None:
    rule, document, wanted = RULES[name]
    check = Compiler({"s": rule}).check_of("s")
    assert [*first_errors(check, json.loads(json.dumps(document)))] == [wanted]


def test_schemas_with_unknown_words_are_refused() -> None:
    with pytest.raises(ValueError, match=r"s has words that are not known: \['uniqueItems'\]"):
        Compiler({"s": {"uniqueItems": True}}).check_of("s")
