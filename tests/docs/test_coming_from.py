"""The pages for those who come from other systems: their last columns are Burnish."""

from __future__ import annotations

from itertools import groupby
from pathlib import Path

import pytest

from .comparisons import PAGES, Cell, cells, program, said_of, unmarked_tables


def alike(cell: Cell) -> tuple[str, tuple[str, ...]]:
    """What cells have in common that are tried in one file."""
    return cell.kind, cell.modules


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_what_stands_beside_other_systems_is_right(page: Path) -> None:
    found = sorted(cells(page.read_text(encoding="utf-8")), key=alike)
    assert found
    for _, group in groupby(found, alike):
        said = said_of(program(list(group)))
        assert not said, said


@pytest.mark.parametrize("page", PAGES, ids=lambda page: page.name)
def test_every_table_is_tried(page: Path) -> None:
    assert not unmarked_tables(page.read_text(encoding="utf-8"))


@pytest.mark.parametrize(
    ("kind", "code"),
    [
        ("types", "float3"), ("a material", "lerp(x, y, t)"), ("a material", "normal.uv"),
        ("a rig", "sun : DirectionalLight"), ("a frame", "glow = Blurred(lit)"),
        ("a material", "target color : rgba9 = vec4(0)"), ("a material", "fn f(x) = x"),
    ],
)  # fmt: skip
def test_what_is_wrong_is_told(kind: str, code: str) -> None:
    (cell,) = cells(f"<!-- {kind} -->\n| there | here |\n| --- | --- |\n| | `{code}` |\n")
    assert said_of(program([cell]))
