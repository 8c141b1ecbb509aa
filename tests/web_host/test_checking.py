"""Packages that the host refuses: it names the place, as Burnish itself does of a document."""

from __future__ import annotations

import json
from copy import deepcopy
from random import Random
from typing import Any

import pytest

from burnish.compiler.documents.reading import ShapeError, read
from burnish.targets.web_host.serving.packages import Package

from ..fuzz.hostile.documents import mutated
from .by_hand import package
from .kit import in_node

REFUSED = """(from) => {
  try {
    return call(from) ?? "";
  } catch (error) {
    return error.constructor.name + ": " + error.message;
  }
}"""


def refused(packages: list[Any]) -> list[str]:
    """The error of each package; empty where there is none."""
    found: list[str] = in_node("checking.js", "checkPackage", REFUSED, packages)
    return found


def without(path: str) -> Any:
    """The package made by hand, without one of its members."""
    whole = package()
    *steps, last = path.split("/")
    del at(whole, steps)[last]
    return whole


def with_(path: str, value: Any) -> Any:
    """The package made by hand, with another value in one place."""
    whole = deepcopy(package())
    *steps, last = path.split("/")
    place = at(whole, steps)
    place[int(last) if isinstance(place, list) else last] = value
    return whole


def at(whole: Any, steps: list[str]) -> Any:
    for step in steps:
        whole = whole[int(step) if isinstance(whole, list) else step]
    return whole


WRONG: list[tuple[Any, str]] = [
    (None, "/: null is not an object"),
    ({}, "/: there is no `package`"),
    (without("plan"), "/: there is no `plan`"),
    (without("shaders"), "/: there is no `shaders`"),
    (without("models"), "/: there is no `models`"),
    (without("textures"), "/: there is no `textures`"),
    (without("plan/textures"), "/plan: there is no `textures`"),
    (without("plan/steps/0/kind"), "/plan/steps/0: there is no `kind`"),
    (with_("plan/steps/0/kind", "dance"), '/plan/steps/0/kind: "dance" has no meaning there'),
    (with_("plan/steps", 7), "/plan/steps: 7 is not a list"),
    (with_("size", [2]), "/size: it has 1 elements"),
    (with_("colour", 1), '/: there is "colour", which has no meaning there'),
    (with_("plan/textures/0/layers", 0), "/plan/textures/0/layers: 0 is less than 1"),
    (
        with_("plan/textures/0/layers", 10**9),
        "/plan/textures/0/layers: 1000000000 is more than 2048",
    ),
    (
        with_("shaders/0/reflection/blocks/0/size", 10**9),
        "/shaders/0/reflection/blocks/0/size: 1000000000 is more than 134217728",
    ),
]


def test_the_place_is_told() -> None:
    said = refused([whole for whole, _ in WRONG])
    assert said == [f"Error: {wanted}" for _, wanted in WRONG]


def test_numbers_name_rows() -> None:
    whole = package()
    textures, shaders = len(whole["plan"]["textures"]), len(whole["shaders"])
    drawn = next(
        number for number, step in enumerate(whole["plan"]["steps"]) if step["kind"] == "draw"
    )
    target, use = f"plan/steps/{drawn}/targets/0/texture", f"plan/steps/{drawn}/draws/0/uses/0"
    said = refused([with_(target, 77), with_(f"{use}/shader", 77)])
    assert said == [
        f"Error: /{target}: there is no 77 among the {textures} textures",
        f"Error: /{use}/shader: there is no 77 among the {shaders} shaders",
    ]


def test_what_is_good_is_not_refused() -> None:
    assert refused([package()]) == [""]


@pytest.mark.parametrize("first", (0, 100))
def test_the_host_refuses_what_burnish_refuses(first: int) -> None:
    """Where Burnish cannot read a package, the host does not take it either, and says so."""
    packages = [mutated(package(), Random(number)) for number in range(first, first + 100)]
    for whole, said in zip(packages, refused(packages), strict=True):
        assert said.startswith("Error: ") or not said
        assert said or is_read(json.loads(json.dumps(whole))), said


def is_read(document: Any) -> bool:
    """True if Burnish reads a package, where 2.0 is a whole number as it is in JavaScript."""
    try:
        read(Package, json.loads(json.dumps(document), parse_float=_number))
    except ShapeError:
        return False
    return True


def _number(text: str) -> float | int:
    return int(float(text)) if float(text).is_integer() else float(text)
