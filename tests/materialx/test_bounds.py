"""Materials of every document of the tests draw within the bounds of their own meaning.

Each document takes the next route, so that one run draws by all of them. ``suite.py --bounds``
draws whole documents by all routes.
"""

from __future__ import annotations

from collections.abc import Iterator
from itertools import cycle
from pathlib import Path

import pytest

import burnish
from burnish.targets.conformance.summary import details
from burnish.targets.runner.routes import ROUTES, Route

from ..conformance.kit import Studio
from .bounds_worker import judged, rows_of, written
from .kit import FOLDER, document, documents
from .suite import table

pytestmark = pytest.mark.xdist_group("materialx")

SMALL = (18, 14)
"""The size of pictures: the reference takes most of the time."""
MOST = 3
"""The materials of a document that are drawn: others of it are much like these."""
TURNS = [
    pytest.param(document, route, id=f"{document.stem}-{route.name}")
    for document, route in zip(documents(), cycle(ROUTES.values()), strict=False)
]


@pytest.fixture(scope="module")
def studio() -> Iterator[Studio]:
    """Draws with every route and with the reference."""
    with Studio() as studio:
        yield studio


@pytest.mark.parametrize(("document", "route"), TURNS)
def test_pictures_are_within_their_bounds(
    studio: Studio, document: Path, route: Route, tmp_path: Path
) -> None:
    source, _names = written(document, tmp_path)
    materials = burnish.compile(source, [route.profile]).materials
    assert materials
    for material in materials[:MOST]:
        (row,) = rows_of(studio, material, [route], SMALL)
        assert row.status in {"agrees", "proves little"}, (material.name, *details(row))


def test_every_route_has_a_row(studio: Studio) -> None:
    rows = list(judged(studio, document("unlit_constant")))
    assert [row["route"] for row in rows] == list(ROUTES)
    assert {row["renderable"] for row in rows} == {"Lamp"}
    assert {row["verdict"] for row in rows} == {"agrees"}
    told = table([{"document": "unlit_constant.mtlx", **row} for row in rows]).splitlines()
    assert told[:2] == ["1 renderables of 1 documents", f"{len(ROUTES):6} agrees"]
    assert told[2:4] == ["", "by route:"]
    assert f"{1:6} llvmpipe:es310 agrees" in told


def test_the_sixty_documents_are_named_once() -> None:
    names = (FOLDER / "sixty.txt").read_text("utf-8").splitlines()
    assert len(set(names)) == len(names) == 60


def test_a_document_that_cannot_be_read_is_not_run(studio: Studio, tmp_path: Path) -> None:
    broken = tmp_path / "broken.mtlx"
    broken.write_text("<materialx", "utf-8")
    (row,) = judged(studio, broken)
    assert row["verdict"] == "not run"
    assert row["reason"].startswith("not imported: DocumentError")
