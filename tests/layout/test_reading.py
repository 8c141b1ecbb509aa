"""The errors of documents that have another shape than their kind declares."""

from __future__ import annotations

from collections.abc import Mapping
from math import inf, nan
from typing import Annotated, Any, ClassVar, Literal

import pytest

from burnish.compiler.constraints import Count, Lanes, Length, Nested, Pattern, Range, dashed
from burnish.compiler.documents.plan import FramePlan
from burnish.compiler.documents.reading import MOST, ShapeError, read
from burnish.compiler.documents.reflection import Reflection
from burnish.compiler.documents.writing import to_json
from burnish.support.frozen import frozen

from ..fuzz.hostile.plans import NAMES, received

FRAME = received("reaction")


@frozen(kw_only=True)
class Leaf:
    """A record without others."""

    kind: Literal["leaf"]
    name: str
    note: str | None = None


@frozen(kw_only=True)
class Branch:
    """A record that contains itself."""

    KEYS: ClassVar = {"at_end": "atEnd"}

    kind: Literal["branch", "twig"]
    at_end: tuple[Leaf | Branch, ...]


@frozen(kw_only=True)
class Whole:
    """A document with a field of each type that fields have."""

    VERSION: ClassVar = "format"
    WORDS: ClassVar = {
        "spelt": dashed(("less_equal", "less")), "perhaps_spelt": {"clamp": "clamp-to-edge"},
    }  # fmt: skip

    format: Literal[2]
    flag: bool
    number: float
    whole: int
    text: str
    word: Literal["a", "b", None]
    count: Count
    share: Annotated[float, Range(0, 1)]
    rows: Annotated[int, Range(least=0, multiple_of=16)]
    mask: Annotated[str, Pattern("r?g?|none")]
    some: Annotated[tuple[int, ...], Length(2)]
    pair: tuple[int, int] | None
    none: tuple[()]
    named: Mapping[str, int]
    value: Lanes
    native: Annotated[Any, Nested("Native", "Anything.", objects=True)]
    class_: str
    tree: Leaf | Branch | None
    leaf: Leaf | None
    spelt: Literal["less_equal", "less"]
    perhaps_spelt: str | None


GOOD: Mapping[str, Any] = {
    "format": 2,
    "flag": True,
    "number": 1,
    "whole": -3,
    "text": "",
    "word": None,
    "count": 0,
    "share": 0.5,
    "rows": 32,
    "mask": "rg",
    "some": [1, 2],
    "pair": [3, 4],
    "none": [],
    "named": {"a": 1},
    "value": [[1, 2.5], [True, None]],
    "native": {"a": [1, {"b": False}]},
    "class": "c",
    "tree": {"kind": "twig", "atEnd": [{"kind": "leaf", "name": "x", "note": "y"}]},
    "leaf": None,
    "spelt": "less-equal",
    "perhaps_spelt": "clamp-to-edge",
}


def told(**wrong: object) -> list[str]:
    """The errors of the document with other members."""
    with pytest.raises(ShapeError) as failed:
        read(Whole, {**GOOD, **wrong})
    return str(failed.value).splitlines()


def test_a_document_becomes_a_record() -> None:
    """Lists become tuples, names and words are those of Python, and what may be absent is null."""
    assert read(Whole, GOOD) == Whole(
        format=2,
        flag=True,
        number=1,
        whole=-3,
        text="",
        word=None,
        count=0,
        share=0.5,
        rows=32,
        mask="rg",
        some=(1, 2),
        pair=(3, 4),
        none=(),
        named={"a": 1},
        value=((1, 2.5), (True, None)),
        native={"a": (1, {"b": False})},
        class_="c",
        tree=Branch(kind="twig", at_end=(Leaf(kind="leaf", name="x", note="y"),)),
        leaf=None,
        spelt="less_equal",
        perhaps_spelt="clamp",
    )
    assert to_json(read(Whole, GOOD)) == GOOD


def test_a_spelt_word_may_be_null() -> None:
    without = {**GOOD, "perhaps_spelt": None}
    assert read(Whole, without).perhaps_spelt is None
    assert to_json(read(Whole, without)) == without


WRONG: Mapping[str, tuple[Any, str]] = {
    "flag": (1, "/flag: 1 is not true or false"),
    "number": (True, "/number: true is not a number"),
    "whole": (1.0, "/whole: 1.0 is not a whole number"),
    "text": (None, "/text: null is not a text"),
    "word": ("x" * 90, f'/word: "{"x" * 60}…" is not "a", "b" or null'),
    "count": (-1, "/count: -1 is not 0 or more"),
    "share": (2, "/share: 2 is not 0 to 1"),
    "rows": (8, "/rows: 8 is no multiple of 16"),
    "mask": ("rg\n", '/mask: "rg\\n" does not look like r?g?|none'),
    "some": ([1], "/some: it has 1 elements, and not 2 or more"),
    "pair": ([1, 2, 3], "/pair: it has 3 elements, and not 2"),
    "none": ([0], "/none: it has 1 elements, and not 0"),
    "named": ([], "/named: a list of 0 is not an object"),
    "value": ({"a": 1}, "/value: an object is no part of a value"),
    "native": ({"a": ["b"]}, '/native/a/0: "b" is no part of a value'),
    "class": ({}, "/class: an object is not a text"),
    "leaf": (7, "/leaf: 7 is not an object"),
    "spelt": ("less_equal", '/spelt: "less_equal" is not "less-equal" or "less"'),
    "perhaps_spelt": (["clamp"], '/perhaps_spelt: a list of 1 is not "clamp-to-edge" or null'),
}
"""For each member, a value of a wrong type or beyond its bounds, and the error about it."""


