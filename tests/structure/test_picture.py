"""The picture of imports shows each of them, and shows circles as such."""

from __future__ import annotations

from xml.etree import ElementTree

import pytest

from .picture import STYLES, drawn, imports_of_floors, imports_within
from .test_floors import FLOORS

pytestmark = pytest.mark.xdist_group("imports")  # One process reads all modules.


def _lines(picture: str, style: str) -> int:
    return picture.count(STYLES[style])


def test_arrows_by_kind() -> None:
    imports = {"a": "", "b": "a", "c": "a b", "d": "e", "e": "d a"}
    graph = {name: frozenset(others.split()) for name, others in imports.items()}
    for implied in (False, True):
        picture = drawn(graph, "title", implied=implied)
        assert _lines(picture, "direct") == 3
        assert _lines(picture, "implied") == implied
        assert _lines(picture, "circle") == 2


def test_the_floors() -> None:
    graph = imports_of_floors()
    picture = drawn(graph, "floors", implied=True)
    texts = [
        each.text for each in ElementTree.fromstring(picture).iter() if each.tag.endswith("text")
    ]
    assert set(texts) == {"floors", *FLOORS}
    assert picture.count("<path") == sum(map(len, graph.values()))


def test_one_package() -> None:
    graph = imports_within("compiler.diagnostics")
    assert "source" in graph["diagnostic"]