@pytest.mark.parametrize("name", WRONG)
def test_a_wrong_value_is_told_with_its_place(name: str) -> None:
    value, wanted = WRONG[name]
    assert told(**{name: value}) == [wanted]


@pytest.mark.parametrize(
    ("value", "said"),
    [
        ("2", '"2"'), (None, "null"), ([2], "a list of 1"), ({"a": 2}, "an object"),
        (True, "true"), (2.5, "2.5"),
    ],
)  # fmt: skip
def test_values_are_told_shortly(value: object, said: str) -> None:
    assert told(whole=value) == [f"/whole: {said} is not a whole number"]


@pytest.mark.parametrize(("number", "said"), [(nan, "NaN"), (inf, "Infinity")])
def test_no_number_is_infinite_or_none(number: float, said: str) -> None:
    assert told(number=number) == [f"/number: {said} is not a number"]
    assert told(value=[number]) == [f"/value/0: {said} is no part of a value"]


def test_members_are_missed_and_others_refused() -> None:
    leaf = {"kind": "leaf", "nam": "x", "a/b~": 0}
    assert told(leaf=leaf, tree={"kind": "branch", "atEnd": [leaf]}) == [
        line
        for place in ("/tree/atEnd/0", "/leaf")
        for line in (
            f"{place}: there is no `name`",
            f'{place}: there is "nam", which has no meaning there',
            f'{place}: there is "a/b~", which has no meaning there',
        )
    ]


def test_places_are_json_pointers() -> None:
    assert told(named={"a/b~c": None, "x" * 90: 0.5}) == [
        "/named/a~1b~0c: null is not a whole number",
        f"/named/{'x' * 60}…: 0.5 is not a whole number",
    ]


@pytest.mark.parametrize("value", [{"kind": "root"}, {}, {"kind": 3}, [], "leaf"], ids=str)
def test_alternatives_are_told_apart_by_a_word(value: object) -> None:
    kinds = [f'an object whose `kind` is "{word}"' for word in ("leaf", "branch")]
    kinds.append('an object whose `kind` is "twig"')
    assert told(tree=value) == [f"/tree: it is not {', '.join(kinds)} or null"]


def test_what_is_no_object_is_no_document() -> None:
    with pytest.raises(ShapeError) as failed:
        read(Whole, [GOOD])
    assert str(failed.value) == "/: a list of 1 is not an object"


@pytest.mark.parametrize(("version", "said"), [(1, "1"), (3, "3"), ("2", '"2"'), (True, "true")])
def test_another_version_is_all_that_is_told(version: object, said: str) -> None:
    assert told(format=version, flag=3, more=0) == [
        f"/format: this is version {said}, and Burnish reads version 2: compile the source again"
    ]


def test_a_document_without_a_version_is_told_like_others() -> None:
    document = {key: value for key, value in GOOD.items() if key != "format"}
    with pytest.raises(ShapeError) as failed:
        read(Whole, document)
    assert str(failed.value) == "/: there is no `format`"


def test_no_more_is_told_than_people_read() -> None:
    plan = {**FRAME.plan, "textures": [7] * 300_000}
    with pytest.raises(ShapeError) as failed:
        read(FramePlan, plan)
    found = str(failed.value).splitlines()
    assert found[:2] == ["/textures/0: 7 is not an object", "/textures/1: 7 is not an object"]
    assert (len(found), found[-1]) == (MOST + 1, "and more")


def test_as_many_errors_as_people_read_are_told_without_more() -> None:
    assert told(named=dict.fromkeys(map(str, range(MOST)), "")) == [
        f'/named/{number}: "" is not a whole number' for number in range(MOST)
    ]


def test_steps_of_plans_are_told_apart() -> None:
    number, step = next(
        (number, step) for number, step in enumerate(FRAME.plan["steps"]) if step["kind"] == "run"
    )
    use = step["use"]
    others: dict[str, Any] = {
        "an unknown use": {"barriers": [{**step["barriers"][0], "after": "x" * 90}]},
        "an unknown step": {"kind": "fly"},
        "an input of nothing": {"use": {**use, "inputs": [{"name": "x"}]}},
        "an input of two things": {
            "use": {
                **use,
                "inputs": [{"name": "x", "source": {"kind": "value", "value": 0, "host": ""}}],
            }
        },
        "an input of another kind": {
            "use": {**use, "inputs": [{"name": "x", "source": {"kind": "guess"}}]}
        },
    }
    found = []
    for other in others.values():
        steps = list(FRAME.plan["steps"])
        steps[number] = {**step, **other}
        with pytest.raises(ShapeError) as failed:
            read(FramePlan, {**FRAME.plan, "steps": steps})
        found += str(failed.value).splitlines()
    assert found == [
        f'/steps/{number}/barriers/0/after: "{"x" * 60}…" is not "target", "depth", "image", '
        '"sampled", "copied_from" or "copied_to"',
        f'/steps/{number}: it is not an object whose `kind` is "draw", an object whose `kind` is '
        '"run" or an object whose `kind` is "copy"',
        f"/steps/{number}/use/inputs/0: there is no `source`",
        f'/steps/{number}/use/inputs/0/source: there is "host", which has no meaning there',
        f"/steps/{number}/use/inputs/0/source: it is not an object whose `kind` is "
        '"value", an object whose `kind` is "result", an object whose `kind` is "host" or an '
        'object whose `kind` is "previous"',
    ]


@pytest.mark.parametrize("name", NAMES)
def test_documents_come_back_as_they_were_written(name: str) -> None:
    frame = received(name)
    assert to_json(read(FramePlan, frame.plan)) == frame.plan
    for document in frame.reflections.values():
        assert to_json(read(Reflection, document)) == document
